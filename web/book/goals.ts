// Goals of figures: remembers, in this browser only, which ones the reader has reached.

const PREFIX = "epipole-goals:";

interface Figure extends HTMLElement {
  recall?: (solved: string[]) => void;
}

function load(figure: string): string[] {
  try {
    const stored: unknown = JSON.parse(localStorage.getItem(PREFIX + figure) ?? "[]");
    return Array.isArray(stored) ? stored.filter((id) => typeof id === "string") : [];
  } catch {
    return [];
  }
}

/** Number of the given goals (`figure/goal`) that the reader has reached. */
export function countReached(goals: string[]): number {
  const isReached = (goal: string) => {
    const [figure = "", id = ""] = goal.split("/");
    return load(figure).includes(id);
  };
  return goals.filter(isReached).length;
}

/** The goals named in an element's `data-goals`. */
export function goalsOf({ dataset }: HTMLElement): string[] {
  return (dataset.goals ?? "").split(" ").filter((goal) => goal !== "");
}

/** Forgets the goals of these figures. Throws if storage is blocked. */
export function forget(goals: string[]): void {
  for (const goal of goals) localStorage.removeItem(PREFIX + (goal.split("/")[0] ?? ""));
}

/** Stores goals reached on this page and restores those reached before. */
export function startGoals(): void {
  const nameOf = ({ target }: Event) => (target as HTMLElement).getAttribute("name") ?? "";
  document.addEventListener("epipole-challenge", (event) => {
    const { id } = (event as CustomEvent<{ id: string }>).detail;
    const known = load(nameOf(event));
    if (known.includes(id)) return;
    try {
      localStorage.setItem(PREFIX + nameOf(event), JSON.stringify([...known, id]));
    } catch {
      // The progress page reports blocked storage.
    }
  });
  document.addEventListener("epipole-ready", (event) => {
    const reached = load(nameOf(event));
    if (reached.length > 0) (event.target as Figure).recall?.(reached);
  });
}
