// The state of the page in its address: JSON, deflated, in base64 of addresses.

async function through(stream, bytes) {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

/** A state as the part of an address behind `#`. */
export async function pack(state) {
  const text = new TextEncoder().encode(JSON.stringify(state));
  const bytes = await through(new CompressionStream("deflate-raw"), text);
  let letters = "";
  for (const byte of bytes) letters += String.fromCharCode(byte);
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The state of an address; null where the address has none that can be read. */
export async function unpack(packed) {
  try {
    const letters = atob(packed.replaceAll("-", "+").replaceAll("_", "/"));
    const bytes = Uint8Array.from(letters, (letter) => letter.charCodeAt(0));
    const text = await through(new DecompressionStream("deflate-raw"), bytes);
    const state = JSON.parse(new TextDecoder().decode(text));
    return isState(state) ? state : null;
  } catch {
    return null;
  }
}

const isFile = (file) => typeof file?.name === "string" && typeof file?.text === "string";

/** A link comes from anywhere: what has not the shape of a state is not taken. */
function isState(state) {
  const { cl, machine, fil, includes = [], options } = state ?? {};
  const plain = typeof options === "object" && options !== null && !Array.isArray(options);
  const files = (list) => Array.isArray(list) && list.every(isFile);
  return isFile(cl) && isFile(machine) && files(fil) && files(includes) && plain;
}
