/** Functions, options and results. Written by `make bless-vision` from `epipole-js`. */

import type { Control } from "./control.js";
import type { Part } from "./parts.js";

/** Part and parameters of each function. */
export const FUNCTIONS: Readonly<Record<string, readonly [Part, ...string[]]>> = {
  estimateHomography: ["homography", "pixels1", "pixels2", "options"],
  fitHomography: ["homography", "pixels1", "pixels2"],
  homography4point: ["homography", "pixels1", "pixels2"],
  refineHomography: ["homography", "homography", "pixels1", "pixels2", "loss"],
  transfer: ["homography", "homography", "pixels1"],
  transferErrorPx: ["homography", "homography", "pixels1", "pixels2"],
  homographySampsonPx: ["homography", "homography", "pixels1", "pixels2"],
  decomposeHomography: ["homography", "homography", "k1", "k2"],
  homographyFromMotion: ["homography", "cam2FromCam1", "normalInCam1", "distance", "k1", "k2"],
  estimateSimilarity: ["homography", "pixels1", "pixels2", "options"],
  fitSimilarity: ["homography", "pixels1", "pixels2"],
  estimateFundamental: ["epipolar", "pixels1", "pixels2", "options"],
  estimateEssential: ["epipolar", "pixels1", "pixels2", "camera1", "camera2", "options"],
  estimateRelativePose: ["epipolar", "pixels1", "pixels2", "camera1", "camera2", "options"],
  estimateRelativePoseWithGravity: ["epipolar", "pixels1", "pixels2", "camera1", "camera2", "gravity1", "gravity2", "options"],
  estimateRelativePoseAndFocal: ["epipolar", "pixels1", "pixels2", "principal1", "principal2", "options"],
  fundamental8point: ["epipolar", "pixels1", "pixels2"],
  fundamental7point: ["epipolar", "pixels1", "pixels2"],
  essential8point: ["epipolar", "rays1", "rays2"],
  essential5point: ["epipolar", "rays1", "rays2"],
  essential6point: ["epipolar", "pixels1", "pixels2", "principal1", "principal2"],
  relativePose3point: ["epipolar", "rays1", "rays2", "gravity1", "gravity2"],
  refineFundamental: ["epipolar", "fundamental", "pixels1", "pixels2", "loss"],
  refineRelativePose: ["epipolar", "cam2FromCam1", "pixels1", "pixels2", "camera1", "camera2", "loss"],
  sampsonPx: ["epipolar", "fundamental", "pixels1", "pixels2"],
  symmetricEpipolarPx: ["epipolar", "fundamental", "pixels1", "pixels2"],
  epipolarLine1: ["epipolar", "fundamental", "pixels2"],
  epipolarLine2: ["epipolar", "fundamental", "pixels1"],
  epipoles: ["epipolar", "fundamental"],
  enforceRank2: ["epipolar", "matrix"],
  projectToEssential: ["epipolar", "matrix"],
  decomposeEssential: ["epipolar", "essential"],
  selectPose: ["epipolar", "motions", "pixels1", "pixels2", "k1", "k2"],
  essentialFromMotion: ["epipolar", "cam2FromCam1"],
  fundamentalFromCameras: ["epipolar", "camera1", "camera2"],
  fundamentalFromEssential: ["epipolar", "essential", "k1", "k2"],
  essentialFromFundamental: ["epipolar", "fundamental", "k1", "k2"],
  focalLengthsFromFundamental: ["epipolar", "fundamental", "principal1", "principal2"],
  triangulateDlt: ["epipolar", "p1", "p2", "pixels1", "pixels2"],
  triangulateMidpoint: ["epipolar", "cam2FromCam1", "rays1", "rays2"],
  triangulateWeightedMidpoint: ["epipolar", "cam2FromCam1", "rays1", "rays2"],
  triangulateAngular: ["epipolar", "cam2FromCam1", "rays1", "rays2"],
  triangulateOptimal: ["epipolar", "camera1", "camera2", "pixels1", "pixels2"],
  correctMatches: ["epipolar", "fundamental", "pixels1", "pixels2"],
  triangulateNviewDlt: ["epipolar", "cameras", "pixels"],
  triangulateNview: ["epipolar", "cameras", "pixels", "loss"],
  triangulationAngleRad: ["epipolar", "center1InWorld", "center2InWorld", "pointsInWorld"],
  pointCovariance: ["epipolar", "cameras", "pointInWorld", "sigmaPx"],
  estimateAbsolutePose: ["absolutePose", "pointsInWorld", "pixels", "camera", "options"],
  estimateAbsolutePoseAndFocal: ["absolutePose", "pointsInWorld", "pixels", "principal", "options"],
  fitAbsolutePose: ["absolutePose", "pointsInWorld", "pixels", "camera"],
  poseDlt: ["absolutePose", "pointsInWorld", "pixels", "intrinsics"],
  poseP3p: ["absolutePose", "rays", "pointsInWorld"],
  poseP4pf: ["absolutePose", "pixels", "pointsInWorld", "principal"],
  refineAbsolutePose: ["absolutePose", "camFromWorld", "pointsInWorld", "pixels", "camera", "loss"],
  findFlippedPose: ["absolutePose", "camFromWorld", "pointsInWorld", "pixels", "camera"],
  reprojectionErrorPx: ["absolutePose", "camera", "pointsInWorld", "pixels"],
  twoViewProblem: ["synthetic", "options"],
  multiViewProblem: ["synthetic", "options"],
};

