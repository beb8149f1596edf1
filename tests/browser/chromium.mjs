// Which browser the tests use: the system's Chromium first, else Playwright's own. The headless shell
// is the same engine without windows, menus and toolbars, and starts a page in half the time.

import { existsSync } from "node:fs";

const SYSTEM = [
  process.env.CHROMIUM,
  "/usr/bin/chromium-headless-shell",
  "/usr/bin/chromium",
  "/usr/bin/chromium-browser",
  "/usr/bin/google-chrome",
  "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
];

const found = SYSTEM.find((path) => path && existsSync(path));

/** Options for `chromium.launch`. */
export const launchOptions = {
  ...(found ? { executablePath: found } : {}),
  args: ["--no-sandbox", "--font-render-hinting=none"],
};
