// Tests dense stereo, localization, odometry and panoramas against the truth of a scene.

import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { Vision } from "../dist/index.js";
import { cameraOf, photograph, seenAt, turn } from "./scene.mjs";

const CAMERA = cameraOf(160, 120, 150);
const PLACES = [0, 0.25, 0.5, 0.75];
const PHOTOS = PLACES.map((along) => photograph(CAMERA, { center: [along, 0, 0] }));
const POSES = PLACES.map((along) => ({ translation: [-along, 0, 0] }));

/** Distance of a point from the two walls, along z. */
const offWalls = ([x, , z]) => Math.abs(z - 4 + 0.5 * Math.abs(x));
const pointsOf = (list) => Array.from({ length: list.length / 3 }, (_, k) => list.slice(3 * k, 3 * k + 3));
const median = (numbers) => numbers.sort((a, b) => a - b)[numbers.length >> 1];

let vision, features, input, scene;
before(async () => {
  vision = await Vision.load({ worker: true, parts: ["all"] });
  features = await Promise.all(PHOTOS.map((photo) => vision.photoFeatures(photo)));
  input = [features.map(({ image }) => image), [CAMERA], await vision.matchFeatures(features)];
  scene = await vision.triangulateTracks(...input, POSES);
});
after(() => vision.close());

test("points of known poses are on the walls", async () => {
  const points = pointsOf(scene.points);
  assert.ok(points.length > 300, `${points.length}`);
  assert.ok(median(points.map(offWalls)) < 0.02);
  assert.ok((await vision.meanReprojectionPx(scene, input[0])) < 0.5);
});

test("a photo is localized among the others", async () => {
  const [known, others] = [[0, 1, 3].map((k) => input[0][k]), [0, 1, 3].map((k) => features[k])];
  const pairs = await vision.matchFeatures(others);
  const poses = [0, 1, 3].map((k) => POSES[k]);
  const model = await vision.triangulateTracks(known, [CAMERA], pairs, poses);
  const { camFromWorld, inlierPoints } = await vision.localize(model, others, features[2], CAMERA);
  assert.ok(inlierPoints.length > 50, `${inlierPoints.length}`);
  const [x, y, z] = camFromWorld.translation;
  assert.ok(Math.hypot(x + 0.5, y, z) < 0.02, `${camFromWorld.translation}`);
  await assert.rejects(vision.localize(model, features, features[2], CAMERA), RangeError);
});

test("odometry follows the camera", async () => {
  const { worldFromCam, lost } = await vision.monocularOdometry(...input);
  assert.equal(lost.length, 0);
  // The unit of length is arbitrary, the frame that of the first camera.
  const step = worldFromCam[3].translation[0] / 3;
  worldFromCam.forEach(({ translation: [x, y, z] }, k) => {
    assert.ok(Math.hypot(x - k * step, y, z) < 0.05 * step, `${k}: ${[x, y, z]}`);
  });
  const { translation } = await vision.relativePoseError(worldFromCam, worldFromCam);
  assert.equal(translation.max, 0);
});

test("depth maps show the walls, and a texture their mesh, until aborted", async () => {
  const views = await vision.prepareViews(scene, PHOTOS);
  const maps = await vision.estimateDepthMaps(views);
  const { depth } = maps[1];
  const errors = [];
  depth.data.forEach((z, place) => {
    const truth = seenAt(CAMERA, place % 160, Math.floor(place / 160), { center: [PLACES[1], 0, 0] });
    if (!Number.isNaN(z)) errors.push(Math.abs(z / truth.depth - 1));
  });
  assert.ok(errors.length > 0.5 * depth.data.length, `${errors.length}`);
  assert.ok(median(errors) < 0.005);
  const cloud = await vision.fuseDepthMaps(views, maps);
  assert.ok(median(pointsOf(cloud.points).map(offWalls)) < 0.02);
  const mesh = await vision.meshDepthMaps(views, maps);
  assert.ok(mesh.triangles.length > 3000 && median(pointsOf(mesh.vertices.points).map(offWalls)) < 0.03);
  const { image, corners } = await vision.textureMesh(mesh, views, { maxSizePx: 512 });
  assert.equal(corners.length, 2 * mesh.triangles.length);
  assert.ok(corners.every((number, k) => number >= -0.5 && number <= (k % 2 ? image.height : image.width) - 0.5));
  const controller = new AbortController();
  const options = { signal: controller.signal, progress: () => controller.abort() };
  await assert.rejects(vision.estimateDepthMaps(views, options), { name: "AbortError" });
  await assert.rejects(vision.prepareViews({ ...scene, observationImage: scene.observationImage.map(() => 9) }, PHOTOS), {
    name: "RangeError",
    message: /^reconstruction has an observation of point 0 in photo 9, but has \d+ points and 4 cameras$/,
  });
});

test("rotated photos become a panorama", async () => {
  const photos = [0, 0.4].map((angle) => photograph(CAMERA, { rotation: turn(0, -angle, 0) }));
  const { images, pairs: [{ matches }] } = await vision.matchPhotos(photos);
  const at = ({ keypoints }, list) => Array.from(list, (k) => keypoints.subarray(2 * k, 2 * k + 2));
  const overlap = await vision.findOverlap(0, 1, at(images[0], matches.indices1), at(images[1], matches.indices2));
  assert.equal(overlap.hasParallax, false);
  const guess = cameraOf(160, 120, 130).intrinsics;
  const panorama = await vision.estimatePanorama([guess, guess], [overlap], true);
  assert.ok(Math.abs(panorama.scalePx - 150) < 3, `${panorama.scalePx}`);
  const { width, height, data } = await vision.renderPanorama(panorama, photos);
  // Two fields of view of 2 atan(80 / 150), moved by 0.4.
  const expected = 150 * (2 * Math.atan(80 / 150) + 0.4);
  assert.ok(Math.abs(width - expected) < 6, `${width} x ${height}, not ${expected}`);
  assert.equal(data.length, 3 * width * height);
});
