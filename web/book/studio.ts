// Selection of the parts that an embedded figure shows: the tables of a figure's page get a check box for each control
// and number, and a list for goals. The figure is updated immediately.

/** Attributes of the element by name; those with their default value are absent. */
export type Choice = Record<string, string>;

const GOALS: [string, string][] = [["one", "one goal"], ["all", "all goals"], ["none", "no goals"]];

/** Check boxes of the rows that an attribute selects from, by attribute. */
type Boxes = Map<string, HTMLInputElement[]>;

function addBox(row: HTMLTableRowElement, boxes: Boxes): void {
  const attribute = row.dataset.shownBy ?? "";
  const name = row.cells[0]?.textContent ?? "";
  const box = document.createElement("input");
  Object.assign(box, { type: "checkbox", checked: true, value: name, ariaLabel: `Show ${name}` });
  const cell = document.createElement("td");
  cell.append(box);
  row.cells[0]?.after(cell);
  boxes.set(attribute, [...(boxes.get(attribute) ?? []), box]);
}

function addColumn(table: HTMLTableElement, boxes: Boxes): void {
  const chosen = [...table.rows].filter(({ dataset }) => dataset.shownBy);
  if (chosen.length === 0) return;
  const head = document.createElement("th");
  head.scope = "col";
  head.textContent = "Shown";
  // In the second column, which a phone shows without scrolling.
  table.tHead?.rows[0]?.cells[0]?.after(head);
  for (const row of table.tBodies[0]?.rows ?? []) {
    if (row.dataset.shownBy) addBox(row, boxes);
    else row.cells[0]?.after(document.createElement("td"));
  }
}

/** Adds the check boxes and the list to a figure's section; `changed` is called for each choice. */
export function startStudio(section: HTMLElement, figure: HTMLElement, changed: (choice: Choice) => void): void {
  const boxes: Boxes = new Map();
  for (const table of section.querySelectorAll<HTMLTableElement>("details table")) addColumn(table, boxes);
  const goals = document.createElement("select");
  goals.ariaLabel = "Goals shown";
  goals.append(...GOALS.map(([value, words]) => new Option(words, value)));
  section.querySelector(".snippet .listing-bar select")?.after(goals);
  section.addEventListener("change", ({ target }) => {
    const isBox = target instanceof HTMLInputElement && [...boxes.values()].some((all) => all.includes(target));
    if (!isBox && target !== goals) return;
    const choice: Choice = {};
    for (const [attribute, all] of boxes) {
      const shown = all.filter(({ checked }) => checked).map(({ value }) => value);
      if (shown.length < all.length) choice[attribute] = shown.join(" ") || "none";
    }
    if (goals.value !== "one") choice.goals = goals.value;
    for (const attribute of [...boxes.keys(), "goals"]) {
      const value = choice[attribute];
      if (value === undefined) figure.removeAttribute(attribute);
      else figure.setAttribute(attribute, value);
    }
    changed(choice);
  });
}
