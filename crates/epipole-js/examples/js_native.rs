//! Results of every function, computed natively, for the test of the npm package that compares
//! them with WebAssembly bit for bit: `cargo run --example js_native -- OUT.json`.
//!
//! The file is a list of calls: name, arguments, result or error. Numbers are the hexadecimal bytes
//! of arrays in little endian.

use epipole_js::value::{Key, Value, camel};
use epipole_js::{GROUPS, call};
use std::fmt::Write;

type Failure = Box<dyn std::error::Error>;

fn main() -> Result<(), Failure> {
    let path = std::env::args()
        .nth(1)
        .ok_or("the output file is missing")?;
    let mut calls = Calls::default();
    calls.add_all()?;
    for function in GROUPS.iter().flat_map(|group| group.functions) {
        let name = camel(function.name);
        if !calls.names.contains(&name) {
            return Err(format!("{name} is never called").into());
        }
    }
    std::fs::write(path, format!("[\n{}\n]\n", calls.lines.join(",\n")))?;
    Ok(())
}

/// Calls that were made, as JSON.
#[derive(Default)]
struct Calls {
    names: Vec<String>,
    lines: Vec<String>,
}

impl Calls {
    /// Calls a function and keeps arguments and result.
    fn add(&mut self, name: &str, given: &[Value]) -> Result<Value, Failure> {
        let outcome = call(name, given, &mut ());
        let mut line = format!("{{\"name\": {name:?}, \"given\": ");
        json(&Value::List(given.to_vec()), &mut line);
        match &outcome {
            Ok(value) => {
                line += ", \"result\": ";
                json(value, &mut line);
            }
            Err(fault) => write!(line, ", \"fault\": [{:?}, {:?}]", fault.kind, fault.message)?,
        }
        self.lines.push(line + "}");
        self.names.push(name.to_owned());
        Ok(outcome?)
    }

    /// The same for a call that must fail.
    fn fail(&mut self, name: &str, given: &[Value]) -> Result<(), Failure> {
        match self.add(name, given) {
            Ok(_) => Err(format!("{name} must fail").into()),
            Err(_) => Ok(()),
        }
    }

    fn add_all(&mut self) -> Result<(), Failure> {
        let world = self.add(
            "twoViewProblem",
            &[record([
                ("numPoints", Value::Number(120.0)),
                ("noisePx", Value::Number(0.5)),
                ("outlierFraction", Value::Number(0.3)),
                ("seed", Value::Number(7.0)),
            ])],
        )?;
        let exact = self.add("twoViewProblem", &[])?;
        let plane = record([("plane", record([("halfSideM", Value::Number(1.0))]))]);
        let wall = self.add(
            "twoViewProblem",
            &[record([
                ("structure", plane),
                ("noisePx", Value::Number(0.5)),
                ("outlierFraction", Value::Number(0.2)),
                ("seed", Value::Number(3.0)),
            ])],
        )?;
        self.add_camera(&exact)?;
        self.add_homography(&wall)?;
        self.add_robust(&world)?;
        self.add_epipolar(&exact)?;
        self.add_triangulation(&exact)?;
        self.add_absolute_pose(&world, &exact)?;
        self.add_features()?;
        self.add_stereo(&exact)
    }

    fn add_camera(&mut self, exact: &Value) -> Result<(), Failure> {
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
        let [center, target, up] = [[1.0, -2.0, 3.0], [0.0, 0.5, 0.0], [0.0, -1.0, 0.0]]
            .map(|vector| Value::Doubles(vector.to_vec()));
        self.add("lookAt", &[center.clone(), target, up.clone()])?;
        self.fail("lookAt", &[center.clone(), center, up])
    }

