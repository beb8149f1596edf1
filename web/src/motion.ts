/**
 * Animations of a figure: glides to parameters, and solutions of goals. They move what a reader can move, and end when
 * the reader takes control.
 */

import type { FigureEvent, Refused, Snapshot } from "./contract.js";
import type { Engine } from "./module.js";
import type { Parameters } from "./permalink.js";
import { wantsStillness } from "./theme.js";

/** The figure, as needed by animations. */
export interface Stage {
  /** Returns the current snapshot. */
  look: () => Snapshot | undefined;
  /** Changes the figure, without reporting refusals. */
  move: (work: (engine: Engine) => string | undefined) => void;
  /** Applies parameters on top of the state; returns those that could not be used. */
  apply: (parameters: Parameters) => Refused[];
  /** Returns whether a long computation is running. */
  busy: () => boolean;
  /** Stops or resumes the figure's clock. */
  freeze: (frozen: boolean) => void;
  /** Marks the changes between two snapshots. */
  mark: (before: Snapshot, now: Snapshot) => void;
  /** Returns the events that reach a goal from the default state. */
  solution: (challenge: string) => FigureEvent[] | undefined;
  /** Resets the figure to its default state. */
  reset: () => void;
  /** Shows which goal's solution is playing. */
  playing: (challenge: string | undefined) => void;
  /** Marks a control that is about to be pressed. */
  point: (id: string) => void;
}

/** Duration of one event of a solution, and of the pause after it, milliseconds. */
const EVENT_MS = 600;
const PAUSE_MS = 350;
/** Maximum duration of all ticks of a solution, milliseconds. */
const TICKS_MS = 3000;

/** Moves the figure to a fraction of its path. */
type Step = (share: number) => void;

export class Motion {
  readonly #stage: Stage;
  #turn = 0;
  /** Parameters at the end of the glide. */
  #target = new Map<string, string>();
  /** Goal whose solution is playing. */
  #playing: string | undefined;

  constructor(stage: Stage) {
    this.#stage = stage;
  }

