/** Visibility of figures: near the viewport, in view, and scrolling into view. */

import { wantsStillness } from "./theme.js";

/** Time limit for scrolling to a figure, milliseconds. */
const SCROLL_MS = 700;

type Seen = (near: boolean) => void;

const listeners = new WeakMap<Element, { near: Seen; seen: Seen }>();

function observer(kind: "near" | "seen", margin: string): IntersectionObserver {
  return new IntersectionObserver(
    (entries) => {
      for (const entry of entries) listeners.get(entry.target)?.[kind](entry.isIntersecting);
    },
    { rootMargin: margin },
  );
}

let near: IntersectionObserver | undefined;
let seen: IntersectionObserver | undefined;

/** Observes an element: `near` within one screen of the viewport, `seen` in the viewport. */
export function watchVisibility(element: Element, callbacks: { near: Seen; seen: Seen }): () => void {
  near ??= observer("near", "100% 0px");
  seen ??= observer("seen", "0px");
  listeners.set(element, callbacks);
  near.observe(element);
  seen.observe(element);
  return () => {
    near?.unobserve(element);
    seen?.unobserve(element);
    listeners.delete(element);
  };
}

let calm: Promise<void> | undefined;

/** Resolves when the page has loaded and the browser is idle, so that text and pictures come first. */
export function pageIsCalm(): Promise<void> {
  calm ??= new Promise((resolve) => {
    const wait = () => {
      // Safari lacks requestIdleCallback.
      if ("requestIdleCallback" in window) requestIdleCallback(() => resolve(), { timeout: 1000 });
      else setTimeout(resolve, 200);
    };
    if (document.readyState === "complete") wait();
    else addEventListener("load", wait, { once: true });
  });
  return calm;
}

let turn = Promise.resolve();

/** Resolves for one caller per frame, in a separate task. */
export function myTurn(): Promise<void> {
  turn = turn.then(() => new Promise((resolve) => requestAnimationFrame(() => setTimeout(resolve))));
  return turn;
}

/** Scrolls the whole element into view if needed, without moving focus. */
export async function bringIntoView(element: Element): Promise<void> {
  const box = element.getBoundingClientRect();
  const top = parseFloat(getComputedStyle(element).scrollMarginTop) || 0;
  if (document.hidden || box.height === 0 || (box.top >= top && box.bottom <= innerHeight)) return;
  const still = wantsStillness();
  const behavior = still ? "instant" : "smooth";
  if (parent === window) element.scrollIntoView({ block: "nearest", behavior });
  else {
    // Scrolls only the frame's own document, never the surrounding page.
    const up = box.top - top;
    scrollBy({ top: up < 0 ? up : Math.min(up, box.bottom - innerHeight), behavior });
  }
  if (still) return;
  await new Promise<void>((resolve) => {
    const done = () => {
      clearTimeout(timer);
      // Without scrolling there is no scrollend event, and each glide would leave a listener behind.
      removeEventListener("scrollend", done, true);
      resolve();
    };
    const timer = setTimeout(done, SCROLL_MS);
    addEventListener("scrollend", done, true);
  });
}
