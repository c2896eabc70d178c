// The files in the address: JSON, deflated, in base64 of addresses.

async function through(stream, bytes) {
  const piped = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(piped).arrayBuffer());
}

/** Files and the part that is shown as the part of an address behind `#`. */
export async function pack(state) {
  const text = new TextEncoder().encode(JSON.stringify(state));
  const bytes = await through(new CompressionStream("deflate-raw"), text);
  let letters = "";
  for (const byte of bytes) letters += String.fromCharCode(byte);
  return btoa(letters).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}

/** The state of an address, `{files, part}`; null where the address has none that can be read. */
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

const isFile = (file) => typeof file?.name === "string" && file.name !== "" && typeof file?.text === "string";

/** A link comes from anywhere: what has not the shape of a state is not taken. */
function isState(state) {
  const { files, part } = state ?? {};
  return Array.isArray(files) && files.every(isFile) && (part === null || typeof part === "string");
}
