/** Defines `<epipole-figure>`; a page only needs to import this module. */

import { EpipoleFigure } from "./element.js";
import { connect } from "./messages.js";

export { EpipoleFigure } from "./element.js";
export { setAssets, type AssetAddresses } from "./assets.js";
export { connect, type Connection } from "./messages.js";
export { listFigures } from "./module.js";
export type { Goal } from "./challenges.js";
export type { Saved } from "./saved.js";
export type { Parameters } from "./permalink.js";
export type * from "./contract.js";

/** Events of a figure and their details. */
export interface EpipoleEvents {
  /** The first frame is drawn. */
  "epipole-ready": CustomEvent<{
    name: string;
    state: Record<string, string>;
    readouts: Record<string, number | string>;
  }>;
  /** The state has changed; the detail contains all values other than the default. */
  "epipole-change": CustomEvent<Record<string, string>>;
  /** A readout has changed; the detail contains all readouts. */
  "epipole-readout": CustomEvent<Record<string, number | string>>;
  /** The reader has reached a goal for the first time. */
  "epipole-challenge": CustomEvent<{ id: string; goal: string }>;
  /** The figure has been reset. */
  "epipole-reset": CustomEvent<Record<string, never>>;
  /** The reader has added a photograph, or the figure has dropped its photographs. */
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

/** In an iframe, connects the page's only figure. A page with several connects the figures of its choice. */
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
