/** Data that figures exchange with the page, as serialized by `epipole-widgets`. */

/** A numeric control. */
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

/** An on/off control. */
export interface Toggle {
  kind: "toggle";
  default: boolean;
  value: boolean;
}

/** A choice between a few options. */
export interface Choice {
  kind: "choice";
  /** Permanent name and label of each option. */
  options: [string, string][];
  default: string;
  value: string;
}

/** A button that triggers an action. */
export interface Button {
  kind: "button";
  role: "run" | "step" | "restart" | "action";
  /** True while its animation is running. */
  pressed: boolean;
}

/** A control with its current value. */
export type Control = {
  id: string;
  label: string;
  /** The value as text, such as "0.30 m". */
  value_text: string;
  /** False if it has no effect at present. */
  enabled: boolean;
  /** Always visible, folded with rarely used controls, or part of the permalink only. */
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
  /** Position in the picture, CSS pixels of the layout. */
  place: [number, number];
}

/** A number or text beside the picture. */
export interface Readout {
  id: string;
  label: string;
  value: number | string;
  unit: string;
  /** The value as displayed, with its unit. */
  text: string;
  /** Whether it is displayed large and always visible; the others are folded. */
  main: boolean;
}

/** A goal for the reader. */
export interface Challenge {
  id: string;
  goal: string;
  hint: string;
  /** Why the solution works, in one sentence. */
  why: string;
  solved: boolean;
}

/** An input for a reader's photograph. */
export interface PhotoSlot {
  id: string;
  label: string;
  /** Longer side in pixels to which larger photographs are downscaled. */
  max_side_px: number;
}

/** A file to save besides the picture. */
export interface FileOffer {
  label: string;
  hint: string;
  extension: string;
  /** Whether the file can be saved already. */
  is_ready: boolean;
}

/** A part of the picture. */
export interface Panel {
  id: string;
  rect: { x: number; y: number; width: number; height: number };
  clickable: boolean;
}

/** A panel that shows a 3D scene. */
export interface Space {
  panel: string;
  /** The handle that rotates the scene; a drag anywhere in the panel moves it. */
  orbit: string;
  /** The handle that pans the scene; dragged with Shift or two fingers. */
  pan: string;
  /** The slider that zooms; Ctrl and the wheel, or pinching. */
  zoom: string;
}

/** A symbol of the text in the picture: a point or a line segment. CSS pixels of the layout. */
export interface PlacedSymbol {
  name: string;
  from: [number, number];
  to: [number, number] | null;
}

/** Everything that the page shows, for one layout width. */
export interface Snapshot {
  /**
   * Shape of the picture: broad ones take the full width, tall ones have the controls beside them.
   */
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
  /** Message while the figure waits for a long computation. */
  waiting: string | null;
}

/** An action of the reader. */
export type FigureEvent =
  | { type: "set"; id: string; value: string | number | boolean }
  | { type: "press"; id: string }
  | { type: "handle-removed"; id: string }
  | { type: "reset" };

/** Step of the verified solution of a challenge. Positions are in the world units of panels. */
export type SolutionEvent =
  | FigureEvent
  | { type: "handle-moved"; id: string; x: number; y: number }
  | { type: "clicked"; panel: string; x: number; y: number }
  | { type: "tick"; dt_s: number };

/** Direction of an arrow key. */
export type Direction = "left" | "right" | "up" | "down";

/** Parameters in permalink order. */
export type Parameters = [key: string, value: string][];

/** A rejected parameter. */
export interface Refused {
  /** True if the figure has no such parameter. */
  unknown: boolean;
  message: string;
}
