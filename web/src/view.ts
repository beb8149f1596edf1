/** Shadow tree of an element: that of its figure, behind a placeholder until the figure is ready. */

import { choiceOf } from "./choice.js";
import { Placeholder } from "./placeholder.js";
import { sheet } from "./sheet.js";
import { Shell, type Acts } from "./shell.js";
import type { Theme } from "./theme.js";

type CompactElement = HTMLElement & { readonly compact: boolean };

export class View {
  readonly root: ShadowRoot;
  readonly #host: CompactElement;
  readonly #acts: (isCurrent: () => boolean) => Acts;
  #shell: Shell;
  #placeholder: Placeholder | undefined;
  #theme: Theme = "light";

  /** Creates a view; `acts` creates the actions of a tree, which may ask whether the tree is current. */
  constructor(host: CompactElement, acts: (isCurrent: () => boolean) => Acts) {
    this.#host = host;
    this.#acts = acts;
    this.root = host.shadowRoot ?? host.attachShadow({ mode: "open" });
    this.root.adoptedStyleSheets = [sheet()];
    this.#shell = this.#makeShell();
    this.#placeholder = Placeholder.in(this.root);
    if (this.#placeholder) this.#placeholder.lend(this.#shell);
    else this.root.append(this.#shell.root);
  }

  get shell(): Shell {
    return this.#shell;
  }

  get placeholder(): Placeholder | undefined {
    return this.#placeholder;
  }

  get theme(): Theme {
    return this.#theme;
  }

  set theme(theme: Theme) {
    this.#theme = theme;
    this.#shell.theme = theme;
    if (this.#placeholder) this.#placeholder.theme = theme;
  }

  /** Sets the role according to the position in the document. */
  connect(): void {
    this.#shell.role = this.#host.closest("figure") ? "group" : "figure";
  }

  /** Applies the layout of the attribute `compact`. */
  squeeze(): void {
    this.#shell.compact = this.#host.compact;
  }

  /** Applies the selection of controls, readouts and goals by the attributes. */
  choose(): void {
    this.#shell.choose(choiceOf((name) => this.#host.getAttribute(name)));
  }

  /** Replaces this tree by that of another figure. */
  replace(): void {
    this.#placeholder = undefined;
    this.#shell = this.#makeShell();
    this.connect();
    this.#shell.theme = this.#theme;
    this.root.replaceChildren(this.#shell.root);
  }

  /** Shows the tree of the figure, which can now be operated; returns whether it replaces a placeholder. */
  reveal(): boolean {
    this.#shell.reveal();
    const placeholder = this.#placeholder;
    placeholder?.yield(this.#shell);
    this.#placeholder = undefined;
    return placeholder !== undefined;
  }

  #makeShell(): Shell {
    const shell: Shell = new Shell(
      this.#acts(() => this.#shell === shell),
      choiceOf((name) => this.#host.getAttribute(name)),
    );
    shell.compact = this.#host.compact;
    return shell;
  }
}
