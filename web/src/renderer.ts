/**
 * One running figure: when it changes, ticks, draws and refines.
 *
 * A frame is drawn only when something has changed, at most once per frame of the display. While the
 * reader moves something, views draw drafts; when the reader rests, `refine` sharpens them in slices.
 */

import type { Snapshot } from "./contract.js";
import { panicMessage, type Engine } from "./module.js";
import { drawScale, layoutWidth } from "./room.js";
import { wantsStillness, type Theme } from "./theme.js";

/** How long the reader must rest before the picture is refined, milliseconds. */
const REST_MS = 120;
/** How long refining may take of one frame of the display, milliseconds. */
const SLICE_MS = 8;
/** How long the first picture may be prepared for a waiting reader before the page is heard again, milliseconds. */
const HURRY_MS = 12;
/** How often an idle moment is looked for, where a browser does not say when it has one, milliseconds. */
const IDLE_MS = 50;
/** How often a picture that is being refined is shown, milliseconds. */
const SHOW_MS = 150;
/** How often a running figure changes for a reader who wants things to stand still, milliseconds. */
const STILL_MS = 600;
/** The longest time that one tick passes on, seconds. */
const TICK_S = 0.1;

export interface RendererCallbacks {
  /**
   * A frame was drawn, or would have been were the picture not held back; the snapshot is new if the
   * state or the layout changed.
   */
  drawn: (snapshot: Snapshot | undefined, painted: boolean) => void;
  /** The figure refused something, with a sentence. */
  refused: (sentence: string) => void;
  /** The module panicked; this renderer does nothing any more. */
  broke: (message: string) => void;
}

export class Renderer {
  readonly engine: Engine;
  readonly #canvas: HTMLCanvasElement;
  readonly #hooks: RendererCallbacks;
  #width = 0;
  /** How wide the picture is shown, CSS pixels. */
  #shown = 0;
  /** Device pixels to a CSS pixel, when the picture was drawn. */
  #density = 0;
  /** Time is made by whoever plays something, not by the clock. */
  #frozen = false;
  #theme: Theme = "light";
  #inSight = false;
  #ended = false;
  /** The poster already shows this state, so nothing is drawn yet. */
  #held = false;
  /** There is a poster, which stands for the picture until that is drawn. */
  #hasPoster = false;
  /** What the first picture needs is there. */
  #prepared = false;
  /** The state or the layout is newer than the snapshot. */
  #changed = true;
  /** The picture is older than it should be. */
  #stale = true;
  /** The view may have more to refine. */
  #rough = true;
  #frame = 0;
  #rest: ReturnType<typeof setTimeout> | undefined;
  #lastInput = 0;
  #lastTick: number | undefined;
  #lastDraw = 0;

  constructor(engine: Engine, canvas: HTMLCanvasElement, hooks: RendererCallbacks) {
    this.engine = engine;
    this.#canvas = canvas;
    this.#hooks = hooks;
  }

  /** The width that the picture is laid out for, CSS pixels; 0 while there is no room. */
  get width(): number {
    return this.#width;
  }

  /** Draws nothing before `release` or the first change: the poster shows the same picture. */
  hold(): void {
    this.#held = this.#hasPoster = true;
  }

