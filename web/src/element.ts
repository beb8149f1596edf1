/**
 * `<epipole-figure name="…">`: a figure on a page. Properties, methods and events; `controller.ts` implements them.
 *
 * One class, long because it is the whole public surface.
 */

import { parametersOf, textOf, wholeState } from "./attributes.js";
import type { Goal } from "./challenges.js";
import { CHOOSING } from "./choice.js";
import type { Refused } from "./contract.js";
import { setAttribute } from "./dom.js";
import { FigureController } from "./controller.js";
import type { Marks } from "./marks.js";
import { linkTo } from "./permalink.js";
import { toSaved, type Saved } from "./saved.js";
import { pictureOf } from "./saving.js";

/** Default duration of a glide, milliseconds. */
const GLIDE_MS = 600;

/** A server that renders pages may import this file; it has no elements, and makes no figure. */
const Base: typeof HTMLElement = globalThis.HTMLElement ?? class {};

export class EpipoleFigure extends Base {
  static readonly observedAttributes = ["name", "theme", "compact", ...CHOOSING];

  readonly #controller: FigureController;

  constructor() {
    super();
    this.#controller = new FigureController(this);
  }

  connectedCallback(): void {
    // JupyterLab hears keys before anybody else, and does nothing on them where it finds this.
    setAttribute(this, "data-lm-suppress-shortcuts", true);
    // A property set before the script loads hides the accessor that sets the attribute.
    if (Object.hasOwn(this, "compact")) {
      const { compact } = this;
      Reflect.deleteProperty(this, "compact");
      this.compact = compact;
    }
    this.#controller.connect();
  }

  disconnectedCallback(): void {
    this.#controller.disconnect();
  }

  attributeChangedCallback(name: string, before: string | null, now: string | null): void {
    if (name === "theme") this.#controller.recolor();
    else if (name === "compact") this.#controller.squeeze();
    else if (name !== "name") this.#controller.choose();
    else if (before !== null && before !== now) this.#controller.dispatch({ type: "renamed", connected: this.isConnected });
  }

