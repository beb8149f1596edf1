/** Parts, each a module. Written by `make bless-vision` from `epipole-js`. */

import type { Source } from "./source.js";

/** A part of the library. */
export type Part = "homography" | "epipolar" | "absolutePose" | "synthetic";

/** Script and module of each part: literal addresses, which bundlers find. */
export const PARTS: Readonly<Record<Part, Source>> = {
  homography: {
    script: () => import("./parts/homography.part.js"),
    wasm: () => new URL("./parts/homography.wasm", import.meta.url),
  },
  epipolar: {
    script: () => import("./parts/epipolar.part.js"),
    wasm: () => new URL("./parts/epipolar.wasm", import.meta.url),
  },
  absolutePose: {
    script: () => import("./parts/absolutePose.part.js"),
    wasm: () => new URL("./parts/absolutePose.wasm", import.meta.url),
  },
  synthetic: {
    script: () => import("./parts/synthetic.part.js"),
    wasm: () => new URL("./parts/synthetic.wasm", import.meta.url),
  },
};
