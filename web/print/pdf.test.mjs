// Tests of the printed book in target/pdf/ against the document that was printed.

import assert from "node:assert/strict";
import { readdirSync, readFileSync, statSync } from "node:fs";
import { join, resolve } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { getDocument } from "pdfjs-dist/legacy/build/pdf.mjs";

const target = resolve(fileURLToPath(import.meta.url), "../../../target");
const file = join(target, "pdf/epipole.pdf");
const MOST_BYTES = 25e6;

const CHAPTER = /^chapter (\d+) /i;

const squeezed = (text) => text.replace(/\s+/g, "");
let book;
/** Text of each page without blanks, and its pieces. */
const pages = [];

before(async () => {
  book = await getDocument({ data: new Uint8Array(readFileSync(file)), verbosity: 0 }).promise;
  for (let number = 1; number <= book.numPages; number += 1) {
    const page = await book.getPage(number);
    const { items } = await page.getTextContent();
    pages.push({ items, text: squeezed(items.map(({ str }) => str).join("")) });
  }
});
after(() => book.destroy());

/** The headings of the outline with their pages, counted from 1. */
async function headings(items, level = 0) {
  const all = [];
  for (const { title, dest, items: inside } of items) {
    const place = typeof dest === "string" ? await book.getDestination(dest) : dest;
    all.push({ title, level, page: (await book.getPageIndex(place[0])) + 1 }, ...(await headings(inside, level + 1)));
  }
  return all;
}

test("the book is tagged, titled, and small enough", async () => {
  assert.ok(statSync(file).size <= MOST_BYTES, `${statSync(file).size} bytes`);
  assert.equal((await book.getMarkInfo())?.Marked, true);
  const { info } = await book.getMetadata();
  assert.equal(info.Title, "Epipole");
});

test("headings are on the pages that the outline names", async () => {
  const all = await headings(await book.getOutline());
  assert.ok(all.length > 100, `${all.length} headings`);
  for (const { title, page } of all) {
    const start = squeezed(title).slice(0, 12);
    assert.ok(pages[page - 1].text.includes(start), `"${title}" is not on page ${page}`);
  }
});

test("the contents name the pages of chapters", async () => {
  const start = pages.findIndex(({ text }) => /^\d+Contents/.test(text));
  const end = pages.findIndex(({ text }, index) => index > start && /^\d+Epipole/.test(text));
  const contents = pages.slice(start, end).flatMap(({ items }) => items.map(({ str }) => str.trim()));
  const chapters = (await headings(await book.getOutline())).filter(({ title }) => CHAPTER.test(title));
  assert.equal(chapters.length, 15);
  for (const { title, page } of chapters) {
    const [, number] = CHAPTER.exec(title);
    const name = squeezed(title.replace(CHAPTER, "")).slice(0, 20);
    const line = contents.findIndex((words, index) => words === number && squeezed(contents.slice(index + 1, index + 6).join("")).startsWith(name));
    assert.ok(line >= 0, `"${title}" is not in the contents`);
    const next = contents.slice(line + 1).find((words) => /^\d+$/.test(words));
    assert.equal(next, String(page), title);
  }
});

test("page numbers, captions and answers are there", () => {
  const html = readFileSync(join(target, "print/print.html"), "utf8");
  const all = pages.map(({ text }) => text).join("");
  const captions = [...html.matchAll(/class="figure-number"[^>]*>(Figure [\d.]+)</g)].map(([, name]) => squeezed(name));
  assert.ok(captions.length > 80, `${captions.length} captions`);
  for (const caption of captions) assert.ok(all.includes(caption), caption);
  assert.ok(all.includes("Hintsandanswers"));
  for (const [index, { text }] of pages.entries()) {
    if (index > 0) assert.ok(text.endsWith(String(index + 1)) || text.startsWith(String(index + 1)), `page ${index + 1} has no number`);
  }
});

test("each chapter has a file of its own", async () => {
  const chapters = readdirSync(join(target, "pdf/chapters"));
  assert.equal(chapters.length, 15);
  for (const name of chapters) {
    const data = new Uint8Array(readFileSync(join(target, "pdf/chapters", name)));
    const chapter = await getDocument({ data, verbosity: 0 }).promise;
    assert.ok(chapter.numPages >= 5, `${name}: ${chapter.numPages} pages`);
    await chapter.destroy();
  }
});
