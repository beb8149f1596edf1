//! The tags and numbers of poses in g2o's text format.

use nalgebra::{
    Isometry2, Isometry3, Matrix3, Point3, Quaternion, SMatrix, Similarity3, Translation3,
    UnitQuaternion, Vector2,
};

/// A pose in a file: tags and numbers.
pub(super) trait Written<const D: usize>: Sized {
    const VERTEX: &'static str;
    const EDGE: &'static str;
    const PRIOR: &'static str;
    /// Prior of the position alone.
    const POSITION: &'static str;
    /// A point.
    const LANDMARK: &'static str;
    /// Position of a point in the frame of a pose, or of its sensor.
    const SIGHTING: &'static str;
    /// Whether priors and sightings name a parameter, the offset of a sensor.
    const HAS_OFFSET: bool;
    /// Numbers of the identity.
    const ORIGIN: &'static [f64];
    /// Coordinates of a position.
    const NUM_AXES: usize;
    fn read(numbers: &[f64]) -> std::result::Result<Self, &'static str>;
    fn write(&self, numbers: &mut Vec<f64>);
    /// Converts the prior of a sensor at an offset to a prior of the vertex.
    fn without_offset(
        self,
        information: SMatrix<f64, D, D>,
        _vertex_from_sensor: &Isometry3<f64>,
    ) -> (Self, SMatrix<f64, D, D>) {
        (self, information)
    }
    /// Converts the sighting of a sensor at an offset to the frame of the vertex, exactly.
    fn relative_to_vertex(
        self,
        information: SMatrix<f64, D, D>,
        _vertex_from_sensor: &Isometry3<f64>,
    ) -> (Self, SMatrix<f64, D, D>) {
        (self, information)
    }
}

impl Written<3> for Isometry2<f64> {
    const VERTEX: &'static str = "VERTEX_SE2";
    const EDGE: &'static str = "EDGE_SE2";
    const PRIOR: &'static str = "EDGE_PRIOR_SE2";
    const POSITION: &'static str = "EDGE_PRIOR_SE2_XY";
    const LANDMARK: &'static str = "VERTEX_XY";
    const SIGHTING: &'static str = "EDGE_SE2_XY";
    const HAS_OFFSET: bool = false;
    const ORIGIN: &'static [f64] = &[0.0; 3];
    const NUM_AXES: usize = 2;
    fn read(n: &[f64]) -> std::result::Result<Self, &'static str> {
        Ok(Isometry2::new(Vector2::new(n[0], n[1]), n[2]))
    }
    fn write(&self, numbers: &mut Vec<f64>) {
        numbers.extend(self.translation.vector.iter());
        numbers.push(self.rotation.angle());
    }
}

/// Returns the rotation of a quaternion of any length but 0.
fn rotation(
    w: f64,
    x: f64,
    y: f64,
    z: f64,
) -> std::result::Result<UnitQuaternion<f64>, &'static str> {
    let mut quaternion = Quaternion::new(w, x, y, z);
    if !quaternion.norm().is_finite() {
        // The numbers are finite, but their squares overflow.
        quaternion /= quaternion.coords.amax();
    }
    UnitQuaternion::try_new(quaternion, 1e-6).ok_or("the quaternion is zero, so it is no rotation")
}

