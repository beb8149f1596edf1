//! Nonzero blocks of the normal equations of a bundle adjustment.

/// Number of unknowns of a camera and of a point.
pub(super) const PER_CAMERA: usize = 6;
pub(super) const PER_POINT: usize = 3;

/// Cameras on a path past the points; each point is seen by neighboring cameras.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Blocks {
    pub(super) num_cameras: usize,
    /// Indices of the cameras that see each point.
    pub(super) seen_by: Vec<Vec<usize>>,
}

impl Blocks {
    /// * `num_views`: number of cameras that see each point, at most `num_cameras`
    pub(super) fn new(num_cameras: usize, num_points: usize, num_views: usize) -> Self {
        let num_views = num_views.min(num_cameras);
        // The first camera that sees a point advances along the path with the point's index.
        let last_first = num_cameras - num_views;
        let first = |point: usize| (point * (last_first + 1)) / num_points.max(1);
        let seen = |point: usize| (first(point)..first(point) + num_views).collect();
        Self {
            num_cameras,
            seen_by: (0..num_points).map(seen).collect(),
        }
    }

    pub(super) fn num_points(&self) -> usize {
        self.seen_by.len()
    }

    /// Returns the number of unknowns of the cameras and of the points.
    pub(super) fn unknowns(&self) -> [usize; 2] {
        [PER_CAMERA * self.num_cameras, PER_POINT * self.num_points()]
    }

    /// Returns the fraction of nonzero entries of `JᵀJ`, 0 to 1.
    pub(super) fn fill_ratio(&self) -> f64 {
        let observations: usize = self.seen_by.iter().map(Vec::len).sum();
        let entries = PER_CAMERA * PER_CAMERA * self.num_cameras
            + PER_POINT * PER_POINT * self.num_points()
            + 2 * PER_CAMERA * PER_POINT * observations;
        let all = self.unknowns().iter().sum::<usize>();
        entries as f64 / (all * all).max(1) as f64
    }

    /// Returns whether two cameras are coupled after elimination of the points: they are the same
    /// or see a common point.
    pub(super) fn are_coupled(&self, one: usize, other: usize) -> bool {
        let both = |seen: &Vec<usize>| seen.contains(&one) && seen.contains(&other);
        one == other || self.seen_by.iter().any(both)
    }

    /// Returns the fraction of nonzero camera blocks after elimination of the points, 0 to 1.
    pub(super) fn coupled_ratio(&self) -> f64 {
        let cameras = 0..self.num_cameras;
        let pairs = cameras
            .clone()
            .flat_map(|one| cameras.clone().map(move |other| (one, other)));
        let coupled = pairs
            .filter(|(one, other)| self.are_coupled(*one, *other))
            .count();
        coupled as f64 / (self.num_cameras * self.num_cameras).max(1) as f64
    }

    /// Returns the number of multiplications of a dense Cholesky solver: for the whole system, and
    /// with the points eliminated first.
    pub(super) fn multiplications(&self) -> [f64; 2] {
        let cube = |size: usize| (size as f64) * (size as f64) * (size as f64) / 6.0;
        let [cameras, points] = self.unknowns();
        let point = |seen: &Vec<usize>| {
            // B P⁻¹ for the cameras that see it, then half of its symmetric product with Bᵀ.
            let rows = (PER_CAMERA * seen.len()) as f64;
            let inverse = (PER_POINT * PER_POINT * PER_POINT) as f64;
            inverse
                + rows * (PER_POINT * PER_POINT) as f64
                + rows * (rows + 1.0) / 2.0 * PER_POINT as f64
        };
        let eliminated: f64 = self.seen_by.iter().map(point).sum();
        [cube(cameras + points), eliminated + cube(cameras)]
    }

    /// Returns the factor by which eliminating the points first reduces the cost.
    pub(super) fn saving(&self) -> f64 {
        let [whole, eliminated] = self.multiplications();
        whole / eliminated
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;

    /// Returns `JᵀJ` for random observations with this pattern.
    fn normal_matrix(blocks: &Blocks) -> DMatrix<f64> {
        let [cameras, points] = blocks.unknowns();
        let mut random = epipole::math::random::Random::new(3);
        let mut normal = DMatrix::zeros(cameras + points, cameras + points);
        for (point, seen) in blocks.seen_by.iter().enumerate() {
            for camera in seen {
                let mut row = DMatrix::zeros(2, cameras + points);
                for r in 0..2 {
                    for k in 0..PER_CAMERA {
                        row[(r, PER_CAMERA * camera + k)] = random.normal();
                    }
                    for k in 0..PER_POINT {
                        row[(r, cameras + PER_POINT * point + k)] = random.normal();
                    }
                }
                normal += row.transpose() * row;
            }
        }
        normal
    }

    #[test]
    fn the_pattern_is_that_of_a_real_system_before_and_after_elimination() {
        let blocks = Blocks::new(6, 24, 3);
        let normal = normal_matrix(&blocks);
        let filled = normal.iter().filter(|entry| **entry != 0.0).count();
        let share = filled as f64 / normal.len() as f64;
        assert!((share - blocks.fill_ratio()).abs() < 1e-12, "{share}");
        let [cameras, points] = blocks.unknowns();
        let a = normal.view((0, 0), (cameras, cameras));
        let b = normal.view((0, cameras), (cameras, points));
        let p = normal
            .view((cameras, cameras), (points, points))
            .into_owned();
        let reduced = a - b * p.try_inverse().unwrap() * b.transpose();
        for one in 0..6 {
            for other in 0..6 {
                let size = (PER_CAMERA, PER_CAMERA);
                let block = reduced.view((PER_CAMERA * one, PER_CAMERA * other), size);
                let is_zero = block.iter().all(|entry| entry.abs() < 1e-9);
                assert_eq!(is_zero, !blocks.are_coupled(one, other), "{one} {other}");
            }
        }
    }

    #[test]
    fn more_points_make_elimination_worth_more() {
        let saving = |points| Blocks::new(8, points, 3).saving();
        assert!(
            saving(20) < saving(60) && saving(60) > 20.0,
            "{}",
            saving(60)
        );
        assert_eq!(Blocks::new(4, 10, 9).coupled_ratio(), 1.0);
    }
}
