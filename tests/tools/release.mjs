// Checks before a release: node tests/tools/release.mjs TAG
//
// The tag is v and the version of the workspace; packages, their lock files, citation and changelog
// have the same version; the npm packages can be published. Lists what is missing, and fails. Needs
// no network. With --notes it prints the section of the changelog instead.

import { readFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { argv, exit } from "node:process";
import { fileURLToPath } from "node:url";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const read = (path) => readFileSync(join(root, path), "utf8");
const tag = argv[2] ?? "";
const version = tag.replace(/^v/, "");

/** The section of the version in the changelog: heading and text. */
function section() {
  const sections = read("CHANGELOG.md").split(/^## /m).slice(1);
  const found = sections.find((text) => text.split(/\s/, 1)[0] === version) ?? "";
  const end = found.indexOf("\n");
  return { heading: found.slice(0, end), text: found.slice(end).trim() };
}

function problemsOf() {
  const problems = [];
  const same = (place, found) => {
    if (found === version) return;
    problems.push(`${place} has version ${found ?? "none"}, the tag ${tag}`);
  };
  const workspace = read("Cargo.toml");
  same("Cargo.toml", workspace.match(/^\[workspace\.package\]\nversion = "(.*)"/m)?.[1]);
  const dependencies = workspace.matchAll(/^(epipole[\w-]*) = \{.*version = "([^"]*)"/gm);
  for (const [, crate, found] of dependencies) {
    same(`Cargo.toml: the dependency ${crate}`, found);
  }
  for (const place of ["web/package.json", "web/vision/package.json"]) {
    const npm = JSON.parse(read(place));
    same(place, npm.version);
    if (npm.private) problems.push(`${place} is private: remove that line to publish it`);
    if (!npm.repository) problems.push(`${place} lacks repository, needed for provenance`);
  }
  same("web/package-lock.json", JSON.parse(read("web/package-lock.json")).version);
  same("CITATION.cff", read("CITATION.cff").match(/^version: (.*)/m)?.[1]);
  const python = read("crates/epipole-python/pyproject.toml").match(/"epipole-figures==([^"]*)"/)?.[1];
  same("crates/epipole-python/pyproject.toml: the dependency epipole-figures", python);
  const { heading, text } = section();
  const isDated = /\d{4}-\d{2}-\d{2}/.test(heading);
  if (!text) problems.push(`CHANGELOG.md has no section ${version}`);
  else if (!isDated) problems.push(`CHANGELOG.md: ${version} has no date`);
  return problems;
}

if (!/^v\d+\.\d+\.\d+/.test(tag)) {
  console.error(`"${tag}" is not a tag such as v0.1.0`);
  exit(1);
}
if (argv.includes("--notes")) {
  console.log(section().text);
} else {
  const problems = problemsOf();
  for (const problem of problems) console.error(problem);
  exit(problems.length > 0 ? 1 : 0);
}
