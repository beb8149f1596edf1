// The tests' browser: the system's Chromium, else Playwright's headless shell, which has the same
// engine without a window and starts pages in half the time.

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
