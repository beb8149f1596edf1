/** The page's WebAssembly module, loaded for the first figure that needs it. */

import load, { Figure, figures, take_panic } from "epipole-web";
import { movedTo } from "./assets.js";
import { compile } from "./compile.js";
import type { Direction, FigureEvent, Refused, Snapshot } from "./contract.js";
import type { Parameters } from "./permalink.js";
import type { Photo } from "./photos.js";

type Loaded = { memory: WebAssembly.Memory };

/** Exports required by this script; methods of a class are prefixed with its name. */
const WANTED = [
  "figures",
  "take_panic",
  ...Object.getOwnPropertyNames(Figure.prototype)
    .filter((name) => !/^(constructor|free|__.*)$/.test(name))
    .map((name) => `figure_${name}`),
];

/** Time until loading is reported as slow, milliseconds. */
const SLOW_MS = 15_000;

/** Loads the module once for all figures of the page; the latest attempt wins. */
const loader = {
  loading: undefined as Promise<Loaded> | undefined,
  attempt: 0,
  /** Resolves when the latest attempt has ended, successful or not. */
  ended: Promise.resolve(),
  abort: new AbortController(),
  settle: undefined as { done: (loaded: Loaded) => void; failed: (why: unknown) => void } | undefined,
  slow: new Set<() => void>(),

  start(): Promise<Loaded> {
    this.loading ??= new Promise((done, failed) => {
      this.settle = { done, failed };
      void this.try();
    });
    return this.loading;
  },

  async try(): Promise<void> {
    const attempt = ++this.attempt;
    this.abort.abort();
    // The generated script would merge a new attempt with one that is still running.
    await this.ended;
    if (attempt !== this.attempt) return;
    this.abort = new AbortController();
    const late = setTimeout(() => {
      for (const tell of this.slow) tell();
    }, SLOW_MS);
    const { signal } = this.abort;
    // Bypasses the cache on a retry, since the cached copy failed before.
    const cache = attempt > 1 ? "reload" : "default";
    const answer = fetch(movedTo("figures") ?? new URL(EPIPOLE_WASM, import.meta.url), { signal, cache });
    this.ended = compile(answer, WANTED)
      .then((module) => load({ module_or_path: module }))
      .then(
        (loaded) => this.settle?.done(loaded),
        (problem: unknown) => {
          if (attempt !== this.attempt) return;
          this.loading = undefined;
          this.settle?.failed(problem);
        },
      )
      .finally(() => clearTimeout(late));
  },
};

/**
 * Loads the module or waits for it; calls `slow` if that takes long. To retry, call it again after
 * a failure, or `hurryModule` while it is slow.
 */
export async function loadModule(slow: () => void = () => {}): Promise<Loaded> {
  loader.slow.add(slow);
  try {
    return await loader.start();
  } finally {
    loader.slow.delete(slow);
  }
}

/** Requests the module again, replacing a hanging request. */
export function hurryModule(): void {
  if (loader.loading) void loader.try();
}

/** Lists the figures of the module, with title and help text. */
export async function listFigures(): Promise<{ name: string; title: string; help: string }[]> {
  await loadModule();
  return JSON.parse(figures());
}

/** Returns the message of the last panic. */
export function panicMessage(): string | undefined {
  return take_panic();
}

/** Typed wrapper of a figure. An exception from any method is a panic of the module. */
export class Engine {
  readonly #figure: Figure;
  readonly #memory: WebAssembly.Memory;

  /** Throws a string if there is no figure with this name. */
  constructor(name: string, memory: WebAssembly.Memory) {
    this.#figure = new Figure(name);
    this.#memory = memory;
  }

  get title(): string {
    return this.#figure.title();
  }

  get help(): string {
    return this.#figure.help();
  }

  get running(): boolean {
    return this.#figure.is_running();
  }

