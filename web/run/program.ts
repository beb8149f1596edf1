/** A block of runnable code: its editor, its buttons, and its output. */

import { Editor } from "./editor.js";
import { answer, factsFor } from "./figures.js";
import type { Fault } from "./messages.js";
import { names } from "./names.js";
import { Output } from "./output.js";
import { Session } from "./session.js";
import { prepare, type Addresses } from "./source.js";
import { keyOf, linkTo, load, save } from "./stored.js";

/** Parts of a page that form a block. */
export interface Block {
  /** Name, unique on the page. */
  name: string;
  title: string;
  /** Part with the code of the book. */
  part: HTMLElement;
  /** Button that runs and stops it. */
  button: HTMLButtonElement;
  /** Body of the function that checks the code. */
  check?: string | undefined;
  /** Called with the first correct verdict. */
  solved?: () => void;
}

const ADDRESSES: Addresses = {
  sandbox: new URL(EPIPOLE_SANDBOX, import.meta.url).href,
  vision: new URL(`${EPIPOLE_VISION}/index.js`, import.meta.url).href,
};
const DECLARATIONS = new URL(`${EPIPOLE_VISION}/api.d.ts`, import.meta.url);

export class Program {
  readonly #block: Block;
  readonly #original: string;
  readonly #key: string;
  readonly #editor: Editor;
  readonly #output: Output;
  readonly #status = document.createElement("p");
  readonly #reset = document.createElement("button");
  #session: Session | undefined;
  /** Number of runs, so that a run that is stopped during its preparation does not start. */
  #run = 0;

  /** Replaces the code by an editor. `code` is that of a link. */
  constructor(block: Block, code?: string) {
    this.#block = block;
    const pre = block.part.querySelector("pre");
    this.#original = (pre?.textContent ?? "").trimEnd();
    this.#key = keyOf(block.name);
    const kept = code ?? load(this.#key);
    const place = document.createElement("div");
    place.className = "run-editor";
    pre?.replaceWith(place);
    const label = `${block.title}: JavaScript, editable`;
    this.#editor = new Editor(place, label, kept ?? this.#original, () => names(DECLARATIONS), {
      changed: (now) => this.#changed(now),
      run: () => void this.run(),
    });
    this.#output = this.#addBelow();
    block.part.dataset.code = this.#editor.code;
    if (code !== undefined) this.#say("This code came with the link. Read it, then run it.");
    else if (kept !== undefined) this.#say("This is your version. Reset shows the book's.");
    this.#reset.disabled = kept === undefined;
  }

  #addBelow(): Output {
    const bar = document.createElement("div");
    bar.className = "run-bar";
    this.#reset.type = "button";
    this.#reset.textContent = "Reset";
    this.#reset.addEventListener("click", () => this.#restore());
    const share = document.createElement("button");
    share.type = "button";
    share.textContent = "Copy link";
    share.addEventListener("click", () => void this.#share());
    this.#status.setAttribute("role", "status");
    bar.append(this.#reset, share, this.#status);
    const box = document.createElement("div");
    box.className = "run-output";
    box.setAttribute("role", "log");
    box.setAttribute("aria-label", "Output");
    this.#block.part.querySelector(".run-editor")?.after(bar, box);
    return new Output(box);
  }

  /** Whether code runs. */
  get isRunning(): boolean {
    return this.#block.button.dataset.state === "running";
  }

  /** Runs the code from the start; a previous run is stopped. */
  async run(): Promise<void> {
    this.#session?.stop();
    const run = ++this.#run;
    const code = this.#editor.code;
    this.#setRunning(true);
    this.#editor.mark(undefined);
    this.#say("Running …");
    const facts = await factsFor(code).catch((problem: Error) => problem);
    if (run !== this.#run) return;
    const prepared = facts instanceof Error ? facts : prepare(code, ADDRESSES, facts, this.#block.check);
    this.#clear();
    if ("message" in prepared) return this.#fail(prepared);
    try {
      this.#session = new Session(code, prepared, {
        items: (items) => this.#output.add(items),
        failed: (fault) => this.#fail(fault),
        finished: (duration, verdict) => this.#finish(duration, verdict),
        lasts: () => this.#say("Still running after five seconds. Stop ends it."),
        answer,
      });
    } catch (problem) {
      this.#fail({ name: "Error", message: `this browser starts no worker for the code: ${String(problem)}` });
    }
  }

  stop(): void {
    this.#session?.stop();
    this.#run += 1;
    this.#setRunning(false);
    this.#say("Stopped.");
  }

  focus(): void {
    this.#editor.focus();
  }

  #clear(): void {
    // The recorded output is replaced by that of the run.
    this.#block.part.querySelector(".prints")?.setAttribute("hidden", "");
    this.#output.clear();
  }

  #fail(fault: Fault): void {
    this.#setRunning(false);
    this.#say("");
    this.#editor.mark(fault.line);
    this.#output.fail(fault, (line, column) => this.#editor.goTo(line, column));
  }

  #finish(duration: number, verdict: string | undefined): void {
    this.#setRunning(false);
    this.#say(`Done in ${(duration / 1000).toFixed(2)} s.`);
    if (verdict === undefined) return;
    const isRight = verdict.startsWith("Right");
    this.#output.judge(verdict, isRight);
    if (isRight) this.#block.solved?.();
  }

  #changed(code: string): void {
    // For the copy button.
    this.#block.part.dataset.code = code;
    const isOwn = code.trimEnd() !== this.#original;
    this.#reset.disabled = !isOwn;
    if (!save(this.#key, isOwn ? code : undefined)) {
      this.#say("This browser keeps nothing for this page: your code is gone when you leave.");
    }
  }

  #restore(): void {
    if (this.isRunning) this.stop();
    this.#editor.code = this.#original;
    this.#editor.mark(undefined);
    this.#output.clear();
    this.#block.part.querySelector(".prints")?.removeAttribute("hidden");
    this.#say("The book's code again.");
    this.#editor.focus();
  }

  async #share(): Promise<void> {
    const link = await linkTo(this.#block.name, this.#editor.code);
    const isCopied = await navigator.clipboard?.writeText(link).then(() => true, () => false);
    if (!isCopied) history.replaceState(null, "", link);
    this.#say(isCopied ? "The link is copied." : "The address of this page now holds your code: copy it from there.");
  }

  #setRunning(isRunning: boolean): void {
    const { button } = this.#block;
    button.dataset.state = isRunning ? "running" : "ready";
    const label = button.querySelector(".run-label") ?? button;
    label.textContent = isRunning ? "Stop" : (button.dataset.label ?? "Run");
  }

  #say(words: string): void {
    this.#status.textContent = words;
  }
}
