// A figure's own page: a code snippet for other sites, which follows the figure's state and the selection of its parts.

import { HOSTS } from "./snippets";
import { type Choice, startStudio } from "./studio";

interface Living extends HTMLElement {
  state: Record<string, string>;
}

/** Storage key of the selected kind of host page. */
const CHOSEN = "epipole-host";

function remembered(): string {
  try {
    return localStorage.getItem(CHOSEN) ?? "";
  } catch {
    return "";
  }
}

function remember(name: string): void {
  try {
    localStorage.setItem(CHOSEN, name);
  } catch {
    // Not stored: the choice applies to this visit only.
  }
}

/** Starts the snippet and the tables of the figure's page. */
export function start(section: HTMLElement): void {
  const figure = document.querySelector<Living>("epipole-figure");
  const code = section.querySelector(".snippet code");
  const page = document.querySelector<HTMLAnchorElement>(".frame-page");
  if (!figure || !code || !page) return;
  const frame = new URL(page.href);
  const list = document.createElement("select");
  list.ariaLabel = "Kind of page";
  list.append(...HOSTS.map(({ name }) => new Option(name, name)));
  const chosen = HOSTS.find(({ name }) => name === remembered());
  if (chosen) list.value = chosen.name;
  section.querySelector(".snippet .listing-title")?.after(list);

  let choice: Choice = {};
  const update = () => {
    // Before the figure script has loaded there is no state.
    const state = figure.state ?? {};
    const embedded = {
      name: section.dataset.name ?? "",
      title: document.querySelector("h1")?.textContent ?? "",
      state,
      choice,
      book: new URL(".", new URL("..", frame)).href,
      height: Math.ceil(figure.getBoundingClientRect().height),
    };
    code.textContent = HOSTS.find(({ name }) => name === list.value)?.write(embedded) ?? "";
    page.search = new URLSearchParams({ ...state, ...choice }).toString();
  };
  startStudio(section, figure, (chosen) => {
    choice = chosen;
    update();
  });
  figure.addEventListener("epipole-ready", update);
  figure.addEventListener("epipole-change", update);
  list.addEventListener("change", () => {
    remember(list.value);
    update();
  });
  update();
}
