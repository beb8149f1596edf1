// Selection of cached pictures of figures: each in one width and theme, as seen by the reader. All variants would take
// four times as much.

/** Width and theme in which the reader sees figures. */
export interface Variant {
  width: number;
  theme: string;
}

/** End of a picture's path: width in pixels, theme, hash. */
const PICTURE = /-(\d+)-(light|dark)-[^-]*$/;

/** Returns the variant of a picture; undefined for any other file. */
export function variantOf(path: string): Variant | undefined {
  const [, width, theme] = PICTURE.exec(path) ?? [];
  return theme === undefined ? undefined : { width: Number(width), theme };
}

/**
 * Returns one path of each group of pictures that show the same: in the theme and this width, else the next smaller
 * width, else the smallest.
 */
export function inVariant(groups: string[][], { width, theme }: Variant): string[] {
  const distance = (path: string) => {
    const own = variantOf(path);
    if (!own) return 0;
    const tooWide = own.width > width ? 1e4 : 0;
    return (own.theme === theme ? 0 : 1e6) + tooWide + Math.abs(own.width - width);
  };
  return groups.map((paths) => paths.reduce((best, path) => (distance(path) < distance(best) ? path : best)));
}
