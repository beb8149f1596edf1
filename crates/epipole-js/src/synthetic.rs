//! Random worlds with ground truth.

use crate::functions::functions;
use crate::options::Options;
use crate::output::{Indices, Mask, Numbers, structs};
use epipole::camera::PosedCamera;
use epipole::synthetic::{
    MultiViewProblem, MultiViewProblemOptions, TwoViewProblem, TwoViewProblemOptions,
};

structs! {
    /// Matches between two images of 640 x 480 pixels, with ground truth.
    struct TwoViews as TwoViewProblem {
        /// First camera, at (0, 0, -distance), which looks along +z.
        camera1: PosedCamera,
        /// Second camera, to the right of it, which looks at the world's origin.
        camera2: PosedCamera,
        /// Measured pixels in image 1, interleaved.
        pixels1: Numbers,
        /// Their matches in image 2.
        pixels2: Numbers,
        /// 1 for matches that are right up to noise.
        is_inlier: Mask,
        /// Points in the world, interleaved.
        points: Numbers,
    }

    /// Cameras, points and observations in images of 640 x 480 pixels, with ground truth.
    struct ManyViews as MultiViewProblem {
        /// Cameras.
        cameras: Vec<PosedCamera>,
        /// Points in the world, interleaved.
        points: Numbers,
        /// Index of the camera of each observation.
        observation_camera: Indices,
        /// Index of the point of each observation.
        observation_point: Indices,
        /// Measured pixel of each observation, interleaved.
        observation_pixel: Numbers,
        /// 1 for observations that are right up to noise.
        observation_is_inlier: Mask,
    }
}

functions! {
    /// Draws points and two cameras that see them.
    fn two_view_problem(options: Options<TwoViewProblemOptions>) -> TwoViews {
        let problem = TwoViewProblem::new(&options.0)?;
        TwoViews {
            camera1: problem.camera1,
            camera2: problem.camera2,
            pixels1: Numbers::of_points(&problem.pixels1),
            pixels2: Numbers::of_points(&problem.pixels2),
            is_inlier: Mask(problem.is_inlier),
            points: Numbers::of_points(&problem.points),
        }
    }

    /// Draws points and cameras that see them.
    fn multi_view_problem(options: Options<MultiViewProblemOptions>) -> ManyViews {
        let MultiViewProblem { cameras, points, observations } =
            MultiViewProblem::new(&options.0)?;
        let pixels: Vec<_> = observations.iter().map(|observation| observation.pixel).collect();
        ManyViews {
            cameras,
            points: Numbers::of_points(&points),
            observation_camera: Indices(observations.iter().map(|observation| observation.camera).collect()),
            observation_point: Indices(observations.iter().map(|observation| observation.point).collect()),
            observation_pixel: Numbers::of_points(&pixels),
            observation_is_inlier: Mask(observations.iter().map(|observation| observation.is_inlier).collect()),
        }
    }
}
