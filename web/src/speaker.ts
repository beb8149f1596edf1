/** Announcements of a figure: one polite live region, and visible notices. */

import { capitalize, make } from "./dom.js";

/** Time without changes before the figure is described, milliseconds. */
const REST_MS = 300;

export class Speaker {
  /** The figure's only live region. */
  readonly region = make("p", { class: "spoken", role: "status", "aria-live": "polite" });
  /** Visible error messages; the live region announces them as well. */
  readonly notice = make("div", { class: "notice", hidden: true });
  /** Parent of transient notices: an overlay, to avoid layout shifts. Lasting ones are above the picture. */
  readonly #passingHome: HTMLElement;
  readonly home = make("div", { class: "sentences" });
  #timer: ReturnType<typeof setTimeout> | undefined;
  #urgent = "";
  /** Description to announce next; urgent messages do not discard it. */
  #described = "";
  #passing = 0;

  constructor(passingHome: HTMLElement) {
    this.#passingHome = passingHome;
    this.home.append(this.notice);
  }

  /** Announces the figure's description once it has stopped changing. */
  describe(text: string): void {
    this.#described = text;
    this.#later();
  }

  /** Shows and announces messages; transient ones disappear with the figure's next state. */
  warn(sentences: string[], passing = false): void {
    this.#passing = passing ? 2 : 0;
    const home = passing ? this.#passingHome : this.home;
    if (this.notice.parentElement !== home) home.append(this.notice);
    const unique = [...new Set(sentences)];
    this.notice.replaceChildren(...unique.map((sentence) => make("p", {}, sentence)));
    this.notice.hidden = unique.length === 0;
    this.#urgent = unique.join(" ");
    if (unique.length > 0) this.#later();
  }

  /** Shows a message with a button to try again. */
  offer(sentence: string, again: (() => void) | undefined): void {
    this.warn([sentence]);
    if (!again) return;
    const retry = make("button", { type: "button" }, "Try again");
    retry.addEventListener("click", again);
    this.notice.append(retry);
  }

  /** Shows problems with the page's markup in the figure and on the console. */
  complain(messages: string[]): void {
    if (messages.length === 0) return;
    const sentences = messages.map((message) => capitalize(message));
    for (const sentence of sentences) console.warn(`epipole-figure: ${sentence}`);
    this.warn(sentences.map((sentence) => `${sentence}.`));
  }

  /** Announces a message before the description. */
  say(sentence: string): void {
    this.#urgent = `${this.#urgent} ${sentence}`.trim();
    this.#later();
  }

  /** Notes that the figure has a new state. */
  moveOn(): void {
    // The first state is still the one that caused the notice.
    if (this.#passing > 0 && --this.#passing === 0) this.notice.hidden = true;
  }

  silence(): void {
    clearTimeout(this.#timer);
  }

  #later(): void {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => {
      const words = `${this.#urgent} ${this.#described}`.trim();
      this.#urgent = this.#described = "";
      if (words && this.region.textContent !== words) this.region.textContent = words;
    }, REST_MS);
  }
}
