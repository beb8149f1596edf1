/** Zoom of spaces by keys, wheel and fingers. */

import type { Snapshot, Space } from "./contract.js";
import type { Hand } from "./picture.js";

export class Zoom {
  readonly #hand: Hand;
  #snapshot: Snapshot | undefined;
  /** Zoom of spaces not yet in the snapshot: keys may arrive faster than frames. */
  readonly #sizes = new Map<string, number>();

  constructor(hand: Hand) {
    this.#hand = hand;
  }

  update(snapshot: Snapshot): void {
    this.#snapshot = snapshot;
    this.#sizes.clear();
  }

  /** Returns the zoom of a space. */
  of(space: Space): number {
    return this.#slider(space)?.value ?? 1;
  }

  /** Sets the zoom of a space. */
  to(space: Space, value: number): void {
    const slider = this.#slider(space);
    if (!slider) return;
    const size = Math.min(Math.max(value, slider.min), slider.max);
    this.#sizes.set(space.zoom, size);
    this.#hand.set(space.zoom, size);
  }

  /** Multiplies the zoom of a space, by at least one step of its slider. */
  by(space: Space, factor: number): void {
    const slider = this.#slider(space);
    if (!slider || factor === 1) return;
    const size = this.#sizes.get(space.zoom) ?? slider.value;
    const step = Math.max(Math.abs(size * (factor - 1)), slider.step);
    this.to(space, size + (factor > 1 ? step : -step));
  }

  #slider(space: Space) {
    const control = this.#snapshot?.controls.find(({ id }) => id === space.zoom);
    return control?.kind === "slider" ? control : undefined;
  }
}
