/** The numbers beside the picture. */

import type { Readout } from "./contract.js";
import { make, setText } from "./dom.js";

/** Longer texts do not fit into the narrowest column: they take the room of two. */
const LONG = 18;

export class Readouts {
  readonly element = make("dl", { class: "readouts" });
  #values = new Map<string, HTMLElement>();
  #ids = "";

  update(readouts: Readout[]): void {
    const ids = readouts.map((readout) => readout.id).join(" ");
    if (ids !== this.#ids) this.#rebuild(readouts, ids);
    for (const readout of readouts) {
      const value = this.#values.get(readout.id);
      if (!value) continue;
      setText(value, readout.text);
      // Once wide, always wide: nothing jumps while numbers change.
      if (readout.text.length > LONG) value.parentElement?.classList.add("long");
    }
    this.element.hidden = readouts.length === 0;
  }

  #rebuild(readouts: Readout[], ids: string): void {
    this.#ids = ids;
    this.#values = new Map();
    const rows = readouts.map((readout) => {
      const value = make("dd");
      this.#values.set(readout.id, value);
      return make("div", { "data-readout": readout.id }, make("dt", {}, readout.label), value);
    });
    this.element.replaceChildren(...rows);
  }
}
