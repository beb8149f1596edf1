/** Initial state of a figure: attributes, the page's address, and properties set early. */

import { parametersOf } from "./attributes.js";
import type { Refused, Snapshot } from "./contract.js";
import type { Engine } from "./module.js";
import { parametersIn } from "./permalink.js";
import { defineProperties, type Host } from "./properties.js";

export interface Opened {
  /** Snapshot for the layout width. */
  first: Snapshot;
  /** Rejected parameters. */
  problems: Refused[];
  /** Whether the page's address has parameters of this figure. */
  linked: boolean;
}

/** Applies the initial state to a new engine; `withAddress` includes the page's address. */
export function openState(engine: Engine, host: Host, width: number, withAddress: boolean): Opened {
  const problems = engine.apply(parametersOf(host));
  const { own, loose } = parametersIn(withAddress ? location.search : "", host);
  problems.push(...engine.apply(own));
  // Unknown parameters without a key belong to the page.
  const others = engine.apply(loose);
  problems.push(...others.filter(({ unknown }) => !unknown));
  const linked = own.length + loose.length > others.filter(({ unknown }) => unknown).length;
  const first = engine.snapshot(width);
  problems.push(...engine.apply(defineProperties(host, first.controls)));
  return { first, problems, linked };
}
