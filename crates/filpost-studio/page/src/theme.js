// Light or dark: as the system is, until somebody chooses.
import { by, signal } from "./dom.js";
import { remember, remembered } from "./memory.js";

const system = matchMedia("(prefers-color-scheme: dark)");

/** The page has become dark or light. */
export const themed = signal();

export const isDark = () => document.documentElement.dataset.theme === "dark";

function follow() {
  const chosen = remembered().theme;
  document.documentElement.dataset.theme = chosen ?? (system.matches ? "dark" : "light");
  by("theme").setAttribute("aria-pressed", String(isDark()));
  themed.tell();
}

export function startTheme() {
  system.addEventListener("change", follow);
  by("theme").addEventListener("click", () => {
    remember("theme", isDark() ? "light" : "dark");
    follow();
  });
  follow();
}
