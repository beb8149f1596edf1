/** One running figure on a canvas: executes the effects of `drawing.ts`, with at most one drawing per frame. */

import type { Refused, Snapshot } from "./contract.js";
import { isCovered, type DrawEffect, type DrawEvent } from "./drawing.js";
import type { State } from "./lifecycle.js";
import { panicMessage, type Engine } from "./module.js";
import type { Parameters } from "./permalink.js";
import { drawScale, layoutWidth } from "./room.js";
import { wantsStillness, type Theme } from "./theme.js";

/** Time for refinement per frame of the display, milliseconds. */
const SLICE_MS = 8;
/** Time per frame for preparing the first picture while a reader waits for it, milliseconds. */
const HURRY_MS = 12;
/** Interval of idle work in browsers without idle callbacks, milliseconds. */
const IDLE_MS = 50;
/** Interval of ticks for readers who prefer reduced motion, milliseconds. */
const STILL_MS = 600;
/** Maximum duration of one tick, seconds. */
const TICK_S = 0.1;

export interface RendererCallbacks {
  state: () => State;
  dispatch: (event: DrawEvent) => void;
  /** Presents the canvas, if it was `painted`, and the snapshot, if it is new. */
  present: (snapshot: Snapshot | undefined, painted: boolean) => void;
  /** Reports why the figure refused a change. */
  refused: (sentence: string) => void;
  /** Called once; a renderer whose module has panicked does nothing more. */
  panicked: (message: string) => void;
}

export class Renderer {
  readonly #canvas: HTMLCanvasElement;
  readonly #callbacks: RendererCallbacks;
  /** Engine; undefined after the end. */
  #engine: Engine | undefined;
  #theme: Theme = "light";
  #width = 0;
  /** Width of the picture on the page, CSS pixels. */
  #shown = 0;
  /** Device pixels per CSS pixel at the last drawing. */
  #density = 0;
  /** Whether state or layout are newer than the last snapshot. */
  #outdated = true;
  /** Whether an animation controls the figure's clock. */
  #frozen = false;
  #lastTick: number | undefined;
  #frame = 0;
  #rest: ReturnType<typeof setTimeout> | undefined;
  #cancelIdle: (() => void) | undefined;

  constructor(engine: Engine, canvas: HTMLCanvasElement, callbacks: RendererCallbacks) {
    this.#engine = engine;
    this.#canvas = canvas;
    this.#callbacks = callbacks;
  }

  /** Layout width of the picture, CSS pixels; 0 without room. */
  get width(): number {
    return this.#width;
  }

  /** Changes the figure, and reports a refusal. */
  act(work: (engine: Engine) => string | undefined): void {
    const refused = this.move(work);
    if (refused !== undefined) this.#callbacks.refused(refused);
  }

  /** Applies parameters on top of the state; returns those that could not be used. */
  apply(parameters: Parameters): Refused[] {
    let problems: Refused[] = [];
    this.move((engine) => void (problems = engine.apply(parameters)));
    return problems;
  }

  /** Changes the figure; returns the reason for a refusal. */
  move(work: (engine: Engine) => string | undefined): string | undefined {
    const refused = this.ask(work);
    this.#outdated = true;
    this.#dispatch({ type: "input", now: performance.now() });
    return refused;
  }

  /** Passes a result to the figure; a poster that already shows it stays. */
  learn(work: (engine: Engine) => void): void {
    this.ask(work);
    this.#outdated = true;
    this.#dispatch({ type: "learned" });
  }

