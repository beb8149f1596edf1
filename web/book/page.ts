// Script of every page: settings, contents, scrollable boxes; loads quizzes and search on demand.
import { followSections, revealCurrentChapter, startFolding } from "./contents";
import { startGoals } from "./goals";
import { startListings } from "./listings";
import { startOperating } from "./operate";
import { startPlaying } from "./play";
import { makeScrollersReachable } from "./scrollers";
import { startRunning } from "./run";
import { settleSections } from "./sections";
import { startSmall } from "./small";
import { startSymbols } from "./symbols";
import { startSettings } from "./theme";
import { startHandingOn } from "./to_lab";

startFolding();
settleSections();
revealCurrentChapter();
followSections();
makeScrollersReachable();
startOperating({ docks: true });
startPlaying();
startSmall();
startGoals();
startListings();
startSymbols();
startHandingOn();

/** Shows once that a script could not be loaded (such as after a new release), with a button to reload. */
function sayMissing(): void {
  if (document.querySelector(".page-notice")) return;
  const notice = document.createElement("p");
  notice.className = "page-notice";
  notice.setAttribute("role", "status");
  const again = document.createElement("button");
  again.type = "button";
  again.textContent = "Load the page anew";
  again.addEventListener("click", () => location.reload());
  notice.append("A part of this page could not be loaded. ", again);
  document.querySelector("main")?.prepend(notice);
  notice.scrollIntoView({ block: "nearest" });
}

startSettings(sayMissing);
startRunning(sayMissing);

/** Whether the page is in a frame of another page, which may store the reader's progress. */
const isEmbedded = "embed" in document.documentElement.dataset;
const kept = isEmbedded ? import("./embed").then((embed) => embed.start(), sayMissing) : Promise.resolve();

if (document.querySelector(".quiz, .small .solved")) {
  void kept.then(() => import("./quiz")).then((quiz) => quiz.start(), sayMissing);
}

if (document.querySelector(".progress")) {
  void import("./progress").then((progress) => progress.start(), sayMissing);
}

if (!isEmbedded && document.querySelector(".sections, .continue")) {
  void import("./continue").then((ways) => ways.start(), sayMissing);
}

if (document.querySelector("a.term")) {
  void import("./terms").then((terms) => terms.startTerms(), sayMissing);
}

const embedding = document.querySelector<HTMLElement>(".embedding");
if (embedding) void import("./embedding").then(({ start }) => start(embedding), sayMissing);

// Only the published book has a manifest; in a frame, the manifest is the other page's concern.
const manifest = document.querySelector<HTMLLinkElement>("link[rel=manifest]");
if (manifest && "serviceWorker" in navigator && window === top) {
  // After everything that this page displays.
  const begin = () => void import("./offline").then((offline) => offline.start(manifest.href), () => undefined);
  const idle = () => ("requestIdleCallback" in window ? requestIdleCallback(begin) : setTimeout(begin, 1000));
  if (document.readyState === "complete") idle();
  else addEventListener("load", idle, { once: true });
}

const button = document.querySelector<HTMLButtonElement>(".search-button");
if (button) {
  button.hidden = false;
  const open = () =>
    void import("./search").then(
      (search) => search.open(button.dataset.index ?? "", button.dataset.root ?? ""),
      sayMissing,
    );
  button.addEventListener("click", open);
  document.addEventListener("keydown", (event) => {
    if ((event.ctrlKey || event.metaKey) && !event.shiftKey && !event.altKey && event.key.toLowerCase() === "k") {
      event.preventDefault();
      open();
    }
  });
}
