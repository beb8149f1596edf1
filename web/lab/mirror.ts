/**
 * Hidden elements that mirror the Lab's widgets, for screen readers to find and operate. They are not Tab stops:
 * keyboard focus stays on the canvas.
 */

/**
 * A line from the module: number, role, name, value, state, minimum, maximum, step, whether the widget's popup is open
 * or closed, description, and the number of the widget that opened the list containing this one.
 */
type Widget = [string, string, string, string, string, string, string, string, string, string, string];

/** Operates a widget by number, role and name, as numbers may be reassigned. */
type Operate = (widget: string, role: string, name: string, value?: number) => void;

export class Mirror {
  readonly #root: HTMLElement;
  readonly #operate: Operate;
  readonly #elements = new Map<string, HTMLElement>();
  readonly #names = new Map<HTMLElement, string>();

  constructor(root: HTMLElement, operate: Operate) {
    this.#root = root;
    this.#operate = operate;
  }

  show(lines: string): void {
    const kept = new Set<string>();
    const opened = new Map<string, string[]>();
    let before: HTMLElement | undefined;
    for (const line of lines.split("\n")) {
      const widget = line.split("\t") as Widget;
      if (widget.length !== 11) continue;
      const key = `${widget[1]} ${widget[0]}`;
      if (kept.has(key)) continue;
      kept.add(key);
      const element = this.#elements.get(key) ?? this.#make(widget);
      this.#elements.set(key, element);
      this.#names.set(element, widget[2]);
      set(element, widget);
      put(element, "id", `widget-${widget[1]}-${widget[0]}`);
      const opener = widget[10];
      if (opener !== "") opened.set(opener, [...(opened.get(opener) ?? []), element.id]);
      const place = before ? before.nextElementSibling : this.#root.firstElementChild;
      if (place !== element) this.#root.insertBefore(element, place);
      before = element;
    }
    for (const [key, element] of this.#elements) {
      if (!kept.has(key)) {
        element.remove();
        this.#elements.delete(key);
        this.#names.delete(element);
        continue;
      }
      const controls = opened.get(key.split(" ")[1] ?? "");
      if (controls && element.hasAttribute("aria-expanded")) put(element, "aria-controls", controls.join(" "));
      else element.removeAttribute("aria-controls");
    }
  }

  #make([id, role]: Widget): HTMLElement {
    if (role === "slider" || role === "number") {
      const input = document.createElement("input");
      input.type = role === "slider" ? "range" : "number";
      input.step = "any";
      input.tabIndex = -1;
      input.addEventListener("change", () => {
        const value = Number(input.value);
        if (input.value !== "" && Number.isFinite(value)) this.#operate(id, role, this.#names.get(input) ?? "", value);
      });
      return input;
    }
    if (role === "text") return document.createElement("p");
    if (role === "img") {
      const picture = document.createElement("div");
      picture.setAttribute("role", "img");
      return picture;
    }
    const button = document.createElement("button");
    button.type = "button";
    button.tabIndex = -1;
    if (role !== "button") button.setAttribute("role", role);
    button.addEventListener("click", () => this.#operate(id, role, this.#names.get(button) ?? ""));
    return button;
  }
}

function set(element: HTMLElement, [, role, name, value, state, least, most, , opens, description]: Widget): void {
  if (element instanceof HTMLInputElement) {
    put(element, "aria-label", name || "number");
    if (least) element.min = least;
    if (most) element.max = most;
    if (document.activeElement !== element) element.value = value;
    element.disabled = state === "disabled";
    return;
  }
  if (role === "text") {
    if (element.textContent !== name) element.textContent = name;
    return;
  }
  if (description !== "") put(element, "title", description);
  else element.removeAttribute("title");
  put(element, "aria-label", role === "combobox" ? `${name}: ${value}` : name);
  if (element instanceof HTMLButtonElement) element.disabled = state === "disabled";
  if (opens !== "") put(element, "aria-expanded", String(opens === "open"));
  else element.removeAttribute("aria-expanded");
  if (role === "checkbox" || role === "radio") put(element, "aria-checked", String(state === "on"));
  else if (role === "button" && (state === "on" || state === "off")) {
    put(element, "aria-pressed", String(state === "on"));
  }
}

function put(element: HTMLElement, name: string, value: string): void {
  if (element.getAttribute(name) !== value) element.setAttribute(name, value);
}
