// Generates custom-elements.json, the manifest of <epipole-figure>, from the sources.
// https://github.com/webcomponents/custom-elements-manifest

import { readdirSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import ts from "typescript";

const here = dirname(fileURLToPath(import.meta.url));

function parse(file) {
  const text = readFileSync(join(here, "src", file), "utf8");
  return ts.createSourceFile(file, text, ts.ScriptTarget.ES2022, true);
}

function find(tree, wanted) {
  const found = [];
  const visit = (node) => {
    if (wanted(node)) found.push(node);
    ts.forEachChild(node, visit);
  };
  visit(tree);
  return found;
}

/** The doc comment of a declaration, as one paragraph. */
function words(node) {
  const [doc] = ts.getJSDocCommentsAndTags(node);
  const text = ts.getTextOfJSDocComment(doc?.comment) ?? "";
  return text.replace(/\s+/g, " ").trim();
}

/** Lifecycle members that browsers call. */
const CALLBACKS = /Callback$|^observedAttributes$/;

/** Descriptions of the attributes that are not parameters of a figure. */
const ATTRIBUTES = {
  name: "The figure, such as ransac-race.",
  theme: "Fixes the colors: light, dark or high-contrast.",
  compact: "Fits the figure to the height that the page gives.",
  controls: "Names of the only controls to show, or none.",
  readouts: "Names of the only readouts to show, or none.",
  goals: "none, one (at a time) or all.",
};

export function manifest() {
  const element = parse("element.ts");
  const [figure] = find(element, (node) => ts.isClassDeclaration(node) && node.name?.text === "EpipoleFigure");
  const members = new Map();
  for (const member of figure.members) {
    const name = member.name && ts.isIdentifier(member.name) ? member.name.text : undefined;
    const isStatic = member.modifiers?.some(({ kind }) => kind === ts.SyntaxKind.StaticKeyword);
    if (!name || isStatic || CALLBACKS.test(name)) continue;
    const text = (node) => node?.getText(element).replace(/\s+/g, " ");
    if (ts.isMethodDeclaration(member)) {
      members.set(name, {
        kind: "method",
        name,
        description: words(member),
        parameters: member.parameters.map((parameter) => ({ name: text(parameter.name), type: { text: text(parameter.type) ?? "" } })),
        return: { type: { text: text(member.type) ?? "void" } },
      });
    } else if (ts.isGetAccessor(member)) {
      members.set(name, { kind: "field", name, description: words(member), type: { text: text(member.type) ?? "" }, readonly: true });
    } else if (ts.isSetAccessor(member) && members.has(name)) delete members.get(name).readonly;
  }
  const index = parse("index.ts");
  const [events] = find(index, (node) => ts.isInterfaceDeclaration(node) && node.name.text === "EpipoleEvents");
  const look = join(here, "src/look");
  const css = readdirSync(look).map((name) => readFileSync(join(look, name), "utf8")).join("");
  const properties = [...new Set(css.match(/var\(--epipole-[a-z-]+/g).map((use) => use.slice("var(".length)))].sort();
  return {
    schemaVersion: "2.1.0",
    modules: [
      {
        kind: "javascript-module",
        path: "dist/index.js",
        declarations: [
          {
            kind: "class",
            customElement: true,
            tagName: "epipole-figure",
            name: "EpipoleFigure",
            description: "A figure of multi-view geometry. Every parameter of the figure is an attribute, too.",
            superclass: { name: "HTMLElement" },
            attributes: Object.entries(ATTRIBUTES).map(([name, description]) => ({ name, description })),
            members: [...members.values()],
            events: events.members.map((event) => ({ name: event.name.text, description: words(event), type: { text: "CustomEvent" } })),
            slots: [
              { name: "", description: "A picture to show until the figure runs." },
              { name: "caption", description: "A caption, which stays." },
            ],
            cssProperties: properties.map((name) => ({ name })),
          },
        ],
        exports: [
          { kind: "js", name: "EpipoleFigure", declaration: { name: "EpipoleFigure", module: "dist/index.js" } },
          { kind: "custom-element-definition", name: "epipole-figure", declaration: { name: "EpipoleFigure", module: "dist/index.js" } },
        ],
      },
    ],
  };
}
