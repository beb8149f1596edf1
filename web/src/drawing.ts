/** Drawing of a running figure, a part of the reducer in `lifecycle.ts`: when to prepare, draw, present and refine. */

import type { State } from "./lifecycle.js";

/** Events of a running figure, by its renderer. */
export type DrawEvent =
  /** The reader or the page changed the figure. */
  | { type: "input"; now: number }
  /** A computation ended. */
  | { type: "learned" }
  | { type: "resized"; room: boolean; relayout: boolean }
  | { type: "recolored" }
  /** Draw now, at any cost. */
  | { type: "flush" }
  /** Show now, as far as it is cheap. */
  | { type: "show"; hidden: boolean }
  /** Idle time has prepared the first picture. */
  | { type: "prepared" }
  /** A frame was spent on preparing the first picture. */
  | { type: "slice"; prepared: boolean }
  /** A frame of the display; figures that are `running` are animated, and `ticked` if time has passed in them. */
  | { type: "frame"; now: number; running: boolean; ticked: boolean }
  | { type: "drawn"; now: number }
  /** A slice of refinement; `better` if it changed the view, `more` if there may be more to do. */
  | { type: "refined"; now: number; better: boolean; more: boolean };

export type DrawEffect =
  | { type: "requestFrame" }
  /** Ends this task, then requests a frame or, with `now`, handles one immediately. */
  | { type: "yield"; now: boolean }
  | { type: "draw" }
  /** Presents the snapshot: that of the painted canvas, or before it is painted. */
  | { type: "present"; painted: boolean }
  /** Requests a frame after `delay` milliseconds. */
  | { type: "rest"; delay: number }
  | { type: "refine" }
  /** Prepares the first picture in idle time. */
  | { type: "warm" }
  /** Stops idle work and the animation clock. */
  | { type: "pause" };

type Next = [State, DrawEffect[]];

/** Time without input before refinement, milliseconds. */
const REST_MS = 120;
/** Time between drawings of a picture that is being refined, milliseconds. */
const SHOW_MS = 150;

export const FRAME: DrawEffect = { type: "requestFrame" };
const PRESENT: DrawEffect = { type: "present", painted: false };

/** Handles the events of a running figure. */
export function draw(state: State, event: DrawEvent): Next {
  switch (event.type) {
    case "input":
      return [outdate({ ...release(state), lastInput: event.now }), [FRAME]];
    case "learned":
      return [outdate(state), [FRAME]];
    case "resized": {
      const next: State = { ...state, room: event.room, picture: "stale" };
      return [event.relayout ? outdate(next) : next, [FRAME]];
    }
    case "recolored":
      return [{ ...state, picture: "stale" }, [FRAME]];
    case "flush":
      return flush(state);
    case "show": {
      const costly = state.phase === "covered" || state.phase === "preparing";
      if (event.hidden || !costly) return flush(state);
      return [release(state), state.poster && state.room ? [FRAME, PRESENT] : [FRAME]];
    }
    case "prepared":
      return [state.phase === "covered" ? { ...state, phase: "warm" } : state, []];
    case "slice": {
      const next: State = event.prepared ? { ...state, phase: "live" } : state;
      const rest: DrawEffect = { type: "yield", now: event.prepared };
      // Everything except the picture is live while the poster is shown.
      return [next, state.poster ? [PRESENT, rest] : [rest]];
    }
    case "frame":
      return onFrame(event.ticked ? outdate(state) : state, event.now, event.running);
    case "drawn":
      return [{ ...state, lastDraw: event.now }, [{ type: "present", painted: true }]];
    case "refined": {
      const { now, better, more } = event;
      const coarse = better || state.picture === "coarse";
      const due = coarse && (!more || now - state.lastDraw > SHOW_MS);
      const picture = due ? "stale" : coarse ? "coarse" : state.picture;
      return [{ ...state, phase: more ? "refining" : "sharp", picture }, more || due ? [FRAME] : []];
    }
  }
}

function onFrame(state: State, now: number, running: boolean): Next {
  const refinable = state.visible && !isCovered(state) && state.phase !== "sharp";
  if (state.picture === "stale") {
    const [next, effects] = update(state);
    // A frame that has drawn does no other work.
    return [next, running || refinable ? [...effects, FRAME] : effects];
  }
  if (running) return [state, [FRAME]];
  if (!refinable) return [state, []];
  const delay = state.lastInput + REST_MS - now;
  if (delay > 0) return [state, [{ type: "rest", delay }]];
  return [{ ...state, phase: "refining" }, [{ type: "refine" }]];
}

function flush(state: State): Next {
  if (!state.room) return [state, []];
  const [next, effects] = update(release(state));
  return [next, isCovered(state) ? [FRAME, ...effects] : effects];
}

/** Updates the picture; if it is covered, only the snapshot. */
function update(state: State): Next {
  if (state.picture !== "stale") return [state, []];
  const next: State = { ...state, picture: "current" };
  if (isCovered(state)) return [next, [PRESENT]];
  return [state.phase === "preparing" ? { ...next, phase: "live" } : next, [{ type: "draw" }]];
}

/** Marks the picture and its refinement as outdated. */
function outdate(state: State): State {
  const phase = state.phase === "refining" || state.phase === "sharp" ? "live" : state.phase;
  return { ...state, phase, picture: "stale" };
}

/** Requests the canvas in place of the poster. */
export function release(state: State): State {
  if (!isCovered(state)) return state;
  return { ...state, phase: state.phase === "warm" ? "live" : "preparing", picture: "stale" };
}

/** Whether a running figure is covered by the poster of its state. */
export function isCovered({ phase }: State): boolean {
  return phase === "covered" || phase === "warm";
}
