//! Calls of functions of points and cameras.

use crate::values::*;
use crate::{Calls, Failure};
use epipole_js::value::{Key, Value};

impl Calls {
    pub(super) fn add_camera(&mut self, exact: &Value) -> Result<(), Failure> {
        let (camera1, camera2) = cameras(exact);
        let pixels = get(exact, "pixels1");
        self.add("projectFromWorld", &[camera2.clone(), get(exact, "points")])?;
        for (kind, coefficients) in [
            ("brown", vec![-0.1, 0.02, 0.001, -0.001, 0.003]),
            (
                "rational",
                vec![-0.1, 0.02, 0.001, -0.001, 0.003, 0.1, 0.01, 0.002],
            ),
            ("fisheye", vec![0.01, -0.02, 0.003, -0.001]),
            ("division", vec![-0.1]),
        ] {
            let coefficients = Value::Doubles(coefficients);
            let camera = record([
                ("width", Value::Number(640.0)),
                ("height", Value::Number(480.0)),
                ("intrinsics", intrinsics(exact)),
                (
                    "lens",
                    record([("kind", text(kind)), ("coefficients", coefficients)]),
                ),
            ]);
            let rays = self.add("unproject", &[camera.clone(), pixels.clone()])?;
            self.add("project", &[camera.clone(), rays])?;
            self.add("pinholePixel", &[camera, pixels.clone()])?;
        }
        let poses = [get(&camera1, "camFromWorld"), get(&camera2, "camFromWorld")];
        self.add("relativeMotion", &poses)?;
        self.add("composeTransforms", &poses)?;
        let [_, pose] = poses;
        self.add("invertTransform", std::slice::from_ref(&pose))?;
        self.add("rotationAngleRad", std::slice::from_ref(&pose))?;
        self.add("transformPoints", &[pose, get(exact, "points")])?;
        self.add("intrinsicsMatrix", &[intrinsics(exact)])?;
        self.add("projectionMatrix", &[camera2])?;
        let [center, target, up] = [[1.0, -2.0, 3.0], [0.0, 0.5, 0.0], [0.0, -1.0, 0.0]]
            .map(|vector| Value::Doubles(vector.to_vec()));
        self.add("lookAt", &[center.clone(), target, up.clone()])?;
        self.fail("lookAt", &[center.clone(), center, up])
    }

    pub(super) fn add_homography(&mut self, wall: &Value) -> Result<(), Failure> {
        let (pixels1, pixels2) = (get(wall, "pixels1"), get(wall, "pixels2"));
        let matches = [pixels1.clone(), pixels2.clone()];
        let report = self.add("estimateHomography", &matches)?;
        let options = record([
            ("maxErrorPx", Value::Number(2.0)),
            ("threshold", text("noise")),
            ("sampler", text("prosac")),
            ("score", text("inlierCount")),
            ("seed", Value::Number(11.0)),
        ]);
        self.add(
            "estimateHomography",
            &[pixels1.clone(), pixels2.clone(), options],
        )?;
        self.add("estimateSimilarity", &matches)?;
        self.add("fitSimilarity", &matches)?;
        self.add("fitHomography", &matches)?;
        self.add(
            "homography4point",
            &[first(&pixels1, 8), first(&pixels2, 8)],
        )?;
        let h = get(&report, "model");
        let with_h = [h.clone(), pixels1.clone(), pixels2.clone()];
        self.add("refineHomography", &with_h)?;
        let huber = record([("huber", record([("width", Value::Number(1.0))]))]);
        self.add(
            "refineHomography",
            &[h.clone(), pixels1.clone(), pixels2.clone(), huber],
        )?;
        self.add("transfer", &[h.clone(), pixels1.clone()])?;
        self.add("transferErrorPx", &with_h)?;
        self.add("homographySampsonPx", &with_h)?;
        let k = intrinsics(wall);
        let motions = self.add("decomposeHomography", &[h, k.clone(), k.clone()])?;
        let Value::List(motions) = motions else {
            return Err("motions are a list".into());
        };
        let motion = motions.first().ok_or("no motion")?;
        let (pose, normal) = (get(motion, "cam2FromCam1"), get(motion, "normalInCam1"));
        let distance = Value::Number(5.0);
        self.add(
            "homographyFromMotion",
            &[pose, normal, distance, k.clone(), k],
        )?;
        // Errors are the same, too.
        self.fail("fitHomography", &[first(&pixels1, 6), first(&pixels2, 6)])?;
        self.fail("fitHomography", &[first(&pixels1, 7), first(&pixels2, 8)])?;
        self.fail(
            "estimateHomography",
            &[pixels1, pixels2, record([("seeds", text("x"))])],
        )
    }