  apply(parameters: Parameters): Refused[] {
    return JSON.parse(this.#figure.apply(parameters.flat()));
  }

  state(): Parameters {
    return JSON.parse(this.#figure.state());
  }

  snapshot(width: number): Snapshot {
    return JSON.parse(this.#figure.snapshot(width));
  }

  update(event: FigureEvent): string | undefined {
    const figure = this.#figure;
    switch (event.type) {
      case "set":
        if (typeof event.value === "number") return figure.set_number(event.id, event.value);
        if (typeof event.value === "boolean") return figure.set_flag(event.id, event.value);
        return figure.set_text(event.id, event.value);
      case "press":
        return figure.press(event.id);
      case "handle-removed":
        return figure.remove(event.id);
      case "handle-moved":
        return figure.place(event.id, event.x, event.y);
      case "clicked":
        return figure.click_in(event.panel, event.x, event.y);
      case "tick":
        return figure.tick(event.dt_s);
      case "reset":
        return figure.reset();
    }
  }

  /** Returns the events that reach a goal from the default state. */
  solution(challenge: string): FigureEvent[] {
    return JSON.parse(this.#figure.solution(challenge));
  }

  tick(seconds: number): string | undefined {
    return this.#figure.tick(seconds);
  }

  handleAt(width: number, x: number, y: number): string | undefined {
    return this.#figure.handle_at(width, x, y);
  }

  drag(id: string, width: number, x: number, y: number): string | undefined {
    return this.#figure.drag(id, width, x, y);
  }

  nudge(id: string, width: number, towards: Direction, steps: number): string | undefined {
    return this.#figure.nudge(id, width, towards, steps);
  }

  moveToEnd(id: string, width: number, towards: Direction): string | undefined {
    return this.#figure.move_to_end(id, width, towards);
  }

  click(width: number, x: number, y: number): string | undefined {
    return this.#figure.click(width, x, y);
  }

  takePhoto(slot: string, { width, height, rgba, focal }: Photo): string | undefined {
    const refused = this.#figure.take_photo(slot, width, height, rgba);
    if (refused === undefined && focal !== undefined) this.#figure.take_focal(slot, focal);
    return refused;
  }

  /** Returns values of the state. */
  data(): Record<string, unknown> {
    return JSON.parse(this.#figure.data());
  }

  /** Returns rows of red, green, blue of a panel's photograph, copied from the module's memory; empty without one. */
  photograph(panel: string): Uint8Array<ArrayBuffer> {
    return new Uint8Array(this.#figure.photograph(panel));
  }

  /** Returns the file to save besides the picture, copied from the module's memory. */
  file(): Uint8Array<ArrayBuffer> {
    return new Uint8Array(this.#figure.file());
  }

  /** Returns the long computation that the figure waits for, if any. */
  job(): { key: string; request: () => Uint8Array } | undefined {
    const key = this.#figure.job_key();
    return key === undefined ? undefined : { key, request: () => this.#figure.job_request() };
  }

  jobDone(key: string, result: Uint8Array): boolean {
    return this.#figure.job_done(key, result);
  }

  jobFailed(key: string, sentence: string): boolean {
    return this.#figure.job_failed(key, sentence);
  }

  /** Frees the figure's memory. It must not be used afterwards. */
  free(): void {
    try {
      this.#figure.free();
    } catch {
      // After a panic, the figure stays borrowed.
    }
  }

  prepare(): boolean {
    return this.#figure.prepare();
  }

  refine(): boolean {
    return this.#figure.refine();
  }

  /** Draws a frame onto a canvas, resized to fit. Returns a message on failure. */
  draw(
    canvas: HTMLCanvasElement,
    width: number,
    scale: number,
    theme: string,
    sharp = false,
  ): string | undefined {
    const figure = this.#figure;
    const refused = sharp
      ? figure.draw_sharp(width, scale, theme)
      : figure.draw(width, scale, theme);
    if (refused !== undefined) return refused;
    const [columns, rows] = [figure.pixel_width(), figure.pixel_height()];
    // A view of the module's memory; putImageData makes the only copy.
    const bytes = new Uint8ClampedArray(
      this.#memory.buffer as ArrayBuffer,
      figure.pixels(),
      columns * rows * 4,
    );
    if (canvas.width !== columns) canvas.width = columns;
    if (canvas.height !== rows) canvas.height = rows;
    const context = canvas.getContext("2d", { alpha: false, willReadFrequently: true });
    context?.putImageData(new ImageData(bytes, columns, rows), 0, 0);
    return undefined;
  }
}
