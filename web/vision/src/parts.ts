/** Parts, each a module. Written by `make bless-vision` from `epipole-js`. */

import type { Source } from "./source.js";

/** A part of the library. */
export type Part = "homography" | "geometry" | "images";

/** Script and module of each part: literal addresses, which bundlers find. */
export const PARTS: Readonly<Record<Part, Source>> = {
  homography: {
    script: () => import("./parts/homography.part.js"),
    wasm: () => new URL("./parts/homography.wasm", import.meta.url),
  },
  geometry: {
    script: () => import("./parts/geometry.part.js"),
    wasm: () => new URL("./parts/geometry.wasm", import.meta.url),
  },
  images: {
    script: () => import("./parts/images.part.js"),
    wasm: () => new URL("./parts/images.wasm", import.meta.url),
  },
};
