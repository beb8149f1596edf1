// Runs before the first paint: the style sheet of the figures, and the reader's settings for the
// page.
import "../src/early.js";
import { PLACES_KEY } from "./places";
import { parseSettings, showSettings, storedSettings } from "./settings";

const { dataset } = document.documentElement;
const query = new URLSearchParams(location.search);
// In a frame of another page, only the chapter is shown, with that page's settings.
const isEmbedded = query.has("embed");
const given = isEmbedded ? parseSettings(JSON.stringify(Object.fromEntries(query))) : {};
dataset.listing = "numpy";
showSettings({ ...storedSettings(), ...given });
try {
  const listing = localStorage.getItem("epipole-listing");
  if (listing && /^(opencv|epipole|rust|js)$/.test(listing)) dataset.listing = listing;
  if (localStorage.getItem("epipole-contents") === "folded") dataset.contents = "folded";
  // Makes room for a line that the page fills in later.
  if (localStorage.getItem(PLACES_KEY)) dataset.places = "";
} catch {
  // Storage may be blocked; the page keeps its defaults.
}
if (isEmbedded) {
  dataset.embed = "";
  dataset.contents = "folded";
}
