// Full-text search over all sections. The index is fetched with the first query.

interface Section {
  /** Path and anchor. */
  u: string;
  /** Chapter. */
  c: string;
  /** Section. */
  t: string;
  /** Text. */
  w: string;
}

interface Hit {
  section: Section;
  score: number;
}

const MAX_HITS = 20;
/** Time after which the dialog reports that the index is slow, milliseconds. */
const SLOW_MS = 15_000;
let sections: Promise<Section[]> | undefined;
let asking = new AbortController();
let dialog: HTMLDialogElement | undefined;

/** Abbreviations of the field, with words of the sections that explain them. */
const ABBREVIATIONS: ReadonlyMap<string, string> = new Map([
  ["ba", "bundle adjustment"],
  ["dlt", "direct linear"],
  ["lk", "lucas kanade"],
  ["lm", "levenberg marquardt"],
  ["lmeds", "least median"],
  ["ncc", "normalized cross-correlation"],
  ["pnp", "absolute pose"],
  ["sfm", "structure from motion"],
  ["sgm", "semi-global matching"],
  ["ssd", "squared differences"],
  ["svd", "singular value"],
  ["vo", "visual odometry"],
]);

const fold = (text: string) => text.normalize("NFD").replace(/\p{M}/gu, "").toLowerCase();

/** Returns the sections that contain every word (at least as a prefix) or what it abbreviates, best first. */
export function find(all: Section[], query: string): Hit[] {
  const words = wordsOf(query);
  const best = new Map<Section, number>();
  for (const wanted of [words, words.flatMap(spelledOut)]) {
    for (const { section, score } of containing(all, wanted)) {
      best.set(section, Math.max(score, best.get(section) ?? 0));
    }
  }
  const hits = [...best].map(([section, score]) => ({ section, score }));
  return hits.sort((a, b) => b.score - a.score).slice(0, MAX_HITS);
}

const wordsOf = (text: string) => fold(text).split(/[^\p{L}\p{N}]+/u).filter(Boolean);

const spelledOut = (word: string) => wordsOf(ABBREVIATIONS.get(word) ?? word);

/** Returns the sections that contain every word; none without words. */
function containing(all: Section[], words: string[]): Hit[] {
  const hits: Hit[] = [];
  for (const section of all) {
    const title = ` ${fold(section.t)}`;
    const chapter = ` ${fold(section.c)}`;
    const text = ` ${fold(section.w)}`;
    let score = 0;
    for (const word of words) {
      const count = ABBREVIATIONS.has(word) ? wholeIn : startsIn;
      const [inTitle, inChapter, inText] = [count(title, word), count(chapter, word), count(text, word)];
      if (!inTitle && !inChapter && !inText) {
        score = 0;
        break;
      }
      score += 8 * inTitle + 3 * inChapter + Math.min(inText, 5);
    }
    // The manual of the Python package has a section for every name.
    if (section.u.startsWith("python/")) score /= 2;
    // An abbreviation counts as much as the words that it abbreviates.
    if (score > 0) hits.push({ section, score: score / words.length });
  }
  return hits;
}

/** Counts the occurrences of the word in the text. */
function wholeIn(text: string, word: string): number {
  return wordsOf(text).filter((other) => other === word).length;
}

/** Counts the words of the text that start with `word`. */
function startsIn(text: string, word: string): number {
  let count = 0;
  for (let at = text.indexOf(word); at >= 0; at = text.indexOf(word, at + 1)) {
    if (!/[\p{L}\p{N}]/u.test(text[at - 1] ?? " ")) count += 1;
  }
  return count;
}

/** Returns about 140 characters around the first match, with the matches marked. */
function excerpt(text: string, query: string): HTMLElement {
  const folded = fold(text);
  const words = wordsOf(query).flatMap((word) => (folded.includes(word) ? word : spelledOut(word)));
  const places = words.map((word) => folded.indexOf(word)).filter((place) => place >= 0);
  const first = places.length > 0 ? Math.min(...places) : 0;
  const from = first > 60 ? text.indexOf(" ", first - 60) + 1 : 0;
  const shown = text.slice(from, from + 140);
  const span = document.createElement("span");
  span.className = "excerpt";
  if (from > 0) span.append("… ");
  let rest = shown;
  while (rest) {
    const at = words.map((word) => [fold(rest).indexOf(word), word.length] as const).filter(([place]) => place >= 0);
    const [place, length] = at.sort((a, b) => a[0] - b[0])[0] ?? [rest.length, 0];
    span.append(rest.slice(0, place));
    if (length === 0) break;
    const mark = document.createElement("mark");
    mark.textContent = rest.slice(place, place + length);
    span.append(mark);
    rest = rest.slice(place + length);
  }
  if (from + 140 < text.length) span.append(" …");
  return span;
}

