/** Functions, options and results. Written by `make bless-vision` from `epipole-js`. */

import type { Control } from "./control.js";

/** Parts of the library, each a module. */
export const PART_NAMES = ["homography", "geometry", "images"] as const;

/** A part of the library. */
export type Part = (typeof PART_NAMES)[number];

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
  project: ["geometry", "camera", "pointsInCam"],
  projectFromWorld: ["geometry", "camera", "pointsInWorld"],
  unproject: ["geometry", "camera", "pixels"],
  pinholePixel: ["geometry", "camera", "pixels"],
  lookAt: ["geometry", "centerInWorld", "targetInWorld", "upInWorld"],
  relativeMotion: ["geometry", "cam1FromWorld", "cam2FromWorld"],
  estimateFundamental: ["geometry", "pixels1", "pixels2", "options"],
  estimateEssential: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "options"],
  estimateRelativePose: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "options"],
  estimateRelativePoseWithGravity: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "gravity1", "gravity2", "options"],
  estimateRelativePoseAndFocal: ["geometry", "pixels1", "pixels2", "principal1", "principal2", "options"],
  fundamental8point: ["geometry", "pixels1", "pixels2"],
  fundamental7point: ["geometry", "pixels1", "pixels2"],
  essential8point: ["geometry", "rays1", "rays2"],
  essential5point: ["geometry", "rays1", "rays2"],
  essential6point: ["geometry", "pixels1", "pixels2", "principal1", "principal2"],
  relativePose3point: ["geometry", "rays1", "rays2", "gravity1", "gravity2"],
  refineFundamental: ["geometry", "fundamental", "pixels1", "pixels2", "loss"],
  refineRelativePose: ["geometry", "cam2FromCam1", "pixels1", "pixels2", "camera1", "camera2", "loss"],
  sampsonPx: ["geometry", "fundamental", "pixels1", "pixels2"],
  symmetricEpipolarPx: ["geometry", "fundamental", "pixels1", "pixels2"],
  epipolarLine1: ["geometry", "fundamental", "pixels2"],
  epipolarLine2: ["geometry", "fundamental", "pixels1"],
  epipoles: ["geometry", "fundamental"],
  enforceRank2: ["geometry", "matrix"],
  projectToEssential: ["geometry", "matrix"],
  decomposeEssential: ["geometry", "essential"],
  selectPose: ["geometry", "motions", "pixels1", "pixels2", "k1", "k2"],
  essentialFromMotion: ["geometry", "cam2FromCam1"],
  fundamentalFromCameras: ["geometry", "camera1", "camera2"],
  fundamentalFromEssential: ["geometry", "essential", "k1", "k2"],
  essentialFromFundamental: ["geometry", "fundamental", "k1", "k2"],
  focalLengthsFromFundamental: ["geometry", "fundamental", "principal1", "principal2"],
  triangulateDlt: ["geometry", "p1", "p2", "pixels1", "pixels2"],
  triangulateMidpoint: ["geometry", "cam2FromCam1", "rays1", "rays2"],
  triangulateWeightedMidpoint: ["geometry", "cam2FromCam1", "rays1", "rays2"],
  triangulateAngular: ["geometry", "cam2FromCam1", "rays1", "rays2"],
  triangulateOptimal: ["geometry", "camera1", "camera2", "pixels1", "pixels2"],
  correctMatches: ["geometry", "fundamental", "pixels1", "pixels2"],
  triangulateNviewDlt: ["geometry", "cameras", "pixels"],
  triangulateNview: ["geometry", "cameras", "pixels", "loss"],
  triangulationAngleRad: ["geometry", "center1InWorld", "center2InWorld", "pointsInWorld"],
  pointCovariance: ["geometry", "cameras", "pointInWorld", "sigmaPx"],
  estimateAbsolutePose: ["geometry", "pointsInWorld", "pixels", "camera", "options"],
  estimateAbsolutePoseAndFocal: ["geometry", "pointsInWorld", "pixels", "principal", "options"],
  fitAbsolutePose: ["geometry", "pointsInWorld", "pixels", "camera"],
  poseDlt: ["geometry", "pointsInWorld", "pixels", "intrinsics"],
  poseP3p: ["geometry", "rays", "pointsInWorld"],
  poseP4pf: ["geometry", "pixels", "pointsInWorld", "principal"],
  refineAbsolutePose: ["geometry", "camFromWorld", "pointsInWorld", "pixels", "camera", "loss"],
  findFlippedPose: ["geometry", "camFromWorld", "pointsInWorld", "pixels", "camera"],
  reprojectionErrorPx: ["geometry", "camera", "pointsInWorld", "pixels"],
  twoViewProblem: ["geometry", "options"],
  multiViewProblem: ["geometry", "options"],
  photoToGray: ["images", "photo"],
  detectFeatures: ["images", "image", "options"],
  detectSift: ["images", "image", "options"],
  detectOrb: ["images", "image", "options"],
  describeSift: ["images", "image", "keypoints", "options"],
  harrisResponse: ["images", "image", "k", "options"],
  minEigenvalueResponse: ["images", "image", "options"],
  goodFeaturesToTrack: ["images", "image", "options"],
  refineCorners: ["images", "image", "corners", "options"],
  matchDescriptors: ["images", "descriptors1", "descriptors2", "options"],
  nearestTwo: ["images", "descriptors1", "descriptors2"],
  trackLucasKanade: ["images", "first", "second", "points", "options"],
  rectifyCalibrated: ["images", "camera1", "camera2", "cam2FromCam1", "options"],
  rectifyImages: ["images", "image1", "image2", "camera1", "camera2", "cam2FromCam1", "options"],
  rectifyUncalibrated: ["images", "fundamental", "pixels1", "pixels2", "width", "height"],
  stereoBm: ["images", "left", "right", "options"],
  stereoSgm: ["images", "left", "right", "options"],
  removeSpeckles: ["images", "disparity", "minSize", "rangePx"],
  depthImage: ["images", "disparity", "focalPx", "baselineM"],
  pointCloud: ["images", "disparity", "q"],
  depthFromDisparity: ["images", "focalPx", "baselineM", "disparityPx"],
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

