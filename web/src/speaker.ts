/** What a figure says: one polite live region, and notices that everyone sees. */

import { capitalize, make } from "./dom.js";

/** How long the figure must rest before it is described, milliseconds. */
const REST_MS = 300;

export class Speaker {
  /** The figure's only live region. */
  readonly region = make("p", { class: "spoken", role: "status", "aria-live": "polite" });
  /** Problems, to be read by eye; the live region speaks them too. */
  readonly notice = make("div", { class: "notice", hidden: true });
  /** Where passing problems are shown: over something, so that nothing moves. Others stay above it all. */
  readonly #passingHome: HTMLElement;
  readonly home = make("div", { class: "sentences" });
  #timer: ReturnType<typeof setTimeout> | undefined;
  #urgent = "";
  /** What the figure shows, until it is said: nothing urgent makes it forgotten. */
  #described = "";
  #passing = 0;

  constructor(passingHome: HTMLElement) {
    this.#passingHome = passingHome;
    this.home.append(this.notice);
  }

  /** Says what the figure shows, once it has rested. */
  describe(text: string): void {
    this.#described = text;
    this.#later();
  }

  /** Shows sentences above the controls and says them; passing ones go when the figure moves on. */
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

  /** A sentence, and a way on. */
  offer(sentence: string, again: (() => void) | undefined): void {
    this.warn([sentence]);
    if (!again) return;
    const retry = make("button", { type: "button" }, "Try again");
    retry.addEventListener("click", again);
    this.notice.append(retry);
  }

  /** Shows in the figure and on the console what is wrong with what its page has asked for. */
  complain(messages: string[]): void {
    if (messages.length === 0) return;
    const sentences = messages.map((message) => capitalize(message));
    for (const sentence of sentences) console.warn(`epipole-figure: ${sentence}`);
    this.warn(sentences.map((sentence) => `${sentence}.`));
  }

  /** Says something at the next rest, before what the figure shows. */
  say(sentence: string): void {
    this.#urgent = `${this.#urgent} ${sentence}`.trim();
    this.#later();
  }

  /** The figure has taken a new state. */
  moveOn(): void {
    // The first is the state in which the figure has just refused something.
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
