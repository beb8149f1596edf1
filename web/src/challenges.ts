/** Goals for the reader, shown one at a time. A reached goal stays reached. */

import type { Choice } from "./choice.js";
import type { Challenge, Snapshot } from "./contract.js";
import { icon, make, setAttribute, setText } from "./dom.js";

/** A goal as reported to the page. */
export interface Goal {
  id: string;
  goal: string;
  /** Whether the reader has reached it, now or on an earlier visit. */
  solved: boolean;
}

const SOLVED = "Solved: ";
const CHECK = "M4.5 10.5l3.5 3.5 7.5-8.5";

export class Challenges {
  readonly element = make("div", { class: "challenges", role: "group", "aria-label": "Goals" });
  readonly #line = make("div", { class: "goal-line", tabindex: -1 });
  readonly #mark = make("span", { class: "mark" });
  readonly #goal = make("span");
  /** The hint or, once solved, the explanation. */
  readonly #note = make("p", { class: "note" });
  readonly #hint = make("button", { type: "button", "aria-expanded": "false" }, "Hint");
  readonly #show = make("button", { type: "button" }, "Show how");
  readonly #back = make("button", { type: "button", "aria-label": "Previous goal" }, icon("M12.5 4.5L7 10l5.5 5.5"));
  readonly #next = make("button", { type: "button", "aria-label": "Next goal" }, icon("M7.5 4.5L13 10l-5.5 5.5"));
  readonly #count = make("button", { type: "button", class: "count", "aria-expanded": "false" });
  readonly #list = make("ol", { hidden: true });
  /** Invisible copies of all goals with their longest notes, to reserve the height of the tallest. */
  readonly #room = make("div", { class: "goal-room", "aria-hidden": "true" });
  #rows: { row: HTMLElement; mark: HTMLElement }[] = [];
  readonly #solved = new Set<string>();
  /** Goals reached by the page or by a shown solution, not by the reader. */
  readonly #given = new Set<string>();
  #known: Challenge[] = [];
  #goals: Choice["goals"] = "one";
  #at = 0;
  #hinted = false;
  #opened = false;
  #playing: string | undefined;
  /** Goal whose solution was played last. */
  #shown: string | undefined;

  /** Creates the goals; `show` plays the solution of a goal, or stops it. */
  constructor(show: (id: string) => void) {
    const shown = make("div", {}, make("p", { class: "goal" }, this.#mark, this.#goal), this.#note);
    const words = make("div", { class: "words" }, shown, this.#room);
    const acts = make("div", { class: "acts" }, this.#hint, this.#show, this.#back, this.#count, this.#next);
    this.#line.append(make("span", { class: "box" }, icon(CHECK)), words, acts);
    this.element.append(this.#line, this.#list);
    this.#hint.addEventListener("click", () => {
      this.#hinted = !this.#hinted;
      this.#refresh();
    });
    this.#show.addEventListener("click", () => show(this.#known[this.#at]?.id ?? ""));
    this.#back.addEventListener("click", () => this.#turn(-1));
    this.#next.addEventListener("click", () => this.#turn(1));
    this.#count.addEventListener("click", () => {
      this.#opened = !this.#opened;
      this.#refresh();
    });
  }

  /**
   * Shows the goals and returns those reached for the first time. They count only if the last change was the reader's
   * `own`; while the figure is `waiting` for a computation, goals may not be evaluated yet.
   */
  update(
    { challenges, waiting }: Snapshot,
    { goals, own }: { goals: Choice["goals"]; own: boolean },
  ): Challenge[] {
    const given = [...this.#given].join();
    for (const { id, solved } of challenges) {
      if (solved && !own && !this.#solved.has(id)) this.#given.add(id);
      else if (!solved && waiting === null) this.#given.delete(id);
    }
    const news = challenges.filter(({ id, solved }) => solved && !this.#given.has(id) && !this.#solved.has(id));
    for (const { id } of news) this.#solved.add(id);
    if (this.#known.length !== challenges.length) this.#listAll(challenges);
    const unchanged = news.length === 0 && given === [...this.#given].join();
    const same = goals === this.#goals && unchanged && this.#known.length > 0;
    this.#known = challenges;
    this.#goals = goals;
    if (!same) this.#refresh();
    return news;
  }

  /** Goals, with their status. */
  get goals(): Goal[] {
    return this.#known.map(({ id, goal }) => ({ id, goal, solved: this.#solved.has(id) }));
  }

  /** Marks goals as reached on an earlier visit. */
  recall(ids: string[]): void {
    for (const { id } of this.#known) if (ids.includes(id)) this.#solved.add(id);
    this.#refresh();
  }

  /** The goal whose solution is playing; its button stops it. */
  set playing(id: string | undefined) {
    this.#playing = id;
    this.#shown = id ?? this.#shown;
    this.#refresh();
  }

  #turn(by: number): void {
    this.#go((this.#at + by + this.#known.length) % this.#known.length);
  }

  #go(index: number): void {
    this.#at = index;
    this.#hinted = false;
    this.#refresh();
  }

  #listAll(challenges: Challenge[]): void {
    this.#at = 0;
    this.#rows = challenges.map(({ id, goal }, index) => {
      const mark = make("span", { class: "mark" });
      const button = make("button", { type: "button" }, make("span", {}, mark, goal));
      button.addEventListener("click", () => {
        this.#go(index);
        // The list closes, so focus moves to the chosen goal.
        this.#line.focus();
      });
      const box = make("span", { class: "box" }, icon(CHECK));
      return { row: make("li", { "data-challenge": id }, box, button), mark };
    });
    this.#list.replaceChildren(...this.#rows.map(({ row }) => row));
    this.#room.replaceChildren(
      ...challenges.map(({ goal, hint, why }) =>
        make("div", {}, make("p", { class: "goal" }, make("span", { class: "mark" }, SOLVED), goal),
          make("p", { class: "note" }, hint.length > why.length ? hint : why)),
      ),
    );
  }

  #refresh(): void {
    const now = this.#known[this.#at];
    this.element.hidden = !now || this.#goals === "none";
    if (!now) return;
    const solved = this.#solved.has(now.id);
    setAttribute(this.#line, "data-solved", solved);
    const shown = !solved && this.#given.has(now.id) && this.#shown === now.id;
    setText(this.#mark, solved ? SOLVED : shown ? "Shown: " : "");
    setText(this.#goal, now.goal);
    setText(this.#note, solved || shown ? now.why : this.#hinted ? now.hint : "");
    this.#hint.hidden = solved || shown;
    setAttribute(this.#hint, "aria-expanded", String(this.#hinted));
    setText(this.#show, this.#playing === now.id ? "Stop" : "Show how");
    const total = this.#known.length;
    const done = this.#known.filter(({ id }) => this.#solved.has(id)).length;
    const open = this.#goals === "all" || this.#opened;
    for (const button of [this.#back, this.#next]) button.hidden = total < 2;
    this.#count.hidden = total < 2;
    setText(this.#count, `${this.#at + 1} of ${total}`);
    setAttribute(this.#count, "aria-label", `Goal ${this.#at + 1} of ${total}, ${done} solved: all goals`);
    setAttribute(this.#count, "aria-expanded", String(open));
    this.#list.hidden = !open || total < 2;
    this.#known.forEach(({ id }, index) => {
      const { row, mark } = this.#rows[index] ?? {};
      if (!row || !mark) return;
      setAttribute(row, "data-solved", this.#solved.has(id));
      // The current goal is shown above the list.
      row.hidden = index === this.#at;
      setText(mark, this.#solved.has(id) ? SOLVED : "");
    });
  }
}
