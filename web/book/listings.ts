// Listings with tabs and a copy button. The selected language is an attribute of the page: it is set before the first
// paint and applies to the whole book.

const CHOSEN = "epipole-listing";
const root = document.documentElement;

/** Returns the tab that a listing shows: the reader's language, else the first. */
function shown(tabs: HTMLElement[]): HTMLElement | undefined {
  return tabs.find((tab) => tab.dataset.tab === root.dataset.listing) ?? tabs[0];
}

const lists: HTMLElement[][] = [];

/** Updates the tabs for assistive technology. */
function update(): void {
  for (const tabs of lists) {
    const chosen = shown(tabs);
    for (const tab of tabs) {
      tab.setAttribute("aria-selected", String(tab === chosen));
      tab.tabIndex = tab === chosen ? 0 : -1;
    }
  }
}

/** Shows a language in all listings, without moving this one on the screen. */
function choose(tab: HTMLElement): void {
  const before = tab.getBoundingClientRect().top;
  root.dataset.listing = tab.dataset.tab ?? "";
  update();
  scrollBy({ top: tab.getBoundingClientRect().top - before, behavior: "instant" });
  try {
    localStorage.setItem(CHOSEN, root.dataset.listing);
  } catch {
    // Not stored: the choice applies to this visit only.
  }
}

/** Shows a language, as if the reader had chosen it in this listing. */
export function showTab(listing: HTMLElement, language: string): void {
  const tab = listing.querySelector<HTMLElement>(`[role=tab][data-tab=${language}]`);
  if (tab) choose(tab);
}

function startTabs(list: HTMLElement): void {
  const tabs = [...list.querySelectorAll<HTMLElement>("[role=tab]")];
  lists.push(tabs);
  for (const tab of tabs) {
    const part = document.getElementById(tab.getAttribute("aria-controls") ?? "");
    part?.setAttribute("role", "tabpanel");
    part?.setAttribute("aria-labelledby", tab.id);
  }
  list.addEventListener("click", ({ target }) => {
    const tab = (target as Element).closest<HTMLElement>("[role=tab]");
    if (tab) choose(tab);
  });
  list.addEventListener("keydown", (event) => {
    const at = tabs.indexOf(event.target as HTMLElement);
    const last = tabs.length - 1;
    const keys: Record<string, number> = { ArrowRight: at + 1, ArrowLeft: at - 1, Home: 0, End: last };
    const to = keys[event.key];
    const next = to === undefined ? undefined : tabs[(to + tabs.length) % tabs.length];
    if (!next || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    choose(next);
    next.focus({ preventScroll: true });
  });
}

/** Copies through the selection, for pages without access to the clipboard. */
function copySelected(code: Element): boolean {
  const selection = getSelection();
  selection?.selectAllChildren(code);
  const done = document.execCommand("copy");
  if (done) selection?.removeAllRanges();
  return done;
}

function startCopying(button: HTMLButtonElement): void {
  const parts = [...(button.closest(".listing")?.querySelectorAll<HTMLElement>(".listing-part") ?? [])];
  const status = document.createElement("span");
  status.className = "visually-hidden";
  status.setAttribute("role", "status");
  button.after(status);
  button.hidden = false;
  let timer = 0;
  button.addEventListener("click", async () => {
    const part = parts.find((part) => part.checkVisibility());
    const code = part?.querySelector("code");
    // For code that runs, the editor has replaced the code element.
    const text = part?.dataset.code ?? code?.textContent ?? "";
    const write = navigator.clipboard?.writeText(text);
    const done = await (write?.then(() => true, () => false) ?? false) || (code != null && copySelected(code));
    if (!done && code == null) return;
    // If copying failed, the code stays selected for the reader to copy with the keyboard.
    button.textContent = done ? "Copied" : "Selected";
    status.textContent = done ? "Code copied" : "Code selected";
    clearTimeout(timer);
    timer = window.setTimeout(() => {
      button.textContent = "Copy";
      status.textContent = "";
    }, 2000);
  });
}

export function startListings(): void {
  document.querySelectorAll<HTMLElement>(".listing-tabs").forEach(startTabs);
  document.querySelectorAll<HTMLButtonElement>(".listing .copy").forEach(startCopying);
  update();
}
