/** Controller of an element: applies the effects of its lifecycle to the tree, the figure and the page. */

import { actsOn, stageOn } from "./acts.js";
import { Announcer } from "./announcer.js";
import { changedParameters } from "./attributes.js";
import type { Refused, Snapshot } from "./contract.js";
import { capitalize, setAttribute } from "./dom.js";
import { listenToReader, observeHost, type FigureHost } from "./host.js";
import { INITIAL, reduce, type Effect, type LifecycleEvent } from "./lifecycle.js";
import { hurryModule, type Engine } from "./module.js";
import { Motion } from "./motion.js";
import { Failure, openEngine, openState } from "./opening.js";
import { type Parameters, parametersIn } from "./permalink.js";
import { Renderer } from "./renderer.js";
import { layoutWidth } from "./room.js";
import type { Shell } from "./shell.js";
import { SizeObserver } from "./size_observer.js";
import { askTheme } from "./theme.js";
import { View } from "./view.js";
import { bringIntoView, pageIsCalm } from "./visibility.js";

export class FigureController {
  readonly #host: FigureHost;
  readonly #announcer: Announcer;
  readonly #size: SizeObserver;
  readonly #view: View;
  readonly #motion: Motion;
  #state = INITIAL;
  #renderer: Renderer | undefined;
  #snapshot: Snapshot | undefined;
  #stopObserving = () => {};

