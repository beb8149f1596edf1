/** Data that figures and pages exchange. Written by `make bless-contract` from `epipole-widgets`. */

/**
 * A figure's current state, laid out for a page width.
 */
export type Snapshot = { layout: Layout, aspect: Aspect, controls: Array<Control>, handles: Array<Handle>, spaces: Array<Space>, symbols: Array<PlacedSymbol>, readouts: Array<Readout>, challenges: Array<Challenge>, description: string, running: boolean, photos: Array<PhotoSlot>, 
/**
 * Photographs of the reader's own have still to be chosen.
 */
wants_photos: boolean, 
/**
 * File that can be saved besides the picture.
 */
file: FileOffer | null, 
/**
 * Status while the figure waits for a long computation.
 */
waiting: string | null, };

/**
 * Aspect of a figure's picture on wide pages, from which a page arranges everything else.
 */
export type Aspect = "broad" | "tall";

/**
 * The picture's size and its panels, for one width of the page.
 */
export type Layout = { 
/**
 * Width, CSS pixels.
 */
width: number, 
/**
 * Height, CSS pixels.
 */
height: number, 
/**
 * The panels; none overlap.
 */
panels: Array<Panel>, };

/**
 * A part of the picture with its own world: a photograph, a plot, a view from above.
 */
export type Panel = { 
/**
 * Permanent name.
 */
id: string, 
/**
 * Rectangle on the page, CSS pixels.
 */
rect: { x: number; y: number; width: number; height: number }, 
/**
 * World units from left to right.
 */
x_axis: Axis, 
/**
 * World units from top to bottom.
 */
y_axis: Axis, 
/**
 * Whether a click away from handles has an effect here.
 */
clickable: boolean, };

/**
 * Mapping of one world coordinate along one side of a panel.
 */
export type Axis = { 
/**
 * World value at the panel's left or top edge.
 */
start: number, 
/**
 * World value at the panel's right or bottom edge; smaller than `start` for an axis that runs
 * up.
 */
end: number, };

/**
 * A control with its present value: what a page needs to show it.
 */
export type Control = { 
/**
 * Permanent name.
 */
id: string, 
/**
 * Label shown to the reader.
 */
label: string, 
/**
 * The value in words for a screen reader, such as "0.30 m".
 */
value_text: string, 
/**
 * False when it can do nothing now; it stays discoverable.
 */
enabled: boolean, 
/**
 * Placement on the page.
 */
place: Place, } & ({ "kind": "slider", 
/**
 * Unit after the value.
 */
unit: string, 
/**
 * Smallest value.
 */
min: number, 
/**
 * Largest value.
 */
max: number, 
/**
 * Distance between neighboring values.
 */
step: number, 
/**
 * Value at the start.
 */
default: number, 
/**
 * Digits after the decimal point.
 */
digits: number, 
/**
 * Present value.
 */
value: number, } | { "kind": "toggle", 
/**
 * State at the start.
 */
default: boolean, 
/**
 * Present state.
 */
value: boolean, } | { "kind": "choice", 
/**
 * Permanent name and label of each option.
 */
options: Array<[string, string]>, 
/**
 * Permanent name of the option at the start.
 */
default: string, 
/**
 * Permanent name of the present option.
 */
value: string, } | { "kind": "button", 
/**
 * Kind of action.
 */
role: ButtonRole, 
/**
 * True while the animation that it starts is running.
 */
pressed: boolean, });

/**
 * The four kinds of control.
 */
export type ControlKind = { "kind": "slider", 
/**
 * Unit after the value.
 */
unit: string, 
/**
 * Smallest value.
 */
min: number, 
/**
 * Largest value.
 */
max: number, 
/**
 * Distance between neighboring values.
 */
step: number, 
/**
 * Value at the start.
 */
default: number, 
/**
 * Digits after the decimal point.
 */
digits: number, 
/**
 * Present value.
 */
value: number, } | { "kind": "toggle", 
/**
 * State at the start.
 */
default: boolean, 
/**
 * Present state.
 */
value: boolean, } | { "kind": "choice", 
/**
 * Permanent name and label of each option.
 */
options: Array<[string, string]>, 
/**
 * Permanent name of the option at the start.
 */
default: string, 
/**
 * Permanent name of the present option.
 */
value: string, } | { "kind": "button", 
/**
 * Kind of action.
 */
role: ButtonRole, 
/**
 * True while the animation that it starts is running.
 */
pressed: boolean, };

/**
 * Kind of action of a button, from which a page chooses its position and icon.
 */
export type ButtonRole = "run" | "step" | "restart" | "action";

/**
 * Placement of a control on the page.
 */
export type Place = "first" | "more" | "hidden";

/**
 * A handle with its position on the page, CSS pixels.
 */
