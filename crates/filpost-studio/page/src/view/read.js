// A path as the answer `columns` of the module gives it: plain columns, looked at in place.

const KINDS = { u8: Uint8Array, u32: Uint32Array, f32: Float32Array, f64: Float64Array };
const MARK = "FPV1";

/** The bytes of an answer, from base 64. */
export function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let at = 0; at < bytes.length; at++) bytes[at] = text.charCodeAt(at);
  return bytes;
}

/** A program: the fields of the head, and each column as a typed array under its name. */
export function readProgram(given) {
  const aligned = given.byteOffset % 8 === 0 ? given : given.slice();
  const { buffer, byteOffset, byteLength } = aligned;
  const mark = String.fromCharCode(...aligned.subarray(0, 4));
  if (mark !== MARK) throw new Error("these bytes are no path of filpost");
  const length = new DataView(buffer, byteOffset, byteLength).getUint32(4, true);
  const head = JSON.parse(new TextDecoder().decode(aligned.subarray(8, 8 + length)));
  const { columns, ...program } = head;
  for (const [name, [kind, start, count]] of Object.entries(columns))
    program[name] = new KINDS[kind](buffer, byteOffset + 8 + length + start, count);
  program.total = program.lines.length;
  return program;
}

/** The row of a table that counts at a piece: the last one from it or before; -1 for none. */
export function rowAt(from, piece) {
  let low = 0, high = from.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (from[middle] <= piece) low = middle + 1;
    else high = middle;
  }
  return low - 1;
}

/** The first piece that ends after a time, seconds; the number of pieces where none does. */
export function pieceAt({ seconds, total }, time) {
  let low = 0, high = total;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (seconds[middle] <= time) low = middle + 1;
    else high = middle;
  }
  return low;
}

/** Seconds of the whole program. */
export const duration = ({ seconds, total }) => (total ? seconds[total - 1] : 0);
