/**
 * `<epipole-figure name="…">`: a figure on a page.
 *
 * One class, long because it is the whole public surface: what a page can set, call and hear.
 */

import { changedParameters, parametersOf, wholeState } from "./attributes.js";
import type { Challenge, Parameters, Refused, Snapshot } from "./contract.js";
import { make, setAttribute } from "./dom.js";
import { Engine, loadModule } from "./module.js";
import { linkTo, parametersIn } from "./permalink.js";
import { defineProperties } from "./properties.js";
import { Session } from "./session.js";
import { Shell } from "./shell.js";
import { askTheme, watchTheme } from "./theme.js";
import { myTurn, pageIsCalm, watchVisibility } from "./visibility.js";

export class EpipoleFigure extends HTMLElement {
  static readonly observedAttributes = ["name", "theme"];

  readonly #shell = new Shell(this, {
    send: (event) => this.#session?.act((engine) => engine.update(event)),
    hand: {
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
      set: (id, value) => this.#session?.act((engine) => engine.update({ type: "set", id, value })),
    },
    deeds: {
      reset: () => this.reset(),
      link: () => this.permalink,
      save: () => void this.#save(),
      fullscreen: document.fullscreenEnabled ? () => void this.#toggleFullscreen() : undefined,
    },
    jobs: {
      next: () => {
        const job = this.#session?.ask((engine) => engine.job());
        return job && { name: this.getAttribute("name") ?? "", ...job };
      },
      done: (key, result) => this.#endJob((engine) => engine.jobDone(key, result)),
      failed: (key, sentence) => this.#endJob((engine) => engine.jobFailed(key, sentence)),
    },
    takePhoto: (slot, photo) => this.#session?.act((engine) => engine.takePhoto(slot, photo)),
  });
  #session: Session | undefined;
  #snapshot: Snapshot | undefined;
  #state: Parameters = [];
  #ready = false;
  /** Somebody has done something; what comes by itself while the page loads is not announced. */
  #touched = false;
  #near = false;
  #inSight = false;
  /** Width for the picture, CSS pixels. */
  #room = 0;
  /** Somebody has pointed at the figure or gone into it. */
  #interested = false;
  #opening = 0;
  #stop: (() => void)[] = [];

  connectedCallback(): void {
    this.#shell.role = this.closest("figure") ? "group" : "figure";
    // What observers tell is remembered: to ask would make the browser lay the page out at once.
    const resized = new ResizeObserver(([entry]) => {
      this.#room = entry?.contentRect.width ?? 0;
      this.#session?.resize(this.#room);
    });
    resized.observe(this.#shell.picture.element);
    const attributes = new MutationObserver((records) => this.#onAttributes(records));
    attributes.observe(this, { attributes: true });
    const density = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
    const recolor = () => this.#recolor();
    const [before, after] = [() => this.#session?.prepareForPrint(), recolor];
    density.addEventListener("change", recolor);
    addEventListener("beforeprint", before);
    addEventListener("afterprint", after);
    const interest = () => {
      this.#interested = true;
      this.#begin();
      // At once, so that the very touch that shows interest already takes hold of something.
      this.#session?.flush();
    };
    for (const type of ["pointerenter", "touchstart", "focusin"]) {
      this.addEventListener(type, interest, { passive: true });
    }
    this.#stop = [
      () => {
        for (const type of ["pointerenter", "touchstart", "focusin"]) {
          this.removeEventListener(type, interest);
        }
      },
      () => resized.disconnect(),
      () => attributes.disconnect(),
      () => density.removeEventListener("change", recolor),
      () => removeEventListener("beforeprint", before),
      () => removeEventListener("afterprint", after),
      watchTheme(recolor),
      watchVisibility(this, {
        near: (near) => {
          this.#near = near;
          if (near) void pageIsCalm().then(() => this.#begin());
        },
        seen: (inSight) => {
          this.#inSight = inSight;
          this.#session?.setInSight(inSight);
        },
      }),
    ];
    for (const type of ["pointerdown", "keydown", "input"]) {
      this.addEventListener(type, () => (this.#touched = true), { once: true, capture: true });
    }
    this.#recolor();
    if (this.#snapshot) this.#shell.jobs.follow(this.#snapshot.waiting);
    if (this.#isLinked()) void this.#open(true);
  }

  disconnectedCallback(): void {
    for (const stop of this.#stop) stop();
    this.#stop = [];
    this.#shell.speaker.silence();
    this.#session?.setInSight(false);
    this.#shell.jobs.end();
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
    const state = this.#session?.ask((engine) => engine.state()) ?? this.#state;
    return linkTo(this, wholeState(this, state, this.#snapshot), (key) => known.has(key));
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
    this.#touched = true;
    this.#session?.act((engine) => {
      problems = engine.apply(pairs);
      return undefined;
    });
    this.#warn(problems);
  }

  /** Presses a button of the figure. */
  press(id: string): void {
    this.#touched = true;
    this.#session?.act((engine) => engine.update({ type: "press", id }));
  }

  /** Back to the state that the page's author has set. */
  reset(): void {
    this.#shell.speaker.warn([]);
    if (!this.#session) {
      void this.#open(false);
      return;
    }
    let problems: Refused[] = [];
    this.#session.act((engine) => {
      const refused = engine.update({ type: "reset" });
      problems = engine.apply(parametersOf(this));
      return refused;
    });
    this.#warn(problems);
    this.#shell.speaker.say("Reset.");
  }

  /** Shows the present state at once, without waiting for the display. */
  flush(): void {
    this.#session?.flush();
  }

  get #width(): number {
    return this.#session?.width ?? 0;
  }

  #recolor(): void {
    askTheme(this, (theme) => {
      this.#shell.theme = theme;
      this.#session?.recolor(theme);
    });
  }

  /** Whether the page's address speaks of this figure. */
  #isLinked(): boolean {
    return parametersIn(location.search, this).own.length > 0;
  }

  /** Opens the figure unless that has been done. */
  #begin(): void {
    if (this.#near && !this.#session && this.#opening === 0) void this.#open(true);
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
    // Figures that have waited for the module would all open in one long task.
    if (!this.#interested) await myTurn();
    if (attempt !== this.#opening) return;
    this.#session?.end();
    this.#session = undefined;
    this.#shell.jobs.end();
    let engine: Engine;
    try {
      engine = new Engine(name, memory);
    } catch (problem) {
      this.#fail(`This figure cannot be shown: ${String(problem)}.`, false);
      return;
    }
    this.#ready = false;
    setAttribute(this, "data-failed", false);
    const problems = engine.apply(parametersOf(this));
    const { own, loose } = parametersIn(withAddress ? location.search : "", this);
    problems.push(...engine.apply(own));
    // Without a key, what the figure does not know is someone else's.
    const others = engine.apply(loose);
    problems.push(...others.filter(({ unknown }) => !unknown));
    const linked = own.length + loose.length > others.filter(({ unknown }) => unknown).length;

    const upgraded = defineProperties(this, engine.snapshot(760).controls);
    problems.push(...engine.apply(upgraded));
    this.#shell.introduce(engine.title, engine.help);
    this.#session = new Session(engine, this.#shell.picture.canvas, {
      drawn: (snapshot, painted) => this.#drawn(snapshot, painted, linked),
      refused: (sentence) => this.#shell.speaker.warn([`${capitalize(sentence)}.`], true),
      broke: (message) => {
        this.#session = undefined;
        this.#shell.jobs.end();
        this.#fail("This figure has stopped: a mistake of ours. Reset starts it again.", !this.#ready);
        this.#emit("epipole-error", { message });
      },
    });
    // The poster is this very picture; photographs are rendered once somebody takes an interest.
    const isShown = withAddress && !linked && problems.length === 0 && this.querySelector("img");
    if (isShown && !this.#interested) this.#session.hold();
    this.#session.recolor(this.#shell.theme);
    this.#shell.speaker.warn([]);
    this.#warn(problems);
    this.#session.resize(this.#room);
    this.#session.setInSight(this.#inSight);
  }

  #drawn(snapshot: Snapshot | undefined, painted: boolean, linked: boolean): void {
    if (painted) this.#shell.picture.reveal();
    if (snapshot) {
      const before = this.#snapshot;
      this.#snapshot = snapshot;
      const solved = this.#shell.update(snapshot);
      if (this.#ready) this.#tell(before, snapshot, solved);
    }
    if (!this.#ready) this.#becomeReady(linked);
  }

  #endJob(work: (engine: Engine) => boolean): void {
    this.#session?.learn((engine) => void work(engine));
  }

  #becomeReady(linked: boolean): void {
    this.#ready = true;
    this.#shell.reveal();
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
    this.#shell.speaker.moveOn();
    if (this.#touched && before?.description !== now.description) this.#shell.speaker.describe(now.description);
    const state = this.#session?.ask((engine) => engine.state()) ?? [];
    if (JSON.stringify(state) !== JSON.stringify(this.#state)) {
      this.#state = state;
      this.#emit("epipole-change", this.state);
    }
    const text = (snapshot?: Snapshot) => snapshot?.readouts.map((readout) => readout.text).join("|");
    if (text(before) !== text(now)) this.#emit("epipole-readout", this.readouts);
    for (const { id, goal } of solved) {
      this.#shell.speaker.say(`Solved: ${goal}`);
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
    this.#shell.speaker.warn([sentence]);
    if (again) {
      const retry = make("button", { type: "button" }, "Try again");
      retry.addEventListener("click", () => this.reset());
      this.#shell.speaker.notice.append(retry);
    }
  }

  #warn(problems: Refused[]): void {
    if (problems.length === 0) return;
    const sentences = problems.map(({ message }) => capitalize(message));
    for (const sentence of sentences) console.warn(`epipole-figure: ${sentence}`);
    this.#shell.speaker.warn(sentences.map((sentence) => `${sentence}.`));
  }

  #onAttributes(records: MutationRecord[]): void {
    const parameters = changedParameters(this, records, this.#snapshot);
    if (!this.#session || Object.keys(parameters).length === 0) return;
    this.#shell.speaker.warn([]);
    this.apply(parameters);
  }

  async #save(): Promise<void> {
    // A picture that waits for a computation is not the one that the reader wants to keep.
    while (this.#snapshot?.waiting && this.#session && this.#shell.jobs.busy) {
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
    else await this.requestFullscreen().catch(() => this.#shell.speaker.say("Full screen is not allowed here."));
  }
}

function capitalize(sentence: string): string {
  return sentence.charAt(0).toUpperCase() + sentence.slice(1);
}
