// Light and dark theme. The system decides until the reader chooses; a choice equal to the system's
// is forgotten, so that the page follows the system again.

const KEY = "epipole-theme";
const root = document.documentElement;
const DARK = "(prefers-color-scheme: dark)";
const system = matchMedia(DARK);

function isDark(): boolean {
  return root.dataset.theme ? root.dataset.theme === "dark" : system.matches;
}

/** Applies the theme to posters and the browser's frame, which follow only the system's colors. */
function apply(button: HTMLButtonElement | null): void {
  const dark = isDark();
  button?.setAttribute("aria-pressed", String(dark));
  for (const source of document.querySelectorAll<HTMLSourceElement>("picture > source[media]")) {
    source.dataset.media ??= source.media;
    const media = source.dataset.media;
    if (!media.includes(DARK)) continue;
    const chosen = dark ? media.replace(` and ${DARK}`, "").replace(DARK, "all") : "not all";
    source.media = root.dataset.theme ? chosen : media;
  }
  for (const meta of document.querySelectorAll<HTMLMetaElement>('meta[name="theme-color"]')) {
    meta.dataset.system ??= meta.content;
    meta.content = root.dataset.theme ? getComputedStyle(document.body).backgroundColor : meta.dataset.system;
  }
}

export function startTheme(): void {
  const button = document.querySelector<HTMLButtonElement>(".theme-button");
  apply(button);
  system.addEventListener("change", () => apply(button));
  if (!button) return;
  button.hidden = false;
  button.addEventListener("click", () => {
    const wanted = isDark() ? "light" : "dark";
    const follows = (wanted === "dark") === system.matches;
    if (follows) delete root.dataset.theme;
    else root.dataset.theme = wanted;
    try {
      if (follows) localStorage.removeItem(KEY);
      else localStorage.setItem(KEY, wanted);
    } catch {
      // Not stored; the theme is applied for this visit.
    }
    apply(button);
  });
  addEventListener("storage", (event) => {
    if (event.key !== KEY) return;
    if (event.newValue === "light" || event.newValue === "dark") root.dataset.theme = event.newValue;
    else delete root.dataset.theme;
    apply(button);
  });
}
