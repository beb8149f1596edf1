/** Handles and crosshairs of a picture as focusable elements with keyboard control. */

import type { Direction, Handle, Panel, Snapshot } from "./contract.js";
import { make, setAttribute } from "./dom.js";
import type { Hand, Place } from "./picture.js";
import type { Zoom } from "./zoom.js";

/** Maximum number of handles with their own focus stops; more share one, with a list to choose from. */
const MOST_FOCUS_STOPS = 12;
/** Zoom factor of a space per press of + or −, or notch of the wheel. */
export const ZOOM_STEP = 1.2;
const FINE_STEPS = 0.2;
const COARSE_STEPS = 5;
const ARROWS: Record<string, Direction> = {
  ArrowLeft: "left",
  ArrowRight: "right",
  ArrowUp: "up",
  ArrowDown: "down",
};

export class Handles {
  readonly marks = make("div", { class: "marks" });
  readonly #select = make("select");
  /** List of handles, if there are many. */
  readonly chooser = make(
    "label",
    { class: "chooser", hidden: true },
    make("span", {}, "Point for the arrow keys"),
    this.#select,
  );
  readonly #hand: Hand;
  readonly #zoom: Zoom;
  readonly #grips = new Map<string, HTMLElement>();
  readonly #crosshairs = new Map<string, { element: HTMLElement; share: Place }>();
  #snapshot: Snapshot | undefined;
  #listed = "";
  #chosen = "";

