/** What a figure is made of on the page: its tree, which needs nothing but a snapshot. */

import { Challenges, type Goal } from "./challenges.js";
import { Compact } from "./compact.js";
import { misnamed, type Choice } from "./choice.js";
import { Controls } from "./controls.js";
import type { Challenge, FigureEvent, Snapshot } from "./contract.js";
import { make, setAttribute, setText } from "./dom.js";
import { Jobs, type JobHooks } from "./jobs.js";
import { Photos, type Photo } from "./photos.js";
import { Picture, type Hand } from "./picture.js";
import { Readouts } from "./readouts.js";
import type { Size } from "./room.js";
import { Speaker } from "./speaker.js";
import type { Theme } from "./theme.js";
import { Toolbar, type Deeds } from "./toolbar.js";

/** What the parts do to the figure. */
export interface Acts {
  send: (event: FigureEvent) => void;
  hand: Hand;
  deeds: Deeds;
  jobs: JobHooks;
  /** Hands a photograph to the figure; a sentence if it is refused. */
  takePhoto: (slot: string, photo: Photo) => string | undefined;
  /** Plays the way to a goal, or ends that. */
  showHow: (challenge: string) => void;
}

/** How long what has changed stays marked, milliseconds. */
const MARKED_MS = 1800;

export class Shell {
  readonly speaker: Speaker;
  readonly picture: Picture;
  readonly jobs: Jobs;
  readonly photos: Photos;
  readonly root = make("div", {
    class: "root",
    "aria-labelledby": "title",
    "aria-describedby": "help",
  });
  readonly #controls: Controls;
  readonly #readouts = new Readouts();
  readonly #challenges: Challenges;
  readonly #toolbar: Toolbar;
  #compact: Compact | undefined;
  readonly #head: HTMLElement;
  readonly #body: HTMLElement;
  readonly #folds: HTMLElement;
  readonly #caption = make("slot", { name: "caption" });
  readonly #help = make("p", { id: "help", class: "help" });
  readonly #title = make("p", { id: "title", class: "title" });
  readonly #description = make("p", { class: "description" });
  readonly #under: HTMLElement;
  readonly #panel: HTMLElement;
  #choice: Choice;
  /** The stand-in whose numbers are still shown. */
  #borrowed: ParentNode | undefined;
  #marked: ReturnType<typeof setTimeout> | undefined;
  /** The figure waits for a computation. */
  #waiting = false;

