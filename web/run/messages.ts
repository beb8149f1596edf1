/** Messages between the page and the worker that runs a reader's code. */

/** A line of a plot. */
export interface Series {
  x: readonly number[];
  y: readonly number[];
  label: string;
  /** Whether to draw points without a line. */
  dots: boolean;
}

/** Labels of a plot. */
export interface Axes {
  title: string;
  x: string;
  y: string;
}

/** An image with marks, in its pixels. */
export interface Picture {
  width: number;
  height: number;
  /** Rows of red, green, blue, alpha. */
  rgba: Uint8ClampedArray<ArrayBuffer>;
  title: string;
  /** u and v of each point. */
  points: readonly number[];
  /** a, b and c of each line a u + b v + c = 0. */
  lines: readonly number[];
}

/** An error, and the position in the code where it was thrown, counted from 1. */
export interface Fault {
  name: string;
  message: string;
  line?: number | undefined;
  column?: number | undefined;
}

/** An item of output, in order. */
export type Item =
  | { type: "text"; text: string; isProblem: boolean }
  | { type: "table"; columns: readonly string[]; rows: readonly (readonly string[])[] }
  | { type: "picture"; picture: Picture }
  | { type: "plot"; series: Series; axes: Axes };

/** Message from the worker. */
export type FromWorker =
  | { type: "items"; items: readonly Item[] }
  | { type: "ask"; id: number; question: Question }
  | { type: "fault"; fault: Fault }
  | { type: "verdict"; text: string }
  | { type: "done" };

/** A request about a figure of the page. */
export type Question = { figure: string } & (
  | { ask: "set"; parameters: Record<string, string> }
  | { ask: "draw"; marks: Marks }
  | { ask: "clear" }
  | { ask: "photograph"; panel: string }
);

/** A photograph: rows of red, green, blue. */
export interface Photograph {
  width: number;
  height: number;
  data: Uint8Array;
}

/** Answer to a request: a photograph, or the facts of the figure after it. */
export type Reply = Photograph | FigureFacts;

/** Marks in a panel of a figure, in its world units. */
export interface Marks {
  panel: string;
  points: readonly number[];
  lines: readonly number[];
}

/** A figure as seen by code. */
export interface FigureFacts {
  state: Record<string, string>;
  readouts: Record<string, number | string>;
  panels: readonly string[];
  data: Record<string, unknown>;
}

/** Message to the worker: the answer to a request. */
export type ToWorker = { id: number; reply: Reply } | { id: number; problem: string };
