/** Functions, options and results. Written by `make bless-vision` from `epipole-js`. */

import type { Control } from "./control.js";
import type { Picture } from "./pictures.js";

/** A part of the library, a module. */
export type Part = "homography" | "geometry" | "images" | "all";

/** Parts of the library. @hidden */
export const PART_NAMES: readonly Part[] = ["homography", "geometry", "images", "all"];

/** Larger parts that contain each part, smallest first. @hidden */
export const LARGER: Readonly<Record<Part, readonly Part[]>> = {
  homography: ["geometry", "all"],
  geometry: ["all"],
  images: ["all"],
  all: [],
};

/** Smallest part and parameters of each function. @hidden */
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
  composeTransforms: ["geometry", "aFromB", "bFromC"],
  invertTransform: ["geometry", "aFromB"],
  transformPoints: ["geometry", "aFromB", "pointsInB"],
  rotationAngleRad: ["geometry", "aFromB"],
  intrinsicsMatrix: ["geometry", "intrinsics"],
  projectionMatrix: ["geometry", "camera"],
  estimateHomographyCalibrated: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "options"],
  estimateFundamental: ["geometry", "pixels1", "pixels2", "options"],
  estimateEssential: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "options"],
  estimateRelativePose: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "options"],
  estimateRelativePoseWithGravity: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "gravity1", "gravity2", "options"],
  estimateRelativePoseAndFocal: ["geometry", "pixels1", "pixels2", "principal1", "principal2", "options"],
  fundamental8point: ["geometry", "pixels1", "pixels2"],
  fundamental8pointExplained: ["geometry", "pixels1", "pixels2"],
  fundamental8pointUnnormalized: ["geometry", "pixels1", "pixels2"],
  epipolarRow: ["geometry", "pixels1", "pixels2"],
  fundamental7point: ["geometry", "pixels1", "pixels2"],
  essential8point: ["geometry", "rays1", "rays2"],
  essential5point: ["geometry", "rays1", "rays2"],
  essential6point: ["geometry", "pixels1", "pixels2", "principal1", "principal2"],
  relativePose3point: ["geometry", "rays1", "rays2", "gravity1", "gravity2"],
  refineFundamental: ["geometry", "fundamental", "pixels1", "pixels2", "loss"],
  refineRelativePose: ["geometry", "cam2FromCam1", "pixels1", "pixels2", "camera1", "camera2", "loss"],
  sampsonPx: ["geometry", "fundamental", "pixels1", "pixels2"],
  tangentSampsonPx: ["geometry", "cam2FromCam1", "pixels1", "pixels2", "camera1", "camera2"],
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
  estimateLine: ["geometry", "points", "options"],
  fitLineTotalLeastSquares: ["geometry", "points"],
  fitLineHuber: ["geometry", "points", "widthPx"],
  leastMedianLine: ["geometry", "points", "options"],
  numTrialsWithReplacement: ["geometry", "inlierRatio", "sampleSize", "confidence"],
  numTrialsWithoutReplacement: ["geometry", "numInliers", "numData", "sampleSize", "confidence"],
  estimateTwoView: ["geometry", "pixels1", "pixels2", "options"],
  estimateTwoViewCalibrated: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "options"],
  estimateRotation: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "options"],
  findDegeneracy: ["geometry", "pixels1", "pixels2", "inliers", "options"],
  findUnmoved: ["geometry", "pixels1", "pixels2", "inliers", "options"],
  findExplainingRotation: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "inliers", "options"],
  findRotationAndFocal: ["geometry", "pixels1", "pixels2", "camera1", "camera2", "inliers", "options"],
  twoViewProblem: ["geometry", "options"],
  multiViewProblem: ["geometry", "options"],
  centeredDifference: ["images", "image", "border"],
  sobel: ["images", "image", "border"],
  derivative: ["images", "image", "kind", "border"],
  gaussianDerivative: ["images", "image", "sigmaPx", "border"],
  gaussianBlur: ["images", "image", "sigmaPx", "border"],
  boxFilter: ["images", "image", "size", "border"],
  correlate: ["images", "image", "kernel", "border"],
  warpPerspective: ["images", "image", "outFromImage", "options"],
  warpAffine: ["images", "image", "outFromImage", "options"],
  resize: ["images", "image", "width", "height"],
  pyramidDown: ["images", "image", "border"],
  pyramidUp: ["images", "image", "width", "height"],
  gaussianPyramid: ["images", "image", "numLevels"],
  laplacianPyramid: ["images", "image", "numLevels"],
  fromLaplacianPyramid: ["images", "levels"],
  sharpness: ["images", "image"],
  photoToGray: ["images", "photo"],
  detectFeatures: ["images", "image", "options"],
  detectSift: ["images", "image", "options"],
  detectOrb: ["images", "image", "options"],
  describeSift: ["images", "image", "keypoints", "options"],
  describePatches: ["images", "image", "keypoints", "size", "spacingPx"],
  harrisResponse: ["images", "image", "k", "options"],
  minEigenvalueResponse: ["images", "image", "options"],
  goodFeaturesToTrack: ["images", "image", "options"],
  nonMaximumSuppression: ["images", "response", "radius", "threshold"],
  refineCorners: ["images", "image", "corners", "options"],
  matchDescriptors: ["images", "descriptors1", "descriptors2", "options"],
  nearestTwo: ["images", "descriptors1", "descriptors2"],
  trackLucasKanade: ["images", "first", "second", "points", "options"],
  windowTensor: ["images", "image", "u", "v", "options"],
  windowTensorFromGradients: ["images", "gradients"],
  windowHarris: ["images", "tensor", "k"],
  shiftSurface: ["images", "image", "u", "v", "halfWindow", "reach", "border"],
  rectifyCalibrated: ["images", "camera1", "camera2", "cam2FromCam1", "options"],
  rectifyImages: ["images", "image1", "image2", "camera1", "camera2", "cam2FromCam1", "options"],
  rectifyUncalibrated: ["images", "fundamental", "pixels1", "pixels2", "width", "height"],
  stereoBm: ["images", "left", "right", "options"],
  stereoSgm: ["images", "left", "right", "options"],
  removeSpeckles: ["images", "disparity", "minSize", "rangePx"],
  fillGaps: ["images", "disparity", "left"],
  qFromRig: ["images", "focalPx", "baselineM", "cuPx", "cvPx"],
  depthImage: ["images", "disparity", "focalPx", "baselineM"],
  pointCloud: ["images", "disparity", "q"],
  depthFromDisparity: ["images", "focalPx", "baselineM", "disparityPx"],
  depthInterval: ["images", "focalPx", "baselineM", "disparityPx", "errorPx"],
  undistortionMap: ["images", "camera", "keep"],
  undistortImage: ["images", "image", "camera", "keep"],
  remap: ["images", "image", "map"],
  findBoard: ["all", "image", "board", "options"],
  detectMarkers: ["all", "image", "dictionary", "options"],
  boardMarks: ["all", "board"],
  boardDrawing: ["all", "board"],
  renderBoard: ["all", "board", "camera", "camFromBoard", "noise", "seed"],
  calibrate: ["all", "board", "views", "width", "height", "options"],
  calibrateRig: ["all", "board", "leftCamera", "rightCamera", "left", "right", "options"],
  intrinsicsFromPlanes: ["all", "pixelsFromPlane"],
  twoViewReconstruction: ["all", "pixels1", "pixels2", "camera1", "camera2", "cam2FromCam1", "options"],
  adjustBundle: ["all", "bundle", "options"],
  matchPhotos: ["all", "photos", "options"],
  reconstruct: ["all", "images", "cameras", "pairs", "options"],
  reconstructPhotos: ["all", "photos", "cameras", "photoOptions", "options"],
  optimizePoseGraph: ["all", "edges", "numVertices", "worldFromVertex", "loss", "options"],
  averageRotations: ["all", "measured", "numViews", "loss", "options"],
  photoFeatures: ["all", "photo", "options"],
  matchFeatures: ["all", "features", "options"],
  matchRectified: ["all", "left", "right", "options"],
  localize: ["all", "reconstruction", "features", "photo", "camera", "options"],
  buildTracks: ["all", "numKeypoints", "pairs"],
  verifyMatches: ["all", "pair", "image1", "image2", "camera1", "camera2", "options"],
  triangulateTracks: ["all", "images", "cameras", "pairs", "camFromWorld", "options"],
  monocularOdometry: ["all", "images", "cameras", "pairs", "options"],
  stereoOdometry: ["all", "images", "cameras", "pairs", "right", "leftRight", "rightFromLeft", "rightCamera", "options"],
  moveReconstruction: ["all", "reconstruction", "toFromWorld"],
  meanReprojectionPx: ["all", "reconstruction", "images"],
  reconstructionBundle: ["all", "reconstruction", "images"],
  determinesFocal: ["all", "reconstruction", "images"],
  refineLenses: ["all", "reconstruction", "images", "options"],
  whyUnregistered: ["all", "images", "cameras", "pairs", "result", "options"],
  alignPoints: ["all", "fromPoints", "toPoints", "kind"],
  absoluteTrajectoryError: ["all", "estimated", "truth", "kind"],
  relativePoseError: ["all", "estimated", "truth", "step"],
  estimateSimilarityOfPoints: ["all", "fromPoints", "toPoints", "maxDistance", "seed"],
  closeLoops: ["all", "worldFromCam", "loops", "motion", "loss", "options"],
  prepareViews: ["all", "reconstruction", "photos", "options"],
  estimateDepthMaps: ["all", "views", "options"],
  fuseDepthMaps: ["all", "views", "maps", "options"],
  meshDepthMaps: ["all", "views", "maps", "options"],
  textureMesh: ["all", "mesh", "views", "options"],
  findOverlap: ["all", "image1", "image2", "pixels1", "pixels2", "options"],
  estimatePanorama: ["all", "intrinsics", "overlaps", "findFocal", "options"],
  chainHomographies: ["all", "numImages", "overlaps"],
  renderPanorama: ["all", "panorama", "photos", "options"],
  localFromGeodetic: ["all", "place", "origin"],
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

/** Bundle after its adjustment. */
export interface AdjustedBundle {
  /** Refined cameras and points, with the observations that were given. */
  bundle: Bundle;
  /** Report of the refinement. */
  report: LmReport;
}

/** Rotations of views that agree best with those between pairs of them. */
export interface AveragedRotations {
  /**
   * Rotation of each view, with a translation of 0. The first view of each connected part has the
   * identity.
   */
  viewFromWorld: RigidTransform[];
  /** Angle by which each measurement is off, radians. */
  errorsRad: Float64Array;
}

/** Flat board with marks at known places: x along its columns, y along its rows, z = 0. */
export interface Board {
  /**
   * Marks. Markers of a ChArUco board have `markerRatio` of the side of its squares; tags of an
   * AprilGrid are `spacing` of their side apart.
   */
  pattern: "chessboard" | "circles" | "asymmetricCircles" | { charuco: { dictionary: "Aruco4x4_50" | "Aruco4x4_100" | "Aruco4x4_250" | "Aruco4x4_1000" | "Aruco5x5_50" | "Aruco5x5_100" | "Aruco5x5_250" | "Aruco5x5_1000" | "Aruco6x6_50" | "Aruco6x6_100" | "Aruco6x6_250" | "Aruco6x6_1000" | "Aruco7x7_50" | "Aruco7x7_100" | "Aruco7x7_250" | "Aruco7x7_1000" | "AprilTag36h11"; markerRatio: number } } | { aprilGrid: { spacing: number } };
  /** Inner corners of a chessboard, squares of a ChArUco board, tags of an AprilGrid, disks in a row. */
  columns: number;
  /** The same along a column; rows of disks. */
  rows: number;
  /** Side of a square or a tag, or distance of two rows of disks, meters. */
  squareM: number;
}

/** Black shapes of a board, in squares; the first mark is at the origin, y points down. */
export interface BoardDrawing {
  /** Upper left and lower right corner of each rectangle, 4 numbers each. */
  rectangles: Float64Array;
  /** Centers of disks, interleaved. */
  disks: Float64Array;
  /** Radius of the disks. */
  diskRadius: number;
}

/** Cameras, points and observations. */
export interface Bundle {
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
  /** Number of the lens of each camera; 0 for missing entries. */
  lensOfCamera: Uint32Array;
  /** Further cameras mounted on each camera. */
  sensors: Sensor[];
  /** Sensor of each observation, 0 for the camera itself and for missing entries. */
  observationSensor: Uint32Array;
}

