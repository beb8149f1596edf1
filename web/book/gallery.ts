// Gallery page: code snippets for other sites, which follow the state of each figure.

import { HOSTS, type Wish } from "./snippets";

interface Living extends HTMLElement {
  state: Record<string, string>;
}

/** Storage key of the chosen kind of host page, shared by all figures. */
const CHOSEN = "epipole-host";
const lists: HTMLSelectElement[] = [];
const updates: (() => void)[] = [];
/** Margin for writing snippets ahead of time; each one measures its figure, and there are many. */
const SOON = "50%";

function remembered(): string {
  try {
    return localStorage.getItem(CHOSEN) ?? "";
  } catch {
    return "";
  }
}

function startSection(section: HTMLElement): void {
  const figure = section.querySelector<Living>("epipole-figure");
  const code = section.querySelector(".snippet code");
  const page = section.querySelector<HTMLAnchorElement>(".own-page");
  if (!figure || !code || !page) return;
  const frame = new URL(page.href);
  const list = document.createElement("select");
  list.ariaLabel = "Kind of page";
  list.append(...HOSTS.map(({ name }) => new Option(name, name)));
  const chosen = HOSTS.find(({ name }) => name === remembered());
  if (chosen) list.value = chosen.name;
  lists.push(list);
  section.querySelector(".snippet .listing-title")?.after(list);

  const update = () => {
    const wish: Wish = {
      name: section.dataset.name ?? "",
      title: section.querySelector("h2")?.textContent ?? "",
      // Before the figure script has loaded there is no state.
      state: figure.state ?? {},
      book: new URL(".", new URL("..", frame)).href,
      height: Math.ceil(figure.getBoundingClientRect().height),
    };
    code.textContent = HOSTS.find(({ name }) => name === list.value)?.write(wish) ?? "";
    page.search = new URLSearchParams(wish.state).toString();
  };
  const seen = new IntersectionObserver(
    ([entry]) => {
      if (!entry?.isIntersecting) return;
      seen.disconnect();
      updates.push(update);
      update();
    },
    { rootMargin: SOON },
  );
  figure.addEventListener("epipole-ready", update);
  figure.addEventListener("epipole-change", update);
  list.addEventListener("change", () => {
    for (const other of lists) other.value = list.value;
    for (const follow of updates) follow();
    try {
      localStorage.setItem(CHOSEN, list.value);
    } catch {
      // Not stored; the choice holds for this visit.
    }
  });
  seen.observe(section);
}

export function start(): void {
  document.querySelectorAll<HTMLElement>(".gallery").forEach(startSection);
}