    pub(super) fn add_lines(&mut self) -> Result<(), Failure> {
        let on_line = (0..12).flat_map(|i| [f64::from(i), 2.0 + 0.5 * f64::from(i % 3)]);
        let astray = (0..5).flat_map(|i| [f64::from(i * i), 40.0 - f64::from(i)]);
        let points = Value::Doubles(on_line.chain(astray).collect());
        let only = std::slice::from_ref(&points);
        self.add("estimateLine", only)?;
        self.add("fitLineTotalLeastSquares", only)?;
        self.add("leastMedianLine", only)?;
        self.add("fitLineHuber", &[points.clone(), Value::Number(1.345)])?;
        self.fail("fitLineHuber", &[points.clone(), Value::Number(0.0)])?;
        self.fail("estimateLine", &[first(&points, 2)])?;
        for ratio in [0.5, 0.0] {
            let arguments = [ratio, 8.0, 0.99].map(Value::Number);
            self.add("numTrialsWithReplacement", &arguments)?;
        }
        let arguments = [50.0, 100.0, 8.0, 0.99].map(Value::Number);
        self.add("numTrialsWithoutReplacement", &arguments)?;
        Ok(())
    }

    pub(super) fn add_robust(&mut self, world: &Value) -> Result<(), Failure> {
        let (pixels1, pixels2) = (get(world, "pixels1"), get(world, "pixels2"));
        let (camera1, camera2) = cameras(world);
        let camera = get(&camera1, "camera");
        let arguments = [pixels1.clone(), pixels2.clone()];
        let calibrated = [
            pixels1.clone(),
            pixels2.clone(),
            camera.clone(),
            camera.clone(),
        ];
        let report = self.add("estimateFundamental", &arguments)?;
        self.add("estimateEssential", &calibrated)?;
        self.add("estimateRelativePose", &calibrated)?;
        let (gravity1, gravity2) = (gravity(&camera1), gravity(&camera2));
        let mut with_gravity = calibrated.to_vec();
        with_gravity.extend([gravity1, gravity2]);
        self.add("estimateRelativePoseWithGravity", &with_gravity)?;
        let k = intrinsics(world);
        let principal = Value::Doubles(vec![numbers(&k, "cuPx"), numbers(&k, "cvPx")]);
        let rotated = tilted(&pixels2, &k);
        self.add(
            "estimateRelativePoseAndFocal",
            &[pixels1.clone(), rotated, principal.clone(), principal],
        )?;
        let f = get(&report, "model");
        for name in [
            "sampsonPx",
            "symmetricEpipolarPx",
            "refineFundamental",
            "correctMatches",
        ] {
            self.add(name, &[f.clone(), pixels1.clone(), pixels2.clone()])?;
        }
        Ok(())
    }

    pub(super) fn add_epipolar(&mut self, exact: &Value) -> Result<(), Failure> {
        let (pixels1, pixels2) = (get(exact, "pixels1"), get(exact, "pixels2"));
        let (camera1, camera2) = cameras(exact);
        let (camera, k) = (get(&camera1, "camera"), intrinsics(exact));
        let principal = Value::Doubles(vec![numbers(&k, "cuPx"), numbers(&k, "cvPx")]);
        let (rays1, rays2) = (rays(&pixels1, &k), rays(&pixels2, &k));
        for name in [
            "fundamental8point",
            "fundamental8pointExplained",
            "fundamental8pointUnnormalized",
            "epipolarRow",
        ] {
            self.add(name, &[pixels1.clone(), pixels2.clone()])?;
        }
        self.add(
            "fundamental7point",
            &[first(&pixels1, 14), first(&pixels2, 14)],
        )?;
        self.add("essential8point", &[rays1.clone(), rays2.clone()])?;
        self.add("essential5point", &[first(&rays1, 15), first(&rays2, 15)])?;
        self.add(
            "essential6point",
            &[
                first(&pixels1, 12),
                first(&pixels2, 12),
                principal.clone(),
                principal.clone(),
            ],
        )?;
        let down = [gravity(&camera1), gravity(&camera2)];
        let [gravity1, gravity2] = down;
        self.add(
            "relativePose3point",
            &[first(&rays1, 9), first(&rays2, 9), gravity1, gravity2],
        )?;
        let f = self.add("fundamentalFromCameras", &[camera1, camera2])?;
        self.add("epipolarLine1", &[f.clone(), pixels2.clone()])?;
        self.add("epipolarLine2", &[f.clone(), pixels1.clone()])?;
        self.add("epipoles", std::slice::from_ref(&f))?;
        let rotated = tilted(&pixels2, &k);
        let rotated = self.add("fundamental8point", &[pixels1.clone(), rotated])?;
        let focals = [rotated, principal.clone(), principal];
        self.add("focalLengthsFromFundamental", &focals)?;
        let ks = [k.clone(), k.clone()];
        let [k1, k2] = ks;
        let e = self.add("essentialFromFundamental", &[f, k1.clone(), k2.clone()])?;
        self.add(
            "fundamentalFromEssential",
            &[e.clone(), k1.clone(), k2.clone()],
        )?;
        let any = Value::Doubles((1..10).map(|i| 1.0 / f64::from(i)).collect());
        self.add("enforceRank2", std::slice::from_ref(&any))?;
        self.add("projectToEssential", &[any])?;
        let motions = self.add("decomposeEssential", &[e])?;
        let selected = self.add(
            "selectPose",
            &[motions, pixels1.clone(), pixels2.clone(), k1, k2],
        )?;
        let motion = get(&selected, "cam2FromCam1");
        self.add("essentialFromMotion", std::slice::from_ref(&motion))?;
        self.add(
            "refineRelativePose",
            &[motion, pixels1, pixels2, camera.clone(), camera],
        )?;
        Ok(())
    }

