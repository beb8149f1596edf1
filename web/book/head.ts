// Runs before the first paint: the style sheet of the figures, and the reader's settings for the
// page.
import "../src/early.js";

document.documentElement.dataset.listing = "numpy";
try {
  const listing = localStorage.getItem("epipole-listing");
  if (listing && /^(opencv|epipole|rust|js)$/.test(listing)) document.documentElement.dataset.listing = listing;
  const chosen = localStorage.getItem("epipole-theme");
  if (chosen === "light" || chosen === "dark") document.documentElement.dataset.theme = chosen;
  if (localStorage.getItem("epipole-contents") === "folded") document.documentElement.dataset.contents = "folded";
} catch {
  // Storage may be blocked; the page keeps its defaults.
}
