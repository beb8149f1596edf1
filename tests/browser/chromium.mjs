// Which browser the tests use: the system's Chromium first, else Playwright's own.

import { existsSync } from "node:fs";

const SYSTEM = [
  process.env.CHROMIUM,
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
