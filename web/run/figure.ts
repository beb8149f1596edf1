/** `figure(name)`: a figure of the page, for readers' code. */

import type { FigureFacts, Marks, Photograph, Question, Reply, ToWorker } from "./messages.js";
import { groups } from "./numbers.js";
import { flush, post } from "./outlet.js";

const waiting = new Map<number, { resolve(reply: Reply): void; reject(why: string): void }>();

let asked = 0;

function ask(question: Question): Promise<Reply> {
  flush();
  // Created here, while the stack still contains the reader's code.
  const refusal = new Error();
  return new Promise((resolve, reject) => {
    const id = ++asked;
    waiting.set(id, { resolve, reject: (why) => reject(Object.assign(refusal, { message: why })) });
    post({ type: "ask", id, question });
  });
}

/** A figure of the page. */
class Figure {
  readonly #name: string;
  #facts: FigureFacts;

  constructor(name: string, facts: FigureFacts) {
    this.#name = name;
    this.#facts = facts;
  }

  /** Parameters that differ from the figure's defaults. */
  get state(): Record<string, string> {
    return this.#facts.state;
  }

  /** Numbers and texts that it shows. */
  get readouts(): Record<string, number | string> {
    return this.#facts.readouts;
  }

  /** Its matches, matrices and cameras. */
  get data(): Record<string, unknown> {
    return this.#facts.data;
  }

  /** Moves sliders and points. */
  async set(parameters: Record<string, string | number | boolean>): Promise<this> {
    const entries = Object.entries(parameters).map(([key, value]) => [key, String(value)]);
    return this.#learn({ figure: this.#name, ask: "set", parameters: Object.fromEntries(entries) });
  }

  /** Draws points (x, y) and lines (a, b, c) over a panel, replacing earlier ones. */
  async draw({ panel, points, lines }: { panel?: string; points?: unknown; lines?: unknown } = {}): Promise<this> {
    const marks: Marks = {
      panel: String(panel ?? this.#facts.panels[0] ?? ""),
      points: groups("points", points, 2),
      lines: groups("lines", lines, 3),
    };
    return this.#learn({ figure: this.#name, ask: "draw", marks });
  }

  /** Removes drawn points and lines. */
  async clear(): Promise<this> {
    return this.#learn({ figure: this.#name, ask: "clear" });
  }

  /** Returns the photograph that a panel shows. */
  async photograph(panel?: string): Promise<Photograph> {
    const wanted = String(panel ?? this.#facts.panels[0] ?? "");
    return (await ask({ figure: this.#name, ask: "photograph", panel: wanted })) as Photograph;
  }

  async #learn(question: Question): Promise<this> {
    this.#facts = (await ask(question)) as FigureFacts;
    return this;
  }
}

self.addEventListener("message", ({ data }: MessageEvent<ToWorker>) => {
  const question = waiting.get(data.id);
  waiting.delete(data.id);
  if ("reply" in data) question?.resolve(data.reply);
  else question?.reject(data.problem);
});

let figures: Record<string, FigureFacts> = {};

/** Returns a figure by its name. Throws a RangeError if the page has none. */
export function figure(name: unknown): Figure {
  const facts = figures[String(name)];
  if (facts !== undefined) return new Figure(String(name), facts);
  const known = Object.keys(figures);
  const those = known.length > 0 ? `this code can use ${known.join(", ")}` : "write the name of a figure of this page";
  throw new RangeError(`there is no figure "${String(name)}" here: ${those}`);
}

/** Called before the first line of the code. */
export function begin(facts: Record<string, FigureFacts>): void {
  figures = facts;
}
