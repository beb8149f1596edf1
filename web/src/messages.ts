/**
 * Messages between a figure in an iframe and its host page: height (LTI), score and saved state (SPLICE, Perseus). Only
 * messages of the direct parent are accepted.
 */

import type { EpipoleFigure } from "./element.js";
import { readSaved, type Saved } from "./saved.js";
import { answerHost, messageId, post, tell } from "./splice.js";

export interface Connection {
  /** Identifier of this figure in learning records [default: the address of its page]. */
  activity?: string;
}

/** Minimum change of height to report, CSS pixels. */
const HEIGHT_STEP = 2;
/** Time for which a height must be stable to be reported, milliseconds. */
const HEIGHT_REST_MS = 150;
/** Time without input after which the state is reported, milliseconds. */
const REST_MS = 1000;
/** Minimum interval between reports without a new goal, milliseconds. */
const REPORT_MS = 30_000;

const connected = new WeakMap<EpipoleFigure, () => void>();

/**
 * Connects a figure to the page around its iframe; does nothing outside of iframes. A figure alone
 * on the page in an iframe is connected automatically. Returns a function that disconnects it.
 */
export function connect(figure: EpipoleFigure, { activity }: Connection = {}): () => void {
  if (parent === window) return () => {};
  const before = connected.get(figure);
  if (before) return before;
  const ends = [talk(figure, activity ?? addressOf(figure)), watchHeight(figure)];
  const end = () => {
    for (const stop of ends) stop();
    connected.delete(figure);
  };
  connected.set(figure, end);
  return end;
}

function addressOf(figure: EpipoleFigure): string {
  return location.origin + location.pathname + (figure.id ? `#${figure.id}` : "");
}

/** Exchanges state, scores and events. */
function talk(figure: EpipoleFigure, activity_id: string): () => void {
  let touched = false;
  let unreported = false;
  let reported = -Infinity;
  let rest: ReturnType<typeof setTimeout> | undefined;
  let praised = false;

  const report = (): boolean => {
    clearTimeout(rest);
    const goals = figure.goals;
    if (!unreported || goals.length === 0) return false;
    unreported = false;
    reported = performance.now();
    const score = goals.filter(({ solved }) => solved).length / goals.length;
    tell("SPLICE.reportScoreAndState", { activity_id, score, state: figure.saved });
    return true;
  };
  const reportLater = () => {
    unreported = true;
    clearTimeout(rest);
    rest = setTimeout(report, Math.max(REST_MS, reported + REPORT_MS - performance.now()));
  };

  const take = (state: unknown) => {
    if (!figure.isConnected || touched) return;
    const saved = readSaved(state, figure.getAttribute("name") ?? "");
    if (typeof saved === "string") void figure.whenReady().then(() => figure.warn(saved));
    else if (saved) void restore(saved);
  };
  const restore = async ({ state, solved }: Saved) => {
    await figure.whenReady();
    // The reader may have started meanwhile.
    if (touched) return;
    await figure.restore(state, { solved });
    figure.flush();
    // The restored state came from the host and need not be reported.
    clearTimeout(rest);
    unreported = false;
  };
  const onReady = () => void tell("SPLICE.sendEvent", { name: "ready", data: { figure: figure.getAttribute("name") } });
  const onReset = () => void tell("SPLICE.sendEvent", { name: "reset", data: {} });
  const onChallenge = ({ detail }: CustomEvent<{ id: string; goal: string }>) => {
    tell("SPLICE.sendEvent", { name: "challenge", data: detail });
    unreported = true;
    report();
    if (praised || figure.goals.some(({ solved }) => !solved)) return;
    praised = true;
    post(JSON.stringify({ testsPassed: true, message: detail.goal }));
  };
  const onTouch = ({ isTrusted }: Event) => {
    touched ||= isTrusted;
  };
  const onHide = () => void report();

  addEventListener("pagehide", onHide);
  figure.addEventListener("epipole-change", reportLater);
  figure.addEventListener("epipole-challenge", onChallenge);
  figure.addEventListener("epipole-reset", onReset);
  figure.addEventListener("epipole-ready", onReady);
  for (const type of ["pointerdown", "keydown"]) figure.addEventListener(type, onTouch, { capture: true });
  if (figure.hasAttribute("data-ready")) onReady();
  const endAnswers = answerHost({ restore: take, flush: report });

  return () => {
    clearTimeout(rest);
    endAnswers();
    removeEventListener("pagehide", onHide);
    figure.removeEventListener("epipole-change", reportLater);
    figure.removeEventListener("epipole-challenge", onChallenge);
    figure.removeEventListener("epipole-reset", onReset);
    figure.removeEventListener("epipole-ready", onReady);
    for (const type of ["pointerdown", "keydown"]) figure.removeEventListener(type, onTouch, { capture: true });
  };
}

/**
 * Reports the page's height, for the host to fit the iframe. Compact figures fit the iframe
 * instead.
 */
function watchHeight(figure: EpipoleFigure): () => void {
  let told = 0;
  let rest: ReturnType<typeof setTimeout> | undefined;
  const measure = () => {
    const { body } = document;
    const { bottom } = body.getBoundingClientRect();
    // The document's height is not used, as it is never less than the iframe's.
    const height = Math.ceil(bottom + scrollY + parseFloat(getComputedStyle(body).marginBottom));
    if (figure.compact || Math.abs(height - told) < HEIGHT_STEP) return;
    told = height;
    const message = { subject: "lti.frameResize", message_id: messageId(), height };
    post(message);
    // Some hosts accept only text.
    post(JSON.stringify(message));
  };
  const later = () => {
    clearTimeout(rest);
    rest = setTimeout(measure, HEIGHT_REST_MS);
  };
  const resized = new ResizeObserver(later);
  let ended = false;
  void figure.whenReady().then(() => {
    if (!ended) resized.observe(document.body);
  });
  return () => {
    ended = true;
    clearTimeout(rest);
    resized.disconnect();
  };
}
