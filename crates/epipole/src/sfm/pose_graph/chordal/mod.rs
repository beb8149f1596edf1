//! Initialization of a pose graph from its measurements alone: rotations first, then scales, then
//! positions, each by linear least squares.

use super::{Graph, GraphPose};
use crate::math::{Svd3, svd3};
use crate::optim::RobustLoss;
use crate::optim::sparse::BlockCholesky;
use crate::progress::{Monitor, Part, Stage, report};
use crate::{Error, Result};
use nalgebra::{
    Isometry3, Matrix3, Rotation3, SMatrix, SVector, Similarity3, Translation3, UnitQuaternion,
    Vector3,
};

/// A weighted least-squares equation on a graph: `x_to = A x_from + b`.
struct Link<const N: usize> {
    ends: (usize, usize),
    /// A, a rotation.
    rotation: SMatrix<f64, N, N>,
    weight: f64,
}

/// Solver of these equations for several right-hand sides; held vertices are constant.
struct Links<'a, const N: usize> {
    links: &'a [Link<N>],
    held: &'a [bool],
    factor: BlockCholesky<N>,
}

impl<'a, const N: usize> Links<'a, N> {
    /// Returns `None` if the equations do not determine a vertex.
    fn new(links: &'a [Link<N>], held: &'a [bool]) -> Option<Self> {
        let pair = |link: &Link<N>| (link.ends.0 as u32, link.ends.1 as u32);
        let pairs: Vec<_> = links.iter().map(pair).collect();
        let mut factor = BlockCholesky::new(held.len(), &pairs);
        let identity = SMatrix::<f64, N, N>::identity();
        for (vertex, _) in held.iter().enumerate().filter(|(_, held)| **held) {
            factor.add_diagonal(vertex, &identity);
        }
        for link in links {
            let (from, to) = link.ends;
            for end in [from, to] {
                if !held[end] {
                    factor.add_diagonal(end, &(identity * link.weight));
                }
            }
            if !held[from] && !held[to] {
                factor.add(to, from, &(link.rotation * -link.weight));
            }
        }
        factor.factorize().then_some(Self {
            links,
            held,
            factor,
        })
    }

    /// * `values`: values of held vertices; replaced by the solution
    /// * `offset`: b of each link
    fn solve(&self, values: &mut [SVector<f64, N>], offset: impl Fn(usize) -> SVector<f64, N>) {
        for (vertex, value) in values.iter_mut().enumerate() {
            if !self.held[vertex] {
                *value = SVector::zeros();
            }
        }
        let known = values.to_vec();
        for (index, link) in self.links.iter().enumerate() {
            let (from, to) = link.ends;
            let b = offset(index);
            if !self.held[to] {
                values[to] += (link.rotation * known[from] + b) * link.weight;
            }
            if !self.held[from] {
                values[from] += link.rotation.tr_mul(&(known[to] - b)) * link.weight;
            }
        }
        self.factor.solve(values);
        for (vertex, value) in values.iter_mut().enumerate() {
            if self.held[vertex] {
                *value = known[vertex];
            }
        }
    }
}

/// Returns the rotation nearest to a matrix in Frobenius norm.
fn nearest_rotation(m: &Matrix3<f64>) -> UnitQuaternion<f64> {
    let Svd3 { u, v, .. } = svd3(m);
    let sign = (u * v.transpose()).determinant().signum();
    let rotation = u * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, sign)) * v.transpose();
    UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(rotation))
}

