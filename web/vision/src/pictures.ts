/** Conversion of browser pictures to pixels. */

/** An `ImageBitmap`, a `VideoFrame`, or a `Blob` or `File` with an encoded image. */
export type Picture =
  | { readonly width: number; readonly height: number; close(): void }
  | { readonly displayWidth: number; readonly displayHeight: number; close(): void }
  | { readonly size: number; readonly type: string; arrayBuffer(): Promise<ArrayBuffer> };

/** Whether an argument is a picture, or a list that contains one. */
export function hasPicture(value: unknown): boolean {
  return Array.isArray(value) ? value.some(isPicture) : isPicture(value);
}

/** Returns an argument with its pictures replaced by their pixels. */
export async function withPixels(name: string, value: unknown): Promise<unknown> {
  if (!Array.isArray(value)) return isPicture(value) ? pixels(name, value) : value;
  return Promise.all(value.map((one, index) => withPixels(`${name}[${index}]`, one)));
}

function isPicture(value: unknown): value is Blob | ImageBitmap | VideoFrame {
  return isBlob(value) || isBitmap(value) || (typeof VideoFrame === "function" && value instanceof VideoFrame);
}

const isBlob = (value: unknown): value is Blob => typeof Blob === "function" && value instanceof Blob;
const isBitmap = (value: unknown): value is ImageBitmap =>
  typeof ImageBitmap === "function" && value instanceof ImageBitmap;

async function pixels(name: string, picture: Blob | ImageBitmap | VideoFrame): Promise<ImageData> {
  if (typeof OffscreenCanvas !== "function" || typeof createImageBitmap !== "function") {
    const instead = "pass an object with width, height and data";
    throw new TypeError(`${name} is a ${picture.constructor.name}, which cannot be decoded here: ${instead}`);
  }
  if (!isBlob(picture)) return drawn(name, picture);
  let bitmap: ImageBitmap;
  try {
    bitmap = await createImageBitmap(picture);
  } catch (cause) {
    const kind = picture.type === "" ? "unknown type" : `type ${picture.type}`;
    throw new TypeError(`${name} of ${kind} cannot be decoded: pass an image that this browser shows`, { cause });
  }
  try {
    return drawn(name, bitmap);
  } finally {
    bitmap.close();
  }
}

function drawn(name: string, picture: ImageBitmap | VideoFrame): ImageData {
  const [width, height] = isBitmap(picture)
    ? [picture.width, picture.height]
    : [picture.displayWidth, picture.displayHeight];
  if (width === 0 || height === 0) throw new TypeError(`${name} is closed: call before its close()`);
  const context = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
  if (context === null) throw new Error(`${name} of ${width} x ${height} pixels cannot be drawn: the memory is full`);
  context.drawImage(picture, 0, 0, width, height);
  return context.getImageData(0, 0, width, height);
}
