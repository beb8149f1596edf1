// Script of every page: theme, contents, scrolling boxes; loads quizzes and search on demand.
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
import { startTheme } from "./theme";
import { startHandingOn } from "./to_lab";

startTheme();
startFolding();
settleSections();
revealCurrentChapter();
followSections();
makeScrollersReachable();
startOperating();
startPlaying();
startSmall();
startGoals();
startListings();
startSymbols();
startHandingOn();

/** Shows once that a script could not be loaded (as after a new release), with a way to reload. */
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

startRunning(sayMissing);

if (document.querySelector(".quiz, .progress, .small .solved")) {
  void import("./quiz").then((quiz) => quiz.start(), sayMissing);
}

if (document.querySelector("a.term")) {
  void import("./terms").then((terms) => terms.startTerms(), sayMissing);
}

if (document.querySelector(".gallery")) {
  void import("./gallery").then((gallery) => gallery.start(), sayMissing);
}

// Only the published book has a manifest. In frames, it belongs to another page.
const manifest = document.querySelector<HTMLLinkElement>("link[rel=manifest]");
if (manifest && "serviceWorker" in navigator && window === top) {
  // After everything that this page shows.
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
