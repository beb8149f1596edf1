/** What is told of a figure: events for the page, sentences for those who hear it. */

import type { Challenge, Parameters, Snapshot } from "./contract.js";
import type { FigureHost } from "./controller.js";
import type { Shell } from "./shell.js";

/** A figure before and after something has changed. */
export interface Change {
  before: Snapshot | undefined;
  now: Snapshot;
  /** Goals that it has reached. */
  solved: Challenge[];
  /** What differs from its defaults. */
  state: Parameters;
  /** Somebody has done it: what comes by itself while the page loads is not announced. */
  touched: boolean;
}

export class Announcer {
  readonly #host: FigureHost;
  #state: Parameters = [];

  constructor(host: FigureHost) {
    this.#host = host;
  }

  /** What differs from the figure's defaults, as it was told last. */
  get state(): Parameters {
    return this.#state;
  }

  /** Another figure: nothing has been told of it. */
  forget(): void {
    this.#state = [];
  }

  /** The figure is about to be ready, with this state. */
  begin(state: Parameters): void {
    this.#state = state;
  }

  ready(): void {
    const { state, readouts } = this.#host;
    this.emit("epipole-ready", { name: this.#host.getAttribute("name"), state, readouts });
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
}
