/** Output of a run below its code: lines, tables, pictures, plots, errors. */

import { pathOf } from "../src/marks.js";
import type { Fault, Item, Picture } from "./messages.js";

/** Maximum width to which a small image is enlarged, CSS pixels, and maximum factor. */
const WIDE_PX = 320;
const MOST_TIMES = 8;

export class Output {
  readonly #box: HTMLElement;
  #lines: HTMLElement | undefined;

  constructor(box: HTMLElement) {
    this.#box = box;
  }

  clear(): void {
    this.#box.replaceChildren();
    this.#lines = undefined;
  }

  add(items: readonly Item[]): void {
    for (const item of items) {
      if (item.type === "text") this.#addText(item.text, item.isProblem);
      else if (item.type === "table") this.#addBlock(tableOf(item));
      else if (item.type === "picture") this.#addBlock(pictureOf(item.picture));
      else {
        const place = document.createElement("div");
        place.className = "run-plot";
        this.#addBlock(place);
        void import("./plot.js").then(({ drawPlot }) => drawPlot(place, item.series, item.axes));
      }
    }
  }

  /** Shows an error; `goTo` is called by the button that names its line. */
  fail({ name, message, line, column }: Fault, goTo: (line: number, column?: number) => void): void {
    const text = document.createElement("p");
    text.className = "run-fault";
    text.setAttribute("role", "alert");
    const kind = document.createElement("strong");
    kind.textContent = name;
    text.append(kind);
    if (line !== undefined) {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = `line ${line}`;
      button.addEventListener("click", () => goTo(line, column));
      text.append(" in ", button);
    }
    text.append(`: ${message}`);
    this.#addBlock(text);
  }

  /** Shows the verdict of a check. */
  judge(verdict: string, isRight: boolean): void {
    const text = document.createElement("p");
    text.className = "run-verdict";
    text.dataset.state = isRight ? "right" : "wrong";
    text.textContent = verdict;
    this.#addBlock(text);
  }

  #addText(text: string, isProblem: boolean): void {
    if (!this.#lines) {
      const pre = document.createElement("pre");
      pre.tabIndex = 0;
      this.#lines = pre.appendChild(document.createElement("samp"));
      this.#box.append(pre);
    }
    const line = document.createElement("span");
    line.textContent = `${text}\n`;
    if (isProblem) line.className = "run-problem";
    this.#lines.append(line);
  }

  #addBlock(block: HTMLElement): void {
    this.#lines = undefined;
    this.#box.append(block);
  }
}

function tableOf({ columns, rows }: Extract<Item, { type: "table" }>): HTMLElement {
  const table = document.createElement("table");
  const head = table.createTHead().insertRow();
  for (const column of columns) {
    const cell = document.createElement("th");
    cell.scope = "col";
    cell.textContent = column;
    head.append(cell);
  }
  const body = table.createTBody();
  for (const row of rows) {
    const line = body.insertRow();
    for (const text of row) line.insertCell().textContent = text;
  }
  const box = document.createElement("div");
  box.className = "table";
  box.tabIndex = 0;
  box.append(table);
  return box;
}

/** Creates an image with its marks; small ones are enlarged by an integer, so that pixels stay square. */
function pictureOf({ width, height, rgba, title, points, lines }: Picture): HTMLElement {
  const times = Math.max(1, Math.min(MOST_TIMES, Math.floor(WIDE_PX / width)));
  const canvas = document.createElement("canvas");
  [canvas.width, canvas.height] = [width * times, height * times];
  canvas.className = "run-picture";
  canvas.setAttribute("role", "img");
  canvas.setAttribute("aria-label", `${title || "Picture"}, ${width}×${height} pixels`);
  const context = canvas.getContext("2d");
  if (context) {
    const plain = new OffscreenCanvas(width, height);
    plain.getContext("2d")?.putImageData(new ImageData(rgba, width, height), 0, 0);
    context.imageSmoothingEnabled = false;
    context.drawImage(plain, 0, 0, canvas.width, canvas.height);
    // Pixel centers are at integers.
    const path = new Path2D(
      pathOf(
        {
          rect: { x: 0, y: 0, width: canvas.width, height: canvas.height },
          x_axis: { start: -0.5, end: width - 0.5 },
          y_axis: { start: -0.5, end: height - 0.5 },
        },
        { points, lines },
      ),
    );
    // A light casing below the color, to stand out on any image.
    for (const [color, thickness] of [["#ffffff", 3.5], ["#c34d00", 1.75]] as const) {
      context.strokeStyle = color;
      context.lineWidth = thickness;
      context.stroke(path);
    }
  }
  const figure = document.createElement("div");
  figure.className = "run-image";
  figure.append(canvas);
  if (title) {
    const words = document.createElement("p");
    words.textContent = title;
    figure.append(words);
  }
  return figure;
}
