/**
 * Lifecycle of a figure as a reducer: events in, next state and effects out. It depends on neither the DOM nor the
 * module.
 *
 *     poster ──→ loading ──→ covered ──→ warm        the page's poster is shown
 *                   │           │          │
 *                   └──────→ preparing ──→ live ──→ refining ──→ sharp
 *                                            ↑__________│__________│
 *
 * A rename leads from any phase to `poster`, a failed load or a panic to `failed`. Both can open again.
 */

import { draw, FRAME, isCovered, release, type DrawEffect, type DrawEvent } from "./drawing.js";

export type Phase =
  /** No figure runs. */
  | "poster"
  /** The module is loading, or the figure waits for its turn. */
  | "loading"
  /** The figure runs, covered by the poster of its state. Its first picture is prepared in idle time. */
  | "covered"
  /** Covered, with the first picture prepared. */
  | "warm"
  /** The first picture is needed, and prepared in slices. */
  | "preparing"
  /** The canvas follows the figure. */
  | "live"
  /** The reader is idle; the view is refined in slices. */
  | "refining"
  /** Nothing is left to refine. */
  | "sharp"
  /** No figure runs, and a notice gives the reason. */
  | "failed";

export interface State {
  phase: Phase;
  /** Number of the latest attempt to load; results of older ones are dropped. */
  attempt: number;
  /** Whether the first snapshot has been presented. */
  ready: boolean;

  /** Whether it is within one screen of the viewport. */
  near: boolean;
  /** Whether it is in the viewport. */
  visible: boolean;
  /** Whether pointer or focus has entered the figure. */
  interested: boolean;
  /** Whether the reader or the page has changed anything; earlier changes are not announced. */
  touched: boolean;
  /** Whether the last change is the reader's: goals reached by the page or by a shown solution do not count. */
  own: boolean;
  /** Whether address and poster of the page belong to another figure. */
  renamed: boolean;

  /** Whether the address of the page has set the state of the figure. */
  linked: boolean;
  /** Whether the poster is shown, until the first picture is drawn. */
  poster: boolean;
  /** Whether the figure waits for a computation, or has not been presented yet. */
  waiting: boolean;
  /** Whether names in the element's attributes have been compared with those of the figure. */
  checked: boolean;
  /** Whether the picture has a width to be drawn at. */
  room: boolean;
  /** State of the canvas relative to the view: up to date, less refined, or outdated. */
  picture: "current" | "coarse" | "stale";
  /** Times of the last input and of the last drawing, milliseconds. */
  lastInput: number;
  lastDraw: number;
}

export type LifecycleEvent =
  | DrawEvent
  | { type: "renamed"; connected: boolean }
  | { type: "near"; near: boolean }
  | { type: "visible"; visible: boolean }
  /** The page has loaded and is idle. */
  | { type: "idle" }
  | { type: "interest" }
  /** The page animates the figure, in view or not. */
  | { type: "wanted" }
  | { type: "touch"; own: boolean }
  /** The canvas must show what the poster cannot. */
  | { type: "reveal" }
  /** The page or its address requests the figure, near or not. */
  | { type: "open"; withAddress: boolean }
  /** A figure runs; `covered` if the poster shows its state, `linked` if the address has set it. */
  | { type: "started"; covered: boolean; waiting: boolean; linked: boolean }
  /** The figure could not be opened, or its module has panicked. */
  | { type: "failed"; sentence: string; retry?: boolean }
  | { type: "snapshot"; waiting: boolean }
  | { type: "presented" };

export type Effect =
  | DrawEffect
  | { type: "load"; attempt: number; withAddress: boolean }
  /** Ends the figure and replaces its tree; with `wasReady`, `whenReady` becomes a new promise. */
  | { type: "dispose"; wasReady: boolean }
  | { type: "fail"; sentence: string; retry: boolean }
  | { type: "checkNames" }
  | { type: "becomeReady"; linked: boolean };

