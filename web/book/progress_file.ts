// Progress as a file: its content, and merging of a file that may be foreign, damaged or of another edition.

import { countReached, markReached } from "./goals";
import { type Place, placesIn, storedPlaces, storePlaces } from "./places";
import { type Kind, loadSolved, markSolved } from "./solved";

const FORMAT = "epipole-progress";
const VERSION = 1;
/** Maximum size of a file, bytes. */
export const MAX_BYTES = 1_000_000;

/** Questions or tasks of a chapter: hashes of their wordings by id. */
interface Solvable {
  kind: Kind;
  chapter: string;
  wordings: Map<string, string>;
}

/** All questions, tasks and goals of an edition of the book. */
export interface Book {
  solvable: Solvable[];
  /** Goals, each `figure/goal`. */
  goals: string[];
  chapters: string[];
}

interface Solution {
  kind: Kind;
  chapter: string;
  id: string;
  hash: string;
}

/** Progress that belongs to this edition. */
export interface Progress {
  solutions: Solution[];
  goals: string[];
  places: Place[];
}

/** Numbers of items added. */
export type Counts = Record<Kind | "goals" | "places", number>;

/** Returns a property of a parsed JSON value of any type. */
function own(value: unknown, key: string): unknown {
  return typeof value === "object" && value !== null && Object.hasOwn(value, key) ? value[key as never] : undefined;
}

/** Returns solutions of the current wordings; `hashOf` looks one up. */
function solutions({ solvable }: Book, hashOf: (kind: Kind, chapter: string, id: string) => unknown): Solution[] {
  return solvable.flatMap(({ kind, chapter, wordings }) => {
    const all = [...wordings].map(([id, hash]) => ({ kind, chapter, id, hash }));
    return all.filter(({ id, hash }) => hashOf(kind, chapter, id) === hash);
  });
}

const isReached = (goal: string) => countReached([goal]) > 0;

/** Returns the content of a file with the progress stored in this browser. */
export function collectProgress(book: Book): object {
  const solved: Record<Kind, Record<string, Record<string, string>>> = { quiz: {}, task: {} };
  for (const { kind, chapter, id, hash } of solutions(book, (...[kind, chapter, id]) => loadSolved(kind, chapter)[id])) {
    (solved[kind][chapter] ??= {})[id] = hash;
  }
  return { format: FORMAT, version: VERSION, ...solved, goals: book.goals.filter(isReached), places: storedPlaces() };
}

/** Returns the progress in a file that this edition knows, or the reason why there is none. */
export function progressIn(text: string, book: Book): Progress | "foreign" | "newer" {
  let file: unknown;
  try {
    file = JSON.parse(text);
  } catch {
    return "foreign";
  }
  const version = own(file, "version");
  if (own(file, "format") !== FORMAT || !Number.isInteger(version)) return "foreign";
  if ((version as number) > VERSION) return "newer";
  const goals = own(file, "goals");
  return {
    solutions: solutions(book, (kind, chapter, id) => own(own(own(file, kind), chapter), id)),
    goals: book.goals.filter((goal) => Array.isArray(goals) && goals.includes(goal)),
    places: placesIn(own(file, "places")).filter(([chapter]) => book.chapters.includes(chapter)),
  };
}

/** Adds progress to that stored in this browser. Returns undefined if storage is blocked. */
export function addProgress(progress: Progress): Counts | undefined {
  const counts: Counts = { quiz: 0, task: 0, goals: 0, places: 0 };
  for (const { kind, chapter, id, hash } of progress.solutions) {
    if (loadSolved(kind, chapter)[id] === hash) continue;
    if (!markSolved(kind, chapter, id, hash)) return undefined;
    counts[kind] += 1;
  }
  for (const goal of progress.goals.filter((goal) => !isReached(goal))) {
    if (!markReached(goal)) return undefined;
    counts.goals += 1;
  }
  const known = storedPlaces();
  const added = progress.places.filter(([chapter]) => known.every(([other]) => other !== chapter));
  counts.places = added.length;
  return added.length === 0 || storePlaces([...known, ...added]) ? counts : undefined;
}