    fn add_homography(&mut self, wall: &Value) -> Result<(), Failure> {
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

    fn add_robust(&mut self, world: &Value) -> Result<(), Failure> {
        let (pixels1, pixels2) = (get(world, "pixels1"), get(world, "pixels2"));
        let (camera1, camera2) = cameras(world);
        let camera = get(&camera1, "camera");
        let seen = [pixels1.clone(), pixels2.clone()];
        let calibrated = [
            pixels1.clone(),
            pixels2.clone(),
            camera.clone(),
            camera.clone(),
        ];
        let report = self.add("estimateFundamental", &seen)?;
        self.add("estimateEssential", &calibrated)?;
        self.add("estimateRelativePose", &calibrated)?;
        let (gravity1, gravity2) = (gravity(&camera1), gravity(&camera2));
        let mut with_gravity = calibrated.to_vec();
        with_gravity.extend([gravity1, gravity2]);
        self.add("estimateRelativePoseWithGravity", &with_gravity)?;
        let k = intrinsics(world);
        let principal = Value::Doubles(vec![numbers(&k, "cuPx"), numbers(&k, "cvPx")]);
        let turned = tilted(&pixels2, &k);
        self.add(
            "estimateRelativePoseAndFocal",
            &[pixels1.clone(), turned, principal.clone(), principal],
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

    fn add_epipolar(&mut self, exact: &Value) -> Result<(), Failure> {
        let (pixels1, pixels2) = (get(exact, "pixels1"), get(exact, "pixels2"));
        let (camera1, camera2) = cameras(exact);
        let (camera, k) = (get(&camera1, "camera"), intrinsics(exact));
        let principal = Value::Doubles(vec![numbers(&k, "cuPx"), numbers(&k, "cvPx")]);
        let (rays1, rays2) = (rays(&pixels1, &k), rays(&pixels2, &k));
        self.add("fundamental8point", &[pixels1.clone(), pixels2.clone()])?;
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
        let turned = tilted(&pixels2, &k);
        let turned = self.add("fundamental8point", &[pixels1.clone(), turned])?;
        let focals = [turned, principal.clone(), principal];
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

    fn add_triangulation(&mut self, exact: &Value) -> Result<(), Failure> {
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

    fn add_features(&mut self) -> Result<(), Failure> {
        let (first, second) = (texture(96, 64, 0), texture(96, 64, 2));
        let (gray1, gray2) = (floats(&first), floats(&second));
        self.add("photoToGray", std::slice::from_ref(&first))?;
        self.add("photoToGray", &[colors(&first, 4)])?;
        let corners = record([("kind", text("harris"))]);
        self.add("detectFeatures", &[colors(&first, 3), corners])?;
        for name in ["detectSift", "detectOrb"] {
            let features1 = self.add(name, std::slice::from_ref(&first))?;
            let features2 = self.add(name, std::slice::from_ref(&second))?;
            let descriptors = [
                get(&features1, "descriptors"),
                get(&features2, "descriptors"),
            ];
            self.add("nearestTwo", &descriptors)?;
            self.add("matchDescriptors", &descriptors)?;
            if name == "detectSift" {
                self.add(
                    "describeSift",
                    &[first.clone(), get(&features1, "keypoints")],
                )?;
            }
        }
        self.add("harrisResponse", &[gray1.clone(), Value::Number(0.05)])?;
        self.add("minEigenvalueResponse", std::slice::from_ref(&gray1))?;
        let corners = self.add("goodFeaturesToTrack", std::slice::from_ref(&gray1))?;
        let points = get(&corners, "points");
        self.add("refineCorners", &[gray1.clone(), points.clone()])?;
        let back = record([("maxForwardBackwardPx", Value::Number(1.0))]);
        self.add("trackLucasKanade", &[gray1, gray2, points, back])?;
        Ok(())
    }

    fn add_stereo(&mut self, exact: &Value) -> Result<(), Failure> {
        let (left, right) = (texture(96, 64, 0), texture(96, 64, 6));
        let near = record([("numDisparities", Value::Number(16.0))]);
        self.add("stereoBm", &[left.clone(), right.clone(), near.clone()])?;
        let found = self.add("stereoSgm", &[left.clone(), right.clone(), near.clone()])?;
        self.add("stereoSgm", &[floats(&left), floats(&right), near])?;
        let (size, range) = (Value::Number(20.0), Value::Number(1.0));
        let clean = self.add("removeSpeckles", &[found, size, range])?;
        let (focal, baseline) = (Value::Number(500.0), Value::Number(0.1));
        self.add(
            "depthImage",
            &[clean.clone(), focal.clone(), baseline.clone()],
        )?;
        self.add(
            "depthFromDisparity",
            &[focal, baseline, Value::Number(12.5)],
        )?;
        let k = record([
            ("fuPx", Value::Number(90.0)),
            ("fvPx", Value::Number(90.0)),
            ("cuPx", Value::Number(47.5)),
            ("cvPx", Value::Number(31.5)),
        ]);
        let brown = Value::Doubles(vec![-0.1, 0.02, 0.001, -0.001, 0.0]);
        let lens = record([("kind", text("brown")), ("coefficients", brown)]);
        let camera = record([
            ("width", Value::Number(96.0)),
            ("height", Value::Number(64.0)),
            ("intrinsics", k),
            ("lens", lens),
        ]);
        let motion = record([
            (
                "rotation",
                Value::Doubles(vec![0.96, 0.0, 0.28, 0.0, 1.0, 0.0, -0.28, 0.0, 0.96]),
            ),
            ("translation", Value::Doubles(vec![-0.1, 0.002, 0.004])),
        ]);
        let rig = [camera.clone(), camera.clone(), motion.clone()];
        let rectified = self.add("rectifyCalibrated", &rig)?;
        self.add("pointCloud", &[clean, get(&rectified, "q")])?;
        for (image1, image2) in [
            (left.clone(), right.clone()),
            (floats(&left), floats(&right)),
            (colors(&left, 4), colors(&right, 3)),
        ] {
            let mut given = vec![image1, image2];
            given.extend(rig.clone());
            self.add("rectifyImages", &given)?;
        }
        let (pixels1, pixels2) = (get(exact, "pixels1"), get(exact, "pixels2"));
        let (camera1, camera2) = cameras(exact);
        let f = self.add("fundamentalFromCameras", &[camera1, camera2])?;
        let (width, height) = (Value::Number(640.0), Value::Number(480.0));
        self.add("rectifyUncalibrated", &[f, pixels1, pixels2, width, height])?;
        Ok(())
    }

    fn add_absolute_pose(&mut self, world: &Value, exact: &Value) -> Result<(), Failure> {
        let (points, pixels) = (get(world, "points"), get(world, "pixels2"));
        let posed = get(world, "camera2");
        let (camera, k) = (get(&posed, "camera"), intrinsics(world));
        let principal = Value::Doubles(vec![numbers(&k, "cuPx"), numbers(&k, "cvPx")]);
        let seen = [points.clone(), pixels.clone(), camera.clone()];
        let report = self.add("estimateAbsolutePose", &seen)?;
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
}

fn record<const N: usize>(entries: [(&'static str, Value); N]) -> Value {
    Value::Record(entries.map(|(key, value)| (Key::from(key), value)).into())
}

fn text(text: &str) -> Value {
    Value::Text(text.to_owned())
}

fn get(value: &Value, key: &str) -> Value {
    match value {
        Value::Record(entries) => entries
            .iter()
            .find(|(name, _)| name == key)
            .map_or(Value::Nothing, |(_, value)| value.clone()),
        _ => Value::Nothing,
    }
}

fn doubles(value: &Value) -> Vec<f64> {
    match value {
        Value::Doubles(list) => list.clone(),
        _ => Vec::new(),
    }
}

fn numbers(value: &Value, key: &str) -> f64 {
    match get(value, key) {
        Value::Number(number) => number,
        _ => f64::NAN,
    }
}

fn first(value: &Value, count: usize) -> Value {
    Value::Doubles(doubles(value).into_iter().take(count).collect())
}

/// Gray image of squares of random brightness, moved to the left.
fn texture(width: usize, height: usize, shift: usize) -> Value {
    let gray = |u: usize, v: usize| {
        let (column, row) = ((u + shift) / 7, v / 5);
        let mixed = (column * 7919 + row * 104_729 + column * row * 31) % 251;
        mixed as u8
    };
    let data = (0..width * height).map(|place| gray(place % width, place / width));
    image(width as f64, height as f64, Value::Bytes(data.collect()))
}

fn image(width: f64, height: f64, data: Value) -> Value {
    record([
        ("width", Value::Number(width)),
        ("height", Value::Number(height)),
        ("data", data),
    ])
}

/// The same image with other data.
fn with_data(gray: &Value, data: impl FnOnce(&[u8]) -> Value) -> Value {
    let Value::Bytes(bytes) = get(gray, "data") else {
        return Value::Nothing;
    };
    image(
        numbers(gray, "width"),
        numbers(gray, "height"),
        data(&bytes),
    )
}

/// The same image in floats.
fn floats(gray: &Value) -> Value {
    let float = |&byte: &u8| f32::from(byte) / 255.0;
    with_data(gray, |bytes| {
        Value::Floats(bytes.iter().map(float).collect())
    })
}

/// The same image in color.
fn colors(gray: &Value, channels: usize) -> Value {
    let pixel = |&byte: &u8| [byte, byte / 2, 255 - byte, 255].into_iter().take(channels);
    with_data(gray, |bytes| {
        Value::Bytes(bytes.iter().flat_map(pixel).collect())
    })
}

fn cameras(world: &Value) -> (Value, Value) {
    (get(world, "camera1"), get(world, "camera2"))
}

fn intrinsics(world: &Value) -> Value {
    get(&get(&get(world, "camera1"), "camera"), "intrinsics")
}

/// Direction of gravity, +y of the world, in a camera's frame.
fn gravity(camera: &Value) -> Value {
    let r = doubles(&get(&get(camera, "camFromWorld"), "rotation"));
    Value::Doubles(vec![r[1], r[4], r[7]])
}

/// Rays through pixels, of any length.
fn rays(pixels: &Value, k: &Value) -> Value {
    let of = |key| numbers(k, key);
    let pixels = doubles(pixels);
    let rays = pixels.chunks_exact(2).flat_map(|pixel| {
        let u = (pixel[0] - of("cuPx")) / of("fuPx");
        let v = (pixel[1] - of("cvPx")) / of("fvPx");
        [u, v, 1.0]
    });
    Value::Doubles(rays.collect())
}

/// Pixels of the same camera turned about its x axis: the optical axes meet no more.
fn tilted(pixels: &Value, k: &Value) -> Value {
    let of = |key| numbers(k, key);
    let rays = doubles(&rays(pixels, k));
    let pixels = rays.chunks_exact(3).flat_map(|ray| {
        let (x, y, z) = (ray[0], 0.96 * ray[1] - 0.28, 0.28 * ray[1] + 0.96);
        [
            of("fuPx") * x / z + of("cuPx"),
            of("fvPx") * y / z + of("cvPx"),
        ]
    });
    Value::Doubles(pixels.collect())
}

/// Projection matrix K [R | t].
fn projection(camera: &Value) -> Value {
    let (k, pose) = (
        get(&get(camera, "camera"), "intrinsics"),
        get(camera, "camFromWorld"),
    );
    let (r, t) = (
        doubles(&get(&pose, "rotation")),
        doubles(&get(&pose, "translation")),
    );
    let row = |row: usize| [r[3 * row], r[3 * row + 1], r[3 * row + 2], t[row]];
    let [x, y, z] = [row(0), row(1), row(2)];
    let line =
        |of: [f64; 4], f: f64, c: f64| std::array::from_fn::<f64, 4, _>(|i| f * of[i] + c * z[i]);
    let top = line(x, numbers(&k, "fuPx"), numbers(&k, "cuPx"));
    let middle = line(y, numbers(&k, "fvPx"), numbers(&k, "cvPx"));
    Value::Doubles([top, middle, z].concat())
}

fn json(value: &Value, out: &mut String) {
    let bytes = |kind: &str, bytes: Vec<u8>, out: &mut String| {
        *out += &format!("{{\"{kind}\": \"");
        for byte in bytes {
            *out += &format!("{byte:02x}");
        }
        *out += "\"}";
    };
    match value {
        Value::Nothing => *out += "null",
        Value::Flag(flag) => *out += &flag.to_string(),
        Value::Number(number) => bytes("number", number.to_le_bytes().into(), out),
        Value::Text(text) | Value::Other(text) => *out += &format!("{text:?}"),
        Value::Bytes(list) => bytes("Uint8Array", list.clone(), out),
        Value::Indices(list) => {
            let list = list.iter().flat_map(|number| number.to_le_bytes());
            bytes("Uint32Array", list.collect(), out);
        }
        Value::Integers(list) => {
            let list = list.iter().flat_map(|number| number.to_le_bytes());
            bytes("Int32Array", list.collect(), out);
        }
        Value::Floats(list) => {
            let list = list.iter().flat_map(|number| number.to_le_bytes());
            bytes("Float32Array", list.collect(), out);
        }
        Value::Doubles(list) => {
            let list = list.iter().flat_map(|number| number.to_le_bytes());
            bytes("Float64Array", list.collect(), out);
        }
        Value::List(list) => {
            *out += "[";
            for (index, value) in list.iter().enumerate() {
                *out += if index > 0 { ", " } else { "" };
                json(value, out);
            }
            *out += "]";
        }
        Value::Record(entries) => {
            *out += "{\"record\": {";
            for (index, (key, value)) in entries.iter().enumerate() {
                *out += if index > 0 { ", " } else { "" };
                *out += &format!("{key:?}: ");
                json(value, out);
            }
            *out += "}}";
        }
    }
}