/** Pose and focal length. */
export interface AbsolutePoseWithFocal {
  /** Pose. */
  camFromWorld: RigidTransform;
  /** Focal length, pixels. */
  focalPx: number;
  /** Its standard deviation, pixels; null from a minimal solver. */
  focalStdPx: number | null;
}

/** A calibrated camera of any lens. */
export interface Camera {
  /** Image width, pixels. */
  width: number;
  /** Image height, pixels. */
  height: number;
  /** K. */
  intrinsics: Intrinsics;
  /** Without distortion if not given. */
  lens?: Lens;
}

/** Matches that satisfy the epipolar constraint; NaN for those without a correction. */
export interface CorrectedMatches {
  /** Pixels of image 1, interleaved. */
  pixels1: Float64Array;
  /** Pixels of image 2, interleaved. */
  pixels2: Float64Array;
}

/** Epipoles: (u, v, 1), or (u, v, 0) with a unit direction for those at infinity. */
export interface Epipoles {
  /** Epipole of image 1. */
  epipole1: Float64Array;
  /** Epipole of image 2. */
  epipole2: Float64Array;
}

/** Essential matrix and focal length. */
export interface EssentialWithFocal {
  /** Essential matrix. */
  essential: Float64Array;
  /** Focal length, pixels. */
  focalPx: number;
}

/** Pinhole intrinsics, pixels; pixel centers are at integers. */
export interface Intrinsics {
  /** Focal length along u. */
  fuPx: number;
  /** Focal length along v. */
  fvPx: number;
  /** Principal point, u. */
  cuPx: number;
  /** Principal point, v. */
  cvPx: number;
}

/** A lens model with its coefficients. */
export interface Lens {
  /** Model. */
  kind: "brown" | "rational" | "fisheye" | "division";
  /** In the order of OpenCV: brown 5, rational 8, fisheye 4, division 1. */
  coefficients: ArrayLike<number>;
}

/** A matrix: numbers by row, or an array of rows. */
export type Matrix = ArrayLike<number> | readonly ArrayLike<number>[];

/** Cameras, points and observations in images of 640 x 480 pixels, with ground truth. */
export interface MultiViewProblem {
  /** Cameras. */
  cameras: PosedCamera[];
  /** Points in the world, interleaved. */
  points: Float64Array;
  /** Index of the camera of each observation. */
  observationCamera: Uint32Array;
  /** Index of the point of each observation. */
  observationPoint: Uint32Array;
  /** Measured pixel of each observation, interleaved. */
  observationPixel: Float64Array;
  /** 1 for observations that are right up to noise. */
  observationIsInlier: Uint8Array;
}

