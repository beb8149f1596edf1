/** Announcements of a figure: events for the page, sentences for screen readers. */

import type { Challenge, Snapshot } from "./contract.js";
import type { FigureHost } from "./host.js";
import type { Parameters } from "./permalink.js";
import type { Shell } from "./shell.js";

/** A figure before and after a change. */
export interface Change {
  before: Snapshot | undefined;
  now: Snapshot;
  /** Goals reached by the change. */
  solved: Challenge[];
  /** Parameters that differ from the defaults. */
  state: Parameters;
  /** Whether reader or page made the change; changes while the page loads are not announced. */
  touched: boolean;
}

export class Announcer {
  readonly #host: FigureHost;
  /** Parameters that differ from the figure's defaults, as last announced. */
  #state: Parameters = [];
  #pass = () => {};
  #passed = this.#gate();

  constructor(host: FigureHost) {
    this.#host = host;
  }

  get state(): Parameters {
    return this.#state;
  }

  /** Resolves when the figure is ready. */
  get whenReady(): Promise<void> {
    return this.#passed;
  }

  /** Starts over for another figure. If this one was never ready, its `whenReady` stays pending for the next. */
  forget(wasReady: boolean): void {
    this.#state = [];
    if (wasReady) this.#passed = this.#gate();
  }

  ready(state: Parameters): void {
    this.#state = state;
    this.#pass();
    const { readouts } = this.#host;
    this.emit("epipole-ready", { name: this.#host.getAttribute("name"), state: this.#host.state, readouts });
  }

  changed({ speaker }: Shell, { before, now, solved, state, touched }: Change): void {
    speaker.moveOn();
    if (touched && before?.description !== now.description) speaker.describe(now.description);
    if (JSON.stringify(state) !== JSON.stringify(this.#state)) {
      this.#state = state;
      this.emit("epipole-change", this.#host.state);
    }
    const text = (snapshot?: Snapshot) => snapshot?.readouts.map((readout) => readout.text).join("|");
    if (text(before) !== text(now)) this.emit("epipole-readout", this.#host.readouts);
    for (const { id, goal } of solved) {
      speaker.say(`Solved: ${goal}`);
      this.emit("epipole-challenge", { id, goal });
    }
  }

  emit(type: string, detail: unknown): void {
    this.#host.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
  }

  #gate(): Promise<void> {
    return new Promise((resolve) => (this.#pass = resolve));
  }
}