/** Cameras, points and observations: entry k of each array of observations belongs to observation k. */
export interface BundleLike {
  /** Cameras. */
  cameras: readonly PosedCameraLike[];
  /** Points in the world. */
  points: Points3;
  /** Index of the camera. */
  observationCamera: ArrayLike<number>;
  /** Index of the point. */
  observationPoint: ArrayLike<number>;
  /** Measured pixel. */
  observationPixel: Points2;
  /**
   * Number of the lens of each camera; 0 for missing entries. Cameras of one lens have equal lenses and
   * share its refined parameters.
   */
  lensOfCamera?: ArrayLike<number>;
  /** Further cameras mounted on each camera. */
  sensors?: readonly SensorLike[];
  /** 0 if the camera itself made the observation, k if sensor k - 1 did; 0 for missing entries. */
  observationSensor?: ArrayLike<number>;
}

/** Options of `adjustBundle`. */
export interface BundleOptions {
  /**
   * Stopping criteria of the solver. @default { costTolerance: 0.000000001, gradientTolerance:
   * 0.0000000001, initialDamping: 0.0001, maxIterations: 50, patience: 0, stepTolerance: 0.0000000001 }
   */
  lm?: LmOptions;
  /** Loss of each reprojection error; width in pixels. @default "trivial" */
  loss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } };
  /** Gauge while fewer than two cameras are held. @default "twoCameras" */
  gauge?: "twoCameras" | "free";
  /** Cameras held fixed, by index; missing entries are free. @default [] */
  heldCameras?: readonly (boolean)[];
  /** Points held fixed, by index; missing entries are free. @default [] */
  heldPoints?: readonly (boolean)[];
  /** Refine a factor of the focal lengths, one per lens. @default false */
  refineFocal?: boolean;
  /** Refine the principal points: one shift per lens, pixels. @default false */
  refinePrincipalPoint?: boolean;
  /**
   * Refine the radial terms of each lens: k1 and k2 of Brown's model, k1 to k6 of the rational one, k1
   * to k4 of a fisheye, k of the division model. @default false
   */
  refineDistortion?: boolean;
  /**
   * Refine the tangential terms p1 and p2 of each lens; fisheyes and the division model have none.
   * @default false
   */
  refineTangential?: boolean;
  /**
   * Priors of camera positions, by index; missing entries are unknown. With any prior, no camera is held
   * by the gauge. @default []
   */
  positionPriors?: readonly (PositionPrior | null)[];
  /** Loss of the position priors; width in standard deviations. @default "trivial" */
  positionLoss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } };
}

/** Calibration result of one view. */
export interface CalibratedView {
  /** Pose of the board, meters. */
  camFromBoard: RigidTransform;
  /** Root mean square of its reprojection errors, pixels. */
  rmsPx: number;
  /** Number of visible marks. */
  numMarks: number;
}

/** Calibrated camera and its uncertainty. */
export interface Calibration {
  /** Camera. */
  camera: Camera;
  /** Root mean square of all reprojection errors: distances, pixels. */
  rmsPx: number;
  /** Standard deviation of fu, fv, cu, cv, pixels. */
  stdDevK: Float64Array;
  /** Standard deviation of each coefficient of the lens. */
  stdDevLens: Float64Array;
  /** Share of the area of the image inside the marks of some view, 0 to 1. */
  coverage: number;
  /** Result of each view; null where none was given. */
  views: (CalibratedView | null)[];
  /** Causes of uncertainty that the errors do not show. */
  warnings: CalibrationWarning[];
}

/** Options of `calibrate`. */
export interface CalibrationOptions {
  /** Lens model. @default "brown" */
  lens?: "brown" | "rational" | "fisheye" | "division";
  /** Maximum number of refinement steps. @default 200 */
  maxIterations?: number;
}

