/**
 * The worker's side: what a reader's code can call besides the package. The code's module imports this script first.
 *
 * Output is collected and sent in pieces, so that an endless loop neither floods the page nor hides what it printed.
 */

import { inspect } from "./inspect.js";
import type { Axes, Fault, FigureFacts, FromWorker, Item, Marks, Photograph, Picture, Question, Reply, Series, ToWorker } from "./messages.js";

/** Limits of the output of a run. */
const MOST_ITEMS = 1000;
const MOST_CHARACTERS = 4000;
const MOST_SIDE_PX = 4096;
/** Time between two pieces of output, milliseconds. */
const PIECE_MS = 50;

const post = (message: FromWorker) => self.postMessage(message);
let items: Item[] = [];
let count = 0;
let sent = 0;
let timer: ReturnType<typeof setTimeout> | undefined;

function flush(): void {
  clearTimeout(timer);
  timer = undefined;
  sent = performance.now();
  if (items.length > 0) post({ type: "items", items });
  items = [];
}

function put(item: Item): void {
  count += 1;
  if (count > MOST_ITEMS) return;
  items.push(item);
  if (count === MOST_ITEMS) {
    items.push({ type: "text", text: `(more than ${MOST_ITEMS} lines: the rest is left out)`, isProblem: true });
    flush();
  } else if (performance.now() - sent > PIECE_MS) flush();
  else timer ??= setTimeout(flush, PIECE_MS);
}

const printer = (isProblem: boolean) => (...values: unknown[]) => {
  const text = values.map(inspect).join(" ");
  const isLong = text.length > MOST_CHARACTERS;
  put({ type: "text", text: isLong ? `${text.slice(0, MOST_CHARACTERS)} …` : text, isProblem });
};

function table(rows: unknown): void {
  if (typeof rows !== "object" || rows === null) return printer(false)(rows);
  const records = Array.from(Object.entries(rows)).slice(0, MOST_ITEMS);
  const cells = (row: unknown): Record<string, unknown> =>
    typeof row === "object" && row !== null ? { ...row } : { value: row };
  const columns = [...new Set(records.flatMap(([, row]) => Object.keys(cells(row))))];
  const shown = records.map(([name, row]) => {
    const own = cells(row);
    return [name, ...columns.map((column) => (column in own ? inspect(own[column]) : ""))];
  });
  put({ type: "table", columns: ["(index)", ...columns], rows: shown });
}

/** Numbers of an array, of pairs, or of a typed array, one after the other. */
function numbers(name: string, value: unknown): number[] {
  const isList = Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
  if (!isList) throw new TypeError(`${name} must be an array of numbers, but is ${inspect(value)}`);
  const flat = Array.from(value as ArrayLike<unknown>).flatMap((part) =>
    typeof part === "number" ? [part] : numbers(name, part),
  );
  return flat;
}

function groups(name: string, value: unknown, size: number): number[] {
  const flat = value === undefined ? [] : numbers(name, value);
  if (flat.length % size !== 0) {
    throw new TypeError(`${name} must be ${size} numbers each, but there are ${flat.length} in all`);
  }
  return flat;
}

/** Bytes as they are; other numbers from 0, or the smallest below it, to the largest. NaN is black. */
function toBytes(data: ArrayLike<number>): ArrayLike<number> {
  if (data instanceof Uint8Array || data instanceof Uint8ClampedArray) return data;
  const finite = Array.from(data).filter(Number.isFinite);
  const low = finite.reduce((least, value) => Math.min(least, value), 0);
  const high = finite.reduce((most, value) => Math.max(most, value), low);
  const scale = high > low ? 255 / (high - low) : 0;
  return Uint8ClampedArray.from(data, (value) => (Number.isFinite(value) ? (value - low) * scale : 0));
}

function show(image: unknown, options: { title?: string; points?: unknown; lines?: unknown } = {}): void {
  const { width, height, data } = (image ?? {}) as { width?: number; height?: number; data?: ArrayLike<number> };
  const isSize = (side: unknown): side is number => Number.isInteger(side) && (side as number) > 0;
  if (!isSize(width) || !isSize(height) || !data) {
    throw new TypeError(`show wants an image: an object with width, height and data, not ${inspect(image)}`);
  }
  if (Math.max(width, height) > MOST_SIDE_PX) {
    throw new RangeError(`show takes images of at most ${MOST_SIDE_PX} pixels a side, not ${width}×${height}`);
  }
  const channels = data.length / (width * height);
  if (channels !== 1 && channels !== 3 && channels !== 4) {
    throw new TypeError(`${data.length} numbers are not 1, 3 or 4 a pixel of ${width}×${height}`);
  }
  const bytes = toBytes(data);
  const rgba = new Uint8ClampedArray(4 * width * height);
  for (let pixel = 0; pixel < width * height; pixel++) {
    for (let channel = 0; channel < 4; channel++) {
      const from = channels === 1 ? pixel : channels * pixel + channel;
      rgba[4 * pixel + channel] = channel === 3 && channels < 4 ? 255 : (bytes[from] ?? 0);
    }
  }
  const [points, lines] = [groups("points", options.points, 2), groups("lines", options.lines, 3)];
  const picture: Picture = { width, height, rgba, title: String(options.title ?? ""), points, lines };
  put({ type: "picture", picture });
}

interface PlotOptions {
  title?: string;
  label?: string;
  xLabel?: string;
  yLabel?: string;
  dots?: boolean;
}

