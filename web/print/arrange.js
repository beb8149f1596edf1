// Arranges the pages of the printed book: links within the document, and page numbers where
// `setPageNumbers` is told them.
"use strict";

/** Lines of a listing that may stand on two pages: kept together, it would leave a page half empty. */
const LONG_LINES = 28;

const nameOf = (path) => path.replace(/\.html$/, "");
const articles = [...document.querySelectorAll("article[data-page]")];

/** The anchor of a link in the printed book; undefined for a place that is not printed. */
function anchorOf(href, page) {
  if (href.startsWith("#")) return `${nameOf(page)}--${href.slice(1)}`;
  const [path, fragment] = href.split("#");
  if (!articles.some((article) => article.dataset.page === path)) return undefined;
  return fragment ? `${nameOf(path)}--${fragment}` : nameOf(path);
}

/** Makes anchors unique in the document, and links to what is not printed plain text. */
function joinLinks() {
  for (const article of articles) {
    const page = article.dataset.page;
    for (const element of article.querySelectorAll("[id]")) element.id = `${nameOf(page)}--${element.id}`;
    article.id = nameOf(page);
  }
  for (const link of document.querySelectorAll("a[href]")) {
    const href = link.getAttribute("href");
    if (/^(https?|mailto):/.test(href)) continue;
    const page = link.closest("article")?.dataset.page ?? "";
    const anchor = anchorOf(href, page);
    if (anchor && document.getElementById(anchor)) link.href = `#${anchor}`;
    else link.replaceWith(...link.childNodes);
  }
}

/** Fits the pages to paper. */
function fit() {
  for (const part of document.querySelectorAll(".listing-part")) {
    part.classList.toggle("long", part.textContent.split("\n").length > LONG_LINES);
  }
  for (const number of document.querySelectorAll("h1 .chapter-number")) {
    // The outline needs a blank, and a line must not begin with one.
    number.append(" ");
    const { nextSibling: title } = number;
    if (title instanceof Text) title.data = title.data.trimStart();
  }
  for (const image of document.querySelectorAll("article img")) image.loading = "eager";
}

/** Puts the address of each figure below its caption. */
function placePermalinks() {
  for (const permalink of document.querySelectorAll(".permalink")) {
    const page = permalink.closest("article").dataset.page;
    document.getElementById(`${nameOf(page)}--${permalink.dataset.figure}`)?.append(permalink);
  }
}

/** Adds places for page numbers: to the contents, and to the glossary, which becomes the index. */
function placePageNumbers() {
  const add = (link) => {
    const number = document.createElement("span");
    number.className = "on-page";
    number.dataset.anchor = link.getAttribute("href").slice(1);
    number.textContent = "000";
    link.append(number);
  };
  for (const link of document.querySelectorAll(".paper-contents a[href]")) add(link);
  for (const link of document.querySelectorAll(".glossary .where a[href]")) {
    link.textContent = "page ";
    add(link);
  }
}

/** Fills in page numbers by anchor. Returns the anchors without one. */
globalThis.setPageNumbers = (pages) => {
  const unknown = [];
  for (const number of document.querySelectorAll(".on-page")) {
    const page = pages[number.dataset.anchor];
    if (page === undefined) unknown.push(number.dataset.anchor);
    number.textContent = page ?? "";
  }
  return unknown;
};

/** Shows one chapter alone, or the whole book without a name. */
globalThis.showOnly = (page) => {
  for (const part of document.body.children) part.hidden = page !== undefined && part.dataset.page !== page;
};

fit();
joinLinks();
placePermalinks();
placePageNumbers();
