// Table of contents: marks the reader's place.

/** Runs `work` after the first layout, when measuring positions is cheap. */
function afterFirstFrame(work: () => void): void {
  requestAnimationFrame(() => setTimeout(work));
}

/** Scrolls the contents, not the page, to the current chapter. */
export function revealCurrentChapter(): void {
  const contents = document.getElementById("contents");
  const current = contents?.querySelector<HTMLElement>(".current");
  if (!contents || !current) return;
  const show = () => {
    const below = current.offsetTop + current.offsetHeight - contents.clientHeight;
    if (below > 0) contents.scrollTop = Math.min(current.offsetTop - 80, below + 80);
  };
  afterFirstFrame(show);
  contents.addEventListener("toggle", show);
  // A link to a section of this page closes the sheet.
  contents.addEventListener("click", (event) => {
    if (event.target instanceof Element && event.target.closest("a[href^='#']")) closeSheet(contents);
  });
}

function closeSheet(contents: HTMLElement): void {
  if (contents.matches(":popover-open")) contents.hidePopover();
}

/** Marks the section that is being read. */
export function followSections(): void {
  const links = new Map<string, HTMLAnchorElement>();
  for (const link of document.querySelectorAll<HTMLAnchorElement>(".sections a")) {
    links.set(decodeURIComponent(link.hash.slice(1)), link);
  }
  // Observes the sections rather than their headings, since measuring a heading would lay out its whole section.
  const sections = new Map<HTMLElement, string>();
  for (const { id, parentElement: section } of document.querySelectorAll("article h2[id]")) {
    if (section && links.has(id)) sections.set(section, id);
  }
  if (sections.size === 0) return;
  let scheduled = false;
  const update = () => {
    scheduled = false;
    const line = innerHeight / 3;
    const passed = [...sections].filter(([section]) => section.getBoundingClientRect().top < line);
    const current = passed.at(-1)?.[1];
    for (const [id, link] of links) {
      if (id === current) link.setAttribute("aria-current", "location");
      else link.removeAttribute("aria-current");
    }
  };
  const schedule = () => {
    if (scheduled) return;
    scheduled = true;
    requestAnimationFrame(update);
  };
  addEventListener("scroll", schedule, { passive: true });
  addEventListener("resize", schedule, { passive: true });
  afterFirstFrame(update);
}

const FOLDED = "epipole-contents";

/** Lets the reader fold the contents column on a wide screen, and stores the choice. */
export function startFolding(): void {
  const button = document.querySelector<HTMLButtonElement>(".fold-button");
  if (!button) return;
  const root = document.documentElement;
  const show = () => button.setAttribute("aria-expanded", String(root.dataset.contents !== "folded"));
  show();
  button.addEventListener("click", () => {
    const folds = root.dataset.contents !== "folded";
    if (folds) root.dataset.contents = "folded";
    else delete root.dataset.contents;
    try {
      if (folds) localStorage.setItem(FOLDED, "folded");
      else localStorage.removeItem(FOLDED);
    } catch {
      // Not stored: the column is folded for this visit only.
    }
    show();
  });
}
