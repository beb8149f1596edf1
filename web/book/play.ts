// Figures that play when scrolled into view; `data-play` names the button to press. Each plays once, never with reduced
// motion and never after the reader has operated it.

import { wantsStillness } from "../src/theme";

interface Figure extends HTMLElement {
  readonly readouts?: Record<string, number | string>;
  readoutText?: (id: string) => string | undefined;
  press?: (id: string) => void;
}

/** Visible fraction of the figure at which it starts. */
const SHARE = 0.6;
const CHECK_MS = 250;

/** Whether the figure has computed its readouts, so that it can be played. */
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
        if (wantsStillness() || !isKnown(figure)) return;
        stop();
        figure.press?.(figure.dataset.play ?? "");
      }, CHECK_MS);
    },
    { threshold: SHARE },
  );
  watch.observe(figure);
  for (const taken of TAKEN) figure.addEventListener(taken, stop);
}

/** Events by which a reader takes control of a figure. */
const TAKEN = ["pointerdown", "keydown"] as const;

export function startPlaying(): void {
  // Permalinks and printing show a state, not an animation.
  if (location.search !== "") return;
  for (const figure of document.querySelectorAll<Figure>("epipole-figure[data-play]")) play(figure);
}
