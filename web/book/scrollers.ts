// Listings, tables and formulas that are wider than the screen scroll in their own boxes. A box
// that scrolls must be reachable by keyboard; one that does not must not be in the way.

const NAMES: [string, (box: HTMLElement) => string][] = [
  ["pre", (box) => `${box.dataset.language ?? "Listing"}, scrolls sideways`],
  [".table", () => "Table, scrolls sideways"],
  [".formula", () => "Formula, scrolls sideways"],
];

export function makeScrollersReachable(): void {
  const boxes = new Map<Element, string>();
  const update = (box: Element) => {
    const element = box as HTMLElement;
    if (element.scrollWidth > element.clientWidth + 1) {
      element.tabIndex = 0;
      element.setAttribute("role", "group");
      element.setAttribute("aria-label", boxes.get(box) ?? "");
    } else {
      element.removeAttribute("tabindex");
      element.removeAttribute("role");
      element.removeAttribute("aria-label");
    }
  };
  const observer = new ResizeObserver((entries) => entries.forEach((entry) => update(entry.target)));
  for (const [selector, name] of NAMES) {
    for (const box of document.querySelectorAll<HTMLElement>(`article ${selector}`)) {
      boxes.set(box, name(box));
      observer.observe(box);
    }
  }
}