  /** Ends glides and solutions in their current state. */
  stop(): void {
    this.#turn += 1;
    this.#target.clear();
    this.#stage.freeze(false);
    if (this.#playing !== undefined) this.#setPlaying(undefined);
  }

  /**
   * Glides to parameters, and to those of a glide that this one interrupts. Resolves when the figure has reached them,
   * or when something else has taken control.
   */
  async glide(parameters: Parameters, duration: number, ready: Promise<unknown>): Promise<Refused[]> {
    if (this.#playing !== undefined) this.stop();
    const turn = ++this.#turn;
    for (const [key, value] of parameters) this.#target.set(key, value);
    await ready;
    const before = this.#stage.look();
    if (turn !== this.#turn) return [];
    if (!before) {
      this.#target.clear();
      return [];
    }
    const target: Parameters = [...this.#target];
    const steps: Step[] = [];
    const jumps: Parameters = [];
    for (const [key, value] of target) {
      const step = this.#parameterStep(before, key, value);
      if (step) steps.push(step);
      else jumps.push([key, value]);
    }
    if (jumps.length > 0) this.#stage.apply(jumps);
    if (steps.length > 0) await this.#run(turn, duration, (share) => steps.forEach((step) => step(share)));
    if (turn !== this.#turn) return [];
    // Sets the exact targets, not the values rounded on the way.
    const refused = this.#stage.apply(target);
    this.#target.clear();
    const now = this.#stage.look();
    if (now) this.#stage.mark(before, now);
    return refused;
  }

  /** Plays the solution of a goal from the default state, or stops it. */
  async toggleSolution(challenge: string): Promise<void> {
    const again = this.#playing === challenge;
    this.stop();
    const events = again ? undefined : this.#stage.solution(challenge);
    if (!events || events.length === 0) return;
    const turn = this.#turn;
    this.#setPlaying(challenge);
    this.#stage.reset();
    await this.#play(events, turn);
    if (turn === this.#turn) this.stop();
  }

  #setPlaying(challenge: string | undefined): void {
    this.#playing = challenge;
    this.#stage.playing(challenge);
  }

  /** Plays events in order, until something else takes control. */
  async #play(events: FigureEvent[], turn: number): Promise<void> {
    const ticks = events.filter(({ type }) => type === "tick").length;
    this.#stage.freeze(ticks > 0);
    for (const event of events) {
      await this.#settle(turn);
      if (turn !== this.#turn) return;
      const before = this.#stage.look();
      if (!before) return;
      const step = this.#eventStep(before, event);
      if (step) await this.#run(turn, EVENT_MS, step);
      else if (event.type === "press") {
        this.#stage.point(event.id);
        await this.#pause(turn, PAUSE_MS);
      }
      if (turn !== this.#turn) return;
      this.#stage.move((engine) => engine.update(event));
      const rest = event.type === "tick" ? Math.min(TICKS_MS / ticks, 1000 * event.dt_s) : PAUSE_MS;
      await this.#pause(turn, rest);
    }
    await this.#settle(turn);
  }

  #parameterStep(snapshot: Snapshot, key: string, value: string): Step | undefined {
    const control = snapshot.controls.find(({ id }) => id === key);
    if (control) return this.#eventStep(snapshot, { type: "set", id: key, value: Number(value) });
    const [x = NaN, y = NaN] = value.split(",").map(Number);
    return this.#eventStep(snapshot, { type: "handle-moved", id: key, x, y });
  }

  /** Returns how to perform an event gradually; undefined for instantaneous events. */
  #eventStep({ controls, handles }: Snapshot, event: FigureEvent): Step | undefined {
    const between = (from: number, to: number, share: number) => from + share * (to - from);
    if (event.type === "set") {
      const { id, value } = event;
      const slider = controls.find((control) => control.id === id);
      const to = Number(value);
      if (slider?.kind !== "slider" || !(to >= slider.min && to <= slider.max)) return undefined;
      const from = slider.value;
      if (from === to) return undefined;
      return (share) =>
        this.#stage.move((engine) => engine.update({ type: "set", id, value: between(from, to, share) }));
    }
    if (event.type !== "handle-moved") return undefined;
    const handle = handles.find(({ id }) => id === event.id);
    if (!handle || !Number.isFinite(event.x) || !Number.isFinite(event.y)) return undefined;
    const { id, x, y } = handle;
    return (share) =>
      this.#stage.move((engine) =>
        engine.update({
          type: "handle-moved",
          id,
          x: between(x, event.x, share),
          y: between(y, event.y, share),
        }),
      );
  }

  /** Calls a step in each frame until the end; only once for readers who prefer reduced motion. */
  async #run(turn: number, duration: number, step: Step): Promise<void> {
    if (wantsStillness() || document.hidden || !(duration > 0)) {
      step(1);
      return;
    }
    const start = performance.now();
    let share = 0;
    while (share < 1 && turn === this.#turn) {
      share = Math.min((performance.now() - start) / duration, 1);
      step(share * share * (3 - 2 * share));
      if (share < 1) await nextFrame();
    }
  }

  async #pause(turn: number, milliseconds: number): Promise<void> {
    if (turn !== this.#turn || wantsStillness() || document.hidden) return;
    await new Promise((resolve) => setTimeout(resolve, milliseconds));
  }

  /** Waits for long computations. */
  async #settle(turn: number): Promise<void> {
    // Computations start with the next frame.
    await nextFrame();
    while (turn === this.#turn && this.#stage.busy()) {
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
  }
}

/** Resolves in the next frame of the display, or after a quarter of a second if there is none. */
function nextFrame(): Promise<void> {
  return new Promise((resolve) => {
    const frame = requestAnimationFrame(() => done());
    const timer = setTimeout(() => done(), 250);
    const done = () => {
      cancelAnimationFrame(frame);
      clearTimeout(timer);
      resolve();
    };
  });
}
