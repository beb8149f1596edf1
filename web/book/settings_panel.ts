// The panel with the reader's settings, opened by the button in the bar. The page loads it on first use.

import type { Name, Settings } from "./settings";

/** Access to the settings of the page. The panel does not import them, as that would split the page's script. */
export interface Access {
  shown: () => Settings;
  keep: (settings: Settings) => void;
}

/** Groups of choices: the setting, its name, and a label for each value, the default first. */
const GROUPS: [Name, string, [string, string][]][] = [
  ["theme", "Colors", [["", "System"], ["light", "Light"], ["dark", "Dark"]]],
  ["contrast", "Contrast", [["", "System"], ["more", "More"]]],
  ["text", "Text size", [["", "100%"], ["115", "115%"], ["130", "130%"], ["150", "150%"]]],
  ["face", "Typeface", [["", "Book"], ["legible", "More legible"]]],
  ["motion", "Motion", [["", "System"], ["reduced", "Reduced"]]],
];

function make<K extends keyof HTMLElementTagNameMap>(tag: K, className: string, ...parts: (Node | string)[]): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  element.className = className;
  element.append(...parts);
  return element;
}

function group(name: Name, title: string, choices: [string, string][]): HTMLElement {
  const labels = choices.map(([value, words]) => {
    const input = make("input", "");
    Object.assign(input, { type: "radio", name: `setting-${name}`, value });
    return make("label", "", input, make("span", "", words));
  });
  return make("fieldset", "", make("legend", "", title), make("div", "choices", ...labels));
}

export function makePanel(button: HTMLButtonElement, { shown, keep }: Access): HTMLElement {
  const reset = make("button", "settings-reset", "Reset");
  reset.type = "button";
  const words = make("p", "", "Figures follow at once. Their colors also work for color-blind readers.");
  const panel = make("div", "settings", ...GROUPS.map((row) => group(...row)), words, reset);
  panel.popover = "auto";
  panel.setAttribute("role", "dialog");
  panel.setAttribute("aria-label", "Settings");
  const inputs = [...panel.querySelectorAll("input")];
  const settingOf = (input: HTMLInputElement) => input.name.replace("setting-", "") as Name;
  const update = () => {
    const settings = shown();
    for (const input of inputs) input.checked = input.value === (settings[settingOf(input)] ?? "");
    reset.disabled = Object.keys(settings).length === 0;
  };
  panel.addEventListener("change", () => {
    const chosen = inputs.filter(({ checked, value }) => checked && value !== "");
    keep(Object.fromEntries(chosen.map((input) => [settingOf(input), input.value])));
    update();
  });
  reset.addEventListener("click", () => {
    keep({});
    update();
    // A disabled button would lose the focus.
    inputs[0]?.focus();
  });
  panel.addEventListener("beforetoggle", ({ newState }) => newState === "open" && update());
  panel.addEventListener("toggle", ({ newState }) => {
    button.setAttribute("aria-expanded", String(newState === "open"));
    if (newState === "open") panel.querySelector<HTMLInputElement>(":checked")?.focus();
  });
  // Another tab may change them.
  addEventListener("storage", update);
  button.after(panel);
  button.popoverTargetElement = panel;
  return panel;
}
