/**
 * What a figure in a frame and the page around it say to each other: how high the figure is (LTI), what the reader
 * has reached, and the state to come back to (SPLICE, Perseus). Only the page right around the frame is heard.
 */

import type { EpipoleFigure } from "./element.js";
import { readSaved, type Saved } from "./saved.js";

export interface Connection {
  /** What learning records call this figure; the address of its page, unless said otherwise. */
  activity?: string;
}

/** Smaller changes of height are not worth a message, CSS pixels. */
const HEIGHT_STEP = 2;
/** A height that keeps changing is told once it stays, milliseconds. */
const HEIGHT_REST_MS = 150;
/** The reader rests: the state is worth keeping, milliseconds. */
const REST_MS = 1000;
/** How often a state without a new goal is reported at most, milliseconds. */
const REPORT_MS = 30_000;

const connected = new WeakMap<EpipoleFigure, () => void>();
let count = 0;

/** Unlike `crypto.randomUUID`, this is there on pages without encryption, too. */
function messageId(): string {
  count += 1;
  return `epipole-${Date.now().toString(36)}-${Math.random().toString(36).slice(2)}-${count}`;
}

function post(message: unknown): void {
  // Who is around the frame is not known, and nothing that is said is secret.
  parent.postMessage(message, "*");
}

function tell(subject: string, more: object): string {
  const message_id = messageId();
  post({ subject, message_id, ...more });
  return message_id;
}

/**
 * Lets a figure talk to the page around its frame; outside of frames this does nothing. A figure that is alone on
 * a page in a frame is connected by itself. Returns how to end it.
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
  /** The question whose answer is still welcome. */
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
    // A page that keeps no states says so, or says nothing.
    if (message["error"] != null || !figure.isConnected || touched) return;
    const saved = readSaved(message["state"], figure.getAttribute("name") ?? "");
    if (typeof saved === "string") void figure.whenReady().then(() => figure.warn(saved));
    else if (saved) void restore(saved);
  };
  const restore = async ({ state, solved }: Saved) => {
    await figure.whenReady();
    // The reader may have been faster.
    if (touched) return;
    await figure.restore(state, { solved });
    figure.flush();
    // What the page has just told need not be told to the page.
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

/** A message as an object, whether it came as one or as text. */
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

/** Tells how high the page is, so that the frame can be as high. A compact figure takes the height that it gets. */
function watchHeight(figure: EpipoleFigure): () => void {
  let told = 0;
  let rest: ReturnType<typeof setTimeout> | undefined;
  const measure = () => {
    const { body } = document;
    const { bottom } = body.getBoundingClientRect();
    // Not that of the document, which is never lower than the frame.
    const height = Math.ceil(bottom + scrollY + parseFloat(getComputedStyle(body).marginBottom));
    if (figure.compact || Math.abs(height - told) < HEIGHT_STEP) return;
    told = height;
    const message = { subject: "lti.frameResize", message_id: messageId(), height };
    post(message);
    // Some hosts hear text alone.
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
