/** Size of the picture: observes the room for it, and resizes it to fit. */

import { WIDTHS } from "./room.js";
import type { Renderer } from "./renderer.js";
import type { Shell } from "./shell.js";

/** Parts to observe and to resize. */
export interface Measured {
  shell: Shell;
  renderer: Renderer | undefined;
  /** Poster, in place of the picture. */
  standing: Element | undefined;
}

export class SizeObserver {
  readonly #host: HTMLElement & { readonly compact: boolean };
  readonly #now: () => Measured;
  #observer: ResizeObserver | undefined;
  /** Widths of the room for the picture and of the picture, CSS pixels. */
  #room = 0;
  #shown = 0;
  /** Layout width in a compact figure. */
  #fitted: number | undefined;

  /** Creates an observer; `now` returns the current parts of the element. */
  constructor(host: HTMLElement & { readonly compact: boolean }, now: () => Measured) {
    this.#host = host;
    this.#now = now;
  }

  /** Room for the picture, CSS pixels. */
  get room(): number {
    return this.#room;
  }

  /** Starts observing. */
  start(): void {
    // Sizes are taken from the observer, because reading them would force a layout.
    this.#observer = new ResizeObserver((entries) => this.#onResize(entries));
    this.observe();
  }

  stop(): void {
    this.#observer?.disconnect();
  }

  /** Observes the current parts. */
  observe(): void {
    const [host, { shell, standing }] = [this.#host, this.#now()];
    this.#observer?.disconnect();
    if (host.compact) this.#observer?.observe(host);
    if (standing) this.#observer?.observe(standing);
    else {
      this.#observer?.observe(shell.picture.element);
      const { sheet } = shell.picture;
      try {
        // Also fires when the pixel density changes.
        this.#observer?.observe(sheet, { box: "device-pixel-content-box" });
      } catch {
        this.#observer?.observe(sheet);
      }
    }
  }

  /** Starts over for another figure. */
  forget(): void {
    this.#fitted = undefined;
    this.observe();
  }

  /** Determines the layout width of a compact figure, and resizes the picture. */
  fit(): void {
    const [host, { shell, renderer }] = [this.#host, this.#now()];
    const look = (width: number) => renderer?.ask((engine) => engine.snapshot(width).layout);
    const sizes = host.compact ? WIDTHS.map(look).filter((size) => size !== undefined) : [];
    this.#fitted = sizes.length > 0 && host.clientHeight > 0 ? shell.arrange(sizes) : undefined;
    this.resize();
  }

  /** Resizes the picture to the room. */
  resize(): void {
    this.#now().renderer?.resize(this.#room, this.#shown, this.#fitted);
  }

  #onResize(entries: ResizeObserverEntry[]): void {
    const [host, { shell }] = [this.#host, this.#now()];
    for (const { target, contentRect } of entries) {
      if (target === host) this.fit();
      else if (target === shell.picture.sheet) this.#shown = contentRect.width;
      else this.#room = contentRect.width;
    }
    this.resize();
  }
}
