// Cards for the terms of the text: hovering, focusing or tapping one shows its glossary entry. Without a script,
// offline without the glossary, and on a second tap, the link leads there.

/** Delay before a card appears or disappears, so that a passing pointer opens none, milliseconds. */
const DELAY_MS = 150;
/** Gap between word and card and around the card, CSS pixels. */
const GAP = 6;

/** Pages by address, so that the glossary is fetched once. */
const pages = new Map<string, Promise<Document>>();
let card: HTMLElement | undefined;
/** Link whose card is shown or about to be shown. */
let current: HTMLAnchorElement | undefined;
let timer = 0;
/** Whether focus returns to the word from its card, which then stays closed. */
let isReturning = false;

async function fetchPage(address: string): Promise<Document> {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`${response.status} for ${address}`);
  return new DOMParser().parseFromString(await response.text(), "text/html");
}

/** Returns name and text of the entry that a link leads to. */
async function entryOf(link: HTMLAnchorElement): Promise<[HTMLElement, HTMLElement]> {
  const [address = "", key = ""] = link.href.split("#");
  if (!pages.has(address)) pages.set(address, fetchPage(address));
  const page = await pages.get(address)!.catch((error: unknown) => {
    pages.delete(address);
    throw error;
  });
  const entry = page.getElementById(key);
  const copy = (from: string, to: string) => {
    const element = document.createElement(to);
    const nodes = entry?.querySelector(from)?.childNodes ?? [];
    element.append(...[...nodes].map((node) => document.importNode(node, true)));
    return element;
  };
  const text = copy("dd", "span");
  if (!text.hasChildNodes()) throw new Error(`no entry ${key} in ${address}`);
  // The links are relative to the page of the glossary.
  for (const inner of text.querySelectorAll("a")) inner.href = new URL(inner.getAttribute("href") ?? "", address).href;
  return [copy("dt", "strong"), text];
}

/** Places the card below the word, or above it if there is more room. */
function place(link: HTMLElement, shown: HTMLElement): void {
  const word = link.getBoundingClientRect();
  const { width, height } = shown.getBoundingClientRect();
  const page = document.documentElement;
  const left = Math.max(GAP, Math.min(word.left, page.clientWidth - width - GAP));
  const below = word.bottom + GAP;
  const fits = below + height + GAP <= innerHeight || word.top < height + 2 * GAP;
  shown.style.left = `${left + scrollX}px`;
  shown.style.top = `${(fits ? below : word.top - height - GAP) + scrollY}px`;
}

function hide(): void {
  clearTimeout(timer);
  current?.removeAttribute("aria-describedby");
  current = undefined;
  card?.remove();
  card = undefined;
}

async function show(link: HTMLAnchorElement): Promise<void> {
  if (current === link && card) return;
  hide();
  current = link;
  const [name, text] = await entryOf(link);
  if (current !== link) return;
  card = document.createElement("aside");
  card.id = "term-card";
  card.className = "term-card";
  card.popover = "manual";
  card.append(name, " ", text);
  // Directly after the word, so that the Tab key reaches the card's links next.
  link.after(card);
  card.showPopover();
  link.setAttribute("aria-describedby", card.id);
  place(link, card);
}

const termOf = ({ target }: Event) => (target instanceof Element ? target.closest<HTMLAnchorElement>("a.term") : null);

const isInside = (node: EventTarget | null) => node instanceof Node && (current?.contains(node) || card?.contains(node));

function later(act: () => void): void {
  clearTimeout(timer);
  timer = window.setTimeout(act, DELAY_MS);
}

const attempt = (link: HTMLAnchorElement) => void show(link).catch(() => current === link && hide());

export function startTerms(): void {
  document.addEventListener("pointerover", (event) => {
    if (event.pointerType !== "mouse") return;
    const link = termOf(event);
    if (link) later(() => attempt(link));
    else if (isInside(event.target)) clearTimeout(timer);
    else if (!isInside(document.activeElement)) later(hide);
  });
  document.addEventListener("focusin", (event) => {
    const link = termOf(event);
    if (isReturning) return;
    if (link?.matches(":focus-visible")) attempt(link);
    else if (!isInside(event.target)) hide();
  });
  document.addEventListener("click", (event) => {
    const link = termOf(event);
    if (!link) {
      if (!isInside(event.target)) hide();
      return;
    }
    // The first tap shows the card, a second follows the link, as does a mouse or a key.
    const isTap = event instanceof PointerEvent && event.pointerType === "touch";
    if (!isTap || (current === link && card)) return;
    event.preventDefault();
    void show(link).catch(() => location.assign(link.href));
  });
  document.addEventListener("keydown", ({ key }) => {
    if (key !== "Escape") return;
    const link = card?.contains(document.activeElement) ? current : undefined;
    hide();
    isReturning = true;
    link?.focus();
    isReturning = false;
  });
}
