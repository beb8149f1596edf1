// The book without a network: registers its service worker, reports when the whole book is cached, and offers a new
// edition. Without permission, the page works as before.

import { variantOf, type Variant } from "../offline/pictures";
import { COMPLETE, TAKE_OVER, type CacheRequest } from "../offline/protocol";

/** Time for which a worker without a predecessor may take to become active, milliseconds. */
const PASSING_MS = 1000;

export async function start(manifest: string): Promise<void> {
  try {
    const root = new URL(".", manifest);
    const workers = navigator.serviceWorker;
    const isFirstVisit = workers.controller === null;
    workers.addEventListener("message", ({ data }) => data === COMPLETE && showSign());
    const registration = await workers.register(new URL("sw.js", root), { updateViaCache: "none" });
    watch(registration);
    const { active } = await workers.ready;
    const page = location.pathname.slice(root.pathname.length).replace(/(^|\/)$/, "$1index.html");
    const saves = (navigator as { connection?: { saveData?: boolean } }).connection?.saveData === true;
    const seen = variantHere();
    // A page without figures does not reveal which pictures of other pages its reader would see.
    const all = !saves && seen !== undefined;
    const variant = seen ?? { width: 360, theme: "light" };
    active?.postMessage({ page, all, variant } satisfies CacheRequest);
    // By itself, a browser checks for updates only once its worker has been idle for a while. This follows the message,
    // because a message to a terminating worker would restart it.
    if (!isFirstVisit) ask(registration);
  } catch {
    // Forbidden by the browser or its settings.
  }
}

/** Returns the variant of the pictures on this page; undefined without a figure. */
function variantHere(): Variant | undefined {
  const pictures = [...document.querySelectorAll<HTMLImageElement>("epipole-figure picture img")];
  return pictures.map(({ currentSrc }) => variantOf(currentSrc)).find(Boolean);
}

function showSign(): void {
  if (document.querySelector(".offline-sign")) return;
  const sign = document.createElement("p");
  sign.className = "offline-sign";
  sign.textContent = "Available offline";
  document.querySelector(".turn")?.append(sign);
}

/** Asks the server for a new edition. */
const ask = (registration: ServiceWorkerRegistration) => void registration.update().catch(() => undefined);

/** Offers each new edition that waits. */
function watch(registration: ServiceWorkerRegistration): void {
  const offerWaiting = () => {
    if (registration.waiting && navigator.serviceWorker.controller) offer(registration.waiting);
  };
  const follow = () =>
    registration.installing?.addEventListener("statechange", () => setTimeout(offerWaiting, PASSING_MS));
  offerWaiting();
  // The browser may have found the edition before this page listened.
  follow();
  registration.addEventListener("updatefound", follow);
  document.addEventListener("visibilitychange", () => document.hidden || ask(registration));
}

function offer(edition: ServiceWorker): void {
  document.querySelector(".edition-notice")?.remove();
  const notice = document.createElement("p");
  notice.className = "edition-notice";
  notice.setAttribute("role", "status");
  const button = (label: string, press: () => void) => {
    const made = document.createElement("button");
    made.type = "button";
    made.textContent = label;
    made.addEventListener("click", press);
    return made;
  };
  const reload = button("Reload", () => {
    navigator.serviceWorker.addEventListener("controllerchange", () => location.reload(), { once: true });
    edition.postMessage(TAKE_OVER);
  });
  notice.append("A new edition is available. ", reload, " ", button("Later", () => notice.remove()));
  document.body.append(notice);
}
