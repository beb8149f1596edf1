// The progress page: counts solved questions and reached goals, saves progress as a file, merges a file, and erases all
// progress.

import { countReached, forget, goalsOf } from "./goals";
import { chapterOf, forgetPlaces } from "./places";
import { addProgress, type Book, collectProgress, type Counts, MAX_BYTES, progressIn } from "./progress_file";
import { canRemember, countSolved, forgetSolved, type Kind } from "./solved";

/** Cells of a row that count solved questions, by kind. */
const CELLS: [Kind, string][] = [
  ["quiz", ".solved"],
  ["task", ".tasks"],
];

/** Returns the hashes in a cell, by the ids of questions or tasks. */
function wordingsOf({ dataset }: HTMLElement): Map<string, string> {
  const pairs = (dataset.wordings ?? "").split(" ").filter((pair) => pair !== "");
  return new Map(pairs.map((pair) => [pair.slice(0, pair.lastIndexOf(":")), pair.slice(pair.lastIndexOf(":") + 1)]));
}

/** Questions and tasks of the book, with the cells that count them. */
function solvableIn(rows: HTMLElement[]) {
  return rows.flatMap((row) =>
    CELLS.flatMap(([kind, selector]) => {
      const cell = row.querySelector<HTMLElement>(selector);
      return cell ? [{ kind, chapter: row.dataset.quiz ?? "", wordings: wordingsOf(cell), cell }] : [];
    }),
  );
}

function save(book: Book): void {
  const link = document.createElement("a");
  const text = JSON.stringify(collectProgress(book), null, 1);
  link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  link.download = "epipole-progress.json";
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10_000);
}

const plural = (count: number, one: string) => `${count} ${one}${count === 1 ? "" : "s"}`;

function wordsFor({ quiz, task, goals, places }: Counts, name: string): string {
  const counts: [number, string][] = [
    [quiz, "question"],
    [task, "task"],
    [goals, "goal"],
    [places, "place"],
  ];
  const added = counts.filter(([count]) => count > 0).map(([count, one]) => plural(count, one));
  return added.length === 0 ? `Nothing in ${name} is new here.` : `Added from ${name}: ${added.join(", ")}.`;
}

/** Merges the progress of a file. Returns a message. */
async function add(file: File, book: Book): Promise<string> {
  const read = file.size <= MAX_BYTES ? progressIn(await file.text(), book) : "foreign";
  if (read === "foreign") return `${file.name} is no progress of this book. Choose a file that this page has saved.`;
  if (read === "newer") return `${file.name} is from a newer edition of the book. Load this page again, then open the file.`;
  const added = addProgress(read);
  return added ? wordsFor(added, file.name) : "This browser lets the page keep nothing, so nothing was added.";
}

function show(progress: HTMLElement): void {
  const solvable = solvableIn([...progress.querySelectorAll<HTMLElement>("tr[data-quiz]")]);
  const reached = [...progress.querySelectorAll<HTMLElement>(".reached")];
  const links = document.querySelectorAll<HTMLAnchorElement>("#contents a[href]");
  // Chapters may share a figure.
  const goals = [...new Set(reached.flatMap(goalsOf))];
  const book: Book = { solvable, goals, chapters: [...links].map(chapterOf) };
  const find = (selector: string) => progress.querySelector<HTMLElement>(selector)!;
  const said = find(".progress-said");
  const update = () => {
    for (const { kind, chapter, wordings, cell } of solvable) {
      cell.textContent = `${countSolved(kind, chapter, wordings)} of ${wordings.size}`;
    }
    for (const cell of reached) {
      cell.textContent = `${countReached(goalsOf(cell))} of ${goalsOf(cell).length}`;
    }
  };
  update();
  if (!canRemember()) {
    const words = document.createElement("p");
    words.className = "kept";
    words.setAttribute("role", "status");
    words.textContent =
      "This browser lets the page keep nothing, so what you solve is forgotten when you leave. Allow it to store " +
      "data for this site, and it will be remembered.";
    progress.prepend(words);
  }
  find(".progress-actions").hidden = false;
  find(".save-progress").addEventListener("click", () => save(book));
  const input = document.createElement("input");
  input.type = "file";
  input.accept = ".json,application/json";
  find(".open-progress").addEventListener("click", () => input.click());
  input.addEventListener("change", async () => {
    const file = input.files?.[0];
    if (!file) return;
    const name = file.name;
    said.textContent = await add(file, book).catch(() => `${name} cannot be read. Choose it again.`);
    // Reset, so that the same file can be chosen again.
    input.value = "";
    update();
  });
  find(".reset-progress").addEventListener("click", () => {
    try {
      for (const { kind, chapter } of solvable) forgetSolved(kind, chapter);
      forget(goals);
      forgetPlaces();
    } catch {
      // Nothing was stored in that case.
    }
    said.textContent = "";
    update();
  });
}

export function start(): void {
  for (const progress of document.querySelectorAll<HTMLElement>(".progress")) show(progress);
}
