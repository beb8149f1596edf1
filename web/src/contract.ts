/** What a figure says of itself: the plain data of `epipole-widgets`, as it arrives here. */

/** A number that the reader slides. */
export interface Slider {
  kind: "slider";
  unit: string;
  min: number;
  max: number;
  step: number;
  default: number;
  digits: number;
  value: number;
}

/** Something that is on or off. */
export interface Toggle {
  kind: "toggle";
  default: boolean;
  value: boolean;
}

/** One of a few named options. */
export interface Choice {
  kind: "choice";
  /** Permanent name and label of each option. */
  options: [string, string][];
  default: string;
  value: string;
}

/** Something that happens when pressed. */
export interface Button {
  kind: "button";
  role: "run" | "step" | "restart" | "action";
  /** True while the animation that it starts is running. */
  pressed: boolean;
}

/** A control with its present value. */
export type Control = {
  id: string;
  label: string;
  /** The value in words, such as "0.30 m". */
  value_text: string;
  /** False when it can do nothing now. */
  enabled: boolean;
  /** Always there, folded with what a reader seldom wants, or part of the permalink only. */
  place: "first" | "more" | "hidden";
} & (Slider | Toggle | Choice | Button);

/** A draggable point. */
export interface Handle {
  id: string;
  panel: string;
  label: string;
  value_text: string;
  x: number;
  y: number;
  x_range: [number, number];
  y_range: [number, number];
  step: [number, number];
  digits: number;
  removable: boolean;
  /** Where it is in the picture, CSS pixels of the layout. */
  place: [number, number];
}

/** A number or words beside the picture. */
export interface Readout {
  id: string;
  label: string;
  value: number | string;
  unit: string;
  /** The value as shown, with its unit. */
  text: string;
  /** Whether it carries the figure's point: then it is large and always there. The others fold. */
  main: boolean;
}

/** A goal for the reader. */
export interface Challenge {
  id: string;
  goal: string;
  hint: string;
  /** Why that reaches it, in one sentence. */
  why: string;
  solved: boolean;
}

/** A place for a photograph of the reader's own. */
export interface PhotoSlot {
  id: string;
  label: string;
  /** Larger photographs are made smaller. */
  max_side_px: number;
}

/** What can be saved besides the picture. */
export interface FileOffer {
  label: string;
  hint: string;
  extension: string;
  /** Whether there is something to save already. */
  is_ready: boolean;
}

/** A part of the picture. */
export interface Panel {
  id: string;
  rect: { x: number; y: number; width: number; height: number };
  clickable: boolean;
}

/** A panel that shows things in three dimensions. */
export interface Space {
  panel: string;
  /** The handle that turns them; a drag from anywhere in the panel moves it. */
  orbit: string;
  /** The handle that moves them across the panel; a drag with Shift, or two fingers. */
  pan: string;
  /** The slider that enlarges them; the wheel with Ctrl, or two fingers spread. */
  zoom: string;
}

/** A letter of the book that the picture shows: a point, or a line between two. CSS pixels of the layout. */
export interface PlacedSymbol {
  name: string;
  from: [number, number];
  to: [number, number] | null;
}

/** Everything that a page shows, for one width of the picture. */
export interface Snapshot {
  /** The picture's: broad ones take the whole width, beside tall ones stands what the reader moves. */
  aspect: "broad" | "tall";
  layout: { width: number; height: number; panels: Panel[] };
  controls: Control[];
  handles: Handle[];
  spaces: Space[];
  symbols: PlacedSymbol[];
  readouts: Readout[];
  challenges: Challenge[];
  description: string;
  running: boolean;
  photos: PhotoSlot[];
  file: FileOffer | null;
  /** What to say while the figure waits for a long computation. */
  waiting: string | null;
}

/** What the reader does. */
export type FigureEvent =
  | { type: "set"; id: string; value: string | number | boolean }
  | { type: "press"; id: string }
  | { type: "handle-removed"; id: string }
  | { type: "reset" };

/** What the proven solution of a challenge consists of. Places are in the world units of panels. */
export type SolutionEvent =
  | FigureEvent
  | { type: "handle-moved"; id: string; x: number; y: number }
  | { type: "clicked"; panel: string; x: number; y: number }
  | { type: "tick"; dt_s: number };

/** Where an arrow key points. */
export type Direction = "left" | "right" | "up" | "down";

/** Parameters in their order, as in a permalink. */
export type Parameters = [key: string, value: string][];

/** A parameter that could not be used. */
export interface Refused {
  /** True if the figure has no such parameter. */
  unknown: boolean;
  message: string;
}
