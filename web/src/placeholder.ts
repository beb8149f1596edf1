/**
 * The tree that a page brings along, so that a figure has its whole size before any script has run
 * (`web/prerender.mjs` writes it). It cannot be operated, and stays until the living one is ready.
 */

import { setAttribute } from "./dom.js";
import type { Shell } from "./shell.js";
import type { Theme } from "./theme.js";

export class Placeholder {
  readonly #root: HTMLElement;

  /** Takes over what a shadow root holds, if it holds that. */
  static in(shadow: ShadowRoot): Placeholder | undefined {
    const root = [...shadow.children].find((child) => child.matches(".root"));
    return root instanceof HTMLElement ? new Placeholder(root) : undefined;
  }

  constructor(root: HTMLElement) {
    this.#root = root;
    // The page may not carry styles of elements, so what a slider shows of its share is set here.
    for (const input of root.querySelectorAll<HTMLInputElement>("input[type=range]")) {
      const [value, min, max] = [input.value, input.min, input.max].map(Number) as [number, number, number];
      input.style.setProperty("--share", `${((100 * (value - min)) / (max - min || 1)).toFixed(2)}%`);
    }
  }

  /** What has the room of the picture. */
  get picture(): HTMLElement | null {
    return this.#root.querySelector<HTMLElement>(".picture");
  }

  set theme(theme: Theme) {
    setAttribute(this.#root, "data-theme", theme);
  }

  /** Lets the living figure say what goes wrong. */
  lend({ speaker }: Shell): void {
    this.#root.querySelector(".sentences")?.replaceWith(speaker.home);
    this.#root.querySelector(".spoken")?.replaceWith(speaker.region);
  }

  /** Gives its numbers to a figure that has to compute its own first. */
  lendNumbers(shell: Shell): void {
    shell.borrowNumbers(this.#root);
  }

  /** Gives its place to the living figure. */
  yield(shell: Shell): void {
    shell.settle();
    this.#root.replaceWith(shell.root);
    const shadow = shell.root.getRootNode();
    if (shadow instanceof ShadowRoot) for (const link of shadow.querySelectorAll("link")) link.remove();
  }
}