function plot(x: unknown, y?: unknown, options: PlotOptions = {}): void {
  const values = numbers(y === undefined ? "plot's numbers" : "y", y ?? x);
  const places = y === undefined ? values.map((_, index) => index) : numbers("x", x);
  if (places.length !== values.length) {
    throw new RangeError(`plot wants as many x as y, not ${places.length} and ${values.length}`);
  }
  const series: Series = { x: places, y: values, label: String(options.label ?? ""), dots: options.dots === true };
  const axes: Axes = {
    title: String(options.title ?? ""),
    x: String(options.xLabel ?? ""),
    y: String(options.yLabel ?? ""),
  };
  put({ type: "plot", series, axes });
}

const waiting = new Map<number, { resolve(reply: Reply): void; reject(why: string): void }>();

let asked = 0;

function ask(question: Question): Promise<Reply> {
  flush();
  // Made here, where the stack still leads to the code.
  const refusal = new Error();
  return new Promise((resolve, reject) => {
    const id = ++asked;
    waiting.set(id, { resolve, reject: (why) => reject(Object.assign(refusal, { message: why })) });
    post({ type: "ask", id, question });
  });
}

/** A figure of the page. */
class Figure {
  readonly #name: string;
  #facts: FigureFacts;

  constructor(name: string, facts: FigureFacts) {
    this.#name = name;
    this.#facts = facts;
  }

  /** Parameters that differ from the figure's defaults. */
  get state(): Record<string, string> {
    return this.#facts.state;
  }

  /** Numbers and words that it shows. */
  get readouts(): Record<string, number | string> {
    return this.#facts.readouts;
  }

  /** Its matches, matrices and cameras. */
  get data(): Record<string, unknown> {
    return this.#facts.data;
  }

  /** Moves sliders and points. */
  async set(parameters: Record<string, string | number | boolean>): Promise<this> {
    const entries = Object.entries(parameters).map(([key, value]) => [key, String(value)]);
    return this.#learn({ figure: this.#name, ask: "set", parameters: Object.fromEntries(entries) });
  }

  /** Draws points (x, y) and lines (a, b, c) over a panel, in place of earlier ones. */
  async draw({ panel, points, lines }: { panel?: string; points?: unknown; lines?: unknown } = {}): Promise<this> {
    const marks: Marks = {
      panel: String(panel ?? this.#facts.panels[0] ?? ""),
      points: groups("points", points, 2),
      lines: groups("lines", lines, 3),
    };
    return this.#learn({ figure: this.#name, ask: "draw", marks });
  }

  /** Removes what was drawn. */
  async clear(): Promise<this> {
    return this.#learn({ figure: this.#name, ask: "clear" });
  }

  /** The photograph that a panel shows. */
  async photograph(panel?: string): Promise<Photograph> {
    const wanted = String(panel ?? this.#facts.panels[0] ?? "");
    return (await ask({ figure: this.#name, ask: "photograph", panel: wanted })) as Photograph;
  }

  async #learn(question: Question): Promise<this> {
    this.#facts = (await ask(question)) as FigureFacts;
    return this;
  }
}

let figures: Record<string, FigureFacts> = {};

function figure(name: unknown): Figure {
  const facts = figures[String(name)];
  if (facts !== undefined) return new Figure(String(name), facts);
  const known = Object.keys(figures);
  const those = known.length > 0 ? `this code can use ${known.join(", ")}` : "write the name of a figure of this page";
  throw new RangeError(`there is no figure "${String(name)}" here: ${those}`);
}

/** Called before the first line of the code. */
export function begin(facts: Record<string, FigureFacts>): void {
  figures = facts;
}

/** Called behind the last line of the code. */
export function finish(...verdict: unknown[]): void {
  flush();
  if (verdict.length > 0) post({ type: "verdict", text: String(verdict[0]) });
  post({ type: "done" });
}

/** The place in the code: the first frame of the stack that is in its module. */
function faultOf(problem: unknown): Fault {
  const { name = "Error", message, stack = "" } = problem instanceof Error ? problem : { message: inspect(problem) };
  const at = stack.split(location.href)[1]?.match(/^:(\d+):(\d+)/);
  return { name, message, line: at ? Number(at[1]) : undefined, column: at ? Number(at[2]) : undefined };
}

function fail(problem: unknown): void {
  flush();
  post({ type: "fault", fault: faultOf(problem) });
}

self.addEventListener("message", ({ data }: MessageEvent<ToWorker>) => {
  const question = waiting.get(data.id);
  waiting.delete(data.id);
  if ("reply" in data) question?.resolve(data.reply);
  else question?.reject(data.problem);
});
self.addEventListener("error", (event) => {
  event.preventDefault();
  const { error, message, lineno: line, colno: column } = event;
  if (error instanceof Error) fail(error);
  else {
    flush();
    post({ type: "fault", fault: { name: "Error", message, line, column } });
  }
});
self.addEventListener("unhandledrejection", (event) => {
  event.preventDefault();
  fail(event.reason);
});

const print = printer(false);
Object.assign(console, { log: print, info: print, debug: print, table, warn: printer(true), error: printer(true) });
console.assert = (holds?: unknown, ...words: unknown[]) => {
  if (!holds) printer(true)("Assertion failed", ...words);
};
Object.assign(self, { show, plot, figure });
// A reader's code leaves alone what the book and the Lab keep in this browser.
for (const name of ["indexedDB", "caches", "BroadcastChannel", "Worker", "importScripts"]) {
  Object.defineProperty(self, name, { value: undefined });
}
Object.defineProperty(navigator, "storage", { value: undefined });
Object.defineProperty(navigator, "locks", { value: undefined });
