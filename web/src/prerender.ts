/** A figure's tree as text, for pages that show it before any script has run. */

import { choiceOf } from "./choice.js";
import type { Snapshot } from "./contract.js";
import { icon } from "./dom.js";
import { Shell } from "./shell.js";

export interface Wanted {
  name: string;
  title: string;
  help: string;
  snapshot: Snapshot;
  attributes: Record<string, string>;
  /** Width and height of the picture at each of the layout widths: room for a poster that is on its way. */
  sizes?: [width: number, height: number][];
}

/** What can be operated in a living figure. */
const OPERATED = ".toolbar, .under, .inputs, .folds, .challenges";
/** What only a living one has. */
const ALIVE = ".marks, .overlay, .chooser, canvas, .photos, .link";

/** The inside of `<template shadowrootmode="open">`; `{{figure.css}}` stands for the style sheet's address. */
export function prerender({ title, help, snapshot, attributes, sizes = [] }: Wanted): string {
  const nothing = () => undefined;
  const hand = { handleAt: nothing, drag: nothing, nudge: nothing, moveToEnd: nothing, remove: nothing, click: nothing, set: nothing };
  const shell = new Shell(
    {
      send: nothing,
      hand,
      // Whether the reader's browser lets figures fill the screen shows in the reader's browser.
      deeds: { reset: nothing, link: () => "", save: nothing, saveFile: nothing, fullscreen: nothing },
      jobs: { next: nothing, done: nothing, failed: nothing },
      takePhoto: nothing,
      showHow: nothing,
    },
    choiceOf((name) => attributes[name] ?? null),
  );
  shell.introduce(title, help);
  shell.role = "group";
  shell.update({ ...snapshot, handles: [], waiting: null }, false);
  shell.reveal();
  const { root } = shell;
  for (const dead of root.querySelectorAll(ALIVE)) dead.remove();
  // A drawing without marks has the shape that its box says, and needs no styles of its own.
  for (const [width, height] of sizes) {
    const shape = icon();
    shape.setAttribute("class", `size-${width}`);
    shape.setAttribute("viewBox", `0 0 ${width} ${height}`);
    shell.picture.sheet.append(shape);
  }
  for (const part of root.querySelectorAll(OPERATED)) part.setAttribute("inert", "");
  // A strict policy allows no styles in the page; the share of a slider is set when the script comes.
  for (const styled of root.querySelectorAll("[style]")) styled.removeAttribute("style");
  for (const button of root.querySelectorAll("[aria-controls]")) button.removeAttribute("aria-controls");
  for (const input of root.querySelectorAll("input")) if (input.checked) input.setAttribute("checked", "");
  root.setAttribute("aria-busy", "true");
  return `<link rel="stylesheet" href="{{figure.css}}">${root.outerHTML}`;
}
