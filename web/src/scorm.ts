/**
 * Script of a figure in a SCORM 1.2 package: restores and stores its state, and reports the
 * fraction of goals reached. Searches the parent frames for the platform's `API`, as the standard
 * specifies; without it, the figure works but nothing is stored.
 */

// Next to this script in the package.
import "./index.js";
import type { EpipoleFigure } from "./element.js";
import { readSaved } from "./saved.js";

/** SCORM 1.2 API of a platform; all values are strings, with "true" or "false" for success. */
interface Api {
  LMSInitialize: (empty: "") => string;
  LMSGetValue: (name: string) => string;
  LMSSetValue: (name: string, value: string) => string;
  LMSCommit: (empty: "") => string;
  LMSFinish: (empty: "") => string;
}

/** Maximum length of `cmi.suspend_data` in the standard, characters. */
const LONGEST = 4096;
/** Maximum depth of parent frames searched, from the standard. */
const DEEPEST = 7;
/** Time without input after which the state is stored, milliseconds. */
const REST_MS = 1000;

function find(from: Window): Api | undefined {
  let at = from;
  for (let depth = 0; depth <= DEEPEST; depth += 1) {
    try {
      const { API } = at as unknown as { API?: Api };
      if (API) return API;
    } catch {
      // Frames of another origin are not accessible.
      return undefined;
    }
    if (at.parent === at) break;
    at = at.parent;
  }
  return undefined;
}

function start(figure: EpipoleFigure, api: Api): void {
  if (api.LMSInitialize("") === "false") return;
  let changed = false;
  let rest: ReturnType<typeof setTimeout> | undefined;
  const keep = () => {
    clearTimeout(rest);
    if (!changed) return;
    changed = false;
    const { goals, saved } = figure;
    const text = JSON.stringify(saved);
    if (text.length <= LONGEST) api.LMSSetValue("cmi.suspend_data", text);
    else figure.warn("This state is too long for the learning platform to keep");
    const solved = goals.filter(({ solved }) => solved).length;
    if (goals.length > 0) {
      api.LMSSetValue("cmi.core.score.min", "0");
      api.LMSSetValue("cmi.core.score.max", "100");
      api.LMSSetValue("cmi.core.score.raw", String(Math.round((100 * solved) / goals.length)));
    }
    api.LMSSetValue("cmi.core.lesson_status", solved === goals.length ? "completed" : "incomplete");
    api.LMSCommit("");
  };
  const later = () => {
    changed = true;
    clearTimeout(rest);
    rest = setTimeout(keep, REST_MS);
  };
  const now = () => {
    changed = true;
    keep();
  };
  const saved = readSaved(api.LMSGetValue("cmi.suspend_data"), figure.getAttribute("name") ?? "");
  const restored =
    typeof saved === "string"
      ? figure.whenReady().then(() => figure.warn(saved))
      : saved && figure.restore(saved.state, { solved: saved.solved }).then(() => figure.flush());
  void Promise.resolve(restored).then(() => {
    figure.addEventListener("epipole-change", later);
    figure.addEventListener("epipole-challenge", now);
  });
  let finished = false;
  addEventListener("pagehide", () => {
    if (finished) return;
    finished = true;
    keep();
    api.LMSSetValue("cmi.core.exit", "suspend");
    api.LMSFinish("");
  });
}

const figure = document.querySelector("epipole-figure");
const api = find(window) ?? (window.opener ? find(window.opener as Window) : undefined);
if (figure && api) start(figure, api);
