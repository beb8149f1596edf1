// Drivers of three engines with one interface: `open(url)`, `run(function, argument)`,
// `press(...keys)`, `isAlive()`, `complaints` and `close()`.
//
// Firefox is driven by WebDriver BiDi without another program. WebKit has a driver of its own that
// opens a window, on a virtual display.

import puppeteer from "puppeteer-core";
import { Browser, Builder, Capabilities, Key } from "selenium-webdriver";
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { launchOptions } from "../browser/chromium.mjs";

/** Size of a laptop's window, CSS pixels. */
export const WINDOW = { width: 1280, height: 900 };

/** Time limit of any step, also on a busy machine, milliseconds. */
const PATIENCE_MS = 240_000;
/** Time for an engine to end when asked, milliseconds. */
const GRACE_MS = 10_000;
/** Time without requests after which a page is loaded, milliseconds. */
const IDLE_MS = 200;

const FIREFOX = ["/usr/bin/firefox-esr", "/usr/bin/firefox", "/Applications/Firefox.app/Contents/MacOS/firefox"];
const MINI_BROWSERS = ["x86_64-linux-gnu", "aarch64-linux-gnu"].flatMap((machine) =>
  ["4.1", "4.0"].map((version) => `/usr/lib/${machine}/webkit2gtk-${version}/MiniBrowser`),
);

