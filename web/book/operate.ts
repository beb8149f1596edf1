// Sentences that operate figures: `.do` sets a figure's state, `.live` follows one of its readouts. Until this script
// runs, both are plain text. A figure may load later or never.

interface Figure extends HTMLElement {
  glide?: (parameters: Record<string, string>, options: { scroll: boolean }) => Promise<void>;
  open?: () => Promise<void>;
  readoutText?: (id: string) => string | undefined;
  controlText?: (id: string) => string | undefined;
}

function figureOf(words: HTMLElement): Figure | null {
  return document.getElementById(words.dataset.figure ?? "")?.querySelector<Figure>("epipole-figure") ?? null;
}

function parametersOf(words: HTMLElement): Record<string, string> {
  return JSON.parse(words.dataset.parameters ?? "{}") as Record<string, string>;
}

/** Resolves in the frame after layout changes, once the browser has scrolled for them (scroll anchoring). */
const scrollAnchored = () => new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));

/** Ends keeping the last operated sentence together with its figure. */
let kept: AbortController | undefined;

/**
 * Calls `act` after each change of layout, until it returns false, or the reader scrolls, presses a key or button,
 * prints or operates another figure.
 */
function keep(act: () => boolean, changing: Element[]): () => Promise<void> {
  kept?.abort();
  const keeping = (kept = new AbortController());
  const { signal } = keeping;
  const again = async () => {
    await scrollAnchored();
    if (!signal.aborted && !act()) keeping.abort();
  };
  // The first report is of initial sizes, not of a change.
  let reports = 0;
  const sizes = new ResizeObserver(() => {
    if (++reports > 1) void again();
  });
  for (const element of changing) sizes.observe(element);
  signal.addEventListener("abort", () => sizes.disconnect());
  for (const type of ["wheel", "touchmove", "keydown", "pointerdown", "beforeprint"]) {
    addEventListener(type, () => keeping.abort(), { signal, passive: true });
  }
  return again;
}

/** Makes the words a button with inline layout, so that they still wrap like text. */
function startButton(words: HTMLElement, docks: boolean): void {
  const figure = figureOf(words);
  if (!figure) return;
  words.setAttribute("role", "button");
  words.tabIndex = 0;
  const number = document.querySelector(`#${CSS.escape(words.dataset.figure ?? "")} .figure-number`)?.textContent;
  if (number) words.title = `Shows it in ${number}`;
  const act = async () => {
    await customElements.whenDefined("epipole-figure");
    // Safari 16 has no popovers, so the page scrolls to the figure instead.
    const canDock = docks && "popover" in HTMLElement.prototype;
    const dock = canDock ? await import("./dock").catch(() => undefined) : undefined;
    const box = figure.closest("figure") ?? figure;
    const together = () => {
      const canBring = dock?.isNear(words, box) ?? false;
      if (canBring) dock?.bringTogether(box, words);
      return canBring;
    };
    together();
    // Fonts that load, figures that start or leave their docks, and numbers in sentences shift the text.
    const again = keep(together, [document.body, figure]);
    await figure.glide?.(parametersOf(words), { scroll: docks && !dock });
    await figure.open?.();
    await again();
  };
  words.addEventListener("click", () => void act());
  words.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== " ") return;
    event.preventDefault();
    if (!event.repeat) void act();
  });
}

/** Keeps the numbers in a sentence equal to the figure's readouts. */
function follow(figure: Figure, numbers: HTMLElement[]): void {
  let scheduled = false;
  const update = () => {
    scheduled = false;
    for (const number of numbers) {
      const id = number.dataset.shows ?? "";
      const text = figure.readoutText?.(id) ?? figure.controlText?.(id);
      if (text === undefined || text === number.textContent) continue;
      number.textContent = text;
      // The width never shrinks, since a paragraph that wraps differently would move the figure below it.
      const width = number.getBoundingClientRect().width;
      if (width > (parseFloat(number.style.minWidth) || 0)) number.style.minWidth = `${Math.ceil(width)}px`;
    }
  };
  const schedule = () => {
    if (!scheduled) requestAnimationFrame(update);
    scheduled = true;
  };
  for (const type of ["epipole-ready", "epipole-readout", "epipole-change"]) figure.addEventListener(type, schedule);
  schedule();
}

/** Starts the sentences. With `docks`, a figure that is off the screen comes to the sentence that operates it. */
export function startOperating({ docks }: { docks: boolean }): void {
  document.querySelectorAll<HTMLElement>(".do").forEach((words) => startButton(words, docks));
  const followed = new Map<Figure, HTMLElement[]>();
  for (const number of document.querySelectorAll<HTMLElement>(".live")) {
    const figure = figureOf(number);
    if (figure) followed.set(figure, [...(followed.get(figure) ?? []), number]);
  }
  followed.forEach((numbers, figure) => follow(figure, numbers));
}
