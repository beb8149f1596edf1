/** For which widths pictures are laid out, and how finely they are drawn. */

/** Layout widths of the figures (`WIDTHS` of `epipole-widgets`), each with the room that it ends below, CSS pixels. */
const CLASSES: readonly (readonly [below: number, width: number])[] = [
  [500, 360],
  [860, 720],
  [Infinity, 1088],
];

/** More device pixels to a CSS pixel than that cost time and are not seen. */
const DENSEST = 2;
/** Nor does a picture in little room get so few that its lines break up. */
const COARSEST = 0.5;

/**
 * The width that a picture is laid out for in some room; it is then scaled to that room. Posters are
 * drawn at the same few widths, so a living picture has the very shape of its poster.
 */
export function layoutWidth(room: number): number {
  return CLASSES.find(([below]) => room < below)?.[1] ?? 0;
}

/** Device pixels to a pixel of the layout, for a picture shown `shown` CSS pixels wide. */
export function drawScale(shown: number, width: number, density: number): number {
  const fit = shown / width;
  const scale = Math.min(fit * Math.min(Math.max(density, 1), DENSEST), Math.max(DENSEST, fit));
  return Math.max(scale, COARSEST);
}

export interface Size {
  width: number;
  height: number;
}

/** Where a picture is shown smaller than that, its letters are hard to read. */
const LEGIBLE = 0.8;

/**
 * For a picture that must fit the width and the height of some room: the widest of its layouts that can still
 * be read there, else the one that is shown at the largest scale; and its size there.
 */
export function shownIn(room: Size, sizes: Size[]): { width: number; shown: Size } {
  const ways = sizes.map((size) => ({ size, scale: Math.min(room.width / size.width, room.height / size.height) }));
  const widest = ways.filter(({ scale }) => scale >= LEGIBLE).sort((a, b) => b.size.width - a.size.width)[0];
  const { size, scale } = widest ?? ways.sort((a, b) => b.scale - a.scale)[0] ?? { size: { width: 0, height: 0 }, scale: 0 };
  return { width: size.width, shown: { width: size.width * scale, height: size.height * scale } };
}

/** The widths that pictures are laid out for. */
export const WIDTHS = CLASSES.map(([, width]) => width);
