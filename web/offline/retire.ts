// Service worker of a book under construction: replaces that of a published one at the same address, removes it with
// its caches, and reloads the open pages.

const worker = self as unknown as ServiceWorkerGlobalScope;

worker.addEventListener("install", (event) => event.waitUntil(worker.skipWaiting()));
worker.addEventListener("activate", (event) => event.waitUntil(retire()));

async function retire(): Promise<void> {
  const { scope } = worker.registration;
  const ours = (await caches.keys()).filter((name) => name.startsWith(`epipole-book ${scope} `));
  await Promise.all(ours.map((name) => caches.delete(name)));
  await worker.clients.claim();
  await worker.registration.unregister();
  const pages = await worker.clients.matchAll({ type: "window" });
  await Promise.all(pages.map((page) => page.navigate(page.url)));
}

export {};
