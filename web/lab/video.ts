/** Frames of a video, decoded by the browser: candidates for each part, of which the Lab uses the sharpest. */

/** Number of candidate frames per part. */
const CANDIDATES = 5;
/** Time limit for an event of the video, milliseconds. */
const PATIENCE_MS = 15_000;
const QUALITY = 0.95;

export function isVideo(file: File): boolean {
  return file.type.startsWith("video/") || /\.(mp4|m4v|mov|webm|mkv|ogv|avi)$/i.test(file.name);
}

/** A video read part by part; at most the frames of one part are in memory. */
export class Frames {
  readonly name: string;
  readonly #video = document.createElement("video");
  readonly #canvas = document.createElement("canvas");
  readonly #url: string;
  #duration: number | undefined;

  constructor(file: File) {
    this.name = file.name;
    this.#url = URL.createObjectURL(file);
  }

  /**
   * Passes the candidate frames of a part to `bring` as JPEG files. Throws an `Error` with a
   * message for the reader.
   */
  async ofPart(part: number, numParts: number, bring: (jpeg: Uint8Array) => void): Promise<void> {
    try {
      this.#duration ??= await this.#open();
      for (let n = 0; n < CANDIDATES; n += 1) {
        const share = (part + (n + 0.5) / CANDIDATES) / numParts;
        await seek(this.#video, share * this.#duration);
        bring(await jpegOf(this.#video, this.#canvas));
      }
    } catch (error) {
      const why = error instanceof Error ? error.message : String(error);
      throw new Error(
        `${this.name} cannot be read as a video here: ${why}. Videos as MP4 with H.264, or as WebM, are read by every browser.`,
      );
    }
  }

  async #open(): Promise<number> {
    const video = this.#video;
    video.muted = true;
    video.playsInline = true;
    video.preload = "auto";
    const loaded = heard(video, "loadeddata");
    video.src = this.#url;
    await loaded;
    const duration = await durationOf(video);
    if (!(video.videoWidth > 0 && duration > 0)) throw new Error("there is no picture in it");
    [this.#canvas.width, this.#canvas.height] = [video.videoWidth, video.videoHeight];
    return duration;
  }

  /** Releases the video. */
  close(): void {
    this.#video.removeAttribute("src");
    this.#video.load();
    URL.revokeObjectURL(this.#url);
  }
}

/** Returns the current frame of a video as a JPEG file. */
export async function jpegOf(video: HTMLVideoElement, canvas: HTMLCanvasElement): Promise<Uint8Array> {
  const context = canvas.getContext("2d");
  if (!context) throw new Error("the browser gives no canvas");
  context.drawImage(video, 0, 0, canvas.width, canvas.height);
  const blob = await new Promise<Blob | null>((resolve) => canvas.toBlob(resolve, "image/jpeg", QUALITY));
  if (!blob) throw new Error("a frame is too large");
  return new Uint8Array(await blob.arrayBuffer());
}

async function seek(video: HTMLVideoElement, time: number): Promise<void> {
  const sought = heard(video, "seeked");
  video.currentTime = time;
  await sought;
}

/** Returns the duration, seconds. Recordings without one in the header reveal it after a seek to the end. */
async function durationOf(video: HTMLVideoElement): Promise<number> {
  if (Number.isFinite(video.duration)) return video.duration;
  await seek(video, 1e7);
  return Number.isFinite(video.duration) ? video.duration : video.currentTime;
}

/** Resolves at an event of a video; rejects on an error or after `PATIENCE_MS`. */
function heard(video: HTMLVideoElement, name: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const end = (then: () => void) => {
      clearTimeout(timer);
      video.removeEventListener(name, good);
      video.removeEventListener("error", bad);
      then();
    };
    const good = () => end(resolve);
    const bad = () => end(() => reject(new Error("this browser cannot decode it")));
    const timer = setTimeout(() => end(() => reject(new Error("this browser takes too long to read it"))), PATIENCE_MS);
    video.addEventListener(name, good);
    video.addEventListener("error", bad);
  });
}
