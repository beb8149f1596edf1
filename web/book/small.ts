// Thumbnails that animate: on hover, on focus, or in the middle of a touch screen. `data-moves` is the state to glide
// to and back from, repeatedly. Only one runs at a time, and none with reduced motion.

import { wantsStillness } from "../src/theme";

interface Figure extends HTMLElement {
  glide?: (parameters: Record<string, string>, options: { duration: number }) => Promise<void>;
}

/** Duration of one direction, then of the pause after it, milliseconds. */
const WAY_MS = 1600;
const REST_MS = 500;
/** Interval for polling whether the figure has finished computing, milliseconds. */
const CHECK_MS = 100;
/** Minimum hover time before a thumbnail animates, milliseconds. */
const LINGER_MS = 250;

const pause = (duration: number) => new Promise((done) => setTimeout(done, duration));

/** Whether a picture is fully visible; otherwise a moving figure would scroll the page to itself. */
function isWhole(card: HTMLElement): boolean {
  const box = card.querySelector("picture")?.getBoundingClientRect();
  return box !== undefined && box.top >= 0 && box.bottom <= innerHeight;
}

let awake: { card: HTMLElement; figure: Figure } | undefined;
let next: number | undefined;

function rest(card: HTMLElement): void {
  clearTimeout(next);
  if (awake?.card !== card) return;
  awake.figure.remove();
  awake = undefined;
}

function wake(card: HTMLElement): void {
  clearTimeout(next);
  if (awake?.card === card || wantsStillness()) return;
  next = setTimeout(() => {
    if (awake) rest(awake.card);
    if (isWhole(card)) void live(card);
  }, LINGER_MS);
}

async function live(card: HTMLElement): Promise<void> {
  const figure: Figure = document.createElement("epipole-figure");
  const state = JSON.parse(card.dataset.state ?? "{}") as Record<string, string>;
  const moves = JSON.parse(card.dataset.moves ?? "{}") as Record<string, string>;
  const home = Object.fromEntries(Object.keys(moves).map((key) => [key, state[key] ?? ""]));
  const looks = { name: card.dataset.figure ?? "", compact: "", controls: "none", readouts: "none", goals: "none" };
  for (const [key, value] of Object.entries({ ...state, ...looks })) figure.setAttribute(key, value);
  // The picture adds nothing to the text, and only the link can be operated.
  figure.inert = true;
  figure.setAttribute("aria-hidden", "true");
  // Goals met by the animation are not the reader's.
  figure.addEventListener("epipole-challenge", (event) => event.stopImmediatePropagation());
  awake = { card, figure };
  card.querySelector("picture")?.append(figure);
  const isAwake = () => awake?.figure === figure;
  await customElements.whenDefined(figure.localName);
  if (isAwake()) await figure.glide?.(home, { duration: 0 });
  while (isAwake() && figure.shadowRoot?.querySelector("[aria-busy=true], [aria-busy='']")) await pause(CHECK_MS);
  if (isAwake()) figure.classList.add("awake");
  for (let away = true; isAwake(); away = !away) {
    if (wantsStillness()) return rest(card);
    await figure.glide?.(away ? moves : home, { duration: WAY_MS });
    await pause(REST_MS);
  }
}

export function startSmall(): void {
  // The address's parameters belong to the figures of the text.
  if (location.search !== "") return;
  const cards = document.querySelectorAll<HTMLElement>(".small[data-moves]");
  const hovers = matchMedia("(hover: hover)").matches;
  // A band in the middle of the screen, about one picture high.
  const watch = new IntersectionObserver(
    (entries) => {
      for (const { target, isIntersecting } of entries) if (!isIntersecting) rest(target as HTMLElement);
      const [come] = entries.filter(({ isIntersecting }) => isIntersecting);
      if (come) wake(come.target as HTMLElement);
    },
    { rootMargin: "-45% 0px -45% 0px" },
  );
  for (const card of cards) {
    if (!hovers) watch.observe(card);
    card.addEventListener("focus", () => wake(card));
    card.addEventListener("blur", () => rest(card));
    card.addEventListener("pointerenter", ({ pointerType }) => {
      if (pointerType === "mouse") wake(card);
    });
    card.addEventListener("pointerleave", ({ pointerType }) => {
      if (pointerType === "mouse") rest(card);
    });
  }
}