/** Cause of uncertainty that the errors of a calibration do not show. */
export interface CalibrationWarning {
  /** Kind: parallel, uncertainFocal, lowCoverage, badView, or other. */
  kind: string;
  /** Cause as a sentence. */
  message: string;
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

/** Path after its loops are closed. */
export interface ClosedPath {
  /** Pose of the camera of each frame in the world. */
  worldFromCam: RigidTransform[];
  /** Factor for lengths around each frame. */
  scale: Float64Array;
  /** Report of the optimization. */
  report: PoseGraphReport;
}

/** Matches that satisfy the epipolar constraint; NaN for those without a correction. */
export interface CorrectedMatches {
  /** Pixels of image 1, interleaved. */
  pixels1: Float64Array;
  /** Pixels of image 2, interleaved. */
  pixels2: Float64Array;
}

/** Reason why the inliers of a model do not determine it. */
export interface Degeneracy {
  /** Kind. */
  kind: "unmoved" | "homography";
  /** Number of inliers that show it. */
  numExplained: number;
  /** Number of inliers. */
  numInliers: number;
}

/** Depths that a disparity and its error allow. */
export interface DepthInterval {
  /** Smallest depth, meters. */
  nearM: number;
  /** Largest depth, meters; null if the interval reaches infinity. */
  farM: number | null;
}

/** Depth and normal of each pixel of a view, row by row. */
export interface DepthMap {
  /** Depth along the optical axis, in the unit of the reconstruction; NaN if unknown. */
  depth: GrayImage;
  /** Unit normals in the camera's frame, towards the camera, 3 numbers each; 0 without depth. */
  normals: Float32Array;
  /** Number of photos that agree on the depth, including this one; 0 without depth. */
  numViews: Uint8Array;
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

/** Tests of the disparities of a dense matcher. */
export interface DisparityFilter {
  /**
   * Minimum percentage by which the costs of all disparities two or more away must exceed the best, 0 to
   * 99; 0 disables this test.
   */
  uniquenessPercent?: number;
  /**
   * Maximum difference between the disparities from the left and from the right, pixels; `None` disables
   * this test.
   */
  leftRightMaxPx?: number | null;
  /** Minimum number of connected pixels: smaller sets are removed; 0 or 1 disables this test. */
  speckleSize?: number;
  /** Maximum difference of disparities between connected neighbors, pixels. */
  speckleRangePx?: number;
  /**
   * Maximum length of a gap along a row or column, pixels, to close by interpolation if the disparities
   * at its ends are connected; 0 disables this.
   */
  maxGapPx?: number;
}

/** Fundamental matrix by the eight-point method, with its intermediate results. */
export interface EightPoint {
  /** F of rank 2 and unit norm. */
  fundamental: Float64Array;
  /** Least-squares solution before its rank was lowered to 2, of unit norm. */
  fullRank: Float64Array;
  /** The 9 singular values of the linear system, largest first. */
  singularValues: Float64Array;
  /** Largest singular value over the eighth: amplification of errors of the data. */
  conditionNumber: number;
}

/** Epipoles: (u, v, 1), or (u, v, 0) with a unit direction for those at infinity. */
export interface Epipoles {
  /** Epipole of image 1. */
  epipole1: Float64Array;
  /** Epipole of image 2. */
  epipole2: Float64Array;
}

/** Statistics of errors. */
export interface ErrorStatistics {
  /** Root of the mean square. */
  rmse: number;
  /** Mean. */
  mean: number;
  /** Median; the lower of the middle two for an even number. */
  median: number;
  /** Maximum. */
  max: number;
}

/** Essential matrix and focal length. */
export interface EssentialWithFocal {
  /** Essential matrix. */
  essential: Float64Array;
  /** Focal length, pixels. */
  focalPx: number;
}

/** Rotation that explains nearly all inliers of a model. */
export interface ExplainingRotation {
  /** Rotation, with a translation of 0. */
  cam2FromCam1: RigidTransform;
  /** Number of inliers that it explains. */
  numExplained: number;
  /** Number of inliers. */
  numInliers: number;
}

/**
 * Options of feature detection, with the defaults of all commands and of `PhotoOptions`; see
 * `MatchOptions` and `RansacOptions` for matches and models.
 */
export interface FeatureOptions {
  /** RootSIFT. @default "rootSift" */
  kind?: "sift" | "rootSift" | "orb" | "harris";
  /** Maximum number of features; the strongest are kept. 0 means no limit. 8192. @default 8192 */
  maxFeatures?: number;
  /**
   * Minimum response of a feature, for gray values in [0, 1]; `None` for the default of the kind. SIFT:
   * `contrastThreshold`, 0.02, which includes faint features. ORB: `fastThreshold`, 20/255. Harris:
   * ratio to the strongest response, `quality`, 0.01. @default null
   */
  contrastThreshold?: number | null;
  /** Assume direction 0, for upright cameras. Harris corners have no direction. False. @default false */
  upright?: boolean;
  /**
   * SIFT: images of up to this many pixels are also searched at twice their size; larger ones, for which
   * this takes seconds, only if they have fewer than `maxFeatures` without; none if 0. 1.5 million.
   * @default 1500000
   */
  maxUpsampledPixels?: number;
  /**
   * SIFT: assumed blur of the input, pixels, 0 to half of `sigmaPx`. 0.5, as Lowe's; 0.3 gives more
   * matches in sharp images, fewer where features are rare. @default 0.5
   */
  inputBlurPx?: number;
  /** SIFT: blur of the first layer of an octave, pixels of that octave, 0.8 to 4. 1.6. @default 1.6 */
  sigmaPx?: number;
  /** SIFT: number of layers per octave that are searched for extrema, 1 to 10. 3. @default 3 */
  layersPerOctave?: number;
  /** SIFT: maximum ratio of the principal curvatures, > 1. 10. @default 10 */
  edgeThreshold?: number;
  /** SIFT: maximum number of directions per position, ≥ 1; each gives a feature. 2. @default 2 */
  maxOrientations?: number;
  /**
   * SIFT: minimum weight of a further direction, relative to the strongest, in (0, 1]. 0.8. @default
   * 0.800000011920929
   */
  orientationPeakRatio?: number;
  /** ORB: number of levels of the pyramid, 1 to 16. 8. @default 8 */
  numLevels?: number;
  /** ORB: ratio of the sizes of successive levels, above 1 and at most 2. 1.2. @default 1.2 */
  scaleFactor?: number;
  /** Harris: constant k of the measure, 0 to below 0.25. 0.04. @default 0.03999999910593033 */
  harrisK?: number;
  /** Harris: minimum distance between corners, pixels; 0 allows neighbors. 8. @default 8 */
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

/** Result of a search for a board. */
export interface FoundBoard {
  /** Pixel of each mark, row by row, interleaved; NaN for hidden marks. Null without a board. */
  pixels: Float64Array | null;
  /** Number of visible marks. */
  numVisible: number;
  /** Why the board was not found, as a sentence; null if it was. */
  problem: string | null;
}

/** Position on the earth, WGS 84, such as from GPS. */
export interface Geodetic {
  /** Latitude, north positive, degrees. */
  latitudeDeg: number;
  /** Longitude, east positive, degrees. */
  longitudeDeg: number;
  /** Height above the ellipsoid, meters. */
  heightM: number;
}

/** Options of `goodFeaturesToTrack`. */
export interface GoodFeaturesOptions {
  /** Maximum number of corners; 0 means no limit. @default 1000 */
  maxCorners?: number;
  /** Minimum response relative to the strongest corner, in (0, 1]. @default 0.009999999776482582 */
  quality?: number;
  /** Minimum distance between corners, pixels; 0 allows neighbors. @default 8 */
  minDistancePx?: number;
  /** Corner measure. @default "shiTomasi" */
  measure?: "shiTomasi" | { harris: number };
  /**
   * Options of the structure tensor. @default { border: "reflect101", derivative: "sobel3", scaling:
   * "textbook", window: { box: 3 } }
   */
  tensor?: StructureTensorOptions;
  /**
   * With a grid and a limit, each cell first contributes an equal number of its strongest corners; cells
   * with too few leave the remainder to the strongest of the rest. @default null
   */
  grid?: Grid | null;
}

/** Partial derivatives of an image. */
export interface Gradient {
  /** Derivative along u, to the right. */
  du: GrayImage;
  /** Derivative along v, downwards. */
  dv: GrayImage;
  /** Length of the gradient. */
  magnitude: GrayImage;
  /** Direction of steepest ascent, atan2(dv, du), radians; 0 where the image is flat. */
  orientation: GrayImage;
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

/** Grid that distributes the corners evenly over the image. */
export interface Grid {
  /** Number of columns of cells, ≥ 1. */
  columns?: number;
  /** Number of rows of cells, ≥ 1. */
  rows?: number;
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

/** An image; in browsers also an `ImageBitmap`, a `VideoFrame`, or a `Blob` or `File` with an encoded image. */
export type ImageSource = ImageLike | Picture;

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

/** Keypoints of several photos that show the same point: entry k of each array belongs to keypoint k. */
export interface KeypointTracks {
  /** Number of its track, increasing. */
  track: Uint32Array;
  /** Index of its photo. */
  image: Uint32Array;
  /** Index of the keypoint in the photo. */
  keypoint: Uint32Array;
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

/** Line with the least median of squared distances. */
export interface LeastMedianLine {
  /** Line (a, b, c), fitted to its inliers: `a u + b v + c = 0`, a² + b² = 1. */
  model: Float64Array;
  /** Median distance from the best line of a sample, pixels. */
  medianPx: number;
  /** Standard deviation of the noise that follows from the median, pixels. */
  sigmaPx: number;
  /** Number of points within 2.5 standard deviations, equal points counted once. */
  numInliers: number;
}

/** Options of `leastMedian`. */
export interface LeastMedianOptions {
  /** Number of samples, ≥ 1. 500. @default 500 */
  numSamples?: number;
  /** Equal seeds give equal results. 0. @default 0 */
  seed?: number;
}

/** A lens model with its coefficients. */
export interface Lens {
  /** Model. */
  kind: "brown" | "rational" | "fisheye" | "division";
  /** In the order of OpenCV: brown 5, rational 8, fisheye 4, division 1. */
  coefficients: ArrayLike<number>;
}

/** Step of a Levenberg-Marquardt loop. */
export interface LmIteration {
  /** Counted from 1; 0 is the start. */
  index: number;
  /** Best cost so far. */
  cost: number;
  /** Damping of the step. */
  damping: number;
  /** Whether the step lowered the cost and was kept. */
  accepted: boolean;
}

/** Options of the Levenberg–Marquardt solver. */
export interface LmOptions {
  /** Maximum number of steps, including rejected ones. @default 50 */
  maxIterations?: number;
  /** Maximum gradient component at convergence. @default 0.0000000001 */
  gradientTolerance?: number;
  /** Maximum step length at convergence, relative to the parameters' length. @default 0.0000000001 */
  stepTolerance?: number;
  /** Maximum relative decrease of the cost by an accepted step at convergence. @default 0.000000001 */
  costTolerance?: number;
  /** Initial λ, relative to the diagonal of `JᵀJ`. @default 0.0001 */
  initialDamping?: number;
  /**
   * Maximum number of steps in a row that raise the cost before the solver returns to the best
   * parameters and tries smaller steps. 0, a cost that never rises, suits most problems; on pose graphs
   * the full step first bends the trajectory and only the next one straightens it. @default 0
   */
  patience?: number;
}

/** Result of a Levenberg-Marquardt loop. */
export interface LmReport {
  /** Cost at the start: half the sum of the losses of all residuals. */
  initialCost: number;
  /** Cost at the end. */
  finalCost: number;
  /** Number of steps tried. */
  iterations: number;
  /** Number of steps kept. */
  accepted: number;
  /** Reason for the end of the loop. */
  termination: "smallGradient" | "smallStep" | "smallCostChange" | "maxIterations" | "stuck";
  /** Start and every step tried, in order. */
  history: LmIteration[];
}

/** Photo localized in a reconstruction. */
export interface Localization {
  /** Pose of the camera. */
  camFromWorld: RigidTransform;
  /** Index of the point of each inlier. */
  inlierPoints: Uint32Array;
  /** Index of the keypoint of each inlier. */
  inlierKeypoints: Uint32Array;
  /** Number of matches between keypoints of the photo and points. */
  numMatches: number;
}

/** Options of `localize`. */
export interface LocalizeOptions {
  /**
   * Filters of the matches. Ratio 0.8, mutual. @default { maxDistance: null, maxRatio:
   * 0.800000011920929, mutual: true, unique: true }
   */
  matching?: MatchOptions;
  /**
   * Robust estimation of the pose, with a maximum reprojection error of 6 px. @default { budget:
   * "withoutReplacement", confidence: 0.999, innerIterations: 4, localOptimization: true, maxErrorPx: 6,
   * maxIterations: 10000, minIterations: 200, sampler: "uniform", score: "msac", scoreEveryTrial: false,
   * seed: 0, threshold: "given" }
   */
  ransac?: RansacOptions;
  /** Minimum number of inliers. 15. @default 15 */
  minNumInliers?: number;
}

/** Motion between two frames that show the same place. */
export interface LoopClosure {
  /** Index of the earlier frame. */
  from: number;
  /** Index of the later frame. */
  to: number;
  /** Pose of the later camera in the frame of the earlier one, with the ratio of their scales. */
  fromFromTo: Similarity3Like;
  /** Weight relative to one step of the path. 1 if not given. */
  weight?: number;
}

/** Square marker in a photo. */
export interface Marker {
  /** Number in the dictionary. */
  id: number;
  /**
   * Corners of the black border, pixels: clockwise from the one that is upper left in an upright marker.
   */
  corners: Float64Array;
  /** Number of bits that differ from the dictionary's. */
  hamming: number;
}

/** Options of `detectMarkers`. */
export interface MarkerOptions {
  /** Maximum number of wrong bits; `None` for `maxHamming`. @default null */
  maxHamming?: number | null;
  /** Width of the black border, bits; at least 1. @default 1 */
  borderBits?: number;
  /** Minimum side, pixels; markers with less than 1.5 pixels per bit are never found. @default 0 */
  minSidePx?: number;
}

/** Options of matching. */
export interface MatchOptions {
  /**
   * Maximum ratio of the distances of the nearest and second nearest, in (0, 1]; `None` disables the
   * test. Lowe 2004, §7.1. @default 0.800000011920929
   */
  maxRatio?: number | null;
  /** Require mutual nearest neighbors. @default true */
  mutual?: boolean;
  /** Maximum distance, ≥ 0; `None` for any. @default null */
  maxDistance?: number | null;
  /**
   * Keep only the closest match of each feature of the second image. Mutual matches are unique anyway.
   * @default true
   */
  unique?: boolean;
}

/** Keypoints of photos and matches between pairs of them. */
export interface MatchedPhotos {
  /** Keypoints of each photo. */
  images: SfmImage[];
  /** Matches between photos. */
  pairs: PairMatches[];
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

/** Matches between two lists of keypoints. */
export interface MatchesLike {
  /** Indices in the first list. */
  indices1: ArrayLike<number>;
  /** Indices in the second list. */
  indices2: ArrayLike<number>;
  /** Distance of the descriptors. 0 if not given. */
  distances?: ArrayLike<number>;
  /** Distance over that of the second nearest. 0 if not given. */
  ratios?: ArrayLike<number>;
}

/** A matrix: numbers by row, or an array of rows. */
export type Matrix = ArrayLike<number> | readonly ArrayLike<number>[];

/** Triangle mesh. */
export interface Mesh {
  /** Vertices with normals and colors. */
  vertices: PointCloud;
  /** Indices of the vertices, 3 for each triangle, counterclockwise as seen from outside. */
  triangles: Uint32Array;
}

/** Triangle mesh. */
export interface MeshLike {
  /** Vertices. */
  vertices: PointCloudLike;
  /** Indices of the vertices, 3 for each triangle, counterclockwise as seen from outside. */
  triangles: ArrayLike<number>;
}

/** Options of `meshDepthMaps`. */
export interface MeshOptions {
  /**
   * Edge of a voxel in the unit of the reconstruction, greater than 0; if not set, `voxelSizePx`
   * applies. None. @default null
   */
  voxelSize?: number | null;
  /** Edge of a voxel relative to a pixel's size on the surface, greater than 0. 1.5. @default 1.5 */
  voxelSizePx?: number;
  /** Minimum number of triangles of a connected piece. 100. @default 100 */
  minTriangles?: number;
}

/** Texture of a mesh. */
export interface MeshTexture {
  /** Pixels; black where no triangle needs them. */
  image: RgbImage;
  /**
   * Pixel of each corner of each triangle, in the order of its vertices, interleaved; pixel centers are
   * at integers.
   */
  corners: Float32Array;
}

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
  /** Fraction of the observations made, 0 to 1; 1 for every point in every image. @default 1 */
  visibleFraction?: number;
  /** Standard deviation of the Gaussian noise of each pixel coordinate, pixels. @default 0 */
  noisePx?: number;
  /** Fraction of the observations with a wrong pixel, 0 to 1. @default 0 */
  outlierFraction?: number;
  /** Seed of all randomness. @default 0 */
  seed?: number;
}

/** Options of multi-view stereo. */
export interface MvsOptions {
  /** Maximum longer side of photos, pixels; larger ones are downscaled. At least 32. 2048. @default 2048 */
  maxSizePx?: number;
  /** Number of neighbors with which each photo is compared, 1 to 16. 6. @default 6 */
  numNeighbors?: number;
  /** Number of neighbors used per pixel, the best ones; at least 1. 3. @default 3 */
  numBestNeighbors?: number;
  /**
   * Minimum angle between the rays of two neighboring photos, the median over their common points,
   * degrees. 1. @default 1
   */
  minAngleDeg?: number;
  /** Number of rounds of propagation at each resolution after the coarsest, at least 1. 1. @default 1 */
  numRounds?: number;
  /** Minimum weighted correlation of a depth, −1 to 1. 0.3. @default 0.3 */
  minCorrelation?: number;
  /**
   * Minimum number of photos that agree on a depth, including the photo itself; if a photo has fewer
   * neighbors, all of them. At least 2. 3. @default 3
   */
  minViews?: number;
  /**
   * Maximum error of a pixel transferred to a neighbor by its depth and back by the neighbor's, pixels,
   * greater than 0. 1. @default 1
   */
  maxReprojectionErrorPx?: number;
  /** Maximum relative difference between the depths of two photos that agree. 0.01. @default 0.01 */
  maxDepthDifference?: number;
  /** Maximum angle between the normals of two photos that agree, degrees. 30. @default 30 */
  maxNormalAngleDeg?: number;
  /** Equal seeds give equal results. 0. @default 0 */
  seed?: number;
}

/** Undistorted photo with its neighbors and depth range. */
export interface MvsView {
  /** Index of the photo in the reconstruction. */
  photo: number;
  /** Camera without distortion, with the size of the image. */
  camera: PosedCamera;
  /** Undistorted pixels. */
  image: RgbImage;
  /** Indices of the views to compare with, best first. */
  neighbors: Uint32Array;
  /** Smallest and largest depth to search, in the unit of the reconstruction. */
  depthRange: Float64Array;
}

/** Undistorted photo with its neighbors and depth range. */
export interface MvsViewLike {
  /** Index of the photo in the reconstruction. */
  photo: number;
  /** Camera without distortion, with the size of the image. */
  camera: PosedCameraLike;
  /** Undistorted pixels. */
  image: ImageLike;
  /** Indices of the views to compare with, best first; 1 to 16. */
  neighbors: ArrayLike<number>;
  /** Smallest and largest depth to search. */
  depthRange: ArrayLike<number>;
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

/** Options of visual odometry. */
export interface OdometryOptions {
  /**
   * Thresholds, in pixels and degrees. Frames are closer together than images of a collection, so
   * smaller angles are accepted: 0.3 degrees for points, 1 for the initial pair. @default {
   * maxRegistrationErrorPx: 3, maxReprojectionErrorPx: 2, minAngleDeg: 0.3, minNumInliers: 15,
   * minStartAngleDeg: 1, minTrackLength: 2, ransac: { budget: "withoutReplacement", confidence: 0.999,
   * innerIterations: 4, localOptimization: true, maxErrorPx: 1.5, maxIterations: 10000, minIterations:
   * 200, sampler: "uniform", score: "msac", scoreEveryTrial: false, seed: 0, threshold: "given" },
   * refineDistortion: false, refineFocal: false, refinePrincipalPoint: false, refineTangential: false,
   * seed: 0 }
   */
  sfm?: SfmOptions;
  /** Number of keyframes that are refined together; older ones are fixed. 8. @default 8 */
  window?: number;
  /**
   * Refine everything at the end, repeatedly until a refined focal length converges. True. @default true
   */
  finalAdjustment?: boolean;
}

/** Path of a camera. */
export interface OdometryResult {
  /**
   * Pose of the camera of each frame in the world; null if it was lost. The first frame found is the
   * origin.
   */
  worldFromCam: (RigidTransform | null)[];
  /** Frames that provide points. */
  keyframes: Uint32Array;
  /** Frames that could not be registered. */
  lost: Uint32Array;
  /** Cameras and points; for a rig, the left cameras followed by the right ones. */
  reconstruction: Reconstruction;
}

/** Pose graph after its optimization. */
export interface OptimizedGraph {
  /** Poses of the vertices. */
  worldFromVertex: RigidTransform[];
  /** Report of the optimization. */
  report: PoseGraphReport;
}

/** Options of `detectOrb`. */
export interface OrbOptions {
  /** Maximum number of features over all levels, ≥ 1. @default 1000 */
  maxFeatures?: number;
  /** Ratio of the sizes of successive levels, above 1 and at most 2. @default 1.2 */
  scaleFactor?: number;
  /** Number of levels of the pyramid, 1 to 16. @default 8 */
  numLevels?: number;
  /** Minimum contrast of nine consecutive pixels, for gray values in [0, 1]. @default 0.0784313753247261 */
  fastThreshold?: number;
  /** Assume direction 0, for upright cameras. @default false */
  upright?: boolean;
}

/** Two overlapping photos and their inliers. */
export interface Overlap {
  /** Index of the first photo. */
  image1: number;
  /** Index of the second photo. */
  image2: number;
  /** Inliers in the first photo, interleaved. */
  pixels1: Float64Array;
  /** Their matches in the second photo, interleaved. */
  pixels2: Float64Array;
  /** Homography from the first photo to the second. */
  homography: Float64Array;
  /** Number of matches, including outliers. */
  numMatches: number;
  /** Whether the matches show parallax: the camera moved, and no homography fits all of them. */
  hasParallax: boolean;
}

/** Two overlapping photos and their inliers. */
export interface OverlapLike {
  /** Index of the first photo. */
  image1: number;
  /** Index of the second photo. */
  image2: number;
  /** Inliers in the first photo. */
  pixels1: Points2;
  /** Their matches in the second photo. */
  pixels2: Points2;
  /** Homography from the first photo to the second. */
  homography: Matrix;
  /** Number of matches, including outliers. That of the inliers if not given. */
  numMatches?: number;
  /** Whether the matches show parallax. False if not given. */
  hasParallax?: boolean;
}

/** Options of `findOverlap`. */
export interface OverlapOptions {
  /**
   * Robust estimation of the homography, with a threshold of 3 px. @default { budget:
   * "withoutReplacement", confidence: 0.999, innerIterations: 4, localOptimization: true, maxErrorPx: 3,
   * maxIterations: 10000, minIterations: 200, sampler: "uniform", score: "msac", scoreEveryTrial: false,
   * seed: 0, threshold: "given" }
   */
  ransac?: RansacOptions;
  /** Minimum number of inliers. 12. @default 12 */
  minNumInliers?: number;
}

/** Matches between two photos. */
export interface PairMatches {
  /** Index of the first photo. */
  image1: number;
  /** Index of the second photo. */
  image2: number;
  /** Matches between their keypoints. */
  matches: Matches;
}

/** Matches between two photos. */
export interface PairMatchesLike {
  /** Index of the first photo. */
  image1: number;
  /** Index of the second photo. */
  image2: number;
  /** Matches between their keypoints. */
  matches: MatchesLike;
}

/** Photos in the frame of a panorama, which looks along z with y down. */
export interface Panorama {
  /** Matrix of each photo from directions of the panorama to homogeneous pixels; null without overlap. */
  pixelFromDirection: (Float64Array | null)[];
  /** Rotation of each camera, for rotating cameras: `dInCam = R d`. */
  rotations: (Float64Array | null)[];
  /** Pixels per unit of a direction at z = 1: the focal length, for rotating cameras. */
  scalePx: number;
  /** Common factor of the focal lengths, if it was estimated. */
  focalFactor: number | null;
}

/** Photos in the frame of a panorama, which looks along z with y down. */
export interface PanoramaLike {
  /**
   * Matrix of each photo from directions of the panorama to homogeneous pixels; null for photos to leave
   * out.
   */
  pixelFromDirection: readonly (Matrix | null)[];
  /** Rotation of each camera. */
  rotations?: readonly (Matrix | null)[] | null;
  /** Pixels per unit of a direction at z = 1. */
  scalePx: number;
  /** Common factor of the focal lengths. */
  focalFactor?: number | null;
}

/** Keypoints of a photo with their colors and descriptors. */
export interface PhotoFeatures {
  /** Keypoints and their colors. */
  image: SfmImage;
  /** Descriptors of the keypoints. */
  descriptors: Descriptors;
  /** The keypoints with their scales and directions. */
  keypoints: Keypoints;
}

/** Keypoints of a photo with their descriptors. */
export interface PhotoFeaturesLike {
  /** Keypoints and their colors. */
  image: SfmImageLike;
  /** Descriptors of the keypoints. */
  descriptors: Descriptors;
  /** The keypoints with their scales and directions. */
  keypoints?: KeypointsLike;
}

/** Options of `photoFeatures` and `matchFeatures`. */
export interface PhotoOptions {
  /**
   * RootSIFT, up to 8192 features, including faint ones. @default { contrastThreshold: null,
   * edgeThreshold: 10, harrisK: 0.03999999910593033, inputBlurPx: 0.5, kind: "rootSift",
   * layersPerOctave: 3, maxFeatures: 8192, maxOrientations: 2, maxUpsampledPixels: 1500000,
   * minDistancePx: 8, numLevels: 8, orientationPeakRatio: 0.800000011920929, patchPx: 11, scaleFactor:
   * 1.2, sigmaPx: 1.6, tensorWindowPx: 3, upright: false }
   */
  features?: FeatureOptions;
  /**
   * Ratio 0.8, mutual. @default { maxDistance: null, maxRatio: 0.800000011920929, mutual: true, unique:
   * true }
   */
  matching?: MatchOptions;
  /** Number of following images to match each one with, for frames in order of time. 0. @default 0 */
  neighbors?: number;
  /**
   * Number of images to match each one with that look most like it; 0 for none, and all pairs if
   * `neighbors` is 0 as well. By default 40 if `neighbors` is 0, else none. @default null
   */
  similar?: number | null;
  /**
   * Sort the matches of a pair by ambiguity, as PROSAC needs, rather than by the keypoints of the first
   * image. False. @default false
   */
  bestFirst?: boolean;
}

/** Reconstruction of photos. */
export interface PhotoReconstruction {
  /** Keypoints of each photo. */
  images: SfmImage[];
  /** Matches between photos. */
  pairs: PairMatches[];
  /** Cameras and points. */
  result: SfmResult;
}

/** Map of pixels of a result to a source. */
export interface PixelMap {
  /** Width of the result, pixels. */
  width: number;
  /** Height of the result, pixels. */
  height: number;
  /** Place (u, v) in the source that each pixel is read from, interleaved; NaN for none. */
  sources: Float32Array;
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

/** Points in space: entry k of each array belongs to point k; optional arrays may be empty. */
export interface PointCloud {
  /** Positions, interleaved. */
  points: Float64Array;
  /** Colors, 3 bytes each. */
  colors: Uint8Array;
  /** Unit normals, interleaved. */
  normals: Float64Array;
  /** Number of photos that agree on each point. */
  confidences: Float32Array;
}

/** Points in space: entry k of each array belongs to point k. */
export interface PointCloudLike {
  /** Positions. */
  points: Points3;
  /** Colors, 3 bytes each. */
  colors?: Uint8Array | Uint8ClampedArray;
  /** Unit normals. */
  normals?: Points3;
  /** Number of photos that agree on each point. */
  confidences?: ArrayLike<number>;
}

/** Points of 2 coordinates each: interleaved, or an array of 2 each. */
export type Points2 = ArrayLike<number> | readonly ArrayLike<number>[];

/** Points of 3 coordinates each: interleaved, or an array of 3 each. */
export type Points3 = ArrayLike<number> | readonly ArrayLike<number>[];

/** Measured pose of a vertex in the frame of another. */
export interface PoseGraphEdge {
  /** Index of the vertex where the edge starts. */
  from: number;
  /** Index of the vertex where the edge ends. */
  to: number;
  /** Pose of `to` in the frame of `from`. */
  fromFromTo: RigidTransformLike;
  /** Inverse covariance, 6 x 6, translation first. The identity if not given. */
  information?: Matrix;
}

/** Report of the optimization of a pose graph. */
export interface PoseGraphReport {
  /** Sum of squared errors in standard deviations at the start. */
  initialChi2: number;
  /** The same at the end; large where measurements contradict each other. */
  finalChi2: number;
  /** Number of steps tried. */
  iterations: number;
  /** Reason for the end of the loop. */
  termination: "smallGradient" | "smallStep" | "smallCostChange" | "maxIterations" | "stuck";
  /** Number of connected parts, each with a vertex that stays where it is. */
  numComponents: number;
}

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

/** Prior of a camera position, such as from GPS; `localFromGeodetic` converts degrees. */
export interface PositionPrior {
  /** Camera center in the world. */
  centerInWorld?: ArrayLike<number>;
  /** Standard deviation along each world axis, in world units. */
  sigma?: ArrayLike<number>;
}

/** Options of `Ransac`. */
export interface RansacOptions {
  /**
   * Threshold T: a data point closer to a model is an inlier. Pixels, > 0; for a custom estimator, the
   * unit of its errors. 1. @default 1
   */
  maxErrorPx?: number;
  /** Source of the threshold. Given. @default "given" */
  threshold?: "given" | "noise";
  /** Probability that at least one sample is free of outliers, in (0, 1). 0.999. @default 0.999 */
  confidence?: number;
  /**
   * Minimum number of samples, unless `maxIterations` is lower. 200, since the number required by the
   * inlier ratio assumes that any outlier-free sample leads to the best model, but with noise only some
   * do. @default 200
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
   * Whether promising models are improved from their inliers at once, and the best one at the end. True.
   * @default true
   */
  localOptimization?: boolean;
  /**
   * Number of rounds of finding and fitting inliers per local optimization; 0 acts like 1. 4. @default 4
   */
  innerIterations?: number;
  /** Formula for the sufficient number of samples. Without replacement. @default "withoutReplacement" */
  budget?: "withReplacement" | "withoutReplacement";
  /**
   * Whether every model is scored on all data, so that a figure can show its score. Otherwise scoring
   * stops as soon as a model cannot win. False. @default false
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
  couldBeRandom: boolean;
}

/** Cameras and points in one frame. */
export interface Reconstruction {
  /** Camera of each photo; null if it is not registered. */
  cameras: (PosedCamera | null)[];
  /** Points in the world, interleaved. */
  points: Float64Array;
  /** Mean color of the keypoints of each point, 3 bytes each. */
  colors: Uint8Array;
  /** Root mean square of the reprojection errors of each point, pixels. */
  errorsPx: Float64Array;
  /** Index of the point of each observation. */
  observationPoint: Uint32Array;
  /** Index of the photo of each observation. */
  observationImage: Uint32Array;
  /** Index of the keypoint of each observation. */
  observationKeypoint: Uint32Array;
  /** Whether it stands where the known positions of its photos are. */
  isPlaced: boolean;
}

/** Reconstruction as a bundle. */
export interface ReconstructionBundle {
  /** Cameras, points and observations. */
  bundle: Bundle;
  /** Index of the photo of each camera. */
  imageOfCamera: Uint32Array;
}

/** Cameras and points in one frame. */
export interface ReconstructionLike {
  /** Camera of each photo; null if it is not registered. */
  cameras: readonly (PosedCameraLike | null)[];
  /** Points in the world. */
  points: Points3;
  /** Color of each point, 3 bytes each. Gray if not given. */
  colors?: Uint8Array | Uint8ClampedArray;
  /** Root mean square of the reprojection errors of each point. 0 if not given. */
  errorsPx?: ArrayLike<number>;
  /** Index of the point of each observation. */
  observationPoint: ArrayLike<number>;
  /** Index of the photo of each observation. */
  observationImage: ArrayLike<number>;
  /** Index of the keypoint of each observation. */
  observationKeypoint: ArrayLike<number>;
  /** Whether it stands where the known positions of its photos are. False if not given. */
  isPlaced?: boolean;
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

/** Options of `rectifyCalibrated`. */
export interface RectifyOptions {
  /**
   * Zoom. 0: zoomed in until the camera covers every pixel of the results. 1: zoomed out until every
   * pixel of the images is visible. Values between interpolate. @default 0
   */
  alpha?: number;
  /** Size of the results, pixels; `None` for that of the images. @default null */
  size?: ArrayLike<number> | null;
  /**
   * Whether both results have the same principal point, so that points at infinity have disparity 0.
   * Otherwise each is centered on the view of its own camera. @default true
   */
  zeroDisparityAtInfinity?: boolean;
}

/** Options of `refineCorners`. */
export interface RefineOptions {
  /** Half the side of the window, pixels, 1 to 50: the window is `2 half + 1` wide. @default 5 */
  halfWindow?: number;
  /** Maximum number of steps. @default 40 */
  maxIterations?: number;
  /** Step length at which the refinement ends, pixels. @default 0.001 */
  tolerancePx?: number;
}

/** Reconstruction after the correction of its lenses. */
export interface RefinedLenses {
  /** Cameras and points. */
  reconstruction: Reconstruction;
  /** Whether they changed. */
  isRefined: boolean;
}

/** Rotation and direction of translation. */
export interface RelativePose {
  /** Rotation matrix R, 9 numbers by row: `x_in_cam2 = R x_in_cam1 + t`. */
  rotation: Float64Array;
  /** Unit vector t. */
  direction: Float64Array;
}

/** Errors of the motions between frames. */
export interface RelativePoseError {
  /** Errors of the translations, in the unit of the trajectories. */
  translation: ErrorStatistics;
  /** Errors of the rotations, degrees. */
  rotationDeg: ErrorStatistics;
}

/** Measured rotation between two views. */
export interface RelativeRotation {
  /** Index of the first view. */
  from: number;
  /** Index of the second view. */
  to: number;
  /** Rotation from the frame of the first view to that of the second. */
  toFromFrom: RigidTransformLike;
}

/** Options of `renderPanorama`. */
export interface RenderOptions {
  /** Projection surface. A cylinder. @default "cylinder" */
  surface?: "plane" | "cylinder" | "sphere";
  /** Blending. Bands. @default "bands" */
  blend?: "bands" | "feather" | "seams";
  /** Whether to compensate exposure. True. @default true */
  gains?: boolean;
  /** Maximum number of pixels; larger results are downscaled. 100 million. @default 100000000 */
  maxPixels?: number;
}

/** Red, green and blue, a byte each, rows from top to bottom. */
export interface RgbImage {
  /** Pixels. */
  width: number;
  /** Pixels. */
  height: number;
  /** Values. */
  data: Uint8Array;
}

/** Two cameras mounted on a rig. */
export interface RigCalibration {
  /** Motion from the left to the right camera, meters. */
  rightFromLeft: RigidTransform;
  /** Distance between the cameras, meters. */
  baselineM: number;
  /** Root mean square of the reprojection errors in both cameras, pixels. */
  rmsPx: number;
  /** Standard deviation of the rotation about the axes of the right camera, radians. */
  stdDevRotationRad: Float64Array;
  /** Standard deviation of the translation, meters. */
  stdDevTranslationM: Float64Array;
  /** Root mean square of each pair, pixels; null where not both cameras see the board. */
  pairsRmsPx: (number | null)[];
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

/** Rotation and focal length that explain nearly all inliers of a model. */
export interface RotationAndFocal {
  /** Rotation, with a translation of 0. */
  cam2FromCam1: RigidTransform;
  /** Ratio of the focal lengths to the given ones. */
  focalFactor: number;
  /** Number of unique matches that it explains. */
  numExplained: number;
  /** Number of unique matches. */
  numInliers: number;
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

/** Camera rigidly mounted on each camera of a bundle. */
export interface Sensor {
  /** From the frame of the camera to that of the sensor. */
  sensorFromCamera: RigidTransform;
  /** Size, intrinsics and lens. */
  camera: Camera;
  /** Number of its lens, as in `lensOfCamera`. */
  lens: number;
}

/** Camera rigidly mounted on each camera of a bundle, such as the right one of a rig. */
export interface SensorLike {
  /** From the frame of the camera to that of the sensor; it is not refined. */
  sensorFromCamera: RigidTransformLike;
  /** Size, intrinsics and lens. */
  camera: Camera;
  /** Number of its lens, as in `lensOfCamera`. 0 if not given. */
  lens?: number;
}

/** Keypoints of one photo. */
export interface SfmImage {
  /** Pixels of the keypoints, interleaved. */
  keypoints: Float64Array;
  /** Color of each keypoint, 3 bytes each. */
  colors: Uint8Array;
  /** Number of the lens: photos of one lens share its refined parameters. */
  lens: number;
}

/** Keypoints of one photo. */
export interface SfmImageLike {
  /** Pixels of the keypoints. */
  keypoints: Points2;
  /** Color of each keypoint, 3 bytes each. */
  colors?: Uint8Array | Uint8ClampedArray;
  /** Number of the lens: photos of one lens share its refined parameters. 0 if not given. */
  lens?: number;
  /** Position of the camera, if known. */
  position?: PositionPrior;
}

/** Options of `reconstruct`. */
export interface SfmOptions {
  /**
   * RANSAC for the essential matrix of a pair, and, with its own threshold and sampler, for registering
   * an image. The threshold is 2 pixels; the seed is ignored. @default { budget: "withoutReplacement",
   * confidence: 0.999, innerIterations: 4, localOptimization: true, maxErrorPx: 2, maxIterations: 10000,
   * minIterations: 200, sampler: "uniform", score: "msac", scoreEveryTrial: false, seed: 0, threshold:
   * "given" }
   */
  ransac?: RansacOptions;
  /** Maximum reprojection error when an image is registered, pixels. 6. @default 6 */
  maxRegistrationErrorPx?: number;
  /** Maximum reprojection error of an observation, pixels. 4. @default 4 */
  maxReprojectionErrorPx?: number;
  /** Minimum number of matches to connect two images, and of points to register one. 15. @default 15 */
  minNumInliers?: number;
  /** Minimum triangulation angle of a point, degrees. 1.5. @default 1.5 */
  minAngleDeg?: number;
  /**
   * Median triangulation angle of the initial pair, degrees; halved repeatedly until a pair has it. 16.
   * @default 16
   */
  minStartAngleDeg?: number;
  /** Minimum number of images that see a point in the result. 2. @default 2 */
  minTrackLength?: number;
  /** Refine a factor of the focal lengths, one per lens. False. @default false */
  refineFocal?: boolean;
  /**
   * Refine the principal points, one shift per lens. False, since a shift is hard to distinguish from a
   * rotation. @default false
   */
  refinePrincipalPoint?: boolean;
  /** Refine the radial terms of each lens, as by `refineDistortion`. False. @default false */
  refineDistortion?: boolean;
  /** Refine the tangential terms p1 and p2 of each lens that has them. False. @default false */
  refineTangential?: boolean;
  /** Equal seeds give equal results. 0. @default 0 */
  seed?: number;
}

/** Result of structure from motion. */
export interface SfmResult {
  /** Reconstructions that could not be connected, largest first; each has its own frame. */
  components: Reconstruction[];
  /** Indices of photos that are in none. */
  unregistered: Uint32Array;
  /** Steps taken, in order. */
  steps: SfmStep[];
}

/** Result of structure from motion. */
export interface SfmResultLike {
  /** Reconstructions that could not be connected. */
  components: readonly ReconstructionLike[];
  /** Indices of photos that are in none. */
  unregistered: ArrayLike<number>;
  /** Ignored. */
  steps?: unknown;
}

/** Step of structure from motion. */
export interface SfmStep {
  /** Kind: started, registered or adjusted. */
  kind: string;
  /** The two photos that started a component, the registered one, or none. */
  images: Uint32Array;
  /** Number of registered photos of the component; null unless one was registered. */
  numRegistered: number | null;
  /** Number of points of the component; null after an adjustment. */
  numPoints: number | null;
  /** Half the sum of the losses after the refinement, square pixels; null without one. */
  cost: number | null;
}

/** Change of a window under every shift by whole pixels up to a reach. */
export interface ShiftSurface {
  /** Largest shift to each side, pixels. */
  reach: number;
  /** Squared change under the shift (du, dv) at `(reach + dv) (2 reach + 1) + reach + du`. */
  values: Float64Array;
}

/**
 * Options of `detectSift`. The defaults are Lowe's, as in OpenCV, except for the assumed blur of the
 * image: 0.3 instead of 0.5 pixels. The first octave is then blurred more, and fewer of the features
 * are too small to be seen from farther away.
 */
export interface SiftOptions {
  /** Maximum number of features; the strongest are kept. 0 means no limit. @default 0 */
  maxFeatures?: number;
  /** Number of layers per octave that are searched for extrema, 1 to 10. @default 3 */
  layersPerOctave?: number;
  /** Blur of the first layer of an octave, pixels of that octave, 0.8 to 4. @default 1.6 */
  sigmaPx?: number;
  /** Assumed blur of the image, pixels, 0 to `sigma_px / 2`. @default 0.3 */
  inputBlurPx?: number;
  /**
   * Start at twice the image's size (octave −1): gives more and smaller features, at four times the
   * cost. @default true
   */
  upsample?: boolean;
  /**
   * Minimum response of an extremum times the layers per octave, for gray values in [0, 1]. @default
   * 0.03999999910593033
   */
  contrastThreshold?: number;
  /** Maximum ratio of the principal curvatures, > 1. @default 10 */
  edgeThreshold?: number;
  /** Maximum number of directions per position, ≥ 1; each gives a feature. @default 2 */
  maxOrientations?: number;
  /**
   * Minimum weight of a further direction, relative to the strongest, in (0, 1]. @default
   * 0.800000011920929
   */
  orientationPeakRatio?: number;
  /** Assume direction 0, for upright cameras. @default false */
  upright?: boolean;
  /** Scaling of descriptors. @default "l2" */
  normalization?: "l2" | "root";
}

/** A similarity of space: `xInA = scale * R * xInB + t`. */
export interface Similarity3 extends RigidTransform {
  /** Ratio of lengths. */
  scale: number;
}

/** A rotation, a translation and a scale. */
export interface Similarity3Like extends RigidTransformLike {
  /** Ratio of lengths. 1 if not given. */
  scale?: number;
}

/** Similarity between two lists of points. */
export interface SimilarityOfPoints {
  /** From the first list to the second. */
  toFromFrom: Similarity3;
  /** 1 for pairs that agree, otherwise 0. */
  inliers: Uint8Array;
}

/** Dense disparity of a rectified pair by block matching. */
export interface StereoBm {
  /** Minimum disparity, pixels; negative for cameras that converge. @default 0 */
  minDisparityPx?: number;
  /** Number of disparities from the minimum upwards; 1 to 4096. @default 64 */
  numDisparities?: number;
  /**
   * Side of the window, pixels; odd, at most the shorter side of the image. The sums must fit 15 bits:
   * `2 prefilter_cap window² ≤ 32766`, so at most 21 with a cap of 31. @default 15
   */
  windowPx?: number;
  /** Prefilter. @default "xSobel" */
  prefilter?: "xSobel" | "localMean";
  /** Bound of the absolute pre-filtered values, 1 to 63. @default 31 */
  prefilterCap?: number;
  /**
   * Minimum mean magnitude of the pre-filtered left values in the window; 0 disables this test. @default
   * 0.5
   */
  minTexture?: number;
  /**
   * Filter of the disparities. @default { leftRightMaxPx: 1, maxGapPx: 0, speckleRangePx: 2,
   * speckleSize: 100, uniquenessPercent: 10 }
   */
  filter?: DisparityFilter;
}

/** Dense disparity of a rectified pair by semi-global matching. */
export interface StereoSgm {
  /** Minimum disparity, pixels; negative for cameras that converge. @default 0 */
  minDisparityPx?: number;
  /** Number of disparities from the minimum upwards; 1 to 4096. @default 64 */
  numDisparities?: number;
  /** Matching cost. @default "both" */
  cost?: "census" | "birchfieldTomasi" | "both";
  /** Maximum cost of a difference of gray values, 1 to 63. @default 30 */
  grayCap?: number;
  /** Directions. @default "eight" */
  paths?: "four" | "five" | "eight";
  /** P1: penalty for a change of disparity by one between neighbors. @default 20 */
  smallStepPenalty?: number;
  /** P2: penalty for a larger change; at least P1, at most 150. @default 100 */
  largeStepPenalty?: number;
  /**
   * Difference of gray values between two neighbors that halves P2 (never below P1), since edges of
   * objects are mostly edges of the image. 0: P2 is constant. @default 10
   */
  edgeGray?: number;
  /**
   * Filter of the disparities. @default { leftRightMaxPx: 1, maxGapPx: 16, speckleRangePx: 2,
   * speckleSize: 100, uniquenessPercent: 3 }
   */
  filter?: DisparityFilter;
}

/** Options of a structure tensor. */
export interface StructureTensorOptions {
  /** Derivative filter. @default "sobel3" */
  derivative?: "sobel3" | "sobel5" | "scharr";
  /** Weights of the neighbors. @default { box: 3 } */
  window?: { box: number } | { gaussian: number };
  /** Scaling. @default "textbook" */
  scaling?: "textbook" | "openCv";
  /** Border of the image; derivatives beyond a constant border count as 0. @default "reflect101" */
  border?: "replicate" | "reflect101" | { constant: number };
}

/** Options of `textureMesh`. */
export interface TextureOptions {
  /**
   * Maximum width and height of the image, pixels, 64 to 16384; larger ones are downscaled. 8192.
   * @default 8192
   */
  maxSizePx?: number;
  /**
   * Cost of a seam along an edge, relative to the worst view of a triangle, 0 to 10: larger values give
   * fewer and larger pieces. 0.5. @default 0.5
   */
  seamCost?: number;
}

/** Options of `trackLucasKanade`. */
export interface TrackOptions {
  /** Half the side of the window, pixels, 1 to 50. @default 10 */
  halfWindow?: number;
  /** Number of levels of the pyramid, 1 to 12; each doubles the maximum motion. @default 4 */
  numLevels?: number;
  /** Maximum number of steps per level, ≥ 1. @default 30 */
  maxIterations?: number;
  /** Step length at which the iteration ends, pixels, > 0. @default 0.01 */
  tolerancePx?: number;
  /**
   * Minimum of the smaller eigenvalue per pixel, for squared gradients of gray values in [0, 1] per
   * pixel; points with flatter windows are lost. @default 0.000001
   */
  minEigenvalue?: number;
  /**
   * Maximum distance between a point and its position when tracked back, pixels; `None` disables the
   * check. @default 1
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

/** Error of a trajectory. */
export interface TrajectoryError {
  /** Distances of the centers, in the unit of the truth. */
  errors: ErrorStatistics;
  /** Alignment. */
  truthFromEstimated: Similarity3;
}

/** Options of the two-view model choice. */
export interface TwoViewOptions {
  /**
   * Options for each model that is tried. For H and rotations the threshold is 1.25 times as large, as
   * their Sampson errors have two dimensions. With `ThresholdKind::Noise` all models use the threshold
   * of F, which needs no intrinsics. @default { budget: "withoutReplacement", confidence: 0.999,
   * innerIterations: 4, localOptimization: true, maxErrorPx: 1, maxIterations: 10000, minIterations:
   * 200, sampler: "uniform", score: "msac", scoreEveryTrial: false, seed: 0, threshold: "given" }
   */
  ransac?: RansacOptions;
  /**
   * Minimum number of unique inliers; otherwise the pair is `Configuration::Degenerate`. 15. @default 15
   */
  minNumInliers?: number;
  /**
   * Minimum fraction of epipolar inliers that a homography must explain for the scene to count as a
   * plane or pure rotation. Above 1 none does. 0.8. @default 0.8
   */
  maxHomographyRatio?: number;
  /** Minimum ratio of E's inliers to F's for E to be preferred. 0.95. @default 0.95 */
  minEssentialRatio?: number;
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
  /** Number of matches, including outliers. @default 100 */
  numPoints?: number;
  /** Structure of the points, around the world's origin. @default { cube: { halfSideM: 1 } } */
  structure?: { cube: { halfSideM: number } } | { plane: { halfSideM: number } } | { corner: { halfSideM: number } };
  /** Distance between the camera centers, meters; 0 for a pure rotation. @default 1 */
  baselineM?: number;
  /** Distance of the first camera from the world's origin, meters. @default 5 */
  distanceM?: number;
  /** Standard deviation of the Gaussian noise of each pixel coordinate, pixels. @default 0 */
  noisePx?: number;
  /** Fraction of the matches with a wrong second pixel, 0 to 1. @default 0 */
  outlierFraction?: number;
  /** Seed of all randomness. @default 0 */
  seed?: number;
}

/** Two cameras and their points, in the frame of camera 1; the cameras have distance 1. */
export interface TwoViewReconstruction {
  /** Refined motion, with a translation of length 1. */
  cam2FromCam1: RigidTransform;
  /** Points, interleaved. */
  points: Float64Array;
  /** The same points as first triangulated, interleaved. */
  triangulated: Float64Array;
  /** Index of the match of each point, increasing. */
  matchOfPoint: Uint32Array;
  /** Number of matches in front of both cameras by each of the four motions of E, most first. */
  numInFront: Uint32Array;
  /** Root mean square of the reprojection errors as first triangulated, pixels. */
  rmsBeforePx: number;
  /** Root mean square after the refinement, pixels. */
  rmsPx: number;
  /** Report of the last refinement. */
  report: LmReport;
}

/** Options of `twoViewReconstruction`. */
export interface TwoViewReconstructionOptions {
  /** Minimum triangulation angle, radians, ≥ 0. @default 0.008726646259971648 */
  minAngleRad?: number;
  /** Maximum reprojection error of a point after the refinement, pixels, > 0. @default 4 */
  maxErrorPx?: number;
  /** Minimum number of points of a reconstruction. @default 15 */
  minNumPoints?: number;
  /**
   * Options of the bundle adjustment of motion and points. @default { gauge: "twoCameras", heldCameras:
   * [], heldPoints: [], lm: { costTolerance: 0.000000001, gradientTolerance: 0.0000000001,
   * initialDamping: 0.0001, maxIterations: 50, patience: 0, stepTolerance: 0.0000000001 }, loss: {
   * huber: { width: 2 } }, positionLoss: "trivial", positionPriors: [], refineDistortion: false,
   * refineFocal: false, refinePrincipalPoint: false, refineTangential: false }
   */
  bundle?: BundleOptions;
}

/** Geometry of two views. */
export interface TwoViewReport {
  /** Configuration of the views. */
  configuration: "general" | "planar" | "panoramic" | "degenerate";
  /** Kind of the model. */
  kind: "fundamental" | "essential" | "homography";
  /** Chosen matrix, 9 numbers by row. */
  model: Float64Array;
  /** Whether model and homography are of rays, not of pixels: lenses with distortion. */
  isOfRays: boolean;
  /** F, where the views have one. */
  fundamental: Float64Array | null;
  /** H, if one was found. */
  homography: Float64Array | null;
  /** Motion of calibrated views, translation of length 1, or 0 for a rotation. */
  cam2FromCam1: RigidTransform | null;
  /** Second motion that explains a plane about as well. */
  otherCam2FromCam1: RigidTransform | null;
  /** 1 for each match that fits the model, otherwise 0. */
  inliers: Uint8Array;
  /** Number of inliers. */
  numInliers: number;
  /** Matches with infinite or huge coordinates, no inliers. */
  numLeftOut: number;
  /** Threshold of F and E, pixels. */
  maxErrorPx: number;
  /** Samples drawn, over all models tried. */
  iterations: number;
  /** Samples required for the model; Infinity if no number is enough. */
  requiredIterations: number;
  /** Reason for the end of the search. */
  stop: "confident" | "exhausted" | "interrupted";
  /** Median angle at which rays of inliers meet, radians, of calibrated views with motion. */
  medianTriangulationAngleRad: number | null;
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

/** Photo without distortion. */
export interface UndistortedImage {
  /** Image of the kind that was given. */
  image: ImageOfKind;
  /** K of the new camera. */
  intrinsics: Intrinsics;
  /** Part of the image in which every pixel was photographed. */
  valid: PixelRect;
}

/** Best camera without distortion for the photos of a camera. */
export interface Undistortion {
  /** K of the new camera, with square pixels. Its images have the size of the photos. */
  intrinsics: Intrinsics;
  /** Part of the result in which every pixel was photographed. */
  valid: PixelRect;
  /** Place in the photo that each pixel of the result is read from, for `remap`. */
  map: PixelMap;
}

/** Pair of photos with matches that agree with one motion. */
export interface VerifiedPair {
  /** Verified matches. */
  pair: PairMatches;
  /** Motion of the camera, with a translation of length 1. */
  cam2FromCam1: RigidTransform;
  /**
   * Median angle at which rays of the matches meet, radians; 0 if a plane and a pure rotation explain
   * them.
   */
  medianAngleRad: number;
  /** Whether a homography explains most matches. */
  isFlat: boolean;
}

/** Options of a warp. */
export interface WarpOptions {
  /** Width of the result, pixels. @default null */
  width?: number | null;
  /** Height of the result, pixels. @default null */
  height?: number | null;
  /** Interpolation between pixels. @default "bilinear" */
  interpolation?: "bilinear" | "bicubic";
  /** Border of the image. @default null */
  border?: "replicate" | "reflect101" | { constant: number } | null;
}

/** Structure tensor of one window, and what follows from it. */
export interface WindowTensor {
  /** Sum of Iu Iu. */
  uu: number;
  /** Sum of Iu Iv. */
  uv: number;
  /** Sum of Iv Iv. */
  vv: number;
  /** Product of the eigenvalues. */
  determinant: number;
  /** Sum of the eigenvalues. */
  trace: number;
  /** The larger first. */
  eigenvalues: Float64Array;
  /** Direction of the larger one's eigenvector, atan2(v, u), radians. */
  directionRad: number;
}

/** Structure tensor of one window. */
export interface WindowTensorLike {
  /** Sum of Iu Iu. */
  uu: number;
  /** Sum of Iu Iv. */
  uv: number;
  /** Sum of Iv Iv. */
  vv: number;
}

/** Functions by part. @hidden */
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
  /** Transform after another: `aFromB` after `bFromC` is `aFromC`. */
  composeTransforms(aFromB: RigidTransformLike, bFromC: RigidTransformLike): Promise<RigidTransform>;
  /** Inverse transform: of `aFromB`, `bFromA`. */
  invertTransform(aFromB: RigidTransformLike): Promise<RigidTransform>;
  /** Points moved from frame b to frame a. */
  transformPoints(aFromB: RigidTransformLike, pointsInB: Points3): Promise<Float64Array>;
  /** Angle of the rotation of a transform, radians in [0, pi]. */
  rotationAngleRad(aFromB: RigidTransformLike): Promise<number>;
  /** Matrix K of intrinsics, 9 numbers by row. */
  intrinsicsMatrix(intrinsics: Intrinsics): Promise<Float64Array>;
  /** Projection matrix K [R | t] of a camera, 12 numbers by row, for undistorted pixels. */
  projectionMatrix(camera: PosedCameraLike): Promise<Float64Array>;
  /** Homography between the rays of two cameras of any lens, from matches with outliers, by RANSAC. */
  estimateHomographyCalibrated(pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, options?: RansacOptions & Control): Promise<RansacReport<Float64Array>>;
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
  /** Result of `fundamental8point` with its intermediate results. */
  fundamental8pointExplained(pixels1: Points2, pixels2: Points2): Promise<EightPoint>;
  /** Eight-point method without normalization of the pixels, for comparison. */
  fundamental8pointUnnormalized(pixels1: Points2, pixels2: Points2): Promise<EightPoint>;
  /**
   * Rows of the linear system of the eight-point method, 9 numbers for each match: their product with F
   * by row is `x2' F x1`.
   */
  epipolarRow(pixels1: Points2, pixels2: Points2): Promise<Float64Array>;
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
  /**
   * Sampson distances of matches through lenses from a motion, pixels; Infinity behind a camera, NaN for
   * pixels without a ray.
   */
  tangentSampsonPx(cam2FromCam1: RigidTransformLike, pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera): Promise<Float64Array>;
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
   * NaN for points at infinity and for those behind a camera.
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
  /** Line of points with outliers, by RANSAC: (a, b, c) with `a u + b v + c = 0`, a² + b² = 1. */
  estimateLine(points: Points2, options?: RansacOptions & Control): Promise<RansacReport<Float64Array>>;
  /** Line (a, b, c) with the least sum of squared distances from points. */
  fitLineTotalLeastSquares(points: Points2): Promise<Float64Array>;
  /**
   * Line (a, b, c) with the least sum of Huber losses of the distances from points, which are linear
   * beyond `widthPx` pixels.
   */
  fitLineHuber(points: Points2, widthPx: number): Promise<Float64Array>;
  /**
   * Line of points of which fewer than half are outliers, by the least median of squares; needs no
   * threshold.
   */
  leastMedianLine(points: Points2, options?: LeastMedianOptions & Control): Promise<LeastMedianLine>;
  /**
   * Number of samples that suffices for a confidence in (0, 1), if data are drawn with replacement;
   * `inlierRatio` is in [0, 1]. Infinity if no number does.
   */
  numTrialsWithReplacement(inlierRatio: number, sampleSize: number, confidence: number): Promise<number>;
  /**
   * Number of samples that suffices for a confidence in (0, 1), if data are drawn without replacement.
   * Infinity if no number does.
   */
  numTrialsWithoutReplacement(numInliers: number, numData: number, sampleSize: number, confidence: number): Promise<number>;
  /** Geometry of two views without calibration, by RANSAC: F or H. */
  estimateTwoView(pixels1: Points2, pixels2: Points2, options?: TwoViewOptions & Control): Promise<TwoViewReport>;
  /** Geometry of two calibrated views, by RANSAC: E, H or a rotation, and the motion. */
  estimateTwoViewCalibrated(pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, options?: TwoViewOptions & Control): Promise<TwoViewReport>;
  /** Rotation matrix `cam2FromCam1` of two calibrated views from the same place, by RANSAC. */
  estimateRotation(pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, options?: RansacOptions & Control): Promise<RansacReport<Float64Array>>;
  /**
   * Reason why the inliers of F or E do not determine it: they did not move, or a homography explains
   * them; null if there is none.
   */
  findDegeneracy(pixels1: Points2, pixels2: Points2, inliers: ArrayLike<number>, options?: TwoViewOptions & Control): Promise<Degeneracy | null>;
  /** The degeneracy of a model nearly all of whose inliers did not move; null if they did. */
  findUnmoved(pixels1: Points2, pixels2: Points2, inliers: ArrayLike<number>, options?: TwoViewOptions & Control): Promise<Degeneracy | null>;
  /** Rotation that explains the inliers of a model equally well; null if none does. */
  findExplainingRotation(pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, inliers: ArrayLike<number>, options?: TwoViewOptions & Control): Promise<ExplainingRotation | null>;
  /** Rotation and factor of the focal lengths that explain the inliers of a model; null if none do. */
  findRotationAndFocal(pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, inliers: ArrayLike<number>, options?: TwoViewOptions & Control): Promise<RotationAndFocal | null>;
  /** Draws points and two cameras that see them. */
  twoViewProblem(options?: TwoViewProblemOptions & Control): Promise<TwoViewProblem>;
  /** Draws points and cameras that see them. */
  multiViewProblem(options?: MultiViewProblemOptions & Control): Promise<MultiViewProblem>;
  /** Gradient by centered differences, slopes per pixel. A constant border has the unit of the values. */
  centeredDifference(image: ImageSource, border?: "replicate" | "reflect101" | { constant: number }): Promise<Gradient>;
  /** Gradient by the 3 x 3 Sobel filter, 8 times the slope per pixel. */
  sobel(image: ImageSource, border?: "replicate" | "reflect101" | { constant: number }): Promise<Gradient>;
  /**
   * Gradient by a filter of small integers, not divided by its gain: 8 for sobel3, 128 for sobel5, 32
   * for scharr.
   */
  derivative(image: ImageSource, kind?: "sobel3" | "sobel5" | "scharr", border?: "replicate" | "reflect101" | { constant: number }): Promise<Gradient>;
  /** Gradient of the image blurred by a Gaussian of standard deviation `sigmaPx`, slopes per pixel. */
  gaussianDerivative(image: ImageSource, sigmaPx: number, border?: "replicate" | "reflect101" | { constant: number }): Promise<Gradient>;
  /** Image blurred by a Gaussian of standard deviation `sigmaPx`, cut off at about 4 of them. */
  gaussianBlur(image: ImageSource, sigmaPx: number, border?: "replicate" | "reflect101" | { constant: number }): Promise<GrayImage>;
  /** Mean of the `size` x `size` window around each pixel; `size` is odd. */
  boxFilter(image: ImageSource, size: number, border?: "replicate" | "reflect101" | { constant: number }): Promise<GrayImage>;
  /** Image correlated with a kernel with odd sides, which is not flipped. */
  correlate(image: ImageSource, kernel: ImageSource, border?: "replicate" | "reflect101" | { constant: number }): Promise<GrayImage>;
  /** Image moved by a homography from its pixels to those of the result, up to scale. */
  warpPerspective(image: ImageSource, outFromImage: Matrix, options?: WarpOptions & Control): Promise<ImageOfKind>;
  /** Image moved by an affine map, 2 x 3, from its pixels to those of the result. */
  warpAffine(image: ImageSource, outFromImage: Matrix, options?: WarpOptions & Control): Promise<ImageOfKind>;
  /**
   * Image of another size: means over the area of each new pixel where it shrinks, interpolated where it
   * grows.
   */
  resize(image: ImageSource, width: number, height: number): Promise<GrayImage>;
  /** Image smoothed and reduced to half its size, rounded up. */
  pyramidDown(image: ImageSource, border?: "replicate" | "reflect101" | { constant: number }): Promise<GrayImage>;
  /** Image enlarged to a size that `pyramidDown` would halve to its own. */
  pyramidUp(image: ImageSource, width: number, height: number): Promise<GrayImage>;
  /** Image and its halves, at most `numLevels`, down to one pixel. */
  gaussianPyramid(image: ImageSource, numLevels: number): Promise<GrayImage[]>;
  /** Differences between the levels of a Gaussian pyramid, and its last level. */
  laplacianPyramid(image: ImageSource, numLevels: number): Promise<GrayImage[]>;
  /** Image of a Laplacian pyramid. */
  fromLaplacianPyramid(levels: readonly ImageSource[]): Promise<GrayImage>;
  /** Amount of detail of a few pixels, which blur removes: for photos of one scene and size. */
  sharpness(image: ImageSource): Promise<number>;
  /** Gray values in [0, 1] in which features of a photo are detected. */
  photoToGray(photo: ImageSource): Promise<GrayImage>;
  /** Features of the kind that the options name, strongest first. */
  detectFeatures(image: ImageSource, options?: FeatureOptions & Control): Promise<Features>;
  /** SIFT features, strongest first. */
  detectSift(image: ImageSource, options?: SiftOptions & Control): Promise<Features>;
  /** ORB features, strongest first. */
  detectOrb(image: ImageSource, options?: OrbOptions & Control): Promise<Features>;
  /** SIFT descriptors of given keypoints. */
  describeSift(image: ImageSource, keypoints: KeypointsLike, options?: SiftOptions & Control): Promise<Descriptors>;
  /**
   * Gray values in a square around each keypoint, `size` x `size` at distances of `spacingPx`, with mean
   * 0 and length 1.
   */
  describePatches(image: ImageSource, keypoints: KeypointsLike, size: number, spacingPx: number): Promise<Descriptors>;
  /** Corner response of Harris with its factor k, such as 0.05. */
  harrisResponse(image: ImageSource, k: number, options?: StructureTensorOptions & Control): Promise<GrayImage>;
  /** Smaller eigenvalue of the structure tensor. */
  minEigenvalueResponse(image: ImageSource, options?: StructureTensorOptions & Control): Promise<GrayImage>;
  /** Corners to track, strongest first. */
  goodFeaturesToTrack(image: ImageSource, options?: GoodFeaturesOptions & Control): Promise<Keypoints>;
  /**
   * Local maxima of a response, strongest first: pixels above `threshold` that are largest in a window
   * `2 radius + 1` pixels wide.
   */
  nonMaximumSuppression(response: ImageSource, radius: number, threshold: number): Promise<Keypoints>;
  /** Corners located between pixels; NaN for those that cannot be. */
  refineCorners(image: ImageSource, corners: Points2, options?: RefineOptions & Control): Promise<Float64Array>;
  /** Matches between two lists of descriptors, in the order of the first. */
  matchDescriptors(descriptors1: Descriptors, descriptors2: Descriptors, options?: MatchOptions & Control): Promise<Matches>;
  /** The two nearest of the second list for each descriptor of the first. */
  nearestTwo(descriptors1: Descriptors, descriptors2: Descriptors): Promise<Neighbors>;
  /** Points tracked from one image to the next (Lucas and Kanade, on a pyramid). */
  trackLucasKanade(first: ImageSource, second: ImageSource, points: Points2, options?: TrackOptions & Control): Promise<Tracks>;
  /** Structure tensor of the window around a pixel of an image. */
  windowTensor(image: ImageSource, u: number, v: number, options?: StructureTensorOptions & Control): Promise<WindowTensor>;
  /** Structure tensor of a window from the gradients (Iu, Iv) of its pixels. */
  windowTensorFromGradients(gradients: Points2): Promise<WindowTensor>;
  /** Corner response of Harris of a window, `determinant - k trace^2`, with k such as 0.05. */
  windowHarris(tensor: WindowTensorLike, k: number): Promise<number>;
  /**
   * Squared change of a window of `2 halfWindow + 1` pixels around (u, v), when it is shifted by up to
   * `reach` pixels to each side. A constant border has the unit of the values.
   */
  shiftSurface(image: ImageSource, u: number, v: number, halfWindow: number, reach: number, border?: "replicate" | "reflect101" | { constant: number }): Promise<ShiftSurface>;
  /** Rectifies a calibrated rig with cameras of the same size. */
  rectifyCalibrated(camera1: Camera, camera2: Camera, cam2FromCam1: RigidTransformLike, options?: RectifyOptions & Control): Promise<Rectification>;
  /** Rectifies a calibrated rig and its images; pixels that the camera did not see are black. */
  rectifyImages(image1: ImageSource, image2: ImageSource, camera1: Camera, camera2: Camera, cam2FromCam1: RigidTransformLike, options?: RectifyOptions & Control): Promise<RectifiedImages>;
  /** Rectifies two images from their fundamental matrix and matches without outliers. */
  rectifyUncalibrated(fundamental: Matrix, pixels1: Points2, pixels2: Points2, width: number, height: number): Promise<UncalibratedRectification>;
  /**
   * Disparities `uLeft - uRight` of the pixels of a rectified image by block matching; NaN without a
   * match.
   */
  stereoBm(left: ImageSource, right: ImageSource, options?: StereoBm & Control): Promise<GrayImage>;
  /**
   * Disparities `uLeft - uRight` of the pixels of a rectified image by semi-global matching; NaN without
   * a match.
   */
  stereoSgm(left: ImageSource, right: ImageSource, options?: StereoSgm & Control): Promise<GrayImage>;
  /**
   * Removes connected regions of fewer than `minSize` pixels, whose neighbors differ by at most
   * `rangePx`.
   */
  removeSpeckles(disparity: GrayImage, minSize: number, rangePx: number): Promise<GrayImage>;
  /**
   * Disparities with all gaps filled by the background beside them, along edges of the left image, which
   * has bytes.
   */
  fillGaps(disparity: GrayImage, left: ImageSource): Promise<GrayImage>;
  /** Matrix Q of a rectified rig, for `pointCloud`, 16 numbers by row. */
  qFromRig(focalPx: number, baselineM: number, cuPx: number, cvPx: number): Promise<Float64Array>;
  /** Depth of every pixel, meters; NaN without disparity or where it is not positive. */
  depthImage(disparity: GrayImage, focalPx: number, baselineM: number): Promise<GrayImage>;
  /** Points of all pixels with a disparity, interleaved, by the matrix Q of a rectification. */
  pointCloud(disparity: GrayImage, q: Matrix): Promise<Float64Array>;
  /** Depth of a disparity, meters. */
  depthFromDisparity(focalPx: number, baselineM: number, disparityPx: number): Promise<number>;
  /** Depths of a disparity that is wrong by at most `errorPx` pixels. */
  depthInterval(focalPx: number, baselineM: number, disparityPx: number, errorPx: number): Promise<DepthInterval>;
  /**
   * Best camera without distortion for the photos of a camera, and the map to its images: valid keeps
   * the area that was photographed everywhere, all keeps everything, with black borders.
   */
  undistortionMap(camera: Camera, keep?: "valid" | "all"): Promise<Undistortion>;
  /** Photo redrawn without the distortion of its camera; `keep` as for `undistortionMap`. */
  undistortImage(image: ImageSource, camera: Camera, keep?: "valid" | "all"): Promise<UndistortedImage>;
  /** Image redrawn by a map, bilinear; 0 where nothing is read. */
  remap(image: ImageSource, map: PixelMap): Promise<ImageOfKind>;
  /**
   * Searches a photo for a board of any pattern. A chessboard may be partly hidden; of a board with
   * markers, a part is enough.
   */
  findBoard(image: ImageSource, board: Board, options?: Control): Promise<FoundBoard>;
  /** Finds ArUco markers and AprilTags, in the order of their numbers. */
  detectMarkers(image: ImageSource, dictionary: "Aruco4x4_50" | "Aruco4x4_100" | "Aruco4x4_250" | "Aruco4x4_1000" | "Aruco5x5_50" | "Aruco5x5_100" | "Aruco5x5_250" | "Aruco5x5_1000" | "Aruco6x6_50" | "Aruco6x6_100" | "Aruco6x6_250" | "Aruco6x6_1000" | "Aruco7x7_50" | "Aruco7x7_100" | "Aruco7x7_250" | "Aruco7x7_1000" | "AprilTag36h11", options?: MarkerOptions & Control): Promise<Marker[]>;
  /** Places of all marks on a board, row by row, meters, interleaved. */
  boardMarks(board: Board): Promise<Float64Array>;
  /** Black shapes of a board, to print it. */
  boardDrawing(board: Board): Promise<BoardDrawing>;
  /**
   * Photo of a board with gray values in [0, 1], to test with exact truth. `noise` is the standard
   * deviation of the gray values, 0 if not given.
   */
  renderBoard(board: Board, camera: Camera, camFromBoard: RigidTransformLike, noise?: number, seed?: number): Promise<GrayImage>;
  /**
   * Intrinsics, lens, and poses of a board with the least squared reprojection errors in photos of
   * `width` x `height` pixels. A view has the `pixels` of `findBoard`; null for a photo without a board.
   */
  calibrate(board: Board, views: readonly (Points2 | null)[], width: number, height: number, options?: CalibrationOptions & Control): Promise<Calibration>;
  /**
   * Relative pose of two calibrated cameras from views of a board at the same moments. Null for a photo
   * without a board.
   */
  calibrateRig(board: Board, leftCamera: Camera, rightCamera: Camera, left: readonly (Points2 | null)[], right: readonly (Points2 | null)[], options?: Control): Promise<RigCalibration>;
  /**
   * Intrinsics of a camera without distortion from homographies of planes to its photos, by Zhang's
   * closed form.
   */
  intrinsicsFromPlanes(pixelsFromPlane: readonly Matrix[]): Promise<Intrinsics>;
  /**
   * Points of the matches of two views without outliers, refined together with the motion. The length of
   * the given translation is ignored.
   */
  twoViewReconstruction(pixels1: Points2, pixels2: Points2, camera1: Camera, camera2: Camera, cam2FromCam1: RigidTransformLike, options?: TwoViewReconstructionOptions & Control): Promise<TwoViewReconstruction>;
  /** Refines cameras and points, and their lenses if asked, by the reprojection errors. */
  adjustBundle(bundle: BundleLike, options?: BundleOptions & Control): Promise<AdjustedBundle>;
  /** Keypoints of all photos, and matches between all pairs, or between photos that are near in order. */
  matchPhotos(photos: readonly ImageSource[], options?: PhotoOptions & Control): Promise<MatchedPhotos>;
  /**
   * Cameras and points from keypoints and matches: incremental structure from motion. `cameras` has one
   * camera for each photo, or one for all.
   */
  reconstruct(images: readonly SfmImageLike[], cameras: readonly Camera[], pairs: readonly PairMatchesLike[], options?: SfmOptions & Control): Promise<SfmResult>;
  /** Cameras and points from photos: `matchPhotos` with `photoOptions`, then `reconstruct`. */
  reconstructPhotos(photos: readonly ImageSource[], cameras: readonly Camera[], photoOptions?: PhotoOptions, options?: SfmOptions & Control): Promise<PhotoReconstruction>;
  /**
   * Poses of vertices that agree best with the measured poses between pairs of them, loops included. The
   * width of the loss is in standard deviations. Without `worldFromVertex`, the start follows from the
   * edges of `numVertices` vertices.
   */
  optimizePoseGraph(edges: readonly PoseGraphEdge[], numVertices: number, worldFromVertex?: readonly RigidTransformLike[], loss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } }, options?: LmOptions & Control): Promise<OptimizedGraph>;
  /**
   * Rotations of `numViews` views that agree best with measured rotations between pairs of them. The
   * width of the loss is in radians.
   */
  averageRotations(measured: readonly RelativeRotation[], numViews: number, loss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } }, options?: Control): Promise<AveragedRotations>;
  /** Keypoints of a photo, their colors and descriptors. */
  photoFeatures(photo: ImageSource, options?: PhotoOptions & Control): Promise<PhotoFeatures>;
  /** Matches between all pairs of photos, or between photos that are near in order. */
  matchFeatures(features: readonly PhotoFeaturesLike[], options?: PhotoOptions & Control): Promise<PairMatches[]>;
  /** Matches between the photos of a rectified rig that are in the same row, within 2 pixels. */
  matchRectified(left: PhotoFeaturesLike, right: PhotoFeaturesLike, options?: PhotoOptions & Control): Promise<Matches>;
  /**
   * Pose of another photo in a reconstruction, from `photoFeatures` of it and of all photos of the
   * reconstruction, in order.
   */
  localize(reconstruction: ReconstructionLike, features: readonly PhotoFeaturesLike[], photo: PhotoFeaturesLike, camera: Camera, options?: LocalizeOptions & Control): Promise<Localization>;
  /**
   * Tracks from verified matches: at most one keypoint per photo each. `numKeypoints` has the number of
   * keypoints of each photo.
   */
  buildTracks(numKeypoints: ArrayLike<number>, pairs: readonly PairMatchesLike[]): Promise<KeypointTracks>;
  /** Matches of two photos that agree with one motion of the camera; null if too few do. */
  verifyMatches(pair: PairMatchesLike, image1: SfmImageLike, image2: SfmImageLike, camera1: Camera, camera2: Camera, options?: SfmOptions & Control): Promise<VerifiedPair | null>;
  /**
   * Points from matches between photos with known poses, which do not change. `cameras` has one camera
   * for each photo, or one for all; photos with the pose null are ignored.
   */
  triangulateTracks(images: readonly SfmImageLike[], cameras: readonly Camera[], pairs: readonly PairMatchesLike[], camFromWorld: readonly (RigidTransformLike | null)[], options?: SfmOptions & Control): Promise<Reconstruction>;
  /**
   * Path of a single camera, up to scale, from frames in order of time and matches between frames that
   * are close. `cameras` has one camera for each frame, or one for all.
   */
  monocularOdometry(images: readonly SfmImageLike[], cameras: readonly Camera[], pairs: readonly PairMatchesLike[], options?: OdometryOptions & Control): Promise<OdometryResult>;
  /**
   * Path of a rig, in the unit of its baseline. `images`, `cameras` and `pairs` are those of the left
   * camera, `right` the same frames of the right camera, and `leftRight` has the matches between the two
   * images of each frame.
   */
  stereoOdometry(images: readonly SfmImageLike[], cameras: readonly Camera[], pairs: readonly PairMatchesLike[], right: readonly SfmImageLike[], leftRight: readonly MatchesLike[], rightFromLeft: RigidTransformLike, rightCamera: Camera, options?: OdometryOptions & Control): Promise<OdometryResult>;
  /** Reconstruction in another world, moved by a similarity. */
  moveReconstruction(reconstruction: ReconstructionLike, toFromWorld: Similarity3Like): Promise<Reconstruction>;
  /** Mean length of the reprojection errors of all observations, pixels. */
  meanReprojectionPx(reconstruction: ReconstructionLike, images: readonly SfmImageLike[]): Promise<number>;
  /** Bundle of a reconstruction, for `adjustBundle`. */
  reconstructionBundle(reconstruction: ReconstructionLike, images: readonly SfmImageLike[]): Promise<ReconstructionBundle>;
  /** Whether the photos determine the focal lengths of their lenses. */
  determinesFocal(reconstruction: ReconstructionLike, images: readonly SfmImageLike[]): Promise<boolean>;
  /**
   * Corrects focal lengths and radial distortion of all lenses, if the photos determine them and the
   * errors become clearly smaller.
   */
  refineLenses(reconstruction: ReconstructionLike, images: readonly SfmImageLike[], options?: Control): Promise<RefinedLenses>;
  /**
   * Why each of the `unregistered` photos of a result of `reconstruct` is in no reconstruction, a
   * sentence each. The other arguments are those of `reconstruct`.
   */
  whyUnregistered(images: readonly SfmImageLike[], cameras: readonly Camera[], pairs: readonly PairMatchesLike[], result: SfmResultLike, options?: SfmOptions & Control): Promise<string[]>;
  /** Similarity that moves points best onto others, by least squares; "rigid" keeps the scale. */
  alignPoints(fromPoints: Points3, toPoints: Points3, kind?: "rigid" | "similarity"): Promise<Similarity3>;
  /** Distances between camera centers and their true ones after alignment. */
  absoluteTrajectoryError(estimated: Points3, truth: Points3, kind?: "rigid" | "similarity"): Promise<TrajectoryError>;
  /** Errors of the motions over `step` frames, 1 if not given, between poses `worldFromCam`. */
  relativePoseError(estimated: readonly RigidTransformLike[], truth: readonly RigidTransformLike[], step?: number): Promise<RelativePoseError>;
  /**
   * Similarity between two lists of points with outliers, by RANSAC. `maxDistance` is the threshold of
   * an inlier, in the unit of the second list.
   */
  estimateSimilarityOfPoints(fromPoints: Points3, toPoints: Points3, maxDistance: number, seed?: number): Promise<SimilarityOfPoints>;
  /**
   * Spreads the error of closed loops over a path, with its scale unless `motion` is "rigid". The first
   * frame stays where it is. The width of the loss is in standard deviations.
   */
  closeLoops(worldFromCam: readonly RigidTransformLike[], loops: readonly LoopClosure[], motion?: "rigid" | "similarity", loss?: "trivial" | { huber: { width: number } } | { cauchy: { width: number } } | { truncated: { width: number } }, options?: Control): Promise<ClosedPath>;
  /**
   * Photos of a reconstruction, undistorted and downscaled, with the neighbors and the depth range of
   * each. Photos that share no points with another at a sufficient angle are left out.
   */
  prepareViews(reconstruction: ReconstructionLike, photos: readonly ImageSource[], options?: MvsOptions & Control): Promise<MvsView[]>;
  /** Depth and normal of each pixel of each view by PatchMatch, where enough views agree. */
  estimateDepthMaps(views: readonly MvsViewLike[], options?: MvsOptions & Control): Promise<DepthMap[]>;
  /** Point cloud of depth maps, with normals, colors and confidences. */
  fuseDepthMaps(views: readonly MvsViewLike[], maps: readonly DepthMap[], options?: MvsOptions & Control): Promise<PointCloud>;
  /** Mesh of depth maps, with normals and colors; it has holes where no photo shows the surface. */
  meshDepthMaps(views: readonly MvsViewLike[], maps: readonly DepthMap[], options?: MeshOptions & Control): Promise<Mesh>;
  /** Texture of a mesh from the photos: each triangle takes its pixels from one of them, with few seams. */
  textureMesh(mesh: MeshLike, views: readonly MvsViewLike[], options?: TextureOptions & Control): Promise<MeshTexture>;
  /**
   * Homography on which the matches of two photos agree, with its inliers; null if no more matches agree
   * than wrong ones might by chance. `image1` and `image2` are the indices of the photos.
   */
  findOverlap(image1: number, image2: number, pixels1: Points2, pixels2: Points2, options?: OverlapOptions & Control): Promise<Overlap | null>;
  /**
   * Rotations of photos from one position, from their overlaps and the intrinsics of each. With
   * `findFocal`, also a common factor of all focal lengths, from 1/4 to 4.
   */
  estimatePanorama(intrinsics: readonly Intrinsics[], overlaps: readonly OverlapLike[], findFocal?: boolean, options?: Control): Promise<Panorama>;
  /**
   * Positions of `numImages` photos of one plane, by homographies from one to the next; to render on the
   * surface "plane".
   */
  chainHomographies(numImages: number, overlaps: readonly OverlapLike[]): Promise<Panorama>;
  /** Picture of all photos of a panorama, blended; black where there is none. */
  renderPanorama(panorama: PanoramaLike, photos: readonly ImageSource[], options?: RenderOptions & Control): Promise<RgbImage>;
  /** Position east, north and up of an origin, meters. */
  localFromGeodetic(place: Geodetic, origin: Geodetic): Promise<Float64Array>;
}