    pub(super) fn add_triangulation(&mut self, exact: &Value) -> Result<(), Failure> {
        let (pixels1, pixels2) = (get(exact, "pixels1"), get(exact, "pixels2"));
        let (camera1, camera2) = cameras(exact);
        let (k, p1, p2) = (
            intrinsics(exact),
            projection(&camera1),
            projection(&camera2),
        );
        let (rays1, rays2) = (rays(&pixels1, &k), rays(&pixels2, &k));
        self.add(
            "triangulateDlt",
            &[p1, p2, pixels1.clone(), pixels2.clone()],
        )?;
        let motion = record([
            (
                "rotation",
                Value::Doubles(vec![1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]),
            ),
            ("translation", Value::Doubles(vec![-1.0, 0.0, 0.25])),
        ]);
        for name in [
            "triangulateMidpoint",
            "triangulateWeightedMidpoint",
            "triangulateAngular",
        ] {
            self.add(name, &[motion.clone(), rays1.clone(), rays2.clone()])?;
        }
        self.add(
            "triangulateOptimal",
            &[camera1.clone(), camera2.clone(), pixels1, pixels2],
        )?;
        let many = self.add(
            "multiViewProblem",
            &[record([
                ("numCameras", Value::Number(5.0)),
                ("numPoints", Value::Number(20.0)),
                ("noisePx", Value::Number(0.3)),
            ])],
        )?;
        let views = get(&many, "cameras");
        let pixels = first(&get(&many, "observationPixel"), 10);
        self.add("triangulateNviewDlt", &[views.clone(), pixels.clone()])?;
        let point = self.add("triangulateNview", &[views.clone(), pixels])?;
        let point = get(&point, "pointInWorld");
        self.add("pointCovariance", &[views, point, Value::Number(0.5)])?;
        let centers = [vec![0.0, 0.0, -5.0], vec![1.0, 0.0, -5.0]].map(Value::Doubles);
        let [center1, center2] = centers;
        self.add(
            "triangulationAngleRad",
            &[center1, center2, get(exact, "points")],
        )?;
        Ok(())
    }

    pub(super) fn add_absolute_pose(
        &mut self,
        world: &Value,
        exact: &Value,
    ) -> Result<(), Failure> {
        let (points, pixels) = (get(world, "points"), get(world, "pixels2"));
        let posed = get(world, "camera2");
        let (camera, k) = (get(&posed, "camera"), intrinsics(world));
        let principal = Value::Doubles(vec![numbers(&k, "cuPx"), numbers(&k, "cvPx")]);
        let arguments = [points.clone(), pixels.clone(), camera.clone()];
        let report = self.add("estimateAbsolutePose", &arguments)?;
        self.add(
            "estimateAbsolutePoseAndFocal",
            &[points.clone(), pixels.clone(), principal.clone()],
        )?;
        let pose = get(&report, "model");
        let with_pose = [pose, points.clone(), pixels.clone(), camera.clone()];
        self.add("refineAbsolutePose", &with_pose)?;
        self.add("findFlippedPose", &with_pose)?;
        self.add("reprojectionErrorPx", &[posed, points, pixels])?;
        let (points, pixels) = (get(exact, "points"), get(exact, "pixels2"));
        self.add("fitAbsolutePose", &[points.clone(), pixels.clone(), camera])?;
        self.add("poseDlt", &[points.clone(), pixels.clone(), k.clone()])?;
        self.add(
            "poseP3p",
            &[first(&rays(&pixels, &k), 9), first(&points, 9)],
        )?;
        self.add(
            "poseP4pf",
            &[first(&pixels, 8), first(&points, 12), principal],
        )?;
        Ok(())
    }

