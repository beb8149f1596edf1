/** Selection of controls, readouts and goals by the page, in attributes of the same names. */

import type { Snapshot } from "./contract.js";

export interface Choice {
  /** Names of the controls to show; all if undefined. */
  controls: string[] | undefined;
  /** Names of the readouts to show; all if undefined. */
  readouts: string[] | undefined;
  goals: "none" | "one" | "all";
  /** Value of `goals`, if it is invalid. */
  odd: string | undefined;
}

/** Attributes of the selection; none is a parameter of a figure. */
export const CHOOSING = ["controls", "readouts", "goals"] as const;

/** Reads the attributes with `get`, which returns null for a missing one. */
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
 * Returns a message for each kind of unknown name. Readouts are known only when the figure is not waiting for a
 * computation.
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
