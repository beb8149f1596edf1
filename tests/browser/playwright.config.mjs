import { defineConfig } from "@playwright/test";
import { launchOptions } from "./chromium.mjs";

export default defineConfig({
  testDir: ".",
  testMatch: "*.spec.mjs",
  // `make test-hosts` and `make test-lab` run these, which take minutes to build.
  testIgnore: process.env.LAB ? "hosts/**" : ["hosts/**", "lab.spec.mjs", "labfaults.spec.mjs", "labkeep.spec.mjs"],
  outputDir: "test-results",
  fullyParallel: true,
  workers: 2,
  timeout: 120_000,
  expect: { timeout: 15_000 },
  reporter: [["list", { printSteps: false }], ["./slowest.mjs"]],
  // The worker of the book would answer for the tests' servers; its own tests allow it.
  use: { serviceWorkers: "block", browserName: "chromium", launchOptions, viewport: { width: 1000, height: 900 } },
});
