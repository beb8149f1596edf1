/**
 * Photographs of the reader's own: chosen, dropped or taken, decoded and made smaller here; they go
 * nowhere else.
 */

import type { PhotoSlot } from "./contract.js";
import { make } from "./dom.js";
import { focalOf, HEAD_BYTES } from "./exif.js";

export interface Photo {
  width: number;
  height: number;
  rgba: Uint8Array;
  /** Focal length in units of the longer side, if the file tells. */
  focal?: number | undefined;
}

export class Photos {
  readonly element = make("div", { class: "photos", hidden: true });
  readonly #take: (slot: string, photo: Photo) => void;
  readonly #warn: (sentence: string) => void;
  #slots = "";
  /** Each slot with the note beside it. */
  #rows: { slot: PhotoSlot; row: HTMLElement; note: HTMLElement }[] = [];

  constructor(take: (slot: string, photo: Photo) => void, warn: (sentence: string) => void) {
    this.#take = take;
    this.#warn = warn;
  }

  update(slots: PhotoSlot[]): void {
    const ids = slots.map(({ id }) => id).join(" ");
    if (ids === this.#slots) return;
    this.#slots = ids;
    this.element.hidden = slots.length === 0;
    this.#rows = slots.map((slot) => this.#row(slot));
    this.element.replaceChildren(...this.#rows.map(({ row }) => row));
  }

  /** Files may be dropped anywhere on `target`: onto a slot's row for that slot, else for the first. */
  listen(target: HTMLElement): void {
    target.addEventListener("dragover", (event) => {
      if (this.#rows.length === 0 || !event.dataTransfer?.types.includes("Files")) return;
      event.preventDefault();
      event.dataTransfer.dropEffect = "copy";
    });
    target.addEventListener("drop", (event) => {
      const file = event.dataTransfer?.files[0];
      const [first] = this.#rows;
      if (!file || !first) return;
      event.preventDefault();
      const path = event.composedPath();
      const { slot, note } = this.#rows.find(({ row }) => path.includes(row)) ?? first;
      void this.#read(slot, file, note);
    });
  }

  #row(slot: PhotoSlot): { slot: PhotoSlot; row: HTMLElement; note: HTMLElement } {
    const note = make("span", { class: "note" }, "Or drop one here. Stays on your device.");
    const inputs = ["photo", "camera"].map((kind) => {
      const capture = kind === "camera" ? "environment" : undefined;
      const id = `${kind}-${slot.id}`;
      const input = make("input", { id, type: "file", accept: "image/*", capture });
      input.addEventListener("change", () => {
        const file = input.files?.[0];
        if (file) void this.#read(slot, file, note);
        // The same photograph may be chosen again.
        input.value = "";
      });
      const label = make("label", { for: id }, kind === "camera" ? "Take one now" : slot.label);
      return make("div", { class: kind === "camera" ? kind : "file" }, label, input);
    });
    return { slot, row: make("div", { class: "photo" }, ...inputs, note), note };
  }

  async #read(slot: PhotoSlot, file: File, note: HTMLElement): Promise<void> {
    let bitmap: ImageBitmap;
    try {
      bitmap = await createImageBitmap(file, { imageOrientation: "from-image" });
    } catch {
      this.#warn(`${file.name} is not a photograph that this browser can read.`);
      return;
    }
    const [photo, words] = shrink(bitmap, slot.max_side_px);
    const head = await file.slice(0, HEAD_BYTES).arrayBuffer();
    if (photo) photo.focal = focalOf(head, bitmap.width, bitmap.height);
    bitmap.close();
    note.textContent = `${words} Stays on your device.`;
    if (photo) this.#take(slot.id, photo);
  }
}

/** The pixels of a photograph, no side longer than `most`, and what was done to it. */
function shrink(bitmap: ImageBitmap, most: number): [Photo | undefined, string] {
  const scale = Math.min(1, most / Math.max(bitmap.width, bitmap.height));
  const width = Math.max(1, Math.round(bitmap.width * scale));
  const height = Math.max(1, Math.round(bitmap.height * scale));
  const canvas = make("canvas", { width, height });
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context) return [undefined, ""];
  context.imageSmoothingQuality = "high";
  context.drawImage(bitmap, 0, 0, width, height);
  const { data } = context.getImageData(0, 0, width, height);
  const now = `${width} × ${height} pixels`;
  const words =
    scale < 1 ? `Made smaller, from ${bitmap.width} × ${bitmap.height} to ${now}.` : `${now}.`;
  return [{ width, height, rgba: new Uint8Array(data.buffer) }, words];
}
