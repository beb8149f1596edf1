/**
 * Compact layout for a fixed height: picture, main buttons and readouts. Everything else is in a drawer that opens over
 * the picture, to avoid layout shifts.
 */

import { make, setAttribute, setText } from "./dom.js";
import { shownIn, type Size } from "./room.js";

/** Position of the bar with buttons and readouts. */
type Side = "below" | "beside";

export class Compact {
  /** Part that is always visible next to the picture. */
  readonly bar = make("div", { class: "bar later" });
  /** Drawer with everything else. */
  readonly drawer = make("div", { class: "drawer", id: "drawer", role: "group", "aria-label": "Settings", hidden: true });
  readonly #button = make("button", {
    type: "button",
    class: "opener",
    "aria-expanded": "false",
    "aria-controls": "drawer",
  }, "More");

  constructor() {
    this.#button.addEventListener("click", () => this.open(this.drawer.hidden));
  }

  /** Distributes the elements between bar and drawer. */
  take(staying: Element[], others: Element[]): void {
    this.bar.replaceChildren(...staying, this.#button);
    this.drawer.replaceChildren(...others);
  }

  open(opened: boolean): void {
    this.drawer.hidden = !opened;
    setAttribute(this.#button, "aria-expanded", String(opened));
    setText(this.#button, opened ? "Less" : "More");
  }

  /** Closes the drawer if focus is in it or on its button. Returns whether it did. */
  leave(focused: Element): boolean {
    if (this.drawer.hidden || !(this.drawer.contains(focused) || focused === this.#button)) return false;
    this.open(false);
    this.#button.focus({ preventScroll: true });
    return true;
  }

  /**
   * Chooses the side of the bar that leaves the most room for the picture. `picture` is the element that provides the
   * room; `sizes` holds the size of each layout. Returns the layout width.
   */
  arrange(root: HTMLElement, picture: HTMLElement, sizes: Size[]): number {
    const ways = (["below", "beside"] as Side[]).map((side) => {
      setAttribute(root, "data-compact", side);
      const { bar } = this;
      // A cut-off bar can be scrolled, but is a last resort.
      const cut = bar.scrollHeight > bar.clientHeight + 1 || bar.scrollWidth > bar.clientWidth + 1;
      const style = getComputedStyle(picture);
      const room = {
        width: picture.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight),
        height: picture.clientHeight - parseFloat(style.paddingTop) - parseFloat(style.paddingBottom),
      };
      const { width, shown } = shownIn(room, sizes);
      return { side, width, score: (shown.width * shown.height) / (cut ? 4 : 1) };
    });
    const [below, beside] = ways as [(typeof ways)[0], (typeof ways)[0]];
    const best = beside.score > below.score ? beside : below;
    setAttribute(root, "data-compact", best.side);
    return best.width;
  }
}
