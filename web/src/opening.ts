/** Opening of a figure: the module, the engine, and the state that attributes, address and early properties ask for. */

import { parametersOf } from "./attributes.js";
import { whyMissing } from "./compile.js";
import type { Refused, Snapshot } from "./contract.js";
import { Engine, loadModule } from "./module.js";
import { parametersIn } from "./permalink.js";
import { defineProperties, type Host } from "./properties.js";
import { myTurn } from "./visibility.js";

/** Reason why a figure does not open, as a sentence, and whether another attempt may help. */
export class Failure {
  constructor(
    readonly sentence: string,
    readonly retry: boolean,
  ) {}
}

export interface Attempt {
  isCurrent: () => boolean;
  /** Whether a reader waits for this very figure. */
  isUrgent: () => boolean;
  /** Called if the module takes long. */
  slow: () => void;
}

/** Loads the module and makes a figure in it, unless another attempt has begun. Throws a `Failure`. */
export async function openEngine(name: string, { isCurrent, isUrgent, slow }: Attempt): Promise<Engine | undefined> {
  let memory: WebAssembly.Memory;
  try {
    ({ memory } = await loadModule(() => isCurrent() && slow()));
  } catch (problem) {
    throw new Failure(`${whyMissing(problem, "The interactive part of this figure")}.`, true);
  }
  // Figures that have waited for the module would all open in one long task.
  if (!isUrgent()) await myTurn();
  if (!isCurrent()) return undefined;
  try {
    return new Engine(name, memory);
  } catch (problem) {
    throw new Failure(`This figure cannot be shown: ${String(problem)}.`, false);
  }
}

export interface Opened {
  title: string;
  help: string;
  /** The figure, laid out in `width`. */
  first: Snapshot;
  /** Parameters that could not be used. */
  problems: Refused[];
  /** The address of the page has parameters for this figure. */
  linked: boolean;
}

/** Brings a new engine into its first state, the address included if `withAddress`. */
export function openState(engine: Engine, host: Host, width: number, withAddress: boolean): Opened {
  const problems = engine.apply(parametersOf(host));
  const { own, loose } = parametersIn(withAddress ? location.search : "", host);
  problems.push(...engine.apply(own));
  // Without a key, what the figure does not know is someone else's.
  const others = engine.apply(loose);
  problems.push(...others.filter(({ unknown }) => !unknown));
  const linked = own.length + loose.length > others.filter(({ unknown }) => unknown).length;
  const first = engine.snapshot(width);
  problems.push(...engine.apply(defineProperties(host, first.controls)));
  return { title: engine.title, help: engine.help, first, problems, linked };
}
