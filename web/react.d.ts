import type { DetailedHTMLProps, HTMLAttributes } from "react";
import type { EpipoleEvents, EpipoleFigure } from "./index.js";

/** Props of a figure in React; each parameter of the figure is an attribute of the same name. */
export interface EpipoleFigureAttributes extends HTMLAttributes<EpipoleFigure> {
  name: string;
  theme?: "light" | "dark" | "high-contrast";
  compact?: boolean;
  controls?: string;
  readouts?: string;
  goals?: "none" | "one" | "all";
  "onepipole-ready"?: (event: EpipoleEvents["epipole-ready"]) => void;
  "onepipole-change"?: (event: EpipoleEvents["epipole-change"]) => void;
  "onepipole-readout"?: (event: EpipoleEvents["epipole-readout"]) => void;
  "onepipole-challenge"?: (event: EpipoleEvents["epipole-challenge"]) => void;
  "onepipole-reset"?: (event: EpipoleEvents["epipole-reset"]) => void;
  "onepipole-error"?: (event: EpipoleEvents["epipole-error"]) => void;
  [parameter: string]: unknown;
}

declare module "react" {
  namespace JSX {
    interface IntrinsicElements {
      "epipole-figure": DetailedHTMLProps<EpipoleFigureAttributes, EpipoleFigure>;
    }
  }
}

export { EpipoleFigure } from "./index.js";
