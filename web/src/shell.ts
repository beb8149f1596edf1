/** The shadow tree of a figure, built only from snapshots. */

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

/** Actions that the parts of the tree trigger on the figure. */
export interface Acts {
  send: (event: FigureEvent) => void;
  hand: Hand;
  deeds: Deeds;
  jobs: JobHooks;
  /** Passes a photograph to the figure. Returns a message if it is rejected. */
  takePhoto: (slot: string, photo: Photo) => string | undefined;
  /** Plays the solution of a goal, or stops it. */
  showHow: (challenge: string) => void;
}

/** Duration for which changed values stay marked, milliseconds. */
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
  /** Stand-in whose readouts are still shown. */
  #borrowed: ParentNode | undefined;
  #marked: ReturnType<typeof setTimeout> | undefined;
  /** Whether the figure waits for a computation. */
  #waiting = false;
  /** Whether the figure needs photographs that have not been chosen yet. */
  #wantsPhotos = false;

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
    // Reserves its space from the start, to avoid a layout shift when the figure starts.
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
    // Dragging a slider must not trigger swipe gestures of the page.
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

  /** Arranges the parts in a column, as in the normal (not compact) layout. */
  #spread(): void {
    // In this order nothing shifts while the page loads: the title fills the rest of the toolbar's row.
    this.#head.append(this.#toolbar.element, this.#title);
    this.#body.before(this.#toolbar.link, this.photos.element);
    this.#under.append(this.#controls.buttons);
    this.#panel.append(this.#readouts.main, this.#controls.inputs, this.#challenges.element, this.#folds);
    this.#body.append(this.#under, this.#panel);
    this.root.append(this.#caption);
  }

  /** Whether picture, main buttons and readouts share the host's height, with the rest in a drawer. */
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

  /** Places the bar of a compact figure. Returns the layout width for the picture. */
  arrange(sizes: Size[]): number | undefined {
    return this.#compact?.arrange(this.root, this.picture.element, sizes);
  }

  introduce(title: string, help: string): void {
    setText(this.#title, title);
    setText(this.#help, help);
  }

  /** Sets the controls, readouts and goals to show from the next update on. */
  choose(choice: Choice): void {
    this.#choice = choice;
    this.#controls.clear();
  }

  /** Returns messages about unknown names in the choice. */
  misnamed(snapshot: Snapshot): string[] {
    return misnamed(this.#choice, snapshot);
  }

  /** Shows the readouts of a stand-in, which equal those of the finished figure. */
  borrowNumbers(tree: ParentNode): void {
    this.#readouts.borrow(tree);
    this.#borrowed = tree;
  }

  /**
   * Whether the readouts are the figure's own. An untouched figure borrows them until it has
   * computed.
   */
  get settled(): boolean {
    return this.#borrowed === undefined;
  }

  /** Updates all parts. Returns the goals reached for the first time. */
  update(snapshot: Snapshot, { touched, own }: { touched: boolean; own: boolean }): Challenge[] {
    if (touched || snapshot.waiting === null) this.#borrowed = undefined;
    setAttribute(this.root, "data-aspect", snapshot.aspect);
    this.#controls.update(snapshot.controls, this.#choice.controls);
    if (this.#borrowed) this.#controls.borrow(this.#borrowed);
    else this.#readouts.update(snapshot.readouts, this.#choice.readouts);
    this.picture.update(snapshot);
    this.photos.update(snapshot.photos);
    if (this.photos.offered) this.#toolbar.offerPhotos(this.photos.element);
    if (snapshot.wants_photos && !this.#wantsPhotos) this.#toolbar.openPhotos(this.photos.element, true);
    this.#wantsPhotos = snapshot.wants_photos;
    this.#toolbar.offerFile(snapshot.file);
    this.jobs.follow(snapshot.waiting);
    this.#waiting = snapshot.waiting !== null;
    this.#tellBusy();
    setText(this.#description, snapshot.description);
    const solved = this.#challenges.update(snapshot, { goals: this.#choice.goals, own });
    this.#under.hidden = this.#controls.buttons.hidden;
    return solved;
  }

  /** Sets `aria-busy`; a figure with a stopped computation is not busy. */
  #tellBusy(): void {
    setAttribute(this.root, "aria-busy", this.#waiting && !this.jobs.stopped ? "true" : undefined);
  }

  /** Shows the parts around the picture once the figure can be operated. */
  reveal(): void {
    this.#panel.hidden = false;
    this.#toolbar.element.classList.remove("later");
    this.#compact?.bar.classList.remove("later");
  }

  /** Takes back the elements borrowed by a stand-in. */
  settle(): void {
    this.root.querySelector(".head")?.after(this.speaker.home);
    this.#help.after(this.speaker.region);
  }

  /** The goal whose solution is playing. */
  set playing(challenge: string | undefined) {
    this.#challenges.playing = challenge;
  }

  /** Goals, with whether the reader has reached each. */
  get goals(): Goal[] {
    return this.#challenges.goals;
  }

  /** Marks goals as reached on an earlier visit. */
  recall(ids: string[]): void {
    this.#challenges.recall(ids);
  }

  /** Briefly marks the values that differ between two snapshots. */
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

  /** Ends announcements and jobs when the element replaces its figure. */
  end(): void {
    this.unmark();
    this.speaker.silence();
    this.jobs.end();
    this.#toolbar.end();
    this.#controls.clear();
    this.photos.forget();
  }

  /**
   * Keeps key presses in a figure from triggering the page's shortcuts. Tab and combinations with Ctrl, Alt or ⌘ pass;
   * Escape returns focus to the page.
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
