/** `<epipole-figure name="…">`: a figure on a page. */

import type { Challenge, Parameters, Refused, Snapshot } from "./contract.js";
import { Challenges } from "./challenges.js";
import { Controls } from "./controls.js";
import { make, setAttribute } from "./dom.js";
import { Jobs } from "./jobs.js";
import { Engine, loadModule } from "./module.js";
import { linkTo, parametersIn } from "./permalink.js";
import { Photos } from "./photos.js";
import { Picture } from "./picture.js";
import { defineProperties } from "./properties.js";
import { Readouts } from "./readouts.js";
import { Session } from "./session.js";
import { Speaker } from "./speaker.js";
import { sheet } from "./sheet.js";
import { themeOf, watchTheme } from "./theme.js";
import { Toolbar } from "./toolbar.js";
import { watchVisibility } from "./visibility.js";

/** Attributes that are no parameters: ours, and those that any element may have. */
const NOT_PARAMETERS =
  /^(name|theme|id|class|style|slot|title|lang|dir|hidden|tabindex|role|is|part|exportparts|inert|translate|nonce|draggable|contenteditable|popover|accesskey|autofocus|item.*|aria-.*|data-.*|on.*)$/;

export class EpipoleFigure extends HTMLElement {
  static readonly observedAttributes = ["name", "theme"];

