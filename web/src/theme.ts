/** Color theme of a figure: the reader's settings first, then the page's. */

export type Theme = "light" | "dark" | "high-contrast";

const queries = ["(prefers-color-scheme: dark)", "(prefers-contrast: more)", "(forced-colors: active)"];

/** Whether the reader wants more contrast, by a setting of the page or of the system. */
export function wantsContrast(): boolean {
  const ofPage = document.documentElement.dataset["contrast"] === "more";
  return ofPage || queries.slice(1).some((query) => matchMedia(query).matches);
}

/** Whether the reader wants reduced motion, by a setting of the page or of the system. */
export function wantsStillness(): boolean {
  const ofPage = document.documentElement.dataset["motion"] === "reduced";
  return ofPage || matchMedia("(prefers-reduced-motion: reduce)").matches;
}

/**
 * Returns the theme for a figure: its `theme` attribute; else high contrast if the reader wants it; else the nearest
 * `data-theme`, else its `color-scheme`, else light or dark by the background behind it.
 */
function themeOf(element: HTMLElement): Theme {
  const wish = element.getAttribute("theme");
  if (wish === "light" || wish === "dark" || wish === "high-contrast") return wish;
  if (wantsContrast()) return "high-contrast";

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
 * Passes an element's theme to `tell` before the next paint. Requests are batched, reading all
 * themes before applying any: reading needs the page's layout, and applying invalidates it.
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

/** Iterates over an element and its ancestors, through shadow roots and slots. */
function* outwards(element: HTMLElement): Generator<HTMLElement> {
  for (let at: Node | null = element; at; at = outside(at)) if (at instanceof HTMLElement) yield at;
}

function outside(node: Node): Node | null {
  if (node instanceof ShadowRoot) return node.host;
  return (node instanceof Element && node.assignedSlot) || node.parentNode;
}

/** Whether the nearest opaque background behind an element is dark; a page without one is white. */
function behindIsDark(element: HTMLElement): boolean {
  for (const at of outwards(element)) {
    if (at === element) continue;
    const [red = 0, green = 0, blue = 0, alpha = 1] =
      getComputedStyle(at).backgroundColor.match(/[\d.]+/g)?.map(Number) ?? [];
    if (alpha > 0.5) return 0.2126 * red + 0.7152 * green + 0.0722 * blue < 110;
  }
  return false;
}

/**
 * Delay after which themes are read again, once a short color transition of the page has ended, milliseconds; longer
 * ones are noticed by `transitionend`.
 */
const BLEND_MS = 400;

/** Callbacks of all figures of the page. */
const watching = new Set<() => void>();

/** Observers shared by all figures, active while there is a callback. */
const page = {
  observer: undefined as MutationObserver | undefined,
  lists: [] as MediaQueryList[],
  blended: undefined as ReturnType<typeof setTimeout> | undefined,

  /** Observes all attributes and style sheets, since pages switch themes in different ways. */
  watch(): void {
    this.observer = new MutationObserver(changed);
    const attributes = { attributes: true };
    this.observer.observe(document.documentElement, attributes);
    if (document.body) this.observer.observe(document.body, attributes);
    this.observer.observe(document.head, { attributes: true, childList: true, subtree: true });
    // A new style sheet takes effect when it has loaded.
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

/** Reads the themes again when the background behind a figure has finished a transition. */
function blended({ propertyName, target }: TransitionEvent): void {
  if (propertyName !== "background-color" || !(target instanceof Element)) return;
  if (target.querySelector("epipole-figure") || target.contains(document.body)) changed();
}

/** Calls back whenever `themeOf` may have changed. Returns a function that stops it. */
export function watchTheme(tell: () => void): () => void {
  if (watching.size === 0) page.watch();
  watching.add(tell);
  return () => {
    watching.delete(tell);
    if (watching.size === 0) page.stop();
  };
}

/** Calls back whenever `devicePixelRatio` changes. */
export function watchDensity(changed: () => void): () => void {
  let list: MediaQueryList;
  // A media query matches one density, so each change needs a new query.
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
