/**
 * Page of the Lab: file inputs, downloads, workers, theme. Everything else is in the wasm module.
 */

import load, { Lab } from "epipole-lab-page";
import { showSettings, storedSettings } from "../book/settings.js";
import { wantsContrast, watchTheme } from "../src/theme.js";
import { Camera } from "./camera.js";
import { WorkerPool, type WorkerMessage } from "./worker_pool.js";
import { FigureBeside } from "./figure.js";
import { dropped, isCamera, isPhotographOrProject, photographOf } from "./files.js";
import { StoredProject, putAside, takeBack } from "./keep.js";
import { Mirror } from "./mirror.js";
import { solvedSample } from "./sample.js";
import { Frames, isVideo } from "./video.js";

function find<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

const canvas = find<HTMLCanvasElement>("lab");
const notice = find("notice");
const said = find("said");
const photographs = find<HTMLInputElement>("photographs");
const project = find<HTMLInputElement>("project");
const cameraFiles = find<HTMLInputElement>("camera-files");

/** Quiet time before a changing status is announced, milliseconds. */
const REST_MS = 400;

showSettings(storedSettings());

/** Interval for mirroring the widgets for screen readers, milliseconds. */
const LOOK_MS = 200;

/** Returns the theme by the settings of the book and of the system. */
function theme(): string {
  if (wantsContrast()) return "high-contrast";
  const chosen = document.documentElement.dataset["theme"];
  return chosen ?? (matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
}

/**
 * Corrects `devicePixelContentBoxSize` on emulated screens (device toolbar of developer tools),
 * where it ignores the emulated pixel ratio and would scale the whole Lab by it.
 */
function tellPixelsOfEmulatedScreens(): void {
  const told = Object.getOwnPropertyDescriptor(ResizeObserverEntry.prototype, "devicePixelContentBoxSize");
  if (!told?.get) return;
  const get = told.get as (this: ResizeObserverEntry) => readonly ResizeObserverSize[];
  Object.defineProperty(ResizeObserverEntry.prototype, "devicePixelContentBoxSize", {
    ...told,
    get(this: ResizeObserverEntry) {
      const [pixels, points] = [get.call(this), this.contentBoxSize];
      const [first, same] = [pixels[0], points[0]];
      const inlineSize = Math.round((same?.inlineSize ?? 0) * devicePixelRatio);
      const blockSize = Math.round((same?.blockSize ?? 0) * devicePixelRatio);
      // Differences from rounding to whole pixels are expected.
      if (!first || Math.abs(first.inlineSize - inlineSize) <= 2) return pixels;
      // The toolkit expects a ResizeObserverSize.
      const size = { inlineSize: { value: inlineSize }, blockSize: { value: blockSize } };
      return [Object.create(ResizeObserverSize.prototype, size) as ResizeObserverSize];
    },
  });
}

async function start(): Promise<void> {
  const link = new URLSearchParams(location.search);
  const linked = link.get("sample");
  /** Whether a figure of the book has stored the reader's photographs, which replace the sample. */
  const isHanded = link.get("photographs") === "brought";
  // Fetched while the module loads.
  const sample = !isHanded && (linked === null || linked === "table") ? solvedSample() : undefined;
  try {
    await load({ module_or_path: new URL(LAB_PAGE_WASM, import.meta.url) });
  } catch (error) {
    console.warn(error);
    notice.textContent = "The Lab could not be loaded. Reload the page to try again.";
    return;
  }
  const lab = new Lab();
  const hear = (message: WorkerMessage) => {
    if ("share" in message) lab.progress(message.work, message.share, message.words);
    else if ("soFar" in message) lab.soFar(message.work, message.soFar);
    else if ("answer" in message) lab.done(message.work, message.answer);
    else lab.failed(message.work, message.problem, message.broken);
  };
  const workers = new WorkerPool(hear);
  const beside = new FigureBeside();
  /** Files given by the reader, whose bytes are not in memory. */
  const given: File[] = [];
  const camera = new Camera(
    (name, jpeg) => {
      given.push(new File([jpeg as BlobPart], name));
      lab.photograph(name, jpeg);
    },
    () => lab.deliver(),
  );
  /** Videos by index. */
  const videos: Frames[] = [];
  const read = async (video: number, part: number, numParts: number) => {
    const frames = videos[video];
    if (!frames) return;
    try {
      await frames.ofPart(part, numParts, (jpeg) => lab.frame(jpeg));
      if (part + 1 === numParts) frames.close();
      lab.frames(video, frames.name);
    } catch (error) {
      frames.close();
      lab.noFrames(video, error instanceof Error ? error.message : String(error));
    }
  };
  const kept = new StoredProject(lab);
  /** Number of `given` files in the stored project, which need not be stored again. */
  let numKept = 0;
  const askForKept = async () => {
    try {
      const project = await kept.read();
      if (project) {
        // Readable until the project is erased.
        given.push(new File([project as BlobPart], "project.zip"));
        numKept = given.length;
        lab.keptProject(project);
      }
      return project !== undefined;
    } catch (error) {
      lab.keptAside(error instanceof Error ? error.message : String(error));
      return false;
    }
  };
  /** Whether the reader has given photographs that are in no saved project. */
  let isUnsaved = false;
  addEventListener("beforeunload", (event) => {
    const isKept = kept.isThere && given.length <= numKept;
    if (isUnsaved && !isKept) event.preventDefault();
  });
  let resting: ReturnType<typeof setTimeout> | undefined;
  const shell = {
    capacity: () => workers.capacity,
    start: (work: number, branch: string, request: Uint8Array) =>
      workers.start(work, branch === "files" ? "files" : "vision", request),
    cancel: (work: number) => workers.cancel(work),
    bringsSample: () => sample !== undefined || isHanded,
    askForPhotographs: () => photographs.click(),
    askForProject: () => project.click(),
    askForCameraFiles: () => cameraFiles.click(),
    askForCamera: () => void camera.open().catch((error: Error) => lab.notice(error.message)),
    askForFrames: (video: number, part: number, numParts: number) => void read(video, part, numParts),
    save: (name: string, bytes: Uint8Array) => {
      if (name === "project.zip") isUnsaved = false;
      save(name, bytes);
    },
    say: (words: string) => {
      clearTimeout(resting);
      resting = setTimeout(() => (said.textContent = words), REST_MS);
    },
    explain: (figure: string, page: string, title: string) => void beside.show(figure, page, title),
    keep: (bytes: Uint8Array) => {
      const count = given.length;
      kept.keep(bytes, () => (numKept = count));
    },
    forget: () => kept.forget(),
    askForKept: () => void askForKept(),
    address: (link: string) => history.replaceState(null, "", `?${link}`),
  };

  const take = async (files: Iterable<File>) => {
    let count = 0;
    const cameras: File[] = [];
    const foreign: string[] = [];
    const left: string[] = [];
    const undecoded: string[] = [];
    for (const file of files) {
      if (isVideo(file)) {
        given.push(file);
        lab.video(videos.push(new Frames(file)) - 1);
        continue;
      }
      if (isCamera(file)) {
        cameras.push(file);
        continue;
      }
      if (!isPhotographOrProject(file)) {
        left.push(file.name);
        continue;
      }
      const photograph = await photographOf(file);
      if (!photograph) {
        undecoded.push(file.name);
        continue;
      }
      given.push(file);
      if (file.name.toLowerCase().endsWith(".zip")) {
        lab.project(photograph.bytes);
        continue;
      }
      if (photograph.foreign) foreign.push(file.name);
      lab.photograph(photograph.name, photograph.bytes);
      count += 1;
    }
    if (count > 0) {
      lab.deliver();
      isUnsaved = true;
    }
    // Poses are matched by the names of photographs, possibly opened with them.
    for (const file of cameras) lab.cameraFile(file.name, new Uint8Array(await file.arrayBuffer()));
    if (cameras.length > 0) lab.cameras();
    const remarks = [
      [left, "not a photograph, so left out."],
      [undecoded, "this browser cannot decode it. Convert it to JPEG and add it again."],
      [foreign, "decoded by this browser, so another browser may give other pixels. The name ends in .jpg to mark it."],
    ] as const;
    const sentences = remarks.filter(([names]) => names.length > 0).map(([names, why]) => `${names.join(", ")}: ${why}`);
    if (sentences.length > 0) lab.notice(sentences.join(" "));
  };
  for (const input of [photographs, project, cameraFiles]) {
    input.addEventListener("change", () => {
      const files = [...(input.files ?? [])];
      input.value = "";
      void take(files);
    });
  }
  // Captured before the toolkit, which would stop a drop onto its canvas and read all files at once.
  for (const kind of ["dragover", "drop"] as const) {
    addEventListener(
      kind,
      (event) => {
        event.preventDefault();
        event.stopPropagation();
        if (kind === "drop" && event.dataTransfer) void dropped(event.dataTransfer).then(take);
      },
      { capture: true },
    );
  }

  await open(lab, isHanded, kept, askForKept);

  letTabLeave();
  tellPixelsOfEmulatedScreens();
  // The toolkit antialiases itself but requests the context with defaults; multisampling would
  // double the drawing time on software renderers.
  canvas.getContext("webgl2", { antialias: false, depth: false });
  try {
    await lab.start(canvas, shell);
  } catch (error) {
    console.warn(error);
    notice.textContent =
      "The Lab needs WebGL, which this browser does not offer. The command line does the same: epipole sfm --help";
    return;
  }
  void sample?.then((computed) => lab.solved(computed));
  notice.textContent = "";
  // The toolkit receives typed text through a hidden input.
  for (const input of document.querySelectorAll("input:not([aria-label])")) {
    input.setAttribute("aria-label", "Letters for the Lab");
  }
  lab.theme(theme());
  watchTheme(() => lab.theme(theme()));
  addEventListener("storage", () => showSettings(storedSettings()));
  const stop = (why: unknown) => {
    console.warn(why);
    clearInterval(watch);
    // Files not yet in the stored project are restored separately; storing them now would restore them twice.
    kept.close();
    // Files are set aside before the page reloads.
    isUnsaved = false;
    restart(
      notice,
      () => given.slice(kept.isThere ? numKept : 0),
      () => kept.settled,
      kept.isThere,
    );
  };
  canvas.addEventListener("webglcontextlost", () => stop("the context of WebGL is lost"));
  // Running out of memory stops the module without a panic.
  addEventListener("error", ({ error }) => {
    if (error instanceof WebAssembly.RuntimeError || error instanceof RangeError) stop(error);
  });
  const mirror = new Mirror(find("widgets"), (widget, role, name, value) => lab.operate(widget, role, name, value));
  const watch = setInterval(() => {
    const widgets = lab.widgets();
    if (widgets !== undefined) mirror.show(widgets);
    const message = lab.panic();
    if (message !== undefined) stop(message);
  }, LOOK_MS);
  const before = await takeBack();
  if (before.length > 0) await take(before);
  // New photographs open their own step; a link to another step overrides it.
  const step = link.get("step");
  if (isHanded && step !== null) lab.link(["step", step]);
  // Without photographs, show the sample.
  if (isHanded) lab.solved(before.length > 0 ? new Uint8Array() : await solvedSample());
}

/** Opens the stored project, then applies the address. */
async function open(lab: Lab, isHanded: boolean, kept: StoredProject, askForKept: () => Promise<boolean>): Promise<void> {
  const link = new URLSearchParams(location.search);
  link.delete("photographs");
  const [visit] = performance.getEntriesByType("navigation") as PerformanceNavigationTiming[];
  if ((link.has("sample") || isHanded) && visit?.type !== "reload") {
    // The reader wants to see the linked sample or the new photographs, which must not overwrite the stored project.
    if (await kept.read().catch(() => undefined)) {
      lab.keptAside("This browser keeps a project of yours. Open it from the Project menu.");
    }
  } else if (await askForKept()) {
    link.delete("sample");
  }
  if (link.size > 0) lab.link([...link].flat());
}

/** Offers to reload the page with the reader's files after the module has stopped. */
function restart(where: HTMLElement, rest: () => File[], settled: () => Promise<void>, isKept: boolean): void {
  if (where.querySelector("button")) return;
  const given = rest();
  const button = document.createElement("button");
  button.type = "button";
  const files = given.length === 1 ? "your file" : `your ${given.length} files`;
  const all = [...(isKept ? ["your project"] : []), ...(given.length > 0 ? [files] : [])];
  button.textContent = all.length > 0 ? `Start the Lab again with ${all.join(" and ")}` : "Start the Lab again";
  button.addEventListener("click", () => {
    // Files still being added to the stored project are in it by then.
    const aside = settled().then(() => {
      const left = rest();
      return left.length > 0 ? putAside(left) : undefined;
    });
    void aside.catch((error: unknown) => console.warn(error)).then(() => location.reload());
  });
  where.replaceChildren(
    "The Lab has stopped, but nothing is lost on your machine. If it happens again, reduce photographs to fewer megapixels. ",
    button,
  );
}

/** After Escape, Tab moves on in the page instead of within the Lab. */
function letTabLeave(): void {
  let leaving = false;
  addEventListener(
    "keydown",
    (event) => {
      if (event.key === "Tab" && leaving) event.stopImmediatePropagation();
      if (event.key !== "Shift" && event.key !== "Tab") leaving = event.key === "Escape";
    },
    { capture: true },
  );
  canvas.addEventListener("focus", () => (leaving = false));
}

function save(name: string, bytes: Uint8Array): void {
  const types: Record<string, string> = { json: "application/json", png: "image/png", zip: "application/zip" };
  const type = types[name.split(".").pop() ?? ""] ?? "application/octet-stream";
  const url = URL.createObjectURL(new Blob([bytes as BlobPart], { type }));
  const link = document.createElement("a");
  link.href = url;
  link.download = name;
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(url), 60_000);
}

void start();
