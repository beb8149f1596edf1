/**
 * Lifecycle of a figure as a reducer: events in, next state and effects out. It knows neither the DOM nor the module.
 *
 *     poster ──→ loading ──→ covered ──→ warm        the page's poster is shown
 *                   │           │          │
 *                   └──────→ preparing ──→ live ──→ refining ──→ sharp
 *                                            ↑__________│__________│
 *
 * A rename leads from everywhere to `poster`, a failed load or a panic to `failed`. Both open again.
 */

import { draw, FRAME, isCovered, release, type DrawEffect, type DrawEvent } from "./drawing.js";

export type Phase =
  /** No figure runs. */
  | "poster"
  /** The module is on its way, or the figure waits for its turn. */
  | "loading"
  /** The figure runs; the poster shows its state. Its first picture is prepared in idle time. */
  | "covered"
  /** Covered, with the first picture prepared. */
  | "warm"
  /** The first picture is wanted, and prepared in slices. */
  | "preparing"
  /** The canvas follows the figure. */
  | "live"
  /** The reader rests; the view is refined in slices. */
  | "refining"
  /** Nothing is left to refine. */
  | "sharp"
  /** No figure runs, and a notice says why. */
  | "failed";

export interface State {
  phase: Phase;
  /** Number of the newest attempt to load; results of older ones are dropped. */
  attempt: number;
  /** The first snapshot has been presented. */
  ready: boolean;

  /** Within one screen of the viewport. */
  near: boolean;
  /** In the viewport. */
  visible: boolean;
  /** Pointer or focus has come to the figure. */
  interested: boolean;
  /** Reader or page have changed something; changes before that are not announced. */
  touched: boolean;
  /** Address and poster of the page belong to another figure. */
  renamed: boolean;

  /** The address of the page has set the state of the figure. */
  linked: boolean;
  /** The poster stays until the first picture is drawn. */
  poster: boolean;
  /** The figure waits for a computation, or has not been presented yet. */
  waiting: boolean;
  /** Names in the element's attributes have been compared with those of the figure. */
  checked: boolean;
  /** The picture has a width to be drawn at. */
  room: boolean;
  /** Canvas relative to the view: up to date, less refined, or outdated. */
  picture: "current" | "coarse" | "stale";
  /** Times of the last input and of the last drawing, milliseconds. */
  lastInput: number;
  lastDraw: number;
}

export type LifecycleEvent =
  | DrawEvent
  /** The element came into a document; `linked` if the address has parameters for it. */
  | { type: "connected"; linked: boolean }
  | { type: "disconnected" }
  | { type: "renamed"; connected: boolean }
  | { type: "near"; near: boolean }
  | { type: "visible"; visible: boolean }
  /** The page has loaded and is idle. */
  | { type: "idle" }
  | { type: "interest" }
  /** The page animates the figure, in view or not. */
  | { type: "glide" }
  | { type: "touch" }
  /** The canvas has to show what the poster cannot. */
  | { type: "reveal" }
  /** Reset, or a state to restore, without a running figure. */
  | { type: "open" }
  /** A figure runs; `covered` if the poster shows its state, `linked` if the address has set it. */
  | { type: "started"; covered: boolean; waiting: boolean; linked: boolean }
  | { type: "failed"; sentence: string; retry: boolean }
  | { type: "panicked"; sentence: string }
  | { type: "snapshot"; waiting: boolean }
  | { type: "presented" };

export type Effect =
  | DrawEffect
  | { type: "load"; attempt: number; withAddress: boolean }
  /** Ends the figure and replaces its tree; `wasReady` if `whenReady` has to be a new promise. */
  | { type: "dispose"; wasReady: boolean }
  | { type: "fail"; sentence: string; retry: boolean }
  | { type: "checkNames" }
  | { type: "becomeReady"; linked: boolean };

type Next = [State, Effect[]];

