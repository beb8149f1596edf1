/**
 * Blocking script for the head of a page with prerendered figures: applies their style sheet before the first paint.
 * Their own `<link>` may load too late and shift the content below; it is for readers without JavaScript.
 */

import { sheet } from "./sheet.js";

function dress(): void {
  for (const { shadowRoot } of document.querySelectorAll("epipole-figure")) {
    if (shadowRoot?.adoptedStyleSheets.length === 0) shadowRoot.adoptedStyleSheets = [sheet()];
  }
}

// The observer's callback runs before the new elements are painted.
const coming = new MutationObserver(dress);
coming.observe(document.documentElement, { childList: true, subtree: true });
document.addEventListener("DOMContentLoaded", () => {
  dress();
  coming.disconnect();
});
