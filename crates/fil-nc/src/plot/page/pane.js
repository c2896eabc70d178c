// The program beside the drawing.

const pane = element("pane"), sheet = element("sheet"), rows = element("rows");
/** Height of a line, and the greatest height of a page that browsers lay out, in pixels. */
const ROW = 18, SHEET = 12e6;
/** A program higher than that is scrolled by shares of its length. */
const isLong = path.text.count * ROW > SHEET;
let current = 0;
sheet.style.height = `${Math.min(path.text.count * ROW, SHEET)}px`;

/** Lines in sight, how many of the program lie above them at most, and how far it scrolls. */
function sight() {
  const room = Math.ceil(pane.clientHeight / ROW);
  return { room, above: Math.max(0, path.text.count - room + 1), way: sheet.clientHeight - pane.clientHeight };
}

/** Lines above what is in sight. */
function linesAbove({ above, way }) {
  return Math.floor(isLong ? pane.scrollTop / way * above : pane.scrollTop / ROW);
}

/** Writes the lines that are in sight. */
function writeRows() {
  const now = sight(), top = linesAbove(now);
  const first = Math.max(0, top - 5), last = Math.min(path.text.count, top + now.room + 5);
  rows.replaceChildren();
  rows.style.top = `${isLong ? pane.scrollTop - (top - first) * ROW : first * ROW}px`;
  for (let line = first + 1; line <= last; line++) {
    const row = document.createElement("div"), number = document.createElement("i");
    number.textContent = line;
    row.append(number, path.text.get(line));
    row.dataset.line = line;
    row.classList.toggle("chosen", line === current);
    rows.append(row);
  }
}

/** Marks a line, and scrolls to it where it is out of sight. */
function goTo(line) {
  current = line;
  const now = sight(), top = linesAbove(now), wanted = Math.max(0, line - now.room / 2);
  if (line <= top || line > top + now.room - 2)
    pane.scrollTop = isLong ? wanted / now.above * now.way : wanted * ROW;
  writeRows();
}

/** Tells a page around this one, such as an editor, of the line that was chosen. */
function tell(line) {
  document.dispatchEvent(new CustomEvent("line-chosen", { detail: line }));
}

pane.addEventListener("scroll", writeRows);
rows.addEventListener("click", (event) => {
  const row = event.target.closest("[data-line]");
  if (row) chooseLine(Number(row.dataset.line));
});

/** Marks a line of the program and what it makes. */
function chooseLine(line) {
  const wanted = Math.max(1, Math.min(path.text.count, line));
  goTo(wanted);
  choose(wanted);
  tell(wanted);
}
new ResizeObserver(writeRows).observe(pane);
