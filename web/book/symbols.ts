// Symbols of the text that figures draw: pointing at one highlights it in the nearest figure that contains it. Those in
// the list at the start of the chapter are keyboard-focusable.

interface Figure extends HTMLElement {
  light?: (symbol: string | undefined) => boolean;
}

/** Duration of the highlight after a tap, milliseconds. */
const AFTER_A_TAP = 3000;

let lit: Figure | undefined;
/** Symbol under the pointer that no figure shows yet, as one may still be computing. */
let waiting: HTMLElement | undefined;
let timer = 0;

function end(): void {
  clearTimeout(timer);
  lit?.light?.(undefined);
  if (lit) delete lit.dataset.lit;
  lit = undefined;
  waiting = undefined;
}

/** Returns the vertical distance of a figure from a symbol, CSS pixels; figures out of view come last. */
function distance(figure: Element, letter: DOMRect): number {
  const { top, bottom } = figure.getBoundingClientRect();
  const apart = Math.max(top - letter.bottom, letter.top - bottom, 0);
  return bottom < 0 || top > innerHeight ? apart + 1e6 : apart;
}

function light(letter: HTMLElement): void {
  end();
  const name = letter.dataset.symbol ?? "";
  const place = letter.getBoundingClientRect();
  const figures = [...document.querySelectorAll<Figure>("epipole-figure")];
  const near = figures.map((figure) => [distance(figure, place), figure] as const).sort(([a], [b]) => a - b);
  const found = near.find(([, figure]) => figure.light?.(name));
  if (!found) {
    waiting = letter;
    return;
  }
  lit = found[1];
  lit.dataset.lit = letter.dataset.role ?? "";
}

export function startSymbols(): void {
  const letterOf = ({ target }: Event) =>
    target instanceof Element ? target.closest<HTMLElement>("[data-symbol]") : null;
  document.addEventListener("pointerover", (event) => {
    const letter = letterOf(event);
    if (letter && event.pointerType === "mouse") light(letter);
  });
  document.addEventListener("pointerout", (event) => {
    if (letterOf(event) && event.pointerType === "mouse") end();
  });
  document.addEventListener("click", (event) => {
    const letter = letterOf(event);
    if (!letter || letter.matches(":focus")) return;
    light(letter);
    timer = window.setTimeout(end, AFTER_A_TAP);
  });
  for (const event of ["epipole-ready", "epipole-readout"]) {
    document.addEventListener(event, () => waiting && light(waiting));
  }
  for (const letter of document.querySelectorAll<HTMLElement>(".symbols [data-symbol]")) {
    letter.tabIndex = 0;
    letter.setAttribute("role", "button");
    const spoken = (letter.dataset.letter ?? "").replace("ℓ", "l").replace("'", " prime");
    letter.setAttribute("aria-label", `${spoken}, ${letter.nextElementSibling?.textContent ?? ""}`);
    letter.addEventListener("focus", () => light(letter));
    letter.addEventListener("blur", end);
    letter.addEventListener("keydown", ({ key }) => {
      if (key === "Escape") end();
      if (key === "Enter" || key === " ") light(letter);
    });
  }
}
