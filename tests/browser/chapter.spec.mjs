// A chapter in a frame of a course page: the text alone, its score, and the state that is kept.

import { course, heard } from "./course.mjs";
import { expect, expectAccessible, test } from "./fixtures.mjs";
import { book } from "./places.mjs";
import { serve } from "./server.mjs";

test.skip(!book, "the book is not what is tested");

const CHAPTER = "rays.html";

/** The book on an origin where it may be framed. */
const framed = () => serve({ mounts: { book }, policy: false });

/** Answers the first question that asks for a number. */
async function solve(inner) {
  const form = inner.locator(".quiz form").filter({ has: inner.locator("input[data-answer]") }).first();
  const input = form.locator("input[data-answer]");
  await input.fill(await input.getAttribute("data-answer"));
  await form.getByRole("button", { name: "Check" }).click();
  await expect(form).toHaveAttribute("data-state", "right");
  return form.getAttribute("id");
}

test("the chapter stands alone, with the settings of its address", async ({ page, library, complaints }) => {
  await page.goto(`${library}/${CHAPTER}?embed&theme=dark&text=130`);
  await expect(page.locator("html")).toHaveAttribute("data-theme", "dark");
  await expect(page.locator("html")).toHaveAttribute("data-text", "130");
  for (const part of [".bar", ".contents", ".turn", ".deck-link"]) await expect(page.locator(part).first()).toBeHidden();
  const box = await page.locator("h1").boundingBox();
  expect(box.y).toBeLessThan(120);
  await expectAccessible(page);
  // axe measures by inline styles, which the policy forbids.
  complaints.length = 0;
  // Links within the chapter stay, others do not replace it.
  await page.locator("article a[href^='#']:not(.anchor)").first().click();
  const other = page.locator("article a[href*='.html']:not([href^='#'])").first();
  const [opened] = await Promise.all([page.context().waitForEvent("page"), other.click()]);
  expect(new URL(page.url()).pathname.endsWith(CHAPTER)).toBe(true);
  await opened.close();
  // Without the word, everything is there.
  await page.goto(`${library}/${CHAPTER}?theme=dark`);
  await expect(page.locator(".bar")).toBeVisible();
  await expect(page.locator("html")).not.toHaveAttribute("data-theme", "dark");
});

test("a course hears which share is solved, and gives back what it keeps", async ({ page }) => {
  const site = await framed();
  const address = `${site.origin}/book/${CHAPTER}?embed`;
  const first = await course(page, address);
  const id = await solve(first.inner);
  await expect.poll(async () => (await heard(page, "SPLICE.reportScoreAndState")).length).toBe(1);
  const [{ activity_id, score, state }] = await heard(page, "SPLICE.reportScoreAndState");
  expect(activity_id).toBe(`${site.origin}/book/${CHAPTER}`);
  expect(Object.keys(state.quiz)).toEqual([id]);
  const all = await first.inner.locator("article").evaluate((article) => ({
    questions: article.querySelectorAll(".quiz form").length,
    goals: article.dataset.goals.split(" "),
  }));
  expect(all.goals.length).toBeGreaterThan(0);
  expect(score).toBeCloseTo(1 / (all.questions + all.goals.length), 12);
  await first.close();
  // Another browser, which knows nothing; the course also sends what belongs to no edition.
  await page.context().clearCookies();
  const kept = { ...state, quiz: { ...state.quiz, gone: "0" }, goals: [all.goals[0], "gone/goal"] };
  const listen = `if (data.subject === "SPLICE.getState") {
    answer({ subject: "SPLICE.getState.response", message_id: "somebody else's", state: {} });
    answer({ subject: "SPLICE.getState.response", message_id: data.message_id, state: ${JSON.stringify(kept)} });
  }`;
  const elsewhere = await framed();
  const second = await course(page, `${elsewhere.origin}/book/${CHAPTER}?embed`, listen);
  await expect(second.inner.locator(`form[id="${id}"] .verdict`)).toHaveText("You solved this one.");
  expect(await heard(page, "SPLICE.reportScoreAndState")).toEqual([]);
  const next = second.inner.locator(".quiz form:not([data-state])").filter({ has: page.locator(".choice") }).first();
  for (const right of await next.locator("input[data-right]").all()) await right.check();
  await next.getByRole("button", { name: "Check" }).click();
  await expect.poll(async () => (await heard(page, "SPLICE.reportScoreAndState")).length).toBe(1);
  const [report] = await heard(page, "SPLICE.reportScoreAndState");
  expect(report.score).toBeCloseTo(3 / (all.questions + all.goals.length), 12);
  expect(report.state.goals).toEqual([all.goals[0]]);
  await second.close();
  await elsewhere.close();
  await site.close();
});

test("a course that keeps nothing does not hold up the quiz", async ({ page }) => {
  const site = await framed();
  const refused = `if (data.subject === "SPLICE.getState")
    answer({ subject: "SPLICE.getState.response", message_id: data.message_id, error: "none", state: "no JSON" });`;
  for (const listen of ["", refused]) {
    const { inner, close } = await course(page, `${site.origin}/book/${CHAPTER}?embed`, listen);
    await solve(inner);
    await close();
  }
  await site.close();
});
