// What every page does: colors, contents, scrolling boxes; quizzes and search when they are wanted.
import { followSections, revealCurrentChapter, startFolding } from "./contents";
import { startListings } from "./listings";
import { startOperating } from "./operate";
import { makeScrollersReachable } from "./scrollers";
import { settleSections } from "./sections";
import { startSymbols } from "./symbols";
import { startTheme } from "./theme";

startTheme();
startFolding();
settleSections();
revealCurrentChapter();
followSections();
makeScrollersReachable();
startOperating();
startListings();
startSymbols();

if (document.querySelector(".quiz, .progress, .small .solved")) {
  void import("./quiz").then((quiz) => quiz.start());
}

if (document.querySelector(".gallery")) {
  void import("./gallery").then((gallery) => gallery.start());
}

const button = document.querySelector<HTMLButtonElement>(".search-button");
if (button) {
  button.hidden = false;
  const open = () =>
    void import("./search").then((search) => search.open(button.dataset.index ?? "", button.dataset.root ?? ""));
  button.addEventListener("click", open);
  document.addEventListener("keydown", (event) => {
    if ((event.ctrlKey || event.metaKey) && !event.shiftKey && !event.altKey && event.key.toLowerCase() === "k") {
      event.preventDefault();
      open();
    }
  });
}
