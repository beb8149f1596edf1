// Tests the package itself: the examples of the README, its files, and their size.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { brotliCompressSync, constants } from "node:zlib";
import { PNG } from "pngjs";
import { FUNCTIONS } from "../dist/api.js";
import { Vision } from "../dist/index.js";
import { cameraOf, inColor, photograph, seenAt, turn } from "./scene.mjs";

const folder = new URL("../", import.meta.url);
const read = (path) => readFileSync(new URL(path, folder));

/** Path of an installed program. */
const tool = (name) => fileURLToPath(new URL(`../node_modules/.bin/${name}`, folder));

/** Size as a server sends it, bytes. */
function brotli(...paths) {
  const params = { [constants.BROTLI_PARAM_QUALITY]: 11, [constants.BROTLI_PARAM_LGWIN]: 24 };
  return paths.map((path) => brotliCompressSync(read(path), { params }).length).reduce((sum, size) => sum + size);
}

/** A program of a user, compiled without skipping the types of libraries. */
const USE = `import { Vision, VisionError, type RansacReport } from "@epipole/vision";
const vision: Vision = await Vision.load({ worker: false, parts: ["homography"] });
const pixels = new Float64Array(8);
const report: RansacReport<Float64Array> = await vision.estimateHomography(pixels, [[0, 1]], {
  maxErrorPx: 2,
  sampler: "prosac",
  signal: AbortSignal.timeout(100),
  progress: (stage, fraction) => console.log(stage.length, fraction.toFixed(2)),
});
const world = await vision.twoViewProblem({ structure: { plane: { halfSideM: 1 } } });
const pose = await vision.estimateRelativePose(world.pixels1, world.pixels2, world.camera1.camera, world.camera2.camera);
await vision.refineHomography(report.model, pixels, pixels, { huber: { width: 1 } });
await vision.fundamentalFromCameras(world.camera1, { camera: world.camera2.camera, camFromWorld: { translation: [0, 0, 1] } });
const bitmap: ImageBitmap = await createImageBitmap(new Blob([]));
await vision.photoToGray(bitmap);
const photos = [new File([], "photo.jpg"), bitmap];
const { images, result } = await vision.reconstructPhotos(photos, [world.camera1.camera], { neighbors: 2 }, { seed: 1 });
const [scene] = result.components;
const views = await vision.prepareViews(scene, photos);
const mesh = await vision.meshDepthMaps(views, await vision.estimateDepthMaps(views, { minViews: 2 }));
const texture: Uint8Array = (await vision.textureMesh(mesh, views)).image.data;
const features = await Promise.all(photos.map((photo) => vision.photoFeatures(photo)));
await vision.localize(scene, features, features[0], world.camera1.camera, { minNumInliers: 20 });
await vision.moveReconstruction(scene, await vision.alignPoints(scene.points, mesh.vertices.points, "rigid"));
await vision.refineLenses(scene, images);
const overlap = await vision.findOverlap(0, 1, pixels, pixels, { ransac: { maxErrorPx: 2 } });
if (overlap !== null) {
  const placed = await vision.chainHomographies(2, [overlap]);
  await vision.renderPanorama(placed, photos, { surface: "plane" });
  await vision.estimatePanorama([world.camera1.camera.intrinsics], [overlap], true, { signal: AbortSignal.timeout(100) });
}
const image = { width: 2, height: 1, data: new Uint8ClampedArray(8) };
const sift = await vision.detectSift(image as ImageData, { maxFeatures: 10 });
await vision.matchDescriptors(sift.descriptors, sift.descriptors);
const { bundle } = await vision.adjustBundle(
  { cameras: [world.camera1], points: [[0, 0, 1]], observationCamera: [0], observationPoint: [0], observationPixel: [[1, 2]] },
  { positionPriors: [null, { centerInWorld: [0, 0, 1], sigma: [1, 1, 1] }], heldCameras: [true] },
);
await vision.adjustBundle(bundle);
console.log(texture.length, pose.model.direction[0], report.log10FalseAlarms?.toFixed(1), VisionError.name);
vision[Symbol.dispose]();
// @ts-expect-error
await vision.estimateHomography(pixels);
// @ts-expect-error
await vision.estimateHomography(pixels, pixels, { maxErorPx: 1 });
// @ts-expect-error
await vision.estimateHomography(pixels, pixels, { sampler: "best" });
// @ts-expect-error
await vision.estimateHomography("pixels", 3);
// @ts-expect-error
await Vision.load({ parts: ["hough"] });
// @ts-expect-error
new Vision();
`;

