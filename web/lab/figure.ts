/** Figure of the book that explains a step: beside the Lab, or over it on narrow screens. */

function find<T extends HTMLElement>(id: string): T {
  const found = document.getElementById(id);
  if (!found) throw new Error(`the page has no #${id}`);
  return found as T;
}

/** Address of the book's folder. */
const BOOK = new URL("../../", import.meta.url);

/** Loads the custom element on first use. */
const elements = () => import(new URL("embed/epipole.js", BOOK).href);

export class FigureBeside {
  readonly #aside = find("figure");
  readonly #title = find("figure-title");
  readonly #place = find("figure-place");
  readonly #chapter = find<HTMLAnchorElement>("figure-chapter");
  readonly #close = find("figure-close");
  #back: HTMLElement | undefined;

  constructor() {
    this.#close.addEventListener("click", () => this.hide());
    this.#aside.addEventListener("keydown", (event) => {
      if (event.key === "Escape" && !event.defaultPrevented) this.hide();
    });
  }

  async show(name: string, page: string, title: string): Promise<void> {
    const active = document.activeElement;
    if (this.#aside.hidden && active instanceof HTMLElement) this.#back = active;
    this.#title.textContent = title;
    this.#chapter.href = new URL(page, BOOK).href;
    this.#aside.hidden = false;
    document.body.dataset["figure"] = name;
    this.#close.focus();
    if (this.#place.firstElementChild?.getAttribute("name") === name) return;
    this.#place.textContent = "Loading the figure …";
    try {
      await elements();
    } catch (error) {
      console.warn(error);
      this.#place.textContent = "The figure could not be loaded. You will find it in the chapter.";
      return;
    }
    // Another figure may have been opened meanwhile.
    if (document.body.dataset["figure"] !== name) return;
    const figure = document.createElement("epipole-figure");
    figure.setAttribute("name", name);
    this.#place.replaceChildren(figure);
  }

  hide(): void {
    this.#aside.hidden = true;
    delete document.body.dataset["figure"];
    this.#place.replaceChildren();
    this.#back?.focus();
  }
}
