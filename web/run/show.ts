/** `show` and `plot`: display of images and numbers of a reader's code. */

import { inspect } from "./inspect.js";
import type { Axes, Picture, Series } from "./messages.js";
import { groups, numbers } from "./numbers.js";
import { put } from "./outlet.js";

/** Maximum side of an image, pixels. */
const MOST_SIDE_PX = 4096;

/**
 * Converts gray values to bytes: bytes are unchanged; other numbers are scaled from 0, or the minimum if that is
 * negative, to the maximum. NaN is black.
 */
function toBytes(data: ArrayLike<number>): ArrayLike<number> {
  if (data instanceof Uint8Array || data instanceof Uint8ClampedArray) return data;
  const finite = Array.from(data).filter(Number.isFinite);
  const low = finite.reduce((least, value) => Math.min(least, value), 0);
  const high = finite.reduce((most, value) => Math.max(most, value), low);
  const scale = high > low ? 255 / (high - low) : 0;
  return Uint8ClampedArray.from(data, (value) => (Number.isFinite(value) ? (value - low) * scale : 0));
}

/** Shows an image, with points (u, v) and lines (a, b, c) in its pixels. */
export function show(image: unknown, options: { title?: string; points?: unknown; lines?: unknown } = {}): void {
  const { width, height, data } = (image ?? {}) as { width?: number; height?: number; data?: ArrayLike<number> };
  const isSize = (side: unknown): side is number => Number.isInteger(side) && (side as number) > 0;
  if (!isSize(width) || !isSize(height) || !data) {
    throw new TypeError(`show wants an image: an object with width, height and data, not ${inspect(image)}`);
  }
  if (Math.max(width, height) > MOST_SIDE_PX) {
    throw new RangeError(`show takes images of at most ${MOST_SIDE_PX} pixels a side, not ${width}×${height}`);
  }
  const channels = data.length / (width * height);
  if (channels !== 1 && channels !== 3 && channels !== 4) {
    throw new TypeError(`${data.length} numbers are not 1, 3 or 4 a pixel of ${width}×${height}`);
  }
  const bytes = toBytes(data);
  const rgba = new Uint8ClampedArray(4 * width * height);
  for (let pixel = 0; pixel < width * height; pixel++) {
    for (let channel = 0; channel < 4; channel++) {
      const from = channels === 1 ? pixel : channels * pixel + channel;
      rgba[4 * pixel + channel] = channel === 3 && channels < 4 ? 255 : (bytes[from] ?? 0);
    }
  }
  const [points, lines] = [groups("points", options.points, 2), groups("lines", options.lines, 3)];
  const picture: Picture = { width, height, rgba, title: String(options.title ?? ""), points, lines };
  put({ type: "picture", picture });
}

interface PlotOptions {
  title?: string;
  label?: string;
  xLabel?: string;
  yLabel?: string;
  dots?: boolean;
}

/** Plots numbers over x values, or over their index. */
export function plot(x: unknown, y?: unknown, options: PlotOptions = {}): void {
  const values = numbers(y === undefined ? "plot's numbers" : "y", y ?? x);
  const places = y === undefined ? values.map((_, index) => index) : numbers("x", x);
  if (places.length !== values.length) {
    throw new RangeError(`plot wants as many x as y, not ${places.length} and ${values.length}`);
  }
  const series: Series = { x: places, y: values, label: String(options.label ?? ""), dots: options.dots === true };
  const axes: Axes = {
    title: String(options.title ?? ""),
    x: String(options.xLabel ?? ""),
    y: String(options.yLabel ?? ""),
  };
  put({ type: "plot", series, axes });
}
