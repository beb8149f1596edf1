/** Downloads of a figure: its picture, or its results as a file. */

import type { FileOffer } from "./contract.js";
import { make } from "./dom.js";
import type { Renderer } from "./renderer.js";

/** Time for the browser to start a download before its URL is revoked, milliseconds. */
const KEPT_MS = 10_000;
/** Device pixels per layout pixel in a saved picture. */
const SCALE = 2;

/** Returns the picture as a PNG, once it is fully refined. */
export async function pictureOf(renderer: Renderer, scale = SCALE): Promise<Blob | null> {
  await renderer.sharpen();
  const canvas = renderer.portrait(scale);
  return new Promise((resolve) => (canvas ? canvas.toBlob(resolve) : resolve(null)));
}

/** Saves the current picture. */
export async function savePicture(renderer: Renderer, name: string): Promise<void> {
  const blob = await pictureOf(renderer);
  if (blob) download(blob, `${name}.png`);
}

/** Saves the file offered by the figure, if it is ready. */
export function saveFile(renderer: Renderer, offer: FileOffer | null | undefined, name: string): void {
  const bytes = renderer.ask((engine) => engine.file());
  if (offer?.is_ready && bytes) download(new Blob([bytes]), `${name}.${offer.extension}`);
}

/** Downloads a file, as by following a link to it. */
function download(blob: Blob, name: string): void {
  const link = make("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
}
