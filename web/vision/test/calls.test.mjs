// Tests calls with good and bad input, in this thread and in a worker.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Vision, VisionError } from "../dist/index.js";
import { cameraOf, photograph } from "./scene.mjs";

/** A square, and the same moved by (2, 3) and scaled by 2. */
const SQUARE = [[0, 0], [100, 0], [100, 100], [0, 100]];
const moved = (pixels) => pixels.map(([u, v]) => [2 * u + 2, 2 * v + 3]);

/** Both ways of running. */
for (const worker of [false, true]) {
  const where = worker ? "in a worker" : "in this thread";
  const withVision = (name, body) =>
    test(`${name} ${where}`, async () => {
      const vision = await Vision.load({ worker });
      try {
        await body(vision);
      } finally {
        vision.close();
      }
    });

  withVision("a homography of four points is exact", async (vision) => {
    const [h] = await vision.homography4point(SQUARE, moved(SQUARE));
    const by = [2, 0, 2, 0, 2, 3, 0, 0, 1].map((number) => number / h[8] * h[8]);
    assert.equal(h.length, 9);
    h.forEach((number, index) => assert.ok(Math.abs(number / h[8] - by[index]) < 1e-12));
  });

  withVision("points may be interleaved or pairs, of any type of array", async (vision) => {
    const pairs = await vision.fitHomography(SQUARE, moved(SQUARE));
    for (const type of [Array, Float64Array, Float32Array, Uint8Array, Int16Array, Uint32Array]) {
      const [first, second] = [SQUARE, moved(SQUARE)].map((pixels) => type.from(pixels.flat()));
      assert.deepEqual(await vision.fitHomography(first, second), pairs, type.name);
    }
    assert.deepEqual(await vision.fitHomography(SQUARE.map((p) => Float64Array.from(p)), moved(SQUARE)), pairs);
  });

  withVision("results are plain objects that the caller owns", async (vision) => {
    const world = await vision.twoViewProblem({ numPoints: 60, outlierFraction: 0.2 });
    const report = await vision.estimateFundamental(world.pixels1, world.pixels2, { maxErrorPx: 0.5 });
    assert.deepEqual(Object.getPrototypeOf(report), Object.prototype);
    assert.ok(report.model instanceof Float64Array && report.inliers instanceof Uint8Array);
    assert.equal(report.inliers.reduce((sum, flag) => sum + flag), report.numInliers);
    assert.equal(report.stop, "confident");
    assert.deepEqual(structuredClone(report), report);
  });

  const bad = [
    ["a NaN", [[...SQUARE, [NaN, 1]], SQUARE], RangeError, "pixels1 contains NaN in row 4"],
    ["an odd number of numbers", [[1, 2, 3], SQUARE], RangeError, /^pixels1 must have 2 numbers for each row/],
    ["a point of three numbers", [[[1, 2, 3]], SQUARE], RangeError, "pixels1[0] must have 2 numbers, but has 3"],
    ["different lengths", [SQUARE, SQUARE.slice(1)], RangeError, /same size.* 4 .* 3$/],
    ["no second argument", [SQUARE], TypeError, /^pixels2 must be an array .* missing$/],
    ["a string", ["points", SQUARE], TypeError, /^pixels1 must be an array .* the string "points"$/],
    ["null", [null, SQUARE], TypeError, /^pixels1 must be an array .* missing$/],
    ["an object", [{}, SQUARE], TypeError, /^pixels1 must be an array .* an object$/],
    ["an unknown option", [SQUARE, SQUARE, { maxErorPx: 1 }], TypeError, /^options has no maxErorPx; it has maxErrorPx, /],
    ["an option in snake case", [SQUARE, SQUARE, { max_error_px: 1 }], TypeError, /^options has no max_error_px/],
    ["a string for a number", [SQUARE, SQUARE, { maxErrorPx: "1" }], TypeError, 'options.maxErrorPx must be a number, but is the string "1"'],
    ["NaN for a number", [SQUARE, SQUARE, { maxErrorPx: NaN }], RangeError, "options.maxErrorPx is NaN"],
    ["a negative threshold", [SQUARE, SQUARE, { maxErrorPx: -1 }], RangeError, /largest error .* -1$/],
    ["a fraction for a count", [SQUARE, SQUARE, { maxIterations: 1.5 }], RangeError, /^options.maxIterations must be an integer .* 1.5$/],
    ["a negative seed", [SQUARE, SQUARE, { seed: -1 }], RangeError, /^options.seed must be an integer .* -1$/],
    ["an unknown choice", [SQUARE, SQUARE, { sampler: "best" }], TypeError, 'options.sampler must be one of uniform, prosac, but is the string "best"'],
    ["options that are a number", [SQUARE, SQUARE, 3], TypeError, "options must be an object, but is 3"],
    ["too many arguments", [SQUARE, SQUARE, {}, 1], TypeError, "estimateHomography takes at most 3 arguments, but is given 4"],
    ["a signal that is none", [SQUARE, SQUARE, { signal: 1 }], TypeError, "options.signal must be an AbortSignal"],
    ["progress that is none", [SQUARE, SQUARE, { progress: 1 }], TypeError, "options.progress must be a function"],
  ];
  withVision("bad input is an error that names the argument", async (vision) => {
    for (const [what, given, type, message] of bad) {
      const problem = await vision.estimateHomography(...given).then(() => assert.fail(`${what} passes`), (error) => error);
      assert.equal(problem.constructor, type, `${what}: ${problem}`);
      if (typeof message === "string") assert.equal(problem.message, message);
      else assert.match(problem.message, message);
    }
    // The next call works.
    assert.equal((await vision.estimateHomography(SQUARE, moved(SQUARE))).numInliers, 4);
  });

  withVision("data without a result are a VisionError with a code", async (vision) => {
    const codeOf = (call) => call.then(() => assert.fail("no error"), (error) => {
      assert.ok(error instanceof VisionError, String(error));
      return error.code;
    });
    const line = [[0, 0], [1, 1], [2, 2], [3, 3], [4, 4], [5, 5]];
    assert.equal(await codeOf(vision.fitHomography(SQUARE.slice(1), SQUARE.slice(1))), "TooFew");
    const same = SQUARE.map(() => SQUARE[0]);
    await assert.rejects(vision.estimateHomography(same, same), { code: "TooFew", message: /the \d+ given are equal/ });
    assert.equal(await codeOf(vision.fitHomography(line, line)), "Degenerate");
    assert.equal(await codeOf(vision.estimateHomography(line, line)), "Degenerate");
  });

  withVision("bad cameras and poses name the field", async (vision) => {
    const { camera1, camera2, pixels1, pixels2 } = await vision.twoViewProblem();
    const camera = camera1.camera;
    const cases = [
      [{ ...camera, width: -1 }, RangeError, /^camera1.width must be an integer/],
      [{ ...camera, intrinsics: { ...camera.intrinsics, fuPx: 0 } }, RangeError, /^camera1.intrinsics: the focal length along u/],
      [{ ...camera, focal: 3 }, TypeError, /^camera1 has no focal; it has width/],
      [{ ...camera, lens: { kind: "fish", coefficients: [] } }, TypeError, /^camera1.lens.kind must be one of brown/],
      [{ ...camera, lens: { kind: "brown", coefficients: [1] } }, RangeError, /^camera1.lens: /],
      [undefined, TypeError, "camera1 must be an object, but is missing"],
    ];
    for (const [given, type, message] of cases) {
      await assert.rejects(vision.estimateEssential(pixels1, pixels2, given, camera), (problem) => {
        assert.equal(problem.constructor, type, String(problem));
        if (typeof message === "string") assert.equal(problem.message, message);
        else assert.match(problem.message, message);
        return true;
      });
    }
    const skewed = { ...camera2, camFromWorld: { rotation: [1, 0, 0, 0, 1, 0, 0, 1, 1] } };
    await assert.rejects(vision.fundamentalFromCameras(camera1, skewed), /^RangeError: camera2.camFromWorld.rotation must be a rotation/);
    const long = { ...camera2, camFromWorld: { quaternion: [1, 1, 0, 0] } };
    await assert.rejects(vision.fundamentalFromCameras(camera1, long), /^RangeError: camera2.camFromWorld.quaternion must have length 1/);
  });

  withVision("images are gray, color or floats, also an ImageData", async (vision) => {
    const [width, height] = [3, 2];
    const gray = Uint8Array.from([0, 51, 102, 153, 204, 255]);
    const rgba = Uint8ClampedArray.from([...gray].flatMap((value) => [value, value, value, 255]));
    const rgb = Uint8Array.from([...gray].flatMap((value) => [value, value, value]));
    const expected = { width, height, data: Float32Array.from(gray, (value) => value / 255) };
    for (const data of [gray, rgba, rgb, expected.data]) {
      assert.deepEqual(await vision.photoToGray({ width, height, data }), expected, `${data.length} values`);
    }
    // As in pages: an object whose properties are those of its prototype.
    if (!worker) {
      class ImageData {
        get width() { return width; }
        get height() { return height; }
        get data() { return rgba; }
      }
      assert.deepEqual(await vision.photoToGray(new ImageData()), expected);
    }
  });

  withVision("bad images name what is wrong", async (vision) => {
    const data = new Uint8Array(12);
    const cases = [
      [undefined, TypeError, "photo must be an image with width, height and data, but is missing"],
      [{ width: 4, height: 4, data }, RangeError, "photo.data must have 1, 3 or 4 bytes a pixel for 4 x 4 pixels, but has 12"],
      [{ width: 0, height: 4, data }, RangeError, "photo.width must be from 1 to 65535, but is 0"],
      [{ width: 3, height: 4.5, data }, RangeError, "photo.height must be an integer from 0 to 4294967295, but is 4.5"],
      [{ width: 3, height: 4 }, TypeError, "photo.data must be an array of bytes or floats, but is missing"],
      [{ width: 2, height: 1, data: Float32Array.of(0, NaN) }, RangeError, "photo has NaN at pixel (1, 0)"],
      [{ width: 2, height: 1, data: Float32Array.of(0, 200) }, RangeError, "photo must have gray values in [0, 1], but has 200; divide by the value of white"],
      [{ width: 2, height: 1, data: Float32Array.of(0) }, RangeError, "photo.data must have 1 float a pixel for 2 x 1 pixels, but has 1"],
    ];
    for (const [photo, type, message] of cases) {
      await assert.rejects(vision.photoToGray(photo), (problem) => {
        assert.equal(problem.message, message);
        assert.equal(problem.constructor, type);
        return true;
      });
    }
    const empty = { kind: "bytes", dimension: 128, data: new Float32Array(128) };
    await assert.rejects(vision.matchDescriptors(empty, empty), /^TypeError: descriptors1.data must be a Uint8Array/);
    const short = { kind: "bits", dimension: 256, data: new Uint8Array(31) };
    await assert.rejects(vision.matchDescriptors(short, short), /^RangeError: descriptors1 must have 256 bits each/);
    const left = { width: 4, height: 3, data };
    const right = { width: 4, height: 3, data: new Float32Array(12) };
    await assert.rejects(vision.stereoSgm(left, right), /^TypeError: left and right must be both bytes or both floats/);
    await assert.rejects(vision.stereoSgm(left, { width: 3, height: 4, data }), RangeError);
    await assert.rejects(vision.stereoBm(left, left, { numDisparities: 1e6 }), RangeError);
  });

  withVision("a Blob is an error where pictures cannot be decoded", async (vision) => {
    const file = new File([new Uint8Array(4)], "photo.jpg", { type: "image/jpeg" });
    const instead = "which cannot be decoded here: pass an object with width, height and data";
    await assert.rejects(vision.photoToGray(file), { name: "TypeError", message: `photo is a File, ${instead}` });
    await assert.rejects(vision.matchPhotos([new Blob([])]), { name: "TypeError", message: `photos[0] is a Blob, ${instead}` });
  });

  withVision("null turns off an option that is on by default, undefined leaves it", async (vision) => {
    const floats = (...rows) => ({ kind: "floats", dimension: 2, data: Float32Array.from(rows.flat()) });
    // The second neighbor is almost as near as the first.
    const [first, second] = [floats([0, 0]), floats([1, 0], [0, 1.01])];
    const count = async (options) => (await vision.matchDescriptors(first, second, options)).indices1.length;
    assert.deepEqual([await count(), await count({ maxRatio: undefined }), await count({ maxRatio: null })], [0, 0, 1]);
    await assert.rejects(count({ mutual: null }), /^TypeError: options.mutual must be true or false/);
  });

  withVision("features of two images match", async (vision) => {
    const [width, height] = [96, 64];
    // Blocks of random brightness, and the same two pixels to the left.
    const at = (u, v) => ((Math.floor(u / 7) * 7919 + Math.floor(v / 5) * 104729 + Math.floor(u / 7) * Math.floor(v / 5) * 31) % 251);
    const picture = (shift) => ({ width, height, data: Uint8Array.from({ length: width * height }, (_, i) => at((i % width) + shift, Math.floor(i / width))) });
    const [first, second] = await Promise.all([0, 2].map((shift) => vision.detectSift(picture(shift))));
    const { indices1, indices2 } = await vision.matchDescriptors(first.descriptors, second.descriptors);
    assert.ok(indices1.length > 20, `${indices1.length} matches`);
    const moved = [...indices1].map((index, k) => first.keypoints.points[2 * index] - second.keypoints.points[2 * indices2[k]]);
    assert.ok(moved.filter((shift) => Math.abs(shift - 2) < 0.3).length > 0.8 * moved.length);
  });

  withVision("a line has a slope, with and without outliers", async (vision) => {
    const points = [[0, 0], [1, 1], [2, 2], [3, 3], [4, 4], [0, 30]];
    const report = await vision.estimateLine(points, { maxErrorPx: 1 });
    assert.deepEqual([...report.inliers], [1, 1, 1, 1, 1, 0]);
    const slope = ([a, b]) => -a / b;
    const inliers = points.slice(0, 5);
    for (const line of [report.model, await vision.fitLineTotalLeastSquares(inliers), (await vision.leastMedianLine(points)).model]) {
      assert.ok(Math.abs(slope(line) - 1) < 1e-9, `${line}`);
    }
    assert.ok(Math.abs(slope(await vision.fitLineHuber(points.slice(0, 5), 1)) - 1) < 1e-9);
    assert.equal(await vision.numTrialsWithReplacement(0.5, 8, 0.99), 1177);
    assert.equal(await vision.numTrialsWithReplacement(0, 8, 0.99), Infinity);
    await assert.rejects(vision.numTrialsWithReplacement(1.5, 8, 0.99), /^RangeError: the inlier ratio .* 1.5$/);
  });

  withVision("the eight-point method shows its condition, which normalization lowers", async (vision) => {
    assert.deepEqual([...(await vision.epipolarRow([100, 50], [110, 48]))], [11000, 5500, 110, 4800, 2400, 48, 100, 50, 1]);
    // The numbers of NumPy in the chapter on the method.
    const pixels1 = [584, 385, 97, 341, 348, 351, 367, 137, 122, 60, 348, 304, 454, 201, 444, 264, 148, 194, 587, 368];
    const pixels2 = [506, 399, 114, 338, 335, 355, 371, 143, 88, 88, 366, 308, 375, 214, 456, 269, 159, 203, 612, 381];
    const raw = await vision.fundamental8pointUnnormalized(pixels1, pixels2);
    const found = await vision.fundamental8pointExplained(pixels1, pixels2);
    assert.equal(raw.conditionNumber.toFixed(0), "65203");
    assert.equal(found.conditionNumber.toFixed(1), "19.8");
    assert.deepEqual(found.fundamental, await vision.fundamental8point(pixels1, pixels2));
    const few = [pixels1, pixels2].map((pixels) => pixels.slice(0, 14));
    await assert.rejects(vision.fundamental8pointExplained(...few), { code: "TooFew" });
  });

  withVision("two views are general, planar or turned, and reconstructed", async (vision) => {
    const world = await vision.twoViewProblem({ numPoints: 80 });
    const { pixels1, pixels2, camera1, camera2, points } = world;
    const { camera } = camera1;
    assert.equal((await vision.estimateTwoView(pixels1, pixels2)).configuration, "general");
    const found = await vision.estimateTwoViewCalibrated(pixels1, pixels2, camera, camera2.camera);
    assert.deepEqual([found.kind, found.numInliers], ["essential", 80]);
    const wall = await vision.twoViewProblem({ numPoints: 80, structure: { plane: { halfSideM: 1 } } });
    const plane = await vision.estimateTwoView(wall.pixels1, wall.pixels2);
    assert.deepEqual([plane.configuration, plane.kind], ["planar", "homography"]);
    const scene = await vision.twoViewReconstruction(pixels1, pixels2, camera, camera2.camera, found.cam2FromCam1);
    assert.ok(scene.rmsPx < 1e-6 && scene.matchOfPoint.length === 80, `${scene.rmsPx}`);
    // The distance of the cameras is 1 there.
    const { translation } = await vision.relativeMotion(camera1.camFromWorld, camera2.camFromWorld);
    const length = Math.hypot(...translation);
    const seen = await vision.transformPoints(camera1.camFromWorld, points);
    scene.points.forEach((x, index) => assert.ok(Math.abs(length * x - seen[index]) < 1e-6));
    await assert.rejects(vision.estimateRotation(pixels1, pixels2, camera), /^TypeError: camera2 must be an object, but is missing$/);
  });

  withVision("an interval of depth may reach infinity", async (vision) => {
    const { nearM, farM } = await vision.depthInterval(700, 0.12, 30, 0.5);
    assert.ok(Math.abs(nearM - 84 / 30.5) < 1e-12 && Math.abs(farM - 84 / 29.5) < 1e-12);
    assert.equal((await vision.depthInterval(700, 0.12, 0.5, 1)).farM, null);
    await assert.rejects(vision.depthInterval(700, 0.12, 30, -1), RangeError);
  });

  withVision("gradients have the unit of the values", async (vision) => {
    const patch = { width: 3, height: 3, data: Float32Array.of(30, 60, 90, 40, 90, 140, 35, 120, 150) };
    const { du, dv, magnitude } = await vision.centeredDifference(patch, "replicate");
    assert.deepEqual([du.data[4], dv.data[4]], [50, 30]);
    assert.ok(Math.abs(magnitude.data[4] - Math.hypot(50, 30)) < 1e-5);
    const raw = await vision.sobel(patch, "replicate");
    assert.deepEqual([raw.du.data[4], raw.dv.data[4]], [375, 185]);
    const bytes = await vision.centeredDifference({ ...patch, data: Uint8Array.from(patch.data) }, "replicate");
    assert.ok(Math.abs(255 * bytes.du.data[4] - 50) < 1e-4);
    await assert.rejects(vision.sobel(patch, "wrap"), /^TypeError: border must be one of replicate, reflect101, constant, but is the string "wrap"$/);
  });

  withVision("a window of three gradients has the response that Harris gives", async (vision) => {
    const tensor = await vision.windowTensorFromGradients([[4, 0], [0, 3], [2, 2]]);
    assert.deepEqual([tensor.determinant, tensor.trace], [244, 33]);
    assert.ok(Math.abs((await vision.windowHarris(tensor, 0.04)) - 200.44) < 1e-9);
    await assert.rejects(vision.windowHarris(3, 0.04), /^TypeError: tensor must be an object with uu, uv and vv, but is 3$/);
  });

  withVision("transforms compose, invert, and move points", async (vision) => {
    const turn = { rotation: [0, -1, 0, 1, 0, 0, 0, 0, 1], translation: [1, 2, 3] };
    assert.deepEqual([...(await vision.transformPoints(turn, [[1, 0, 0]]))].map((x) => Math.round(1e9 * x) / 1e9), [1, 3, 3]);
    const { translation } = await vision.composeTransforms(await vision.invertTransform(turn), turn);
    assert.ok(Math.hypot(...translation) < 1e-12);
    assert.ok(Math.abs((await vision.rotationAngleRad(turn)) - Math.PI / 2) < 1e-12);
  });

  withVision("a bundle is refined, and its parts are checked", async (vision) => {
    const { observationIsInlier, ...world } = await vision.multiViewProblem({ numCameras: 3, numPoints: 20 });
    const moved = world.points.map((x, index) => x + 0.02 * ((index % 3) - 1));
    const { bundle, report } = await vision.adjustBundle({ ...world, points: moved });
    assert.ok(report.finalCost < 1e-9 * report.initialCost, `${report.initialCost} to ${report.finalCost}`);
    assert.deepEqual([report.history[0].index, report.history.at(-1).cost], [0, report.finalCost]);
    // The result is a bundle again.
    assert.ok((await vision.adjustBundle(bundle)).report.initialCost <= report.finalCost + 1e-12);
    const cases = [
      [{ ...world, observationCamera: [0, 1] }, RangeError, /^bundle.observationCamera must have 60 numbers, one for each pixel, but has 2$/],
      [{ ...world, observationPoint: world.observationPoint.map(() => 99) }, RangeError, /99/],
      [{ ...world, lensOfCamera: [0, -1] }, RangeError, "bundle.lensOfCamera must contain integers from 0 to 4294967295, but contains -1"],
      [{ ...world, observationIsInlier }, TypeError, /^bundle has no observationIsInlier; it has cameras, points/],
      [{ ...world, cameras: undefined }, TypeError, "bundle.cameras must be an array, but is missing"],
    ];
    for (const [given, type, message] of cases) {
      await assert.rejects(vision.adjustBundle(given), (problem) => {
        if (typeof message === "string") assert.equal(problem.message, message);
        else assert.match(problem.message, message);
        assert.equal(problem.constructor, type);
        return true;
      });
    }
    await assert.rejects(vision.adjustBundle(world, { heldPoints: [1] }), /^TypeError: options.heldPoints\[0\] must be true or false, but is 1$/);
  });

  withVision("images are warped, of any kind", async (vision) => {
    const image = { width: 3, height: 1, data: Uint8Array.of(10, 20, 30) };
    const right = [[1, 0, 1], [0, 1, 0], [0, 0, 1]];
    assert.deepEqual((await vision.warpPerspective(image, right)).data, Uint8Array.of(0, 10, 20));
    assert.deepEqual((await vision.warpAffine(image, right.slice(0, 2), { width: 4 })).data, Uint8Array.of(0, 10, 20, 30));
    const constant = { border: { constant: 7 }, interpolation: "bicubic" };
    assert.deepEqual((await vision.warpPerspective(image, right, constant)).data[0], 7);
    await assert.rejects(vision.warpAffine(image, right), /^RangeError: outFromImage must have 6 numbers, but has 9$/);
    await assert.rejects(vision.warpPerspective(image, [1, 0, 0, 0, 1, 0, 0, 0, 0]), { code: "Degenerate" });
    await assert.rejects(vision.warpPerspective(image, right, { width: 70000 }), /^RangeError: options must have sides from 1 to 65535 pixels, but has 70000 x 1$/);
  });

  withVision("a photo is undistorted at once and by its map", async (vision) => {
    const [width, height] = [64, 48];
    const camera = {
      width,
      height,
      intrinsics: { fuPx: 60, fvPx: 60, cuPx: 31.5, cvPx: 23.5 },
      lens: { kind: "brown", coefficients: [-0.2, 0, 0, 0, 0] },
    };
    const image = { width, height, data: Uint8Array.from({ length: width * height }, (_, i) => (i * 37) % 251) };
    const { map, intrinsics, valid } = await vision.undistortionMap(camera);
    const { image: flat } = await vision.undistortImage(image, camera);
    assert.deepEqual(await vision.remap(image, map), flat);
    assert.ok(intrinsics.fuPx < 60 && valid.uMax <= 63, `${intrinsics.fuPx} ${valid.uMax}`);
    await assert.rejects(vision.undistortImage(image, { ...camera, width: 63 }), /^RangeError: image must have the size of its camera, 63 x 48, but has 64 x 48$/);
    await assert.rejects(vision.undistortImage(image, camera, "most"), /^TypeError: keep must be one of valid, all, but is the string "most"$/);
    await assert.rejects(vision.remap(image, { ...map, width: 3 }), /^RangeError: map.sources must have 288 numbers for 3 x 48 pixels, but has 6144$/);
  });

  withVision("photos of a board calibrate the camera that took them", async (vision) => {
    const board = { pattern: "chessboard", columns: 7, rows: 5, squareM: 0.03 };
    const camera = {
      width: 320,
      height: 240,
      intrinsics: { fuPx: 300, fvPx: 300, cuPx: 159.5, cvPx: 119.5 },
      lens: { kind: "brown", coefficients: [-0.05, 0.01, 0, 0, 0] },
    };
    const views = [];
    for (const [x, y] of [[0.28, 0], [-0.28, 0], [0, 0.28], [0, -0.28]]) {
      const pose = { quaternion: [0.96, x, y, 0], translation: [-0.09 + 0.1 * y, -0.06, 0.35] };
      const photo = await vision.renderBoard(board, camera, pose);
      const { pixels, numVisible, problem } = await vision.findBoard(photo, board);
      assert.deepEqual([numVisible, problem], [35, null]);
      views.push(pixels);
    }
    const found = await vision.calibrate(board, [...views, null], 320, 240);
    assert.ok(Math.abs(found.camera.intrinsics.fuPx - 300) < 2, `${found.camera.intrinsics.fuPx}`);
    assert.ok(found.rmsPx < 0.1, `${found.rmsPx}`);
    assert.deepEqual([found.views.length, found.views[4]], [5, null]);
    const dark = { width: 64, height: 48, data: new Uint8Array(64 * 48) };
    const { pixels, problem } = await vision.findBoard(dark, board);
    assert.deepEqual([pixels, typeof problem], [null, "string"]);
    await assert.rejects(vision.findBoard(dark, board, { size: 3 }), /^TypeError: options has no size; it has signal, progress$/);
    await assert.rejects(vision.findBoard(dark, { ...board, pattern: "checkers" }), /^TypeError: board.pattern must be one of chessboard, circles/);
    await assert.rejects(vision.findBoard(dark, { ...board, rows: 1 }), /^RangeError: board: the number of a board's rows/);
    await assert.rejects(vision.calibrate(board, [views[0].slice(2)], 320, 240), RangeError);
    await assert.rejects(vision.detectMarkers(dark, "4x4"), /^TypeError: dictionary must be one of Aruco4x4_50, /);
  });

  withVision("photos become cameras and points, with progress, until aborted", async (vision) => {
    const cameras = [cameraOf(160, 120, 150)];
    const photos = [0, 0.25, 0.5, 0.75].map((along) => photograph(cameras[0], { center: [along, 0, 0] }));
    const stages = new Set();
    const progress = (stage) => stages.add(stage);
    const { images, pairs, result } = await vision.reconstructPhotos(photos, cameras, {}, { progress });
    assert.deepEqual([images.length, pairs.length, result.unregistered.length], [4, 6, 0]);
    assert.ok(stages.size > 2, [...stages].join());
    const [{ points, colors, cameras: found }] = result.components;
    assert.ok(points.length > 300 && colors.length === points.length);
    const step = await vision.relativeMotion(found[0].camFromWorld, found[1].camFromWorld);
    const [x, ...rest] = step.translation;
    assert.ok(Math.abs(x) > 20 * Math.hypot(...rest), `${step.translation}`);
    // The same from its parts.
    assert.deepEqual((await vision.reconstruct(images, cameras, pairs)).components, result.components);
    const controller = new AbortController();
    const signal = controller.signal;
    const abort = () => controller.abort();
    await assert.rejects(vision.reconstructPhotos(photos, cameras, {}, { signal, progress: abort }), { name: "AbortError" });
    await assert.rejects(vision.reconstructPhotos(photos, []), RangeError);
    await assert.rejects(vision.reconstructPhotos(photos.slice(1), cameras, { neighbours: 2 }), /^TypeError: photoOptions has no neighbours; it has features/);
    await assert.rejects(vision.reconstruct(images, cameras, [{ image1: 0, image2: 1, matches: { indices1: [0], indices2: [] } }]), {
      name: "RangeError",
      message: "pairs[0].matches.indices2 must have 1 numbers, as many as indices1, but has 0",
    });
    const floats = { width: 1, height: 1, data: Float32Array.of(0) };
    await assert.rejects(vision.matchPhotos([floats]), /^TypeError: photos\[0\] must be an image of bytes, but has floats$/);
  });

  withVision("a loop of poses closes", async (vision) => {
    const quarter = { rotation: [0, 0, 1, 0, 1, 0, -1, 0, 0], translation: [0, 0, 1] };
    const edges = [0, 1, 2, 3].map((from) => ({ from, to: (from + 1) % 4, fromFromTo: quarter }));
    const { worldFromVertex, report } = await vision.optimizePoseGraph(edges, 4);
    assert.ok(report.finalChi2 < 1e-12, `${report.finalChi2}`);
    assert.ok(Math.abs(Math.hypot(...worldFromVertex[2].translation) - Math.SQRT2) < 1e-6);
    const turns = edges.map(({ from, to }) => ({ from, to, toFromFrom: quarter }));
    const { errorsRad } = await vision.averageRotations(turns, 4);
    assert.ok(errorsRad.every((error) => error < 1e-6));
    await assert.rejects(vision.optimizePoseGraph(edges, 3), RangeError);
    await assert.rejects(vision.averageRotations(turns, 2 ** 21), /^RangeError: numViews must be at most 1048576, but is 2097152$/);
  });

  withVision("a detached buffer is an error", async (vision) => {
    const pixels = Float64Array.from(SQUARE.flat());
    structuredClone(pixels, { transfer: [pixels.buffer] });
    await assert.rejects(vision.fitHomography(pixels, SQUARE), {
      name: "TypeError",
      message: "pixels1 is detached: its buffer was transferred",
    });
    await assert.rejects(vision.fitHomography([pixels], SQUARE), /pixels1.0 is detached/);
    // An array that is only empty is none.
    await assert.rejects(vision.fitHomography(new Float64Array(0), []), { code: "TooFew" });
  });

  withVision("values that are no data are errors", async (vision) => {
    const ring = [];
    ring.push(ring);
    for (const value of [() => 1, Symbol("x"), 10n, ring, new Map()]) {
      await assert.rejects(vision.fitHomography(value, SQUARE), TypeError);
    }
    assert.equal((await vision.fitHomography(SQUARE, moved(SQUARE))).length, 9);
  });

  withVision("an aborted signal rejects with its reason", async (vision) => {
    await assert.rejects(vision.estimateHomography(SQUARE, SQUARE, { signal: AbortSignal.abort() }), { name: "AbortError" });
    const reason = new Error("enough");
    await assert.rejects(vision.estimateHomography(SQUARE, SQUARE, { signal: AbortSignal.abort(reason) }), reason);
    assert.equal((await vision.estimateHomography(SQUARE, moved(SQUARE))).numInliers, 4);
  });

  withVision("progress reports stages, and abort or an error in it ends the call", async (vision) => {
    const world = await vision.twoViewProblem({ numPoints: 3000, outlierFraction: 0.6, noisePx: 0.5 });
    const slow = { minIterations: 20000, maxIterations: 20000 };
    const estimate = (options) => vision.estimateFundamental(world.pixels1, world.pixels2, { ...slow, ...options });
    const seen = [];
    await estimate({ progress: (stage, fraction) => seen.push([stage, fraction]) });
    assert.ok(seen.length > 2, `${seen.length} reports`);
    assert.ok(seen.every(([stage]) => stage === "drawing samples"));
    assert.ok(seen.every(([, fraction], index) => fraction >= (seen[index - 1]?.[1] ?? 0) && fraction <= 1));
    const controller = new AbortController();
    const start = performance.now();
    await assert.rejects(estimate({ signal: controller.signal, progress: () => controller.abort() }), { name: "AbortError" });
    await assert.rejects(estimate({ progress: () => { throw new Error("mine"); } }), /mine/);
    assert.ok(performance.now() - start < 5000);
    assert.equal((await vision.estimateHomography(SQUARE, moved(SQUARE))).numInliers, 4);
  });

  withVision("a closed Vision refuses calls", async (vision) => {
    await vision.fitHomography(SQUARE, SQUARE);
    const running = vision.fitHomography(SQUARE, SQUARE);
    vision.close();
    vision.close();
    await assert.rejects(running, /this Vision is closed/);
    await assert.rejects(vision.fitHomography(SQUARE, SQUARE), /this Vision is closed/);
  });

  test(`two loads at once are independent ${where}`, async () => {
    const [first, second] = await Promise.all([
      Vision.load({ worker, parts: ["homography"] }),
      Vision.load({ worker, parts: ["homography", "geometry"] }),
    ]);
    const results = await Promise.all([first, second, first].map((vision) => vision.fitHomography(SQUARE, moved(SQUARE))));
    assert.deepEqual(results[0], results[1]);
    first[Symbol.dispose]();
    await assert.rejects(first.fitHomography(SQUARE, SQUARE), /closed/);
    assert.deepEqual(await second.fitHomography(SQUARE, moved(SQUARE)), results[0]);
    second.close();
  });
}

test("abort of a waiting call leaves the others", async () => {
  const vision = await Vision.load({ worker: true });
  const world = await vision.twoViewProblem({ numPoints: 2000, outlierFraction: 0.5 });
  const long = vision.estimateFundamental(world.pixels1, world.pixels2, { minIterations: 3000 });
  const controller = new AbortController();
  const waiting = vision.estimateHomography(SQUARE, SQUARE, { signal: controller.signal });
  const last = vision.fitHomography(SQUARE, SQUARE);
  controller.abort();
  await assert.rejects(waiting, { name: "AbortError" });
  assert.ok((await long).numInliers > 900);
  assert.equal((await last).length, 9);
  vision.close();
});

test("abort of a running call starts another worker for the next", async () => {
  const vision = await Vision.load({ worker: true });
  const world = await vision.twoViewProblem({ numPoints: 3000, outlierFraction: 0.6 });
  const signal = AbortSignal.timeout(50);
  const endless = { minIterations: 1e9, maxIterations: 1e9, signal };
  const long = vision.estimateFundamental(world.pixels1, world.pixels2, endless);
  const next = vision.fitHomography(SQUARE, SQUARE);
  await assert.rejects(long, { name: "TimeoutError" });
  assert.equal((await next).length, 9);
  vision.close();
});

test("unknown options of load are errors", async () => {
  await assert.rejects(Vision.load({ workers: true }), /^TypeError: Vision.load has no option workers/);
  await assert.rejects(Vision.load({ worker: 1 }), /^TypeError: worker must be true or false, but is 1/);
  await assert.rejects(Vision.load({ parts: ["hough"] }), /^TypeError: there is no part hough; the parts are homography/);
});

test("a process ends without closing", async () => {
  const { execFileSync } = await import("node:child_process");
  const index = new URL("../dist/index.js", import.meta.url).href;
  const code = `import { Vision } from ${JSON.stringify(index)};
    const vision = await Vision.load({ worker: true });
    console.log((await vision.fitHomography([0, 0, 1, 0, 1, 1, 0, 1], [0, 0, 1, 0, 1, 1, 0, 1])).length);`;
  const out = execFileSync(process.execPath, ["--input-type=module", "-e", code], { timeout: 20_000, encoding: "utf8" });
  assert.equal(out, "9\n");
});
