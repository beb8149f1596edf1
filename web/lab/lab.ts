/** The page of the Lab: file inputs, downloads, workers, theme. Everything else is in its module. */

import load, { Lab } from "epipole-lab-page";
import { Camera } from "./camera.js";
import { Crew, type Told } from "./crew.js";
import { FigureBeside } from "./figure.js";
import { Mirror } from "./mirror.js";
import { framesOf, isVideo } from "./video.js";

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

/** Words that change with every picture are told once they rest, milliseconds. */
const REST_MS = 400;

try {
  const chosen = localStorage.getItem("epipole-theme");
  if (chosen === "light" || chosen === "dark") document.documentElement.dataset["theme"] = chosen;
} catch {
  // Storage may be forbidden; then the system decides.
}

/** How often widgets are looked at for those who do not see them, milliseconds. */
const LOOK_MS = 200;

/** The theme that the reader chose in the book, or that of the system. */
function isDark(): boolean {
  const chosen = document.documentElement.dataset["theme"];
  if (chosen) return chosen === "dark";
  return matchMedia("(prefers-color-scheme: dark)").matches;
}

async function start(): Promise<void> {
  try {
    await load({ module_or_path: new URL(LAB_PAGE_WASM, import.meta.url) });
  } catch (error) {
    console.warn(error);
    notice.textContent = "The Lab could not be loaded. Reload the page to try again.";
    return;
  }
  const lab = new Lab();
  const hear = (told: Told) => {
    if ("share" in told) lab.progress(told.work, told.share, told.words);
    else if ("soFar" in told) lab.soFar(told.work, told.soFar);
    else if ("answer" in told) lab.done(told.work, told.answer);
    else lab.failed(told.work, told.problem);
  };
  const crew = new Crew(hear);
  const beside = new FigureBeside();
  const camera = new Camera(
    (name, jpeg) => lab.photograph(name, jpeg),
    () => lab.deliver(),
  );
  /** Videos by their numbers, and the one after the other: each takes the machine for itself. */
  const videos: File[] = [];
  let reading = Promise.resolve();
  const read = async (video: number, numParts: number) => {
    const file = videos[video];
    if (!file) return;
    try {
      await framesOf(file, numParts, (words) => lab.news(words), (part, jpeg) => lab.frame(part, jpeg));
      lab.frames(video, file.name);
    } catch (error) {
      lab.dropFrames();
      lab.news(error instanceof Error ? error.message : String(error));
    }
  };
  let resting: ReturnType<typeof setTimeout> | undefined;
  const shell = {
    capacity: () => crew.capacity,
    start: (work: number, branch: string, request: Uint8Array) =>
      crew.start(work, branch === "files" ? "files" : "vision", request),
    cancel: (work: number) => crew.cancel(work),
    askForPhotographs: () => photographs.click(),
    askForProject: () => project.click(),
    askForCamera: () => void camera.open().catch((error: Error) => lab.news(error.message)),
    askForFrames: (video: number, numParts: number) => {
      reading = reading.then(() => read(video, numParts));
    },
    save,
    say: (words: string) => {
      clearTimeout(resting);
      resting = setTimeout(() => (said.textContent = words), REST_MS);
    },
    explain: (figure: string, page: string, title: string) => void beside.show(figure, page, title),
    address: (link: string) => history.replaceState(null, "", `?${link}`),
  };

  const take = async (files: Iterable<File>) => {
    let count = 0;
    for (const file of files) {
      if (isVideo(file)) {
        lab.video(videos.push(file) - 1);
        continue;
      }
      const bytes = new Uint8Array(await file.arrayBuffer());
      if (file.name.toLowerCase().endsWith(".zip")) {
        lab.project(bytes);
        continue;
      }
      lab.photograph(file.name, bytes);
      count += 1;
    }
    if (count > 0) lab.deliver();
  };
  for (const input of [photographs, project]) {
    input.addEventListener("change", () => {
      const files = [...(input.files ?? [])];
      input.value = "";
      void take(files);
    });
  }
  addEventListener("dragover", (event) => event.preventDefault());
  addEventListener("drop", (event) => {
    event.preventDefault();
    void take([...(event.dataTransfer?.files ?? [])]);
  });

  if (location.search) lab.link([...new URLSearchParams(location.search)].flat());

  letTabLeave();
  try {
    await lab.start(canvas, shell);
  } catch (error) {
    console.warn(error);
    notice.textContent =
      "The Lab needs WebGL, which this browser does not give it. The command line does the same: epipole sfm --help";
    return;
  }
  notice.textContent = "";
  // The toolkit takes typed letters through an input of its own.
  for (const input of document.querySelectorAll("input:not([aria-label])")) {
    input.setAttribute("aria-label", "Letters for the Lab");
  }
  lab.dark(isDark());
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => lab.dark(isDark()));
  canvas.addEventListener("webglcontextlost", () => restart(notice));
  const mirror = new Mirror(find("widgets"), (widget, value) => lab.operate(widget, value));
  const watch = setInterval(() => {
    const widgets = lab.widgets();
    if (widgets !== undefined) mirror.show(widgets);
    const message = lab.panic();
    if (message === undefined) return;
    clearInterval(watch);
    console.warn(message);
    restart(notice);
  }, LOOK_MS);
}

/** Nothing goes on in this page: a new one does. */
function restart(where: HTMLElement): void {
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = "Start the Lab again";
  button.addEventListener("click", () => location.reload());
  where.replaceChildren("The Lab has stopped. Your files are as they were on your machine. ", button);
}

/** After Escape, Tab goes where the page goes next instead of where the Lab goes. */
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
  const type = name.endsWith(".json") ? "application/json" : "application/zip";
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
