// What is shown: kinds of motions, one operation, one work offset, levels of Z.

const tool = element("tool"), work = element("work"), low = element("low"), high = element("high");
/** Most entries of a list. */
const ENTRIES = 1000;

/** A check box of what is drawn, with a sample of its line. */
function legend(layer, style) {
  const label = document.createElement("label"), box = document.createElement("input");
  const sample = document.createElement("i");
  box.type = "checkbox";
  box.checked = true;
  box.addEventListener("change", () => {
    layer.on = box.checked;
    drawOthers();
  });
  sample.style.borderTop = `${style} ${layer.colour}`;
  label.append(box, " ", sample, ` ${layer.name}`);
  element("layers").append(label);
  return label;
}
const used = path.kinds.reduce((all, kinds) => all | kinds, 0);
for (const layer of layers) {
  if (!(used >> layer.index & 1)) continue;
  legend(layer, layer.index === 0 ? `1px ${path.total < DASHES ? "dashed" : "solid"}` : "2px solid");
}
let underLabel = null;
function showUnder() {
  underLabel?.remove();
  underLabel = legend(underLayer, "5px solid");
}
if (under) showUnder();
if (path.axes.from.length) legend(axisLayer, "1px solid");

/** Operations: from one tool to the next. */
const operations = [];
for (let row = 0; row < path.inForce.from.length; row++) {
  const number = path.inForce.tool[row];
  if (!row || path.inForce.tool[row - 1] !== number) operations.push({ from: path.inForce.from[row], tool: number });
}
const option = (select, value, text) => select.append(new Option(text, value));
option(tool, "", "all tools");
const several = [...new Set(operations.map((one) => one.tool))]
  .map((number) => ({ number, count: operations.filter((one) => one.tool === number).length }))
  .filter(({ count }) => count > 1);
several.slice(0, ENTRIES).forEach(({ number, count }) => option(tool, `T${number}`, `T${number} in ${count} operations`));
operations.slice(0, ENTRIES).forEach((one, index) =>
  option(tool, index, `${index + 1}: T${one.tool} from line ${path.lines[one.from]}`));
if (operations.length > ENTRIES) {
  const rest = new Option(`and ${operations.length - ENTRIES} more`);
  rest.disabled = true;
  tool.append(rest);
}
option(work, "", "all offsets");
const fixtures = [...new Set(path.inForce.fixture)];
fixtures.slice(0, ENTRIES).forEach((fixture) => option(work, fixture, offset(fixture)));
tool.hidden = operations.length < 2;
work.hidden = fixtures.length < 2;

function filter() {
  const number = tool.value.startsWith("T") ? Number(tool.value.slice(1)) : null;
  const one = tool.value === "" || number !== null ? null : Number(tool.value);
  const first = one === null ? 0 : operations[one].from;
  const end = one === null || one + 1 >= operations.length ? path.total : operations[one + 1].from;
  const least = low.value === "" ? -Infinity : Number(low.value) * data.unit.size - data.step / 2;
  const most = high.value === "" ? Infinity : Number(high.value) * data.unit.size + data.step / 2;
  const { from, fixture } = path.inForce;
  for (let piece = 0, row = -1; piece < path.total; piece++) {
    while (row + 1 < from.length && from[row + 1] <= piece) row++;
    const z = coordinate(path, path.ends[piece] - 1, 2);
    const seen = piece >= first && piece < end && z >= least && z <= most &&
      (number === null || row >= 0 && path.inForce.tool[row] === number) &&
      (work.value === "" || (row < 0 ? 0 : fixture[row]) === Number(work.value));
    path.mask[piece] = seen ? 1 : 0;
  }
  soon("picture", drawOthers);
}
for (const field of [tool, work, low, high]) field.addEventListener("input", filter);
