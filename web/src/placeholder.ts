/**
 * Prerendered tree of a page (`web/prerender.mjs`), which gives a figure its size before any script runs. It cannot be
 * operated, and stays until the figure is ready.
 */

import { setAttribute } from "./dom.js";
import type { Shell } from "./shell.js";
import type { Theme } from "./theme.js";

export class Placeholder {
  readonly #root: HTMLElement;

  /** Returns the placeholder in a shadow root, if any. */
  static in(shadow: ShadowRoot): Placeholder | undefined {
    const root = [...shadow.children].find((child) => child.matches(".root"));
    return root instanceof HTMLElement ? new Placeholder(root) : undefined;
  }

  constructor(root: HTMLElement) {
    this.#root = root;
    // The page has no inline styles, so the fill of its sliders is set here.
    for (const input of root.querySelectorAll<HTMLInputElement>("input[type=range]")) {
      const [value, min, max] = [input.value, input.min, input.max].map(Number) as [number, number, number];
      input.style.setProperty("--share", `${((100 * (value - min)) / (max - min || 1)).toFixed(2)}%`);
    }
  }

  /** Element with the size of the picture. */
  get picture(): HTMLElement | null {
    return this.#root.querySelector<HTMLElement>(".picture");
  }

  set theme(theme: Theme) {
    setAttribute(this.#root, "data-theme", theme);
  }

  /** Shows the notices and the live region of the figure. */
  lend({ speaker }: Shell): void {
    this.#root.querySelector(".sentences")?.replaceWith(speaker.home);
    this.#root.querySelector(".spoken")?.replaceWith(speaker.region);
  }

  /** Shows its numbers in a figure that has not computed its own yet. */
  lendNumbers(shell: Shell): void {
    shell.borrowNumbers(this.#root);
  }

  /** Replaces itself by the figure. */
  yield(shell: Shell): void {
    shell.settle();
    this.#root.replaceWith(shell.root);
    const shadow = shell.root.getRootNode();
    if (shadow instanceof ShadowRoot) for (const link of shadow.querySelectorAll("link")) link.remove();
  }
}
