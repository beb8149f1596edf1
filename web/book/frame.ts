// The page of one figure, for frames: what its address says becomes the figure's attributes, before the figure is
// there. So Reset returns to what the author of the frame has chosen.

import { isParameter } from "../src/attributes";

/** Attributes of the figure that are no parameters, and may stand in the address. */
const CHOICES = new Set(["compact", "controls", "readouts", "goals"]);

const figure = document.querySelector("epipole-figure");
for (const [key, value] of new URLSearchParams(location.search)) {
  if (key === "theme") document.documentElement.dataset.theme = value;
  else if (CHOICES.has(key) || (/^[a-z][\w-]*$/.test(key) && isParameter(key))) figure?.setAttribute(key, value);
}
