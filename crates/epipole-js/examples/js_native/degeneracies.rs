//! Calls of functions that look for degenerate matches, and of those through lenses.

use crate::values::*;
use crate::{Calls, Failure};
use epipole_js::value::Value;

impl Calls {
    pub(super) fn add_degeneracies(&mut self, world: &Value, wall: &Value) -> Result<(), Failure> {
        let pixels = |views: &Value| [get(views, "pixels1"), get(views, "pixels2")];
        let all = |pixels: &Value| Value::Bytes(vec![1; doubles(pixels).len() / 2]);
        let inliers = get(wall, "isInlier");
        let mut given = pixels(wall).to_vec();
        given.push(inliers);
        let flat = self.add("findDegeneracy", &given)?;
        if get(&flat, "kind") != text("homography") {
            return Err("a wall is degenerate".into());
        }
        let [pixels1, pixels2] = pixels(world);
        let inliers = get(world, "isInlier");
        let moved = [pixels1.clone(), pixels2.clone(), inliers];
        self.add("findDegeneracy", &moved)?;
        self.add("findUnmoved", &moved)?;
        let same = [pixels1.clone(), pixels1.clone(), all(&pixels1)];
        self.add("findUnmoved", &same)?;
        let mask = Value::Bytes(vec![2; doubles(&pixels1).len() / 2]);
        self.fail("findUnmoved", &[pixels1.clone(), pixels2.clone(), mask])?;
        let camera = get(&get(world, "camera1"), "camera");
        let k = get(&camera, "intrinsics");
        let rotated = tilted(&pixels1, &k);
        for (camera, name) in [
            (camera.clone(), "findExplainingRotation"),
            (zoomed(&camera, 0.8), "findRotationAndFocal"),
        ] {
            for second in [rotated.clone(), pixels2.clone()] {
                let cameras = [camera.clone(), camera.clone()];
                let mut given = vec![pixels1.clone(), second];
                given.extend(cameras);
                given.push(all(&pixels1));
                self.add(name, &given)?;
            }
        }
        let fisheye = record([
            ("width", Value::Number(640.0)),
            ("height", Value::Number(480.0)),
            ("intrinsics", k),
            (
                "lens",
                record([
                    ("kind", text("fisheye")),
                    (
                        "coefficients",
                        Value::Doubles(vec![0.02, -0.01, 0.003, 0.0]),
                    ),
                ]),
            ),
        ]);
        for camera in [camera, fisheye] {
            let [pixels1, pixels2] = pixels(wall);
            let given = [pixels1, pixels2, camera.clone(), camera];
            self.add("estimateHomographyCalibrated", &given)?;
            let motion = record([("translation", Value::Doubles(vec![-1.0, 0.1, 0.05]))]);
            let mut given = given.to_vec();
            given.insert(0, motion);
            self.add("tangentSampsonPx", &given)?;
        }
        Ok(())
    }
}

/// The same camera with another focal length.
fn zoomed(camera: &Value, factor: f64) -> Value {
    let k = get(camera, "intrinsics");
    let of = |key| Value::Number(numbers(&k, key));
    let focal = |key| Value::Number(factor * numbers(&k, key));
    record([
        ("width", get(camera, "width")),
        ("height", get(camera, "height")),
        (
            "intrinsics",
            record([
                ("fuPx", focal("fuPx")),
                ("fvPx", focal("fvPx")),
                ("cuPx", of("cuPx")),
                ("cvPx", of("cvPx")),
            ]),
        ),
    ])
}