  readonly #speaker = new Speaker();
  readonly #readouts = new Readouts();
  readonly #challenges = new Challenges();
  readonly #controls = new Controls((event) => this.#session?.act((engine) => engine.update(event)));
  readonly #picture = new Picture({
    handleAt: (x, y) => this.#session?.ask((engine) => engine.handleAt(this.#width, x, y)),
    drag: (id, x, y) => this.#session?.act((engine) => engine.drag(id, this.#width, x, y)),
    nudge: (id, towards, steps) =>
      this.#session?.act((engine) => engine.nudge(id, this.#width, towards, steps)),
    moveToEnd: (id, towards) =>
      this.#session?.act((engine) => engine.moveToEnd(id, this.#width, towards)),
    remove: (id) => this.#session?.act((engine) => engine.update({ type: "handle-removed", id })),
    click: (x, y) => {
      this.#session?.act((engine) => engine.click(this.#width, x, y));
      // A point that a click has made can be dragged on at once.
      this.#session?.flush();
    },
  });
  readonly #toolbar = new Toolbar(
    {
      reset: () => this.reset(),
      link: () => this.permalink,
      save: () => void this.#save(),
      fullscreen: document.fullscreenEnabled ? () => void this.#toggleFullscreen() : undefined,
    },
    (sentence) => this.#speaker.say(sentence),
  );
  readonly #jobs = new Jobs({
    next: () => {
      const name = this.getAttribute("name") ?? "";
      const job = this.#session?.ask((engine) => engine.job());
      return job && { name, ...job };
    },
    done: (key, result) => this.#endJob((engine) => engine.jobDone(key, result)),
    failed: (key, sentence) => this.#endJob((engine) => engine.jobFailed(key, sentence)),
  });
  readonly #photos = new Photos(
    (slot, photo) => this.#session?.act((engine) => engine.takePhoto(slot, photo)),
    (sentence) => this.#speaker.warn([sentence], true),
  );
  readonly #help = make("p", { id: "help", class: "help" });
  readonly #title = make("p", { id: "title", class: "title" });
  readonly #description = make("p", { class: "description" });
  readonly #panel = make("div", { class: "panel", hidden: true });
  readonly #root: HTMLElement;

  #session: Session | undefined;
  #snapshot: Snapshot | undefined;
  #state: Parameters = [];
  #ready = false;
  #near = false;
  #opening = 0;
  #stop: (() => void)[] = [];

  constructor() {
    super();
    const head = make("div", { class: "head" }, this.#title, this.#toolbar.element);
    this.#panel.append(
      this.#readouts.element,
      this.#controls.element,
      this.#photos.element,
      this.#challenges.element,
    );
    this.#root = make(
      "div",
      { class: "root", "aria-labelledby": "title", "aria-describedby": "help" },
      head,
      this.#picture.element,
      this.#jobs.element,
      this.#speaker.notice,
      this.#toolbar.link,
      this.#panel,
      this.#description,
      this.#help,
      this.#speaker.region,
      make("slot", { name: "caption" }),
    );
    // Its room is kept from the start, so that nothing moves when the figure is there.
    this.#toolbar.element.classList.add("later");
    const shadow = this.attachShadow({ mode: "open" });
    shadow.adoptedStyleSheets = [sheet()];
    shadow.append(this.#root);
    // Keys that move something here must not turn the page around.
    this.#root.addEventListener("keydown", (event) => {
      if (/^(Arrow|Page|Home|End)/.test(event.key) && event.target !== this.#root) {
        event.stopPropagation();
      }
    });
  }

  connectedCallback(): void {
    setAttribute(this.#root, "role", this.closest("figure") ? "group" : "figure");
    const resized = new ResizeObserver(() => this.#session?.resize(this.#picture.element.clientWidth));
    resized.observe(this.#picture.element);
    const attributes = new MutationObserver((records) => this.#onAttributes(records));
    attributes.observe(this, { attributes: true });
    const density = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
    const recolor = () => this.#recolor();
    const [before, after] = [() => this.#session?.prepareForPrint(), recolor];
    density.addEventListener("change", recolor);
    addEventListener("beforeprint", before);
    addEventListener("afterprint", after);
    this.#stop = [
      () => resized.disconnect(),
      () => attributes.disconnect(),
      () => density.removeEventListener("change", recolor),
      () => removeEventListener("beforeprint", before),
      () => removeEventListener("afterprint", after),
      watchTheme(recolor),
      watchVisibility(this, {
        near: (near) => {
          this.#near = near;
          if (near && !this.#session && this.#opening === 0) void this.#open(true);
        },
        seen: (inSight) => this.#session?.setInSight(inSight),
      }),
    ];
    this.#recolor();
    this.#session?.resize(this.#picture.element.clientWidth);
    if (this.#snapshot) this.#jobs.follow(this.#snapshot.waiting);
    if (this.#isLinked()) void this.#open(true);
  }

  disconnectedCallback(): void {
    for (const stop of this.#stop) stop();
    this.#stop = [];
    this.#speaker.silence();
    this.#session?.setInSight(false);
    this.#jobs.end();
  }

  attributeChangedCallback(name: string, before: string | null): void {
    if (name === "theme") this.#recolor();
    if (name === "name" && before !== null && (this.#session || this.#near)) void this.#open(false);
  }

  /** Parameters that differ from the figure's defaults, by name. Setting puts them on top. */
  get state(): Record<string, string> {
    return Object.fromEntries(this.#state);
  }

  set state(parameters: Record<string, string | number | boolean>) {
    this.apply(parameters);
  }

  /** The readouts by name. */
  get readouts(): Record<string, number | string> {
    return Object.fromEntries(this.#snapshot?.readouts.map(({ id, value }) => [id, value]) ?? []);
  }

  /** What the figure shows now, in words. */
  get description(): string {
    return this.#snapshot?.description ?? "";
  }

  /** A link to this page with the figure in its present state. */
  get permalink(): string {
    const known = new Set(this.#snapshot?.controls.map(({ id }) => id));
    for (const { id } of this.#snapshot?.handles ?? []) known.add(id);
    return linkTo(this, this.#fullState(), (key) => known.has(key));
  }

  /** The present value of a control. */
  controlValue(id: string): number | boolean | string | undefined {
    const control = this.#snapshot?.controls.find((known) => known.id === id);
    return control && "value" in control ? control.value : undefined;
  }

  /** Takes parameters, as attributes do. */
  apply(parameters: Record<string, string | number | boolean>): void {
    const pairs: Parameters = Object.entries(parameters).map(([key, value]) => [key, String(value)]);
    let problems: Refused[] = [];
    this.#session?.act((engine) => {
      problems = engine.apply(pairs);
      return undefined;
    });
    this.#warn(problems);
  }

  /** Presses a button of the figure. */
  press(id: string): void {
    this.#session?.act((engine) => engine.update({ type: "press", id }));
  }

  /** Back to the state that the page's author has set. */
  reset(): void {
    this.#speaker.warn([]);
    if (!this.#session) {
      void this.#open(false);
      return;
    }
    let problems: Refused[] = [];
    this.#session.act((engine) => {
      const refused = engine.update({ type: "reset" });
      problems = engine.apply(this.#attributes());
      return refused;
    });
    this.#warn(problems);
    this.#speaker.say("Reset.");
  }

  /** Shows the present state at once, without waiting for the display. */
  flush(): void {
    this.#session?.flush();
  }

  get #width(): number {
    return this.#session?.width ?? 0;
  }

  #recolor(): void {
    const theme = themeOf(this);
    setAttribute(this.#root, "data-theme", theme);
    this.#session?.recolor(theme);
  }

  /** Whether the page's address speaks of this figure. */
  #isLinked(): boolean {
    return parametersIn(location.search, this).own.length > 0;
  }

  async #open(withAddress: boolean): Promise<void> {
    const attempt = ++this.#opening;
    const name = this.getAttribute("name") ?? "";
    let memory: WebAssembly.Memory;
    try {
      ({ memory } = await loadModule());
    } catch {
      if (attempt === this.#opening) {
        this.#fail("The interactive part of this figure could not be loaded.", true);
      }
      return;
    }
    if (attempt !== this.#opening) return;
    this.#session?.end();
    this.#session = undefined;
    this.#jobs.end();
    let engine: Engine;
    try {
      engine = new Engine(name, memory);
    } catch (problem) {
      this.#fail(`This figure cannot be shown: ${String(problem)}.`, false);
      return;
    }
    this.#ready = false;
    setAttribute(this, "data-failed", false);
    const problems = engine.apply(this.#attributes());
    const { own, loose } = parametersIn(withAddress ? location.search : "", this);
    problems.push(...engine.apply(own));
    // Without a key, what the figure does not know is someone else's.
    const others = engine.apply(loose);
    problems.push(...others.filter(({ unknown }) => !unknown));
    const linked = own.length + loose.length > others.filter(({ unknown }) => unknown).length;

    const upgraded = defineProperties(this, engine.snapshot(760).controls);
    problems.push(...engine.apply(upgraded));
    this.#title.textContent = engine.title;
    this.#help.textContent = engine.help;
    this.#session = new Session(engine, this.#picture.canvas, {
      drawn: (snapshot) => this.#drawn(snapshot, linked),
      refused: (sentence) => this.#speaker.warn([`${capitalize(sentence)}.`], true),
      broke: (message) => {
        this.#session = undefined;
        this.#jobs.end();
        this.#fail("This figure has stopped: a mistake of ours. Reset starts it again.", !this.#ready);
        this.#emit("epipole-error", { message });
      },
    });
    this.#recolor();
    this.#speaker.warn([]);
    this.#warn(problems);
    this.#session.resize(this.#picture.element.clientWidth);
    const box = this.getBoundingClientRect();
    this.#session.setInSight(box.bottom >= 0 && box.top <= innerHeight);
  }

  #drawn(snapshot: Snapshot | undefined, linked: boolean): void {
    if (snapshot) {
      const before = this.#snapshot;
      this.#snapshot = snapshot;
      this.#controls.update(snapshot.controls);
      this.#readouts.update(snapshot.readouts);
      this.#picture.update(snapshot);
      this.#photos.update(snapshot.photos);
      this.#jobs.follow(snapshot.waiting);
      this.#description.textContent = snapshot.description;
      const solved = this.#challenges.update(snapshot.challenges);
      if (this.#ready) this.#tell(before, snapshot, solved);
    }
    if (!this.#ready) this.#becomeReady(linked);
  }

  #endJob(work: (engine: Engine) => boolean): void {
    this.#session?.act((engine) => {
      work(engine);
      return undefined;
    });
  }

  /** The first frame is there: the poster goes, everything else comes. */
  #becomeReady(linked: boolean): void {
    this.#ready = true;
    this.#picture.reveal();
    this.#panel.hidden = false;
    this.#toolbar.element.classList.remove("later");
    this.#state = this.#session?.ask((engine) => engine.state()) ?? [];
    setAttribute(this, "data-ready", true);
    if (linked && !location.hash) this.scrollIntoView({ block: "start" });
    this.#emit("epipole-ready", {
      name: this.getAttribute("name"),
      state: this.state,
      readouts: this.readouts,
    });
  }

  #tell(before: Snapshot | undefined, now: Snapshot, solved: Challenge[]): void {
    this.#speaker.moveOn();
    if (before?.description !== now.description) this.#speaker.describe(now.description);
    const state = this.#session?.ask((engine) => engine.state()) ?? [];
    if (JSON.stringify(state) !== JSON.stringify(this.#state)) {
      this.#state = state;
      this.#emit("epipole-change", this.state);
    }
    const text = (snapshot?: Snapshot) => snapshot?.readouts.map((readout) => readout.text).join("|");
    if (text(before) !== text(now)) this.#emit("epipole-readout", this.readouts);
    for (const { id, goal } of solved) {
      this.#speaker.say(`Solved: ${goal}`);
      this.#emit("epipole-challenge", { id, goal });
    }
  }

  #emit(type: string, detail: unknown): void {
    this.dispatchEvent(new CustomEvent(type, { detail, bubbles: true, composed: true }));
  }

  /** A sentence where the figure should be; the poster stays, and Reset tries again. */
  #fail(sentence: string, again: boolean): void {
    this.#opening = 0;
    setAttribute(this, "data-failed", true);
    this.#speaker.warn([sentence]);
    if (again) {
      const retry = make("button", { type: "button" }, "Try again");
      retry.addEventListener("click", () => this.reset());
      this.#speaker.notice.append(retry);
    }
  }

  #warn(problems: Refused[]): void {
    if (problems.length === 0) return;
    const sentences = problems.map(({ message }) => capitalize(message));
    for (const sentence of sentences) console.warn(`epipole-figure: ${sentence}`);
    this.#speaker.warn(sentences.map((sentence) => `${sentence}.`));
  }

  #attributes(): Parameters {
    return [...this.attributes]
      .filter(({ name }) => !NOT_PARAMETERS.test(name))
      .map(({ name, value }) => [name, value]);
  }

  #onAttributes(records: MutationRecord[]): void {
    const names = records.map(({ attributeName }) => attributeName ?? "");
    const changed = new Set(names.filter((name) => name && !NOT_PARAMETERS.test(name)));
    if (changed.size === 0 || !this.#session) return;
    const parameters: Record<string, string> = {};
    for (const name of changed) {
      const control = this.#snapshot?.controls.find(({ id }) => id === name);
      const fallback = control && "default" in control ? String(control.default) : undefined;
      const value = this.getAttribute(name) ?? fallback;
      if (value !== undefined) parameters[name] = value;
    }
    this.#speaker.warn([]);
    this.apply(parameters);
  }

  /** The state, with what the attributes say and the reader has set back to the default. */
  #fullState(): Parameters {
    const state = this.#session?.ask((engine) => engine.state()) ?? this.#state;
    const named = new Set(state.map(([key]) => key));
    const more: Parameters = [];
    for (const [key] of this.#attributes()) {
      if (named.has(key)) continue;
      const control = this.#snapshot?.controls.find(({ id }) => id === key);
      const handle = this.#snapshot?.handles.find(({ id }) => id === key);
      if (control?.kind === "slider") more.push([key, control.value.toFixed(control.digits)]);
      else if (control && "value" in control) more.push([key, String(control.value)]);
      else if (handle) {
        more.push([key, `${handle.x.toFixed(handle.digits)},${handle.y.toFixed(handle.digits)}`]);
      }
    }
    return [...more, ...state];
  }

  async #save(): Promise<void> {
    // A picture that waits for a computation is not the one that the reader wants to keep.
    while (this.#snapshot?.waiting && this.#session && this.#jobs.busy) {
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    this.#session?.portrait(2)?.toBlob((blob) => {
      if (!blob) return;
      const link = make("a", {
        href: URL.createObjectURL(blob),
        download: `${this.getAttribute("name")}.png`,
      });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
    });
  }

  async #toggleFullscreen(): Promise<void> {
    if (document.fullscreenElement) await document.exitFullscreen();
    else await this.requestFullscreen().catch(() => this.#speaker.say("Full screen is not allowed here."));
  }
}

function capitalize(sentence: string): string {
  return sentence.charAt(0).toUpperCase() + sentence.slice(1);
}
