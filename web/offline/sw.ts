// Service worker of the published book. It caches one edition for reading without a network. While that is incomplete,
// pages come from the server, to match the files there.

import { fill, forgetOthers, isComplete, isHashed, store, cached, cachedAlternative, variantBefore } from "./edition";
import { COMPLETE, TAKE_OVER, type CacheRequest } from "./protocol";

const worker = self as unknown as ServiceWorkerGlobalScope;

/** Parts of the site that are not cached: frames for other sites, manuals, notebooks, slides. */
const ELSEWHERE = /^(embed|python|js|notebooks|slides|licenses)\/|\.(br|gz)$/;

worker.addEventListener("install", (event) => event.waitUntil(install()));
worker.addEventListener("activate", (event) => event.waitUntil(activate()));

/** Waits for the reader only if a complete older edition is in use, until this one is also complete. */
async function install(): Promise<void> {
  try {
    const variant = await variantBefore();
    if (variant) return await fill({ page: undefined, all: true, variant });
  } catch (error) {
    // Without a network the older edition stays. Otherwise it must not stay forever.
    if (!(error instanceof DOMException)) throw error;
    await forgetOthers().catch(() => undefined);
  }
  await worker.skipWaiting();
}

async function activate(): Promise<void> {
  await forgetOthers().catch(() => undefined);
  await worker.clients.claim();
}

worker.addEventListener("message", (event) => {
  if (event.data === TAKE_OVER) event.waitUntil(worker.skipWaiting());
  else event.waitUntil(answer(event.data as CacheRequest, event.source));
});

/** Pending work: two pages must not download the same files concurrently. */
let busy = Promise.resolve();

async function answer(request: CacheRequest, source: ExtendableMessageEvent["source"]): Promise<void> {
  busy = busy.then(async () => {
    try {
      await fill(request);
      if (await isComplete()) source?.postMessage(COMPLETE);
    } catch {
      // No network or no space: the next page tries again.
    }
  });
  await busy;
}

worker.addEventListener("fetch", (event) => {
  const { request } = event;
  const { scope } = worker.registration;
  const address = request.url.replace(/[?#].*$/, "");
  if (request.method !== "GET" || !address.startsWith(scope)) return;
  const path = address.slice(scope.length).replace(/(^|\/)$/, "$1index.html");
  if (!ELSEWHERE.test(path)) event.respondWith(respond(event, path));
});

/** Responds to a request. Never fails if the network alone would not. */
async function respond(event: FetchEvent, path: string): Promise<Response> {
  const isOfLab = path.startsWith("lab/");
  let held: Response | undefined;
  let first = isHashed(path);
  try {
    held = (await cached(path)) ?? (/\.\w+$/.test(path) ? undefined : await cached(`${path}.html`));
    if (held && !first && !isOfLab) first = await isComplete();
  } catch {
    // Storage is blocked.
  }
  if (held && first) return held;
  try {
    const response = await fetch(event.request);
    // The Lab is cached once it is opened.
    if (isOfLab && response.ok && !response.redirected) {
      event.waitUntil(store(path, response.clone()).catch(() => undefined));
    }
    return held && response.status >= 500 ? held : response;
  } catch (error) {
    held ??= await cachedAlternative(path).catch(() => undefined);
    if (held) return held;
    throw error;
  }
}
