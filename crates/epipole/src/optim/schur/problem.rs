//! Interface of a problem of cameras and points to its solver.

use crate::optim::loss::RobustLoss;

/// A linearized observation: residual and Jacobians by its camera (`C` degrees of freedom), the
/// shared parameters of the camera's group (`S`), and its point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ObservationTerms<const C: usize, const S: usize> {
    /// Predicted minus observed.
    pub(crate) residual: [f64; 2],
    /// ∂r/∂camera.
    pub(crate) camera: [[f64; C]; 2],
    /// ∂r/∂shared.
    pub(crate) shared: [[f64; S]; 2],
    /// ∂r/∂point.
    pub(crate) point: [[f64; 3]; 2],
}

/// Steps of all blocks, from the Schur complement.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct BundleStep<const C: usize, const S: usize> {
    /// One step per camera.
    pub(crate) cameras: Vec<[f64; C]>,
    /// Steps of the shared parameters, one per group.
    pub(crate) shared: Vec<[f64; S]>,
    /// One step per point.
    pub(crate) points: Vec<[f64; 3]>,
}

/// A linearized prior of a camera: residual and Jacobian by the camera.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PriorTerms<const C: usize> {
    /// Estimated minus known, in standard deviations.
    pub(crate) residual: [f64; 3],
    /// ∂r/∂camera.
    pub(crate) camera: [[f64; C]; 3],
}

/// A problem of cameras and points, where every residual belongs to one camera and one point.
/// Cameras with shared parameters, such as a lens, form a group; an observation belongs to one.
pub(crate) trait BundleProblem<const C: usize, const S: usize>: Sync {
    /// Cameras, groups and points.
    type Parameters: Clone + Sync;

    /// Returns the number of cameras.
    fn num_cameras(&self) -> usize;
    /// Returns the number of points.
    fn num_points(&self) -> usize;
    /// Returns camera and point of each observation; both must be in range.
    fn observations(&self) -> &[(u32, u32)];
    /// Returns the residual of one observation.
    fn residual(&self, parameters: &Self::Parameters, observation: usize) -> [f64; 2];
    /// Returns the residual of one observation with its Jacobians.
    fn linearize(
        &self,
        parameters: &Self::Parameters,
        observation: usize,
    ) -> ObservationTerms<C, S>;
    /// Writes `from ⊞ step`.
    fn step(&self, from: &Self::Parameters, step: &BundleStep<C, S>, into: &mut Self::Parameters);
    /// Returns the length of the parameters, for the relative step test.
    fn parameter_norm(&self, parameters: &Self::Parameters) -> f64;
    /// Returns the loss of every residual.
    fn loss(&self) -> RobustLoss;
    /// Returns which degrees of freedom of a camera are held fixed.
    fn held_camera(&self, _camera: usize) -> [bool; C] {
        [false; C]
    }
    /// Returns the number of groups. One by default, or none without shared parameters.
    fn num_groups(&self) -> usize {
        usize::from(S > 0)
    }
    /// Returns the group of an observation; it must be in range. The first by default.
    fn group(&self, _observation: usize) -> usize {
        0
    }
    /// Returns which shared parameters are held fixed, the same for all groups.
    fn held_shared(&self) -> [bool; S] {
        [false; S]
    }
    /// Returns the prior of a camera. None by default.
    fn prior(&self, _parameters: &Self::Parameters, _camera: usize) -> Option<PriorTerms<C>> {
        None
    }
    /// Returns the loss of the priors on cameras.
    fn prior_loss(&self) -> RobustLoss {
        RobustLoss::Trivial
    }
    /// Returns whether a point is held fixed.
    fn held_point(&self, _point: usize) -> bool {
        false
    }
}
