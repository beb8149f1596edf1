// A chapter in a frame (`?embed`): its links open new tabs. The host page receives the fraction of questions solved and
// goals reached, and may store them, as defined by SPLICE.

import { answerHost, recordOf, tell } from "../src/splice.js";
import { countReached, goalOf, goalsOf, markReached, recall } from "./goals";
import { hashOf, loadSolved, markSolved } from "./solved";

/** Maximum wait for the state stored by the host page, milliseconds. */
const ANSWER_MS = 1000;

/** Progress in the format stored by the host page. */
interface SavedProgress {
  v: 1;
  /** Hashes of solved questions by their ids. */
  quiz: Record<string, string>;
  /** Reached goals, each `figure/goal`. */
  goals: string[];
}

/** Starts, and waits for the stored progress. */
export async function start(): Promise<void> {
  document.addEventListener("click", openElsewhere, { capture: true });
  if (parent !== window) await new Chapter().restored();
}

/** Lets a link to another page open in a new tab. */
function openElsewhere({ target }: Event): void {
  const link = target instanceof Element ? target.closest<HTMLAnchorElement>("a[href]") : null;
  if (!link || link.hasAttribute("download")) return;
  if (link.origin === location.origin && link.pathname === location.pathname) return;
  link.target = "_blank";
  link.rel = "noopener";
}

class Chapter {
  readonly #quiz = document.querySelector<HTMLElement>(".quiz");
  readonly #forms = [...(this.#quiz?.querySelectorAll("form") ?? [])];
  readonly #goals = goalsOf(document.querySelector("article")!);
  readonly #solved = new Map<string, string>();
  readonly #reached = new Set<string>();

  constructor() {
    this.#add({ quiz: loadSolved("quiz", this.#chapter), goals: this.#goals.filter((goal) => countReached([goal]) > 0) });
    document.addEventListener("epipole-solved", ({ target }) => {
      const form = target as HTMLFormElement;
      this.#solved.set(form.id, hashOf(form));
      this.#report();
    });
    document.addEventListener("epipole-challenge", (event) => {
      const goal = goalOf(event);
      if (!this.#goals.includes(goal)) return;
      this.#reached.add(goal);
      this.#report();
    });
  }

  get #chapter(): string {
    return this.#quiz?.dataset.quiz ?? "";
  }

  /** Restores the stored progress; resolves after that, or if the host does not answer. */
  restored(): Promise<void> {
    return new Promise((done) => {
      setTimeout(done, ANSWER_MS);
      const restore = (state: unknown) => {
        this.#take(recordOf(state) ?? {});
        done();
      };
      // Each step is reported immediately, so nothing is left to flush.
      answerHost({ restore, flush: () => false });
    });
  }

  #take({ quiz, goals }: Record<string, unknown>): void {
    const texts = Array.isArray(goals) ? goals.filter((goal) => typeof goal === "string") : [];
    this.#add({ quiz: (recordOf(quiz) ?? {}) as Record<string, string>, goals: texts });
    for (const [id, hash] of this.#solved) markSolved("quiz", this.#chapter, id, hash);
    for (const goal of this.#reached) markReached(goal);
    for (const figure of document.querySelectorAll<HTMLElement>("epipole-figure[data-ready]")) recall(figure);
  }

  /** Adds progress that belongs to this edition of the chapter. */
  #add({ quiz, goals }: Omit<SavedProgress, "v">): void {
    for (const form of this.#forms) if (quiz[form.id] === hashOf(form)) this.#solved.set(form.id, hashOf(form));
    for (const goal of goals) if (this.#goals.includes(goal)) this.#reached.add(goal);
  }

  #report(): void {
    const count = this.#forms.length + this.#goals.length;
    const state: SavedProgress = { v: 1, quiz: Object.fromEntries(this.#solved), goals: [...this.#reached] };
    const score = (this.#solved.size + this.#reached.size) / count;
    tell("SPLICE.reportScoreAndState", { activity_id: location.origin + location.pathname, score, state });
  }
}
