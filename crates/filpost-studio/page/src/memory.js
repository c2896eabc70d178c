// What the page keeps for the next time, where the browser lets it.

const NAME = "filpost-studio";

/** A year, seconds. */
const LONG = 31_536_000;

/** The studio has another port each time, and so another store: a cookie belongs to the computer and is still there. */
function read() {
  const cookie = document.cookie.split("; ").find((each) => each.startsWith(`${NAME}=`));
  return cookie ? decodeURIComponent(cookie.slice(NAME.length + 1)) : localStorage.getItem(NAME);
}

/** What was kept, by names. */
export function remembered() {
  try {
    return JSON.parse(read()) ?? {};
  } catch {
    return {};
  }
}

/** Keeps a number or a short word. */
export function remember(name, value) {
  try {
    const text = JSON.stringify({ ...remembered(), [name]: value });
    document.cookie = `${NAME}=${encodeURIComponent(text)}; path=/; max-age=${LONG}; samesite=strict`;
    localStorage.setItem(NAME, text);
  } catch {
    // A browser that keeps nothing shows the page as the first time.
  }
}