const readme = read("README.md").toString();
const examples = new Map([...readme.matchAll(/^## (.*)\n```js\n([\s\S]*?)```/gm)].map(([, title, code]) => [title, code]));
const CAMERA = cameraOf(480, 320, 400);
/** Pose of the right camera; that of the left one is the identity. */
const CENTER = [0.3, 0.02, 0.05];
const ROTATION = turn(0.02, -0.05, 0.01);
const TRANSLATION = [0, 3, 6].map((row) => -CENTER.reduce((sum, place, k) => sum + ROTATION[row + k] * place, 0));

/** Output of an example, run beside two photos and their rig. */
function run(title) {
  const temporary = mkdtempSync(join(tmpdir(), "vision-readme-"));
  try {
    mkdirSync(join(temporary, "node_modules/@epipole"), { recursive: true });
    symlinkSync(fileURLToPath(folder), join(temporary, "node_modules/@epipole/vision"));
    symlinkSync(fileURLToPath(new URL("../node_modules/pngjs", folder)), join(temporary, "node_modules/pngjs"));
    const right = { center: CENTER, rotation: ROTATION };
    for (const [name, pose] of [["left.png", {}], ["right.png", right]]) {
      writeFileSync(join(temporary, name), PNG.sync.write(Object.assign(new PNG(), inColor(photograph(CAMERA, pose)))));
    }
    const rig = { leftCamera: CAMERA, rightCamera: CAMERA, rightFromLeft: { rotation: ROTATION, translation: TRANSLATION } };
    writeFileSync(join(temporary, "rig.json"), JSON.stringify(rig));
    writeFileSync(join(temporary, "example.mjs"), examples.get(title));
    return execFileSync(process.execPath, ["example.mjs"], { cwd: temporary, timeout: 30_000, encoding: "utf8" });
  } finally {
    rmSync(temporary, { recursive: true });
  }
}

const numbersIn = (text) => text.match(/-?\d+(\.\d+)?(e-?\d+)?/g).map(Number);
/** Norm of the difference of two vectors or matrices: for unit vectors their angle, if it is small. */
const distance = (first, second) => Math.hypot(...first.map((number, k) => number - second[k]));

test("the README has an example of each use", () => {
  assert.deepEqual([...examples.keys()], [
    "A panorama in a page",
    "The pose from two photographs",
    "A rig to depth",
    "ORB and a homography over a webcam",
    "SIFT in Node",
  ]);
});

test("the example of a pose finds the motion between the photos", () => {
  const [rotation, direction] = run("The pose from two photographs").split("t along").map(numbersIn);
  const length = Math.hypot(...TRANSLATION);
  assert.equal(rotation.length, 9);
  assert.ok(distance(rotation, ROTATION) < 0.003, `${rotation} is not ${ROTATION}`);
  assert.ok(distance(direction, TRANSLATION.map((part) => part / length)) < 0.01, `${direction}`);
});

test("the example of a rig measures the depth of the wall", async () => {
  const vision = await Vision.load();
  const rightFromLeft = { rotation: ROTATION, translation: TRANSLATION };
  const { intrinsics1, rotation1, width, height } = await vision.rectifyCalibrated(CAMERA, CAMERA, rightFromLeft);
  const { depth } = seenAt({ intrinsics: intrinsics1 }, width >> 1, height >> 1, { rotation: rotation1 });
  const [measured] = numbersIn(run("A rig to depth"));
  assert.ok(Math.abs(measured - depth) < 0.01 * depth, `${measured} m, but the wall is at ${depth} m`);
});

test("the example of SIFT finds features", () => {
  const [count, dimension] = numbersIn(run("SIFT in Node"));
  assert.ok(count > 100, `${count} features`);
  assert.equal(dimension, 128);
});

test("the package contains scripts, modules, types and licenses, and no dependency", () => {
  const { dependencies } = JSON.parse(read("package.json"));
  assert.equal(dependencies, undefined);
  const pack = ["pack", "--dry-run", "--json", "--ignore-scripts"];
  const [{ files }] = JSON.parse(execFileSync("npm", pack, { cwd: fileURLToPath(folder), encoding: "utf8" }));
  const names = files.map(({ path }) => path);
  for (const name of ["index.js", "index.d.ts", "api.d.ts", "worker.js", "THIRD-PARTY.txt", "LICENSE-MIT", "LICENSE-APACHE"]) {
    assert.ok(names.includes(`dist/${name}`), name);
  }
  const scripts = names.filter((name) => name.endsWith(".js"));
  for (const name of scripts) {
    for (const [, path] of read(name).toString().matchAll(/(?:from|import|import\(|URL\() ?"(\.\/[^"]+)"/g)) {
      assert.ok(names.includes(new URL(path, `file:///${name}`).pathname.slice(1)), `${name} needs ${path}`);
    }
  }
});

test("publint and arethetypeswrong find nothing", () => {
  const temporary = mkdtempSync(join(tmpdir(), "vision-pack-"));
  try {
    const pack = ["pack", "--json", "--ignore-scripts", "--pack-destination", temporary];
    const [{ filename }] = JSON.parse(execFileSync("npm", pack, { cwd: fileURLToPath(folder), encoding: "utf8" }));
    const packed = join(temporary, filename);
    const options = { encoding: "utf8", stdio: "pipe" };
    assert.match(execFileSync(tool("publint"), ["run", packed, "--strict"], options), /All good!/);
    // The package has modules only; scripts of CommonJS import it dynamically.
    execFileSync(tool("attw"), [packed, "--profile", "esm-only", "--no-definitely-typed"], options);
  } finally {
    rmSync(temporary, { recursive: true });
  }
});

test("the reference has every function and loads nothing from other servers", () => {
  const temporary = mkdtempSync(join(tmpdir(), "vision-docs-"));
  try {
    const options = ["--options", fileURLToPath(new URL("typedoc.json", folder)), "--out", temporary];
    execFileSync(tool("typedoc"), options, { stdio: "pipe" });
    const pages = readdirSync(temporary, { recursive: true }).filter((name) => /\.(html|css)$/.test(name));
    assert.ok(pages.length > 100, `${pages.length} pages`);
    for (const name of pages) {
      const text = readFileSync(join(temporary, name), "utf8");
      const loaded = /<(?:script|link|img|iframe)\b[^>]*(?:src|href)="([^"]*)"|url\(([^)]*)\)|@import ([^;]*)/g;
      for (const [, ...found] of text.matchAll(loaded)) {
        const address = found.find(Boolean) ?? "";
        assert.ok(!/^["']?(https?:|\/)/.test(address), `${name} loads ${address}`);
      }
    }
    const methods = readFileSync(join(temporary, "classes/Vision.html"), "utf8").toLowerCase();
    for (const name of Object.keys(FUNCTIONS)) assert.ok(methods.includes(`id="${name.toLowerCase()}"`), name);
  } finally {
    rmSync(temporary, { recursive: true });
  }
});

test("types accept good calls, and refuse bad ones", () => {
  const temporary = mkdtempSync(join(tmpdir(), "vision-types-"));
  try {
    const index = fileURLToPath(new URL("dist/index.js", folder));
    writeFileSync(join(temporary, "use.mts"), USE.replace("@epipole/vision", index));
    const require = createRequire(new URL("../package.json", folder));
    const options = ["--noEmit", "--strict", "--module", "nodenext", "--target", "es2022", "--lib", "es2022,dom"];
    execFileSync(process.execPath, [require.resolve("typescript/bin/tsc"), ...options, "use.mts"], { cwd: temporary, encoding: "utf8" });
  } finally {
    rmSync(temporary, { recursive: true });
  }
});

test("a homography costs a page at most 90 KB, everything at most 760 KB", (t) => {
  const files = readdirSync(new URL("dist", folder), { recursive: true });
  const scripts = brotli(...files.filter((name) => name.endsWith(".js")).map((name) => `dist/${name}`));
  t.diagnostic(`scripts: ${(scripts / 1000).toFixed(1)} KB`);
  const sizes = {};
  for (const name of files.filter((name) => name.endsWith(".wasm"))) {
    const part = name.replace(/.*[/\\]|\.wasm/g, "");
    sizes[part] = brotli(`dist/${name}`);
    t.diagnostic(`${part}: ${(sizes[part] / 1000).toFixed(1)} KB`);
    const [, said] = new RegExp(`\\| \`${part}\` \\|.*\\| (\\d+) KB`).exec(readme) ?? [];
    assert.ok(Math.abs(sizes[part] / 1000 - said) < 0.05 * said, `the README says ${said} KB for ${part}`);
  }
  assert.ok(scripts + sizes.homography <= 90_000);
  assert.ok(scripts + sizes.all <= 760_000);
});
