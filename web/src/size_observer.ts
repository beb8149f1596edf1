/** How much room a figure has, and how large its picture is made for it. */

import { WIDTHS } from "./room.js";
import type { Renderer } from "./renderer.js";
import type { Shell } from "./shell.js";

/** What is measured and who is told. */
export interface Measured {
  shell: Shell;
  renderer: Renderer | undefined;
  /** The poster, while it stands for the picture. */
  standing: Element | undefined;
}

export class SizeObserver {
  readonly #host: HTMLElement & { readonly compact: boolean };
  readonly #now: () => Measured;
  #observer: ResizeObserver | undefined;
  /** Room for the picture, and how much of it the picture takes, CSS pixels. */
  #room = 0;
  #shown = 0;
  /** The width that the picture of a compact figure is laid out for. */
  #fitted: number | undefined;

  /** Of an element, whose parts are asked for when they are needed: they change. */
  constructor(host: HTMLElement & { readonly compact: boolean }, now: () => Measured) {
    this.#host = host;
    this.#now = now;
  }

  /** Room for the picture, CSS pixels. */
  get room(): number {
    return this.#room;
  }

  /** Measures from now on. */
  start(): void {
    // What observers tell is remembered: to ask would make the browser lay the page out at once.
    this.#observer = new ResizeObserver((entries) => this.#onResize(entries));
    this.observe();
  }

  stop(): void {
    this.#observer?.disconnect();
  }

  /** Looks at the parts that there are now. */
  observe(): void {
    const [host, { shell, standing }] = [this.#host, this.#now()];
    this.#observer?.disconnect();
    if (host.compact) this.#observer?.observe(host);
    if (standing) this.#observer?.observe(standing);
    else {
      this.#observer?.observe(shell.picture.element);
      const { sheet } = shell.picture;
      try {
        // Tells of another density as well.
        this.#observer?.observe(sheet, { box: "device-pixel-content-box" });
      } catch {
        this.#observer?.observe(sheet);
      }
    }
  }

  /** Another figure: nothing has been found out about its size. */
  forget(): void {
    this.#fitted = undefined;
    this.observe();
  }

  /** Finds the width to lay out a compact figure for, and has the picture made for it. */
  fit(): void {
    const [host, { shell, renderer }] = [this.#host, this.#now()];
    const look = (width: number) => renderer?.ask((engine) => engine.snapshot(width).layout);
    const sizes = host.compact ? WIDTHS.map(look).filter((size) => size !== undefined) : [];
    this.#fitted = sizes.length > 0 && host.clientHeight > 0 ? shell.arrange(sizes) : undefined;
    this.resize();
  }

  /** Has the picture made for the room that there is. */
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
