/** Readouts beside the picture: a few large ones that are always visible, the others folded. */

import type { Readout } from "./contract.js";
import { fold, make, setText } from "./dom.js";

/** Number of characters above which a text takes two columns, in a smaller font. */
const LONG = 11;
/** Number of characters above which a text takes a second line. */
const TWO_LINES = 34;

export class Readouts {
  readonly main = make("dl", { class: "readouts main" });
  readonly others = fold("More numbers", "numbers");
  readonly #rest = make("dl", { class: "readouts" });
  #values = new Map<string, HTMLElement>();
  #ids = "";

  constructor() {
    this.others.append(this.#rest);
  }

  /** Shows the readouts; if `only` is given, just those, all large. */
  update(readouts: Readout[], only: string[] | undefined): void {
    const shown = only ? readouts.filter(({ id }) => only.includes(id)) : readouts;
    const main = only ? new Set(only) : mainOf(readouts);
    const ids = shown.map(({ id }) => `${id}${main.has(id) ? "!" : ""}`).join(" ");
    if (ids !== this.#ids) this.#rebuild(shown, main, ids);
    for (const { id, text } of shown) {
      const value = this.#values.get(id);
      if (!value) continue;
      setText(value, text);
      // Cells never shrink, to avoid layout shifts while values change.
      const cell = value.parentElement?.classList;
      if (text.length > LONG) cell?.add("long");
      if (text.length > TWO_LINES) cell?.add("two-lines");
    }
  }

  /** Shows the readouts of a stand-in until the next update. */
  borrow(tree: ParentNode): void {
    // Cloned, since the stand-in is still visible.
    const cells = (part: string) =>
      [...tree.querySelectorAll(`${part} [data-readout]`)].map((cell) => cell.cloneNode(true));
    this.main.replaceChildren(...cells(".readouts.main"));
    this.#rest.replaceChildren(...cells(".numbers"));
    this.main.hidden = !this.main.hasChildNodes();
    this.others.hidden = !this.#rest.hasChildNodes();
    this.#ids = "borrowed";
  }

  /** Returns the element of a readout. */
  elementOf(id: string): HTMLElement | undefined {
    return this.#values.get(id)?.parentElement ?? undefined;
  }

  #rebuild(readouts: Readout[], main: Set<string>, ids: string): void {
    this.#ids = ids;
    this.#values = new Map();
    const cells = readouts.map(({ id, label }) => {
      const value = make("dd");
      this.#values.set(id, value);
      return make("div", { "data-readout": id }, make("dt", {}, label), value);
    });
    const isMain = (cell: HTMLElement) => main.has(cell.dataset["readout"] ?? "");
    this.main.replaceChildren(...cells.filter(isMain));
    this.#rest.replaceChildren(...cells.filter((cell) => !isMain(cell)));
    this.main.hidden = !this.main.hasChildNodes();
    this.others.hidden = !this.#rest.hasChildNodes();
  }
}

/** Returns the ids of the main readouts; of the first two if the figure marks none. */
function mainOf(readouts: Readout[]): Set<string> {
  const said = readouts.filter(({ main }) => main);
  return new Set((said.length > 0 ? said : readouts.slice(0, 2)).map(({ id }) => id));
}
