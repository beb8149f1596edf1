// Slides of a chapter. A second window, for the speaker, shows the notes and controls both.

import Reveal from "reveal.js";
import { startOperating } from "../book/operate";

/** Size of a slide, CSS pixels. */
const SIZE = { width: 1280, height: 720 };
/** Query of the address of the speaker's window. */
const SPEAKER = "?notes";

interface Place {
  h: number;
  v: number;
}

const isSpeaker = location.search === SPEAKER;
const isCalm = matchMedia("(prefers-reduced-motion: reduce)").matches;

async function start(): Promise<void> {
  const deck = new Reveal({
    ...SIZE,
    margin: 0.02,
    center: false,
    // Figures take the remaining space.
    display: "flex",
    hash: true,
    respondToHashChanges: true,
    controlsTutorial: false,
    // Narrow screens show the same slides, scaled down.
    scrollActivationWidth: 0,
    showNotes: isSpeaker,
    transition: isCalm ? "none" : "slide",
    backgroundTransition: "none",
  });
  await deck.initialize();
  startOperating({ docks: false });
  const windows = new BroadcastChannel(`epipole-slides ${location.pathname}`);
  deck.on("slidechanged", () => {
    const { h, v } = deck.getIndices();
    windows.postMessage({ h, v } satisfies Place);
  });
  windows.addEventListener("message", ({ data }: MessageEvent<Place>) => deck.slide(data.h, data.v));
  if (!isSpeaker) offerSpeaker(() => deck.getIndices());
}

/** Adds the button for the speaker's window, which opens at the current slide. */
function offerSpeaker(shown: () => Place): void {
  const button = document.querySelector<HTMLButtonElement>(".speaker");
  if (!button) return;
  button.hidden = false;
  button.addEventListener("click", () => {
    const { h, v } = shown();
    window.open(`${location.pathname}${SPEAKER}#/${h}/${v}`, "epipole-speaker", "popup,width=1100,height=700");
  });
}

void start();
