// Runs before anything is drawn: the look of figures, and what the reader chose of the page, if it
// differs from the usual.
import "../src/early.js";

document.documentElement.dataset.listing = "numpy";
try {
  const listing = localStorage.getItem("epipole-listing");
  if (listing === "opencv" || listing === "rust") document.documentElement.dataset.listing = listing;
  const chosen = localStorage.getItem("epipole-theme");
  if (chosen === "light" || chosen === "dark") document.documentElement.dataset.theme = chosen;
  if (localStorage.getItem("epipole-contents") === "folded") document.documentElement.dataset.contents = "folded";
} catch {
  // Storage may be forbidden; then the page is as it comes.
}
