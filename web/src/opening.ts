/** Opening of a figure: the module, the engine, and the state requested by attributes, address and early properties. */

import { parametersOf } from "./attributes.js";
import { whyMissing } from "./compile.js";
import type { Refused, Snapshot } from "./contract.js";
import { Engine, loadModule } from "./module.js";
import { parametersIn } from "./permalink.js";
import { defineProperties, type Host } from "./properties.js";
import { myTurn } from "./visibility.js";

/** Reason why a figure does not open, as a message, and whether a retry may help. */
export class Failure {
  constructor(
    readonly sentence: string,
    readonly retry: boolean,
  ) {}
}

export interface Attempt {
  isCurrent: () => boolean;
  /** Whether a reader waits for this figure in particular. */
  isUrgent: () => boolean;
  /** Called if the module loads slowly. */
  slow: () => void;
}

/** Loads the module and creates a figure in it, unless another attempt has started. Throws a `Failure`. */
export async function openEngine(name: string, { isCurrent, isUrgent, slow }: Attempt): Promise<Engine | undefined> {
  let memory: WebAssembly.Memory;
  try {
    ({ memory } = await loadModule(() => isCurrent() && slow()));
  } catch (problem) {
    throw new Failure(`${whyMissing(problem, "The interactive part of this figure")}.`, true);
  }
  // Figures that have waited for the module would otherwise all open in one long task.
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
  /** Whether the address of the page has parameters for this figure. */
  linked: boolean;
}

/** Brings a new engine into its initial state, including the address if `withAddress`. */
export function openState(engine: Engine, host: Host, width: number, withAddress: boolean): Opened {
  const problems = engine.apply(parametersOf(host));
  const { own, loose } = parametersIn(withAddress ? location.search : "", host);
  problems.push(...engine.apply(own));
  // Without a key, parameters unknown to the figure belong to others.
  const others = engine.apply(loose);
  problems.push(...others.filter(({ unknown }) => !unknown));
  const linked = own.length + loose.length > others.filter(({ unknown }) => unknown).length;
  const first = engine.snapshot(width);
  problems.push(...engine.apply(defineProperties(host, first.controls)));
  return { title: engine.title, help: engine.help, first, problems, linked };
}
