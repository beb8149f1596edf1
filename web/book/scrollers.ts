// Listings, tables and formulas wider than the screen scroll in their own boxes. A box is a Tab stop only while it can
// scroll.

const NAMES: [string, (box: HTMLElement) => string][] = [
  ["pre", (box) => `${box.dataset.language ?? "Listing"}, scrolls sideways`],
  [".table", () => "Table, scrolls sideways"],
  [".formula", () => "Formula, scrolls sideways"],
];

export function makeScrollersReachable(): void {
  const boxes = new Map<Element, string>();
  const update = (box: Element, scrolls: boolean) => {
    if (scrolls) {
      box.setAttribute("tabindex", "0");
      box.setAttribute("role", "group");
      box.setAttribute("aria-label", boxes.get(box) ?? "");
    } else {
      box.removeAttribute("tabindex");
      box.removeAttribute("role");
      box.removeAttribute("aria-label");
    }
  };
  const observer = new ResizeObserver((entries) => {
    // Measures all before changing any, so that the page is laid out once.
    const measured = entries.map(({ target }) => [target, target.scrollWidth > target.clientWidth + 1] as const);
    for (const [box, scrolls] of measured) {
      if (scrolls !== box.hasAttribute("tabindex")) update(box, scrolls);
    }
  });
  for (const [selector, name] of NAMES) {
    for (const box of document.querySelectorAll<HTMLElement>(`article ${selector}`)) {
      boxes.set(box, name(box));
      observer.observe(box);
    }
  }
}
