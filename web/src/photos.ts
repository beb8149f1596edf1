/**
 * Photographs of the reader: chosen, dropped or taken with the camera, decoded and downscaled on this device. They are
 * never uploaded.
 */

import type { PhotoSlot } from "./contract.js";
import { make } from "./dom.js";
import { focalOf, HEAD_BYTES, isCutOff } from "./exif.js";
import { reduced } from "./reduce.js";

export interface Photo {
  width: number;
  height: number;
  rgba: Uint8Array;
  /** Focal length in units of the longer side, if the file contains one. */
  focal?: number | undefined;
}

/** Callbacks for photographs. */
export interface PhotoHooks {
  /** Passes one to the figure. Returns a message if it is rejected. */
  take: (slot: string, photo: Photo) => string | undefined;
  warn: (sentence: string) => void;
  /** Called when the inputs have a note to show. */
  noted: () => void;
}

interface Row {
  slot: PhotoSlot;
  row: HTMLElement;
  note: HTMLElement;
  /** Number of photographs chosen so far; results of all but the last are discarded. */
  chosen: number;
  /** Original file of the photograph in the figure. */
  file?: File | undefined;
}

const INVITATION = "Or drop one here. Stays on your device.";

export class Photos {
  readonly element = make("div", { id: "photos", class: "photos", hidden: true });
  readonly #hooks: PhotoHooks;
  #slots = "";
  #rows: Row[] = [];

  constructor(hooks: PhotoHooks) {
    this.#hooks = hooks;
  }

  get offered(): boolean {
    return this.#rows.length > 0;
  }

  /** Original files of the figure's photographs, in the order of its slots. */
  get files(): File[] {
    return this.#rows.flatMap(({ file }) => file ?? []);
  }

  update(slots: PhotoSlot[]): void {
    const ids = slots.map(({ id }) => id).join(" ");
    if (ids === this.#slots) return;
    this.#slots = ids;
    this.#rows = slots.map((slot) => this.#row(slot));
    this.element.replaceChildren(...this.#rows.map(({ row }) => row));
  }

  /** Accepts files dropped on `target`: on a slot's row for that slot, elsewhere for the first. */
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
      void this.#read(this.#rows.find(({ row }) => path.includes(row)) ?? first, file);
    });
  }

  /** Drops all photographs, and discards those still being read. */
  forget(): void {
    const had = this.files.length > 0;
    for (const row of this.#rows) {
      row.chosen += 1;
      row.note.textContent = INVITATION;
      row.file = undefined;
    }
    if (had) this.#tell();
  }

  /** Notifies the page, which may pass the files to the Lab. */
  #tell(): void {
    this.element.dispatchEvent(new CustomEvent("epipole-photographs", { bubbles: true, composed: true }));
  }

  #row(slot: PhotoSlot): Row {
    const row: Row = { slot, row: make("div", { class: "photo" }), note: make("span", { class: "note" }, INVITATION), chosen: 0 };
    const inputs = ["photo", "camera"].map((kind) => {
      const capture = kind === "camera" ? "environment" : undefined;
      const id = `${kind}-${slot.id}`;
      const input = make("input", { id, type: "file", accept: "image/*", capture });
      input.addEventListener("change", () => {
        const file = input.files?.[0];
        if (file) void this.#read(row, file);
        // Reset, so that choosing the same file again triggers an event.
        input.value = "";
      });
      const label = make("label", { for: id }, kind === "camera" ? "Take one now" : slot.label);
      return make("div", { class: kind === "camera" ? kind : "file" }, label, input);
    });
    row.row.append(...inputs, row.note);
    return row;
  }

  async #read(row: Row, file: File): Promise<void> {
    const { slot, note } = row;
    const turn = ++row.chosen;
    let bitmap: ImageBitmap;
    try {
      if (isCutOff(await file.arrayBuffer())) {
        if (turn === row.chosen) this.#hooks.warn(`${file.name} is cut off: the file ends before its picture does.`);
        return;
      }
      bitmap = await createImageBitmap(file, { imageOrientation: "from-image" });
    } catch {
      if (turn === row.chosen) {
        this.#hooks.warn(`${file.name} is not a photograph that this browser can read.`);
      }
      return;
    }
    const head = await file.slice(0, HEAD_BYTES).arrayBuffer();
    const [few, low] = smaller(bitmap, slot.max_side_px);
    // A smaller photograph, chosen later, may be finished first.
    const rgba = await reduced(bitmap, few, low, () => turn === row.chosen).catch(() => undefined);
    const { width, height } = bitmap;
    bitmap.close();
    if (turn !== row.chosen) return;
    if (!rgba) {
      this.#hooks.warn(`This browser has no memory for ${file.name}: it has ${width} × ${height} pixels. Try a smaller copy.`);
      return;
    }
    const [whole, now] = [`${width} × ${height}`, `${few} × ${low}`];
    const refused = this.#hooks.take(slot.id, { width: few, height: low, rgba, focal: focalOf(head, width, height) });
    if (refused !== undefined) {
      // Names the original file and size. The figure's requirement is after the colon.
      const wanted = refused.split(": it ").at(-1) ?? refused;
      const size = whole === now ? `${now} pixels` : `${whole} pixels, made smaller to ${now}`;
      this.#hooks.warn(`${file.name} has ${size}. This figure ${wanted}.`);
      return;
    }
    const words = whole === now ? `${now} pixels.` : `Made smaller, from ${whole} to ${now} pixels.`;
    note.textContent = `${words} Stays on your device.`;
    row.file = file;
    this.#hooks.noted();
    this.#tell();
  }
}

/** Returns the size of a photograph downscaled to at most `most` pixels per side. */
function smaller({ width, height }: ImageBitmap, most: number): [width: number, height: number] {
  const scale = Math.min(1, most / Math.max(width, height));
  return [Math.max(1, Math.round(width * scale)), Math.max(1, Math.round(height * scale))];
}