impl<T: GraphPose<D>, const D: usize> Graph<T, D> {
    /// Computes all vertices from the measurements alone: the result does not depend on their
    /// previous values, and is close enough to the optimum for [`optimize`](Graph::optimize),
    /// unless measurements contradict each other wildly.
    ///
    /// First the rotations, as matrix entries, for which `R_to = R_from R` is linear, each
    /// projected to the nearest rotation; then, for similarities, logarithms of scales; then
    /// positions. Fixed vertices do not move; in a connected part without any, the first vertex is
    /// fixed.
    ///
    /// # Errors
    /// As [`optimize`](Graph::optimize), and [`Error::Degenerate`] if a vertex depends on
    /// measurements without weight. The only stage is [`Stage::PoseGraph`].
    ///
    /// Source: Carlone, Tron, Daniilidis & Dellaert 2015, "Initialization techniques for 3D SLAM: a
    /// survey on rotation estimation and its use in pose graph optimization", §IV.A (chordal
    /// relaxation).
    ///
    /// ```
    /// # fn main() -> Result<(), epipole::Error> {
    /// use epipole::nalgebra::{Isometry2, Matrix3, Vector2};
    /// use epipole::sfm::{Edge, Graph};
    /// // Vertex 1 was measured 1 ahead and rotated by 90° to the left, but starts anywhere.
    /// let quarter = std::f64::consts::FRAC_PI_2;
    /// let mut graph = Graph {
    ///     ids: vec![0, 1],
    ///     vertices: vec![Isometry2::identity(), Isometry2::new(Vector2::new(-7.0, 3.0), 3.0)],
    ///     edges: vec![Edge {
    ///         from: 0,
    ///         to: 1,
    ///         from_from_to: Isometry2::new(Vector2::new(1.0, 0.0), quarter),
    ///         information: 4.0 * Matrix3::identity(),
    ///     }],
    ///     ..Graph::default()
    /// };
    /// graph.initialize(&mut ())?;
    /// assert!(graph.chi2() < 1e-20);
    /// # Ok(()) }
    /// ```
    pub fn initialize(&mut self, monitor: &mut dyn Monitor) -> Result<()> {
        self.check(RobustLoss::Trivial)?;
        if let Some(mut joined) = self.with_world() {
            let result = joined.initialize(monitor);
            self.take_vertices(joined);
            return result;
        }
        let (held, _) = self.held();
        let mut poses: Vec<Similarity3<f64>> = self.vertices.iter().map(T::to_similarity).collect();
        let measured: Vec<Similarity3<f64>> = (self.edges.iter())
            .map(|edge| edge.from_from_to.to_similarity())
            .collect();
        let degenerate = || Error::Degenerate {
            what: "a start for a pose graph",
            why: "a vertex hangs on measurements without weight",
        };
        // The tangent of a similarity holds translation, rotation, then scale.
        let num_axes = if D == 3 { 2 } else { 3 };
        let num_rotations = if D == 3 { 1 } else { 3 };
        let weight = |edge: usize, start: usize, count: usize| {
            let information = &self.edges[edge].information;
            let sum: f64 = (start..start + count).map(|i| information[(i, i)]).sum();
            sum.max(0.0) / count as f64
        };
        let links = |start: usize, count: usize| -> Vec<Link<1>> {
            let link = |(index, edge): (usize, &super::Edge<T, D>)| Link {
                ends: (edge.from, edge.to),
                rotation: SMatrix::identity(),
                weight: weight(index, start, count),
            };
            self.edges.iter().enumerate().map(link).collect()
        };

        // The rows of rotations: those of `to` are those of `from`, rotated back by the
        // measurement.
        let rotation_links: Vec<Link<3>> = (self.edges.iter().zip(&measured).enumerate())
            .map(|(index, (edge, measured))| Link {
                ends: (edge.from, edge.to),
                rotation: matrix(measured).transpose(),
                weight: weight(index, num_axes, num_rotations),
            })
            .collect();
        report(monitor, Stage::PoseGraph, 0.0)?;
        // A landmark has no rotation.
        let is_landmark = self.is_landmark();
        let fixed: Vec<bool> = held
            .iter()
            .zip(&is_landmark)
            .map(|(a, b)| *a || *b)
            .collect();
        let rotation_system = Links::new(&rotation_links, &fixed).ok_or_else(degenerate)?;
        let mut rows: [Vec<Vector3<f64>>; 3] = core::array::from_fn(|row| {
            let row_of = |pose: &Similarity3<f64>| matrix(pose).row(row).transpose();
            poses.iter().map(row_of).collect()
        });
        for (done, row) in rows.iter_mut().enumerate() {
            rotation_system.solve(row, |_| Vector3::zeros());
            report(monitor, Stage::PoseGraph, 0.2 * (done + 1) as f32)?;
        }
        for (vertex, pose) in poses.iter_mut().enumerate() {
            if !fixed[vertex] {
                let [a, b, c] = [0, 1, 2].map(|row: usize| rows[row][vertex].transpose());
                pose.isometry.rotation = nearest_rotation(&Matrix3::from_rows(&[a, b, c]));
            }
        }

        if D == 7 {
            let scales = links(6, 1);
            let of_scales = Links::new(&scales, &fixed).ok_or_else(degenerate)?;
            let log = |pose: &Similarity3<f64>| SVector::<f64, 1>::new(libm::log(pose.scaling()));
            let mut logs: Vec<_> = poses.iter().map(log).collect();
            of_scales.solve(&mut logs, |edge| log(&measured[edge]));
            for (pose, log) in poses.iter_mut().zip(&logs) {
                pose.set_scaling(libm::exp(log[0]).clamp(f64::MIN_POSITIVE, f64::MAX));
            }
        }

        report(monitor, Stage::PoseGraph, 0.7)?;
        let steps = links(0, num_axes);
        let of_steps = Links::new(&steps, &held).ok_or_else(degenerate)?;
        let moved: Vec<Vector3<f64>> = (self.edges.iter().zip(&measured))
            .map(|(edge, measured)| {
                let from = &poses[edge.from];
                from.isometry.rotation * measured.isometry.translation.vector * from.scaling()
            })
            .collect();
        for axis in 0..3 {
            let place = |pose: &Similarity3<f64>| {
                SVector::<f64, 1>::new(pose.isometry.translation.vector[axis])
            };
            let mut places: Vec<_> = poses.iter().map(place).collect();
            of_steps.solve(&mut places, |edge| {
                SVector::<f64, 1>::new(moved[edge][axis])
            });
            for (pose, place) in poses.iter_mut().zip(&places) {
                pose.isometry.translation.vector[axis] = place[0];
            }
        }

        let found: Vec<T> = poses.iter().map(T::from_similarity).collect();
        if !found.iter().all(GraphPose::is_finite) {
            return Err(Error::NotFinite {
                what: "a start for a pose graph",
            });
        }
        for (vertex, found) in found.into_iter().enumerate() {
            if !held[vertex] {
                self.vertices[vertex] = found;
            }
        }
        Ok(())
    }
}

