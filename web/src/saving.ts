/** Saves a figure's picture or computed data as a file. */

import type { FileOffer } from "./contract.js";
import { make } from "./dom.js";
import type { Session } from "./session.js";

/** Time until the object URL of a download is revoked, milliseconds. */
const KEPT_MS = 10_000;
/** Device pixels per layout pixel in saved pictures. */
const SCALE = 2;

/** The fully refined picture as a PNG. */
export async function pictureOf(session: Session, scale = SCALE): Promise<Blob | null> {
  await session.sharpen();
  const canvas = session.portrait(scale);
  return new Promise((resolve) => (canvas ? canvas.toBlob(resolve) : resolve(null)));
}

/** Saves the current picture. */
export async function savePicture(session: Session, name: string): Promise<void> {
  const blob = await pictureOf(session);
  if (blob) download(blob, `${name}.png`);
}

/** Saves the figure's data file, if it is ready. */
export function saveFile(session: Session, offer: FileOffer | null | undefined, name: string): void {
  const bytes = session.ask((engine) => engine.file());
  if (offer?.is_ready && bytes) download(new Blob([bytes]), `${name}.${offer.extension}`);
}

/** Triggers a download. */
function download(blob: Blob, name: string): void {
  const link = make("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT_MS);
}
