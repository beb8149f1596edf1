/**
 * What goes on behind an element: its tree, the figure that runs in it, the page around both, and how one comes to
 * the other. `element.ts` is what a page sees of it.
 *
 * Longer than most files: opening, drawing, renaming and leaving change the same few facts, and nobody else does. How
 * large the picture is made is found in `size_observer.ts`, and who hears of what in `announcer.ts`.
 */

import { actsOn } from "./acts.js";
import { Announcer } from "./announcer.js";
import { changedParameters } from "./attributes.js";
import { choiceOf } from "./choice.js";
import { whyMissing } from "./compile.js";
import type { Parameters, Refused, Snapshot } from "./contract.js";
import { capitalize, setAttribute } from "./dom.js";
import { Engine, hurryModule, loadModule, panicMessage } from "./module.js";
import { Motion } from "./motion.js";
import { openState } from "./opening.js";
import { parametersIn } from "./permalink.js";
import { Placeholder } from "./placeholder.js";
import type { Host } from "./properties.js";
import { Renderer } from "./renderer.js";
import { layoutWidth } from "./room.js";
import { saveFile, savePicture } from "./saving.js";
import { sheet } from "./sheet.js";
import { Shell } from "./shell.js";
import { SizeObserver } from "./size_observer.js";
import { askTheme, watchDensity, watchTheme, type Theme } from "./theme.js";
import { bringIntoView, myTurn, pageIsCalm, watchVisibility } from "./visibility.js";

/** The element, as far as its controller needs it. */
export interface FigureHost extends Host {
  readonly compact: boolean;
  readonly state: Record<string, string>;
  readonly readouts: Record<string, number | string>;
  readonly permalink: string;
  reset: () => void;
}

