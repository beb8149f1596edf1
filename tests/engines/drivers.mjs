// Three engines behind one small interface: `open(url)`, `run(function, argument)`, `press(...keys)`,
// `isAlive()`, `complaints` and `close()`.
//
// Firefox speaks WebDriver BiDi, so no further program is needed; WebKit has its own driver, which opens a
// window, so it gets a display that nobody sees.

import puppeteer from "puppeteer-core";
import { Browser, Builder, Capabilities, Key } from "selenium-webdriver";
import { spawn } from "node:child_process";
import { existsSync } from "node:fs";
import { launchOptions } from "../browser/chromium.mjs";

/** Wide enough for the layout of a laptop. */
export const WINDOW = { width: 1280, height: 900 };

/** Nothing that a test asks of an engine takes longer, also on a busy machine; what does never ends. */
const PATIENCE_MS = 240_000;
/** How long an engine may take to end once it is asked to. */
const GRACE_MS = 10_000;

const FIREFOX = ["/usr/bin/firefox-esr", "/usr/bin/firefox", "/Applications/Firefox.app/Contents/MacOS/firefox"];
const MINI_BROWSERS = ["x86_64-linux-gnu", "aarch64-linux-gnu"].flatMap((machine) =>
  ["4.1", "4.0"].map((version) => `/usr/lib/${machine}/webkit2gtk-${version}/MiniBrowser`),
);

// WebGL on the processor, for the Lab: there may be no graphics card.
const args = [...launchOptions.args, "--use-angle=swiftshader", "--enable-unsafe-swiftshader"];
const extraPrefsFirefox = { "webgl.force-enabled": true, "webgl.disable-fail-if-major-performance-caveat": true };

export const chromium = () => byPuppeteer("Chromium", { ...launchOptions, args, browser: "chrome", headless: true });

export const firefox = () => openFirefox({ headless: true });

/** In a window, on a display that nobody sees: without one it gives no page WebGL. */
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
    open: (url) => page.goto(url, { waitUntil: "load" }),
    run: (work, argument) => page.evaluate(work, argument),
    press: async (...keys) => {
      for (const key of keys) await page.keyboard.press(key);
    },
    isAlive: async () => browser.connected,
    close: () => browser.close(),
  };
}

/** Does what opening takes; what has been started is ended where that fails, or it would keep the tests from ending. */
async function orClose(work, close) {
  try {
    return await work();
  } catch (problem) {
    await close();
    throw problem;
  }
}

let windows = 0;

/** A display that nobody sees, with a number of its own: what a window before has used may not be free yet. */
function hiddenScreen() {
  const [display, port] = [`:${90 + (process.pid % 100) + 100 * windows}`, 4400 + (process.pid % 1000) + 1000 * windows];
  windows += 1;
  const size = `${WINDOW.width + 60}x${WINDOW.height + 160}x24`;
  const screen = spawn("Xvfb", [display, "-screen", "0", size, "-nolisten", "tcp"], { stdio: "ignore" });
  return { display, port, close: () => void screen.kill() };
}

/** Its driver tells nothing of the console, so pages report their own errors. */
export async function webkit() {
  const window = process.env.MINI_BROWSER ?? MINI_BROWSERS.find((path) => existsSync(path));
  if (!window) throw new Error("WebKit is missing: install webkit2gtk-driver and its MiniBrowser");
  const { display, port, close } = hiddenScreen();
  const env = {
    ...process.env,
    DISPLAY: display,
    GDK_BACKEND: "x11",
    WEBKIT_DISABLE_DMABUF_RENDERER: "1",
    // With the last of its compilers for WebAssembly, WebKitGTK 2.50 was seen to crash under load, each time in another
    // figure, and once to give other bits; without it, that was seen in one run of three.
    JSC_useOMGJIT: process.env.JSC_useOMGJIT ?? "0",
    // Nor beside the code that runs: so compiled, other bits were seen in five runs of nine, and in none of six without.
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
      // As text: its driver stumbles over some values.
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
      // A session that hangs ends with its driver.
      const late = new Promise((resolve) => setTimeout(resolve, GRACE_MS).unref());
      await Promise.race([session.quit().catch(() => {}), late]);
      end();
    },
  };
}

/** Waits until somebody listens there. */
async function answers(url) {
  for (let attempt = 0; attempt < 600; attempt += 1) {
    const heard = await fetch(url).catch(() => undefined);
    if (heard?.ok) return;
    await new Promise((resolve) => setTimeout(resolve, 100));
  }
  throw new Error(`nobody answers at ${url}: is WebKitWebDriver installed?`);
}
