/** The state that a figure opens with: what attributes, the page's address and early properties ask for. */

import { parametersOf } from "./attributes.js";
import type { Refused, Snapshot } from "./contract.js";
import type { Engine } from "./module.js";
import { parametersIn } from "./permalink.js";
import { defineProperties, type Host } from "./properties.js";

export interface Opened {
  /** The figure as it would be laid out in `width`. */
  first: Snapshot;
  /** What could not be used. */
  problems: Refused[];
  /** The page's address speaks of this figure. */
  linked: boolean;
}

/** Brings a new engine into that state; the address counts if `withAddress` says so. */
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
  return { first, problems, linked };
}