export const INITIAL: State = {
  phase: "poster",
  attempt: 0,
  ready: false,
  near: false,
  visible: false,
  interested: false,
  touched: false,
  renamed: false,
  linked: false,
  poster: false,
  waiting: true,
  checked: false,
  room: false,
  picture: "stale",
  lastInput: 0,
  lastDraw: 0,
};

export function reduce(state: State, event: LifecycleEvent): Next {
  switch (event.type) {
    case "connected":
      return event.linked ? load(state, true) : [state, []];
    case "disconnected":
      return [{ ...state, visible: false }, [{ type: "pause" }]];
    case "renamed": {
      const wanted = event.connected && (state.near || !isClosed(state));
      const next: State = { ...state, phase: "poster", attempt: state.attempt + 1, ready: false, renamed: true };
      const dispose: Effect = { type: "dispose", wasReady: state.ready };
      if (!wanted) return [next, [dispose]];
      const [loading, effects] = load(next, false);
      return [loading, [dispose, ...effects]];
    }
    case "near":
      return [{ ...state, near: event.near }, []];
    case "visible":
      return setVisible(state, event.visible);
    case "idle":
      return begin(state);
    case "interest": {
      const next = { ...state, interested: true };
      return isClosed(next) ? begin(next) : showLive(next);
    }
    case "glide":
      return begin({ ...state, near: true, interested: true });
    case "touch":
      return [{ ...state, touched: true }, []];
    case "reveal":
      return showLive(state);
    case "open":
      return load(state, false);
    case "started":
      return start(state, event);
    case "failed":
      return fail(state, event.sentence, event.retry);
    case "panicked":
      // A figure that was ready has a Reset of its own.
      return fail(state, event.sentence, !state.ready || !isRunning(state));
    case "snapshot": {
      const check = !state.checked && !event.waiting;
      const next = { ...state, waiting: event.waiting, checked: state.checked || check };
      const [shown, effects] = next.interested ? showLive(next) : ([next, []] as Next);
      return [shown, check ? [{ type: "checkNames" }, ...effects] : effects];
    }
    case "presented": {
      // A listener to what was announced may have renamed the figure.
      if (state.ready || !isRunning(state)) return [state, []];
      return [{ ...state, ready: true }, [{ type: "becomeReady", linked: state.linked }]];
    }
    default:
      return isRunning(state) ? draw(state, event) : [state, []];
  }
}

/** Releases a figure, unless it waits for the very result that the poster shows. */
function showLive(state: State): Next {
  return isCovered(state) && !state.waiting ? [release(state), [FRAME]] : [state, []];
}

function start(state: State, { covered, waiting, linked }: { covered: boolean; waiting: boolean; linked: boolean }): Next {
  const next: State = {
    ...state,
    phase: covered ? "covered" : "preparing",
    ready: false,
    linked,
    poster: covered,
    waiting: true,
    checked: !waiting,
    room: false,
    picture: "stale",
    lastInput: 0,
    lastDraw: 0,
  };
  const shown = state.interested && !waiting ? release(next) : next;
  return [shown, isCovered(shown) && state.visible ? [{ type: "warm" }] : []];
}

function setVisible(state: State, visible: boolean): Next {
  if (visible === state.visible) return [state, []];
  const next = { ...state, visible };
  if (!visible) return [next, [{ type: "pause" }]];
  return [next, isCovered(next) ? [FRAME, { type: "warm" }] : [FRAME]];
}

/** Opens a figure near the viewport unless it is open. */
function begin(state: State): Next {
  return state.near && isClosed(state) ? load(state, !state.renamed) : [state, []];
}

function load(state: State, withAddress: boolean): Next {
  const attempt = state.attempt + 1;
  return [{ ...state, phase: "loading", attempt }, [{ type: "load", attempt, withAddress }]];
}

function fail(state: State, sentence: string, retry: boolean): Next {
  return [{ ...state, phase: "failed", attempt: state.attempt + 1 }, [{ type: "fail", sentence, retry }]];
}

function isClosed({ phase }: State): boolean {
  return phase === "poster" || phase === "failed";
}

function isRunning(state: State): boolean {
  return !isClosed(state) && state.phase !== "loading";
}
