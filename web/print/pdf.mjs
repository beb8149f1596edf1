// Prints the book that `epipole-book print` writes: the whole and each chapter, as tagged PDF.
//
// Usage: node pdf.mjs FOLDER OUT
//
// Chromium knows no page numbers of other places, so the whole book is printed twice: the first
// time tells on which page each anchor is.

import { mkdir, writeFile } from "node:fs/promises";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { getDocument } from "pdfjs-dist/legacy/build/pdf.mjs";
import { chromium } from "playwright-core";
import { launchOptions } from "../../tests/browser/chromium.mjs";

const [folder, out] = process.argv.slice(2);
if (!folder || !out) {
  console.error("usage: node pdf.mjs FOLDER OUT");
  process.exit(2);
}
const OPTIONS = { tagged: true, outline: true, preferCSSPageSize: true, printBackground: true };

/** Page of each anchor, counted from 1. */
async function pagesOf(pdf) {
  const task = getDocument({ data: new Uint8Array(pdf), verbosity: 0 });
  const book = await task.promise;
  const pages = {};
  for (const [anchor, place] of Object.entries(await book.getDestinations())) {
    pages[anchor] = (await book.getPageIndex(place[0])) + 1;
  }
  const { numPages } = book;
  await task.destroy();
  return { pages, numPages };
}

const browser = await chromium.launch({
  ...launchOptions,
  args: [...launchOptions.args, "--allow-file-access-from-files"],
});
try {
  const start = performance.now();
  const page = await browser.newPage({ colorScheme: "light" });
  page.on("pageerror", (error) => {
    throw error;
  });
  await page.goto(pathToFileURL(resolve(folder, "print.html")).href, { waitUntil: "load" });
  await page.evaluate(() =>
    Promise.all([document.fonts.ready, ...[...document.images].map((image) => image.decode())]),
  );
  const { pages } = await pagesOf(await page.pdf(OPTIONS));
  const unknown = await page.evaluate((pages) => setPageNumbers(pages), pages);
  if (unknown.length > 0) throw new Error(`no page holds ${unknown.join(", ")}`);
  const whole = await page.pdf(OPTIONS);
  const { pages: again, numPages } = await pagesOf(whole);
  const moved = Object.keys(pages).filter((anchor) => pages[anchor] !== again[anchor]);
  if (moved.length > 0) throw new Error(`page numbers moved ${moved.slice(0, 5).join(", ")}`);
  await mkdir(join(out, "chapters"), { recursive: true });
  await writeFile(join(out, "epipole.pdf"), whole);
  console.log(`epipole.pdf: ${numPages} pages, ${(whole.length / 1e6).toFixed(1)} MB`);
  const chapters = await page.$$eval("article.chapter", (all) => all.map(({ dataset: { page, number } }) => ({ page, number })));
  for (const { page: name, number } of chapters) {
    await page.evaluate((name) => showOnly(name), name);
    const pdf = await page.pdf(OPTIONS);
    const file = `${number.padStart(2, "0")}-${name.replace(/\.html$/, "")}.pdf`;
    await writeFile(join(out, "chapters", file), pdf);
    console.log(`chapters/${file}: ${(pdf.length / 1e6).toFixed(1)} MB`);
  }
  console.log(`printed in ${((performance.now() - start) / 1000).toFixed(0)} s`);
} finally {
  await browser.close();
}
