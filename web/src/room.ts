/** Layout widths and drawing scale of pictures. */

/** Layout widths (`WIDTHS` of `epipole-widgets`), each with the room below which it applies, CSS pixels. */
const CLASSES: readonly (readonly [below: number, width: number])[] = [
  [500, 360],
  [860, 720],
  [Infinity, 1088],
];

/** Maximum number of drawn device pixels per CSS pixel; more would cost time without a visible gain. */
const DENSEST = 2;
/** Minimum number of drawn pixels per layout pixel; with fewer, lines break up. */
const COARSEST = 0.5;

/**
 * Returns the layout width of a picture for the available width; the picture is then scaled to fit. Posters are
 * rendered at the same few widths, so that a running figure has exactly its poster's shape.
 */
export function layoutWidth(room: number): number {
  return CLASSES.find(([below]) => room < below)?.[1] ?? 0;
}

/** Returns the device pixels per layout pixel for a picture displayed `shown` CSS pixels wide. */
export function drawScale(shown: number, width: number, density: number): number {
  const fit = shown / width;
  const scale = Math.min(fit * Math.min(Math.max(density, 1), DENSEST), Math.max(DENSEST, fit));
  return Math.max(scale, COARSEST);
}

export interface Size {
  width: number;
  height: number;
}

/** Minimum scale at which labels are easy to read. */
const LEGIBLE = 0.8;

/**
 * Returns the layout for a picture that must fit both width and height, with its displayed size: the widest one that is
 * still legible, else the one displayed at the largest scale.
 */
export function shownIn(room: Size, sizes: Size[]): { width: number; shown: Size } {
  const ways = sizes.map((size) => ({ size, scale: Math.min(room.width / size.width, room.height / size.height) }));
  const widest = ways.filter(({ scale }) => scale >= LEGIBLE).sort((a, b) => b.size.width - a.size.width)[0];
  const { size, scale } = widest ?? ways.sort((a, b) => b.scale - a.scale)[0] ?? { size: { width: 0, height: 0 }, scale: 0 };
  return { width: size.width, shown: { width: size.width * scale, height: size.height * scale } };
}

/** Layout widths of pictures. */
export const WIDTHS = CLASSES.map(([, width]) => width);
