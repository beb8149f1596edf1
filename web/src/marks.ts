/** Marks that a page draws over panels of the picture: points and lines in the panels' world units. */

import type { Panel, Snapshot } from "./contract.js";

const SVG = "http://www.w3.org/2000/svg";
/** Radius of a point, CSS pixels of the layout. */
const RADIUS = 5;

/** Marks of a panel. */
export interface Marks {
  /** Name of the panel. */
  panel: string;
  /** x and y of each point, consecutively. */
  points?: readonly number[];
  /** a, b and c of each line a x + b y + c = 0, consecutively. */
  lines?: readonly number[];
}

export class MarkLayer {
  readonly element = document.createElementNS(SVG, "svg");
  readonly #marks = new Map<string, Marks>();

  constructor() {
    this.element.setAttribute("class", "drawn");
    this.element.setAttribute("aria-hidden", "true");
  }

  /** Replaces the marks of a panel. Throws a RangeError that lists the panels. */
  show(marks: Marks, snapshot: Snapshot): void {
    const panels = snapshot.layout.panels.map(({ id }) => id);
    if (!panels.includes(marks.panel)) {
      throw new RangeError(`the figure has no panel ${JSON.stringify(marks.panel)}: it has ${panels.join(", ")}`);
    }
    this.#marks.set(marks.panel, marks);
    this.update(snapshot);
  }

  /** Removes all marks. */
  clear(): void {
    this.#marks.clear();
    this.element.replaceChildren();
  }

  /** Updates the marks with the layout. */
  update({ layout }: Snapshot): void {
    if (this.#marks.size === 0) return;
    this.element.setAttribute("viewBox", `0 0 ${layout.width} ${layout.height}`);
    const parts = layout.panels.map((panel) => {
      const marks = this.#marks.get(panel.id);
      return marks ? pathOf(panel, marks) : "";
    });
    // Each mark is drawn twice: a light casing, then its color.
    const paths = ["casing", "color"].map((layer) => {
      const path = document.createElementNS(SVG, "path");
      path.setAttribute("class", layer);
      path.setAttribute("d", parts.join(""));
      return path;
    });
    this.element.replaceChildren(...paths);
  }
}

/** Returns the SVG path of marks in a panel, without those outside of it. */
export function pathOf(
  { rect, x_axis, y_axis }: Pick<Panel, "rect" | "x_axis" | "y_axis">,
  { points = [], lines = [] }: Pick<Marks, "points" | "lines">,
): string {
  const sx = rect.width / (x_axis.end - x_axis.start);
  const sy = rect.height / (y_axis.end - y_axis.start);
  const [x0, y0] = [rect.x - x_axis.start * sx, rect.y - y_axis.start * sy];
  const [right, bottom] = [rect.x + rect.width, rect.y + rect.height];
  const path: string[] = [];
  const word = (value: number) => value.toFixed(2);
  for (let index = 0; index + 2 < lines.length; index += 3) {
    const [a = NaN, b = NaN, c = NaN] = lines.slice(index, index + 3);
    // The same line in CSS pixels.
    const ends = clipped(a / sx, b / sy, c - (a * x0) / sx - (b * y0) / sy, rect.x, rect.y, right, bottom);
    const [from, to] = ends;
    if (from && to) path.push(`M${from.map(word).join(" ")}L${to.map(word).join(" ")}`);
  }
  for (let index = 0; index + 1 < points.length; index += 2) {
    const [x, y] = [x0 + (points[index] ?? NaN) * sx, y0 + (points[index + 1] ?? NaN) * sy];
    if (!(x >= rect.x && x <= right && y >= rect.y && y <= bottom)) continue;
    const arc = `a${RADIUS} ${RADIUS} 0 1 0`;
    path.push(`M${word(x - RADIUS)} ${word(y)}${arc} ${2 * RADIUS} 0${arc} ${-2 * RADIUS} 0`);
  }
  return path.join("");
}

type Place = [x: number, y: number];

/** Returns the intersections of a line with the edges of a rectangle: two, or none. */
function clipped(a: number, b: number, c: number, left: number, top: number, right: number, bottom: number): Place[] {
  const found: Place[] = [];
  for (const x of [left, right]) {
    const y = -(a * x + c) / b;
    if (y >= top && y <= bottom) found.push([x, y]);
  }
  for (const y of [top, bottom]) {
    const x = -(b * y + c) / a;
    if (x > left && x < right) found.push([x, y]);
  }
  return found.length < 2 ? [] : found.slice(0, 2);
}
