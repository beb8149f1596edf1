/** The canvas with its overlays: focusable handles, crosshairs for the keyboard, pointer input. */

import type { Direction, Handle, Panel, Snapshot, Space } from "./contract.js";
import { make, setAttribute } from "./dom.js";
import { Lit } from "./lit.js";
import { Pinch } from "./pinch.js";

/** Actions of the reader in the picture. Positions are CSS pixels of the layout. */
export interface Hand {
  handleAt: (x: number, y: number) => string | undefined;
  drag: (id: string, x: number, y: number) => void;
  nudge: (id: string, towards: Direction, steps: number) => void;
  moveToEnd: (id: string, towards: Direction) => void;
  remove: (id: string) => void;
  click: (x: number, y: number) => void;
  set: (id: string, value: number) => void;
}

/**
 * Maximum number of handles with a focus stop each; beyond it, one stop and a list replace them.
 */
const MOST_FOCUS_STOPS = 12;
/** Radius in which a mouse or pen takes a handle, CSS pixels; for touch, the figure decides. */
const FINE_RADIUS = 14;
/**
 * Radius in which a finger takes the handle that rotates a 3D scene; elsewhere it scrolls the page.
 */
const FINGER_RADIUS = 22;
/** Zoom factor of one press of + or −, or of one notch of the wheel. */
const ZOOM_STEP = 1.2;
/** Wheel delta of one notch, pixels. */
const NOTCH = 100;
/** Maximum movement of a finger during a tap, CSS pixels. */
const TAP_SLOP = 10;
const FINE_STEPS = 0.2;
const COARSE_STEPS = 5;
const ARROWS: Record<string, Direction> = {
  ArrowLeft: "left",
  ArrowRight: "right",
  ArrowUp: "up",
  ArrowDown: "down",
};

export type Place = [x: number, y: number];

