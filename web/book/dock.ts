// A figure and the sentence that operates it, on one screen. Where both fit, the page scrolls by the least. Where they
// do not, the figure docks: it leaves an empty place of its size in the chapter and stands at the top or bottom of the
// screen, until the reader closes it, reads on or comes to its place.

import { wantsStillness } from "../src/theme";

/** Distance from the edges of the screen, and between figure and text, CSS pixels. */
const GAP_PX = 8;
/** Most of a docked figure, and the least for which the whole paragraph stays uncovered, CSS pixels. */
const HIGHEST_PX = 440;
const PARAGRAPH_PX = 300;
/** Visible fraction of its place at which a docked figure returns to it. */
const HOME = 0.95;

interface Span {
  top: number;
  bottom: number;
}

/** The part of the window below the bar, if that covers the element's columns. */
function screen(element: Element): Span {
  const bar = document.querySelector(".bar")?.getBoundingClientRect();
  const covers = bar !== undefined && bar.top <= 0 && bar.right > element.getBoundingClientRect().left;
  return { top: (covers ? bar.bottom : 0) + GAP_PX, bottom: innerHeight - GAP_PX };
}

const isIn = (inner: Span, outer: Span) => inner.top >= outer.top - 1 && inner.bottom <= outer.bottom + 1;

/** The picture of a figure; the figure where there is none yet. */
const pictureOf = (figure: HTMLElement) => figure.querySelector("epipole-figure")?.shadowRoot?.querySelector(".picture") ?? figure;

let docked: Dock | undefined;

/** Brings a figure of the chapter and a sentence onto one screen, without taking the sentence off it. */
export function bringTogether(figure: HTMLElement, words: HTMLElement): void {
  if (docked?.figure === figure) return docked.serve(words);
  docked?.end();
  const [picture, sentence, room] = [pictureOf(figure).getBoundingClientRect(), words.getBoundingClientRect(), screen(figure)];
  const both = { top: Math.min(picture.top, sentence.top), bottom: Math.max(picture.bottom, sentence.bottom) };
  if (isIn(both, room)) return;
  if (both.bottom - both.top > room.bottom - room.top) docked = new Dock(figure, words);
  else {
    const by = both.top < room.top ? both.top - room.top : both.bottom - room.bottom;
    scrollBy({ top: by, behavior: wantsStillness() ? "instant" : "smooth" });
  }
}

class Dock {
  readonly figure: HTMLElement;
  #words: HTMLElement;
  /** Keeps the figure's place in the chapter. */
  readonly #place = document.createElement("div");
  readonly #bar = document.createElement("div");
  readonly #back = button("Back to the text", "dock-back");
  readonly #listening = new AbortController();

