/**
 * A figure in no more height than its host gives: picture, main buttons and numbers. The rest lies in a
 * drawer that opens over the picture, so that nothing moves.
 */

import { make, setAttribute, setText } from "./dom.js";
import { shownIn, type Size } from "./room.js";

/** Where the bar with buttons and numbers is. */
type Side = "below" | "beside";

export class Compact {
  /** What is always there beside the picture. */
  readonly bar = make("div", { class: "bar later" });
  /** Everything else. */
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

  /** Puts what stays into the bar, and the others into the drawer. */
  take(staying: Element[], others: Element[]): void {
    this.bar.replaceChildren(...staying, this.#button);
    this.drawer.replaceChildren(...others);
  }

  open(opened: boolean): void {
    this.drawer.hidden = !opened;
    setAttribute(this.#button, "aria-expanded", String(opened));
    setText(this.#button, opened ? "Less" : "More");
  }

  /** Closes the drawer for whoever is in it or has just opened it; says whether that was so. */
  leave(focused: Element): boolean {
    if (this.drawer.hidden || !(this.drawer.contains(focused) || focused === this.#button)) return false;
    this.open(false);
    this.#button.focus({ preventScroll: true });
    return true;
  }

  /**
   * Puts the bar where it leaves the picture the most room. `picture` is the element that has that room, and
   * `sizes` are those of the picture for each width that it can be laid out for. Returns the width to use.
   */
  arrange(root: HTMLElement, picture: HTMLElement, sizes: Size[]): number {
    const ways = (["below", "beside"] as Side[]).map((side) => {
      setAttribute(root, "data-compact", side);
      const { bar } = this;
      // What does not fit can be scrolled to, but should not have to be.
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
