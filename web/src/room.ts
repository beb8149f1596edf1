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
