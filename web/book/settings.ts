// The reader's settings of the page. Each is an attribute of the root, which style sheets and
// figures read, and is absent where the system or the book decides.

import { wantsContrast } from "../src/theme";

export const SETTINGS_KEY = "epipole-settings";

/** Values of each setting other than its default. */
export const VALUES = {
  theme: ["light", "dark"],
  contrast: ["more"],
  text: ["115", "130", "150"],
  face: ["legible"],
  motion: ["reduced"],
} as const;

export type Name = keyof typeof VALUES;
export type Settings = { [N in Name]?: (typeof VALUES)[N][number] };

const names = Object.keys(VALUES) as Name[];

/** Parses settings stored as `text`, ignoring unknown names and values. */
export function parseSettings(text: string | null): Settings {
  try {
    const stored = JSON.parse(text ?? "{}") as Record<string, unknown>;
    const known = names.filter((name) => (VALUES[name] as readonly unknown[]).includes(stored[name]));
    return Object.fromEntries(known.map((name) => [name, stored[name]]));
  } catch {
    return {};
  }
}

/** Returns the stored settings; none if storage is blocked. */
export function storedSettings(): Settings {
  try {
    return parseSettings(localStorage.getItem(SETTINGS_KEY));
  } catch {
    return {};
  }
}

export function showSettings(settings: Settings): void {
  const { classList, dataset } = document.documentElement;
  for (const name of names) {
    const value = settings[name];
    if (value) dataset[name] = value;
    else delete dataset[name];
  }
  // CSS cannot combine an attribute and a media query in one selector.
  classList.toggle("contrast", wantsContrast());
}

/** Returns the settings that the page shows. */
export function shownSettings(): Settings {
  return parseSettings(JSON.stringify(document.documentElement.dataset));
}

/** Shows and stores settings. If storage is blocked, they apply to this visit only. */
export function keepSettings(settings: Settings): void {
  showSettings(settings);
  try {
    if (Object.keys(settings).length === 0) localStorage.removeItem(SETTINGS_KEY);
    else localStorage.setItem(SETTINGS_KEY, JSON.stringify(settings));
  } catch {
    // Not stored.
  }
}