  /** Queries the figure; undefined after the end. A panic ends the renderer. */
  ask<T>(work: (engine: Engine) => T): T | undefined {
    if (!this.#engine) return undefined;
    try {
      return work(this.#engine);
    } catch (error) {
      this.end();
      const message = panicMessage() ?? String(error);
      console.error(`epipole-figure: ${message}`);
      this.#callbacks.panicked(message);
      return undefined;
    }
  }

  /**
   * Sets the room of the picture, its width on the page and, unless determined by the room, its layout width; CSS
   * pixels.
   */
  resize(room: number, shown: number, fitted?: number): void {
    const width = room < 1 ? 0 : (fitted ?? layoutWidth(room));
    const size = Math.min(shown || room, room);
    const relayout = width !== this.#width;
    if (!relayout && Math.abs(size - this.#shown) < 0.5 && this.#density === devicePixelRatio) return;
    if (relayout) this.#outdated = true;
    this.#width = width;
    this.#shown = size;
    this.#dispatch({ type: "resized", room: width > 0, relayout });
  }

  /** Stops or resumes the figure's clock. */
  freeze(frozen: boolean): void {
    this.#frozen = frozen;
    this.#lastTick = undefined;
  }

  /** Applies new colors or a new pixel density. */
  recolor(theme: Theme): void {
    this.#theme = theme;
    this.#dispatch({ type: "recolored" });
  }

  /** Draws now, without waiting for the display. */
  flush(): void {
    this.#dispatch({ type: "flush" });
  }

  /** Presents changes now, and draws them unless the first picture is still being prepared. */
  show(): void {
    // A hidden page gets no frames.
    this.#dispatch({ type: "show", hidden: document.hidden });
  }

  /** Completes the refinement, in slices. */
  async sharpen(): Promise<void> {
    while (this.#refine(performance.now() + SLICE_MS).more) await new Promise((resolve) => setTimeout(resolve));
  }

  /** Returns the picture at full quality on a separate canvas; immediate after `sharpen`. */
  portrait(scale: number, theme: Theme = this.#theme): HTMLCanvasElement | undefined {
    if (this.#width === 0) return undefined;
    const canvas = document.createElement("canvas");
    const refused = this.ask((engine) => engine.draw(canvas, this.#width, scale, theme, true));
    if (refused !== undefined) this.#callbacks.refused(refused);
    return this.#engine && refused === undefined ? canvas : undefined;
  }

  /** Draws the figure for print: sharp, dark on light, until it is recolored. */
  prepareForPrint(): void {
    if (this.#width === 0) return;
    // Does not wait for long computations.
    const settled = this.ask((engine) => engine.job()) === undefined;
    this.ask((engine) => engine.draw(this.#canvas, this.#width, 2, "light", settled));
  }

  /** Stops for good. */
  end(): void {
    cancelAnimationFrame(this.#frame);
    clearTimeout(this.#rest);
    this.#pause();
    this.#engine?.free();
    this.#engine = undefined;
  }

  run(effect: DrawEffect): void {
    switch (effect.type) {
      case "requestFrame":
        return this.#requestFrame();
      case "yield":
        // The first drawing takes longest; between frames, it delays none.
        setTimeout(() => (effect.now ? this.#onFrame(performance.now()) : this.#requestFrame()));
        return;
      case "draw":
        return this.#draw();
      case "present":
        return this.#present(effect.painted);
      case "rest":
        clearTimeout(this.#rest);
        this.#rest = setTimeout(() => this.#requestFrame(), effect.delay);
        return;
      case "refine": {
        const refined = this.#refine(performance.now() + SLICE_MS);
        return this.#dispatch({ type: "refined", now: performance.now(), ...refined });
      }
      case "warm":
        return this.#warm();
      case "pause":
        return this.#pause();
    }
  }

  #dispatch(event: DrawEvent): void {
    if (this.#engine) this.#callbacks.dispatch(event);
  }

  #requestFrame(): void {
    if (this.#frame || !this.#engine || this.#width === 0) return;
    this.#frame = requestAnimationFrame((now) => this.#onFrame(now));
  }

  #onFrame(now: number): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    // The room may have disappeared since the frame was requested.
    if (this.#width === 0) return;
    if (this.#callbacks.state().phase === "preparing") {
      const start = performance.now();
      const prepared = this.#prepare(start + HURRY_MS);
      if (!prepared || performance.now() - start > SLICE_MS) return this.#dispatch({ type: "slice", prepared });
    }
    const { visible } = this.#callbacks.state();
    const running = visible && !this.#frozen && this.ask((engine) => engine.running) === true;
    if (!running) this.#lastTick = undefined;
    this.#dispatch({ type: "frame", now, running, ticked: running && this.#tick(now) });
  }

  /** Advances the time of an animated figure; returns whether it did. */
  #tick(now: number): boolean {
    this.#lastTick ??= now;
    const passed = now - this.#lastTick;
    if (wantsStillness() && passed < STILL_MS) return false;
    this.#lastTick = now;
    for (let left = Math.min(passed, 2 * STILL_MS) / 1000; left > 0; left -= TICK_S) {
      const refused = this.ask((engine) => engine.tick(Math.min(left, TICK_S)));
      if (refused !== undefined) this.#callbacks.refused(refused);
    }
    this.#outdated = true;
    return true;
  }

  #draw(): void {
    this.#density = devicePixelRatio;
    const scale = drawScale(this.#shown, this.#width, this.#density || 1);
    const refused = this.ask((engine) => engine.draw(this.#canvas, this.#width, scale, this.#theme));
    if (refused !== undefined) this.#callbacks.refused(refused);
    else this.#dispatch({ type: "drawn", now: performance.now() });
  }

  #present(painted: boolean): void {
    if (!painted && !this.#outdated) return;
    const snapshot = this.#outdated ? this.ask((engine) => engine.snapshot(this.#width)) : undefined;
    this.#outdated = false;
    if (this.#engine) this.#callbacks.present(snapshot, painted);
  }

  /** Prepares the first picture until a given time; returns whether it is prepared. */
  #prepare(end: number): boolean {
    let more = true;
    while (more && performance.now() < end) more = this.ask((engine) => engine.prepare()) === true;
    return !more;
  }

  /** Refines the view until a given time. */
  #refine(end: number): { better: boolean; more: boolean } {
    let [better, more] = [false, true];
    while (more && performance.now() < end) {
      more = this.ask((engine) => engine.refine()) === true;
      better ||= more;
    }
    return { better, more };
  }

  /** Prepares and refines the first picture in idle time, so that the reader need not wait for it. */
  #warm(): void {
    if (this.#cancelIdle) return;
    const slice = (deadline?: IdleDeadline) => {
      this.#cancelIdle = undefined;
      const state = this.#callbacks.state();
      if (!isCovered(state) || !state.visible) return;
      const end = performance.now() + SLICE_MS;
      const prepared = state.phase === "warm" || this.#prepare(end);
      if (prepared) this.#dispatch({ type: "prepared" });
      if ((prepared && !this.#refine(end).more) || !this.#engine) return;
      // Idle time may last for several slices; between them, the page handles its events.
      if ((deadline?.timeRemaining() ?? 0) > SLICE_MS) later(() => slice(deadline), 0);
      else this.#warm();
    };
    const later = (work: () => void, delay: number) => {
      const timer = setTimeout(work, delay);
      this.#cancelIdle = () => clearTimeout(timer);
    };
    // Safari has no idle callbacks.
    if (typeof requestIdleCallback !== "function") return later(slice, IDLE_MS);
    const request = requestIdleCallback(slice);
    this.#cancelIdle = () => cancelIdleCallback(request);
  }

  /** Stops the animation clock and idle work, since pending callbacks would keep a removed figure in memory. */
  #pause(): void {
    this.#lastTick = undefined;
    this.#cancelIdle?.();
    this.#cancelIdle = undefined;
  }
}