  constructor(acts: Acts, choice: Choice) {
    this.#choice = choice;
    this.picture = new Picture(acts.hand);
    this.speaker = new Speaker(this.picture.overlay);
    this.jobs = new Jobs({ ...acts.jobs, turned: () => this.#tellBusy() });
    this.#controls = new Controls(acts.send);
    this.#challenges = new Challenges(acts.showHow);
    this.#toolbar = new Toolbar(acts.deeds, (sentence) => this.speaker.say(sentence));
    this.photos = new Photos({
      take: acts.takePhoto,
      warn: (sentence) => this.speaker.warn([sentence], true),
      noted: () => this.#toolbar.openPhotos(this.photos.element, true),
    });
    // Its room is kept from the start, so that nothing moves when the figure is there.
    this.#toolbar.element.classList.add("later");
    this.#under = make("div", { class: "under", hidden: true });
    this.#folds = make("div", { class: "folds" }, this.#controls.more, this.#readouts.others);
    this.#panel = make("div", { class: "panel", hidden: true });
    this.picture.overlay.append(this.jobs.element);
    this.#head = make("div", { class: "head" });
    this.#body = make("div", { class: "body" }, this.picture.element);
    this.root.append(this.#head, this.speaker.home, this.#body, this.#description, this.#help, this.speaker.region);
    this.#spread();
    this.photos.listen(this.root);
    for (const type of ["keydown", "keypress", "keyup"] as const) {
      this.root.addEventListener(type, (event) => this.#keep(event));
    }
    // Whoever holds a slider does not swipe the page away.
    for (const type of ["pointerdown", "pointermove", "touchstart", "touchmove"] as const) {
      const holds = ({ target }: Event) => target instanceof HTMLInputElement && target.type === "range";
      this.root.addEventListener(type, (event) => holds(event) && event.stopPropagation(), { passive: true });
    }
  }

  set role(role: "figure" | "group") {
    setAttribute(this.root, "role", role);
  }

  set theme(theme: Theme) {
    setAttribute(this.root, "data-theme", theme);
  }

  /** Puts everything where it is if there is room: one part below the other. */
  #spread(): void {
    // In this order a page that is still coming moves nothing: the title fills what the row leaves.
    this.#head.append(this.#toolbar.element, this.#title);
    this.#body.before(this.#toolbar.link, this.photos.element);
    this.#under.append(this.#controls.buttons);
    this.#panel.append(this.#readouts.main, this.#controls.inputs, this.#challenges.element, this.#folds);
    this.#body.append(this.#under, this.#panel);
    this.root.append(this.#caption);
  }

  /** Whether picture, main buttons and numbers share the height that the host gives, and the rest is in a drawer. */
  set compact(wanted: boolean) {
    if (wanted === (this.#compact !== undefined)) return;
    this.#compact?.drawer.remove();
    this.#compact?.bar.remove();
    setAttribute(this.root, "data-compact", wanted ? "below" : undefined);
    this.#compact = undefined;
    if (!wanted) {
      this.#spread();
      return;
    }
    this.#compact = new Compact();
    this.#compact.take(
      [this.#controls.buttons, this.#readouts.main],
      [this.#toolbar.element, this.#toolbar.link, this.photos.element, this.#panel, this.#caption],
    );
    this.#compact.bar.classList.toggle("later", this.#panel.hidden);
    this.#under.remove();
    this.#body.append(this.#compact.drawer, this.#compact.bar);
  }

  /** In a compact figure: the width to lay the picture out for, once the bar has found its place. */
  arrange(sizes: Size[]): number | undefined {
    return this.#compact?.arrange(this.root, this.picture.element, sizes);
  }

  introduce(title: string, help: string): void {
    setText(this.#title, title);
    setText(this.#help, help);
  }

  /** Shows other controls, readouts and goals with the next update. */
  choose(choice: Choice): void {
    this.#choice = choice;
    this.#controls.clear();
  }

  /** What is wrong with the names of what is to be shown. */
  misnamed(snapshot: Snapshot): string[] {
    return misnamed(this.#choice, snapshot);
  }

  /** Shows the numbers of a stand-in, which are those of a figure that waits for nothing any more. */
  borrowNumbers(tree: ParentNode): void {
    this.#readouts.borrow(tree);
    this.#borrowed = tree;
  }

  /** Whether the numbers are known: not before a figure that nobody has touched has computed its own. */
  get settled(): boolean {
    return this.#borrowed === undefined;
  }

  /** Brings everything up to date. Returns the goals that have just been reached. */
  update(snapshot: Snapshot, touched: boolean): Challenge[] {
    if (touched || snapshot.waiting === null) this.#borrowed = undefined;
    setAttribute(this.root, "data-aspect", snapshot.aspect);
    this.#controls.update(snapshot.controls, this.#choice.controls);
    if (this.#borrowed) this.#controls.borrow(this.#borrowed);
    else this.#readouts.update(snapshot.readouts, this.#choice.readouts);
    this.picture.update(snapshot);
    this.photos.update(snapshot.photos);
    if (this.photos.offered) this.#toolbar.offerPhotos(this.photos.element);
    this.#toolbar.offerFile(snapshot.file);
    this.jobs.follow(snapshot.waiting);
    this.#waiting = snapshot.waiting !== null;
    this.#tellBusy();
    setText(this.#description, snapshot.description);
    const solved = this.#challenges.update(snapshot, { goals: this.#choice.goals, touched });
    this.#under.hidden = this.#controls.buttons.hidden;
    return solved;
  }

  /** A figure whose computation was stopped is at rest. */
  #tellBusy(): void {
    setAttribute(this.root, "aria-busy", this.#waiting && !this.jobs.stopped ? "true" : undefined);
  }

  /** The figure can be operated: everything beside the picture comes. */
  reveal(): void {
    this.#panel.hidden = false;
    this.#toolbar.element.classList.remove("later");
    this.#compact?.bar.classList.remove("later");
  }

  /** Takes back what a stand-in had borrowed. */
  settle(): void {
    this.root.querySelector(".head")?.after(this.speaker.home);
    this.#help.after(this.speaker.region);
  }

  /** Tells which goal is being shown. */
  set playing(challenge: string | undefined) {
    this.#challenges.playing = challenge;
  }

  /** Every goal, and whether the reader has reached it. */
  get goals(): Goal[] {
    return this.#challenges.goals;
  }

  /** Takes goals for reached. */
  recall(ids: string[]): void {
    this.#challenges.recall(ids);
  }

  /** Marks for a moment what has changed between two snapshots. */
  markChanges(before: Snapshot, now: Snapshot): void {
    const words = (snapshot: Snapshot) => [
      ...snapshot.controls.map((control) => ["control", control.id, control.value_text] as const),
      ...snapshot.readouts.map(({ id, text }) => ["readout", id, text] as const),
      ...snapshot.handles.map(({ id, x, y }) => ["handle", id, `${x},${y}`] as const),
    ];
    const old = new Map(words(before).map(([kind, id, text]) => [`${kind} ${id}`, text]));
    const changed = words(now).filter(([kind, id, text]) => old.get(`${kind} ${id}`) !== text);
    this.unmark();
    for (const [kind, id] of changed) {
      const [controls, readouts, picture] = [this.#controls, this.#readouts, this.picture];
      const home = kind === "control" ? controls : kind === "readout" ? readouts : picture;
      home.elementOf(id)?.setAttribute("data-changed", "");
    }
    this.#marked = setTimeout(() => this.unmark(), MARKED_MS);
  }

  /** Marks a control that is about to be pressed. */
  markControl(id: string): void {
    this.unmark();
    this.#controls.elementOf(id)?.setAttribute("data-changed", "");
    this.#marked = setTimeout(() => this.unmark(), MARKED_MS);
  }

  unmark(): void {
    clearTimeout(this.#marked);
    for (const marked of this.root.querySelectorAll("[data-changed]")) {
      marked.removeAttribute("data-changed");
    }
  }

  /** The figure is no longer that of the element: nothing of it may speak or compute. */
  end(): void {
    this.unmark();
    this.speaker.silence();
    this.jobs.end();
    this.#toolbar.end();
    this.#controls.clear();
    this.photos.forget();
  }

  /**
   * Keys that are pressed here mean nothing to the page, whose shortcuts would turn it around. Tab
   * goes on, what a browser does with Ctrl, Alt or ⌘ goes on, and Escape gives the focus back.
   */
  #keep(event: KeyboardEvent): void {
    if (event.key === "Tab" || event.ctrlKey || event.altKey || event.metaKey) return;
    event.stopPropagation();
    if (event.key !== "Escape" || event.type !== "keydown") return;
    const tree = this.root.getRootNode();
    const focused = tree instanceof ShadowRoot ? tree.activeElement : null;
    if (!(focused instanceof HTMLElement) || this.#compact?.leave(focused)) return;
    focused.blur();
  }
}
