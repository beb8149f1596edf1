// Link from a figure to the Lab: passes the matching step, parameters and the reader's photographs, which this browser
// stores until the Lab opens.

interface Figure extends HTMLElement {
  readonly photographs?: readonly File[];
  readonly state?: Record<string, string>;
}

/** Step of the Lab for a figure, and the Lab's name of each of the figure's parameters. */
interface Way {
  step: (state: Record<string, string>) => string;
  knobs: Record<string, string>;
}

const STAGES: Record<string, string> = { detect: "features", match: "matches", ransac: "two-views", surface: "depth" };

const WAYS: Record<string, Way> = {
  "gradient-field": { step: () => "features", knobs: {} },
  harris: { step: () => "features", knobs: {} },
  "two-view-sfm": {
    step: ({ stage = "surface" }) => STAGES[stage] ?? "reconstruction",
    knobs: { ratio: "ratio", threshold: "max-error" },
  },
};

/** Returns the address of the Lab for a figure's state, relative to the page's folder. */
export function addressFor(name: string, state: Record<string, string>): string {
  const way = WAYS[name];
  const link = new URLSearchParams({ step: way?.step(state) ?? "photographs" });
  for (const [knob, theirs] of Object.entries(way?.knobs ?? {})) {
    const value = state[knob];
    if (value !== undefined) link.set(theirs, value);
  }
  // With this value the Lab loads the stored photographs instead of its sample.
  link.set("photographs", "brought");
  return `lab/index.html?${link}`;
}

/** Stores the photographs and opens the Lab. Throws an error with a message for the reader. */
async function go(figure: Figure): Promise<void> {
  const address = addressFor(figure.getAttribute("name") ?? "", figure.state ?? {});
  const photographs = figure.photographs ?? [];
  // Stores nothing unless that page is a Lab, which will read the photographs.
  const answer = await fetch(address).catch(() => undefined);
  const page = answer?.ok ? await answer.text() : "";
  if (!page.includes('id="lab"')) throw new Error("The Lab cannot be reached just now.");
  const { putAside } = await import("../lab/keep");
  await putAside(photographs).catch(() => {
    throw new Error("This browser lets a page hand on nothing: open the Lab and choose the photographs there.");
  });
  location.assign(address);
}

/** Shows a button below the figure while it has photographs of the reader. */
function offer(figure: Figure): void {
  const place = figure.parentElement?.querySelector(":scope > .to-lab");
  const count = figure.photographs?.length ?? 0;
  if (count === 0) {
    place?.remove();
    return;
  }
  const button = document.createElement("button");
  button.type = "button";
  button.textContent = count === 1 ? "Open your photograph in the Lab" : `Open your ${count} photographs in the Lab`;
  const box = document.createElement("p");
  box.className = "to-lab";
  box.setAttribute("role", "status");
  button.addEventListener("click", () => {
    button.disabled = true;
    go(figure).catch((problem: Error) => {
      button.disabled = false;
      box.replaceChildren(button, ` ${problem.message}`);
    });
  });
  box.append(button);
  if (place) place.replaceWith(box);
  else figure.after(box);
}

export function startHandingOn(): void {
  document.addEventListener("epipole-photographs", ({ target }) => {
    if (target instanceof HTMLElement) offer(target as Figure);
  });
}
