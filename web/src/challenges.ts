/** Goals for the reader, and which are reached. A goal once reached stays reached. */

import type { Challenge } from "./contract.js";
import { icon, make, setAttribute, setText } from "./dom.js";

interface Item {
  element: HTMLElement;
  mark: HTMLElement;
}

export class Challenges {
  readonly element = make("div", { class: "challenges", role: "group", "aria-label": "Challenges" });
  readonly #list = make("ol");
  readonly #title = make("p", { class: "heading" });
  readonly #items = new Map<string, Item>();
  readonly #solved = new Set<string>();

  constructor() {
    this.element.append(this.#title, this.#list);
  }

  /** Shows the goals and returns those that have just been reached for the first time. */
  update(challenges: Challenge[]): Challenge[] {
    const news = challenges.filter(({ id, solved }) => solved && !this.#solved.has(id));
    for (const { id } of news) this.#solved.add(id);
    for (const challenge of challenges) {
      const item = this.#items.get(challenge.id) ?? this.#add(challenge);
      const solved = this.#solved.has(challenge.id);
      setAttribute(item.element, "data-solved", solved);
      setText(item.mark, solved ? "Solved: " : "");
    }
    const count = challenges.filter(({ id }) => this.#solved.has(id)).length;
    setText(this.#title, `Try it · ${count} of ${challenges.length} solved`);
    this.element.hidden = challenges.length === 0;
    return news;
  }

  #add(challenge: Challenge): Item {
    const mark = make("span", { class: "mark" });
    const goal = make("p", { class: "goal" }, mark, challenge.goal);
    const box = make("span", { class: "box" }, icon("M4.5 10.5l3.5 3.5 7.5-8.5"));
    const hint = make("details", {}, make("summary", {}, "Hint"), make("p", {}, challenge.hint));
    const element = make(
      "li",
      { "data-challenge": challenge.id },
      box,
      make("div", {}, goal, hint),
    );
    this.#list.append(element);
    const item = { element, mark };
    this.#items.set(challenge.id, item);
    return item;
  }
}
