/**
 * Messages between a figure in an iframe and its host page: height (LTI), score and saved state
 * (SPLICE, Perseus). Only messages of the direct parent are accepted.
 */

import type { EpipoleFigure } from "./element.js";
import { readSaved, type Saved } from "./saved.js";

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
let count = 0;

/** A unique id. `crypto.randomUUID` is missing on pages served without https. */
function messageId(): string {
  count += 1;
  return `epipole-${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}-${count}`;
}

function post(message: unknown): void {
  // The origin of the parent is unknown, and the messages contain nothing private.
  parent.postMessage(message, "*");
}

function tell(subject: string, more: object): string {
  const message_id = messageId();
  post({ subject, message_id, ...more });
  return message_id;
}

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

/** State, scores and events. */
function talk(figure: EpipoleFigure, activity_id: string): () => void {
  /** Message id of the state request that is still open. */
  let asked: string | undefined;
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

  const onMessage = ({ source, data }: MessageEvent) => {
    if (source !== parent) return;
    const message = recordOf(data);
    if (message?.["subject"] === "SPLICE.flushState") {
      const hadState = report();
      post({ subject: "SPLICE.flushState.response", message_id: message["message_id"], success: true, hadState });
    }
    if (message?.["subject"] !== "SPLICE.getState.response") return;
    if (asked === undefined || message["message_id"] !== asked) return;
    asked = undefined;
    // Hosts without stored state answer with an error or not at all.
    if (message["error"] != null || !figure.isConnected || touched) return;
    const saved = readSaved(message["state"], figure.getAttribute("name") ?? "");
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

  addEventListener("message", onMessage);
  addEventListener("pagehide", onHide);
  figure.addEventListener("epipole-change", reportLater);
  figure.addEventListener("epipole-challenge", onChallenge);
  figure.addEventListener("epipole-reset", onReset);
  figure.addEventListener("epipole-ready", onReady);
  for (const type of ["pointerdown", "keydown"]) figure.addEventListener(type, onTouch, { capture: true });
  if (figure.hasAttribute("data-ready")) onReady();
  asked = tell("SPLICE.getState", {});

  return () => {
    clearTimeout(rest);
    removeEventListener("message", onMessage);
    removeEventListener("pagehide", onHide);
    figure.removeEventListener("epipole-change", reportLater);
    figure.removeEventListener("epipole-challenge", onChallenge);
    figure.removeEventListener("epipole-reset", onReset);
    figure.removeEventListener("epipole-ready", onReady);
    for (const type of ["pointerdown", "keydown"]) figure.removeEventListener(type, onTouch, { capture: true });
  };
}

/** A message as an object; it may arrive as JSON text. */
function recordOf(data: unknown): Record<string, unknown> | undefined {
  let value = data;
  if (typeof data === "string") {
    try {
      value = JSON.parse(data);
    } catch {
      return undefined;
    }
  }
  return typeof value === "object" && value !== null ? (value as Record<string, unknown>) : undefined;
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
    // Not the document's height, which is never less than the iframe's.
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