  /** Draws from now on. */
  release(): void {
    if (!this.#held) return;
    this.#held = false;
    this.#stale = true;
    this.#want();
  }

  /** Does something to the figure and draws what comes of it; tells a sentence if it is refused. */
  act(work: (engine: Engine) => string | undefined): void {
    const refused = this.move(work);
    if (refused !== undefined && !this.#ended) this.#hooks.refused(refused);
  }

  /** As `act`, and whoever calls says what is refused. */
  move(work: (engine: Engine) => string | undefined): string | undefined {
    const refused = this.#guard(() => work(this.engine));
    if (this.#ended) return undefined;
    this.#held = false;
    this.#changed = this.#stale = this.#rough = true;
    this.#lastInput = performance.now();
    this.#want();
    return refused;
  }

  /** Tells the figure what it was waiting for; where the poster shows it already, that stays. */
  learn(work: (engine: Engine) => void): void {
    this.#guard(() => work(this.engine));
    if (this.#ended) return;
    this.#changed = this.#stale = this.#rough = true;
    this.#want();
  }

  /** Asks the figure something. */
  ask<T>(work: (engine: Engine) => T): T | undefined {
    return this.#guard(() => work(this.engine));
  }

  /**
   * Takes the room that there is, and the width that the picture has in it, CSS pixels; and the width to lay it
   * out for, where that is not for the room alone to say.
   */
  resize(room: number, shown: number, fitted?: number): void {
    const width = room < 1 ? 0 : (fitted ?? layoutWidth(room));
    const size = Math.min(shown || room, room);
    const same = width === this.#width && Math.abs(size - this.#shown) < 0.5;
    if (same && this.#density === devicePixelRatio) return;
    if (width !== this.#width) this.#changed = this.#rough = true;
    this.#width = width;
    this.#shown = size;
    this.#stale = true;
    this.#want();
  }

  /** Lets the clock stand still, or run. */
  freeze(frozen: boolean): void {
    this.#frozen = frozen;
    this.#lastTick = undefined;
  }

  /** Takes new colors or a new density of pixels. */
  recolor(theme: Theme): void {
    this.#theme = theme;
    this.#stale = true;
    this.#want();
  }

  /** Animation and refinement stop where nobody sees them. */
  setInSight(inSight: boolean): void {
    if (inSight === this.#inSight) return;
    this.#inSight = inSight;
    this.#lastTick = undefined;
    if (!inSight) return this.#cool();
    this.#want();
    if (this.#held) this.#warm();
  }

  /** Draws now, without waiting for the display. */
  flush(): void {
    if (this.#ended || this.#width === 0) return;
    this.release();
    if (this.#stale) this.#draw();
  }

  /** Tells now what is new, and draws it unless the picture has still to be prepared. */
  show(): void {
    // In a hidden page no frame of the display would come.
    if (document.hidden || this.#prepared) return this.flush();
    this.release();
    if (this.#hasPoster && this.#changed && this.#width > 0 && !this.#ended) this.#tell(false);
  }

  /** Refines all that is left, in slices between which the page goes on. */
  async sharpen(): Promise<void> {
    for (let more = true; more && !this.#ended; ) {
      const start = performance.now();
      while (more && performance.now() - start < SLICE_MS) more = this.ask((engine) => engine.refine()) === true;
      await new Promise((resolve) => setTimeout(resolve));
    }
  }

  /** The picture at full quality on a canvas of its own: at once after `sharpen`. */
  portrait(scale: number, theme: Theme = this.#theme): HTMLCanvasElement | undefined {
    if (this.#width === 0) return undefined;
    const canvas = document.createElement("canvas");
    const refused = this.#guard(() => this.engine.draw(canvas, this.#width, scale, theme, true));
    if (this.#ended) return undefined;
    if (refused !== undefined) this.#hooks.refused(refused);
    return refused === undefined ? canvas : undefined;
  }

  /** Shows the figure as it is to be printed: sharp, dark on light. */
  prepareForPrint(): void {
    if (this.#width === 0) return;
    // Nobody waits for a long computation now.
    const settled = this.ask((engine) => engine.job()) === undefined;
    this.#guard(() => this.engine.draw(this.#canvas, this.#width, 2, "light", settled));
    this.#stale = true;
  }

  /** Stops for good. */
  end(): void {
    if (this.#ended) return;
    this.#ended = true;
    cancelAnimationFrame(this.#frame);
    clearTimeout(this.#rest);
    this.#cool();
    this.engine.free();
  }

  #want(): void {
    if (this.#frame || this.#ended || this.#width === 0) return;
    this.#frame = requestAnimationFrame((now) => {
      this.#frame = 0;
      // The room may have gone since the frame was asked for.
      if (this.#width > 0) this.#onFrame(now);
    });
  }

  #onFrame(now: number): void {
    const start = performance.now();
    if (this.#stale && !this.#held && (!this.#prepare(HURRY_MS) || performance.now() - start > SLICE_MS)) {
      // All at once would block the page: meanwhile the poster stands there, and all else is live.
      if (this.#hasPoster && this.#changed) this.#tell(false);
      // The first drawing takes longest, and is no part of the frame that shows it.
      setTimeout(() => (this.#prepared ? this.#drawBetweenFrames() : this.#want()));
      return;
    }
    const running = this.#inSight && !this.#frozen && this.ask((engine) => engine.running) === true;
    if (running) this.#pass(now);
    else this.#lastTick = undefined;
    if (this.#ended) return;
    const drawn = this.#stale;
    if (drawn) this.#draw();
    if (running) this.#want();
    else if (this.#rough && this.#inSight && !this.#held) {
      // A frame that has drawn has done enough.
      if (drawn) this.#want();
      else this.#refineAfterRest(now);
    }
  }

  #drawBetweenFrames(): void {
    cancelAnimationFrame(this.#frame);
    this.#frame = 0;
    if (!this.#ended && this.#width > 0) this.#onFrame(performance.now());
  }

  /** Prepares the first picture for so long, milliseconds; whether all that it needs is there. */
  #prepare(duration: number): boolean {
    const start = performance.now();
    while (!this.#prepared && performance.now() - start < duration) {
      this.#prepared = this.ask((engine) => engine.prepare()) !== true;
    }
    return this.#prepared;
  }

  /**
   * Prepares in idle moments what the first picture needs, while the poster is in its place: so whoever takes hold of
   * the figure need not wait for it.
   */
  #warm(): void {
    if (this.#warming || !this.#rough) return;
    this.#warming = true;
    const slice = (deadline?: IdleDeadline) => {
      this.#warming = false;
      this.#idle = 0;
      if (!this.#held || !this.#inSight || this.#ended) return;
      const start = performance.now();
      let more = true;
      if (this.#prepare(SLICE_MS)) {
        while (more && performance.now() - start < SLICE_MS) more = this.ask((engine) => engine.refine()) === true;
      }
      if (!more || this.#ended) return;
      // An idle moment has room for several slices; between them the page is heard.
      this.#warming = (deadline?.timeRemaining() ?? 0) > SLICE_MS;
      if (this.#warming) setTimeout(() => slice(deadline));
      else this.#warm();
    };
    // Safari has no idle callbacks.
    if (typeof requestIdleCallback === "function") this.#idle = requestIdleCallback(slice);
    else setTimeout(() => slice(), IDLE_MS);
  }

  /** Waits for no idle moment any more: it may be long in coming, and would hold a figure that is gone until then. */
  #cool(): void {
    if (this.#idle === 0) return;
    cancelIdleCallback(this.#idle);
    this.#idle = 0;
    this.#warming = false;
  }

  /** Lets time pass in a running figure. */
  #pass(now: number): void {
    this.#lastTick ??= now;
    let seconds = (now - this.#lastTick) / 1000;
    if (wantsStillness() && seconds * 1000 < STILL_MS) return;
    this.#lastTick = now;
    seconds = Math.min(seconds, (2 * STILL_MS) / 1000);
    while (seconds > 0) {
      const part = Math.min(seconds, TICK_S);
      seconds -= part;
      const refused = this.#guard(() => this.engine.tick(part));
      if (refused !== undefined) this.#hooks.refused(refused);
    }
    this.#changed = this.#stale = this.#rough = true;
  }

  #draw(): void {
    const width = this.#width;
    if (this.#held) {
      this.#stale = false;
      this.#tell(false);
      return;
    }
    this.#density = devicePixelRatio;
    const scale = drawScale(this.#shown, width, this.#density || 1);
    const refused = this.#guard(() => this.engine.draw(this.#canvas, width, scale, this.#theme));
    if (this.#ended) return;
    this.#stale = false;
    this.#lastDraw = performance.now();
    if (refused !== undefined) {
      this.#hooks.refused(refused);
      return;
    }
    this.#tell(true);
  }

  #tell(painted: boolean): void {
    const width = this.#width;
    const snapshot = this.#changed ? this.ask((engine) => engine.snapshot(width)) : undefined;
    this.#changed = false;
    if (!this.#ended) this.#hooks.drawn(snapshot, painted);
  }

  #refineAfterRest(now: number): void {
    clearTimeout(this.#rest);
    const wait = this.#lastInput + REST_MS - now;
    if (wait > 0) {
      this.#rest = setTimeout(() => this.#want(), wait);
      return;
    }
    const start = performance.now();
    let more = true;
    let refined = false;
    while (more && performance.now() - start < SLICE_MS) {
      more = this.ask((engine) => engine.refine()) === true;
      refined ||= more;
    }
    this.#rough = more;
    this.#unshown ||= refined;
    if (this.#unshown && (!more || performance.now() - this.#lastDraw > SHOW_MS)) {
      this.#unshown = false;
      this.#stale = true;
    }
    if (more || this.#stale) this.#want();
  }

  /** The view is better than the picture. */
  #unshown = false;
  /** An idle moment is waited for. */
  #warming = false;
  #idle = 0;

  #guard<T>(work: () => T): T | undefined {
    if (this.#ended) return undefined;
    try {
      return work();
    } catch (error) {
      this.end();
      const message = panicMessage() ?? String(error);
      console.error(`epipole-figure: ${message}`);
      this.#hooks.broke(message);
      return undefined;
    }
  }
}
