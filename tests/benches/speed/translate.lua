-- The translator of handwritten.rs as a LuaJIT script: luajit translate.lua CL NC
--
-- Numbers are read byte by byte, which LuaJIT compiles, where patterns and
-- tonumber would fall back to its interpreter.

local byte, format, sub = string.byte, string.format, string.sub
local concat = table.concat

local SCALE = 10000
local LAST_NUMBER = 99999
local PIECES = 8192

local input = assert(io.open(arg[1], "rb"))
local output = assert(io.open(arg[2], "wb"))
input:setvbuf("full", 262144)

local pieces, count = {}, 0
local last = { false, false, false }
local point = { 0, 0, 0 }
local letters = { "X", "Y", "Z" }
local feed, last_feed = false, false
local rapid, last_rapid = false, nil
local number = 0

local function put(piece)
  count = count + 1
  pieces[count] = piece
end

local function flush()
  output:write(concat(pieces, "", 1, count))
  count = 0
end

-- The number from position `at` of a line, as a count of the last decimal, and
-- the position after it.
local function scaled(line, at)
  local character = byte(line, at)
  while character == 32 do
    at = at + 1
    character = byte(line, at)
  end
  local negative = character == 45
  if negative then
    at = at + 1
    character = byte(line, at)
  end
  local value = 0
  while character and character >= 48 and character <= 57 do
    value = value * 10 + (character - 48)
    at = at + 1
    character = byte(line, at)
  end
  local decimals = 0
  if character == 46 then
    at = at + 1
    character = byte(line, at)
    while character and character >= 48 and character <= 57 do
      if decimals < 4 then
        value = value * 10 + (character - 48)
      elseif decimals == 4 and character >= 53 then
        value = value + 1
      end
      decimals = decimals + 1
      at = at + 1
      character = byte(line, at)
    end
  end
  while decimals < 4 do
    value = value * 10
    decimals = decimals + 1
  end
  return negative and -value or value, at
end

-- The texts of four decimals without the zeros at their end.
local decimals = {}
for rest = 0, SCALE - 1 do
  decimals[rest] = "." .. format("%04d", rest):gsub("0+$", "")
end

local function word(letter, value)
  put(letter)
  if value < 0 then
    put("-")
    value = -value
  end
  local rest = value % SCALE
  put((value - rest) / SCALE)
  put(decimals[rest])
end

local function block()
  number = number + 10
  if number > LAST_NUMBER then
    number = 10
  end
  put("N")
  put(number)
end

local function go_to(line)
  local at = 7
  for axis = 1, 3 do
    point[axis], at = scaled(line, at)
    at = at + 1
  end
  local now_rapid = rapid
  rapid = false
  if point[1] == last[1] and point[2] == last[2] and point[3] == last[3] then
    return
  end
  block()
  if now_rapid ~= last_rapid then
    put(now_rapid and " G0" or " G1")
    last_rapid = now_rapid
  end
  for axis = 1, 3 do
    if point[axis] ~= last[axis] then
      put(" ")
      word(letters[axis], point[axis])
      last[axis] = point[axis]
    end
  end
  if not now_rapid and feed ~= last_feed then
    put(" ")
    word("F", feed)
    last_feed = feed
  end
  put("\n")
end

for line in input:lines() do
  local first = byte(line, 1)
  if first == 71 and sub(line, 1, 6) == "GOTO /" then
    go_to(line)
    if count > PIECES then
      flush()
    end
  elseif first == 70 and sub(line, 1, 8) == "FEDRAT /" then
    feed = scaled(line, 9)
  elseif first == 70 and sub(line, 1, 4) == "FINI" then
    block()
    put(" M30\n")
  elseif first == 82 and sub(line, 1, 5) == "RAPID" then
    rapid = true
  end
end
flush()
output:close()
