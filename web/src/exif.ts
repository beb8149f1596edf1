/**
 * Metadata of a photograph's file: the focal length from Exif, and whether the file is complete.
 */

/** JPEG markers: start of the image, application data, start of the scan, end of the image. */
const [START, APP1, SCAN, END] = [0xffd8, 0xffe1, 0xffda, 0xffd9];
/** "Exif", followed by two zeros. */
const EXIF = 0x45786966;
const EXIF_DIRECTORY = 0x8769;
const FOCAL_LENGTH_IN_35MM_FILM = 0xa405;
/** The Exif block, if any, is near the beginning of the file. */
export const HEAD_BYTES = 256 * 1024;
/** Diagonal of a frame of 36 mm × 24 mm. */
const FULL_FRAME_DIAGONAL = Math.hypot(36, 24);

/**
 * Returns the focal length in units of the photograph's longer side; undefined if the file contains none.
 *
 * The 35 mm equivalent compares diagonals (CIPA DCG-001).
 */
export function focalOf(head: ArrayBuffer, width: number, height: number): number | undefined {
  let equivalent: number | undefined;
  try {
    equivalent = equivalentIn(new DataView(head));
  } catch {
    // Truncated Exif block.
  }
  if (!equivalent) return undefined;
  return (equivalent * Math.hypot(width, height)) / (FULL_FRAME_DIAGONAL * Math.max(width, height));
}

/**
 * Whether a JPEG file ends before its image does; browsers show such a file partly gray, or not at all. Ignores
 * trailing data appended by cameras, and the thumbnail in the header.
 */
export function isCutOff(bytes: ArrayBuffer): boolean {
  const file = new DataView(bytes);
  if (file.byteLength < 4 || file.getUint16(0) !== START) return false;
  let at = 2;
  while (at + 4 <= file.byteLength && file.getUint16(at) !== SCAN) {
    // Unknown headers are left to the browser.
    if (file.getUint16(at) < 0xff00 || file.getUint16(at + 2) < 2) return false;
    at += 2 + file.getUint16(at + 2);
  }
  for (let end = file.byteLength - 2; end > at; end -= 1) if (file.getUint16(end) === END) return false;
  return true;
}

function equivalentIn(file: DataView): number | undefined {
  if (file.byteLength < 4 || file.getUint16(0) !== START) return undefined;
  let at = 2;
  while (at + 10 < file.byteLength) {
    const [marker, length] = [file.getUint16(at), file.getUint16(at + 2)];
    if (marker === APP1 && file.getUint32(at + 4) === EXIF) return inBlock(file, at + 10);
    if (marker < 0xff00 || marker === SCAN || length < 2) return undefined;
    at += 2 + length;
  }
  return undefined;
}

/** Reads a TIFF block: directories of tags, in either byte order. */
function inBlock(file: DataView, start: number): number | undefined {
  const little = file.getUint16(start) === 0x4949;
  const find = (directory: number, wanted: number): number | undefined => {
    const count = file.getUint16(directory, little);
    for (let entry = 0; entry < count; entry += 1) {
      const at = directory + 2 + 12 * entry;
      if (file.getUint16(at, little) !== wanted) continue;
      const isShort = file.getUint16(at + 2, little) === 3;
      return isShort ? file.getUint16(at + 8, little) : file.getUint32(at + 8, little);
    }
    return undefined;
  };
  const exif = find(start + file.getUint32(start + 4, little), EXIF_DIRECTORY);
  return exif === undefined ? undefined : find(start + exif, FOCAL_LENGTH_IN_35MM_FILM);
}