export type Handle = { place: [number, number], 
/**
 * Permanent name; also its URL parameter, with the value `x,y`.
 */
id: string, 
/**
 * Name of its panel.
 */
panel: string, 
/**
 * Label for screen readers.
 */
label: string, 
/**
 * Position in words, such as "2.80 m away, 0.40 m to the right".
 */
value_text: string, 
/**
 * x in world units.
 */
x: number, 
/**
 * y in world units.
 */
y: number, 
/**
 * Smallest and largest x.
 */
x_range: [number, number], 
/**
 * Smallest and largest y.
 */
y_range: [number, number], 
/**
 * Step of an arrow key along x and y, world units.
 */
step: [number, number], 
/**
 * Digits after the decimal point of its position.
 */
digits: number, 
/**
 * Whether the reader may remove it.
 */
removable: boolean, };

/**
 * A panel whose contents the reader turns, moves and zooms.
 *
 * Its state is two handles and a slider, so that keys, permalinks and tests cover it. Pointers
 * have shortcuts: a drag anywhere in the panel moves the handle `orbit`, a drag with Shift moves
 * `pan`; two fingers move `pan` and, spread, the slider.
 */
export type Space = { 
/**
 * Name of the panel.
 */
panel: string, 
/**
 * Handle that turns the scene.
 */
orbit: string, 
/**
 * Handle that moves the scene across the panel.
 */
pan: string, 
/**
 * Slider that zooms.
 */
zoom: string, };

/**
 * A symbol with its position on the page, CSS pixels.
 */
export type PlacedSymbol = { name: string, 
/**
 * A point, or one end of a line.
 */
from: [number, number], 
/**
 * The other end.
 */
to: [number, number] | null, };

/**
 * A value with its label and unit.
 */
export type Readout = { 
/**
 * Permanent name.
 */
id: string, 
/**
 * Label shown to the reader.
 */
label: string, 
/**
 * The value.
 */
value: ReadoutValue, 
/**
 * Unit after a number; empty for a pure number.
 */
unit: string, 
/**
 * The value as shown, with its unit.
 */
text: string, 
/**
 * Whether it carries the figure's point: it is then large and always shown. The others fold.
 */
main: boolean, };

/**
 * Value of a readout.
 */
export type ReadoutValue = number | string;

/**
 * A challenge with whether it is solved now.
 */
export type Challenge = { 
/**
 * Permanent name.
 */
id: string, 
/**
 * The goal as a request to the reader.
 */
goal: string, 
/**
 * A nudge for a reader who is stuck.
 */
hint: string, 
/**
 * Why that reaches it, in one sentence.
 */
why: string, 
/**
 * Whether the present state reaches the goal.
 */
solved: boolean, };

/**
 * A slot for a photograph of the reader's own.
 */
export type PhotoSlot = { 
/**
 * Permanent name.
 */
id: string, 
/**
 * Label shown to the reader, such as "Left photograph".
 */
label: string, 
/**
 * Largest useful width or height, pixels; a page downscales larger photographs and reports it.
 */
max_side_px: number, };

/**
 * A file that a figure offers, such as a point cloud for other programs.
 */
export type FileOffer = { 
/**
 * Label of the button.
 */
label: string, 
/**
 * Contents of the file and its use, as a tooltip.
 */
hint: string, 
/**
 * Extension of the file name, without the dot.
 */
extension: string, 
/**
 * Whether the file can be saved now.
 */
is_ready: boolean, };

/**
 * An input from the reader, from a permalink or from the clock.
 */
export type FigureEvent = { "type": "set", 
/**
 * The control.
 */
id: string, 
/**
 * Its new value.
 */
value: Value, } | { "type": "press", 
/**
 * The control.
 */
id: string, } | { "type": "handle-moved", 
/**
 * The handle.
 */
id: string, 
/**
 * New place in the world units of its panel.
 */
x: number, 
/**
 * New place in the world units of its panel.
 */
y: number, } | { "type": "handle-removed", 
/**
 * The handle.
 */
id: string, } | { "type": "clicked", 
/**
 * The panel.
 */
panel: string, 
/**
 * Place in the panel's world units.
 */
x: number, 
/**
 * Place in the panel's world units.
 */
y: number, } | { "type": "tick", 
/**
 * Seconds since the last tick.
 */
dt_s: number, } | { "type": "reset" };

/**
 * The value of a control, from an attribute, a URL or an input of the page.
 */
export type Value = boolean | number | string;

/**
 * Direction of an arrow key on the page.
 */
export type Direction = "left" | "right" | "up" | "down";

/**
 * A rejected parameter.
 */
export type Refused = { 
/**
 * True if the figure has no such parameter: one in the page's address may belong to another
 * script.
 */
unknown: boolean, 
/**
 * The reason, as a sentence.
 */
message: string, };