export class Picture {
  /** Container that reserves room for the picture. */
  readonly element = make("div", { class: "picture" });
  /** The picture itself, narrower than its container where height is limited. */
  readonly sheet = make("div", { class: "sheet" });
  /** Overlay at the lower edge, for temporary messages. */
  readonly overlay = make("div", { class: "overlay" });
  readonly canvas = make("canvas", { role: "img", hidden: true });
  readonly #hand: Hand;
  readonly #lit = new Lit();
  readonly #marks = make("div", { class: "marks" });
  readonly #chooser = make("select");
  readonly #chooserBox = make(
    "label",
    { class: "chooser", hidden: true },
    make("span", {}, "Point for the arrow keys"),
    this.#chooser,
  );
  readonly #grips = new Map<string, HTMLElement>();
  readonly #crosshairs = new Map<string, { element: HTMLElement; share: Place }>();
  #snapshot: Snapshot | undefined;
  /** Zoom values not in the snapshot yet, as keys may repeat faster than frames. */
  readonly #sizes = new Map<string, number>();
  #listed = "";
  #chosen = "";
  #dragging: { pointer: number; id: string; offset: Place } | undefined;
  #pressing: { pointer: number; place: Place } | undefined;
  readonly #pinch = new Pinch({
    placeOf: (touch) => this.#placeOf(touch),
    spaceAt: (place) => this.#spaceAt(place),
    handle: (id) => this.#snapshot?.handles.find((handle) => handle.id === id),
    zoomOf: (space) => this.#zoomOf(space)?.value ?? 1,
    begin: () => this.#letGo(),
    drag: (id, x, y) => this.#hand.drag(id, x, y),
    zoom: (space, value) => this.#zoomTo(space, value),
  });

  constructor(hand: Hand) {
    this.#hand = hand;
    this.sheet.append(make("slot"), this.canvas, this.#chooserBox, this.#lit.element, this.#marks);
    this.element.append(this.sheet, this.overlay);
    this.#chooser.addEventListener("change", () => {
      this.#chosen = this.#chooser.value;
      this.#refresh();
    });
    this.#listen();
  }

  /** Updates the handles' positions. */
  update(snapshot: Snapshot): void {
    this.#snapshot = snapshot;
    this.#sizes.clear();
    const { width, height } = snapshot.layout;
    this.sheet.style.setProperty("--ratio", String(width / height));
    setAttribute(this.canvas, "aria-label", snapshot.description);
    this.#lit.update(snapshot);
    this.#refresh();
  }

  /** Highlights a symbol of the text and no other. Returns whether the picture has it. */
  light(symbol: string | undefined): boolean {
    return this.#lit.show(symbol, this.#snapshot);
  }

  /** The element of a handle. */
  elementOf(id: string): HTMLElement | undefined {
    return this.#grips.get(id);
  }

  /** Replaces the poster by the canvas. */
  reveal(): void {
    if (!this.canvas.hidden) return;
    this.canvas.hidden = false;
    const slot = this.element.querySelector("slot");
    if (slot) slot.hidden = true;
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
    this.#chooserBox.hidden = handles.length === 0;
    const listed = handles.map(({ id, label }) => `${id} ${label}`).join("|");
    if (listed !== this.#listed) {
      this.#listed = listed;
      const options = handles.map(({ id, label }) => make("option", { value: id }, label));
      this.#chooser.replaceChildren(...options);
    }
    if (handles.length > 0 && this.#chooser.value !== this.#chosen) this.#chooser.value = this.#chosen;
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
      // Keep handles before crosshairs in Tab order.
      this.#marks.insertBefore(grip, this.#marks.querySelector(".crosshair"));
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

  /** Removes a handle; its focus moves to the next one, so that the keyboard keeps working. */
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
      this.#marks.append(element);
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
    if (space && (larger || event.key === "-")) this.#zoomBy(space, larger ? ZOOM_STEP : 1 / ZOOM_STEP);
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

  #listen(): void {
    const stage = this.element;
    stage.addEventListener("pointerdown", (event) => this.#onDown(event));
    stage.addEventListener("pointermove", (event) => this.#onMove(event));
    stage.addEventListener("pointerup", (event) => this.#onUp(event, true));
    stage.addEventListener("pointercancel", (event) => this.#onUp(event, false));
    stage.addEventListener("lostpointercapture", (event) => this.#onUp(event, false));
    // Touch on a handle must not scroll the page; elsewhere it may.
    stage.addEventListener(
      "touchstart",
      (event) => {
        const touch = event.touches[0];
        const taken =
          this.#pinch.start(event) ||
          (touch && event.touches.length === 1 && this.#take(this.#placeOf(touch), "touch"));
        if (!taken) return;
        event.preventDefault();
        // A drag must not trigger swipe gestures of the page.
        event.stopPropagation();
      },
      { passive: false },
    );
    const onTouchMove = (event: TouchEvent) => {
      if (this.#dragging) event.stopPropagation();
      this.#pinch.move(event);
    };
    stage.addEventListener("touchmove", onTouchMove, { passive: false });
    for (const type of ["touchend", "touchcancel"]) stage.addEventListener(type, () => this.#pinch.end());
    stage.addEventListener("wheel", (event) => this.#onWheel(event), { passive: false });
  }

  /** Zooms with Ctrl or ⌘ (touchpad pinches set Ctrl); otherwise the wheel scrolls the page. */
  #onWheel(event: WheelEvent): void {
    if (!(event.ctrlKey || event.metaKey)) return;
    const space = this.#spaceAt(this.#placeOf(event));
    if (!space) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 / NOTCH : 1 / 3;
    this.#zoomBy(space, ZOOM_STEP ** (-event.deltaY * lines));
  }

  #zoomOf(space: Space) {
    const control = this.#snapshot?.controls.find(({ id }) => id === space.zoom);
    return control?.kind === "slider" ? control : undefined;
  }

  #zoomTo(space: Space, value: number): void {
    const slider = this.#zoomOf(space);
    if (!slider) return;
    const size = Math.min(Math.max(value, slider.min), slider.max);
    this.#sizes.set(space.zoom, size);
    this.#hand.set(space.zoom, size);
  }

  /** Zooms a 3D scene, by at least one step of its slider. */
  #zoomBy(space: Space, factor: number): void {
    const slider = this.#zoomOf(space);
    if (!slider || factor === 1) return;
    const size = this.#sizes.get(space.zoom) ?? slider.value;
    const step = Math.max(Math.abs(size * (factor - 1)), slider.step);
    this.#zoomTo(space, size + (factor > 1 ? step : -step));
  }

  /** CSS pixels per pixel of the layout. */
  get #scale(): number {
    return this.sheet.clientWidth / (this.#snapshot?.layout.width || 1);
  }

  #spaceAt([x, y]: Place): Space | undefined {
    const panel = this.#snapshot?.layout.panels.find(({ rect }) => {
      const inside = x >= rect.x && x <= rect.x + rect.width;
      return inside && y >= rect.y && y <= rect.y + rect.height;
    });
    return this.#snapshot?.spaces.find((space) => space.panel === panel?.id);
  }

  #placeOf({ clientX, clientY }: { clientX: number; clientY: number }): Place {
    // The poster, if still shown, has the same box.
    const box = this.sheet.getBoundingClientRect();
    const { width, height } = this.#snapshot?.layout ?? { width: 0, height: 0 };
    return [
      ((clientX - box.left) * width) / (box.width || 1),
      ((clientY - box.top) * height) / (box.height || 1),
    ];
  }

  /** The handle that a pointer at a position takes. */
  #take([x, y]: Place, pointerType: string): Handle | undefined {
    const id = this.#hand.handleAt(x, y);
    const handle = this.#snapshot?.handles.find((known) => known.id === id);
    if (!handle) return undefined;
    const distance = Math.hypot(handle.place[0] - x, handle.place[1] - y) * this.#scale;
    const space = this.#snapshot?.spaces.some(({ orbit, pan }) => orbit === id || pan === id);
    if (space && pointerType === "touch") return distance <= FINGER_RADIUS ? handle : undefined;
    return pointerType === "touch" || distance <= FINE_RADIUS ? handle : undefined;
  }

  /** The handle that a mouse or pen drags anywhere in a 3D scene: orbit, or pan with Shift. */
  #takeSpace(place: Place, event: PointerEvent): Handle | undefined {
    const space = event.pointerType === "touch" ? undefined : this.#spaceAt(place);
    const id = event.shiftKey ? space?.pan : space?.orbit;
    return this.#snapshot?.handles.find((handle) => handle.id === id);
  }

  #panelAt([x, y]: Place): Panel | undefined {
    return this.#snapshot?.layout.panels.find(({ rect, clickable }) => {
      const inside = x >= rect.x && x <= rect.x + rect.width;
      return clickable && inside && y >= rect.y && y <= rect.y + rect.height;
    });
  }

  #onDown(event: PointerEvent): void {
    if (!event.isPrimary || event.button !== 0) return;
    // Overlays on the picture are not part of it.
    const lies = [this.#chooserBox, this.overlay];
    if (event.target instanceof Node && lies.some((over) => over.contains(event.target as Node))) return;
    const place = this.#placeOf(event);
    let handle = this.#take(place, event.pointerType) ?? this.#takeSpace(place, event);
    if (!handle && this.#panelAt(place)) {
      if (event.pointerType === "touch") {
        // This may become a scroll; a tap is recognized on pointerup.
        this.#pressing = { pointer: event.pointerId, place };
        return;
      }
      this.#hand.click(...place);
      handle = this.#take(place, event.pointerType);
    }
    if (handle) this.#grab(event, handle, place);
  }

  #grab(event: PointerEvent, handle: Handle, place: Place): void {
    event.preventDefault();
    event.stopPropagation();
    this.element.setPointerCapture(event.pointerId);
    const offset: Place = [handle.place[0] - place[0], handle.place[1] - place[1]];
    this.#dragging = { pointer: event.pointerId, id: handle.id, offset };
    setAttribute(this.element, "data-dragging", true);
    this.#chosen = handle.id;
    this.#refresh();
    this.#grips.get(handle.id)?.focus({ preventScroll: true });
  }

  #onMove(event: PointerEvent): void {
    const place = this.#placeOf(event);
    const drag = this.#dragging;
    if (drag?.pointer === event.pointerId) {
      event.stopPropagation();
      this.#hand.drag(drag.id, place[0] + drag.offset[0], place[1] + drag.offset[1]);
      return;
    }
    if (event.pointerType !== "mouse" || event.buttons !== 0) return;
    const held = this.#take(place, "mouse") ?? this.#takeSpace(place, event);
    const over = held ? "handle" : this.#panelAt(place) ? "panel" : undefined;
    setAttribute(this.element, "data-over", over);
  }

  /** Ends a one-finger drag or press when a second finger touches. */
  #letGo(): void {
    this.#dragging = this.#pressing = undefined;
    setAttribute(this.element, "data-dragging", false);
  }

  #onUp(event: PointerEvent, meant: boolean): void {
    if (this.#dragging?.pointer === event.pointerId) {
      this.#dragging = undefined;
      setAttribute(this.element, "data-dragging", false);
    }
    const press = this.#pressing;
    if (press?.pointer !== event.pointerId) return;
    this.#pressing = undefined;
    const [x, y] = this.#placeOf(event);
    if (meant && Math.hypot(x - press.place[0], y - press.place[1]) * this.#scale <= TAP_SLOP) {
      this.#hand.click(...press.place);
    }
  }
}

function inPanel({ rect }: Panel, [across, down]: Place): Place {
  return [rect.x + across * rect.width, rect.y + down * rect.height];
}
