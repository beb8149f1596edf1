/** Numbers passed by a reader's code, nested in any way. */

import { inspect } from "./inspect.js";

/** Flattens an array of numbers, of pairs, or a typed array. */
export function numbers(name: string, value: unknown): number[] {
  const isList = Array.isArray(value) || (ArrayBuffer.isView(value) && !(value instanceof DataView));
  if (!isList) throw new TypeError(`${name} must be an array of numbers, but is ${inspect(value)}`);
  return Array.from(value as ArrayLike<unknown>).flatMap((part) =>
    typeof part === "number" ? [part] : numbers(name, part),
  );
}

/** Flattens numbers in groups of `size`; empty if undefined. */
export function groups(name: string, value: unknown, size: number): number[] {
  const flat = value === undefined ? [] : numbers(name, value);
  if (flat.length % size !== 0) {
    throw new TypeError(`${name} must be ${size} numbers each, but there are ${flat.length} in all`);
  }
  return flat;
}
