/** The look of the figures. */

import text from "epipole-look" with { type: "text" };

let shared: CSSStyleSheet | undefined;

/** The one style sheet that all figures of a page share. */
export function sheet(): CSSStyleSheet {
  if (!shared) {
    shared = new CSSStyleSheet();
    shared.replaceSync(text);
  }
  return shared;
}
