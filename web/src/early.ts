/**
 * For the head of a page that brings the trees of its figures along, as a script that the page waits
 * for: gives them their look before anything is painted. Their own `<link>` may come too late for
 * that, and would then move what is below them; it serves readers without script.
 */

import { sheet } from "./sheet.js";

function dress(): void {
  for (const { shadowRoot } of document.querySelectorAll("epipole-figure")) {
    if (shadowRoot?.adoptedStyleSheets.length === 0) shadowRoot.adoptedStyleSheets = [sheet()];
  }
}

// Its callback runs before the page is painted with what has just come.
const coming = new MutationObserver(dress);
coming.observe(document.documentElement, { childList: true, subtree: true });
document.addEventListener("DOMContentLoaded", () => {
  dress();
  coming.disconnect();
});
