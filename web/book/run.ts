// Runnable code: the button of a listing or a task loads the editor and runs the code. A link with `#run=name&code=…`
// opens a block with the code that it contains.

import type { Block, Program } from "../run/program";
import { showTab } from "./listings";
import { hashOf, markSolved } from "./solved";

const programs = new Map<HTMLElement, Promise<Program>>();

function blockOf(box: HTMLElement): Block | undefined {
  const part = box.querySelector<HTMLElement>(".listing-part[data-tab=js]");
  const button = box.querySelector<HTMLButtonElement>("button.run");
  if (!part || !button) return undefined;
  const check = box.querySelector<HTMLTemplateElement>("template.check")?.content.textContent ?? undefined;
  return {
    name: box.id.replace(/^(listing|task)-/, ""),
    title: box.querySelector(".listing-title")?.textContent ?? "",
    part,
    button,
    check,
    solved: () => markSolved("task", box.dataset.chapter ?? "", box.id, hashOf(box)),
  };
}

/** Opens a block once. */
function open(block: Block, code?: string): Promise<Program> {
  const opened =
    programs.get(block.part) ?? import("../run/program").then(({ Program }) => new Program(block, code));
  programs.set(block.part, opened);
  opened.catch(() => programs.delete(block.part));
  return opened;
}

async function openLinked(boxes: HTMLElement[], missing: () => void): Promise<void> {
  const name = new URLSearchParams(location.hash.slice(1)).get("run");
  const box = boxes.find(({ id }) => id === `listing-${name}` || id === `task-${name}`);
  const block = box && blockOf(box);
  if (!box || !block) return;
  showTab(box, "js");
  box.scrollIntoView({ block: "start" });
  try {
    const { linked } = await import("../run/stored");
    const { code } = (await linked(location.hash).catch((problem: Error) => {
      const words = document.createElement("p");
      words.className = "run-fault";
      words.setAttribute("role", "alert");
      words.textContent = problem.message;
      block.part.append(words);
      return undefined;
    })) ?? { code: undefined };
    if (code !== undefined) (await open(block, code)).focus();
  } catch {
    missing();
  }
}

/** Activates the buttons; `missing` is called if the editor could not be loaded. */
export function startRunning(missing: () => void): void {
  // A site without the package cannot run code.
  if (EPIPOLE_VISION === "") return;
  const boxes = [...document.querySelectorAll<HTMLElement>(".listing")];
  for (const box of boxes) {
    const block = blockOf(box);
    if (!block) continue;
    const { button, part } = block;
    button.hidden = false;
    button.addEventListener("click", async () => {
      if (!part.checkVisibility()) showTab(box, "js");
      try {
        const program = await open(block);
        if (program.isRunning) program.stop();
        else await program.run();
      } catch {
        missing();
      }
    });
  }
  if (location.hash.startsWith("#run=")) void openLinked(boxes, missing);
}
