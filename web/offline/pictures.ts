// Which pictures of figures are kept: each in one width and theme, those that the reader sees. All
// of them would be four times as much.

/** Width and theme in which a reader sees figures. */
export interface Variant {
  width: number;
  theme: string;
}

/** The end of a picture's path: width in pixels, theme, hash. */
const PICTURE = /-(\d+)-(light|dark)-[^-]*$/;

/** The variant of a picture; undefined for anything else. */
export function variantOf(path: string): Variant | undefined {
  const [, width, theme] = PICTURE.exec(path) ?? [];
  return theme === undefined ? undefined : { width: Number(width), theme };
}

/**
 * One path of each group of pictures that show the same: in the theme, of this width, else of the
 * next smaller one, else of the smallest.
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