impl Written<6> for Isometry3<f64> {
    const VERTEX: &'static str = "VERTEX_SE3:QUAT";
    const EDGE: &'static str = "EDGE_SE3:QUAT";
    const PRIOR: &'static str = "EDGE_SE3_PRIOR";
    const POSITION: &'static str = "EDGE_SE3_XYZ_PRIOR";
    const LANDMARK: &'static str = "VERTEX_TRACKXYZ";
    const SIGHTING: &'static str = "EDGE_SE3_TRACKXYZ";
    const HAS_OFFSET: bool = true;
    const ORIGIN: &'static [f64] = &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    const NUM_AXES: usize = 3;
    fn read(n: &[f64]) -> std::result::Result<Self, &'static str> {
        let rotation = rotation(n[6], n[3], n[4], n[5])?;
        Ok(Isometry3::from_parts(
            Translation3::new(n[0], n[1], n[2]),
            rotation,
        ))
    }
    fn write(&self, numbers: &mut Vec<f64>) {
        numbers.extend(self.translation.vector.iter());
        let q = &self.rotation;
        numbers.extend([q.i, q.j, q.k, q.w]);
    }
    /// Converts exactly for a rotated sensor, and to first order in the rotation error for a
    /// shifted one.
    ///
    /// With the error D = Z⁻¹ T O of a sensor at the offset O = (t, R), that of a prior Z O⁻¹ of
    /// the vertex is O D O⁻¹.
    fn without_offset(
        self,
        information: SMatrix<f64, 6, 6>,
        vertex_from_sensor: &Isometry3<f64>,
    ) -> (Self, SMatrix<f64, 6, 6>) {
        let undo: Matrix3<f64> = *vertex_from_sensor
            .rotation
            .inverse()
            .to_rotation_matrix()
            .matrix();
        let lever = vertex_from_sensor.translation.vector.cross_matrix();
        let mut back = SMatrix::<f64, 6, 6>::zeros();
        back.fixed_view_mut::<3, 3>(0, 0).copy_from(&undo);
        // The factor 2 is because the error has the sine of half the angle.
        back.fixed_view_mut::<3, 3>(0, 3)
            .copy_from(&(undo * lever * -2.0));
        back.fixed_view_mut::<3, 3>(3, 3).copy_from(&undo);
        let moved = back.transpose() * information * back;
        let symmetric = (moved + moved.transpose()) * 0.5;
        (self * vertex_from_sensor.inverse(), symmetric)
    }
    fn relative_to_vertex(
        self,
        information: SMatrix<f64, 6, 6>,
        vertex_from_sensor: &Isometry3<f64>,
    ) -> (Self, SMatrix<f64, 6, 6>) {
        let rotation = *vertex_from_sensor.rotation.to_rotation_matrix().matrix();
        let position = vertex_from_sensor * Point3::from(self.translation.vector);
        let rotated = rotation * information.fixed_view::<3, 3>(0, 0) * rotation.transpose();
        let mut of_vertex = SMatrix::<f64, 6, 6>::zeros();
        let symmetric = (rotated + rotated.transpose()) * 0.5;
        of_vertex.fixed_view_mut::<3, 3>(0, 0).copy_from(&symmetric);
        let pose = Isometry3::from_parts(position.coords.into(), UnitQuaternion::identity());
        (pose, of_vertex)
    }
}

impl Written<7> for Similarity3<f64> {
    const VERTEX: &'static str = "VERTEX_SIM3:QUAT";
    const EDGE: &'static str = "EDGE_SIM3:QUAT";
    const PRIOR: &'static str = "EDGE_SIM3_PRIOR";
    const POSITION: &'static str = "EDGE_SIM3_XYZ_PRIOR";
    const LANDMARK: &'static str = "VERTEX_SIM3_XYZ";
    const SIGHTING: &'static str = "EDGE_SIM3_XYZ";
    const HAS_OFFSET: bool = false;
    const ORIGIN: &'static [f64] = &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0, 1.0];
    const NUM_AXES: usize = 3;
    fn read(n: &[f64]) -> std::result::Result<Self, &'static str> {
        let isometry = <Isometry3<f64> as Written<6>>::read(&n[..7])?;
        if n[7] > 0.0 {
            Ok(Similarity3::from_isometry(isometry, n[7]))
        } else {
            Err("the scale is not greater than 0")
        }
    }
    fn write(&self, numbers: &mut Vec<f64>) {
        Written::<6>::write(&self.isometry, numbers);
        numbers.push(self.scaling());
    }
}
