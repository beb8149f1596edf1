/** Style sheet of the figures. */

import text from "epipole-look" with { type: "text" };

let shared: CSSStyleSheet | undefined;

/** Returns the style sheet, shared by all figures of a page. */
export function sheet(): CSSStyleSheet {
  if (!shared) {
    shared = new CSSStyleSheet();
    shared.replaceSync(text);
  }
  return shared;
}
