/** Input by mouse, pen, fingers and wheel on a picture. */

import type { Handle, Panel, Snapshot, Space } from "./contract.js";
import { setAttribute } from "./dom.js";
import { ZOOM_STEP, type Handles } from "./handles.js";
import type { Hand, Place } from "./picture.js";
import { Pinch } from "./pinch.js";
import type { Zoom } from "./zoom.js";

/** Distance at which a mouse or pen grabs a handle, pixels; for fingers, the figure decides. */
const FINE_RADIUS = 14;
/** Distance at which a finger grabs the handle of a space, pixels; elsewhere it scrolls the page. */
const FINGER_RADIUS = 22;
/** Wheel delta of one notch, pixels. */
const NOTCH = 100;
/** Maximum movement of a tap, pixels. */
const TAP_SLOP = 10;

/** The picture, as needed by pointers. */
export interface Surface {
  element: HTMLElement;
  sheet: HTMLElement;
  /** Elements on the picture that handle their own events. */
  covers: Element[];
  hand: Hand;
  handles: Handles;
  zoom: Zoom;
}

export class Pointers {
  readonly #surface: Surface;
  readonly #hand: Hand;
  #snapshot: Snapshot | undefined;
  #dragging: { pointer: number; id: string; offset: Place } | undefined;
  #pressing: { pointer: number; place: Place } | undefined;
  readonly #pinch = new Pinch({
    placeOf: (touch) => this.#placeOf(touch),
    spaceAt: (place) => this.#spaceAt(place),
    handle: (id) => this.#snapshot?.handles.find((handle) => handle.id === id),
    zoomOf: (space) => this.#surface.zoom.of(space),
    begin: () => this.#letGo(),
    drag: (id, x, y) => this.#hand.drag(id, x, y),
    zoom: (space, value) => this.#surface.zoom.to(space, value),
  });

  constructor(surface: Surface) {
    this.#surface = surface;
    this.#hand = surface.hand;
    this.#listen();
  }

  update(snapshot: Snapshot): void {
    this.#snapshot = snapshot;
  }

  #listen(): void {
    const stage = this.#surface.element;
    stage.addEventListener("pointerdown", (event) => this.#onDown(event));
    stage.addEventListener("pointermove", (event) => this.#onMove(event));
    stage.addEventListener("pointerup", (event) => this.#onUp(event, true));
    stage.addEventListener("pointercancel", (event) => this.#onUp(event, false));
    stage.addEventListener("lostpointercapture", (event) => this.#onUp(event, false));
    // A finger that starts on a handle must not scroll the page.
    stage.addEventListener(
      "touchstart",
      (event) => {
        const touch = event.touches[0];
        const taken =
          this.#pinch.start(event) ||
          (touch && event.touches.length === 1 && this.#take(this.#placeOf(touch), "touch"));
        if (!taken) return;
        event.preventDefault();
        // A finger that drags must not swipe the page away.
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

  /** Zooms with Ctrl or ⌘, which a two-finger pinch on a touchpad also sends; the wheel alone scrolls the page. */
  #onWheel(event: WheelEvent): void {
    if (!(event.ctrlKey || event.metaKey)) return;
    const space = this.#spaceAt(this.#placeOf(event));
    if (!space) return;
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_PIXEL ? 1 / NOTCH : 1 / 3;
    this.#surface.zoom.by(space, ZOOM_STEP ** (-event.deltaY * lines));
  }

  /** Size of a layout pixel, CSS pixels. */
  get #scale(): number {
    return this.#surface.sheet.clientWidth / (this.#snapshot?.layout.width || 1);
  }

  #spaceAt([x, y]: Place): Space | undefined {
    const panel = this.#snapshot?.layout.panels.find(({ rect }) => {
      const inside = x >= rect.x && x <= rect.x + rect.width;
      return inside && y >= rect.y && y <= rect.y + rect.height;
    });
    return this.#snapshot?.spaces.find((space) => space.panel === panel?.id);
  }

  #placeOf({ clientX, clientY }: { clientX: number; clientY: number }): Place {
    // The poster, if still shown, has the same position.
    const box = this.#surface.sheet.getBoundingClientRect();
    const { width, height } = this.#snapshot?.layout ?? { width: 0, height: 0 };
    return [
      ((clientX - box.left) * width) / (box.width || 1),
      ((clientY - box.top) * height) / (box.height || 1),
    ];
  }

  /** Returns the handle that a pointer at a position grabs. */
  #take([x, y]: Place, pointerType: string): Handle | undefined {
    const id = this.#hand.handleAt(x, y);
    const handle = this.#snapshot?.handles.find((known) => known.id === id);
    if (!handle) return undefined;
    const distance = Math.hypot(handle.place[0] - x, handle.place[1] - y) * this.#scale;
    const space = this.#snapshot?.spaces.some(({ orbit, pan }) => orbit === id || pan === id);
    if (space && pointerType === "touch") return distance <= FINGER_RADIUS ? handle : undefined;
    return pointerType === "touch" || distance <= FINE_RADIUS ? handle : undefined;
  }

  /** Returns the handle that a mouse or pen grabs anywhere in a space; with Shift, the one that pans it. */
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
    // Lists and labels over the picture do not belong to it.
    const { target } = event;
    if (target instanceof Node && this.#surface.covers.some((cover) => cover.contains(target))) return;
    const place = this.#placeOf(event);
    let handle = this.#take(place, event.pointerType) ?? this.#takeSpace(place, event);
    if (!handle && this.#panelAt(place)) {
      if (event.pointerType === "touch") {
        // It may become a scroll, so a tap is recognized only when the finger leaves.
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
    this.#surface.element.setPointerCapture(event.pointerId);
    const offset: Place = [handle.place[0] - place[0], handle.place[1] - place[1]];
    this.#dragging = { pointer: event.pointerId, id: handle.id, offset };
    setAttribute(this.#surface.element, "data-dragging", true);
    this.#surface.handles.focus(handle.id);
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
    setAttribute(this.#surface.element, "data-over", over);
  }

  /** Ends the drag of one finger when a second one arrives. */
  #letGo(): void {
    this.#dragging = this.#pressing = undefined;
    setAttribute(this.#surface.element, "data-dragging", false);
  }

  #onUp(event: PointerEvent, meant: boolean): void {
    if (this.#dragging?.pointer === event.pointerId) {
      this.#dragging = undefined;
      setAttribute(this.#surface.element, "data-dragging", false);
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
