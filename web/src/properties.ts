/** A figure's parameters as properties of its element. */

import type { Control } from "./contract.js";
import type { Parameters } from "./permalink.js";

/** Members of the element used by its properties. */
export interface Host extends HTMLElement {
  readonly controlValue: (id: string) => number | boolean | string | undefined;
  apply: (parameters: Record<string, string | number | boolean>) => void;
}

const defined = new WeakMap<Host, string[]>();

/**
 * Defines a property for each control: `figure.outliers = 0.4`. Names that elements already have
 * keep their meaning; those controls are reached through `state`. Replaces the properties of the
 * previous figure. Returns the values that were assigned before the figure existed.
 */
export function defineProperties(host: Host, controls: Control[]): Parameters {
  for (const id of defined.get(host) ?? []) Reflect.deleteProperty(host, id);
  const names: string[] = [];
  defined.set(host, names);
  const early: Parameters = [];
  for (const { id, kind } of controls) {
    if (kind === "button") continue;
    const own = Object.getOwnPropertyDescriptor(host, id);
    if (own && "value" in own) {
      early.push([id, String(own.value)]);
      Reflect.deleteProperty(host, id);
    }
    if (id in host) continue;
    names.push(id);
    Object.defineProperty(host, id, {
      configurable: true,
      enumerable: true,
      get: () => host.controlValue(id),
      set: (value: string | number | boolean) => host.apply({ [id]: value }),
    });
  }
  return early;
}
