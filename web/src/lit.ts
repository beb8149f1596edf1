/** Highlight of a symbol of the text in the picture: a ring around a point, or a broad line. */

import type { PlacedSymbol, Snapshot } from "./contract.js";

const SVG = "http://www.w3.org/2000/svg";
/** Radius of the ring, CSS pixels of the layout. */
const RADIUS = 15;

export class Lit {
  readonly element = document.createElementNS(SVG, "svg");
  #name: string | undefined;
  #drawn = "";

  constructor() {
    this.element.setAttribute("class", "lit");
    this.element.setAttribute("aria-hidden", "true");
  }

  /** Highlights only the symbol with this name. Returns whether the picture shows it. */
  show(name: string | undefined, snapshot: Snapshot | undefined): boolean {
    this.#name = name;
    const found = snapshot?.symbols.filter((symbol) => symbol.name === name) ?? [];
    if (snapshot) this.#draw(found, snapshot.layout);
    return found.length > 0;
  }

  /** Updates the highlight with the picture. */
  update(snapshot: Snapshot): void {
    if (this.#name !== undefined) this.show(this.#name, snapshot);
  }

  #draw(symbols: PlacedSymbol[], { width, height }: Snapshot["layout"]): void {
    const state = JSON.stringify([symbols, width, height]);
    if (state === this.#drawn) return;
    this.#drawn = state;
    this.element.setAttribute("viewBox", `0 0 ${width} ${height}`);
    // Each shape is drawn twice: a light casing, then the color of the symbol.
    const shapes = symbols.flatMap((symbol) => ["casing", "color"].map((layer) => shape(symbol, layer)));
    this.element.replaceChildren(...shapes);
  }
}

function shape({ from, to }: PlacedSymbol, layer: string): SVGElement {
  const made = document.createElementNS(SVG, to ? "line" : "circle");
  const places = to
    ? { x1: from[0], y1: from[1], x2: to[0], y2: to[1] }
    : { cx: from[0], cy: from[1], r: RADIUS };
  for (const [key, value] of Object.entries(places)) made.setAttribute(key, String(value));
  made.setAttribute("class", layer);
  return made;
}
