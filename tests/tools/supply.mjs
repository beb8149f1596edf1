// Supply chain checks: node tests/tools/supply.mjs [--bless]
//
// 1. Lock files are complete: every package is locked, from a registry, with a checksum. 2. Every
// crate of the workspace's graph has a license that deny.toml allows. 3. web/THIRD-PARTY.txt lists
// all third-party parts of the site with their license texts: crates in the WebAssembly modules,
// npm packages in the scripts, fonts. web/THIRD-PARTY-FIGURES.txt lists those in the packages of
// the figures alone, web/vision/THIRD-PARTY.txt those in the npm package of the core. `--bless`
// writes the files.
//
// Needs no network once everything is installed. `make audit` checks advisories, with network.

import { execFileSync } from "node:child_process";
import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";
import { chosen } from "./license.mjs";

const root = resolve(dirname(fileURLToPath(import.meta.url)), "../..");
const read = (path) => readFileSync(join(root, path), "utf8");
const problems = [];

/** Folders with a package.json and its lock file. */
const NPM = ["web", "web/print", "tests/browser", "tests/browser/hosts", "tests/engines", "tests/bench"];
/** Requirements files of Python, each for a whole environment. */
const PIP = [
  "crates/epipole-python/docs/requirements.txt",
  "tests/browser/hosts/requirements.txt",
  "tests/files/nerfstudio.txt",
  "tests/peers/requirements.txt",
  "tests/requirements.txt",
  "tests/tools/zig.txt",
];
/** The WebAssembly modules: package, feature, description. */
const FIGURES = [
  ["epipole-web", "figures", "figures"],
  ["epipole-web", "jobs", "long computations"],
];
const LAB = [
  ["epipole-lab", "page", "Lab"],
  ["epipole-lab", "vision-worker", "Lab's workers"],
  ["epipole-lab", "files-worker", "Lab's workers"],
];
/** Modules of the npm package of the core, which runs the readers' code. */
const VISION = ["homography", "geometry", "images", "all"].map((part) => ["epipole-js", part, part]);
const READERS = VISION.map(([name, part]) => [name, part, "readers' code"]);
/** Entry points that esbuild bundles. */
const ELEMENTS = ["web/src/index.ts", "web/src/worker.ts", "web/src/early.ts", "web/src/scorm.ts", "web/src/scorm_chapter.ts"];
const SCRIPTS = [
  ...ELEMENTS, "web/book/head.ts", "web/book/page.ts", "web/book/frame.ts", "web/run/sandbox.ts", "web/slides/deck.ts", "web/lab/lab.ts", "web/lab/worker.ts",
];
/** Fonts: the one in the figures, and those from npm that the builder subsets. */
const FIGURE_SANS = ["Epipole Figure Sans, a renamed subset of IBM Plex Sans, in the modules", "OFL-1.1", "crates/epipole-canvas/assets/EpipoleFigureSans-OFL.txt"];
const STIX = ["STIX Two Text and STIX Two Math, cut to the letters of the book", "OFL-1.1", "web/node_modules/@fontsource/stix-two-math/LICENSE"];
/** The lists to write: for the site, and for the packages of the figures. */
const LISTS = [
  { file: "web/THIRD-PARTY.txt", of: "Epipole's pages, modules and packages", modules: [...FIGURES, ...READERS, ...LAB], scripts: SCRIPTS, fonts: [STIX, FIGURE_SANS] },
  { file: "web/THIRD-PARTY-FIGURES.txt", of: "the figures of Epipole", modules: FIGURES, scripts: ELEMENTS, fonts: [FIGURE_SANS] },
  { file: "web/vision/THIRD-PARTY.txt", of: "the npm package of the core", modules: VISION, scripts: ["web/vision/src/index.ts"], fonts: [] },
];

function cargo(...args) {
  return execFileSync("cargo", args, { cwd: root, maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "pipe"] }).toString();
}

/** Whether the package at `home` finds another one in the lock file, by Node's lookup. */
function isLocked(packages, home, other) {
  if (packages[`${home ? `${home}/` : ""}node_modules/${other}`]) return true;
  if (home === "") return false;
  const cut = home.lastIndexOf("/node_modules/");
  return isLocked(packages, cut < 0 ? "" : home.slice(0, cut), other);
}

