// What is said of a program in words: lengths, times, what is in force.
import { rowAt } from "./read.js";

const INCH = 25.4, FOOT = 0.3048;

/** How a program gives lengths: the size of its unit, mm, and what it is called. */
export const unitOf = ({ inch }) =>
  inch ? { size: INCH, name: "inch", digits: 4 } : { size: 1, name: "mm", digits: 3 };

/** A number without zeros at its end. */
export const short = (value, digits) => String(Number(value.toFixed(digits)) + 0);

/** A length of mm in a unit. */
export const length = (mm, unit) => short(mm / unit.size, unit.digits);

export function clock(seconds) {
  const whole = Math.round(seconds), two = (value) => String(value).padStart(2, "0");
  return `${Math.floor(whole / 3600)}:${two(Math.floor(whole / 60) % 60)}:${two(whole % 60)}`;
}

/** The name of a work offset by its number in the columns. */
export function offsetName(fixture) {
  if (!fixture) return "";
  const code = fixture - 1;
  if (code < 1000) return `G${code}`;
  const tenths = Math.floor(code / 1000);
  return code < 1e6 ? `G${Math.floor(tenths / 10)}.${tenths % 10} P${code % 1000}` : `work offset ${code - 1e6}`;
}

/** The tool at a piece; 0 where none is known. */
export function toolNumber(program, piece) {
  const row = rowAt(program.forceFrom, piece);
  if (row >= 0) return program.tool[row];
  const change = rowAt(program.changeFrom, piece);
  return change >= 0 ? program.changeTool[change] : 0;
}

/** F at a piece as the program gives it; empty in rapid traverse. */
export function feedText(program, piece, unit) {
  const row = rowAt(program.forceFrom, piece);
  if (program.strokes[piece] === 0) return "rapid";
  if (row < 0 || !program.feedKind[row]) return "";
  return `F ${length(program.feed[row], unit)} ${unit.name}${program.feedKind[row] === 1 ? "/min" : "/rev"}`;
}

/** S at a piece. */
export function speedText(program, piece) {
  const row = rowAt(program.forceFrom, piece);
  if (row < 0 || !program.speedKind[row]) return "";
  const value = program.speed[row];
  const turns = ["spindle off", "clockwise", "counterclockwise"][program.spindle[row]];
  const amount = program.speedKind[row] === 1 ? `${short(value, 1)} rpm`
    : program.inch ? `${short(value / FOOT, 1)} ft/min` : `${short(value, 1)} m/min`;
  return `S ${amount} ${turns}`;
}

/** The work offset at a piece. */
export function offsetText(program, piece) {
  const row = rowAt(program.forceFrom, piece);
  return row < 0 ? "" : offsetName(program.fixture[row]);
}

/** A tool in words. */
export function toolText(program, number) {
  const shape = program.tools.find((tool) => tool.number === number), unit = unitOf(program);
  if (!number) return "";
  if (!shape) return program.lathe ? `T${number}` : `T${number} (size not known)`;
  const { diameter, corner, bottom } = shape, size = `\u2300${length(diameter, unit)}`;
  if (bottom > 0) return `T${number} drill ${size}`;
  if (corner === 0) return `T${number} flat ${size}`;
  return corner >= diameter / 2 - 1e-6 ? `T${number} ball ${size}` : `T${number} bull ${size} R${length(corner, unit)}`;
}