/** Options of a `MultiViewProblem`. */
export interface MultiViewProblemOptions {
  /** Number of cameras, at least 2. @default 8 */
  numCameras?: number;
  /** Number of points; each is seen by at least two cameras. @default 200 */
  numPoints?: number;
  /** Structure of the points, around the world's origin. @default { cube: { halfSideM: 1 } } */
  structure?: { cube: { halfSideM: number } } | { plane: { halfSideM: number } } | { corner: { halfSideM: number } };
  /** Positions of the cameras. @default { arc: { radiusM: 5, spanRad: 1 } } */
  path?: { arc: { radiusM: number; spanRad: number } } | { line: { distanceM: number; spacingM: number } };
  /** Part of the observations that are made, 0 to 1; 1 for every point in every picture. @default 1 */
  visibleFraction?: number;
  /** Standard deviation of the Gaussian error of each coordinate of each pixel, pixels. @default 0 */
  noisePx?: number;
  /** Part of the observations whose pixel is wrong, 0 to 1. @default 0 */
  outlierFraction?: number;
  /** Everything random depends on it alone. @default 0 */
  seed?: number;
}

/** Point seen by several cameras. */
export interface NviewPoint {
  /** Point, world frame. */
  pointInWorld: Float64Array;
  /** Root mean square of its reprojection errors, pixels. */
  rmsErrorPx: number;
}

/** A motion and the plane that explain a homography. */
export interface PlaneMotion {
  /** Motion; the translation is in units of the distance of the plane from camera 1. */
  cam2FromCam1: RigidTransform;
  /** Unit normal of the plane in the frame of camera 1. */
  normalInCam1: Float64Array;
}

/** Similarity of the plane: (u, v) to (a u - b v + tu, b u + a v + tv). */
export interface PlaneSimilarity {
  /** Scale times cosine. */
  a: number;
  /** Scale times sine. */
  b: number;
  /** Translation along u, pixels. */
  tu: number;
  /** Translation along v, pixels. */
  tv: number;
}

/** Points of 2 coordinates each: interleaved, or an array of 2 each. */
export type Points2 = ArrayLike<number> | readonly ArrayLike<number>[];

/** Points of 3 coordinates each: interleaved, or an array of 3 each. */
export type Points3 = ArrayLike<number> | readonly ArrayLike<number>[];

/** Relative pose and common focal length. */
export interface PoseWithFocal {
  /** Pose. */
  pose: RelativePose;
  /** Fundamental matrix. */
  fundamental: Float64Array;
  /** Focal length, pixels. */
  focalPx: number;
  /** Its standard deviation, pixels; null if unknown. */
  focalStdPx: number | null;
}

/** A camera with its pose. */
export interface PosedCamera {
  /** Size, intrinsics and lens. */
  camera: Camera;
  /** Pose. */
  camFromWorld: RigidTransform;
}

/** A camera with its pose. */
export interface PosedCameraLike {
  /** Size, intrinsics and lens. */
  camera: Camera;
  /** Pose. */
  camFromWorld: RigidTransformLike;
}

/** Options of `Ransac`. */
export interface RansacOptions {
  /**
   * The threshold T: a datum nearer than this to a model is an inlier. Pixels, > 0; of an estimator of
   * one's own, the unit of its errors. 1. @default 1
   */
  maxErrorPx?: number;
  /** Source of the threshold. Given. @default "given" */
  threshold?: "given" | "noise";
  /** The probability that at least one sample is free of outliers, in (0, 1). 0.999. @default 0.999 */
  confidence?: number;
  /**
   * Minimum number of samples, unless `maxIterations` is lower. 200: the number required by the inlier
   * ratio takes every sample without outliers for a good start, but with noise only some of them lead to
   * the best model. @default 200
   */
  minIterations?: number;
  /** Maximum number of samples, ≥ 1. 10 000. @default 10000 */
  maxIterations?: number;
  /** Equal seeds give equal results. 0. @default 0 */
  seed?: number;
  /** Sampling strategy. Uniform. @default "uniform" */
  sampler?: "uniform" | "prosac";
  /** Scoring function. MSAC. @default "msac" */
  score?: "msac" | "inlierCount";
  /**
   * Whether a promising model is improved from its inliers at once, and the best one at the end. True.
   * @default true
   */
  localOptimization?: boolean;
  /** Rounds of "find the inliers, fit to them" in one local optimization, 0 as good as 1. 4. @default 4 */
  innerIterations?: number;
  /** Formula for the sufficient number of samples. Without replacement. @default "withoutReplacement" */
  budget?: "withReplacement" | "withoutReplacement";
  /**
   * Whether every model is compared with every datum, so that a figure can show its score. Otherwise a
   * model is dropped as soon as it cannot win. False. @default false
   */
  scoreEveryTrial?: boolean;
}

