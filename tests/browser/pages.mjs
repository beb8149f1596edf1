// Pages that the tests make up: figures as the book writes them, with poster and caption.

import { script } from "./places.mjs";

/** `?figure=ransac-race outliers=0.4&figure=…&theme=dark&bare=1`: a page with these figures. */
export function figurePage(url) {
  const figures = url.searchParams.getAll("figure").map((words, index) => {
    const [name, ...settings] = words.split(" ");
    const attributes = settings.map((setting) => {
      const [key, value = ""] = setting.split("=");
      return ` ${key}="${value.replaceAll('"', "&quot;")}"`;
    });
    if (url.searchParams.has("bare")) {
      return `<epipole-figure name="${name}"${attributes.join("")}></epipole-figure>`;
    }
    return `<figure class="epipole" id="fig-${index + 1}">
<epipole-figure name="${name}"${attributes.join("")}><picture><img src="/pages/poster.svg" alt="Poster of ${name}" width="760" height="420"></picture></epipole-figure>
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
<script type="module" src="/elements/${script}"></script>
</head>
<body>
<main>
<h1>Figures</h1>
<p id="before">A paragraph with <a href="#after">a link</a>.</p>
${figures.join("\n")}
<p id="after">Another paragraph.</p>
</main>
</body>
</html>`;
}
