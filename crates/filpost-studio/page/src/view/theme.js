// Colours, as the style sheet of the view gives them.

const NAMES = ["paper", "rapid", "feed", "arc", "thread", "second", "ghost", "mark", "cutter", "holder", "stock", "x", "y", "z"];

/** The colours in force in an element. */
export function themeOf(root) {
  const style = getComputedStyle(root), colour = (name) => style.getPropertyValue(`--fv-${name}`).trim();
  const list = (name) => style.getPropertyValue(`--fv-${name}`).split(",").map((one) => one.trim());
  const theme = Object.fromEntries(NAMES.map((name) => [name, colour(name)]));
  return { ...theme, tools: list("tools"), feeds: list("feeds") };
}