export class FigureController {
  readonly #host: FigureHost;
  readonly #shadow: ShadowRoot;
  #shell: Shell;
  /** What the page has brought along, until the figure is ready. */
  #placeholder: Placeholder | undefined;
  readonly #motion = new Motion({
    look: () => this.#renderer?.ask((engine) => engine.snapshot(this.#width || layoutWidth(1))),
    move: (work) => void this.#renderer?.move(work),
    apply: (parameters) => this.put(parameters),
    busy: () => this.#snapshot?.waiting != null && this.#shell.jobs.busy,
    freeze: (frozen) => this.#renderer?.freeze(frozen),
    mark: (before, now) => {
      this.#renderer?.show();
      this.#shell.markChanges(before, now);
    },
    point: (id) => this.#shell.markControl(id),
  });
  #renderer: Renderer | undefined;
  #snapshot: Snapshot | undefined;
  #theme: Theme = "light";
  #ready = false;
  /** The names of readouts that the page asks for have been compared with those that there are. */
  #judged = false;
  #awaited = gate();
  /** Somebody has done something; what comes by itself while the page loads is not announced. */
  #touched = false;
  #near = false;
  #inSight = false;
  /** Somebody has pointed at the figure or gone into it. */
  #interested = false;
  #opening = 0;
  /** The goal whose solution is being played. */
  #playing: string | undefined;
  readonly #size: SizeObserver;
  readonly #announcer: Announcer;
  #stop: (() => void)[] = [];

  constructor(host: FigureHost) {
    this.#host = host;
    this.#shadow = host.shadowRoot ?? host.attachShadow({ mode: "open" });
    this.#shadow.adoptedStyleSheets = [sheet()];
    this.#shell = this.#makeShell();
    this.#announcer = new Announcer(host);
    this.#size = new SizeObserver(host, () => ({
      shell: this.#shell,
      renderer: this.#renderer,
      standing: this.#placeholder?.picture ?? undefined,
    }));
    this.#placeholder = Placeholder.in(this.#shadow);
    if (this.#placeholder) this.#placeholder.lend(this.#shell);
    else this.#shadow.append(this.#shell.root);
    // Whoever takes hold of the figure ends what it does by itself.
    const takeOver = (event: Event) => {
      this.touch();
      if (event.isTrusted && !isModifier(event)) this.stopMotion();
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
      host.addEventListener(type, interest, { passive: true, capture: true });
    }
  }

  get shell(): Shell {
    return this.#shell;
  }

  /** The running figure, once there is one. */
  get renderer(): Renderer | undefined {
    return this.#renderer;
  }

  /** What was drawn last. */
  get snapshot(): Snapshot | undefined {
    return this.#snapshot;
  }

  /** What differs from the figure's defaults. */
  get state(): Parameters {
    return this.#announcer.state;
  }

  /** Resolves once the figure can be operated and asked. */
  get whenReady(): Promise<void> {
    return this.#awaited.passed;
  }

  /** The element has come into a page. */
  connect(): void {
    const host = this.#host;
    this.#shell.role = this.#role;
    this.#size.start();
    const attributes = new MutationObserver((records) => this.#onAttributes(records));
    attributes.observe(host, { attributes: true });
    const recolor = () => this.recolor();
    const [before, after] = [() => this.#renderer?.prepareForPrint(), recolor];
    addEventListener("beforeprint", before);
    addEventListener("afterprint", after);
    this.#stop = [
      () => this.#size.stop(),
      () => attributes.disconnect(),
      () => removeEventListener("beforeprint", before),
      () => removeEventListener("afterprint", after),
      watchDensity(recolor),
      watchTheme(recolor),
      watchVisibility(host, {
        near: (near) => {
          this.#near = near;
          if (near) void pageIsCalm().then(() => this.#begin());
        },
        seen: (inSight) => {
          this.#inSight = inSight;
          this.#renderer?.setInSight(inSight);
        },
      }),
    ];
    this.recolor();
    if (this.#snapshot) this.#shell.jobs.follow(this.#snapshot.waiting);
    if (this.#isLinked()) void this.open(true);
  }

  /** It has left the page; it may come back. */
  disconnect(): void {
    for (const stop of this.#stop) stop();
    this.#stop = [];
    this.stopMotion();
    this.#shell.speaker.silence();
    this.#renderer?.setInSight(false);
    this.#shell.jobs.end();
  }

  /** Another figure: everything that belongs to the old one goes. */
  rename(): void {
    const wanted = this.#renderer !== undefined || this.#near || this.#opening > 0;
    this.#opening += 1;
    this.stopMotion();
    this.#shell.end();
    this.#renderer?.end();
    this.#renderer = undefined;
    this.#snapshot = undefined;
    this.#announcer.forget();
    if (this.#ready) this.#awaited = gate();
    this.#ready = false;
    setAttribute(this.#host, "data-ready", false);
    this.#placeholder = undefined;
    this.#shell = this.#makeShell();
    this.#shell.role = this.#role;
    this.#shell.theme = this.#theme;
    this.#shadow.replaceChildren(this.#shell.root);
    this.#size.forget();
    if (wanted && this.#host.isConnected) void this.open(false);
  }

  /** Other controls, readouts and goals are to be shown. */
  choose(): void {
    this.#shell.choose(choiceOf((name) => this.#host.getAttribute(name)));
    if (!this.#renderer || !this.#snapshot) return;
    this.#shell.update(this.#snapshot, this.#touched);
    this.#size.fit();
    this.#shell.speaker.warn([]);
    this.#shell.speaker.complain(this.#shell.misnamed(this.#snapshot));
  }

  /** Compact, or no longer. */
  squeeze(): void {
    this.#shell.compact = this.#host.compact;
    this.#size.observe();
    this.#size.fit();
  }

  /** Finds out what colors the figure takes, and takes them. */
  recolor(): void {
    askTheme(this.#host, (theme) => {
      this.#theme = theme;
      this.#shell.theme = theme;
      if (this.#placeholder) this.#placeholder.theme = theme;
      this.#renderer?.recolor(theme);
    });
  }

  /** Somebody has done something to the figure. */
  touch(): void {
    this.#touched = true;
  }

  /** Puts parameters on top of the state; those that could not be used come back. */
  put(parameters: Parameters): Refused[] {
    let problems: Refused[] = [];
    this.#renderer?.act((engine) => {
      problems = engine.apply(parameters);
      return undefined;
    });
    return problems;
  }

  /** Says which parameters could not be used. */
  warn(problems: Refused[]): void {
    this.#shell.speaker.complain(problems.map(({ message }) => message));
  }

  /** Moves what can be moved to parameters, after waking the figure and bringing it into view. */
  glide(parameters: Parameters, duration: number): Promise<Refused[]> {
    this.#endPlay();
    this.#interested = true;
    this.#near = true;
    this.#begin();
    return this.#motion.glide(parameters, duration, this.#ready ? this.#comeIntoView() : this.#wake());
  }

  /** Ends what the figure does by itself. */
  stopMotion(): void {
    this.#endPlay();
    this.#motion.stop();
  }

  /** Opens the figure; `withAddress` lets the page's address speak. */
  async open(withAddress: boolean): Promise<void> {
    const attempt = ++this.#opening;
    setAttribute(this.#host, "data-failed", false);
    const name = this.#host.getAttribute("name") ?? "";
    let memory: WebAssembly.Memory;
    try {
      ({ memory } = await loadModule(() => {
        if (attempt !== this.#opening) return;
        this.#shell.speaker.offer("The interactive part of this figure is slow to come.", hurryModule);
      }));
    } catch (problem) {
      if (attempt === this.#opening) this.#fail(`${whyMissing(problem, "The interactive part of this figure")}.`, true);
      return;
    }
    // Figures that have waited for the module would all open in one long task.
    if (!this.#interested) await myTurn();
    if (attempt !== this.#opening) return;
    this.#renderer?.end();
    this.#renderer = undefined;
    this.#shell.jobs.end();
    let engine: Engine;
    try {
      engine = new Engine(name, memory);
    } catch (problem) {
      this.#fail(`This figure cannot be shown: ${String(problem)}.`, false);
      return;
    }
    try {
      this.#start(engine, withAddress);
    } catch (problem) {
      const message = panicMessage() ?? String(problem);
      console.error(`epipole-figure: ${message}`);
      engine.free();
      this.#break(message);
    }
  }

  /** A picture that waits for a computation is not the one that anybody wants to keep. */
  async answered(): Promise<void> {
    while (this.#snapshot?.waiting && this.#renderer && this.#shell.jobs.busy) {
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
  }

  get #width(): number {
    return this.#renderer?.width ?? 0;
  }

  get #role(): "figure" | "group" {
    return this.#host.closest("figure") ? "group" : "figure";
  }

  /** A new tree. What the tree of another figure still does or finds out is nobody's business. */
  #makeShell(): Shell {
    const host = this.#host;
    const mine = () => (this.#shell === shell ? this.#renderer : undefined);
    const name = () => host.getAttribute("name") ?? "";
    const shell: Shell = new Shell(
      {
        ...actsOn({ renderer: mine, name }),
        deeds: {
          reset: () => host.reset(),
          link: () => host.permalink,
          save: () => void this.#save(),
          saveFile: () => {
            const renderer = mine();
            if (renderer) saveFile(renderer, this.#snapshot?.file, name());
          },
          fullscreen: document.fullscreenEnabled ? () => void this.#toggleFullscreen() : undefined,
        },
        showHow: (challenge) => void this.#showHow(challenge),
      },
      choiceOf((key) => host.getAttribute(key)),
    );
    shell.compact = host.compact;
    return shell;
  }

  #onAttributes(records: MutationRecord[]): void {
    const parameters = changedParameters(this.#host, records, this.#snapshot);
    if (!this.#renderer || Object.keys(parameters).length === 0) return;
    this.#shell.speaker.warn([]);
    this.#host.apply(parameters);
  }

  /** Whether the page's address speaks of this figure. */
  #isLinked(): boolean {
    return parametersIn(location.search, this.#host).own.length > 0;
  }

  /** Opens the figure unless that has been done. */
  #begin(): void {
    if (this.#near && !this.#renderer && this.#opening === 0) void this.open(true);
  }

  /** Lets a new figure run. */
  #start(engine: Engine, withAddress: boolean): void {
    const host = this.#host;
    this.#ready = false;
    const { first, problems, linked } = openState(engine, host, layoutWidth(this.#size.room), withAddress);
    this.#shell.introduce(engine.title, engine.help);
    if (first.waiting !== null && !this.#touched) this.#placeholder?.lendNumbers(this.#shell);
    this.#renderer = new Renderer(engine, this.#shell.picture.canvas, {
      drawn: (snapshot, painted) => this.#drawn(snapshot, painted, linked),
      refused: (sentence) => this.#shell.speaker.warn([`${capitalize(sentence)}.`], true),
      broke: (message) => this.#break(message),
    });
    // The poster is this very picture; photographs are rendered once somebody takes an interest.
    const isShown = withAddress && !linked && problems.length === 0 && host.querySelector("img");
    if (isShown) this.#renderer.hold();
    if (this.#interested && first.waiting === null) this.#renderer.release();
    this.#renderer.recolor(this.#theme);
    this.#shell.speaker.warn([]);
    this.#shell.speaker.complain([...problems.map(({ message }) => message), ...this.#shell.misnamed(first)]);
    this.#judged = first.waiting === null;
    if (host.compact) {
      // How much room the bar takes shows once its buttons and numbers are there.
      this.#shell.update(first, this.#touched);
      this.#size.fit();
    } else this.#size.resize();
    this.#renderer.setInSight(this.#inSight);
  }

  #drawn(snapshot: Snapshot | undefined, painted: boolean, linked: boolean): void {
    if (painted) this.#shell.picture.reveal();
    if (snapshot) {
      const before = this.#snapshot;
      this.#snapshot = snapshot;
      const solved = this.#shell.update(snapshot, this.#touched);
      if (!this.#judged && snapshot.waiting === null) {
        this.#judged = true;
        this.#shell.speaker.complain(this.#shell.misnamed(snapshot));
      }
      if (this.#ready) {
        const state = this.#askState();
        this.#announcer.changed(this.#shell, { before, now: snapshot, solved, state, touched: this.#touched });
      }
      if (this.#interested) this.#showLive();
    }
    if (!this.#ready) this.#becomeReady(linked);
  }

  /** Draws in place of the poster; not while the figure waits for what the poster shows already. */
  #showLive(): void {
    if (this.#snapshot?.waiting === null) this.#renderer?.release();
  }

  #becomeReady(linked: boolean): void {
    const host = this.#host;
    this.#ready = true;
    this.#shell.reveal();
    if (this.#placeholder) {
      this.#placeholder.yield(this.#shell);
      this.#placeholder = undefined;
      this.#size.observe();
    }
    this.#announcer.begin(this.#askState());
    setAttribute(host, "data-ready", true);
    // In a frame the address is the figure's alone, and the page around it would be moved.
    if (linked && !location.hash && parent === window) host.scrollIntoView({ block: "start" });
    this.#awaited.pass();
    this.#announcer.ready();
  }

  #askState(): Parameters {
    return this.#renderer?.ask((engine) => engine.state()) ?? [];
  }

  /** Waits for the figure to be there, whether anybody sees it or not; not for one that never comes. */
  async #wake(): Promise<void> {
    while (!this.#renderer && !this.#host.hasAttribute("data-failed")) {
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    this.#renderer?.show();
    await this.#comeIntoView();
  }

  #comeIntoView(): Promise<void> {
    return bringIntoView(this.#shell.picture.element);
  }

  /** Plays the solution of a goal from the default state, or ends that. */
  async #showHow(challenge: string): Promise<void> {
    const again = this.#playing !== challenge;
    this.stopMotion();
    const events = this.#renderer?.ask((engine) => engine.solution(challenge));
    if (!again || !events || events.length === 0) return;
    this.#playing = this.#shell.playing = challenge;
    this.#renderer?.act((engine) => engine.update({ type: "reset" }));
    this.#shell.jobs.goOn();
    await this.#motion.play(events);
    if (this.#playing === challenge) this.#endPlay();
  }

  #endPlay(): void {
    if (this.#playing === undefined) return;
    this.#playing = this.#shell.playing = undefined;
    this.#motion.stop();
  }

  /** A sentence where the figure should be; the poster stays, and Reset tries again. */
  #fail(sentence: string, again: boolean): void {
    this.#opening = 0;
    setAttribute(this.#host, "data-failed", true);
    this.#shell.speaker.offer(sentence, again ? () => this.#host.reset() : undefined);
  }

  /** The module has panicked. */
  #break(message: string): void {
    this.#renderer = undefined;
    this.#shell.jobs.end();
    this.#fail("This figure has stopped: a mistake of ours. Reset starts it again.", !this.#ready);
    this.#announcer.emit("epipole-error", { message });
  }

  async #save(): Promise<void> {
    await this.answered();
    if (this.#renderer) await savePicture(this.#renderer, this.#host.getAttribute("name") ?? "");
  }

  async #toggleFullscreen(): Promise<void> {
    if (document.fullscreenElement) await document.exitFullscreen();
    else await this.#host.requestFullscreen().catch(() => this.#shell.speaker.say("Full screen is not allowed here."));
  }
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
