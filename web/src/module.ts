/** The one WebAssembly module of a page: loaded when the first figure wants it. */

import load, { Figure, figures, take_panic } from "epipole-web";
import { movedTo } from "./assets.js";
import { compile } from "./compile.js";
import type {
  Direction,
  Parameters,
  Refused,
  Snapshot,
  SolutionEvent,
} from "./contract.js";
import type { Photo } from "./photos.js";

type Loaded = { memory: WebAssembly.Memory };

/** What the module must export for this script: a class's methods go by its name. */
const WANTED = [
  "figures",
  "take_panic",
  ...Object.getOwnPropertyNames(Figure.prototype)
    .filter((name) => !/^(constructor|free|__.*)$/.test(name))
    .map((name) => `figure_${name}`),
];

/** A request that takes longer is slow enough to say so, milliseconds. */
const SLOW_MS = 15_000;

/** Loads the module, once for all figures of the page; of several attempts the last one counts. */
const loader = {
  loading: undefined as Promise<Loaded> | undefined,
  attempt: 0,
  /** Settled once the newest attempt has ended, one way or the other. */
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
    // The generated script joins an attempt to one that is under way.
    await this.ended;
    if (attempt !== this.attempt) return;
    this.abort = new AbortController();
    const late = setTimeout(() => {
      for (const tell of this.slow) tell();
    }, SLOW_MS);
    const { signal } = this.abort;
    // What a cache has of it did not help the last time.
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
 * Loads the module, or waits for it; `slow` is called if that takes long. A failed load may be tried
 * again by another call, a slow one by `hurryModule`.
 */
export async function loadModule(slow: () => void = () => {}): Promise<Loaded> {
  loader.slow.add(slow);
  try {
    return await loader.start();
  } finally {
    loader.slow.delete(slow);
  }
}

/** Asks for the module anew, in place of a request that does not end. */
export function hurryModule(): void {
  if (loader.loading) void loader.try();
}

/** Every figure of the module with its title and what a reader can do with it. */
export async function listFigures(): Promise<{ name: string; title: string; help: string }[]> {
  await loadModule();
  return JSON.parse(figures());
}

/** What the last panic said. */
export function panicMessage(): string | undefined {
  return take_panic();
}

/** A figure in some state, typed. Whatever a method throws is a panic of the module. */
export class Engine {
  readonly #figure: Figure;
  readonly #memory: WebAssembly.Memory;

  /** Throws a sentence if there is no such figure. */
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

  update(event: SolutionEvent): string | undefined {
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

  /** The events that reach a goal from the default state. */
  solution(challenge: string): SolutionEvent[] {
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

  /** What can be saved besides the picture: a copy, which outlives the module's memory. */
  file(): Uint8Array<ArrayBuffer> {
    return new Uint8Array(this.#figure.file());
  }

  /** The long computation that the figure waits for. */
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

  /** Gives the figure's memory back; nothing may be asked of it any more. */
  free(): void {
    try {
      this.#figure.free();
    } catch {
      // A figure that has panicked still counts as busy.
    }
  }

  prepare(): boolean {
    return this.#figure.prepare();
  }

  refine(): boolean {
    return this.#figure.refine();
  }

  /** Draws a frame onto a canvas, which takes the frame's size. Returns a sentence on failure. */
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
    // A view of the module's memory: the only copy is the one that the canvas makes.
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
