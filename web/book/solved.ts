// Solved questions and tasks of a chapter, in this browser only. An answer to an earlier wording
// (another hash) does not count.

/** Hash by the id of a question or a task. */
export type Solved = Record<string, string>;

/** Kinds of things to solve. */
export type Kind = "quiz" | "task";

const keyOf = (kind: Kind, chapter: string) => `epipole-${kind}:${chapter}`;

/** The hash of the wording of a question or a task. */
export function hashOf({ dataset }: HTMLElement): string {
  return dataset.hash ?? "";
}

export function loadSolved(kind: Kind, chapter: string): Solved {
  try {
    const stored: unknown = JSON.parse(localStorage.getItem(keyOf(kind, chapter)) ?? "{}");
    if (typeof stored !== "object" || stored === null || Array.isArray(stored)) return {};
    // Ignore stored values that are not hashes.
    return Object.fromEntries(Object.entries(stored).filter(([, hash]) => typeof hash === "string"));
  } catch {
    return {};
  }
}

/** Number of solved questions or tasks of a chapter; `wordings` are the present hashes by id. */
export function countSolved(kind: Kind, chapter: string, wordings: Map<string, string>): number {
  const solved = Object.entries(loadSolved(kind, chapter));
  return solved.filter(([id, hash]) => wordings.get(id) === hash).length;
}

/** Stores that something is solved. Returns false if storage is blocked; the page works without it. */
export function markSolved(kind: Kind, chapter: string, id: string, hash: string): boolean {
  try {
    localStorage.setItem(keyOf(kind, chapter), JSON.stringify({ ...loadSolved(kind, chapter), [id]: hash }));
    return true;
  } catch {
    return false;
  }
}

/** Forgets what is solved of a chapter. Throws if storage is blocked. */
export function forgetSolved(kind: Kind, chapter: string): void {
  localStorage.removeItem(keyOf(kind, chapter));
}

/** Whether the page may store anything in this browser. */
export function canRemember(): boolean {
  try {
    localStorage.setItem("epipole-quiz:?", "");
    localStorage.removeItem("epipole-quiz:?");
    return true;
  } catch {
    return false;
  }
}
