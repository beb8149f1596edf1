/**
 * `<epipole-figure name="…">`: a figure on a page.
 *
 * One class, long because it is the whole public surface: what a page can set, call and hear.
 */

import { changedParameters, parametersOf, wholeState } from "./attributes.js";
import type { Goal } from "./challenges.js";
import { CHOOSING, choiceOf } from "./choice.js";
import { whyMissing } from "./compile.js";
import type { Challenge, Parameters, Refused, Snapshot } from "./contract.js";
import { capitalize, make, setAttribute } from "./dom.js";
import { Engine, hurryModule, loadModule } from "./module.js";
import { Motion } from "./motion.js";
import { linkTo, parametersIn } from "./permalink.js";
import { defineProperties } from "./properties.js";
import { toSaved, type Saved } from "./saved.js";
import { layoutWidth, WIDTHS } from "./room.js";
import { Session } from "./session.js";
import { sheet } from "./sheet.js";
import { Shell } from "./shell.js";
import { StandIn } from "./stand_in.js";
import { askTheme, wantsStillness, watchDensity, watchTheme, type Theme } from "./theme.js";
import { myTurn, pageIsCalm, watchVisibility } from "./visibility.js";

/** How long a glide takes, milliseconds. */
const GLIDE_MS = 600;
/** The longest time that scrolling to a figure may take, milliseconds. */
const SCROLL_MS = 700;

/** A server that renders pages may import this file; it has no elements, and makes no figure. */
const Base: typeof HTMLElement = globalThis.HTMLElement ?? class {};

export class EpipoleFigure extends Base {
  static readonly observedAttributes = ["name", "theme", "compact", ...CHOOSING];

