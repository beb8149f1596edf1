/**
 * Downscales photographs by area averaging. Browsers' own downscaling differs by up to 15 gray levels per pixel for
 * equal input, so a figure's results would differ between browsers.
 */

import { make } from "./dom.js";

/** Pixels read per strip; between strips the page handles events. */
const STRIP_PIXELS = 1 << 19;

/** Source pixels covered by one target pixel along a line: index of the first, and weights. */
interface Cover {
  first: number;
  shares: Float64Array;
}

/**
 * Averages the photograph to `width` × `height` RGBA pixels. Returns `undefined` when no longer `wanted`, or if there
 * is not enough memory for a canvas context.
 */
export async function reduced(
  photograph: ImageBitmap,
  width: number,
  height: number,
  wanted: () => boolean,
): Promise<Uint8Array | undefined> {
  const columns = covers(photograph.width, width);
  const rows = covers(photograph.height, height);
  const sums = new Float64Array(3 * width * height);
  const line = new Float64Array(3 * width);
  const most = Math.max(1, Math.floor(STRIP_PIXELS / photograph.width));
  const canvas = make("canvas", { width: photograph.width, height: Math.min(most, photograph.height) });
  // Transparent pixels are composited over black.
  const context = canvas.getContext("2d", { alpha: false, willReadFrequently: true });
  if (!context) return undefined;

  // First target row that the current source row contributes to.
  let target = 0;
  for (let top = 0; top < photograph.height; top += canvas.height) {
    if (top > 0) await new Promise((resolve) => setTimeout(resolve));
    if (!wanted()) return undefined;
    context.fillRect(0, 0, canvas.width, canvas.height);
    context.drawImage(photograph, 0, -top);
    const strip = Math.min(canvas.height, photograph.height - top);
    const { data } = context.getImageData(0, 0, photograph.width, strip);
    for (let inside = 0; inside < strip; inside += 1) {
      average(data.subarray(4 * photograph.width * inside), columns, line);
      target = spread(line, top + inside, rows, target, sums);
    }
  }

  const rgba = new Uint8Array(4 * width * height).fill(255);
  for (let pixel = 0; pixel < width * height; pixel += 1) {
    for (let channel = 0; channel < 3; channel += 1) rgba[4 * pixel + channel] = Math.round(sums[3 * pixel + channel] ?? 0);
  }
  return rgba;
}

/** Returns the source pixels covered by each of `few` equal parts of a line of `many`. Weights of a part sum to 1. */
function covers(many: number, few: number): Cover[] {
  return Array.from({ length: few }, (_, part) => {
    const [from, to] = [(part * many) / few, ((part + 1) * many) / few];
    const first = Math.floor(from);
    const count = Math.max(1, Math.min(many, Math.ceil(to)) - first);
    const share = (pixel: number) => (Math.min(pixel + 1, to) - Math.max(pixel, from)) / (to - from);
    return { first, shares: Float64Array.from({ length: count }, (__, i) => share(first + i)) };
  });
}

/** Averages a source row horizontally. */
function average(row: Uint8ClampedArray, columns: Cover[], line: Float64Array): void {
  let out = 0;
  for (const { first, shares } of columns) {
    let [red, green, blue] = [0, 0, 0];
    let at = 4 * first;
    for (const share of shares) {
      red += share * (row[at] ?? 0);
      green += share * (row[at + 1] ?? 0);
      blue += share * (row[at + 2] ?? 0);
      at += 4;
    }
    line[out] = red;
    line[out + 1] = green;
    line[out + 2] = blue;
    out += 3;
  }
}

/**
 * Adds an averaged row to the target rows that it overlaps. Returns the first row for the next
 * call.
 */
function spread(line: Float64Array, row: number, rows: Cover[], from: number, sums: Float64Array): number {
  let target = from;
  for (;;) {
    const cover = rows[target];
    if (!cover || cover.first > row) return Math.max(from, target - 1);
    const share = cover.shares[row - cover.first];
    if (share === undefined) {
      target += 1;
      continue;
    }
    const start = line.length * target;
    for (let i = 0; i < line.length; i += 1) sums[start + i] = (sums[start + i] ?? 0) + share * (line[i] ?? 0);
    target += 1;
  }
}
