/** Attributes of an element that are parameters of its figure. */

import type { Snapshot } from "./contract.js";
import type { Parameters } from "./permalink.js";

/** Attributes that are not parameters: those of the element, and global HTML attributes. */
const NOT_PARAMETERS =
  /^(name|theme|compact|controls|readouts|goals|id|class|style|slot|title|lang|dir|hidden|tabindex|role|is|part|exportparts|inert|translate|nonce|draggable|contenteditable|popover|accesskey|autofocus|item.*|aria-.*|data-.*|on.*)$/;

/** Whether an attribute of this name is a parameter of the figure. */
export function isParameter(name: string): boolean {
  return !NOT_PARAMETERS.test(name);
}

/** Returns the parameters set in the page's markup. */
export function parametersOf(element: Element): Parameters {
  return [...element.attributes]
    .filter(({ name }) => isParameter(name))
    .map(({ name, value }) => [name, value]);
}

/** Returns new values of changed attributes; a removed attribute takes the default. */
export function changedParameters(
  element: Element,
  records: MutationRecord[],
  snapshot: Snapshot | undefined,
): Record<string, string> {
  const parameters: Record<string, string> = {};
  for (const { attributeName: name } of records) {
    if (!name || !isParameter(name)) continue;
    const control = snapshot?.controls.find(({ id }) => id === name);
    const fallback = control && "default" in control ? String(control.default) : undefined;
    const value = element.getAttribute(name) ?? fallback;
    if (value !== undefined) parameters[name] = value;
  }
  return parameters;
}

/**
 * Returns the complete state, to apply on top of the attributes: values other than the default, and default values that
 * override an attribute.
 */
export function wholeState(
  element: Element,
  state: Parameters,
  snapshot: Snapshot | undefined,
): Parameters {
  const named = new Set(state.map(([key]) => key));
  const back: Parameters = [];
  for (const [key] of parametersOf(element)) {
    const control = snapshot?.controls.find(({ id }) => id === key);
    const handle = snapshot?.handles.find(({ id }) => id === key);
    if (named.has(key)) continue;
    if (control?.kind === "slider") back.push([key, control.value.toFixed(control.digits)]);
    else if (control && "value" in control) back.push([key, String(control.value)]);
    else if (handle) {
      const { x, y, digits } = handle;
      back.push([key, `${x.toFixed(digits)},${y.toFixed(digits)}`]);
    }
  }
  return [...back, ...state];
}

/** Converts parameters to strings, as in attributes. */
export function textOf(parameters: Record<string, string | number | boolean>): Parameters {
  return Object.entries(parameters).map(([key, value]) => [key, String(value)]);
}
