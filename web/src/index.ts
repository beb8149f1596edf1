/** Defines `<epipole-figure>`; importing this module is all that a page does. */

import { EpipoleFigure } from "./element.js";
import { connect } from "./messages.js";

export { EpipoleFigure } from "./element.js";
export { setAssets, type AssetAddresses } from "./assets.js";
export { connect, type Connection } from "./messages.js";
export { listFigures } from "./module.js";
export type { Goal } from "./challenges.js";
export type { Saved } from "./saved.js";
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
  /** The figure has been reset. */
  "epipole-reset": CustomEvent<Record<string, never>>;
  /** The reader has given it a photograph, or it has let go of them. */
  "epipole-photographs": CustomEvent;
  /** The figure has stopped; Reset starts it again. */
  "epipole-error": CustomEvent<{ message: string }>;
}

declare global {
  interface HTMLElementTagNameMap {
    "epipole-figure": EpipoleFigure;
  }
  interface HTMLElementEventMap extends EpipoleEvents {}
}

/** In a frame: connects the figure that the page is for. A page with more of them connects those that it means. */
function connectAlone(): void {
  const [figure, another] = document.querySelectorAll("epipole-figure");
  if (figure instanceof EpipoleFigure && !another) connect(figure);
}

if (globalThis.customElements) {
  if (!customElements.get("epipole-figure")) {
    customElements.define("epipole-figure", EpipoleFigure);
    if (parent !== window) {
      if (document.readyState === "loading") addEventListener("DOMContentLoaded", connectAlone);
      else connectAlone();
      document.addEventListener("epipole-ready", connectAlone);
    }
  } else {
    console.warn("epipole-figure: another copy of the figures is on this page already, and serves it");
  }
}
