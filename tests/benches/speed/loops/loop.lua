-- In the scope of a file with local variables, the fast way in Lua.
print("start")
io.flush()
local xx, nn = 0.0, 0.0
for ii = 1.0, 10000000.0 do
  xx = xx + ii * 2.0
  if xx > 1000000.0 then
    xx = xx - 1000000.0
    nn = nn + 1.0
  end
end
print(string.format("%.17g %.17g", xx, nn))
