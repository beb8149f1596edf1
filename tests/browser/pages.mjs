// Generated test pages: figures as the book writes them, with poster and caption.

import { mkdtemp } from "node:fs/promises";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { loadBindings, root, script } from "./places.mjs";

const { Figure, compute, figures } = await loadBindings();
const known = JSON.parse(figures());
const { prerenderer } = await import(`${root}/web/prerender.mjs`);
/** Folder of the head script and the figures' style sheet for these pages. */
export const made = await mkdtemp(join(tmpdir(), "epipole-"));
const { build } = await import(`${root}/web/node_modules/esbuild/lib/main.js`);
const { look } = await import(`${root}/web/look.mjs`);
const entryPoints = ["early.ts", "figure.css"].map((name) => `${root}/web/src/${name}`);
await build({ entryPoints, outdir: made, bundle: true, format: "iife", plugins: [look] });
const prerender = await prerenderer();

/** Computed answers by figure and key, shared by many pages. */
const answers = new Map();

/** Answer to a job. The key identifies it among the jobs of the figure. */
function answerOf(name, key, request) {
  const asked = `${name} ${key}`;
  if (!answers.has(asked)) answers.set(asked, compute(name, request, { progress: () => {} }));
  return answers.get(asked);
}

/** A figure that has finished its computations. */
function settledFigure(name, attributes) {
  const figure = new Figure(name);
  figure.apply(Object.entries(attributes).flat());
  for (let key = figure.job_key(); key !== undefined; key = figure.job_key()) {
    figure.job_done(key, answerOf(name, key, figure.job_request()));
  }
  return figure;
}

/** Computes in advance what a page with this figure needs, which takes seconds. */
export function prepare(name) {
  settledFigure(name, {}).free();
}

/**
 * Lets figures of different pages share answers, through a worker that asks this process. The
 * answers are the same; tests of the computation itself must not use it.
 */
export async function shareAnswers(page) {
  await page.route(/\/answers\?/, async (route) => {
    const query = new URL(route.request().url()).searchParams;
    try {
      const answer = answerOf(query.get("name"), query.get("key"), new Uint8Array(route.request().postDataBuffer() ?? []));
      await route.fulfill({ body: Buffer.from(answer), contentType: "application/octet-stream" });
    } catch (problem) {
      await route.fulfill({ status: 422, body: String(problem) });
    }
  });
  const body = `addEventListener("message", async ({ data: { name, key, request } }) => {
  const response = await fetch("/answers?" + new URLSearchParams({ name, key }), { method: "POST", body: request });
  if (!response.ok) return postMessage({ key, problem: await response.text() });
  postMessage({ key, result: new Uint8Array(await response.arrayBuffer()) });
});`;
  await page.route(/\/worker[^/]*\.js$/, (route) => route.fulfill({ body, contentType: "text/javascript" }));
}

/** Markup of a figure before its script has loaded: poster and stand-in. */
function standIn(name, attributes, width) {
  const figure = settledFigure(name, attributes);
  const { title, help } = known.find((entry) => entry.name === name);
  const snapshot = JSON.parse(figure.snapshot(width));
  const heightAt = (across) => JSON.parse(figure.snapshot(across)).layout.height;
  const sizes = [360, 720, 1088].map((across) => [across, Math.round(heightAt(across))]);
  figure.free();
  const tree = prerender({ name, title, help, snapshot, attributes, sizes });
  const { layout } = snapshot;
  const [across, down] = [Math.round(layout.width), Math.round(layout.height)];
  const svg = `<svg xmlns="http://www.w3.org/2000/svg" width="${across}" height="${down}"><rect width="100%" height="100%" fill="#ddd"/></svg>`;
  const poster = `<img src="data:image/svg+xml,${encodeURIComponent(svg)}" alt="Poster of ${name}" width="${across}" height="${down}">`;
  const sheet = "/made/figure.css";
  return `<template shadowrootmode="open">${tree.replace("{{figure.css}}", sheet)}</template><picture>${poster}</picture>`;
}

/**
 * Page for `?figure=ransac-race outliers=0.4&figure=…&theme=dark&bare=1`. `wide` lays the figures
 * out on a wide page, `poster=720` adds a stand-in and a poster of that width.
 */
export function figurePage(url) {
  const figures = url.searchParams.getAll("figure").map((words, index) => {
    const [name, ...settings] = words.split(" ");
    const pairs = settings.map((setting) => {
      const [key, value = ""] = setting.split("=");
      return [key, value.replaceAll("+", " ")];
    });
    const attributes = pairs.map(([key, value]) => ` ${key}="${value.replaceAll('"', "&quot;")}"`);
    const width = Number(url.searchParams.get("poster"));
    const inside = width
      ? standIn(name, Object.fromEntries(pairs), width)
      : `<picture><img src="/pages/poster.svg" alt="Poster of ${name}" width="760" height="420"></picture>`;
    if (url.searchParams.has("bare")) {
      return `<epipole-figure name="${name}"${attributes.join("")}></epipole-figure>`;
    }
    return `<figure class="epipole" id="fig-${index + 1}">
<epipole-figure name="${name}"${attributes.join("")}>${inside}</epipole-figure>
<figcaption>Figure ${index + 1}. Caption of ${name}.</figcaption>
</figure>`;
  });
  const theme = url.searchParams.get("theme");
  return `<!DOCTYPE html>
<html lang="en"${theme ? ` data-theme="${theme}"` : ""}>
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Figures</title>
<link rel="stylesheet" href="/pages/page.css">
${url.searchParams.has("poster") ? '<script src="/made/early.js"></script>' : ""}
<script type="module" src="/elements/${script}"></script>
</head>
<body>
<main${url.searchParams.has("wide") ? ' class="wide"' : ""}>
<h1>Figures</h1>
<p id="before">A paragraph with <a href="#after">a link</a>.</p>
${figures.join("\n")}
<p id="after">Another paragraph.</p>
</main>
</body>
</html>`;
}
