/**
 * Script of a figure in a SCORM 1.2 package: restores and stores its state, and reports the
 * fraction of goals reached. Searches the parent frames for the platform's `API`, as the standard
 * specifies; without it, the figure works but nothing is stored.
 */

// In the package, the file is beside this script.
import "./index.js";
import type { EpipoleFigure } from "./element.js";
import { readSaved } from "./saved.js";
import { type Api, findApi, finishOnLeave, record } from "./scorm_api.js";

/** Time without input after which the state is stored, milliseconds. */
const REST_MS = 1000;

function start(figure: EpipoleFigure, api: Api): void {
  let changed = false;
  let rest: ReturnType<typeof setTimeout> | undefined;
  const keep = () => {
    clearTimeout(rest);
    if (!changed) return;
    changed = false;
    const { goals, saved } = figure;
    const solved = goals.filter(({ solved }) => solved).length;
    if (!record(api, saved, goals.length > 0 ? solved / goals.length : undefined)) {
      figure.warn("This state is too long for the learning platform to keep");
    }
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
  finishOnLeave(api, keep);
}

const figure = document.querySelector("epipole-figure");
const api = figure && findApi();
if (figure && api) start(figure, api);
