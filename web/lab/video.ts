/** Frames of a video, decoded by the browser: some of each of its parts, of which the Lab keeps the sharpest. */

/** So many frames of each part are looked at. */
const CANDIDATES = 5;
/** A browser that says nothing for so long will not, milliseconds. */
const PATIENCE_MS = 15_000;
const QUALITY = 0.95;

export function isVideo(file: File): boolean {
  return file.type.startsWith("video/") || /\.(mp4|m4v|mov|webm|mkv|ogv|avi)$/i.test(file.name);
}

/**
 * Brings frames as JPEG files, part by part. Throws an `Error` whose message is a sentence for the reader.
 */
export async function framesOf(
  file: File,
  numParts: number,
  tell: (words: string) => void,
  bring: (part: number, jpeg: Uint8Array) => void,
): Promise<void> {
  const video = document.createElement("video");
  video.muted = true;
  video.playsInline = true;
  video.preload = "auto";
  const url = URL.createObjectURL(file);
  try {
    const loaded = heard(video, "loadeddata");
    video.src = url;
    await loaded;
    const duration = await durationOf(video);
    if (!(video.videoWidth > 0 && duration > 0)) throw new Error("there is no picture in it");
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [video.videoWidth, video.videoHeight];
    for (let part = 0; part < numParts; part += 1) {
      tell(`${file.name}: part ${part + 1} of ${numParts} is being read.`);
      for (let n = 0; n < CANDIDATES; n += 1) {
        const share = (part + (n + 0.5) / CANDIDATES) / numParts;
        await seek(video, share * duration);
        bring(part, await jpegOf(video, canvas));
      }
    }
  } catch (error) {
    const why = error instanceof Error ? error.message : String(error);
    throw new Error(
      `${file.name} cannot be read as a video here: ${why}. Videos as MP4 with H.264, or as WebM, are read by every browser.`,
    );
  } finally {
    video.removeAttribute("src");
    video.load();
    URL.revokeObjectURL(url);
  }
}

/** The picture of a video as a JPEG file. */
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

/** Videos that were recorded without an end tell it once one has been there. */
async function durationOf(video: HTMLVideoElement): Promise<number> {
  if (Number.isFinite(video.duration)) return video.duration;
  await seek(video, 1e7);
  return Number.isFinite(video.duration) ? video.duration : video.currentTime;
}

/** Waits for an event of a video. */
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
    const timer = setTimeout(() => end(() => reject(new Error("this browser does not get on with it"))), PATIENCE_MS);
    video.addEventListener(name, good);
    video.addEventListener("error", bad);
  });
}
