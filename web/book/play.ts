// Figures that play by themselves when they come in sight: `data-play` names the button to press. Once, only for
// readers who do not mind motion, and not for one who has taken hold of the figure.

interface Figure extends HTMLElement {
  readonly readouts?: Record<string, number | string>;
  readoutText?: (id: string) => string | undefined;
  press?: (id: string) => void;
}

/** How much of the figure is to be seen before it begins. */
const SHARE = 0.6;
const CHECK_MS = 250;

/** Whether the figure's own numbers are there, so that it has something to play. */
function isKnown(figure: Figure): boolean {
  const [first] = Object.keys(figure.readouts ?? {});
  return first !== undefined && figure.readoutText?.(first) !== undefined;
}

function play(figure: Figure): void {
  let timer: number | undefined;
  const stop = () => {
    clearInterval(timer);
    watch.disconnect();
    for (const taken of TAKEN) figure.removeEventListener(taken, stop);
  };
  const watch = new IntersectionObserver(
    ([entry]) => {
      clearInterval(timer);
      if (!entry?.isIntersecting) return;
      timer = setInterval(() => {
        if (!isKnown(figure)) return;
        stop();
        figure.press?.(figure.dataset.play ?? "");
      }, CHECK_MS);
    },
    { threshold: SHARE },
  );
  watch.observe(figure);
  for (const taken of TAKEN) figure.addEventListener(taken, stop);
}

/** What a reader does who takes hold of a figure. */
const TAKEN = ["pointerdown", "keydown"] as const;

export function startPlaying(): void {
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) return;
  // Printing and permalinks show a state, not a story.
  if (location.search !== "") return;
  for (const figure of document.querySelectorAll<Figure>("epipole-figure[data-play]")) play(figure);
}
