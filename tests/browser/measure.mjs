// Costs of a page: processor time of its tasks, and memory held after garbage collection.

/** Fraction of tasks that may exceed the reported quantile. */
const FEW = 0.01;

/** Makes the module's memory accessible as `window.memory`; call it before opening the page. */
export function keepMemory(page) {
  return page.addInitScript(() => {
    const real = WebAssembly.instantiate;
    WebAssembly.instantiate = async (...args) => {
      const made = await real(...args);
      window.memory = (made.instance ?? made).exports.memory;
      return made;
    };
  });
}

/** Listeners, nodes, and bytes of scripts and module held after garbage collection. */
export async function holds(page) {
  const devtools = await page.context().newCDPSession(page);
  await devtools.send("Performance.enable");
  for (let round = 0; round < 3; round += 1) await devtools.send("HeapProfiler.collectGarbage");
  const { metrics } = await devtools.send("Performance.getMetrics");
  await devtools.detach();
  const of = (name) => metrics.find((metric) => metric.name === name).value;
  const wasm = await page.evaluate(() => window.memory?.buffer.byteLength ?? 0);
  return { listeners: of("JSEventListeners"), nodes: of("Nodes"), heap: of("JSHeapUsedSize"), wasm };
}

/**
 * Traces the tasks of a page's main thread. `end()` returns their processor times in milliseconds,
 * which do not depend on the load.
 */
export async function tasksOf(browser, page) {
  await browser.startTracing(page, { categories: ["toplevel"] });
  return {
    end: async () => {
      const { traceEvents } = JSON.parse(String(await browser.stopTracing()));
      const mains = traceEvents.filter(({ name, args }) => name === "thread_name" && args.name === "CrRendererMain");
      const main = new Set(mains.map(({ pid, tid }) => `${pid} ${tid}`));
      const tasks = traceEvents.filter(({ name, ph, pid, tid }) => ph === "X" && /RunTask$/.test(name) && main.has(`${pid} ${tid}`));
      const times = tasks.map(({ tdur = 0 }) => tdur / 1000).sort((a, b) => b - a);
      if (times.length === 0) throw new Error("no task was seen");
      return { count: times.length, longest: times[0], p99: times[Math.floor(FEW * times.length)] };
    },
  };
}
