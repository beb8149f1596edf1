/** Defines `<epipole-figure>`; importing this module is all that a page does. */

import { EpipoleFigure } from "./element.js";

export { EpipoleFigure } from "./element.js";
export { listFigures } from "./module.js";
export type * from "./contract.js";

/** What the events of a figure carry. */
export interface EpipoleEvents {
  /** The first frame is drawn. */
  "epipole-ready": CustomEvent<{
    name: string;
    state: Record<string, string>;
    readouts: Record<string, number | string>;
  }>;
  /** The state has changed; the detail is all that differs from the defaults. */
  "epipole-change": CustomEvent<Record<string, string>>;
  /** A readout has changed; the detail is all of them. */
  "epipole-readout": CustomEvent<Record<string, number | string>>;
  /** The reader has reached a goal for the first time. */
  "epipole-challenge": CustomEvent<{ id: string; goal: string }>;
  /** The figure has stopped; Reset starts it again. */
  "epipole-error": CustomEvent<{ message: string }>;
}

declare global {
  interface HTMLElementTagNameMap {
    "epipole-figure": EpipoleFigure;
  }
  interface HTMLElementEventMap extends EpipoleEvents {}
}

if (globalThis.customElements && !customElements.get("epipole-figure")) customElements.define("epipole-figure", EpipoleFigure);
