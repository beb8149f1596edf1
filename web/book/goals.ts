// Goals of figures: which of them the reader has reached, on any page, is remembered in this browser only.

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

/** How many of some goals, each `figure/goal`, the reader has reached. */
export function countReached(goals: string[]): number {
  const isReached = (goal: string) => {
    const [figure = "", id = ""] = goal.split("/");
    return load(figure).includes(id);
  };
  return goals.filter(isReached).length;
}

/** The goals that an element names. */
export function goalsOf({ dataset }: HTMLElement): string[] {
  return (dataset.goals ?? "").split(" ").filter((goal) => goal !== "");
}

/** Forgets the goals of these figures; throws where nothing may be stored. */
export function forget(goals: string[]): void {
  for (const goal of goals) localStorage.removeItem(PREFIX + (goal.split("/")[0] ?? ""));
}

/** Remembers the goals that are reached on this page, and tells a figure of those reached before. */
export function startGoals(): void {
  const nameOf = ({ target }: Event) => (target as HTMLElement).getAttribute("name") ?? "";
  document.addEventListener("epipole-challenge", (event) => {
    const { id } = (event as CustomEvent<{ id: string }>).detail;
    const known = load(nameOf(event));
    if (known.includes(id)) return;
    try {
      localStorage.setItem(PREFIX + nameOf(event), JSON.stringify([...known, id]));
    } catch {
      // The page of progress says so.
    }
  });
  document.addEventListener("epipole-ready", (event) => {
    const reached = load(nameOf(event));
    if (reached.length > 0) (event.target as Figure).recall?.(reached);
  });
}
