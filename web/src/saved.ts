/** Saved state of a figure, as stored by a host page: parameters and reached goals. */

/** Current version of the format. */
const VERSION = 1;

export interface Saved {
  v: number;
  /** Name of the figure. */
  figure: string;
  /** Parameters that differ from their defaults. */
  state: Record<string, string>;
  /** Ids of the reached goals. */
  solved: string[];
}

export function toSaved(figure: string, state: Record<string, string>, solved: string[]): Saved {
  return { v: VERSION, figure, state, solved };
}

/** Reads a saved state, as an object or JSON text. Undefined for empty input; a message if it is invalid. */
export function readSaved(kept: unknown, figure: string): Saved | string | undefined {
  let value = kept;
  if (typeof kept === "string" && kept.trim() !== "") {
    try {
      value = JSON.parse(kept);
    } catch {
      return "What the page has kept is no state of a figure";
    }
  }
  if (value === undefined || value === null || value === "") return undefined;
  if (typeof value !== "object") return "What the page has kept is no state of a figure";
  const { v, figure: name, state, solved } = value as Record<string, unknown>;
  if (v === undefined && Object.keys(value).length === 0) return undefined;
  if (typeof v === "number" && v > VERSION) {
    return "What the page has kept comes from a newer version of this figure, so it starts anew";
  }
  if (v !== VERSION || typeof name !== "string" || typeof state !== "object" || state === null) {
    return "What the page has kept is no state of a figure";
  }
  if (name !== figure) return `What the page has kept belongs to the figure "${name}", so this one starts anew`;
  const pairs = Object.entries(state).filter(([, value]) => ["string", "number", "boolean"].includes(typeof value));
  return {
    v: VERSION,
    figure,
    state: Object.fromEntries(pairs.map(([key, value]) => [key, String(value)])),
    solved: Array.isArray(solved) ? solved.filter((id): id is string => typeof id === "string") : [],
  };
}
