/** Prerenders a figure's shadow tree as HTML, for pages to show before any script runs. */

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
  /** Width and height of the picture for each layout width, to reserve room for its poster. */
  sizes?: [width: number, height: number][];
}

/** Parts that are operable in a running figure. */
const OPERATED = ".toolbar, .under, .inputs, .folds, .challenges";
/** Parts that exist only in a running figure. */
const ALIVE = ".marks, .overlay, .chooser, canvas, .photos, .link";

/** Returns the content of `<template shadowrootmode="open">`, with `{{figure.css}}` as the style sheet's address. */
export function prerender({ title, help, snapshot, attributes, sizes = [] }: Wanted): string {
  const nothing = () => undefined;
  const hand = { handleAt: nothing, drag: nothing, nudge: nothing, moveToEnd: nothing, remove: nothing, click: nothing, set: nothing };
  const shell = new Shell(
    {
      send: nothing,
      hand,
      // Only the reader's browser knows whether full screen is available.
      deeds: { reset: nothing, link: () => "", save: nothing, saveFile: nothing, fullscreen: nothing },
      jobs: { next: nothing, done: nothing, failed: nothing },
      takePhoto: nothing,
      showHow: nothing,
    },
    choiceOf((name) => attributes[name] ?? null),
  );
  shell.introduce(title, help);
  shell.role = "group";
  shell.update({ ...snapshot, handles: [], waiting: null }, { touched: false, own: false });
  shell.reveal();
  const { root } = shell;
  for (const dead of root.querySelectorAll(ALIVE)) dead.remove();
  // An empty SVG gets its aspect ratio from the viewBox, so no inline style is needed.
  for (const [width, height] of sizes) {
    const shape = icon();
    shape.setAttribute("class", `size-${width}`);
    shape.setAttribute("viewBox", `0 0 ${width} ${height}`);
    shell.picture.sheet.append(shape);
  }
  for (const part of root.querySelectorAll(OPERATED)) part.setAttribute("inert", "");
  // Strict content security policies forbid inline styles; the script sets slider fills later.
  for (const styled of root.querySelectorAll("[style]")) styled.removeAttribute("style");
  for (const button of root.querySelectorAll("[aria-controls]")) button.removeAttribute("aria-controls");
  for (const input of root.querySelectorAll("input")) if (input.checked) input.setAttribute("checked", "");
  root.setAttribute("aria-busy", "true");
  return `<link rel="stylesheet" href="{{figure.css}}">${root.outerHTML}`;
}
