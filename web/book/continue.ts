// Stores the reader's place, and leads back to it: by a line on the first page to the chapter read last, and by an
// offer in a chapter opened at its top. Neither shifts the text.

import { chapterOf, type Place, storedPlaces, storePlaces } from "./places";

/** Time after which a heading counts as read, milliseconds. */
const DWELL_MS = 3000;

/** Scrolled fraction of the screen that counts as reading on. */
const SCROLLED = 0.25;

/** Returns the link to a chapter in the contents. */
function linkTo(chapter: string): HTMLAnchorElement | undefined {
  return [...document.querySelectorAll<HTMLAnchorElement>("#contents a[href]")].find(
    (link) => !link.hash && chapterOf(link) === chapter,
  );
}

function link(address: string, ...words: (string | Node)[]): HTMLAnchorElement {
  const made = document.createElement("a");
  made.href = address;
  made.append(...words);
  return made;
}

/** Fills the line of the first page with the last place whose chapter still exists. */
function fill(line: HTMLElement, places: Place[]): void {
  for (const [chapter, anchor, title] of places) {
    const entry = linkTo(chapter);
    if (!entry) continue;
    const [number, name] = [...entry.children].map(({ textContent }) => textContent ?? "");
    const words = `Continue: ${number} ${name?.split(":")[0]}, ${title}`;
    line.append(link(`${entry.href}#${encodeURIComponent(anchor)}`, words));
    return;
  }
}

/** Offers a place in this chapter until the reader takes it or scrolls on. */
function offer([, anchor, title]: Place): void {
  const heading = document.getElementById(anchor);
  if (!heading || scrollY > 0 || heading.getBoundingClientRect().top < innerHeight) return;
  const words = document.createElement("em");
  words.append(title);
  const box = document.createElement("nav");
  box.className = "continue-here";
  box.setAttribute("aria-label", "Where you were");
  box.append(link(`#${encodeURIComponent(anchor)}`, "Continue at ", words));
  const listening = new AbortController();
  const end = () => {
    listening.abort();
    box.remove();
  };
  box.addEventListener("click", () => setTimeout(end));
  addEventListener("scroll", () => scrollY > SCROLLED * innerHeight && end(), { signal: listening.signal, passive: true });
  document.querySelector("main")?.before(box);
}

function remember(link: HTMLAnchorElement): void {
  const chapter = chapterOf(location);
  const others = storedPlaces().filter(([other]) => other !== chapter);
  storePlaces([[chapter, decodeURIComponent(link.hash.slice(1)), (link.textContent ?? "").trim()], ...others]);
}

/** Stores the headings that the contents mark, once the reader stays there. */
function follow(sections: HTMLElement): void {
  let timer: number | undefined;
  let current: HTMLAnchorElement | null = null;
  const note = () => {
    const link = sections.querySelector<HTMLAnchorElement>("[aria-current]");
    if (link === current) return;
    current = link;
    clearTimeout(timer);
    if (link) timer = window.setTimeout(() => remember(link), DWELL_MS);
  };
  new MutationObserver(note).observe(sections, { subtree: true, attributeFilter: ["aria-current"] });
  note();
}

export function start(): void {
  const places = storedPlaces();
  const line = document.querySelector<HTMLElement>(".continue");
  if (line) fill(line, places);
  const sections = document.querySelector<HTMLElement>(".chapter .sections");
  if (!sections) return;
  follow(sections);
  const [visit] = performance.getEntriesByType("navigation") as PerformanceNavigationTiming[];
  const here = places.find(([chapter]) => chapter === chapterOf(location));
  // After a reload or a step back, browsers restore the position themselves.
  if (here && !location.hash && visit?.type === "navigate") offer(here);
}