  constructor(host: FigureHost) {
    this.#host = host;
    const parts = {
      host,
      renderer: () => this.#renderer,
      snapshot: () => this.#snapshot,
      shell: () => this.shell,
      answered: () => this.answered(),
      toggleSolution: (challenge: string) => {
        this.dispatch({ type: "touch", own: false });
        void this.#motion.toggleSolution(challenge);
      },
    };
    this.#view = new View(host, (isCurrent) =>
      actsOn({ ...parts, renderer: () => (isCurrent() ? this.#renderer : undefined) }),
    );
    this.#motion = new Motion(stageOn(parts));
    this.#announcer = new Announcer(host);
    this.#size = new SizeObserver(host, () => ({
      shell: this.shell,
      renderer: this.#renderer,
      standing: this.#view.placeholder?.picture ?? undefined,
    }));
    listenToReader(host, this.#view.root, {
      interest: () => this.dispatch({ type: "interest" }),
      takeOver: (byReader) => {
        this.dispatch({ type: "touch", own: byReader });
        if (byReader) this.stopMotion();
      },
    });
  }

  get shell(): Shell {
    return this.#view.shell;
  }

  /** The running figure. */
  get renderer(): Renderer | undefined {
    return this.#renderer;
  }

  /** Last presented snapshot. */
  get snapshot(): Snapshot | undefined {
    return this.#snapshot;
  }

  /** Parameters that differ from the figure's defaults. */
  get state(): Parameters {
    return this.#announcer.state;
  }

  /** Resolves once the figure can be operated and queried. */
  get whenReady(): Promise<void> {
    return this.#announcer.whenReady;
  }

  dispatch(event: LifecycleEvent): void {
    const [state, effects] = reduce(this.#state, event);
    this.#state = state;
    for (const effect of effects) this.#run(effect);
  }

  connect(): void {
    this.#view.connect();
    this.#size.start();
    this.#stopObserving = observeHost(this.#host, {
      attributes: (records) => this.#onAttributes(records),
      recolor: () => this.recolor(),
      print: () => this.#renderer?.prepareForPrint(),
      near: (near) => {
        this.dispatch({ type: "near", near });
        if (near) void pageIsCalm().then(() => this.dispatch({ type: "idle" }));
      },
      seen: (visible) => this.dispatch({ type: "visible", visible }),
    });
    this.recolor();
    if (this.#snapshot) this.shell.jobs.follow(this.#snapshot.waiting);
    if (parametersIn(location.search, this.#host).own.length > 0) this.dispatch({ type: "open", withAddress: true });
  }

  /** Stops invisible work; the element may be connected again. */
  disconnect(): void {
    this.#size.stop();
    this.#stopObserving();
    this.stopMotion();
    this.shell.speaker.silence();
    this.dispatch({ type: "visible", visible: false });
    this.shell.jobs.end();
  }

  /** Shows the controls, readouts and goals named by the attributes. */
  choose(): void {
    this.#view.choose();
    if (!this.#renderer || !this.#snapshot) return;
    this.shell.update(this.#snapshot, this.#state);
    this.#size.fit();
    this.shell.speaker.warn([]);
    this.shell.speaker.complain(this.shell.misnamed(this.#snapshot));
  }

  /** Applies the layout of the attribute `compact`. */
  squeeze(): void {
    this.#view.squeeze();
    this.#size.observe();
    this.#size.fit();
  }

  /** Determines and applies the colors of the page. */
  recolor(): void {
    askTheme(this.#host, (theme) => {
      this.#view.theme = theme;
      this.#renderer?.recolor(theme);
    });
  }

  /** Reports parameters that could not be used. */
  warn(problems: Refused[]): void {
    this.shell.speaker.complain(problems.map(({ message }) => message));
  }

  /** Glides to parameters, after opening the figure and, if `scroll`, bringing it into view. */
  glide(parameters: Parameters, duration: number, scroll: boolean): Promise<Refused[]> {
    this.dispatch({ type: "wanted" });
    return this.#motion.glide(parameters, duration, scroll ? this.#comeIntoView() : this.#running());
  }

  /** Ends running glides and solutions. */
  stopMotion(): void {
    this.#motion.stop();
  }

  /** Resolves when the figure has finished computing. */
  async answered(): Promise<void> {
    while (this.#snapshot?.waiting && this.#renderer && this.shell.jobs.busy) {
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
  }

  #run(effect: Effect): void {
    switch (effect.type) {
      case "load":
        return void this.#load(effect.attempt, effect.withAddress);
      case "dispose":
        return this.#dispose(effect.wasReady);
      case "fail":
        this.#endRenderer();
        setAttribute(this.#host, "data-failed", true);
        return this.shell.speaker.offer(effect.sentence, effect.retry ? () => this.#host.reset() : undefined);
      case "checkNames":
        if (this.#snapshot) this.shell.speaker.complain(this.shell.misnamed(this.#snapshot));
        return;
      case "becomeReady":
        return this.#becomeReady(effect.linked);
      default:
        this.#renderer?.run(effect);
    }
  }

  #onAttributes(records: MutationRecord[]): void {
    const parameters = changedParameters(this.#host, records, this.#snapshot);
    if (!this.#renderer || Object.keys(parameters).length === 0) return;
    this.shell.speaker.warn([]);
    this.#host.apply(parameters);
  }

  async #load(attempt: number, withAddress: boolean): Promise<void> {
    const isCurrent = () => attempt === this.#state.attempt;
    setAttribute(this.#host, "data-failed", false);
    try {
      const engine = await openEngine(this.#host.getAttribute("name") ?? "", {
        isCurrent,
        isUrgent: () => this.#state.interested,
        slow: () => this.shell.speaker.offer("The interactive part of this figure is slow to come.", hurryModule),
      });
      if (engine && isCurrent()) this.#start(engine, withAddress);
      else engine?.free();
    } catch (problem) {
      if (!(problem instanceof Failure)) throw problem;
      if (isCurrent()) this.dispatch({ type: "failed", ...problem });
    }
  }

  #start(engine: Engine, withAddress: boolean): void {
    this.#endRenderer();
    const [host, shell] = [this.#host, this.shell];
    const renderer = new Renderer(engine, shell.picture.canvas, {
      state: () => this.#state,
      dispatch: (event) => this.dispatch(event),
      present: (snapshot, painted) => this.#present(snapshot, painted),
      refused: (sentence) => shell.speaker.warn([`${capitalize(sentence)}.`], true),
      panicked: (message) => this.#onPanic(message),
    });
    const opened = renderer.ask(() => openState(engine, host, layoutWidth(this.#size.room), withAddress));
    if (!opened) return;
    const { title, help, first, problems, linked } = opened;
    const waiting = first.waiting !== null;
    shell.introduce(title, help);
    if (waiting && !this.#state.touched) this.#view.placeholder?.lendNumbers(shell);
    this.#renderer = renderer;
    const covered = withAddress && !linked && problems.length === 0 && host.querySelector("img") !== null;
    this.dispatch({ type: "started", covered, waiting, linked });
    renderer.recolor(this.#view.theme);
    shell.speaker.warn([]);
    shell.speaker.complain([...problems.map(({ message }) => message), ...shell.misnamed(first)]);
    // The room for a compact picture depends on the buttons and numbers in the bar.
    if (host.compact) {
      shell.update(first, this.#state);
      this.#size.fit();
    } else this.#size.resize();
  }

  #present(snapshot: Snapshot | undefined, painted: boolean): void {
    const shell = this.shell;
    if (painted) shell.picture.reveal();
    if (snapshot) {
      const before = this.#snapshot;
      this.#snapshot = snapshot;
      const { touched } = this.#state;
      const solved = shell.update(snapshot, this.#state);
      this.dispatch({ type: "snapshot", waiting: snapshot.waiting !== null });
      if (this.#state.ready) {
        this.#announcer.changed(shell, { before, now: snapshot, solved, state: this.#askState(), touched });
      }
    }
    this.dispatch({ type: "presented" });
  }

  #becomeReady(linked: boolean): void {
    const host = this.#host;
    if (this.#view.reveal()) this.#size.observe();
    setAttribute(host, "data-ready", true);
    // In a frame the address belongs to the figure alone, and scrolling would move the surrounding page.
    if (linked && !location.hash && parent === window) host.scrollIntoView({ block: "start" });
    this.#announcer.ready(this.#askState());
  }

  #askState(): Parameters {
    return this.#renderer?.ask((engine) => engine.state()) ?? [];
  }

  #dispose(wasReady: boolean): void {
    this.stopMotion();
    this.shell.end();
    this.#endRenderer();
    this.#snapshot = undefined;
    this.#announcer.forget(wasReady);
    setAttribute(this.#host, "data-ready", false);
    this.#view.replace();
    this.#size.forget();
  }

  #endRenderer(): void {
    this.#renderer?.end();
    this.#renderer = undefined;
    this.shell.jobs.end();
  }

  #onPanic(message: string): void {
    this.dispatch({ type: "failed", sentence: "This figure has stopped: a mistake of ours. Reset starts it again." });
    this.#announcer.emit("epipole-error", { message });
  }

  /** Opens the figure even out of view; resolves once it runs or has failed. */
  async open(): Promise<void> {
    this.dispatch({ type: "wanted" });
    await this.#running();
  }

  /** Waits until the figure runs or has failed. */
  async #running(): Promise<void> {
    if (this.#state.ready) return;
    while (!this.#renderer && this.#state.phase !== "failed") await new Promise((resolve) => setTimeout(resolve, 50));
    this.#renderer?.show();
  }

  /** Scrolls the figure into view, once it runs or has failed. */
  async #comeIntoView(): Promise<void> {
    await this.#running();
    await bringIntoView(this.shell.picture.element);
  }
}