  constructor(hand: Hand, zoom: Zoom) {
    this.#hand = hand;
    this.#zoom = zoom;
    this.#select.addEventListener("change", () => {
      this.#chosen = this.#select.value;
      this.#refresh();
    });
  }

  /** Updates the handles with their positions in the figure. */
  update(snapshot: Snapshot): void {
    this.#snapshot = snapshot;
    this.#refresh();
  }

  /** Returns the element of a handle. */
  elementOf(id: string): HTMLElement | undefined {
    return this.#grips.get(id);
  }

  /** Focuses a handle. */
  focus(id: string): void {
    this.#chosen = id;
    this.#refresh();
    this.#grips.get(id)?.focus({ preventScroll: true });
  }

  #refresh(): void {
    const snapshot = this.#snapshot;
    if (!snapshot) return;
    const { handles, layout } = snapshot;
    const many = handles.length > MOST_FOCUS_STOPS;
    if (many && !handles.some(({ id }) => id === this.#chosen)) this.#chosen = handles[0]?.id ?? "";
    const stops = many ? handles.filter(({ id }) => id === this.#chosen) : handles;
    this.#list(many ? handles : []);
    for (const handle of stops) this.#placeGrip(handle);
    const gone = [...this.#grips].filter(([id]) => !stops.some((handle) => handle.id === id));
    const panels = layout.panels.filter((panel) => panel.clickable);
    for (const panel of panels) this.#placeCrosshair(panel, panels.length > 1);
    for (const [id, { element }] of this.#crosshairs) {
      element.hidden = !panels.some((panel) => panel.id === id);
    }
    for (const [id, element] of gone) this.#drop(id, element, stops);
  }

  #list(handles: Handle[]): void {
    this.chooser.hidden = handles.length === 0;
    const listed = handles.map(({ id, label }) => `${id} ${label}`).join("|");
    if (listed !== this.#listed) {
      this.#listed = listed;
      const options = handles.map(({ id, label }) => make("option", { value: id }, label));
      this.#select.replaceChildren(...options);
    }
    if (handles.length > 0 && this.#select.value !== this.#chosen) this.#select.value = this.#chosen;
  }

  #placeGrip(handle: Handle): void {
    let grip = this.#grips.get(handle.id);
    if (!grip) {
      const id = handle.id;
      grip = make("div", {
        class: "grip",
        role: "slider",
        tabindex: 0,
        "aria-roledescription": "movable point",
        "data-handle": id,
      });
      grip.addEventListener("keydown", (event) => this.#onGripKey(event, id));
      this.#grips.set(id, grip);
      // Handles come before crosshairs in Tab order, whenever they are added.
      this.marks.insertBefore(grip, this.marks.querySelector(".crosshair"));
    }
    const sideways = handle.x_range[0] < handle.x_range[1];
    const [low, high] = sideways ? handle.x_range : handle.y_range;
    setAttribute(grip, "aria-label", handle.label);
    setAttribute(grip, "aria-valuemin", low);
    setAttribute(grip, "aria-valuemax", high);
    setAttribute(grip, "aria-valuenow", sideways ? handle.x : handle.y);
    setAttribute(grip, "aria-valuetext", handle.value_text);
    setAttribute(grip, "aria-keyshortcuts", handle.removable ? "Delete" : undefined);
    this.#put(grip, handle.place);
  }

  /** Removes a handle; its focus moves to the next, so that keyboard focus is not lost. */
  #drop(id: string, element: HTMLElement, stops: Handle[]): void {
    const focused = element.matches(":focus");
    element.remove();
    this.#grips.delete(id);
    if (!focused) return;
    const heir = this.#grips.get(stops[0]?.id ?? "") ?? this.#crosshairs.values().next().value?.element;
    heir?.focus({ preventScroll: true });
  }

  #placeCrosshair(panel: Panel, named: boolean): void {
    let crosshair = this.#crosshairs.get(panel.id);
    if (!crosshair) {
      const element = make("div", {
        class: "crosshair",
        role: "slider",
        tabindex: 0,
        "aria-roledescription": "crosshair",
        "aria-label": `Crosshair${named ? ` in ${panel.id}` : ""}: Enter clicks there`,
        "aria-valuemin": 0,
        "aria-valuemax": 100,
      });
      const made = { element, share: [0.5, 0.5] as Place };
      element.addEventListener("keydown", (event) => this.#onCrosshairKey(event, panel.id));
      this.#crosshairs.set(panel.id, made);
      this.marks.append(element);
      crosshair = made;
    }
    const { element, share } = crosshair;
    const across = Math.round(100 * share[0]);
    setAttribute(element, "aria-valuenow", across);
    setAttribute(
      element,
      "aria-valuetext",
      `${across} percent across, ${Math.round(100 * share[1])} percent down`,
    );
    this.#put(element, inPanel(panel, share));
  }

  #put(element: HTMLElement, [x, y]: Place): void {
    const layout = this.#snapshot?.layout;
    if (!layout) return;
    element.style.left = `${(100 * x) / layout.width}%`;
    element.style.top = `${(100 * y) / layout.height}%`;
  }

  #onGripKey(event: KeyboardEvent, id: string): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const handle = this.#snapshot?.handles.find((known) => known.id === id);
    if (!handle) return;
    const sideways = handle.x_range[0] < handle.x_range[1];
    const upright = handle.y_range[0] < handle.y_range[1];
    const arrow = ARROWS[event.key];
    const space = this.#snapshot?.spaces.find(({ orbit, pan }) => orbit === id || pan === id);
    const larger = event.key === "+" || event.key === "=";
    if (space && (larger || event.key === "-")) this.#zoom.by(space, larger ? ZOOM_STEP : 1 / ZOOM_STEP);
    else if (arrow) this.#hand.nudge(id, arrow, event.shiftKey ? FINE_STEPS : 1);
    else if (event.key === "PageUp") this.#hand.nudge(id, upright ? "up" : "right", COARSE_STEPS);
    else if (event.key === "PageDown") this.#hand.nudge(id, upright ? "down" : "left", COARSE_STEPS);
    else if (event.key === "Home") this.#hand.moveToEnd(id, sideways ? "left" : "down");
    else if (event.key === "End") this.#hand.moveToEnd(id, sideways ? "right" : "up");
    else if (event.key === "Delete" || event.key === "Backspace") {
      if (!handle.removable) return;
      this.#hand.remove(id);
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  #onCrosshairKey(event: KeyboardEvent, id: string): void {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const crosshair = this.#crosshairs.get(id);
    const panel = this.#snapshot?.layout.panels.find((known) => known.id === id);
    if (!crosshair || !panel) return;
    const arrow = ARROWS[event.key];
    const step = event.shiftKey ? 0.01 : 0.05;
    const [x, y] = crosshair.share;
    const moved: Record<Direction, Place> = {
      left: [x - step, y],
      right: [x + step, y],
      up: [x, y - step],
      down: [x, y + step],
    };
    if (arrow) {
      const [across, down] = moved[arrow];
      crosshair.share = [Math.min(Math.max(across, 0), 1), Math.min(Math.max(down, 0), 1)];
      this.#placeCrosshair(panel, (this.#crosshairs.size ?? 0) > 1);
    } else if (event.key === "Enter" || event.key === " ") {
      this.#hand.click(...inPanel(panel, crosshair.share));
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }
}

function inPanel({ rect }: Panel, [across, down]: Place): Place {
  return [rect.x + across * rect.width, rect.y + down * rect.height];
}
