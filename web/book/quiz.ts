// Quizzes. The page contains questions and folded answers; this script checks the reader's answer and stores solved
// questions in this browser only. An answer to an earlier wording of a question (another data-hash) does not count.

import { countReached, goalsOf } from "./goals";
import { hashOf, loadSolved, markSolved } from "./solved";

type Verdict = { right: boolean; say: string };

function checkNumber(input: HTMLInputElement): Verdict | null {
  const typed = input.value.trim().replace(/\s/g, "").replace("−", "-").replace(",", ".");
  if (typed === "") return null;
  const value = Number(typed);
  if (!Number.isFinite(value)) return { right: false, say: "Please type a number." };
  const answer = Number(input.dataset.answer);
  // Readers type decimals rounded like those on the page, so rounding is allowed beyond the tolerance.
  const tolerance = Number(input.dataset.tolerance) + 1e-9 * Math.max(1, Math.abs(answer));
  const right = Math.abs(value - answer) <= tolerance;
  return { right, say: right ? "Right." : value > answer ? "Not yet: too large." : "Not yet: too small." };
}

function checkChoices(inputs: HTMLInputElement[]): Verdict | null {
  if (!inputs.some((input) => input.checked)) return null;
  const right = inputs.every((input) => input.checked === "right" in input.dataset);
  return { right, say: right ? "Right." : "Not yet. Look again, or open the answer." };
}

function checkOrder(places: HTMLSelectElement[]): Verdict | null {
  const chosen = places.map(({ value }) => value);
  if (chosen.every((place) => place === "")) return null;
  if (chosen.some((place) => place === "")) return { right: false, say: "Not yet: some have no place." };
  if (new Set(chosen).size < chosen.length) return { right: false, say: "Not yet: two have the same place." };
  const wrong = places.filter(({ value, dataset }) => value !== dataset.place).length;
  return { right: wrong === 0, say: wrong === 0 ? "Right." : `Not yet: ${wrong} stand elsewhere.` };
}

function showReasons(form: HTMLFormElement): void {
  for (const why of form.querySelectorAll<HTMLElement>(".why")) {
    const input = why.previousElementSibling?.querySelector("input");
    why.hidden = !input?.checked;
  }
}

function prepare(form: HTMLFormElement, quiz: string): void {
  const id = form.id;
  const hash = hashOf(form);
  const actions = form.querySelector<HTMLElement>(".question-actions");
  const verdict = form.querySelector<HTMLElement>(".verdict");
  const solution = form.querySelector<HTMLDetailsElement>(".solution");
  if (!actions || !verdict) return;
  actions.hidden = false;
  if (loadSolved("quiz", quiz)[id] === hash) {
    form.dataset.state = "right";
    verdict.textContent = "You solved this one.";
  }
  form.addEventListener("submit", (event) => {
    event.preventDefault();
    const number = form.querySelector<HTMLInputElement>("input[data-answer]");
    const choices = [...form.querySelectorAll<HTMLInputElement>(".choice input")];
    const places = [...form.querySelectorAll<HTMLSelectElement>("select[data-place]")];
    const result = number ? checkNumber(number) : places.length > 0 ? checkOrder(places) : checkChoices(choices);
    if (!result) {
      delete form.dataset.state;
      verdict.textContent = "Choose or type an answer first.";
      return;
    }
    form.dataset.state = result.right ? "right" : "wrong";
    verdict.textContent = result.say;
    showReasons(form);
    if (result.right) {
      if (!markSolved("quiz", quiz, id, hash)) {
        verdict.textContent += " This browser keeps nothing for this page, so it will not remember that.";
      }
      if (solution) solution.open = true;
      form.dispatchEvent(new Event("epipole-solved", { bubbles: true }));
    }
  });
}

/** Shows the reader's progress below a chapter's picture; nothing if there is none. */
function showSolved(mark: HTMLElement): void {
  const solved = Object.keys(loadSolved("quiz", mark.dataset.quiz ?? "")).length;
  const questions = Number(mark.dataset.questions);
  const goals = goalsOf(mark);
  const reached = countReached(goals);
  const words = [];
  if (solved > 0) words.push(solved < questions ? `${solved} of ${questions} questions solved` : "Quiz solved");
  const tasks = Object.keys(loadSolved("task", mark.dataset.quiz ?? "")).length;
  if (tasks > 0) words.push(tasks === 1 ? "1 task solved" : `${tasks} tasks solved`);
  if (reached > 0) words.push(`${reached} of ${goals.length} goals reached`);
  mark.hidden = words.length === 0;
  mark.textContent = words.join(", ");
}

export function start(): void {
  for (const quiz of document.querySelectorAll<HTMLElement>(".quiz")) {
    for (const form of quiz.querySelectorAll("form")) prepare(form, quiz.dataset.quiz ?? "");
  }
  for (const mark of document.querySelectorAll<HTMLElement>(".small .solved")) showSolved(mark);
}