  constructor(figure: HTMLElement, words: HTMLElement) {
    this.figure = figure;
    this.#words = words;
    this.#place.className = "dock-place";
    this.#place.style.blockSize = `${figure.getBoundingClientRect().height}px`;
    figure.before(this.#place);
    this.#fillBar();
    figure.prepend(this.#bar);
    figure.classList.add("docked");
    // The top layer stands beside the screen whatever contains the chapter's sections.
    figure.popover = "manual";
    figure.showPopover();
    figure.querySelector("epipole-figure")?.toggleAttribute("compact", true);
    this.#stand();
    const { signal } = this.#listening;
    addEventListener("scroll", () => this.#follow(), { signal, passive: true });
    addEventListener("resize", () => this.#stand(), { signal });
    addEventListener("beforeprint", () => this.end(), { signal });
    addEventListener("keydown", (event) => this.#onKey(event), { signal });
  }

  /** Serves another sentence. */
  serve(words: HTMLElement): void {
    this.#words = words;
    const [dock, sentence] = [this.figure.getBoundingClientRect(), words.getBoundingClientRect()];
    if (sentence.bottom > dock.top && sentence.top < dock.bottom) this.#stand();
    this.#follow();
  }

  /** Puts the figure back in its place. */
  end(): void {
    if (docked === this) docked = undefined;
    this.#listening.abort();
    const focused = this.#bar.contains(document.activeElement);
    this.figure.hidePopover();
    this.figure.removeAttribute("popover");
    this.figure.classList.remove("docked");
    this.figure.removeAttribute("style");
    this.#bar.remove();
    this.#place.remove();
    this.figure.querySelector("epipole-figure")?.removeAttribute("compact");
    if (focused) this.#words.focus({ preventScroll: true });
  }

  #fillBar(): void {
    this.#bar.className = "dock-bar";
    const number = this.figure.querySelector<HTMLAnchorElement>(".figure-number")?.cloneNode(true) as HTMLAnchorElement | undefined;
    const close = button("Put back", "dock-close");
    close.title = "Put the figure back into the text";
    close.addEventListener("click", () => this.end());
    this.#back.hidden = true;
    this.#back.addEventListener("click", () => returnTo(this.#words));
    if (number) {
      number.title = "Go to the figure's place in the text";
      number.addEventListener("click", () => {
        this.end();
        offerReturn(this.#words);
      });
      this.#bar.append(number);
    }
    this.#bar.append(this.#back, close);
  }

  /** Takes the side of the screen, above or below the sentence, that has more room. */
  #stand(): void {
    const [sentence, place, room] = [this.#words.getBoundingClientRect(), this.#place.getBoundingClientRect(), screen(this.#place)];
    const paragraph = (this.#words.closest("p, li") ?? this.#words).getBoundingClientRect();
    const [above, below] = [sentence.top - room.top, room.bottom - sentence.bottom];
    const isAbove = above > below;
    const beside = isAbove ? paragraph.top - room.top : room.bottom - paragraph.bottom;
    const height = Math.min((beside >= PARAGRAPH_PX ? beside : Math.max(above, below)) - GAP_PX, HIGHEST_PX);
    Object.assign(this.figure.style, {
      left: `${place.left}px`,
      width: `${place.width}px`,
      height: `${height}px`,
      top: isAbove ? `${room.top}px` : "auto",
      bottom: isAbove ? "auto" : `${GAP_PX}px`,
    });
  }

  /** After scrolling: returns the figure to its place there, or when its sentence is a screen away. */
  #follow(): void {
    const [place, sentence, room] = [this.#place.getBoundingClientRect(), this.#words.getBoundingClientRect(), screen(this.#place)];
    const height = room.bottom - room.top;
    const visible = Math.min(place.bottom, room.bottom) - Math.max(place.top, room.top);
    const away = sentence.bottom < room.top - height || sentence.top > room.bottom + height;
    if (visible >= HOME * Math.min(place.height, height)) this.end();
    else if (away && !this.figure.matches(":hover, :focus-within")) this.end();
    else this.#back.hidden = isIn(sentence, room);
  }

  #onKey(event: KeyboardEvent): void {
    // The figure itself hears Escape first: it closes its drawer.
    if (event.key !== "Escape" || event.defaultPrevented) return;
    if (this.#bar.contains(document.activeElement) || document.activeElement === this.#words) this.end();
  }
}

function button(text: string, className: string): HTMLButtonElement {
  const made = document.createElement("button");
  made.type = "button";
  made.className = className;
  made.textContent = text;
  return made;
}

function returnTo(words: HTMLElement): void {
  words.scrollIntoView({ block: "center", behavior: wantsStillness() ? "instant" : "smooth" });
  words.focus({ preventScroll: true });
}

/** Offers the way back to a sentence, until it is on the screen. */
function offerReturn(words: HTMLElement): void {
  document.querySelector(".return")?.remove();
  const back = button("Back to the text", "return");
  const seen = new IntersectionObserver(([entry]) => {
    if (!entry?.isIntersecting) return;
    seen.disconnect();
    back.remove();
  });
  back.addEventListener("click", () => returnTo(words));
  document.body.append(back);
  seen.observe(words);
}