/** Descriptors, one after the other. */
export interface Descriptors {
  /** Kind of the entries. */
  kind: "bytes" | "floats" | "bits";
  /** Entries of a descriptor: numbers or bits. */
  dimension: number;
  /** Entries; eight bits of a descriptor of bits are one byte, lowest first. */
  data: Uint8Array | Float32Array;
}

/** Tests that an answer of a dense matcher must pass. */
export interface DisparityFilter {
  /**
   * Percent by which the costs of all disparities two or more away from the best must be higher, 0 to
   * 99; 0: no such test.
   */
  uniquenessPercent?: number;
  /**
   * The largest difference between the disparities seen from the left and from the right, pixels; none:
   * no such test.
   */
  leftRightMaxPx?: number | null;
  /** Answers that hang together in fewer pixels than this are removed; 0 or 1: none. */
  speckleSize?: number;
  /** Neighbors whose disparities differ by no more than this hang together, pixels. */
  speckleRangePx?: number;
  /**
   * The longest gap along a row or a column, pixels, that is closed by interpolation where the answers
   * at its two ends hang together; 0: none.
   */
  maxGapPx?: number;
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

/**
 * Options of feature detection. Every command and `PhotoOptions` start from the default; see
 * `MatchOptions` and `RansacOptions` for matches and models.
 */
export interface FeatureOptions {
  /** RootSIFT. @default "rootSift" */
  kind?: "sift" | "rootSift" | "orb" | "harris";
  /** Maximum number of features, the strongest; 0 means no limit. 8192. @default 8192 */
  maxFeatures?: number;
  /**
   * Minimum response of a feature, for gray values in [0, 1]; `None` for the default of the kind. SIFT:
   * `contrastThreshold`, 0.02, which includes faint features. ORB: `fastThreshold`, 20/255. Harris: the
   * share of the strongest response, `quality`, 0.01. @default null
   */
  contrastThreshold?: number | null;
  /**
   * Take every direction to be 0, for cameras held upright. Harris' corners have none. False. @default
   * false
   */
  upright?: boolean;
  /**
   * SIFT: photographs of up to this many pixels are also searched at twice their size; larger ones,
   * which takes seconds, only if they have fewer than `maxFeatures` without; none if 0. 1.5 million.
   * @default 1500000
   */
  maxUpsampledPixels?: number;
  /**
   * SIFT: assumed blur of the input, pixels, 0 to half of `sigmaPx`. 0.5, as Lowe's; 0.3 gives more
   * matches in sharp photographs, fewer where features are rare. @default 0.5
   */
  inputBlurPx?: number;
  /** SIFT: the blur of the first layer of an octave, pixels of that octave, 0.8 to 4. 1.6. @default 1.6 */
  sigmaPx?: number;
  /** SIFT: layers per octave in which extrema are looked for, 1 to 10. 3. @default 3 */
  layersPerOctave?: number;
  /** SIFT: the largest ratio of the principal curvatures, > 1. 10. @default 10 */
  edgeThreshold?: number;
  /** SIFT: maximum number of directions per place, ≥ 1; each makes a feature. 2. @default 2 */
  maxOrientations?: number;
  /**
   * SIFT: the share of the strongest direction's weight that a further one needs, in (0, 1]. 0.8.
   * @default 0.800000011920929
   */
  orientationPeakRatio?: number;
  /** ORB: levels of the pyramid, 1 to 16. 8. @default 8 */
  numLevels?: number;
  /** ORB: ratio of the sizes of successive levels, above 1 and at most 2. 1.2. @default 1.2 */
  scaleFactor?: number;
  /** Harris: the constant k of the measure, 0 to below 0.25. 0.04. @default 0.03999999910593033 */
  harrisK?: number;
  /** Harris: no two corners are closer than this, pixels; 0 allows neighbors. 8. @default 8 */
  minDistancePx?: number;
  /** Harris: side of the square over which gradients are summed, pixels, 1 to 255. 3. @default 3 */
  tensorWindowPx?: number;
  /** Harris: side of the patch that describes a corner, pixels, 2 to 64. 11. @default 11 */
  patchPx?: number;
}

/** Keypoints with their descriptors. */
export interface Features {
  /** Keypoints, strongest first. */
  keypoints: Keypoints;
  /** Their descriptors. */
  descriptors: Descriptors;
}

/** Options of `goodFeaturesToTrack`. */
export interface GoodFeaturesOptions {
  /** At most so many corners; 0 means no limit. @default 1000 */
  maxCorners?: number;
  /**
   * Corners weaker than this share of the strongest are dropped, in (0, 1]. @default
   * 0.009999999776482582
   */
  quality?: number;
  /** No two corners are closer than this, pixels; 0 allows neighbors. @default 8 */
  minDistancePx?: number;
  /** The measure. @default "shiTomasi" */
  measure?: "shiTomasi" | { harris: number };
  /**
   * Options of the structure tensor. @default { border: "reflect101", derivative: "sobel3", scaling:
   * "textbook", window: { box: 3 } }
   */
  tensor?: StructureTensorOptions;
  /**
   * With a grid and a limit, each cell first gives its share of the strongest; what the poor cells leave
   * goes to the strongest of the rest. @default null
   */
  grid?: Grid | null;
}

/** Floats, one a pixel, rows from top to bottom. */
export interface GrayImage {
  /** Pixels. */
  width: number;
  /** Pixels. */
  height: number;
  /** Values. */
  data: Float32Array;
}

/** Cells of the image that share the corners out evenly. */
export interface Grid {
  /** Cells side by side, ≥ 1. */
  columns?: number | null;
  /** Cells one above the other, ≥ 1. */
  rows?: number | null;
}

/** An image, rows from top to bottom: an ImageData, or an object like it. */
export interface ImageLike {
  /** Pixels. */
  width: number;
  /** Pixels. */
  height: number;
  /** Bytes: 1 (gray), 3 (RGB) or 4 (RGBA) a pixel. Floats: 1 a pixel, black 0 and white 1. */
  data: Uint8Array | Uint8ClampedArray | Float32Array | Float64Array | ArrayLike<number>;
}

/** An image of the kind that was given: bytes or floats, with as many channels. */
export interface ImageOfKind {
  /** Pixels. */
  width: number;
  /** Pixels. */
  height: number;
  /** Values. */
  data: Uint8Array | Float32Array;
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

/** Keypoints: entry k of each array belongs to keypoint k. */
export interface Keypoints {
  /** Pixels, interleaved. */
  points: Float64Array;
  /** Scales, pixels. */
  scalesPx: Float32Array;
  /** Directions, radians. */
  anglesRad: Float32Array;
  /** Strengths. */
  responses: Float32Array;
  /** Octaves of the pyramid. */
  octaves: Int32Array;
}

/** Keypoints: entry k of each array belongs to keypoint k. */
export interface KeypointsLike {
  /** Pixels. */
  points: Points2;
  /** Scales, pixels. 1 if not given. */
  scalesPx?: ArrayLike<number>;
  /** Directions, radians. 0 if not given. */
  anglesRad?: ArrayLike<number>;
  /** Strengths. 0 if not given. */
  responses?: ArrayLike<number>;
  /** Octaves of the pyramid. 0 if not given. */
  octaves?: ArrayLike<number>;
}

/** A lens model with its coefficients. */
export interface Lens {
  /** Model. */
  kind: "brown" | "rational" | "fisheye" | "division";
  /** In the order of OpenCV: brown 5, rational 8, fisheye 4, division 1. */
  coefficients: ArrayLike<number>;
}

/** Which nearest neighbors count as matches. */
export interface MatchOptions {
  /**
   * The nearest must be closer than this share of the second nearest, in (0, 1]; `None` leaves the test
   * out. Lowe 2004, §7.1. @default 0.800000011920929
   */
  maxRatio?: number | null;
  /** Require mutual nearest neighbors. @default true */
  mutual?: boolean;
  /** The largest distance, ≥ 0; `None` for any. @default null */
  maxDistance?: number | null;
  /**
   * No feature of the second image in two matches: the closest stays. Mutual matches are unique already.
   * @default true
   */
  unique?: boolean;
}

/** Matches between two lists of features. */
export interface Matches {
  /** Indices in the first list. */
  indices1: Uint32Array;
  /** Indices in the second list. */
  indices2: Uint32Array;
  /** Distance of the descriptors: Euclidean, or the number of bits that differ. */
  distances: Float32Array;
  /** Distance over that of the second nearest, in [0, 1]. */
  ratios: Float32Array;
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

/** The two nearest descriptors of each descriptor. */
export interface Neighbors {
  /** Index of the nearest. */
  indices: Uint32Array;
  /** Distance of the nearest. */
  distances: Float32Array;
  /** Distance of the second nearest; Infinity if there is none. */
  secondDistances: Float32Array;
}

/** Point seen by several cameras. */
export interface NviewPoint {
  /** Point, world frame. */
  pointInWorld: Float64Array;
  /** Root mean square of its reprojection errors, pixels. */
  rmsErrorPx: number;
}

/** Options of `detectOrb`. */
export interface OrbOptions {
  /** Maximum number of features over all levels, ≥ 1. @default 1000 */
  maxFeatures?: number;
  /** Ratio of the sizes of successive levels, above 1 and at most 2. @default 1.2 */
  scaleFactor?: number;
  /** Levels of the pyramid, 1 to 16. @default 8 */
  numLevels?: number;
  /** Minimum contrast of nine neighbors in a row, for gray values in [0, 1]. @default 0.0784313753247261 */
  fastThreshold?: number;
  /** Take every direction to be 0: for cameras held upright. @default false */
  upright?: boolean;
}

/** Rectangle of pixels. */
export interface PixelRect {
  /** Left. */
  uMin: number;
  /** Top. */
  vMin: number;
  /** Right. */
  uMax: number;
  /** Bottom. */
  vMax: number;
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

/** Rectification of a rig: matches share a row, or a column if it is vertical. */
export interface Rectification {
  /** Homography from undistorted pixels of image 1 to the rectified image. */
  homography1: Float64Array;
  /** The same of image 2. */
  homography2: Float64Array;
  /** K of rectified image 1. */
  intrinsics1: Intrinsics;
  /** K of rectified image 2. */
  intrinsics2: Intrinsics;
  /** Rotation from camera 1 to the rectified camera, 9 numbers by row. */
  rotation1: Float64Array;
  /** The same of camera 2. */
  rotation2: Float64Array;
  /** Matrix from (u, v, disparity, 1) to homogeneous points, 16 numbers by row. */
  q: Float64Array;
  /** Whether matches share a column. */
  isVertical: boolean;
  /** Distance of the camera centers, meters. */
  baselineM: number;
  /** Width of the rectified images, pixels. */
  width: number;
  /** Height of the rectified images, pixels. */
  height: number;
}

/** Rectified images of a rig. */
export interface RectifiedImages {
  /** Image 1, of the kind that was given. */
  image1: ImageOfKind;
  /** Image 2. */
  image2: ImageOfKind;
  /** Rectification. */
  rectification: Rectification;
}

/** Choices of `rectifyCalibrated`. */
export interface RectifyOptions {
  /**
   * 0: zoomed in until every pixel of the results is seen by the camera. 1: zoomed out until every pixel
   * of the photographs is shown. Between: in between. @default 0
   */
  alpha?: number;
  /** Size of the results, pixels; none: that of the photographs. @default null */
  size?: ArrayLike<number> | null;
  /**
   * Whether both results have the same principal point, so that points at infinity have disparity 0.
   * Otherwise each shows what its own camera sees best. @default true
   */
  zeroDisparityAtInfinity?: boolean;
}

/** Options of `refineCorners`. */
export interface RefineOptions {
  /** Half the side of the window, pixels, 1 to 50: the window is `2 half + 1` wide. @default 5 */
  halfWindow?: number;
  /** At most so many steps. @default 40 */
  maxIterations?: number;
  /** Done when a step is shorter than this, pixels. @default 0.001 */
  tolerancePx?: number;
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

/**
 * Options of `detectSift`. The defaults are Lowe's, as OpenCV takes them, but for the blur that the
 * image is assumed to have: 0.3 in place of 0.5 pixels. The first octave is then blurred more, and
 * fewer of the features are too small to be seen from further away.
 */
export interface SiftOptions {
  /** At most so many features, the strongest; 0 means no limit. @default 0 */
  maxFeatures?: number;
  /** Layers per octave in which extrema are looked for, 1 to 10. @default 3 */
  layersPerOctave?: number;
  /** Blur of the first layer of an octave, pixels of that octave, 0.8 to 4. @default 1.6 */
  sigmaPx?: number;
  /** Blur that the image is assumed to have, pixels, 0 to `sigma_px / 2`. @default 0.3 */
  inputBlurPx?: number;
  /**
   * Start at twice the image's size (octave −1): more and smaller features, four times the work.
   * @default true
   */
  upsample?: boolean;
  /**
   * Smallest answer of an extremum times the layers per octave, for gray values in [0, 1]. @default
   * 0.03999999910593033
   */
  contrastThreshold?: number;
  /** Largest ratio of the principal curvatures, > 1. @default 10 */
  edgeThreshold?: number;
  /** At most so many directions per place, ≥ 1; each makes a feature. @default 2 */
  maxOrientations?: number;
  /**
   * A further direction needs this share of the strongest one's weight, in (0, 1]. @default
   * 0.800000011920929
   */
  orientationPeakRatio?: number;
  /** Take every direction to be 0: for cameras held upright. @default false */
  upright?: boolean;
  /** Scaling of descriptors. @default "l2" */
  normalization?: "l2" | "root";
}

/** Dense disparity of a rectified pair by comparing square windows. */
export interface StereoBm {
  /** The smallest disparity looked for, pixels; negative for cameras that converge. @default 0 */
  minDisparityPx?: number;
  /** Number of disparities, from the smallest on; 1 to 4096. @default 64 */
  numDisparities?: number;
  /**
   * Side of the window, pixels; odd, at most the picture's shorter side. The sums must fit 15 bits: `2
   * prefilter_cap window² ≤ 32766`, so at most 21 with a cap of 31. @default 15
   */
  windowPx?: number;
  /** Prefilter. @default "xSobel" */
  prefilter?: "xSobel" | "localMean";
  /** Pre-filtered values are limited to plus or minus this, 1 to 63. @default 31 */
  prefilterCap?: number;
  /**
   * The smallest mean, per pixel of the window, of the pre-filtered left values' magnitudes; 0: no such
   * test. @default 0.5
   */
  minTexture?: number;
  /**
   * Which answers are kept. @default { leftRightMaxPx: 1, maxGapPx: 0, speckleRangePx: 2, speckleSize:
   * 100, uniquenessPercent: 10 }
   */
  filter?: DisparityFilter;
}

/** Dense disparity of a rectified pair by semi-global matching. */
export interface StereoSgm {
  /** The smallest disparity looked for, pixels; negative for cameras that converge. @default 0 */
  minDisparityPx?: number;
  /** Number of disparities, from the smallest on; 1 to 4096. @default 64 */
  numDisparities?: number;
  /** Matching cost. @default "both" */
  cost?: "census" | "birchfieldTomasi" | "both";
  /** The largest cost of a difference of gray values, 1 to 63. @default 30 */
  grayCap?: number;
  /** Directions. @default "eight" */
  paths?: "four" | "five" | "eight";
  /** P1: the penalty for a change of disparity by one between neighbors. @default 20 */
  smallStepPenalty?: number;
  /** P2: the penalty for a larger change; at least P1, at most 150. @default 100 */
  largeStepPenalty?: number;
  /**
   * The difference of gray values between two neighbors that halves P2 (never below P1), since the edges
   * of objects are mostly edges of the image. 0: P2 is the same everywhere. @default 10
   */
  edgeGray?: number;
  /**
   * Which answers are kept. @default { leftRightMaxPx: 1, maxGapPx: 16, speckleRangePx: 2, speckleSize:
   * 100, uniquenessPercent: 3 }
   */
  filter?: DisparityFilter;
}

/** Options of a structure tensor. */
export interface StructureTensorOptions {
  /** The filter for the derivatives. */
  derivative?: "sobel3" | "sobel5" | "scharr";
  /** The weights of the neighbors. */
  window?: { box: number } | { gaussian: number };
  /** The units. */
  scaling?: "textbook" | "openCv";
  /** Border of the image; derivatives beyond a constant border count as 0. */
  border?: "replicate" | "reflect101" | { constant: number };
}

/** Options of `trackLucasKanade`. */
export interface TrackOptions {
  /** Half the side of the window, pixels, 1 to 50. @default 10 */
  halfWindow?: number;
  /** Levels of the pyramid, 1 to 12; each doubles the motion that can be followed. @default 4 */
  numLevels?: number;
  /** Maximum number of steps per level, ≥ 1. @default 30 */
  maxIterations?: number;
  /** Done when a step is shorter than this, pixels, > 0. @default 0.01 */
  tolerancePx?: number;
  /**
   * Minimum of the smaller eigenvalue per pixel, for slopes of gray values in [0, 1] per pixel, squared;
   * flatter windows are lost. @default 0.000001
   */
  minEigenvalue?: number;
  /**
   * Following back must end within this distance of the start, pixels; `None` leaves the check out.
   * @default 1
   */
  maxForwardBackwardPx?: number | null;
}

/** Points that were tracked from one image to the next. */
export interface Tracks {
  /** Positions in the second image, interleaved; NaN for lost points. */
  points: Float64Array;
  /** 1 for tracked points. */
  found: Uint8Array;
  /** Mean absolute difference of gray values between the two windows; NaN for lost points. */
  residuals: Float32Array;
  /** Distance between each point and itself tracked back, pixels; NaN without that check. */
  forwardBackwardPx: Float64Array;
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

/** Rectification without calibration. */
export interface UncalibratedRectification {
  /** Homography of image 1. */
  homography1: Float64Array;
  /** Homography of image 2. */
  homography2: Float64Array;
  /** Whether matches share a column. */
  isVertical: boolean;
  /** Smallest and largest disparity of the matches, pixels. */
  disparityRangePx: Float64Array;
  /** Bounds of image 1. */
  outline1: PixelRect;
  /** Bounds of image 2. */
  outline2: PixelRect;
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
  /** Pixels of points in the camera frame; NaN for points that the lens does not see. */
  project(camera: Camera, pointsInCam: Points3): Promise<Float64Array>;
  /** Pixels of points in the world; NaN for points that the camera does not see. */
  projectFromWorld(camera: PosedCameraLike, pointsInWorld: Points3): Promise<Float64Array>;
  /** Unit rays through pixels, in the camera frame; NaN for pixels without one. */
  unproject(camera: Camera, pixels: Points2): Promise<Float64Array>;
  /** Undistorted pixels, those of a camera with the same K and no lens; NaN for pixels without one. */
  pinholePixel(camera: Camera, pixels: Points2): Promise<Float64Array>;
  /** Pose of a camera at a center that looks at a target. */
  lookAt(centerInWorld: ArrayLike<number>, targetInWorld: ArrayLike<number>, upInWorld: ArrayLike<number>): Promise<RigidTransform>;
  /** Motion between two poses, `cam2FromCam1`. */
  relativeMotion(cam1FromWorld: RigidTransformLike, cam2FromWorld: RigidTransformLike): Promise<RigidTransform>;
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
  /** Gray values in [0, 1] in which features of a photo are detected. */
  photoToGray(photo: ImageLike): Promise<GrayImage>;
  /** Features of the kind that the options name, strongest first. */
  detectFeatures(image: ImageLike, options?: FeatureOptions & Control): Promise<Features>;
  /** SIFT features, strongest first. */
  detectSift(image: ImageLike, options?: SiftOptions & Control): Promise<Features>;
  /** ORB features, strongest first. */
  detectOrb(image: ImageLike, options?: OrbOptions & Control): Promise<Features>;
  /** SIFT descriptors of given keypoints. */
  describeSift(image: ImageLike, keypoints: KeypointsLike, options?: SiftOptions & Control): Promise<Descriptors>;
  /** Corner response of Harris with its factor k, such as 0.05. */
  harrisResponse(image: ImageLike, k: number, options?: StructureTensorOptions & Control): Promise<GrayImage>;
  /** Smaller eigenvalue of the structure tensor. */
  minEigenvalueResponse(image: ImageLike, options?: StructureTensorOptions & Control): Promise<GrayImage>;
  /** Corners to track, strongest first. */
  goodFeaturesToTrack(image: ImageLike, options?: GoodFeaturesOptions & Control): Promise<Keypoints>;
  /** Corners located between pixels; NaN for those that cannot be. */
  refineCorners(image: ImageLike, corners: Points2, options?: RefineOptions & Control): Promise<Float64Array>;
  /** Matches between two lists of descriptors, in the order of the first. */
  matchDescriptors(descriptors1: Descriptors, descriptors2: Descriptors, options?: MatchOptions & Control): Promise<Matches>;
  /** The two nearest of the second list for each descriptor of the first. */
  nearestTwo(descriptors1: Descriptors, descriptors2: Descriptors): Promise<Neighbors>;
  /** Points tracked from one image to the next (Lucas and Kanade, on a pyramid). */
  trackLucasKanade(first: ImageLike, second: ImageLike, points: Points2, options?: TrackOptions & Control): Promise<Tracks>;
  /** Rectifies a calibrated rig with cameras of the same size. */
  rectifyCalibrated(camera1: Camera, camera2: Camera, cam2FromCam1: RigidTransformLike, options?: RectifyOptions & Control): Promise<Rectification>;
  /** Rectifies a calibrated rig and its images; pixels that the camera did not see are black. */
  rectifyImages(image1: ImageLike, image2: ImageLike, camera1: Camera, camera2: Camera, cam2FromCam1: RigidTransformLike, options?: RectifyOptions & Control): Promise<RectifiedImages>;
  /** Rectifies two images from their fundamental matrix and matches without outliers. */
  rectifyUncalibrated(fundamental: Matrix, pixels1: Points2, pixels2: Points2, width: number, height: number): Promise<UncalibratedRectification>;
  /**
   * Disparities `uLeft - uRight` of the pixels of a rectified image by block matching; NaN without a
   * match.
   */
  stereoBm(left: ImageLike, right: ImageLike, options?: StereoBm & Control): Promise<GrayImage>;
  /**
   * Disparities `uLeft - uRight` of the pixels of a rectified image by semi-global matching; NaN without
   * a match.
   */
  stereoSgm(left: ImageLike, right: ImageLike, options?: StereoSgm & Control): Promise<GrayImage>;
  /**
   * Removes connected regions of fewer than `minSize` pixels, whose neighbors differ by at most
   * `rangePx`.
   */
  removeSpeckles(disparity: GrayImage, minSize: number, rangePx: number): Promise<GrayImage>;
  /** Depth of every pixel, meters; NaN without disparity or where it is not positive. */
  depthImage(disparity: GrayImage, focalPx: number, baselineM: number): Promise<GrayImage>;
  /** Points of all pixels with a disparity, interleaved, by the matrix Q of a rectification. */
  pointCloud(disparity: GrayImage, q: Matrix): Promise<Float64Array>;
  /** Depth of a disparity, meters. */
  depthFromDisparity(focalPx: number, baselineM: number, disparityPx: number): Promise<number>;
}
