/** Access to figures of the page for readers' code. */

import type { FigureFacts, Marks, Question, Reply } from "./messages.js";

/** Time limit for opening a figure, milliseconds. */
const LATE_MS = 20_000;

interface Figure extends HTMLElement {
  readonly state: Record<string, string>;
  readonly readouts: Record<string, number | string>;
  readonly data: Record<string, unknown>;
  readonly panels: readonly string[];
  open(): Promise<void>;
  whenReady(): Promise<void>;
  apply(parameters: Record<string, string>): void;
  photograph(panel: string): { width: number; height: number; data: Uint8Array } | undefined;
  draw(marks: Marks): void;
  clearMarks(): void;
  flush(): void;
}

/** Returns the figures of this page by name; of several with the same name, the first. */
function figures(): Map<string, Figure> {
  const found = new Map<string, Figure>();
  for (const element of document.querySelectorAll<Figure>("main epipole-figure[name]")) {
    const name = element.getAttribute("name") ?? "";
    if (!found.has(name)) found.set(name, element);
  }
  return found;
}

/** Returns facts of the figures named in the code. Opens those that are not open yet. */
export async function factsFor(code: string): Promise<Record<string, FigureFacts>> {
  const named = [...figures()].filter(([name]) => code.includes(`"${name}"`) || code.includes(`'${name}'`));
  const facts = named.map(async ([name, figure]) => {
    await open(figure);
    return [name, factsOf(figure)] as const;
  });
  return Object.fromEntries(await Promise.all(facts));
}

async function open(figure: Figure): Promise<void> {
  await customElements.whenDefined("epipole-figure");
  await figure.open();
  if (figure.hasAttribute("data-ready")) return;
  const late = new Promise((_, fail) => setTimeout(fail, LATE_MS, new Error("a figure does not open: reload the page")));
  await Promise.race([figure.whenReady(), late]);
}

function factsOf(figure: Figure): FigureFacts {
  const { state, readouts, data, panels } = figure;
  return { state, readouts, data, panels };
}

/** Answers a request of the code. Rejects with a message. */
export async function answer(question: Question): Promise<Reply> {
  const figure = figures().get(question.figure);
  if (!figure) throw new Error(`there is no figure ${question.figure} on this page`);
  await open(figure);
  if (question.ask === "photograph") {
    const photograph = figure.photograph(question.panel);
    if (photograph) return photograph;
    throw new Error(`the panel ${question.panel} shows no photograph; the panels are ${figure.panels.join(", ")}`);
  }
  if (question.ask === "set") {
    figure.apply(question.parameters);
    // Waits for a frame, so that each step of a loop is visible.
    await new Promise((done) => requestAnimationFrame(done));
    figure.flush();
    await open(figure);
  } else if (question.ask === "draw") figure.draw(question.marks);
  else figure.clearMarks();
  return factsOf(figure);
}