// Software WebGL for the Lab, as there may be no GPU.
const args = [...launchOptions.args, "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const extraPrefsFirefox = { "webgl.force-enabled": true, "webgl.disable-fail-if-major-performance-caveat": true };

export const chromium = () => byPuppeteer("Chromium", { ...launchOptions, args, browser: "chrome", headless: true });

export const firefox = () => openFirefox({ headless: true });

/** Firefox in a window on a virtual display, as it offers no WebGL without a window. */
export async function firefoxWindow() {
  const screen = hiddenScreen();
  const env = { ...process.env, DISPLAY: screen.display, LIBGL_ALWAYS_SOFTWARE: "1" };
  const engine = await orClose(() => openFirefox({ headless: false, env }), screen.close);
  return { ...engine, close: () => engine.close().finally(screen.close) };
}

function openFirefox(options) {
  const executablePath = process.env.FIREFOX ?? FIREFOX.find((path) => existsSync(path));
  if (!executablePath) throw new Error("Firefox is missing: install firefox-esr, or set FIREFOX=path");
  return byPuppeteer("Firefox", { browser: "firefox", executablePath, extraPrefsFirefox, ...options });
}

async function byPuppeteer(name, options) {
  const browser = await puppeteer.launch({ ...options, defaultViewport: WINDOW, protocolTimeout: PATIENCE_MS });
  const page = await orClose(() => browser.newPage(), () => browser.close());
  const complaints = [];
  page.on("console", (message) => {
    if (message.type() === "error") complaints.push(message.text());
  });
  page.on("pageerror", (error) => complaints.push(String(error)));
  return {
    name,
    complaints,
    open: async (url) => {
      // Firefox reports requests that a service worker answers when their page is left. The last
      // ones start when a page is idle.
      await page.evaluate(() => new Promise((resolve) => requestIdleCallback(resolve)));
      await page.waitForNetworkIdle({ idleTime: IDLE_MS, timeout: PATIENCE_MS });
      await page.goto(url, { waitUntil: "load" });
    },
    run: (work, argument) => page.evaluate(work, argument),
    press: async (...keys) => {
      for (const key of keys) await page.keyboard.press(key);
    },
    isAlive: async () => browser.connected,
    close: () => browser.close(),
  };
}

/**
 * Runs `work`; on failure calls `close`, as a process left running would keep the tests from
 * ending.
 */
async function orClose(work, close) {
  try {
    return await work();
  } catch (problem) {
    await close();
    throw problem;
  }
}

let windows = 0;

/** Starts a virtual display with a new number, as that of the last may still be in use. */
function hiddenScreen() {
  const [display, port] = [`:${90 + (process.pid % 100) + 100 * windows}`, 4400 + (process.pid % 1000) + 1000 * windows];
  windows += 1;
  const size = `${WINDOW.width + 60}x${WINDOW.height + 160}x24`;
  const screen = spawn("Xvfb", [display, "-screen", "0", size, "-nolisten", "tcp"], { stdio: "ignore" });
  return { display, port, close: () => void screen.kill() };
}

/** WebKit. Its driver does not report the console, so pages report their own errors. */
export async function webkit() {
  const window = process.env.MINI_BROWSER ?? MINI_BROWSERS.find((path) => existsSync(path));
  if (!window) throw new Error("WebKit is missing: install webkit2gtk-driver and its MiniBrowser");
  const { display, port, close } = hiddenScreen();
  const env = {
    ...process.env,
    DISPLAY: display,
    GDK_BACKEND: "x11",
    WEBKIT_DISABLE_DMABUF_RENDERER: "1",
    // Disable OMG, the last WebAssembly compiler: with it, WebKitGTK 2.50 crashed under load in
    // varying figures and once gave different bits; without it, that happened in one run of three.
    JSC_useOMGJIT: process.env.JSC_useOMGJIT ?? "0",
    // Compile synchronously: concurrent compilation gave different bits in 5 of 9 runs, else in 0
    // of 6.
    JSC_useConcurrentJIT: process.env.JSC_useConcurrentJIT ?? "0",
  };
  const driver = spawn("WebKitWebDriver", [`--port=${port}`], { stdio: "ignore", env });
  const end = () => {
    driver.kill();
    close();
  };
  const server = `http://127.0.0.1:${port}`;
  const wanted = new Capabilities({ browserName: Browser.MINIBROWSER ?? "MiniBrowser" });
  wanted.set("webkitgtk:browserOptions", { binary: window, args: ["--automation"] });
  const session = await orClose(async () => {
    await answers(`${server}/status`);
    return new Builder().usingServer(server).withCapabilities(wanted).build();
  }, end);
  await session.manage().setTimeouts({ script: PATIENCE_MS, pageLoad: 120_000 });
  await session.manage().window().setRect({ x: 0, y: 0, width: WINDOW.width, height: WINDOW.height + 90 });
  const complaints = [];
  return {
    name: "WebKit",
    complaints,
    open: async (url) => {
      await session.get(url);
      await session.executeScript(
        "addEventListener('error', (event) => (window.complaints ??= []).push(String(event.message)));" +
          "addEventListener('unhandledrejection', (event) => (window.complaints ??= []).push(String(event.reason)));",
      );
    },
    run: async (work, argument) => {
      // As JSON, since its driver fails on some values.
      const said = await session.executeAsyncScript(
        `const done = arguments[arguments.length - 1];
         const tell = (said) => done(JSON.stringify({ ...said, heard: (window.complaints ?? []).splice(0) }));
         Promise.resolve((${work})(arguments[0])).then((value) => tell({ value }), (error) => tell({ problem: String(error) }));`,
        argument,
      );
      const { value, problem, heard } = JSON.parse(said);
      complaints.push(...heard);
      if (problem) throw new Error(problem);
      return value;
    },
    press: async (...keys) => {
      const named = { ArrowLeft: Key.ARROW_LEFT, ArrowRight: Key.ARROW_RIGHT, ArrowDown: Key.ARROW_DOWN };
      const actions = session.actions();
      for (const key of keys) actions.sendKeys(named[key]);
      await actions.perform();
    },
    isAlive: () => session.executeScript("return true").catch(() => false),
    close: async () => {
      // A hanging session ends with its driver.
      const late = new Promise((resolve) => setTimeout(resolve, GRACE_MS).unref());
      await Promise.race([session.quit().catch(() => {}), late]);
      end();
    },
  };
}

/** Waits until the address responds. */
async function answers(url) {
  for (let attempt = 0; attempt < 600; attempt += 1) {
    const heard = await fetch(url).catch(() => undefined);
    if (heard?.ok) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error(`nobody answers at ${url}: is WebKitWebDriver installed?`);
}