/** Result of a robust estimation. */
export interface RansacReport<M> {
  /** Best model, refined from its inliers. */
  model: M;
  /** 1 for each datum within the threshold, otherwise 0. */
  inliers: Uint8Array;
  /** Number of inliers. */
  numInliers: number;
  /** The same, equal data counted once. */
  numUniqueInliers: number;
  /** Data with infinite or huge coordinates, no inliers. */
  numLeftOut: number;
  /** Samples drawn. */
  iterations: number;
  /** Samples required by the inlier ratio; Infinity if no number is enough. */
  requiredIterations: number;
  /** Threshold of an inlier, pixels. */
  maxErrorPx: number;
  /** Score of the model. */
  score: number;
  /** Expected number of such models in random data, as a decimal logarithm. */
  log10FalseAlarms: number | null;
  /** Local optimizations. */
  refinements: number;
  /** Reason for the end of the loop. */
  stop: "confident" | "exhausted" | "interrupted";
  /** Whether random data might show as much support. */
  couldBeChance: boolean;
}

/** Rotation and direction of translation. */
export interface RelativePose {
  /** Rotation matrix R, 9 numbers by row: `x_in_cam2 = R x_in_cam1 + t`. */
  rotation: Float64Array;
  /** Unit vector t. */
  direction: Float64Array;
}

/** Rotation and translation: `x_in_a = a_from_b * x_in_b`. */
export interface RigidTransform {
  /** Rotation matrix, 9 numbers by row. */
  rotation: Float64Array;
  /** The same rotation as (w, x, y, z). */
  quaternion: Float64Array;
  /** 3 numbers. */
  translation: Float64Array;
}

/** A rotation, as a matrix by row or a quaternion, and a translation. */
export interface RigidTransformLike {
  /** Rotation matrix. Ignored beside a quaternion; identity if neither is given. */
  rotation?: ArrayLike<number> | readonly ArrayLike<number>[];
  /** (w, x, y, z), of length 1. */
  quaternion?: ArrayLike<number>;
  /** Zero if not given. */
  translation?: ArrayLike<number>;
}

/** Motion with most points in front of both cameras. */
export interface SelectedPose {
  /** Motion. */
  cam2FromCam1: RigidTransform;
  /** Number of points in front of both cameras. */
  numInFront: number;
  /** The same for the second-best motion. */
  secondNumInFront: number;
}

/** Matches between two images of 640 x 480 pixels, with ground truth. */
export interface TwoViewProblem {
  /** First camera, at (0, 0, -distance), which looks along +z. */
  camera1: PosedCamera;
  /** Second camera, to the right of it, which looks at the world's origin. */
  camera2: PosedCamera;
  /** Measured pixels in image 1, interleaved. */
  pixels1: Float64Array;
  /** Their matches in image 2. */
  pixels2: Float64Array;
  /** 1 for matches that are right up to noise. */
  isInlier: Uint8Array;
  /** Points in the world, interleaved. */
  points: Float64Array;
}

/** Options of a `TwoViewProblem`. */
export interface TwoViewProblemOptions {
  /** Number of matches, inliers and outliers together. @default 100 */
  numPoints?: number;
  /** Structure of the points, around the world's origin. @default { cube: { halfSideM: 1 } } */
  structure?: { cube: { halfSideM: number } } | { plane: { halfSideM: number } } | { corner: { halfSideM: number } };
  /** Distance between the camera centers, meters; 0 for a camera that only turns. @default 1 */
  baselineM?: number;
  /** Distance of the first camera from the world's origin, meters. @default 5 */
  distanceM?: number;
  /** Standard deviation of the Gaussian error of each coordinate of each pixel, pixels. @default 0 */
  noisePx?: number;
  /** Part of the matches whose second pixel is wrong, 0 to 1. @default 0 */
  outlierFraction?: number;
  /** Everything random depends on it alone. @default 0 */
  seed?: number;
}

