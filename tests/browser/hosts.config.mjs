// Configuration for `make test-hosts`: each host is built by its own tool from the recipe in
// docs/embed/. Some bring service workers of their own.

import base from "./playwright.config.mjs";

export default { ...base, testDir: "hosts", testMatch: "*.spec.mjs", testIgnore: [], timeout: 300_000, workers: 1, use: { ...base.use, serviceWorkers: "allow", actionTimeout: 60_000 } };
