/** Interface between a figure and its element and page. */

import type { Host } from "./properties.js";
import { watchDensity, watchTheme } from "./theme.js";
import { watchVisibility } from "./visibility.js";

/** The element, as needed by its controller. */
export interface FigureHost extends Host {
  readonly compact: boolean;
  readonly state: Record<string, string>;
  readonly readouts: Record<string, number | string>;
  readonly permalink: string;
  reset: () => void;
}

export interface HostCallbacks {
  attributes: (records: MutationRecord[]) => void;
  /** Called when colors or pixel density may have changed. */
  recolor: () => void;
  print: () => void;
  /** Called when the element comes within one screen of the viewport, or leaves that range. */
  near: (near: boolean) => void;
  /** Called when the element enters or leaves the viewport. */
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
  /** Called when pointer or focus enters the figure. */
  interest: () => void;
  /** Called when the figure is operated; `byReader` unless by a script, or by a key without an effect of its own. */
  takeOver: (byReader: boolean) => void;
}

/** Listens to the reader's input before the figure's own parts do. */
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