  /** Parameters that differ from the figure's defaults, by name. Setting puts them on top. */
  get state(): Record<string, string> {
    return Object.fromEntries(this.#controller.state);
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
    return Object.fromEntries(this.#controller.snapshot?.readouts.map(({ id, value }) => [id, value]) ?? []);
  }

  /**
   * Matches, matrices and cameras of the present state, by the names and in the shapes of `@epipole/vision`; empty for
   * figures without any.
   */
  get data(): Record<string, unknown> {
    return this.#controller.renderer?.ask((engine) => engine.data()) ?? {};
  }

  /** Names of the picture's panels. */
  get panels(): string[] {
    return this.#controller.snapshot?.layout.panels.map(({ id }) => id) ?? [];
  }

  /** The photograph that a panel shows: rows of red, green, blue. Undefined without one. */
  photograph(panel: string): { width: number; height: number; data: Uint8Array } | undefined {
    const { renderer, snapshot } = this.#controller;
    const found = snapshot?.layout.panels.find(({ id }) => id === panel);
    const data = renderer?.ask((engine) => engine.photograph(panel));
    if (!found || !data?.length) return undefined;
    const width = Math.round(Math.abs(found.x_axis.end - found.x_axis.start));
    return { width, height: data.length / (3 * width), data };
  }

  /**
   * Draws points and lines over a panel, in its world units, in place of those that a page has drawn there before.
   * Throws a RangeError if there is no such panel.
   */
  draw(marks: Marks): void {
    const { shell, snapshot } = this.#controller;
    if (!snapshot) throw new Error("the figure is not ready yet: await whenReady()");
    // Marks belong to the living picture, not to a poster.
    this.#controller.dispatch({ type: "reveal" });
    shell.picture.marks.show(marks, snapshot);
  }

  /** Removes what `draw` has drawn. */
  clearMarks(): void {
    this.#controller.shell.picture.marks.clear();
  }

  /** The goals, and which of them the reader has reached. */
  get goals(): Goal[] {
    return this.#controller.shell.goals;
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
    if (!this.#controller.shell.settled) return undefined;
    return this.#controller.snapshot?.readouts.find((readout) => readout.id === id)?.text;
  }

  /** Photographs of the reader's own that it shows, as they were given. Told by the event `epipole-photographs`. */
  get photographs(): readonly File[] {
    return this.#controller.shell.photos.files;
  }

  /** Description of the current picture in words. */
  get description(): string {
    return this.#controller.snapshot?.description ?? "";
  }

  /** A link to this page with the figure in its present state. */
  get permalink(): string {
    const known = new Set(this.#controller.snapshot?.controls.map(({ id }) => id));
    for (const { id } of this.#controller.snapshot?.handles ?? []) known.add(id);
    const state = this.#controller.renderer?.ask((engine) => engine.state()) ?? this.#controller.state;
    return linkTo(this, wholeState(this, state, this.#controller.snapshot), (key) => known.has(key));
  }

  /** The present value of a control. */
  controlValue(id: string): number | boolean | string | undefined {
    const control = this.#controller.snapshot?.controls.find((known) => known.id === id);
    return control && "value" in control ? control.value : undefined;
  }

  /** A control's value as the figure shows it, with its unit. */
  controlText(id: string): string | undefined {
    return this.#controller.snapshot?.controls.find((control) => control.id === id)?.value_text;
  }

  /** Opens the figure without bringing it into view; resolves once it has computed what it shows, or has failed. */
  async open(): Promise<void> {
    await this.#controller.open();
    await this.#controller.answered();
  }

  /** Resolves once the figure can be operated and asked. */
  whenReady(): Promise<void> {
    return this.#controller.whenReady;
  }

  /** Takes parameters, as attributes do. */
  apply(parameters: Record<string, string | number | boolean>): void {
    this.#controller.dispatch({ type: "touch", own: false });
    this.#controller.stopMotion();
    this.#controller.warn(this.#controller.renderer?.apply(textOf(parameters)) ?? []);
  }

  /**
   * Moves sliders and points to parameters so that it can be watched, after bringing the figure into view where that is
   * needed and `scroll` is not false. Choices and toggles change at once, and everything does for a reader who wants no
   * motion. Opens the figure if that has not been done. A second glide takes the first one's goal over; a reader who
   * takes hold of the figure ends it.
   */
  async glide(
    parameters: Record<string, string | number | boolean>,
    { duration = GLIDE_MS, scroll = true }: { duration?: number; scroll?: boolean } = {},
  ): Promise<void> {
    this.#controller.dispatch({ type: "touch", own: false });
    this.#controller.warn(await this.#controller.glide(textOf(parameters), duration, scroll));
  }

  /**
   * Lights up what the book has this letter for: a ring or a line in the color `--epipole-lit`. Nothing else stays
   * lit. Says whether the figure shows it.
   */
  light(symbol: string | undefined): boolean {
    const found = this.#controller.shell.picture.light(symbol);
    // A poster cannot be lit up: the same picture is drawn in its place.
    if (found) this.#controller.dispatch({ type: "reveal" });
    return found;
  }

  /** Presses a button of the figure. */
  press(id: string): void {
    this.#controller.dispatch({ type: "touch", own: false });
    this.#controller.stopMotion();
    this.#controller.renderer?.act((engine) => engine.update({ type: "press", id }));
  }

  /** Back to the state that the page's author has set. */
  reset(): void {
    const controller = this.#controller;
    const { shell, renderer } = controller;
    controller.stopMotion();
    shell.speaker.warn([]);
    if (!renderer) {
      controller.dispatch({ type: "open", withAddress: false });
      return;
    }
    let problems: Refused[] = [];
    renderer.act((engine) => {
      const refused = engine.update({ type: "reset" });
      problems = engine.apply(parametersOf(this));
      return refused;
    });
    shell.photos.forget();
    shell.picture.marks.clear();
    shell.jobs.goOn();
    controller.warn(problems);
    shell.speaker.say("Reset.");
    this.dispatchEvent(new CustomEvent("epipole-reset", { detail: {}, bubbles: true, composed: true }));
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
    const controller = this.#controller;
    controller.stopMotion();
    if (!controller.renderer) controller.dispatch({ type: "open", withAddress: false });
    await controller.whenReady;
    controller.stopMotion();
    const { shell, renderer } = controller;
    shell.speaker.warn([]);
    renderer?.act((engine) => engine.update({ type: "reset" }));
    shell.jobs.goOn();
    controller.warn(renderer?.apply(textOf(state)) ?? []);
    shell.recall(solved);
  }

  /** Takes these goals for reached: the reader has reached them another time. Wants a figure that is ready. */
  recall(solved: string[]): void {
    this.#controller.shell.recall(solved);
  }

  /**
   * Picture of the figure as a PNG, `scale` pixels per CSS pixel of its layout; resolves after pending computations.
   * Null while there is no picture.
   */
  async toPng({ scale = 2 }: { scale?: number } = {}): Promise<Blob | null> {
    await this.#controller.answered();
    const { renderer } = this.#controller;
    return renderer ? pictureOf(renderer, scale) : null;
  }

  /** Shows a sentence in the figure, and on the console. */
  warn(sentence: string): void {
    this.#controller.shell.speaker.complain([sentence]);
  }

  /** Shows the present state at once, without waiting for the display. */
  flush(): void {
    this.#controller.renderer?.flush();
  }
}
