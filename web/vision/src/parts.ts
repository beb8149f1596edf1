/** Parts, each a module. Written by `make bless-vision` from `epipole-js`. */

import type { Part } from "./api.js";
import * as homography from "./parts/homography.part.js";
import * as geometry from "./parts/geometry.part.js";
import * as images from "./parts/images.part.js";
import * as all from "./parts/all.part.js";
import type { Source } from "./source.js";

/** Script and module of each part: literal addresses, which bundlers find. */
export const PARTS: Readonly<Record<Part, Source>> = {
  homography: { script: homography, wasm: () => new URL("./parts/homography.wasm", import.meta.url) },
  geometry: { script: geometry, wasm: () => new URL("./parts/geometry.wasm", import.meta.url) },
  images: { script: images, wasm: () => new URL("./parts/images.wasm", import.meta.url) },
  all: { script: all, wasm: () => new URL("./parts/all.wasm", import.meta.url) },
};
