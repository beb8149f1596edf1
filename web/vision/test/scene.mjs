// A scene with ground truth for tests: two textured walls, z = 4 - 0.5 |x|.

const IDENTITY = [1, 0, 0, 0, 1, 0, 0, 0, 1];

/** Rotation by angles about x, y and z, in this order, by row. */
export function turn(...angles) {
  const [[c, s], [d, t], [e, f]] = angles.map((angle) => [Math.cos(angle), Math.sin(angle)]);
  return [e * d, e * t * s - f * c, e * t * c + f * s, f * d, f * t * s + e * c, f * t * c - e * s, -t, d * s, d * c];
}

/** Camera whose principal point is at the center of its image unless given. */
export function cameraOf(width, height, focalPx, [cuPx, cvPx] = [(width - 1) / 2, (height - 1) / 2]) {
  return { width, height, intrinsics: { fuPx: focalPx, fvPx: focalPx, cuPx, cvPx } };
}

/** Depth and place of what a camera sees at a pixel; `rotation` is that of the camera from the world, by row. */
export function seenAt({ intrinsics: { fuPx, fvPx, cuPx, cvPx } }, u, v, { center = [0, 0, 0], rotation = IDENTITY } = {}) {
  const ray = [(u - cuPx) / fuPx, (v - cvPx) / fvPx, 1];
  const [dx, dy, dz] = [0, 1, 2].map((k) => rotation[k] * ray[0] + rotation[k + 3] * ray[1] + rotation[k + 6] * ray[2]);
  const depths = [0.5, -0.5].map((slope) => (4 - slope * center[0] - center[2]) / (dz + slope * dx));
  const depth = Math.min(...depths.filter((depth) => depth > 0));
  return { depth, x: center[0] + depth * dx, y: center[1] + depth * dy };
}

/** Gray value of the texture, 0 to 255. */
export function shade(x, y) {
  return 160 * smooth(4 * x, 4 * y) + 95 * smooth(11 * x + 3, 11 * y);
}

/** Gray photo, an object with width, height and bytes. */
export function photograph(camera, pose) {
  const { width, height } = camera;
  const data = Uint8Array.from({ length: width * height }, (_, place) => {
    const { x, y } = seenAt(camera, place % width, Math.floor(place / width), pose);
    return shade(x, y);
  });
  return { width, height, data };
}

/** The same gray photo with 4 bytes a pixel, as decoders of PNG return it. */
export function inColor({ width, height, data }) {
  const colors = Uint8Array.from({ length: 4 * data.length }, (_, k) => (k % 4 === 3 ? 255 : data[k >> 2]));
  return { width, height, data: colors };
}

function at(x, y) {
  return ((((x * 7919 + y * 104729 + x * y * 31) % 251) + 251) % 251) / 250;
}

/** Random values at whole numbers, smooth between them. */
function smooth(x, y) {
  const [column, row] = [Math.floor(x), Math.floor(y)];
  const [s, t] = [x - column, y - row].map((share) => share * share * (3 - 2 * share));
  const on = (row) => at(column, row) * (1 - s) + at(column + 1, row) * s;
  return on(row) * (1 - t) + on(row + 1) * t;
}
