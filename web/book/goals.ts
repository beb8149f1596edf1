// Goals of figures: stores, in this browser only, which ones the reader has reached.

const PREFIX = "epipole-goals:";

interface Figure extends HTMLElement {
  recall?: (solved: string[]) => void;
}

const nameOf = (figure: Element) => figure.getAttribute("name") ?? "";

function load(figure: string): string[] {
  try {
    const stored: unknown = JSON.parse(localStorage.getItem(PREFIX + figure) ?? "[]");
    return Array.isArray(stored) ? stored.filter((id) => typeof id === "string") : [];
  } catch {
    return [];
  }
}

/** Stores that a goal (`figure/goal`) is reached. Returns false if storage is blocked. */
export function markReached(goal: string): boolean {
  const [figure = "", id = ""] = goal.split("/");
  const known = load(figure);
  try {
    if (!known.includes(id)) localStorage.setItem(PREFIX + figure, JSON.stringify([...known, id]));
    return true;
  } catch {
    return false;
  }
}

/** Counts those of the given goals (`figure/goal`) that the reader has reached. */
export function countReached(goals: string[]): number {
  const isReached = (goal: string) => {
    const [figure = "", id = ""] = goal.split("/");
    return load(figure).includes(id);
  };
  return goals.filter(isReached).length;
}

/** Returns the goals named in an element's `data-goals`. */
export function goalsOf({ dataset }: HTMLElement): string[] {
  return (dataset.goals ?? "").split(" ").filter((goal) => goal !== "");
}

/** Forgets the goals of these figures. Throws if storage is blocked. */
export function forget(goals: string[]): void {
  for (const goal of goals) localStorage.removeItem(PREFIX + (goal.split("/")[0] ?? ""));
}

/** Returns the goal (`figure/goal`) of an event `epipole-challenge`. */
export function goalOf(event: Event): string {
  return `${nameOf(event.target as Element)}/${(event as CustomEvent<{ id: string }>).detail.id}`;
}

/** Passes a figure its goals that were reached before. */
export function recall(figure: Figure): void {
  const reached = load(nameOf(figure));
  if (reached.length > 0) figure.recall?.(reached);
}

/** Stores goals reached on this page and restores those reached before. */
export function startGoals(): void {
  // The progress page reports blocked storage.
  document.addEventListener("epipole-challenge", (event) => void markReached(goalOf(event)));
  document.addEventListener("epipole-ready", ({ target }) => recall(target as Figure));
}
