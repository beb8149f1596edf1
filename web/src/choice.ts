/** What of a figure its page wants to show: the attributes `controls`, `readouts` and `goals`. */

import type { Snapshot } from "./contract.js";

export interface Choice {
  /** Names of the only controls to show; all, if undefined. */
  controls: string[] | undefined;
  /** Names of the only readouts to show. */
  readouts: string[] | undefined;
  goals: "none" | "one" | "all";
  /** What `goals` says, if that means nothing. */
  odd: string | undefined;
}

/** The attributes that choose; none of them is a parameter of a figure. */
export const CHOOSING = ["controls", "readouts", "goals"] as const;

/** Reads the attributes through `get`, which gives null for one that is not there. */
export function choiceOf(get: (name: string) => string | null): Choice {
  const goals = get("goals")?.trim() ?? "one";
  const known = goals === "none" || goals === "one" || goals === "all";
  return {
    controls: namesIn(get("controls")),
    readouts: namesIn(get("readouts")),
    goals: known ? goals : "one",
    odd: known ? undefined : goals,
  };
}

function namesIn(text: string | null): string[] | undefined {
  if (text === null) return undefined;
  const names = text.trim().split(/[\s,]+/).filter((name) => name !== "");
  return names.length === 1 && names[0] === "none" ? [] : names;
}

/**
 * A sentence for each kind of name that the figure does not have. Which readouts there are is known once
 * the figure waits for nothing.
 */
export function misnamed(choice: Choice, { controls, readouts, waiting }: Snapshot): string[] {
  const shown = controls.filter(({ place }) => place !== "hidden");
  const sentences = [
    unknown("control", choice.controls, shown.map(({ id }) => id)),
    waiting === null ? unknown("readout", choice.readouts, readouts.map(({ id }) => id)) : undefined,
  ];
  if (choice.odd !== undefined) {
    sentences.push(`goals="${choice.odd}" means nothing: it may be none, one or all`);
  }
  return sentences.filter((sentence) => sentence !== undefined);
}

function unknown(kind: string, wanted: string[] | undefined, known: string[]): string | undefined {
  const strange = (wanted ?? []).filter((name) => !known.includes(name));
  if (strange.length === 0) return undefined;
  const names = strange.map((name) => `"${name}"`).join(" and ");
  return `there is no ${kind} ${names} in this figure; it has ${known.join(", ")}`;
}
