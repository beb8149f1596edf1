// Solved questions and tasks of a chapter, in this browser only. An answer to an earlier wording
// (another hash) does not count.

/** Hash by the id of a question or a task. */
export type Solved = Record<string, string>;

/** Kinds of solvable items. */
export type Kind = "quiz" | "task";

const keyOf = (kind: Kind, chapter: string) => `epipole-${kind}:${chapter}`;

/** Returns the hash of the wording of a question or a task. */
export function hashOf({ dataset }: HTMLElement): string {
  return dataset.hash ?? "";
}

export function loadSolved(kind: Kind, chapter: string): Solved {
  try {
    const stored: unknown = JSON.parse(localStorage.getItem(keyOf(kind, chapter)) ?? "{}");
    if (typeof stored !== "object" || stored === null || Array.isArray(stored)) return {};
    // Ignores stored values that are not hashes.
    return Object.fromEntries(Object.entries(stored).filter(([, hash]) => typeof hash === "string"));
  } catch {
    return {};
  }
}

/** Counts solved questions or tasks of a chapter; `wordings` are the current hashes by id. */
export function countSolved(kind: Kind, chapter: string, wordings: Map<string, string>): number {
  const solved = Object.entries(loadSolved(kind, chapter));
  return solved.filter(([id, hash]) => wordings.get(id) === hash).length;
}

/** Stores that an item is solved. Returns false if storage is blocked; the page works without it. */
export function markSolved(kind: Kind, chapter: string, id: string, hash: string): boolean {
  try {
    localStorage.setItem(keyOf(kind, chapter), JSON.stringify({ ...loadSolved(kind, chapter), [id]: hash }));
    return true;
  } catch {
    return false;
  }
}

/** Forgets the solved items of a chapter. Throws if storage is blocked. */
export function forgetSolved(kind: Kind, chapter: string): void {
  localStorage.removeItem(keyOf(kind, chapter));
}

/** Whether the page can store data in this browser. */
export function canRemember(): boolean {
  try {
    localStorage.setItem("epipole-quiz:?", "");
    localStorage.removeItem("epipole-quiz:?");
    return true;
  } catch {
    return false;
  }
}