/** Requests the index, replacing a pending request. */
function fetchIndex(index: string): void {
  asking.abort();
  asking = new AbortController();
  const asked = fetch(index, { signal: asking.signal }).then(async (response) => {
    const all: unknown = response.ok ? await response.json() : undefined;
    if (!Array.isArray(all)) throw new Error(`${response.status} for ${index}`);
    return all as Section[];
  });
  // After a failure, the next search requests it again.
  asked.catch(() => sections === asked && (sections = undefined));
  sections = asked;
}

function makeDialog(index: string, root: string): HTMLDialogElement {
  const made = document.createElement("dialog");
  made.className = "search-dialog";
  made.setAttribute("aria-label", "Search the book");
  const field = document.createElement("div");
  field.className = "search-field";
  const input = document.createElement("input");
  input.type = "search";
  input.setAttribute("aria-label", "Search for");
  input.placeholder = "Search the book";
  input.autocomplete = "off";
  const close = document.createElement("button");
  close.type = "button";
  close.className = "icon-button";
  close.setAttribute("aria-label", "Close the search");
  close.textContent = "✕";
  field.append(input, close);
  const status = document.createElement("p");
  status.className = "search-status";
  status.setAttribute("role", "status");
  const list = document.createElement("ol");
  list.className = "search-results";
  made.append(field, status, list);
  document.body.append(made);

  close.addEventListener("click", () => made.close());
  made.addEventListener("click", (event) => {
    const target = event.target;
    if (target === made || (target instanceof Element && target.closest("a"))) made.close();
  });
  const offer = (sentence: string) => {
    const again = document.createElement("button");
    again.type = "button";
    again.textContent = "Try again";
    again.addEventListener("click", () => {
      fetchIndex(index);
      input.focus();
      void update();
    });
    status.replaceChildren(`${sentence} `, again);
    list.replaceChildren();
  };
  const update = async () => {
    const query = input.value;
    if (!sections) fetchIndex(index);
    const waited = sections;
    const late = setTimeout(() => offer("The index of the book is slow to come."), SLOW_MS);
    let hits: Hit[] = [];
    try {
      hits = find((await waited) ?? [], query);
    } catch {
      // A failure is not reported if a newer request has replaced this one.
      if (!sections || sections === waited) offer("The index of the book could not be loaded.");
      return;
    } finally {
      clearTimeout(late);
    }
    if (query !== input.value) return;
    const found = hits.length === 0 ? "Nothing found." : `${hits.length} section${hits.length === 1 ? "" : "s"}`;
    status.textContent = query.trim() === "" ? "" : found;
    list.replaceChildren(
      ...hits.map(({ section }) => {
        const item = document.createElement("li");
        const link = document.createElement("a");
        link.href = root + section.u;
        const where = document.createElement("span");
        where.className = "where";
        where.append(section.t);
        if (section.t !== section.c) {
          const chapter = document.createElement("small");
          chapter.textContent = ` · ${section.c}`;
          where.append(chapter);
        }
        link.append(where, excerpt(section.w, query));
        item.append(link);
        return item;
      }),
    );
  };
  input.addEventListener("input", () => void update());
  input.addEventListener("keydown", (event) => {
    if (event.key === "Enter") list.querySelector<HTMLAnchorElement>("a")?.click();
    if (event.key === "ArrowDown") {
      event.preventDefault();
      list.querySelector<HTMLAnchorElement>("a")?.focus();
    }
  });
  list.addEventListener("keydown", (event) => {
    if (event.key !== "ArrowDown" && event.key !== "ArrowUp") return;
    event.preventDefault();
    const links = [...list.querySelectorAll("a")];
    const next = links.indexOf(document.activeElement as HTMLAnchorElement) + (event.key === "ArrowDown" ? 1 : -1);
    (next < 0 ? input : links[Math.min(next, links.length - 1)])?.focus();
  });
  return made;
}

export function open(index: string, root: string): void {
  if (!sections) fetchIndex(index);
  dialog ??= makeDialog(index, root);
  if (!dialog.open) dialog.showModal();
  dialog.querySelector("input")?.select();
}
