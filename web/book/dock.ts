// Brings a figure and the sentence that operates it onto one screen. If both fit, the page scrolls as little as
// possible. Otherwise the figure docks at the top or bottom of the screen, with a placeholder in the chapter, until the
// reader closes it, scrolls on or reaches the placeholder.

import { wantsStillness } from "../src/theme";

/** Distance from the edges of the screen, and between figure and text, CSS pixels. */
const GAP_PX = 8;
/** Maximum height of a docked figure, CSS pixels. */
const MAX_HEIGHT_PX = 440;
/** Minimum height beside a paragraph for keeping all of it uncovered, CSS pixels. */
const MIN_ROOM_PX = 300;
/** Visible fraction of the placeholder at which a docked figure returns to it. */
const RETURN_AT = 0.95;

interface Span {
  top: number;
  bottom: number;
}

/** Returns the visible part of the window, without the bar of the page if that is above the element. */
function viewport(element: Element): Span {
  const bar = document.querySelector(".bar")?.getBoundingClientRect();
  const covers = bar !== undefined && bar.top <= 0 && bar.right > element.getBoundingClientRect().left;
  return { top: (covers ? bar.bottom : 0) + GAP_PX, bottom: innerHeight - GAP_PX };
}

const isIn = (inner: Span, outer: Span) => inner.top >= outer.top - 1 && inner.bottom <= outer.bottom + 1;

/** Returns the picture of a figure, or the figure if it has none yet. */
const pictureOf = (figure: HTMLElement) => figure.querySelector("epipole-figure")?.shadowRoot?.querySelector(".picture") ?? figure;

/** Whether a sentence is less than a screen away from being visible. */
export function isNear(words: Element, figure: Element): boolean {
  const [sentence, room] = [words.getBoundingClientRect(), viewport(figure)];
  const height = room.bottom - room.top;
  return sentence.bottom >= room.top - height && sentence.top <= room.bottom + height;
}

let docked: Dock | undefined;

/** Brings a figure of the chapter and a sentence onto one screen, without moving the sentence off it. */
export function bringTogether(figure: HTMLElement, words: HTMLElement): void {
  if (docked?.figure === figure) return docked.moveTo(words);
  docked?.end();
  const [picture, sentence, room] = [pictureOf(figure).getBoundingClientRect(), words.getBoundingClientRect(), viewport(figure)];
  const both = { top: Math.min(picture.top, sentence.top), bottom: Math.max(picture.bottom, sentence.bottom) };
  if (isIn(both, room)) return;
  if (both.bottom - both.top > room.bottom - room.top) docked = new Dock(figure, words);
  else scrollInto(both, room);
}

/** Scrolls the page as little as needed to bring a part of it into a part of the screen. */
function scrollInto(part: Span, room: Span): void {
  const by = part.top < room.top ? part.top - room.top : part.bottom - room.bottom;
  scrollBy({ top: by, behavior: wantsStillness() ? "instant" : "smooth" });
}

class Dock {
  readonly figure: HTMLElement;
  #words: HTMLElement;
  /** Placeholder, as tall as the figure was in the chapter. */
  readonly #placeholder = document.createElement("div");
  readonly #bar = document.createElement("div");
  readonly #back = button("Back to the text", "dock-back");
  readonly #listening = new AbortController();

  constructor(figure: HTMLElement, words: HTMLElement) {
    this.figure = figure;
    this.#words = words;
    this.#placeholder.className = "dock-placeholder";
    this.#placeholder.style.blockSize = `${figure.getBoundingClientRect().height}px`;
    figure.before(this.#placeholder);
    this.#fillBar();
    figure.prepend(this.#bar);
    figure.classList.add("docked");
    // In the top layer, `fixed` refers to the screen even inside sections with containment.
    figure.popover = "manual";
    figure.showPopover();
    figure.querySelector("epipole-figure")?.toggleAttribute("compact", true);
    this.#position();
    const { signal } = this.#listening;
    addEventListener("scroll", () => this.#onScroll(), { signal, passive: true });
    addEventListener("resize", () => this.#position(), { signal });
    addEventListener("beforeprint", () => this.end(), { signal });
    addEventListener("keydown", (event) => this.#onKey(event), { signal });
  }

  /** Switches to keeping another sentence uncovered. */
  moveTo(words: HTMLElement): void {
    this.#words = words;
    const [dock, sentence, room] = [this.figure.getBoundingClientRect(), words.getBoundingClientRect(), viewport(this.#placeholder)];
    const isAbove = dock.top < room.top + 1;
    const free = isAbove ? { ...room, top: dock.bottom + GAP_PX } : { ...room, bottom: dock.top - GAP_PX };
    if (sentence.bottom > dock.top && sentence.top < dock.bottom) this.#position();
    else if (!isIn(sentence, free)) scrollInto(sentence, free);
    this.#back.hidden = true;
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
    this.#placeholder.remove();
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

  /** Chooses the side of the screen, above or below the sentence, that has more room. */
  #position(): void {
    const [sentence, place, room] = [this.#words.getBoundingClientRect(), this.#placeholder.getBoundingClientRect(), viewport(this.#placeholder)];
    const paragraph = (this.#words.closest("p, li") ?? this.#words).getBoundingClientRect();
    const [above, below] = [sentence.top - room.top, room.bottom - sentence.bottom];
    const isAbove = above > below;
    const beside = isAbove ? paragraph.top - room.top : room.bottom - paragraph.bottom;
    const height = Math.min((beside >= MIN_ROOM_PX ? beside : Math.max(above, below)) - GAP_PX, MAX_HEIGHT_PX);
    Object.assign(this.figure.style, {
      left: `${place.left}px`,
      width: `${place.width}px`,
      height: `${height}px`,
      top: isAbove ? `${room.top}px` : "auto",
      bottom: isAbove ? "auto" : `${GAP_PX}px`,
    });
  }

  /** Ends after scrolling to the placeholder, or a screen away from the sentence. */
  #onScroll(): void {
    const [place, sentence, room] = [this.#placeholder.getBoundingClientRect(), this.#words.getBoundingClientRect(), viewport(this.#placeholder)];
    const height = room.bottom - room.top;
    const visible = Math.min(place.bottom, room.bottom) - Math.max(place.top, room.top);
    const away = !isNear(this.#words, this.#placeholder);
    if (visible >= RETURN_AT * Math.min(place.height, height)) this.end();
    else if (away && !this.figure.matches(":hover, :focus-within")) this.end();
    else this.#back.hidden = isIn(sentence, room);
  }

  #onKey(event: KeyboardEvent): void {
    // The figure handles Escape first, to close its drawer.
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

/** Shows a button that leads back to a sentence, until the sentence is on the screen. */
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
