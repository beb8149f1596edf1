/**
 * `<epipole-figure name="…">`: a figure on a page. Properties, methods and events; `controller.ts` implements them.
 *
 * A single class, long because it is the whole public interface.
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

/** A server that renders pages may import this file: it has no custom elements, and creates no figure. */
const Base: typeof HTMLElement = globalThis.HTMLElement ?? class {};

export class EpipoleFigure extends Base {
  static readonly observedAttributes = ["name", "theme", "compact", ...CHOOSING];

  readonly #controller: FigureController;

  constructor() {
    super();
    this.#controller = new FigureController(this);
  }

  connectedCallback(): void {
    // JupyterLab handles keys first, and ignores those of elements with this attribute.
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

  /**
   * Parameters that differ from the figure's defaults, by name. Setting applies parameters on top of the current ones.
   */
  get state(): Record<string, string> {
    return Object.fromEntries(this.#controller.state);
  }

  set state(parameters: Record<string, string | number | boolean>) {
    this.apply(parameters);
  }

  /**
   * Whether the figure fits the height given by its page: with picture, main buttons and numbers, and the rest in a
   * drawer. Reflects the attribute.
   */
  get compact(): boolean {
    return this.hasAttribute("compact");
  }

  set compact(compact: boolean) {
    this.toggleAttribute("compact", Boolean(compact));
  }

  /** Readouts by name. */
  get readouts(): Record<string, number | string> {
    return Object.fromEntries(this.#controller.snapshot?.readouts.map(({ id, value }) => [id, value]) ?? []);
  }

  /**
   * Matches, matrices and cameras of the current state, named and shaped as in `@epipole/vision`; empty for figures
   * without any.
   */
  get data(): Record<string, unknown> {
    return this.#controller.renderer?.ask((engine) => engine.data()) ?? {};
  }

  /** Names of the picture's panels. */
  get panels(): string[] {
    return this.#controller.snapshot?.layout.panels.map(({ id }) => id) ?? [];
  }

  /** Returns the photograph that a panel shows: rows of red, green, blue. Undefined without one. */
  photograph(panel: string): { width: number; height: number; data: Uint8Array } | undefined {
    const { renderer, snapshot } = this.#controller;
    const found = snapshot?.layout.panels.find(({ id }) => id === panel);
    const data = renderer?.ask((engine) => engine.photograph(panel));
    if (!found || !data?.length) return undefined;
    const width = Math.round(Math.abs(found.x_axis.end - found.x_axis.start));
    return { width, height: data.length / (3 * width), data };
  }

  /**
   * Draws points and lines over a panel, in its world units, replacing those drawn before. Throws a RangeError if there
   * is no such panel.
   */
  draw(marks: Marks): void {
    const { shell, snapshot } = this.#controller;
    if (!snapshot) throw new Error("the figure is not ready yet: await whenReady()");
    // Marks are drawn on the live picture, not on a poster.
    this.#controller.dispatch({ type: "reveal" });
    shell.picture.marks.show(marks, snapshot);
  }

  /** Removes the marks drawn by `draw`. */
  clearMarks(): void {
    this.#controller.shell.picture.marks.clear();
  }

  /** Goals, with whether the reader has reached each. */
  get goals(): Goal[] {
    return this.#controller.shell.goals;
  }

  /** Names of the goals that the reader has reached. */
  get solved(): string[] {
    return this.goals.filter(({ solved }) => solved).map(({ id }) => id);
  }

  /** State and reached goals, for a page to store. */
  get saved(): Saved {
    return toSaved(this.getAttribute("name") ?? "", this.state, this.solved);
  }

  /**
   * Returns a readout as displayed, with its unit. Undefined before it is known, such as while a figure with a
   * placeholder is still computing.
   */
  readoutText(id: string): string | undefined {
    if (!this.#controller.shell.settled) return undefined;
    return this.#controller.snapshot?.readouts.find((readout) => readout.id === id)?.text;
  }

  /**
   * Original files of the reader's photographs that it shows. Changes are announced by the event `epipole-photographs`.
   */
  get photographs(): readonly File[] {
    return this.#controller.shell.photos.files;
  }

  /** Description of the current picture. */
  get description(): string {
    return this.#controller.snapshot?.description ?? "";
  }

  /** Link to this page with the figure in its current state. */
  get permalink(): string {
    const known = new Set(this.#controller.snapshot?.controls.map(({ id }) => id));
    for (const { id } of this.#controller.snapshot?.handles ?? []) known.add(id);
    const state = this.#controller.renderer?.ask((engine) => engine.state()) ?? this.#controller.state;
    return linkTo(this, wholeState(this, state, this.#controller.snapshot), (key) => known.has(key));
  }

  /** Returns the current value of a control. */
  controlValue(id: string): number | boolean | string | undefined {
    const control = this.#controller.snapshot?.controls.find((known) => known.id === id);
    return control && "value" in control ? control.value : undefined;
  }

  /** Returns a control's value as displayed, with its unit. */
  controlText(id: string): string | undefined {
    return this.#controller.snapshot?.controls.find((control) => control.id === id)?.value_text;
  }

  /** Opens the figure without scrolling to it; resolves once it has computed its content, or has failed. */
  async open(): Promise<void> {
    await this.#controller.open();
    await this.#controller.answered();
  }

  /** Resolves once the figure can be operated and queried. */
  whenReady(): Promise<void> {
    return this.#controller.whenReady;
  }

  /** Applies parameters, like attributes. */
  apply(parameters: Record<string, string | number | boolean>): void {
    this.#controller.dispatch({ type: "touch", own: false });
    this.#controller.stopMotion();
    this.#controller.warn(this.#controller.renderer?.apply(textOf(parameters)) ?? []);
  }

  /**
   * Animates sliders and points to parameters, after scrolling the figure into view if needed, unless `scroll` is
   * false. Choices and toggles change immediately, and so does everything if the reader prefers reduced motion. Opens
   * the figure if needed. A second glide also completes the first one; the reader ends a glide by operating the figure.
   */
  async glide(
    parameters: Record<string, string | number | boolean>,
    { duration = GLIDE_MS, scroll = true }: { duration?: number; scroll?: boolean } = {},
  ): Promise<void> {
    this.#controller.dispatch({ type: "touch", own: false });
    this.#controller.warn(await this.#controller.glide(textOf(parameters), duration, scroll));
  }

  /**
   * Highlights only the mark of this symbol of the book: a ring or a line in the color `--epipole-lit`. Returns whether
   * the figure shows it.
   */
  light(symbol: string | undefined): boolean {
    const found = this.#controller.shell.picture.light(symbol);
    // A poster cannot be highlighted, so the same picture is drawn in its place.
    if (found) this.#controller.dispatch({ type: "reveal" });
    return found;
  }

  /** Presses a button of the figure. */
  press(id: string): void {
    this.#controller.dispatch({ type: "touch", own: false });
    this.#controller.stopMotion();
    this.#controller.renderer?.act((engine) => engine.update({ type: "press", id }));
  }

  /** Restores the state set by the page's author. */
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
   * Sets exactly this state, such as from a permalink or `state`: parameters not named take the figure's own defaults,
   * whatever the attributes. The given goals count as reached. Opens the figure if needed.
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

  /** Marks these goals as reached by the reader at an earlier time. The figure must be ready. */
  recall(solved: string[]): void {
    this.#controller.shell.recall(solved);
  }

  /**
   * Returns the picture as a PNG, with `scale` pixels per CSS pixel of its layout; resolves after pending computations.
   * Null while there is no picture.
   */
  async toPng({ scale = 2 }: { scale?: number } = {}): Promise<Blob | null> {
    await this.#controller.answered();
    const { renderer } = this.#controller;
    return renderer ? pictureOf(renderer, scale) : null;
  }

  /** Shows a message in the figure and on the console. */
  warn(sentence: string): void {
    this.#controller.shell.speaker.complain([sentence]);
  }

  /** Shows the current state immediately, without waiting for the display. */
  flush(): void {
    this.#controller.renderer?.flush();
  }
}