fn matrix(pose: &Similarity3<f64>) -> Matrix3<f64> {
    *pose.isometry.rotation.to_rotation_matrix().matrix()
}

/// A rotation measured between two views, such as that of
/// [`cam2_from_cam1`](crate::epipolar::RelativePose).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RelativeRotation {
    /// Index of the first view.
    pub from: usize,
    /// Index of the second view.
    pub to: usize,
    /// Rotation from the frame of the first view to the frame of the second.
    pub to_from_from: UnitQuaternion<f64>,
}

/// Averages rotations: returns `view_from_world` of each view that agrees best with the measured
/// relative rotations, and the error of each measurement, radians.
///
/// Minimizes `Σ ρ(e²)` where `2 arcsin(e/2)` is the angle between `view_from_world` of `to` and its
/// prediction from the measurement and `view_from_world` of `from`. The first view of each
/// connected part has the identity.
///
/// * `count`: number of views
/// * `loss`: robust to wrong measurements; width in radians
///
/// # Errors
/// [`Error::TooFew`] without measurements, [`Error::OutOfRange`] for an invalid index or a view
/// joined with itself, or for a loss that [`RobustLoss::check`] rejects; [`Error::NotFinite`] for
/// NaN; [`Error::Canceled`].
///
/// Source: Hartley, Trumpf, Dai & Li 2013, "Rotation averaging"; initialized as by
/// [`Graph::initialize`].
///
/// ```
/// # fn main() -> Result<(), epipole::Error> {
/// use epipole::optim::RobustLoss;
/// use epipole::sfm::{RelativeRotation, average_rotations};
/// use nalgebra::{UnitQuaternion, Vector3};
/// // About one axis by 0.1 and 0.2; the direct edge measures 0.36: each of the three is off by
/// // 0.02.
/// let relative = |from, to, angle| RelativeRotation {
///     from, to, to_from_from: UnitQuaternion::from_axis_angle(&Vector3::y_axis(), angle),
/// };
/// let measured = [relative(0, 1, 0.1), relative(1, 2, 0.2), relative(0, 2, 0.36)];
/// let (views, errors_rad) = average_rotations(3, &measured, RobustLoss::Trivial, &mut ())?;
/// assert!((views[2].angle() - 0.34).abs() < 1e-6);
/// assert!(errors_rad.iter().all(|e| (e - 0.02).abs() < 1e-6));
/// # Ok(()) }
/// ```
pub fn average_rotations(
    count: usize,
    measured: &[RelativeRotation],
    loss: RobustLoss,
    monitor: &mut dyn Monitor,
) -> Result<(Vec<UnitQuaternion<f64>>, Vec<f64>)> {
    let rotated = |rotation| Isometry3::from_parts(Translation3::identity(), rotation);
    // The error of an edge is the sine of half the angle, so e = 2 × that.
    let information = SMatrix::<f64, 6, 6>::identity() * 4.0;
    let mut graph = Graph {
        ids: (0..count as u64).collect(),
        vertices: vec![Isometry3::identity(); count],
        edges: (measured.iter())
            .map(|m| super::Edge {
                from: m.from,
                to: m.to,
                from_from_to: rotated(m.to_from_from.inverse()),
                information,
            })
            .collect(),
        ..Graph::default()
    };
    graph.initialize(&mut Part::new(monitor, 0.0, 0.5))?;
    let options = crate::optim::LmOptions::default();
    graph.optimize(&options, loss, &mut Part::new(monitor, 0.5, 1.0))?;
    let views: Vec<_> = (graph.vertices.iter())
        .map(|vertex| vertex.rotation.inverse())
        .collect();
    let error = |m: &RelativeRotation| views[m.to].angle_to(&(m.to_from_from * views[m.from]));
    let errors_rad = measured.iter().map(error).collect();
    Ok((views, errors_rad))
}

#[cfg(test)]
mod tests;
