// The tests of hosts: `make test-hosts`. Each builds with its own tool what its recipe in docs/embed/ says.

import base from "./playwright.config.mjs";

export default { ...base, testDir: "hosts", testMatch: "*.spec.mjs", testIgnore: [], timeout: 300_000, workers: 1, use: { ...base.use, actionTimeout: 60_000 } };
