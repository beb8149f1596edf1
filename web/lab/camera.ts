/** Photographs taken with the device's camera. */

import { jpegOf } from "./video.js";

function find<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

export class Camera {
  readonly #dialog = find<HTMLDialogElement>("camera");
  readonly #video = find<HTMLVideoElement>("camera-picture");
  readonly #count = find("camera-count");
  readonly #bring: (name: string, jpeg: Uint8Array) => void;
  readonly #end: () => void;
  #stream: MediaStream | undefined;
  #taken = 0;
  /** Number of photographs taken so far; file names keep counting up. */
  #total = 0;

  /** Calls `bring` with each photograph, and `end` when the dialog closes. */
  constructor(bring: (name: string, jpeg: Uint8Array) => void, end: () => void) {
    this.#bring = bring;
    this.#end = end;
    find("camera-take").addEventListener("click", () => void this.#take());
    find("camera-done").addEventListener("click", () => this.#dialog.close());
    this.#dialog.addEventListener("close", () => this.#stop());
  }

  /** Opens the camera. Throws an `Error` with a message for the reader. */
  async open(): Promise<void> {
    if (this.#dialog.open) return;
    const media = navigator.mediaDevices as MediaDevices | undefined;
    if (!media) throw new Error("This browser offers no camera to this page, or only over https. Add photographs from files.");
    try {
      this.#stream = await media.getUserMedia({
        video: { facingMode: "environment", width: { ideal: 3840 }, height: { ideal: 2160 } },
        audio: false,
      });
    } catch (error) {
      throw new Error(sentence(error));
    }
    this.#taken = 0;
    this.#tell();
    this.#video.srcObject = this.#stream;
    this.#dialog.showModal();
    await this.#video.play();
  }

  async #take(): Promise<void> {
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [this.#video.videoWidth, this.#video.videoHeight];
    // No photograph can be taken before the first video frame.
    if (!canvas.width) return;
    const jpeg = await jpegOf(this.#video, canvas);
    this.#total += 1;
    this.#taken += 1;
    this.#bring(`camera-${String(this.#total).padStart(2, "0")}.jpg`, jpeg);
    this.#tell();
  }

  #tell(): void {
    this.#count.textContent =
      this.#taken === 0 ? "Take two or more, one step to the side each time." : `${this.#taken} taken.`;
  }

  #stop(): void {
    for (const track of this.#stream?.getTracks() ?? []) track.stop();
    this.#stream = undefined;
    this.#video.srcObject = null;
    if (this.#taken > 0) this.#end();
  }
}

function sentence(error: unknown): string {
  const name = error instanceof Error ? error.name : "";
  if (name === "NotAllowedError") {
    return "The camera was refused. Allow it in the browser's settings for this page, or add photographs from files.";
  }
  if (name === "NotFoundError" || name === "OverconstrainedError") {
    return "There is no camera on this machine. Add photographs from files.";
  }
  if (name === "NotReadableError") return "The camera does not answer; another program may have it.";
  return "The camera could not be opened. Add photographs from files.";
}
