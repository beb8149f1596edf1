/** The canvas and the elements over it. */

import type { Direction, Snapshot } from "./contract.js";
import { make, setAttribute } from "./dom.js";
import { Handles } from "./handles.js";
import { Lit } from "./lit.js";
import { MarkLayer } from "./marks.js";
import { Pointers } from "./pointers.js";
import { Zoom } from "./zoom.js";

/** Actions of a reader in the picture. Positions are CSS pixels of the layout. */
export interface Hand {
  handleAt: (x: number, y: number) => string | undefined;
  drag: (id: string, x: number, y: number) => void;
  nudge: (id: string, towards: Direction, steps: number) => void;
  moveToEnd: (id: string, towards: Direction) => void;
  remove: (id: string) => void;
  click: (x: number, y: number) => void;
  set: (id: string, value: number) => void;
}

export type Place = [x: number, y: number];

export class Picture {
  /** Room for the picture. */
  readonly element = make("div", { class: "picture" });
  /** The picture itself, which is narrower if the room is low. */
  readonly sheet = make("div", { class: "sheet" });
  /** Temporary overlay at its lower edge. */
  readonly overlay = make("div", { class: "overlay" });
  readonly canvas = make("canvas", { role: "img", hidden: true });
  readonly #lit = new Lit();
  /** Marks of the page. */
  readonly marks = new MarkLayer();
  readonly #zoom: Zoom;
  readonly #handles: Handles;
  readonly #pointers: Pointers;
  #snapshot: Snapshot | undefined;

  constructor(hand: Hand) {
    this.#zoom = new Zoom(hand);
    this.#handles = new Handles(hand, this.#zoom);
    const { chooser, marks } = this.#handles;
    this.sheet.append(make("slot"), this.canvas, this.marks.element, chooser, this.#lit.element, marks);
    this.element.append(this.sheet, this.overlay);
    const { element, sheet, overlay } = this;
    const [handles, zoom] = [this.#handles, this.#zoom];
    this.#pointers = new Pointers({ element, sheet, covers: [chooser, overlay], hand, handles, zoom });
  }

  /** Shows a snapshot around the canvas. */
  update(snapshot: Snapshot): void {
    this.#snapshot = snapshot;
    const { width, height } = snapshot.layout;
    this.sheet.style.setProperty("--ratio", String(width / height));
    setAttribute(this.canvas, "aria-label", snapshot.description);
    for (const part of [this.#zoom, this.#pointers, this.#lit, this.marks, this.#handles]) part.update(snapshot);
  }

  /** Highlights only the mark of this symbol of the book. Returns whether the picture shows it. */
  light(symbol: string | undefined): boolean {
    return this.#lit.show(symbol, this.#snapshot);
  }

  /** Returns the element of a handle. */
  elementOf(id: string): HTMLElement | undefined {
    return this.#handles.elementOf(id);
  }

  /** Shows the canvas in place of the poster. */
  reveal(): void {
    if (!this.canvas.hidden) return;
    this.canvas.hidden = false;
    const slot = this.element.querySelector("slot");
    if (slot) slot.hidden = true;
  }
}