/** Functions by part. */
export interface Functions {
  /** Homography of matches with outliers, by RANSAC: `x2 ~ H x1`. */
  estimateHomography(pixels1: Points2, pixels2: Points2, options?: RansacOptions & Control): Promise<RansacReport<Float64Array>>;
  /** Homography of matches without outliers, by linear least squares. */
  fitHomography(pixels1: Points2, pixels2: Points2): Promise<Float64Array>;
  /** Homography of four matches; none if three points lie on a line. */
  homography4point(pixels1: Points2, pixels2: Points2): Promise<Float64Array[]>;
  /** Refines a homography from matches without outliers by minimizing a robust loss. */
  refineHomography(homography: Matrix, pixels1: Points2, pixels2: Points2, loss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } }): Promise<Float64Array>;
  /** Maps pixels of image 1 to image 2; NaN for those that go to infinity. */
  transfer(homography: Matrix, pixels1: Points2): Promise<Float64Array>;
  /** Distances in image 2 between mapped and matched pixels, pixels. */
  transferErrorPx(homography: Matrix, pixels1: Points2, pixels2: Points2): Promise<Float64Array>;
  /** Sampson distances of matches from a homography, pixels. */
  homographySampsonPx(homography: Matrix, pixels1: Points2, pixels2: Points2): Promise<Float64Array>;
  /** Motions and planes that explain a homography between two calibrated cameras. */
  decomposeHomography(homography: Matrix, k1: Intrinsics, k2: Intrinsics): Promise<PlaneMotion[]>;
  /** Homography of a plane with a unit normal at a distance from camera 1. */
  homographyFromMotion(cam2FromCam1: RigidTransformLike, normalInCam1: ArrayLike<number>, distance: number, k1: Intrinsics, k2: Intrinsics): Promise<Float64Array>;
  /** Similarity of matches with outliers, by RANSAC. */
  estimateSimilarity(pixels1: Points2, pixels2: Points2, options?: RansacOptions & Control): Promise<RansacReport<PlaneSimilarity>>;
  /** Similarity of matches without outliers, by least squares. */
  fitSimilarity(pixels1: Points2, pixels2: Points2): Promise<PlaneSimilarity>;
  /** Fundamental matrix of matches with outliers, by RANSAC: `x2' F x1 = 0`, unit norm. */
  estimateFundamental(pixels1: Points2, pixels2: Points2, options?: RansacOptions & Control): Promise<RansacReport<Float64Array>>;
  /** Essential matrix of matches with outliers, by RANSAC: unit norm. */
  estimateEssential(pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, options?: RansacOptions & Control): Promise<RansacReport<Float64Array>>;
  /** Relative pose of two calibrated cameras from matches with outliers, by RANSAC. */
  estimateRelativePose(pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, options?: RansacOptions & Control): Promise<RansacReport<RelativePose>>;
  /** Relative pose of two cameras that know the direction of gravity, by RANSAC. */
  estimateRelativePoseWithGravity(pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, gravity1: ArrayLike<number>, gravity2: ArrayLike<number>, options?: RansacOptions & Control): Promise<RansacReport<RelativePose>>;
  /** Relative pose and common focal length of two cameras, by RANSAC. */
  estimateRelativePoseAndFocal(pixels1: Points2, pixels2: Points2, principal1: ArrayLike<number>, principal2: ArrayLike<number>, options?: RansacOptions & Control): Promise<RansacReport<PoseWithFocal>>;
  /** Fundamental matrix of eight or more matches without outliers, normalized. */
  fundamental8point(pixels1: Points2, pixels2: Points2): Promise<Float64Array>;
  /** Fundamental matrices of seven matches. */
  fundamental7point(pixels1: Points2, pixels2: Points2): Promise<Float64Array[]>;
  /** Essential matrix of eight or more pairs of rays without outliers. */
  essential8point(rays1: Points3, rays2: Points3): Promise<Float64Array>;
  /** Essential matrices of five pairs of rays. */
  essential5point(rays1: Points3, rays2: Points3): Promise<Float64Array[]>;
  /** Essential matrices and focal lengths of six matches. */
  essential6point(pixels1: Points2, pixels2: Points2, principal1: ArrayLike<number>, principal2: ArrayLike<number>): Promise<EssentialWithFocal[]>;
  /** Motions of three pairs of rays and the direction of gravity in both cameras. */
  relativePose3point(rays1: Points3, rays2: Points3, gravity1: ArrayLike<number>, gravity2: ArrayLike<number>): Promise<RigidTransform[]>;
  /** Refines a fundamental matrix from matches without outliers. */
  refineFundamental(fundamental: Matrix, pixels1: Points2, pixels2: Points2, loss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } }): Promise<Float64Array>;
  /** Refines a motion, whose length is ignored, from matches without outliers. */
  refineRelativePose(cam2FromCam1: RigidTransformLike, pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, loss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } }): Promise<RelativePose>;
  /** Sampson distances of matches from a fundamental matrix, pixels. */
  sampsonPx(fundamental: Matrix, pixels1: Points2, pixels2: Points2): Promise<Float64Array>;
  /** Symmetric epipolar distances of matches from a fundamental matrix, pixels. */
  symmetricEpipolarPx(fundamental: Matrix, pixels1: Points2, pixels2: Points2): Promise<Float64Array>;
  /**
   * Epipolar lines in image 1 of pixels of image 2: (a, b, c) with `a u + b v + c = 0`, a² + b² = 1.
   * NaN for epipoles.
   */
  epipolarLine1(fundamental: Matrix, pixels2: Points2): Promise<Float64Array>;
  /** Epipolar lines in image 2 of pixels of image 1, as for image 1. */
  epipolarLine2(fundamental: Matrix, pixels1: Points2): Promise<Float64Array>;
  /** Epipoles of both images. */
  epipoles(fundamental: Matrix): Promise<Epipoles>;
  /** Nearest matrix of rank 2, of unit norm. */
  enforceRank2(matrix: Matrix): Promise<Float64Array>;
  /** Nearest essential matrix, of unit norm. */
  projectToEssential(matrix: Matrix): Promise<Float64Array>;
  /** The four motions of an essential matrix, with translations of length 1. */
  decomposeEssential(essential: Matrix): Promise<RigidTransform[]>;
  /** Motion with most points in front of both cameras, from matches without outliers. */
  selectPose(motions: readonly RigidTransformLike[], pixels1: Points2, pixels2: Points2, k1: Intrinsics, k2: Intrinsics): Promise<SelectedPose>;
  /** Essential matrix of a motion, of unit norm. */
  essentialFromMotion(cam2FromCam1: RigidTransformLike): Promise<Float64Array>;
  /** Fundamental matrix of two cameras, of unit norm, for undistorted pixels. */
  fundamentalFromCameras(camera1: PosedCameraLike, camera2: PosedCameraLike): Promise<Float64Array>;
  /** Fundamental matrix of an essential matrix, of unit norm. */
  fundamentalFromEssential(essential: Matrix, k1: Intrinsics, k2: Intrinsics): Promise<Float64Array>;
  /** Essential matrix of a fundamental matrix, of unit norm. */
  essentialFromFundamental(fundamental: Matrix, k1: Intrinsics, k2: Intrinsics): Promise<Float64Array>;
  /** Focal lengths of both cameras from a fundamental matrix, pixels. */
  focalLengthsFromFundamental(fundamental: Matrix, principal1: ArrayLike<number>, principal2: ArrayLike<number>): Promise<Float64Array>;
  /**
   * Points of matches by the direct linear transform, in the frame of the projection matrices (3 x 4).
   * NaN for points at infinity.
   */
  triangulateDlt(p1: Matrix, p2: Matrix, pixels1: Points2, pixels2: Points2): Promise<Float64Array>;
  /** Points halfway between rays, in the frame of camera 1. NaN for parallel rays. */
  triangulateMidpoint(cam2FromCam1: RigidTransformLike, rays1: Points3, rays2: Points3): Promise<Float64Array>;
  /** Points between rays, weighted by inverse depth, in the frame of camera 1. NaN for parallel rays. */
  triangulateWeightedMidpoint(cam2FromCam1: RigidTransformLike, rays1: Points3, rays2: Points3): Promise<Float64Array>;
  /** Points of rays turned by the least angles, in the frame of camera 1. NaN for parallel rays. */
  triangulateAngular(cam2FromCam1: RigidTransformLike, rays1: Points3, rays2: Points3): Promise<Float64Array>;
  /** Points of least reprojection error of two cameras, world frame. NaN for points at infinity. */
  triangulateOptimal(camera1: PosedCameraLike, camera2: PosedCameraLike, pixels1: Points2, pixels2: Points2): Promise<Float64Array>;
  /** Nearest matches that satisfy the epipolar constraint. */
  correctMatches(fundamental: Matrix, pixels1: Points2, pixels2: Points2): Promise<CorrectedMatches>;
  /** Point of one pixel in each of several cameras, by the direct linear transform, world frame. */
  triangulateNviewDlt(cameras: readonly PosedCameraLike[], pixels: Points2): Promise<Float64Array>;
  /** Point of one pixel in each of several cameras that minimizes a robust loss. */
  triangulateNview(cameras: readonly PosedCameraLike[], pixels: Points2, loss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } }): Promise<NviewPoint>;
  /** Angles at points between the directions to two camera centers, radians. */
  triangulationAngleRad(center1InWorld: ArrayLike<number>, center2InWorld: ArrayLike<number>, pointsInWorld: Points3): Promise<Float64Array>;
  /** Covariance of a point seen by several cameras with pixel noise `sigmaPx`, 3 x 3. */
  pointCovariance(cameras: readonly PosedCameraLike[], pointInWorld: ArrayLike<number>, sigmaPx: number): Promise<Float64Array>;
  /** Pose of a calibrated camera from points and pixels with outliers, by RANSAC. */
  estimateAbsolutePose(pointsInWorld: Points3, pixels: Points2, camera: Camera, options?: RansacOptions & Control): Promise<RansacReport<RigidTransform>>;
  /** Pose and focal length of a camera from points and pixels with outliers, by RANSAC. */
  estimateAbsolutePoseAndFocal(pointsInWorld: Points3, pixels: Points2, principal: ArrayLike<number>, options?: RansacOptions & Control): Promise<RansacReport<AbsolutePoseWithFocal>>;
  /** Pose from points and pixels without outliers, by least squares. */
  fitAbsolutePose(pointsInWorld: Points3, pixels: Points2, camera: Camera): Promise<RigidTransform>;
  /** Pose from six or more points without outliers, by the direct linear transform. */
  poseDlt(pointsInWorld: Points3, pixels: Points2, intrinsics: Intrinsics): Promise<RigidTransform>;
  /** Poses from three rays of any length and their points. */
  poseP3p(rays: Points3, pointsInWorld: Points3): Promise<RigidTransform[]>;
  /** Poses and focal lengths from four pixels and their points. */
  poseP4pf(pixels: Points2, pointsInWorld: Points3, principal: ArrayLike<number>): Promise<AbsolutePoseWithFocal[]>;
  /** Refines a pose from points and pixels without outliers by minimizing a robust loss. */
  refineAbsolutePose(camFromWorld: RigidTransformLike, pointsInWorld: Points3, pixels: Points2, camera: Camera, loss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } }): Promise<RigidTransform>;
  /** The other pose that explains points near a plane about as well; null if there is none. */
  findFlippedPose(camFromWorld: RigidTransformLike, pointsInWorld: Points3, pixels: Points2, camera: Camera): Promise<RigidTransform | null>;
  /** Distances between projected points and measured pixels, pixels. */
  reprojectionErrorPx(camera: PosedCameraLike, pointsInWorld: Points3, pixels: Points2): Promise<Float64Array>;
  /** Draws points and two cameras that see them. */
  twoViewProblem(options?: TwoViewProblemOptions & Control): Promise<TwoViewProblem>;
  /** Draws points and cameras that see them. */
  multiViewProblem(options?: MultiViewProblemOptions & Control): Promise<MultiViewProblem>;
}
