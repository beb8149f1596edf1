/** The element and its page, as far as they concern the figure. */

import type { Host } from "./properties.js";
import { watchDensity, watchTheme } from "./theme.js";
import { watchVisibility } from "./visibility.js";

/** The element, as its controller needs it. */
export interface FigureHost extends Host {
  readonly compact: boolean;
  readonly state: Record<string, string>;
  readonly readouts: Record<string, number | string>;
  readonly permalink: string;
  reset: () => void;
}

export interface HostCallbacks {
  attributes: (records: MutationRecord[]) => void;
  /** Colors or the density of pixels may have changed. */
  recolor: () => void;
  print: () => void;
  /** The element is within one screen of the viewport, or no longer. */
  near: (near: boolean) => void;
  /** The element is in the viewport, or no longer. */
  seen: (visible: boolean) => void;
}

/** Observes an element. Returns a function that ends it. */
export function observeHost(host: HTMLElement, { attributes, recolor, print, near, seen }: HostCallbacks): () => void {
  const observer = new MutationObserver(attributes);
  observer.observe(host, { attributes: true });
  addEventListener("beforeprint", print);
  addEventListener("afterprint", recolor);
  const watches = [watchDensity(recolor), watchTheme(recolor), watchVisibility(host, { near, seen })];
  return () => {
    observer.disconnect();
    removeEventListener("beforeprint", print);
    removeEventListener("afterprint", recolor);
    for (const stop of watches) stop();
  };
}

export interface ReaderCallbacks {
  /** Pointer or focus has come to the figure. */
  interest: () => void;
  /** Something is done to the figure; `byReader` if no script did it, nor a key that does nothing by itself. */
  takeOver: (byReader: boolean) => void;
}

/** Listens to what a reader does to the figure, before its own parts do. */
export function listenToReader(host: HTMLElement, shadow: ShadowRoot, { interest, takeOver }: ReaderCallbacks): void {
  for (const type of ["pointerdown", "keydown", "input"]) {
    shadow.addEventListener(type, (event) => takeOver(event.isTrusted && !isModifier(event)), { capture: true });
  }
  for (const type of ["pointerenter", "touchstart", "focusin"]) {
    host.addEventListener(type, interest, { passive: true, capture: true });
  }
}

/** Whether an event is of Tab or a modifier key. */
function isModifier(event: Event): boolean {
  return event instanceof KeyboardEvent && /^(Shift|Control|Alt|Meta|Tab)$/.test(event.key);
}