    pub(super) fn add_two_view(
        &mut self,
        world: &Value,
        wall: &Value,
        exact: &Value,
    ) -> Result<(), Failure> {
        for views in [world, wall] {
            let camera = get(&cameras(views).0, "camera");
            let pixels = [get(views, "pixels1"), get(views, "pixels2")];
            self.add("estimateTwoView", &pixels)?;
            let [pixels1, pixels2] = pixels;
            self.add(
                "estimateTwoViewCalibrated",
                &[pixels1, pixels2, camera.clone(), camera],
            )?;
        }
        let (camera1, camera2) = cameras(exact);
        let (pixels1, pixels2) = (get(exact, "pixels1"), get(exact, "pixels2"));
        let camera = get(&camera1, "camera");
        let rotated = tilted(&pixels1, &intrinsics(exact));
        self.add(
            "estimateRotation",
            &[pixels1.clone(), rotated, camera.clone(), camera.clone()],
        )?;
        let poses = [get(&camera1, "camFromWorld"), get(&camera2, "camFromWorld")];
        let motion = self.add("relativeMotion", &poses)?;
        let strict = record([("maxErrorPx", Value::Number(2.0))]);
        self.add(
            "twoViewReconstruction",
            &[pixels1, pixels2, camera.clone(), camera, motion, strict],
        )?;
        Ok(())
    }

    pub(super) fn add_bundle(&mut self) -> Result<(), Failure> {
        let world = self.add(
            "multiViewProblem",
            &[record([
                ("numCameras", Value::Number(4.0)),
                ("numPoints", Value::Number(25.0)),
                ("noisePx", Value::Number(0.5)),
            ])],
        )?;
        let shifted = doubles(&get(&world, "points"))
            .into_iter()
            .enumerate()
            .map(|(index, x)| x + 0.01 * (index % 5) as f64);
        let bundle = record([
            ("cameras", get(&world, "cameras")),
            ("points", Value::Doubles(shifted.collect())),
            ("observationCamera", get(&world, "observationCamera")),
            ("observationPoint", get(&world, "observationPoint")),
            ("observationPixel", get(&world, "observationPixel")),
        ]);
        self.add("adjustBundle", std::slice::from_ref(&bundle))?;
        let center = Value::Doubles(vec![0.0, 0.0, -5.0]);
        let prior = record([
            ("centerInWorld", center),
            ("sigma", Value::Doubles(vec![0.1, 0.2, 0.3])),
        ]);
        let options = record([
            (
                "loss",
                record([("huber", record([("width", Value::Number(2.0))]))]),
            ),
            ("refineFocal", Value::Flag(true)),
            ("heldPoints", Value::List(vec![Value::Flag(true)])),
            ("positionPriors", Value::List(vec![Value::Nothing, prior])),
            ("lm", record([("maxIterations", Value::Number(5.0))])),
        ]);
        let adjusted = self.add("adjustBundle", &[bundle, options])?;
        // A result is an argument, also with a sensor.
        let Value::Record(mut again) = get(&adjusted, "bundle") else {
            return Err("a bundle is a record".into());
        };
        let posed = get(&world, "cameras");
        let Value::List(posed) = posed else {
            return Err("cameras are a list".into());
        };
        let shift = Value::Doubles(vec![-0.1, 0.0, 0.0]);
        let sensor = record([
            ("sensorFromCamera", record([("translation", shift)])),
            ("camera", get(&posed[0], "camera")),
            ("lens", Value::Number(1.0)),
        ]);
        again.retain(|(key, _)| key != "sensors");
        again.push((Key::from("sensors"), Value::List(vec![sensor])));
        self.add("adjustBundle", &[Value::Record(again.clone())])?;
        again.retain(|(key, _)| key != "observationPoint");
        again.push((Key::from("observationPoint"), Value::Indices(vec![0, 1])));
        self.fail("adjustBundle", &[Value::Record(again)])
    }
}
