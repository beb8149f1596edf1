/** What a figure is made of on the page: the tree in its shadow root, and the look of it. */

import { Challenges } from "./challenges.js";
import { Controls } from "./controls.js";
import type { Challenge, FigureEvent, Snapshot } from "./contract.js";
import { make, setAttribute, setText } from "./dom.js";
import text from "./figure.css" with { type: "text" };
import { Jobs, type JobHooks } from "./jobs.js";
import { Photos, type Photo } from "./photos.js";
import { Picture, type Hand } from "./picture.js";
import { Readouts } from "./readouts.js";
import { Speaker } from "./speaker.js";
import type { Theme } from "./theme.js";
import { Toolbar, type Deeds } from "./toolbar.js";

/** What the parts do to the figure. */
export interface Acts {
  send: (event: FigureEvent) => void;
  hand: Hand;
  deeds: Deeds;
  jobs: JobHooks;
  takePhoto: (slot: string, photo: Photo) => void;
}

export class Shell {
  readonly speaker = new Speaker();
  readonly picture: Picture;
  readonly jobs: Jobs;
  readonly #controls: Controls;
  readonly #readouts = new Readouts();
  readonly #photos: Photos;
  readonly #challenges = new Challenges();
  readonly #toolbar: Toolbar;
  readonly #help = make("p", { id: "help", class: "help" });
  readonly #title = make("p", { id: "title", class: "title" });
  readonly #description = make("p", { class: "description" });
  readonly #panel = make("div", { class: "panel", hidden: true });
  #theme: Theme = "light";
  readonly #root = make("div", {
    class: "root",
    "aria-labelledby": "title",
    "aria-describedby": "help",
  });

  constructor(host: HTMLElement, acts: Acts) {
    this.picture = new Picture(acts.hand);
    this.jobs = new Jobs(acts.jobs);
    this.#controls = new Controls(acts.send);
    this.#photos = new Photos(acts.takePhoto, (sentence) => this.speaker.warn([sentence], true));
    this.#toolbar = new Toolbar(acts.deeds, (sentence) => this.speaker.say(sentence));
    // Its room is kept from the start, so that nothing moves when the figure is there.
    this.#toolbar.element.classList.add("later");
    this.#panel.append(
      this.#readouts.element,
      this.#controls.element,
      this.#photos.element,
      this.#challenges.element,
    );
    this.#root.append(
      make("div", { class: "head" }, this.#title, this.#toolbar.element),
      this.picture.element,
      this.jobs.element,
      this.speaker.notice,
      this.#toolbar.link,
      this.#panel,
      this.#description,
      this.#help,
      this.speaker.region,
      make("slot", { name: "caption" }),
    );
    this.#photos.listen(this.#root);
    // Keys that move something here must not turn the page around.
    this.#root.addEventListener("keydown", (event) => {
      if (/^(Arrow|Page|Home|End)/.test(event.key)) event.stopPropagation();
    });
    const shadow = host.attachShadow({ mode: "open" });
    shadow.adoptedStyleSheets = [sheet()];
    shadow.append(this.#root);
  }

  set role(role: "figure" | "group") {
    setAttribute(this.#root, "role", role);
  }

  get theme(): Theme {
    return this.#theme;
  }

  set theme(theme: Theme) {
    this.#theme = theme;
    setAttribute(this.#root, "data-theme", theme);
  }

  introduce(title: string, help: string): void {
    setText(this.#title, title);
    setText(this.#help, help);
  }

  /** Brings everything up to date. Returns the goals that have just been reached. */
  update(snapshot: Snapshot): Challenge[] {
    this.#controls.update(snapshot.controls);
    this.#readouts.update(snapshot.readouts);
    this.picture.update(snapshot);
    this.#photos.update(snapshot.photos);
    this.jobs.follow(snapshot.waiting);
    setAttribute(this.#root, "aria-busy", snapshot.waiting === null ? undefined : "true");
    setText(this.#description, snapshot.description);
    return this.#challenges.update(snapshot.challenges);
  }

  /** The figure can be operated: everything beside the picture comes. */
  reveal(): void {
    this.#panel.hidden = false;
    this.#toolbar.element.classList.remove("later");
  }
}

let shared: CSSStyleSheet | undefined;

/** The one style sheet that all figures of a page share. */
function sheet(): CSSStyleSheet {
  if (!shared) {
    shared = new CSSStyleSheet();
    shared.replaceSync(text);
  }
  return shared;
}