function checkLocks() {
  for (const folder of NPM) {
    const { packages } = JSON.parse(read(`${folder}/package-lock.json`));
    const wanted = JSON.parse(read(`${folder}/package.json`));
    for (const kind of ["dependencies", "devDependencies"]) {
      for (const [name, version] of Object.entries(wanted[kind] ?? {})) {
        if (!/^\d/.test(version)) problems.push(`${folder}: ${name} ${version} is not one version`);
        if (packages[""][kind]?.[name] !== version) problems.push(`${folder}: ${name} is locked for another version than ${version}`);
      }
    }
    for (const [name, { integrity, resolved, link, dependencies, optionalDependencies }] of Object.entries(packages)) {
      // `npm ci` rejects lock files without the optional packages of other platforms.
      for (const other of Object.keys({ ...dependencies, ...optionalDependencies })) {
        if (!isLocked(packages, name, other)) problems.push(`${folder}: ${name || "the package"} needs ${other}, which is not locked`);
      }
      if (name === "" || link) continue;
      if (!integrity) problems.push(`${folder}: ${name} has no integrity`);
      if (resolved && !resolved.startsWith("https://registry.npmjs.org/")) problems.push(`${folder}: ${name} comes from ${resolved}`);
    }
  }
  for (const path of PIP) {
    for (const line of read(path).split("\n")) {
      if (line.trim() !== "" && !/^#|^[\w.[\]-]+==[\w.+-]+(\s*;.*)?$/.test(line)) problems.push(`${path}: "${line}" is not one version`);
    }
  }
  for (const entry of read("Cargo.lock").split("[[package]]").slice(1)) {
    const of = (key) => new RegExp(`^${key} = "(.*)"$`, "m").exec(entry)?.[1];
    const source = of("source");
    if (!source) continue;
    if (source !== "registry+https://github.com/rust-lang/crates.io-index") problems.push(`Cargo.lock: ${of("name")} comes from ${source}`);
    else if (!of("checksum")) problems.push(`Cargo.lock: ${of("name")} has no checksum`);
  }
}

/** The licenses that deny.toml allows, and its exceptions for single crates. */
function allowed() {
  const names = (list) => [...list.matchAll(/"([^"]+)"/g)].map(([, name]) => name);
  const text = read("deny.toml");
  const [, list] = /^\[licenses\][\s\S]*?^allow = \[([\s\S]*?)\]/m.exec(text);
  const exceptions = [...text.matchAll(/^\[\[licenses\.exceptions\]\]\ncrate = "(.+)"\nallow = \[(.*)\]/gm)];
  return { allow: names(list), besides: Object.fromEntries(exceptions.map(([, crate, more]) => [crate, names(more)])) };
}

/** All crates by name and version. Throws if Cargo.lock does not match the manifests. */
function crates(allow, besides) {
  const { packages } = JSON.parse(cargo("metadata", "--format-version=1", "--locked", "--all-features", "--filter-platform=x86_64-unknown-linux-gnu"));
  const wasm = JSON.parse(cargo("metadata", "--format-version=1", "--locked", "--all-features", "--filter-platform=wasm32-unknown-unknown"));
  const all = new Map([...packages, ...wasm.packages].map((one) => [`${one.name} ${one.version}`, one]));
  for (const [key, { name, license }] of all) {
    if (!chosen(license ?? "", [...allow, ...(besides[name] ?? [])])) problems.push(`${key} has the license ${license ?? "of a file alone"}, which deny.toml does not allow`);
  }
  return all;
}

/** Crates linked into a module, without build dependencies. */
function linked(name, feature) {
  const tree = ["tree", "--locked", "--package", name, "--no-default-features", "--features", feature, "--target", "wasm32-unknown-unknown"];
  const lines = cargo(...tree, "--edges", "normal,no-proc-macro", "--prefix", "none", "--format", "{p}").split("\n");
  const ours = (line) => line.includes(`(${root}`);
  const plain = (line) => line.replace(/ \(.*$/, "").replace(/^(\S+) v/, "$1 ");
  return new Set(lines.filter((line) => line && !ours(line)).map(plain));
}

/** License text without whitespace differences. */
const folded = (text) => text.replace(/\s+/g, " ").trim();

/** License text of a crate, from its own files. */
function words({ manifest_path: manifest }, license) {
  const folder = dirname(manifest);
  const files = readdirSync(folder).filter((file) => /^(licen[cs]e|copying|unlicense)/i.test(file));
  const of = license.split(/[- ]/)[0].toLowerCase();
  const own = files.find((file) => file.toLowerCase().includes(of)) ?? files.find((file) => /^licen[cs]e(\.(md|txt))?$/i.test(file));
  return own && readFileSync(join(folder, own), "utf8").replaceAll("\r\n", "\n").trim();
}

async function bundled(scripts) {
  const { build } = await import(join(root, "web/node_modules/esbuild/lib/main.js"));
  const { look } = await import(join(root, "web/look.mjs"));
  const entryPoints = scripts.map((path) => join(root, path));
  const external = ["epipole-web", "epipole-jobs", "epipole-lab*", "stix-two:*", "*.part.js"];
  const { metafile } = await build({
    absWorkingDir: root, entryPoints, external, bundle: true, write: false, metafile: true, outdir: "out", format: "esm", plugins: [look], logLevel: "error",
  });
  const names = Object.keys(metafile.inputs).map((path) => /node_modules\/((?:@[^/]+\/)?[^/]+)/.exec(path)?.[1]);
  return [...new Set(names.filter(Boolean))].sort();
}

async function thirdParty(all, allow, { of, modules, scripts, fonts: cut }) {
  const shipped = new Map();
  for (const [name, feature, where] of modules) {
    for (const key of linked(name, feature)) shipped.set(key, [...new Set([...(shipped.get(key) ?? []), where])]);
  }
  const texts = new Map();
  const keep = (text, who) => {
    const same = [...texts.keys()].find((known) => folded(known) === folded(text)) ?? text;
    texts.set(same, [...(texts.get(same) ?? []), who]);
  };
  const rows = [...shipped].sort(([a], [b]) => (a < b ? -1 : 1)).map(([key, where]) => {
    const crate = all.get(key);
    const license = chosen(crate.license, allow);
    // If a crate only contains the text of its other license, use that.
    const text = words(crate, license) ?? (license.includes("Apache") ? undefined : words(crate, "Apache"));
    if (text) keep(text, key);
    const source = text ? "" : ` | its package has no text: ${crate.authors.join(", ") || "its authors"}, ${crate.repository}`;
    return `${key} | ${license} | ${where.join(", ")}${source}`;
  });
  const packages = await bundled(scripts);
  const npm = packages.map((name) => {
    const { version, license } = JSON.parse(read(`web/node_modules/${name}/package.json`));
    const taken = chosen(license, allow);
    if (!taken) problems.push(`${name} has the license ${license}, which deny.toml does not allow`);
    const file = ["LICENSE", "LICENSE.md", "LICENSE.txt", "license"].find((one) => existsSync(join(root, "web/node_modules", name, one)));
    if (file) keep(read(`web/node_modules/${name}/${file}`).trim(), `${name} ${version}`);
    return `${name} ${version} | ${taken}`;
  });
  const fonts = cut.map(([name, license, path]) => {
    keep(read(path).replaceAll("\r\n", "\n").trim(), name);
    return `${name} | ${license}`;
  });
  const line = "=".repeat(80);
  return [
    `What is in ${of} and comes from others.`,
    "Written by `make bless-licenses`; `make check` compares.",
    `\n${line}\nCrates in the WebAssembly modules\n`,
    ...rows,
    "the Rust standard library | MIT, https://github.com/rust-lang/rust | all",
    "the scripts beside the modules, as wasm-bindgen writes them | MIT | all",
    `\n${line}\nnpm packages in the scripts\n`,
    ...(npm.length > 0 ? npm : ["none"]),
    `\n${line}\nFonts\n`,
    ...(fonts.length > 0 ? fonts : ["none"]),
    ...[...texts].map(([text, who]) => `\n${line}\n${who.join(", ")}\n\n${text}`),
    "",
  ].join("\n");
}

checkLocks();
const { allow, besides } = allowed();
const all = crates(allow, besides);
tell();
for (const list of LISTS) {
  const [path, text] = [join(root, list.file), await thirdParty(all, allow, list)];
  if (process.argv.includes("--bless")) writeFileSync(path, text);
  else if (!existsSync(path) || readFileSync(path, "utf8") !== text) {
    problems.push(`${list.file} is not what we ship: read the difference after \`make bless-licenses\``);
  }
}
tell();

function tell() {
  for (const problem of problems) console.error(problem);
  if (problems.length > 0) process.exit(1);
}
