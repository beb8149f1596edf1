/** Native inputs for a figure's controls. */

import type { Control, FigureEvent } from "./contract.js";
import { fold, make, setAttribute, setText } from "./dom.js";

type Send = (event: FigureEvent) => void;
type Kind<K extends Control["kind"]> = Extract<Control, { kind: K }>;

/** Number of characters of its options above which a choice takes the width of two inputs. */
const BROAD_OPTIONS = 18;

/** A control on the page: its element, and the function that updates it. */
interface Row {
  element: HTMLElement;
  update: (control: Control) => void;
}

/**
 * The controls of one figure in the figure's order: buttons below the picture, inputs that are
 * always visible, and folded inputs.
 */
export class Controls {
  readonly inputs = make("div", { class: "inputs" });
  readonly buttons = make("div", { class: "buttons", role: "group", "aria-label": "Actions" });
  readonly more = fold("More settings", "more");
  readonly #rest = make("div", { class: "inputs" });
  #rows = new Map<string, Row>();
  readonly #send: Send;

  constructor(send: Send) {
    this.#send = send;
    this.more.append(this.#rest);
    this.#hideEmpty();
  }

  /** Shows the controls; if `only` is given, just those, with none folded. */
  update(controls: Control[], only: string[] | undefined): void {
    for (const control of controls) {
      if (control.place === "hidden" || (only && !only.includes(control.id))) continue;
      let row = this.#rows.get(control.id);
      if (!row) {
        row = makeRow(control, this.#send);
        row.element.dataset["control"] = control.id;
        this.#rows.set(control.id, row);
        const folded = control.place === "more" && !only;
        const first = control.kind === "button" ? this.buttons : this.inputs;
        (folded ? this.#rest : first).append(row.element);
      }
      row.update(control);
    }
    this.#hideEmpty();
  }

  /** Shows the values of a stand-in until the next update. */
  borrow(tree: ParentNode): void {
    for (const output of tree.querySelectorAll("output")) {
      const shown = this.#rows.get(output.htmlFor.value.replace("control-", ""))?.element.querySelector("output");
      if (shown) setText(shown, output.textContent ?? "");
    }
  }

  /** Removes all controls; the next update creates them again. */
  clear(): void {
    for (const { element } of this.#rows.values()) {
      // Chromium leaks radio buttons that are removed from a group, with everything around them.
      for (const radio of element.querySelectorAll("input[type=radio]")) radio.removeAttribute("name");
    }
    this.#rows = new Map();
    for (const group of [this.inputs, this.buttons, this.#rest]) group.replaceChildren();
  }

  /** Returns the element of a control. */
  elementOf(id: string): HTMLElement | undefined {
    return this.#rows.get(id)?.element;
  }

  #hideEmpty(): void {
    this.inputs.hidden = !this.inputs.hasChildNodes();
    this.buttons.hidden = !this.buttons.hasChildNodes();
    this.more.hidden = !this.#rest.hasChildNodes();
  }
}

function makeRow(control: Control, send: Send): Row {
  switch (control.kind) {
    case "slider":
      return sliderRow(control, send);
    case "toggle":
      return toggleRow(control, send);
    case "choice":
      return control.options.length <= 4 ? radioRow(control, send) : selectRow(control, send);
    case "button":
      return buttonRow(control, send);
  }
}

/** Marks a control as disabled; it stays visible and focusable. */
function setEnabled(element: Element, control: Control): void {
  setAttribute(element, "aria-disabled", control.enabled ? undefined : "true");
}

function sliderRow(control: Kind<"slider">, send: Send): Row {
  const id = `control-${control.id}`;
  const input = make("input", {
    id,
    type: "range",
    min: control.min,
    max: control.max,
    step: control.step,
  });
  const output = make("output", { for: id });
  const label = make("label", { for: id }, control.label);
  const element = make("div", { class: "slider" }, label, output, input);
  let shown = control;
  input.addEventListener("input", () => {
    if (shown.enabled) send({ type: "set", id: control.id, value: input.valueAsNumber });
    else input.value = shown.value.toFixed(shown.digits);
  });
  return {
    element,
    update(now) {
      if (now.kind !== "slider") return;
      shown = now;
      const value = now.value.toFixed(now.digits);
      // Set the range first: browsers clamp the value to it.
      if (Number(input.max) !== now.max) input.max = String(now.max);
      if (Number(input.value) !== now.value) input.value = value;
      const share = (now.value - now.min) / (now.max - now.min || 1);
      input.style.setProperty("--share", `${(100 * share).toFixed(2)}%`);
      setAttribute(input, "aria-valuetext", now.value_text);
      setText(output, now.value_text);
      setEnabled(input, now);
    },
  };
}

function toggleRow(control: Kind<"toggle">, send: Send): Row {
  const input = make("input", { type: "checkbox" });
  const element = make("label", { class: "toggle" }, input, make("span", {}, control.label));
  let shown = control;
  input.addEventListener("change", () => {
    if (shown.enabled) send({ type: "set", id: control.id, value: input.checked });
    else input.checked = shown.value;
  });
  return {
    element,
    update(now) {
      if (now.kind !== "toggle") return;
      shown = now;
      input.checked = now.value;
      setEnabled(input, now);
    },
  };
}

function radioRow(control: Kind<"choice">, send: Send): Row {
  const letters = control.options.reduce((sum, [, label]) => sum + label.length, 0);
  const length = letters > BROAD_OPTIONS ? "choice broad" : "choice";
  const element = make("fieldset", { class: length }, make("legend", {}, control.label));
  const inputs = new Map<string, HTMLInputElement>();
  const options = make("div", { class: "options" });
  let shown = control;
  for (const [value, label] of control.options) {
    const input = make("input", { type: "radio", name: `control-${control.id}`, value });
    input.addEventListener("change", () => {
      if (shown.enabled) send({ type: "set", id: control.id, value });
      else check(shown.value);
    });
    inputs.set(value, input);
    options.append(make("label", {}, input, make("span", {}, label)));
  }
  element.append(options);
  const check = (value: string) => {
    for (const [name, input] of inputs) input.checked = name === value;
  };
  return {
    element,
    update(now) {
      if (now.kind !== "choice") return;
      shown = now;
      check(now.value);
      setEnabled(element, now);
    },
  };
}

function selectRow(control: Kind<"choice">, send: Send): Row {
  const id = `control-${control.id}`;
  const options = control.options.map(([value, label]) => make("option", { value }, label));
  const select = make("select", { id }, ...options);
  const element = make("div", { class: "select" }, make("label", { for: id }, control.label), select);
  let shown = control;
  select.addEventListener("change", () => {
    if (shown.enabled) send({ type: "set", id: control.id, value: select.value });
    else choose(shown.value);
  });
  const choose = (value: string) => {
    for (const option of options) option.selected = option.value === value;
  };
  return {
    element,
    update(now) {
      if (now.kind !== "choice") return;
      shown = now;
      choose(now.value);
      setEnabled(select, now);
    },
  };
}

function buttonRow(control: Kind<"button">, send: Send): Row {
  const element = make("button", { type: "button", class: control.role });
  let shown: Kind<"button"> = control;
  element.addEventListener("click", () => {
    if (shown.enabled) send({ type: "press", id: control.id });
  });
  return {
    element,
    update(now) {
      if (now.kind !== "button") return;
      shown = now;
      // The label is the next action, so no pressed state is set.
      setText(element, now.role === "run" && now.pressed ? "Pause" : now.label);
      setAttribute(element, "data-running", now.pressed);
      setEnabled(element, now);
    },
  };
}