type Next = [State, Effect[]];

/** State of a figure that has just started, except for fields that depend on its element. */
const STARTED = {
  ready: false,
  waiting: true,
  room: false,
  picture: "stale",
  lastInput: 0,
  lastDraw: 0,
} as const;

export const INITIAL: State = {
  ...STARTED,
  phase: "poster",
  attempt: 0,
  near: false,
  visible: false,
  interested: false,
  touched: false,
  own: false,
  renamed: false,
  linked: false,
  poster: false,
  checked: false,
};

export function reduce(state: State, event: LifecycleEvent): Next {
  switch (event.type) {
    case "renamed": {
      const wanted = event.connected && (state.near || !isClosed(state));
      const closed: State = { ...state, phase: "poster", attempt: state.attempt + 1, ready: false, renamed: true };
      const [next, effects] = wanted ? load(closed, false) : stay(closed);
      return [next, [{ type: "dispose", wasReady: state.ready }, ...effects]];
    }
    case "near":
      return stay({ ...state, near: event.near });
    case "visible":
      return see({ ...state, visible: event.visible });
    case "idle":
      return begin(state);
    case "interest": {
      const next = { ...state, interested: true };
      return isClosed(next) ? begin(next) : showLive(next);
    }
    case "wanted":
      return begin({ ...state, near: true, interested: true });
    case "touch":
      return stay({ ...state, touched: true, own: event.own });
    case "reveal":
      return showLive(state);
    case "open":
      return load(state, event.withAddress);
    case "started":
      return start(state, event);
    case "failed": {
      // A figure that was ready has its own Reset.
      const { sentence, retry = !state.ready || !isRunning(state) } = event;
      return [{ ...state, phase: "failed", attempt: state.attempt + 1 }, [{ type: "fail", sentence, retry }]];
    }
    case "snapshot": {
      const check = !state.checked && !event.waiting;
      const next = { ...state, waiting: event.waiting, checked: state.checked || check };
      const [shown, effects] = next.interested ? showLive(next) : stay(next);
      return [shown, check ? [{ type: "checkNames" }, ...effects] : effects];
    }
    case "presented": {
      // A listener to an announcement may have renamed the figure.
      if (state.ready || !isRunning(state)) return stay(state);
      return [{ ...state, ready: true }, [{ type: "becomeReady", linked: state.linked }]];
    }
    default:
      return isRunning(state) ? draw(state, event) : stay(state);
  }
}

/** Shows the live figure, unless it still waits for the result shown in the poster. */
function showLive(state: State): Next {
  return isCovered(state) && !state.waiting ? [release(state), [FRAME]] : stay(state);
}

function start(state: State, { covered, waiting, linked }: Extract<LifecycleEvent, { type: "started" }>): Next {
  const next: State = {
    ...state,
    ...STARTED,
    phase: covered ? "covered" : "preparing",
    linked,
    poster: covered,
    checked: !waiting,
  };
  const shown = state.interested && !waiting ? release(next) : next;
  return [shown, isCovered(shown) && state.visible ? [{ type: "warm" }] : []];
}

function see(state: State): Next {
  if (!state.visible) return [state, [{ type: "pause" }]];
  return [state, isCovered(state) ? [FRAME, { type: "warm" }] : [FRAME]];
}

/** Opens a figure near the viewport unless it is open. */
function begin(state: State): Next {
  return state.near && isClosed(state) ? load(state, !state.renamed) : stay(state);
}

function load(state: State, withAddress: boolean): Next {
  const attempt = state.attempt + 1;
  return [{ ...state, phase: "loading", attempt }, [{ type: "load", attempt, withAddress }]];
}

function stay(state: State): Next {
  return [state, []];
}

function isClosed({ phase }: State): boolean {
  return phase === "poster" || phase === "failed";
}

function isRunning(state: State): boolean {
  return !isClosed(state) && state.phase !== "loading";
}