  readonly #shadow: ShadowRoot;
  #shell: Shell;
  /** What the page has brought along, until the figure is ready. */
  #standIn: StandIn | undefined;
  readonly #motion = new Motion({
    look: () => this.#session?.ask((engine) => engine.snapshot(this.#width || layoutWidth(1))),
    move: (work) => void this.#session?.move(work),
    apply: (parameters) => this.#put(parameters),
    busy: () => this.#snapshot?.waiting != null && this.#shell.jobs.busy,
    freeze: (frozen) => this.#session?.freeze(frozen),
    mark: (before, now) => {
      this.#session?.flush();
      this.#shell.markChanges(before, now);
    },
    point: (id) => this.#shell.markControl(id),
  });
  #session: Session | undefined;
  #snapshot: Snapshot | undefined;
  #state: Parameters = [];
  #theme: Theme = "light";
  #ready = false;
  /** The names of readouts that the page asks for have been compared with those that there are. */
  #judged = false;
  #awaited = gate();
  /** Somebody has done something; what comes by itself while the page loads is not announced. */
  #touched = false;
  #near = false;
  #inSight = false;
  /** Room for the picture, and how much of it the picture takes, CSS pixels. */
  #room = 0;
  #shown = 0;
  /** The width that the picture of a compact figure is laid out for. */
  #fitted: number | undefined;
  /** Somebody has pointed at the figure or gone into it. */
  #interested = false;
  #opening = 0;
  /** The goal whose solution is being played. */
  #playing: string | undefined;
  #resized: ResizeObserver | undefined;
  #stop: (() => void)[] = [];

  constructor() {
    super();
    this.#shadow = this.shadowRoot ?? this.attachShadow({ mode: "open" });
    this.#shadow.adoptedStyleSheets = [sheet()];
    this.#shell = this.#makeShell();
    this.#standIn = StandIn.in(this.#shadow);
    if (this.#standIn) this.#standIn.lend(this.#shell);
    else this.#shadow.append(this.#shell.root);
    const touch = () => (this.#touched = true);
    // Whoever takes hold of the figure ends what it does by itself.
    const takeOver = (event: Event) => {
      touch();
      if (event.isTrusted && !isModifier(event)) this.#stopMotion();
    };
    for (const type of ["pointerdown", "keydown", "input"]) {
      this.#shadow.addEventListener(type, takeOver, { capture: true });
    }
    // What is shown interest in is drawn with the next frame; it can be taken hold of at once.
    const interest = () => {
      this.#interested = true;
      this.#begin();
      this.#showLive();
    };
    for (const type of ["pointerenter", "touchstart", "focusin"]) {
      this.addEventListener(type, interest, { passive: true, capture: true });
    }
  }

  connectedCallback(): void {
    // JupyterLab hears keys before anybody else, and does nothing on them where it finds this.
    setAttribute(this, "data-lm-suppress-shortcuts", true);
    this.#shell.role = this.closest("figure") ? "group" : "figure";
    // What was set before the script had come hides the property that sets the attribute.
    if (Object.hasOwn(this, "compact")) {
      const { compact } = this;
      Reflect.deleteProperty(this, "compact");
      this.compact = compact;
    }
    // What observers tell is remembered: to ask would make the browser lay the page out at once.
    this.#resized = new ResizeObserver((entries) => this.#onResize(entries));
    this.#observeRoom();
    const attributes = new MutationObserver((records) => this.#onAttributes(records));
    attributes.observe(this, { attributes: true });
    const recolor = () => this.#recolor();
    const [before, after] = [() => this.#session?.prepareForPrint(), recolor];
    addEventListener("beforeprint", before);
    addEventListener("afterprint", after);
    this.#stop = [
      () => this.#resized?.disconnect(),
      () => attributes.disconnect(),
      () => removeEventListener("beforeprint", before),
      () => removeEventListener("afterprint", after),
      watchDensity(recolor),
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
    this.#recolor();
    if (this.#snapshot) this.#shell.jobs.follow(this.#snapshot.waiting);
    if (this.#isLinked()) void this.#open(true);
  }

  disconnectedCallback(): void {
    for (const stop of this.#stop) stop();
    this.#stop = [];
    this.#stopMotion();
    this.#shell.speaker.silence();
    this.#session?.setInSight(false);
    this.#shell.jobs.end();
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (name === "theme") this.#recolor();
    else if (name === "compact") this.#squeeze();
    else if (name !== "name") this.#choose();
    else if (before !== null && before !== now) this.#rename();
  }

  /** Parameters that differ from the figure's defaults, by name. Setting puts them on top. */
  get state(): Record<string, string> {
    return Object.fromEntries(this.#state);
  }

  set state(parameters: Record<string, string | number | boolean>) {
    this.apply(parameters);
  }

  /**
   * Whether the figure fits the height that its page gives: picture, main buttons and numbers, the rest behind a
   * button. The same as the attribute.
   */
  get compact(): boolean {
    return this.hasAttribute("compact");
  }

  set compact(compact: boolean) {
    this.toggleAttribute("compact", Boolean(compact));
  }

  /** The readouts by name. */
  get readouts(): Record<string, number | string> {
    return Object.fromEntries(this.#snapshot?.readouts.map(({ id, value }) => [id, value]) ?? []);
  }

  /** The goals, and which of them the reader has reached. */
  get goals(): Goal[] {
    return this.#shell.goals;
  }

  /** The names of the goals that the reader has reached. */
  get solved(): string[] {
    return this.goals.filter(({ solved }) => solved).map(({ id }) => id);
  }

  /** State and reached goals, for a page that keeps them. */
  get saved(): Saved {
    return toSaved(this.getAttribute("name") ?? "", this.state, this.solved);
  }

  /**
   * A readout as the figure shows it, with its unit. Undefined before it is known, as in a figure that
   * still computes what its page has brought along.
   */
  readoutText(id: string): string | undefined {
    if (!this.#shell.settled) return undefined;
    return this.#snapshot?.readouts.find((readout) => readout.id === id)?.text;
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

  /** A control's value as the figure shows it, with its unit. */
  controlText(id: string): string | undefined {
    return this.#snapshot?.controls.find((control) => control.id === id)?.value_text;
  }

  /** Resolves once the figure can be operated and asked. */
  whenReady(): Promise<void> {
    return this.#awaited.passed;
  }

  /** Takes parameters, as attributes do. */
  apply(parameters: Record<string, string | number | boolean>): void {
    this.#touched = true;
    this.#stopMotion();
    this.#warn(this.#put(textOf(parameters)));
  }

  /**
   * Moves sliders and points to parameters so that it can be watched, after bringing the figure into
   * view where that is needed. Choices and toggles change at once, and everything does for a reader
   * who wants no motion. Opens the figure if that has not been done. A second glide takes the first
   * one's goal over; a reader who takes hold of the figure ends it.
   */
  async glide(
    parameters: Record<string, string | number | boolean>,
    { duration = GLIDE_MS }: { duration?: number } = {},
  ): Promise<void> {
    this.#touched = true;
    this.#endPlay();
    this.#interested = true;
    this.#near = true;
    this.#begin();
    const problems = await this.#motion.glide(textOf(parameters), duration, this.#ready ? this.#comeIntoView() : this.#wake());
    this.#warn(problems);
  }

  /**
   * Lights up what the book has this letter for: a ring or a line in the color `--epipole-lit`. Nothing else stays
   * lit. Says whether the figure shows it.
   */
  light(symbol: string | undefined): boolean {
    return this.#shell.picture.light(symbol);
  }

  /** Presses a button of the figure. */
  press(id: string): void {
    this.#touched = true;
    this.#stopMotion();
    this.#session?.act((engine) => engine.update({ type: "press", id }));
  }

  /** Back to the state that the page's author has set. */
  reset(): void {
    this.#stopMotion();
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
    this.#shell.photos.forget();
    this.#shell.jobs.goOn();
    this.#warn(problems);
    this.#shell.speaker.say("Reset.");
    this.#emit("epipole-reset", {});
  }

  /**
   * Makes the state exactly this one, as a permalink or `state` has told it: what is not named takes the
   * figure's own default, whatever the attributes say. The goals named count as reached. Opens the figure if that
   * has not been done.
   */
  async restore(
    state: Record<string, string | number | boolean>,
    { solved = [] }: { solved?: string[] } = {},
  ): Promise<void> {
    this.#stopMotion();
    if (!this.#session) void this.#open(false);
    await this.whenReady();
    this.#stopMotion();
    this.#shell.speaker.warn([]);
    this.#session?.act((engine) => engine.update({ type: "reset" }));
    this.#shell.jobs.goOn();
    this.#warn(this.#put(textOf(state)));
    this.#shell.recall(solved);
  }

  /** Shows a sentence in the figure, and on the console. */
  warn(sentence: string): void {
    this.#complain([sentence]);
  }

  /** Shows the present state at once, without waiting for the display. */
  flush(): void {
    this.#session?.flush();
  }

  get #width(): number {
    return this.#session?.width ?? 0;
  }

  /** A new tree. What the tree of another figure still does or finds out is nobody's business. */
  #makeShell(): Shell {
    const mine = () => (this.#shell === shell ? this.#session : undefined);
    const endJob = (work: (engine: Engine) => boolean) => mine()?.learn((engine) => void work(engine));
    const shell: Shell = new Shell(
      {
        send: (event) => mine()?.act((engine) => engine.update(event)),
        hand: {
          handleAt: (x, y) => mine()?.ask((engine) => engine.handleAt(this.#width, x, y)),
          drag: (id, x, y) => mine()?.act((engine) => engine.drag(id, this.#width, x, y)),
          nudge: (id, towards, steps) =>
            mine()?.act((engine) => engine.nudge(id, this.#width, towards, steps)),
          moveToEnd: (id, towards) => mine()?.act((engine) => engine.moveToEnd(id, this.#width, towards)),
          remove: (id) => mine()?.act((engine) => engine.update({ type: "handle-removed", id })),
          click: (x, y) => {
            mine()?.act((engine) => engine.click(this.#width, x, y));
            // A point that a click has made can be dragged on at once.
            mine()?.flush();
          },
          set: (id, value) => mine()?.act((engine) => engine.update({ type: "set", id, value })),
        },
        deeds: {
          reset: () => this.reset(),
          link: () => this.permalink,
          save: () => void this.#save(),
          saveFile: () => this.#saveFile(),
          fullscreen: document.fullscreenEnabled ? () => void this.#toggleFullscreen() : undefined,
        },
        jobs: {
          next: () => {
            const job = mine()?.ask((engine) => engine.job());
            return job && { name: this.getAttribute("name") ?? "", ...job };
          },
          done: (key, result) => endJob((engine) => engine.jobDone(key, result)),
          failed: (key, sentence) => endJob((engine) => engine.jobFailed(key, sentence)),
        },
        takePhoto: (slot, photo) => mine()?.move((engine) => engine.takePhoto(slot, photo)),
        showHow: (challenge) => void this.#showHow(challenge),
      },
      choiceOf((name) => this.getAttribute(name)),
    );
    shell.compact = this.compact;
    return shell;
  }

  /** Another figure: everything that belongs to the old one goes. */
  #rename(): void {
    const wanted = this.#session !== undefined || this.#near || this.#opening > 0;
    this.#opening += 1;
    this.#stopMotion();
    this.#shell.end();
    this.#session?.end();
    this.#session = undefined;
    this.#snapshot = undefined;
    this.#state = [];
    if (this.#ready) this.#awaited = gate();
    this.#ready = false;
    setAttribute(this, "data-ready", false);
    this.#standIn = undefined;
    this.#shell = this.#makeShell();
    this.#shell.role = this.closest("figure") ? "group" : "figure";
    this.#shell.theme = this.#theme;
    this.#fitted = undefined;
    this.#shadow.replaceChildren(this.#shell.root);
    this.#observeRoom();
    if (wanted && this.isConnected) void this.#open(false);
  }

  /** Other controls, readouts and goals are to be shown. */
  #choose(): void {
    this.#shell.choose(choiceOf((name) => this.getAttribute(name)));
    if (!this.#session || !this.#snapshot) return;
    this.#shell.update(this.#snapshot);
    this.#fit();
    this.#shell.speaker.warn([]);
    this.#complain(this.#shell.misnamed(this.#snapshot));
  }

  /** Compact, or no longer. */
  #squeeze(): void {
    this.#shell.compact = this.compact;
    this.#observeRoom();
    this.#fit();
  }

  /** Finds the width to lay out a compact figure for. */
  #fit(): void {
    const look = (width: number) => this.#session?.ask((engine) => engine.snapshot(width).layout);
    const sizes = this.compact ? WIDTHS.map(look).filter((size) => size !== undefined) : [];
    this.#fitted = sizes.length > 0 && this.clientHeight > 0 ? this.#shell.arrange(sizes) : undefined;
    this.#session?.resize(this.#room, this.#shown, this.#fitted);
  }

  #observeRoom(): void {
    this.#resized?.disconnect();
    if (this.compact) this.#resized?.observe(this);
    const standing = this.#standIn?.picture;
    if (standing) this.#resized?.observe(standing);
    else {
      this.#resized?.observe(this.#shell.picture.element);
      const { sheet } = this.#shell.picture;
      try {
        // Tells of another density as well.
        this.#resized?.observe(sheet, { box: "device-pixel-content-box" });
      } catch {
        this.#resized?.observe(sheet);
      }
    }
  }

  #onResize(entries: ResizeObserverEntry[]): void {
    for (const { target, contentRect } of entries) {
      if (target === this) this.#fit();
      else if (target === this.#shell.picture.sheet) this.#shown = contentRect.width;
      else this.#room = contentRect.width;
    }
    this.#session?.resize(this.#room, this.#shown, this.#fitted);
  }

  #recolor(): void {
    askTheme(this, (theme) => {
      this.#theme = theme;
      this.#shell.theme = theme;
      if (this.#standIn) this.#standIn.theme = theme;
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
    setAttribute(this, "data-failed", false);
    const name = this.getAttribute("name") ?? "";
    let memory: WebAssembly.Memory;
    try {
      ({ memory } = await loadModule(() => {
        if (attempt !== this.#opening) return;
        this.#say("The interactive part of this figure is slow to come.", hurryModule);
      }));
    } catch (problem) {
      if (attempt === this.#opening) this.#fail(`${whyMissing(problem, "The interactive part of this figure")}.`, true);
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
    const problems = engine.apply(parametersOf(this));
    const { own, loose } = parametersIn(withAddress ? location.search : "", this);
    problems.push(...engine.apply(own));
    // Without a key, what the figure does not know is someone else's.
    const others = engine.apply(loose);
    problems.push(...others.filter(({ unknown }) => !unknown));
    const linked = own.length + loose.length > others.filter(({ unknown }) => unknown).length;

    const first = engine.snapshot(layoutWidth(this.#room));
    const upgraded = defineProperties(this, first.controls);
    problems.push(...engine.apply(upgraded));
    this.#shell.introduce(engine.title, engine.help);
    if (first.waiting !== null && !this.#touched) this.#standIn?.lendNumbers(this.#shell);
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
    if (isShown && (!this.#interested || first.waiting !== null)) this.#session.hold();
    this.#session.recolor(this.#theme);
    this.#shell.speaker.warn([]);
    this.#complain([...problems.map(({ message }) => message), ...this.#shell.misnamed(first)]);
    this.#judged = first.waiting === null;
    if (this.compact) {
      // How much room the bar takes shows once its buttons and numbers are there.
      this.#shell.update(first, this.#touched);
      this.#fit();
    } else this.#session.resize(this.#room, this.#shown);
    this.#session.setInSight(this.#inSight);
  }

  #drawn(snapshot: Snapshot | undefined, painted: boolean, linked: boolean): void {
    if (painted) this.#shell.picture.reveal();
    if (snapshot) {
      const before = this.#snapshot;
      this.#snapshot = snapshot;
      const solved = this.#shell.update(snapshot, this.#touched);
      if (!this.#judged && snapshot.waiting === null) {
        this.#judged = true;
        this.#complain(this.#shell.misnamed(snapshot));
      }
      if (this.#ready) this.#tell(before, snapshot, solved);
      if (this.#interested) this.#showLive();
    }
    if (!this.#ready) this.#becomeReady(linked);
  }

  /** Draws in place of the poster; not while the figure waits for what the poster shows already. */
  #showLive(): void {
    if (this.#snapshot?.waiting === null) this.#session?.release();
  }

  #becomeReady(linked: boolean): void {
    this.#ready = true;
    this.#shell.reveal();
    if (this.#standIn) {
      this.#standIn.yield(this.#shell);
      this.#standIn = undefined;
      this.#observeRoom();
    }
    this.#state = this.#session?.ask((engine) => engine.state()) ?? [];
    setAttribute(this, "data-ready", true);
    // In a frame the address is the figure's alone, and the page around it would be moved.
    if (linked && !location.hash && parent === window) this.scrollIntoView({ block: "start" });
    this.#awaited.pass();
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

  /** Puts parameters on top of the state; those that could not be used come back. */
  #put(parameters: Parameters): Refused[] {
    let problems: Refused[] = [];
    this.#session?.act((engine) => {
      problems = engine.apply(parameters);
      return undefined;
    });
    return problems;
  }

  /** Waits for the figure to be there, whether anybody sees it or not; not for one that never comes. */
  async #wake(): Promise<void> {
    while (!this.#session && !this.hasAttribute("data-failed")) {
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    // In a hidden page no frame would come, and without room none is drawn.
    this.#session?.flush();
    await this.#comeIntoView();
  }

  /** Scrolls so that the picture is seen, if it is not; the focus stays where it is. */
  async #comeIntoView(): Promise<void> {
    const { element } = this.#shell.picture;
    const box = element.getBoundingClientRect();
    const top = parseFloat(getComputedStyle(element).scrollMarginTop) || 0;
    if (document.hidden || box.height === 0 || (box.top >= top && box.bottom <= innerHeight)) return;
    const still = wantsStillness();
    element.scrollIntoView({ block: "nearest", behavior: still ? "instant" : "smooth" });
    if (still) return;
    await new Promise<void>((resolve) => {
      const timer = setTimeout(resolve, SCROLL_MS);
      const done = () => {
        clearTimeout(timer);
        resolve();
      };
      addEventListener("scrollend", done, { once: true, capture: true });
    });
  }

  /** Plays the solution of a goal from the default state, or ends that. */
  async #showHow(challenge: string): Promise<void> {
    const again = this.#playing !== challenge;
    this.#stopMotion();
    const events = this.#session?.ask((engine) => engine.solution(challenge));
    if (!again || !events || events.length === 0) return;
    this.#playing = this.#shell.playing = challenge;
    this.#session?.act((engine) => engine.update({ type: "reset" }));
    this.#shell.jobs.goOn();
    await this.#motion.play(events);
    if (this.#playing === challenge) this.#endPlay();
  }

  #endPlay(): void {
    if (this.#playing === undefined) return;
    this.#playing = this.#shell.playing = undefined;
    this.#motion.stop();
  }

  #stopMotion(): void {
    this.#endPlay();
    this.#motion.stop();
  }

  /** A sentence where the figure should be; the poster stays, and Reset tries again. */
  #fail(sentence: string, again: boolean): void {
    this.#opening = 0;
    setAttribute(this, "data-failed", true);
    this.#say(sentence, again ? () => this.reset() : undefined);
  }

  /** A sentence, and a way on. */
  #say(sentence: string, again: (() => void) | undefined): void {
    this.#shell.speaker.warn([sentence]);
    if (!again) return;
    const retry = make("button", { type: "button" }, "Try again");
    retry.addEventListener("click", again);
    this.#shell.speaker.notice.append(retry);
  }

  #warn(problems: Refused[]): void {
    this.#complain(problems.map(({ message }) => message));
  }

  /** Shows sentences in the figure and on the console. */
  #complain(messages: string[]): void {
    if (messages.length === 0) return;
    const sentences = messages.map((message) => capitalize(message));
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
      if (blob) download(blob, `${this.getAttribute("name")}.png`);
    });
  }

  #saveFile(): void {
    const { extension, is_ready: isReady } = this.#snapshot?.file ?? {};
    const bytes = this.#session?.ask((engine) => engine.file());
    if (isReady && bytes) download(new Blob([bytes]), `${this.getAttribute("name")}.${extension}`);
  }

  async #toggleFullscreen(): Promise<void> {
    if (document.fullscreenElement) await document.exitFullscreen();
    else await this.requestFullscreen().catch(() => this.#shell.speaker.say("Full screen is not allowed here."));
  }
}

/** Offers a file for saving, as if a link to it had been followed. */
function download(blob: Blob, name: string): void {
  const link = make("a", { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

function textOf(parameters: Record<string, string | number | boolean>): Parameters {
  return Object.entries(parameters).map(([key, value]) => [key, String(value)]);
}

/** Keys that do nothing by themselves, and the one that only goes on. */
function isModifier(event: Event): boolean {
  return event instanceof KeyboardEvent && /^(Shift|Control|Alt|Meta|Tab)$/.test(event.key);
}

function gate(): { passed: Promise<void>; pass: () => void } {
  let pass = () => {};
  const passed = new Promise<void>((resolve) => (pass = resolve));
  return { passed, pass };
}
