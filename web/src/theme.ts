/** Which colors a figure takes: those of its reader, then of its page. */

export type Theme = "light" | "dark" | "high-contrast";

const queries = ["(prefers-color-scheme: dark)", "(prefers-contrast: more)", "(forced-colors: active)"];

/**
 * The theme for a figure: its `theme` attribute; else high contrast where the reader asks for it;
 * else what `data-theme` around it says, else its `color-scheme`, else how dark the page behind it is.
 */
function themeOf(element: HTMLElement): Theme {
  const wish = element.getAttribute("theme");
  if (wish === "light" || wish === "dark" || wish === "high-contrast") return wish;
  if (queries.slice(1).some((query) => matchMedia(query).matches)) return "high-contrast";

  for (const at of outwards(element)) {
    const named = at.dataset["theme"];
    if (named === "light" || named === "dark" || named === "high-contrast") return named;
  }

  const schemes = getComputedStyle(element).colorScheme.split(" ");
  const [light, dark] = [schemes.includes("light"), schemes.includes("dark")];
  if (light && dark) return matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  if (light || dark) return dark ? "dark" : "light";
  return behindIsDark(element) ? "dark" : "light";
}

const asking = new Map<HTMLElement, (theme: Theme) => void>();

/**
 * Tells the theme of an element before anything is painted. Those of all who ask together are found
 * before any is told: finding it needs a layout of the page, and taking it makes that layout stale.
 */
export function askTheme(element: HTMLElement, tell: (theme: Theme) => void): void {
  if (asking.size === 0) {
    queueMicrotask(() => {
      const told = [...asking].map(([asker, answer]) => [answer, themeOf(asker)] as const);
      asking.clear();
      for (const [answer, theme] of told) answer(theme);
    });
  }
  asking.set(element, tell);
}

/** An element and what is around it, out of every shadow tree that it is in. */
function* outwards(element: HTMLElement): Generator<HTMLElement> {
  for (let at: Node | null = element; at; at = outside(at)) if (at instanceof HTMLElement) yield at;
}

function outside(node: Node): Node | null {
  if (node instanceof ShadowRoot) return node.host;
  return (node instanceof Element && node.assignedSlot) || node.parentNode;
}

/** Whether the first opaque background around an element is a dark one; a bare page is white. */
function behindIsDark(element: HTMLElement): boolean {
  for (const at of outwards(element)) {
    if (at === element) continue;
    const [red = 0, green = 0, blue = 0, alpha = 1] =
      getComputedStyle(at).backgroundColor.match(/[\d.]+/g)?.map(Number) ?? [];
    if (alpha > 0.5) return 0.2126 * red + 0.7152 * green + 0.0722 * blue < 110;
  }
  return false;
}

/** A page that changes its colors may take so long to blend from one to the other, milliseconds; longer ones tell. */
const BLEND_MS = 400;

/** Who is to be told, of all figures of the page. */
const watching = new Set<() => void>();

/** What looks at the page for all of them, while there is one. */
const page = {
  observer: undefined as MutationObserver | undefined,
  lists: [] as MediaQueryList[],
  blended: undefined as ReturnType<typeof setTimeout> | undefined,

  /** Which attribute a page switches its colors by is its own affair, and so is which style sheet. */
  watch(): void {
    this.observer = new MutationObserver(changed);
    const attributes = { attributes: true };
    this.observer.observe(document.documentElement, attributes);
    if (document.body) this.observer.observe(document.body, attributes);
    this.observer.observe(document.head, { attributes: true, childList: true, subtree: true });
    // A style sheet that has been put there counts once it has come.
    document.head.addEventListener("load", changed, true);
    document.addEventListener("transitionend", blended);
    this.lists = queries.map((query) => matchMedia(query));
    for (const list of this.lists) list.addEventListener("change", changed);
  },

  stop(): void {
    this.observer?.disconnect();
    document.head.removeEventListener("load", changed, true);
    document.removeEventListener("transitionend", blended);
    for (const list of this.lists) list.removeEventListener("change", changed);
    clearTimeout(this.blended);
  },
};

function changed(): void {
  for (const tell of watching) tell();
  clearTimeout(page.blended);
  page.blended = setTimeout(() => {
    for (const tell of watching) tell();
  }, BLEND_MS);
}

/** The background of something with a figure in it has its new color at last. */
function blended({ propertyName, target }: TransitionEvent): void {
  if (propertyName !== "background-color" || !(target instanceof Element)) return;
  if (target.querySelector("epipole-figure") || target.contains(document.body)) changed();
}

/** Calls back whenever the answer of `themeOf` may have changed. Returns how to stop. */
export function watchTheme(tell: () => void): () => void {
  if (watching.size === 0) page.watch();
  watching.add(tell);
  return () => {
    watching.delete(tell);
    if (watching.size === 0) page.stop();
  };
}

/** Calls back whenever a pixel of the page has another number of device pixels. */
export function watchDensity(changed: () => void): () => void {
  let list: MediaQueryList;
  // A query knows one density; at another, another one is due.
  const again = () => {
    list.removeEventListener("change", again);
    watch();
    changed();
  };
  const watch = () => {
    list = matchMedia(`(resolution: ${devicePixelRatio}dppx)`);
    list.addEventListener("change", again);
  };
  watch();
  return () => list.removeEventListener("change", again);
}

/** Whether the reader wants things to stand still. */
export function wantsStillness(): boolean {
  return matchMedia("(prefers-reduced-motion: reduce)").matches;
}
