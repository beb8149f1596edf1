/** Two-finger gestures in a 3D scene: moving both fingers pans, spreading them zooms. */

import type { Handle, Space } from "./contract.js";
import type { Place } from "./picture.js";

export interface PinchHand {
  placeOf: (touch: Touch) => Place;
  spaceAt: (place: Place) => Space | undefined;
  handle: (id: string) => Handle | undefined;
  zoomOf: (space: Space) => number;
  /** Ends the drag of a single finger. */
  begin: () => void;
  drag: (id: string, x: number, y: number) => void;
  zoom: (space: Space, value: number) => void;
}

/** Minimum distance between fingers in the zoom ratio, pixels. */
const CLOSEST = 12;

export class Pinch {
  readonly #hand: PinchHand;
  #held: { space: Space; spread: number; zoom: number; offset: Place } | undefined;

  constructor(hand: PinchHand) {
    this.#hand = hand;
  }

  /** Starts a gesture if both fingers are in the same scene. Returns whether it did. */
  start(event: TouchEvent): boolean {
    const fingers = this.#fingers(event);
    const space = fingers && this.#hand.spaceAt(fingers[0]);
    const pan = space && this.#hand.handle(space.pan);
    if (!fingers || !pan || this.#hand.spaceAt(fingers[1]) !== space) return false;
    event.preventDefault();
    this.#hand.begin();
    const [x, y] = middle(fingers);
    const offset: Place = [pan.place[0] - x, pan.place[1] - y];
    this.#held = { space, spread: spread(fingers), zoom: this.#hand.zoomOf(space), offset };
    return true;
  }

  move(event: TouchEvent): void {
    const [held, fingers] = [this.#held, this.#fingers(event)];
    if (!held || !fingers) return;
    event.preventDefault();
    const [x, y] = middle(fingers);
    this.#hand.drag(held.space.pan, x + held.offset[0], y + held.offset[1]);
    this.#hand.zoom(held.space, (held.zoom * spread(fingers)) / held.spread);
  }

  end(): void {
    this.#held = undefined;
  }

  #fingers({ touches }: TouchEvent): [Place, Place] | undefined {
    const [first, second] = [touches[0], touches[1]];
    if (!first || !second || touches.length !== 2) return undefined;
    return [this.#hand.placeOf(first), this.#hand.placeOf(second)];
  }
}

function middle([a, b]: [Place, Place]): Place {
  return [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2];
}

function spread([a, b]: [Place, Place]): number {
  return Math.max(Math.hypot(a[0] - b[0], a[1] - b[1]), CLOSEST);
}
