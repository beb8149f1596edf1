/** Toolbar of a figure: reset, link, picture, full screen, and photographs of the reader. */

import type { FileOffer } from "./contract.js";
import { icon, make, setAttribute, setText } from "./dom.js";

export interface Deeds {
  reset: () => void;
  link: () => string;
  save: () => void;
  saveFile: () => void;
  fullscreen: (() => void) | undefined;
}

const COPIED_MS = 2000;

export class Toolbar {
  readonly element = make("div", { class: "toolbar", role: "group", "aria-label": "Figure" });
  /** The link as text, if it could not be copied. */
  readonly link = make("div", { class: "link", hidden: true });
  readonly #deeds: Deeds;
  #photos: HTMLButtonElement | undefined;
  #file: HTMLButtonElement | undefined;
  readonly #save: HTMLButtonElement;
  readonly #say: (sentence: string) => void;
  #copied: ReturnType<typeof setTimeout> | undefined;

  constructor(deeds: Deeds, say: (sentence: string) => void) {
    this.#deeds = deeds;
    this.#say = say;
    const reset = this.#button("Reset", deeds.reset, "M15.5 10a5.5 5.5 0 1 1-1.8-4.1", "M14.5 2.5v3.8h-3.8");
    const copy = this.#button(
      "Copy link",
      () => void this.#copy(copy),
      "M8.3 11.7a3 3 0 0 0 4.3 0l2.6-2.6a3 3 0 0 0-4.3-4.3l-.9.9",
      "M11.7 8.3a3 3 0 0 0-4.3 0l-2.6 2.6a3 3 0 0 0 4.3 4.3l.9-.9",
    );
    copy.title = "Copy a link to this figure in its present state";
    const save = this.#button("Save image", deeds.save, "M10 3.5v9", "M6.2 9l3.8 3.8L13.8 9", "M4 16.5h12");
    save.title = "Save the picture as a PNG file";
    this.#save = save;
    this.element.append(reset, copy, save);
    if (deeds.fullscreen) {
      const paths = ["M3.5 7.5v-4h4", "M12.5 3.5h4v4", "M16.5 12.5v4h-4", "M7.5 16.5h-4v-4"];
      this.element.append(this.#button("Full screen", deeds.fullscreen, ...paths));
    }
  }

  /** Adds the button that opens and closes the photograph inputs. */
  offerPhotos(panel: HTMLElement): void {
    if (this.#photos) return;
    const paths = ["M3 6.5h3.2l1.3-2h5l1.3 2H17v9.5H3z", "M10 8.2a2.8 2.8 0 1 0 0 5.6a2.8 2.8 0 1 0 0-5.6"];
    const button = this.#button("Photographs", () => this.openPhotos(panel, panel.hidden), ...paths);
    button.title = "Use photographs of your own";
    setAttribute(button, "aria-controls", panel.id);
    setAttribute(button, "aria-expanded", "false");
    this.#photos = button;
    this.element.prepend(button);
  }

  /** Shows the button that saves the figure's data file; removes it for null. */
  offerFile(file: FileOffer | null): void {
    if (!file) {
      this.#file?.remove();
      this.#file = undefined;
      return;
    }
    if (!this.#file) {
      const paths = ["M6 3.5h5.5l3.5 3.5v9.5H6z", "M10.5 8.5v5", "M8.2 11.4l2.3 2.3 2.3-2.3"];
      this.#file = this.#button(file.label, this.#deeds.saveFile, ...paths);
      this.#save.after(this.#file);
    }
    const words = this.#file.querySelector("span");
    if (words) setText(words, file.label);
    setAttribute(this.#file, "title", file.hint);
    setAttribute(this.#file, "aria-disabled", file.is_ready ? undefined : "true");
  }

  openPhotos(panel: HTMLElement, open: boolean): void {
    panel.hidden = !open;
    if (this.#photos) setAttribute(this.#photos, "aria-expanded", String(open));
  }

  #button(label: string, deed: () => void, ...paths: string[]): HTMLButtonElement {
    const button = make("button", { type: "button", title: label }, icon(...paths), make("span", {}, label));
    button.addEventListener("click", deed);
    return button;
  }

  async #copy(button: HTMLButtonElement): Promise<void> {
    const link = this.#deeds.link();
    try {
      await navigator.clipboard.writeText(link);
    } catch {
      this.#show(link);
      return;
    }
    this.link.hidden = true;
    this.#say("Link copied.");
    const label = button.querySelector("span");
    if (!label) return;
    setText(label, "Copied");
    this.end();
    this.#copied = setTimeout(() => setText(label, "Copy link"), COPIED_MS);
  }

  /** Clears the timer, which would keep the whole figure in memory. */
  end(): void {
    clearTimeout(this.#copied);
  }

  /** Shows the link for copying by hand, as clipboards are blocked in some iframes. */
  #show(link: string): void {
    const input = make("input", { type: "text", readonly: true, value: link });
    this.link.replaceChildren(make("label", {}, "Link to this state", input));
    this.link.hidden = false;
    input.focus();
    input.select();
  }
}
