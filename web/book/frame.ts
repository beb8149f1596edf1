// Page of a single figure, for iframes. The query parameters become attributes before the figure
// starts, so Reset returns to the state that the embedding author chose.

import { isParameter } from "../src/attributes";

/** Attributes other than parameters that the address may set. */
const CHOICES = new Set(["compact", "controls", "readouts", "goals"]);

const figure = document.querySelector("epipole-figure");
for (const [key, value] of new URLSearchParams(location.search)) {
  if (key === "theme") document.documentElement.dataset.theme = value;
  else if (CHOICES.has(key) || (/^[a-z][\w-]*$/.test(key) && isParameter(key))) figure?.setAttribute(key, value);
}
