// Colors of elements that follow only the system: posters and the browser's frame; and the button for the reader's
// settings.

import { keepSettings, type Settings, SETTINGS_KEY, showSettings, shownSettings, storedSettings } from "./settings";

const DARK = "(prefers-color-scheme: dark)";

function apply(): void {
  const { theme, contrast } = shownSettings();
  // With more contrast, figures have a black background.
  const chosen = contrast ? "dark" : theme;
  for (const source of document.querySelectorAll<HTMLSourceElement>("picture > source[media]")) {
    source.dataset.media ??= source.media;
    const media = source.dataset.media;
    if (!media.includes(DARK)) continue;
    const dark = media.replace(` and ${DARK}`, "").replace(DARK, "all");
    source.media = !chosen ? media : chosen === "dark" ? dark : "not all";
  }
  for (const meta of document.querySelectorAll<HTMLMetaElement>('meta[name="theme-color"]')) {
    meta.dataset.system ??= meta.content;
    meta.content = theme || contrast ? getComputedStyle(document.body).backgroundColor : meta.dataset.system;
  }
}

function show(settings: Settings): void {
  showSettings(settings);
  apply();
}

function keep(settings: Settings): void {
  keepSettings(settings);
  apply();
}

/** Follows the settings; their panel opens from the bar. `missing` is called if its script could not be loaded. */
export function startSettings(missing: () => void): void {
  apply();
  for (const query of [DARK, "(prefers-contrast: more)", "(forced-colors: active)"]) {
    matchMedia(query).addEventListener("change", () => show(shownSettings()));
  }
  addEventListener("storage", ({ key }) => {
    // A null key means that the whole storage was cleared.
    if (key === SETTINGS_KEY || key === null) show(storedSettings());
  });
  const button = document.querySelector<HTMLButtonElement>(".settings-button");
  if (!button) return;
  button.hidden = false;
  const open = () =>
    void import("./settings_panel").then(
      ({ makePanel }) => makePanel(button, { shown: shownSettings, keep }).showPopover(),
      missing,
    );
  button.addEventListener("click", open, { once: true });
}
