"use strict";
(() => {
  const { path, data, at, short, draw, soon, show, look, fit, choose } = window.filpostPlot;
  const element = (id) => document.getElementById(id);
  const pane = element("pane"), sheet = element("sheet"), rows = element("rows");
  const ROW = 18, RAPID = 10000;

  // --- the program ------------------------------------------------------------

  let current = 0;
  sheet.style.height = `${path.texts.length * ROW}px`;

  /** Writes the lines that are in sight. */
  function lines() {
    const first = Math.max(0, Math.floor(pane.scrollTop / ROW) - 5);
    const last = Math.min(path.texts.length, first + Math.ceil(pane.clientHeight / ROW) + 10);
    rows.replaceChildren();
    rows.style.top = `${first * ROW}px`;
    for (let line = first + 1; line <= last; line++) {
      const row = document.createElement("div"), number = document.createElement("i");
      number.textContent = line;
      row.append(number, path.texts[line - 1]);
      row.dataset.line = line;
      row.classList.toggle("chosen", line === current);
      rows.append(row);
    }
  }

  function goTo(line, scrolls) {
    current = line;
    const top = (line - 1) * ROW, sight = pane.clientHeight;
    if (scrolls && (top < pane.scrollTop || top > pane.scrollTop + sight - 2 * ROW))
      pane.scrollTop = top - sight / 2;
    lines();
  }

  pane.addEventListener("scroll", () => lines());
  rows.addEventListener("click", (event) => {
    const row = event.target.closest("[data-line]");
    if (!row) return;
    goTo(Number(row.dataset.line), false);
    choose(current, false);
  });
  window.filpostPlot.told = (line) => goTo(line, true);
  window.filpostPlot.shown = (line) => goTo(line, true);

  // --- time ---------------------------------------------------------------------

  const count = path.starts.length;
  const ends = new Float64Array(count);

  function lengthOf(piece) {
    let length = 0;
    for (let point = path.starts[piece]; point + 1 < path.ends[piece]; point++) {
      const a = 3 * point, { points } = path;
      length += Math.hypot(points[a + 3] - points[a], points[a + 4] - points[a + 1], points[a + 5] - points[a + 2]);
    }
    return length;
  }

  /** mm a minute; 0 where nothing says it. */
  function feedOf(piece, now) {
    if (path.strokes[piece] === 0) return RAPID;
    if (!now || now.feedKind === 0) return 0;
    return now.feedKind === 1 ? now.feed : now.speedKind === 1 ? now.feed * now.speed : 0;
  }

  for (let piece = 0, minutes = 0, state = -1; piece < count; piece++) {
    while (state + 1 < path.inForce.length && path.inForce[state + 1].from <= piece) state++;
    const feed = feedOf(piece, path.inForce[state]);
    if (feed > 0) minutes += lengthOf(piece) / feed;
    ends[piece] = minutes;
  }

  function clock(minutes) {
    const seconds = Math.round(minutes * 60), two = (value) => String(value).padStart(2, "0");
    return `${Math.floor(seconds / 3600)}:${two(Math.floor(seconds / 60) % 60)}:${two(seconds % 60)}`;
  }

  function offset(fixture) {
    const code = fixture - 1;
    if (code < 1000) return `G${code}`;
    const tenths = Math.floor(code / 1000);
    return code < 1e6 ? `G${Math.floor(tenths / 10)}.${tenths % 10} P${code % 1000}` : `work offset ${code - 1e6}`;
  }

  window.filpostPlot.stateOf = (trace, piece) => {
    const now = trace === path ? at(path.inForce, piece) : null;
    if (!now) return "";
    const said = [`T${now.tool}`];
    if (now.fixture) said.push(offset(now.fixture));
    if (path.strokes[piece] !== 0 && now.feedKind) said.push(`F ${short(now.feed)} ${now.feedKind === 1 ? "mm/min" : "mm a turn"}`);
    if (now.speedKind) said.push(`S ${short(now.speed)} ${now.speedKind === 1 ? "turns/min" : "m/min"}`);
    said.push(["spindle off", "clockwise", "counterclockwise"][now.spindle], `after ${clock(ends[piece])}`);
    return said.join(" · ");
  };

  // --- playback -------------------------------------------------------------------

  const play = element("play"), speed = element("speed"), time = element("time");
  let playing = 0, minutes = 0;

  function stop() {
    clearInterval(playing);
    playing = 0;
    play.textContent = "Play";
    play.setAttribute("aria-pressed", "false");
  }

  /** How many motions are over after some minutes. */
  function over(minutes) {
    let low = 0, high = count;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (ends[middle] <= minutes) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  function tick() {
    minutes += Number(speed.value) / 60 / 20;
    // A motion without a known feed takes no time, and a long one is not waited for.
    const reached = Math.max(over(minutes), path.shown + (ends[path.shown] - minutes > 0 ? 0 : 1));
    show(reached);
    if (path.shown >= count) stop();
  }

  function toggle() {
    if (playing) return stop();
    if (path.shown >= count) show(0);
    minutes = path.shown ? ends[path.shown - 1] : 0;
    play.textContent = "Pause";
    play.setAttribute("aria-pressed", "true");
    playing = setInterval(tick, 50);
  }

  play.addEventListener("click", toggle);
  time.textContent = count ? `${clock(ends[count - 1])} with rapids at ${RAPID / 1000} m/min` : "";

  // --- what is shown ----------------------------------------------------------------

  const tool = element("tool"), work = element("work"), low = element("low"), high = element("high");

  /** Operations: from one tool to the next. */
  const operations = [];
  for (const now of path.inForce) {
    const last = operations[operations.length - 1];
    if (!last || last.tool !== now.tool) operations.push({ from: now.from, tool: now.tool });
  }
  const option = (select, value, text) => select.append(new Option(text, value));
  option(tool, "", "all tools");
  operations.forEach((one, index) => option(tool, index, `${index + 1}: T${one.tool} from line ${path.lines[one.from]}`));
  option(work, "", "all offsets");
  const fixtures = [...new Set(path.inForce.map((now) => now.fixture))];
  fixtures.forEach((fixture) => option(work, fixture, fixture ? offset(fixture) : "no offset"));
  tool.hidden = operations.length < 2;
  work.hidden = fixtures.length < 2;

  function filter() {
    const chosen = tool.value === "" ? null : Number(tool.value);
    const first = chosen === null ? 0 : operations[chosen].from;
    const end = chosen === null || chosen + 1 >= operations.length ? count : operations[chosen + 1].from;
    const least = low.value === "" ? -Infinity : Number(low.value);
    const most = high.value === "" ? Infinity : Number(high.value);
    for (let piece = 0; piece < count; piece++) {
      let seen = piece >= first && piece < end;
      if (seen && work.value !== "") {
        const now = at(path.inForce, piece);
        seen = (now ? now.fixture : 0) === Number(work.value);
      }
      if (seen) {
        const z = path.points[3 * (path.ends[piece] - 1) + 2];
        seen = z >= least && z <= most;
      }
      path.mask[piece] = seen ? 1 : 0;
    }
    soon(draw);
  }
  for (const field of [tool, work, low, high]) field.addEventListener("input", filter);

  // --- keys and themes ------------------------------------------------------------------

  const theme = element("theme");
  theme.addEventListener("click", () => {
    const dark = matchMedia("(prefers-color-scheme: dark)").matches;
    const now = document.documentElement.dataset.theme || (dark ? "dark" : "light");
    document.documentElement.dataset.theme = now === "dark" ? "light" : "dark";
    draw();
  });

  const STEPS = { ArrowRight: 1, ArrowLeft: -1, PageDown: 100, PageUp: -100, Home: -Infinity, End: Infinity };
  const KEYS = {
    " ": toggle, f: () => { fit(); draw(); }, d: () => theme.click(),
    1: () => look("xy"), 2: () => look("zx"), 3: () => look("zy"), 4: () => look("iso"),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (/^(INPUT|SELECT|BUTTON)$/.test(event.target.tagName)) return;
    if (event.key in STEPS) show(path.shown + STEPS[event.key]);
    else if (KEYS[event.key]) KEYS[event.key]();
    else return;
    event.preventDefault();
  });

  new ResizeObserver(lines).observe(pane);
  lines();
  draw();
})();
