//! Calls of functions of boards, photos of scenes, and pose graphs.

use crate::values::*;
use crate::{Calls, Failure};
use epipole_js::value::Value;

impl Calls {
    pub(super) fn add_warps(&mut self, exact: &Value) -> Result<(), Failure> {
        let gray = texture(40, 30, 0);
        let h = Value::Doubles(vec![1.1, 0.1, -2.0, 0.05, 0.9, 1.0, 1e-3, -1e-3, 1.0]);
        let a = Value::Doubles(vec![0.9, 0.1, 2.5, -0.1, 1.1, -1.5]);
        let options = record([
            ("width", Value::Number(31.0)),
            ("height", Value::Number(22.0)),
            ("interpolation", text("bicubic")),
            ("border", text("replicate")),
        ]);
        let images = [
            gray.clone(),
            floats(&gray),
            colors(&gray, 3),
            colors(&gray, 4),
        ];
        let camera = camera(
            40.0,
            30.0,
            36.0,
            "brown",
            vec![-0.1, 0.02, 0.001, -0.001, 0.0],
        );
        let all = text("all");
        let map = self.add("undistortionMap", std::slice::from_ref(&camera))?;
        let map = get(&map, "map");
        for image in images {
            self.add("warpPerspective", &[image.clone(), h.clone()])?;
            self.add("warpAffine", &[image.clone(), a.clone(), options.clone()])?;
            self.add("remap", &[image.clone(), map.clone()])?;
            self.add("undistortImage", &[image, camera.clone(), all.clone()])?;
        }
        let huge = record([("width", Value::Number(1e6))]);
        self.fail("warpAffine", &[gray.clone(), a, huge])?;
        let other = get(&cameras(exact).0, "camera");
        self.fail("undistortImage", &[gray.clone(), other])?;
        let short = record([
            ("width", Value::Number(2.0)),
            ("height", Value::Number(1.0)),
            ("sources", Value::Floats(vec![0.0])),
        ]);
        self.fail("remap", &[gray, short])
    }

    pub(super) fn add_calibration(&mut self) -> Result<(), Failure> {
        let camera = camera(
            320.0,
            240.0,
            300.0,
            "brown",
            vec![-0.05, 0.01, 0.0, 0.0, 0.0],
        );
        let boards = [
            (text("chessboard"), 7.0, 5.0, 0.03),
            (text("circles"), 7.0, 5.0, 0.03),
            (text("asymmetricCircles"), 4.0, 9.0, 0.02),
            (
                record([(
                    "charuco",
                    record([
                        ("dictionary", text("Aruco4x4_50")),
                        ("markerRatio", Value::Number(0.75)),
                    ]),
                )]),
                7.0,
                5.0,
                0.03,
            ),
            (
                record([("aprilGrid", record([("spacing", Value::Number(0.3))]))]),
                3.0,
                2.0,
                0.06,
            ),
        ];
        for (pattern, columns, rows, square) in boards {
            let board = record([
                ("pattern", pattern),
                ("columns", Value::Number(columns)),
                ("rows", Value::Number(rows)),
                ("squareM", Value::Number(square)),
            ]);
            self.add("boardDrawing", std::slice::from_ref(&board))?;
            self.add("boardMarks", std::slice::from_ref(&board))?;
            let pose = record([("translation", Value::Doubles(vec![-0.09, -0.07, 0.4]))]);
            let (noise, seed) = (Value::Number(0.01), Value::Number(3.0));
            let photo = self.add(
                "renderBoard",
                &[board.clone(), camera.clone(), pose, noise, seed],
            )?;
            let found = self.add("findBoard", &[photo.clone(), board])?;
            if get(&found, "pixels") == Value::Nothing {
                return Err(format!("no board is found: {:?}", get(&found, "problem")).into());
            }
            for dictionary in ["Aruco4x4_50", "AprilTag36h11"] {
                self.add("detectMarkers", &[photo.clone(), text(dictionary)])?;
            }
        }
        let board = record([
            ("pattern", text("chessboard")),
            ("columns", Value::Number(7.0)),
            ("rows", Value::Number(5.0)),
            ("squareM", Value::Number(0.03)),
        ]);
        self.add("findBoard", &[texture(96, 64, 0), board.clone()])?;
        let (left, right, homographies) = self.views(&board, &camera)?;
        let (width, height) = (Value::Number(320.0), Value::Number(240.0));
        let found = self.add("calibrate", &[board.clone(), left.clone(), width, height])?;
        let (left_camera, right_camera) = (get(&found, "camera"), camera);
        self.add(
            "calibrateRig",
            &[
                board.clone(),
                left_camera.clone(),
                right_camera.clone(),
                left.clone(),
                right,
            ],
        )?;
        self.add("intrinsicsFromPlanes", &[homographies])?;
        let none = Value::List(vec![Value::Nothing]);
        self.fail(
            "calibrateRig",
            &[board, left_camera, right_camera, left, none],
        )
    }

    /// Views of a board by two cameras, null for the last, and homographies of the left ones.
    fn views(&mut self, board: &Value, camera: &Value) -> Result<(Value, Value, Value), Failure> {
        let marks = doubles(&self.add("boardMarks", std::slice::from_ref(board))?);
        let flat: Vec<f64> = marks
            .chunks_exact(2)
            .flat_map(|mark| [mark[0], mark[1], 0.0])
            .collect();
        let (mut left, mut right, mut homographies) = (Vec::new(), Vec::new(), Vec::new());
        for (x, y) in [(0.28, 0.0), (-0.28, 0.0), (0.0, 0.28), (0.0, -0.28)] {
            let pose = record([
                ("quaternion", Value::Doubles(vec![0.96, x, y, 0.0])),
                (
                    "translation",
                    Value::Doubles(vec![-0.09 + 0.1 * y, -0.06, 0.35]),
                ),
            ]);
            let shift = Value::Doubles(vec![-0.1, 0.01, 0.0]);
            let motion = record([("translation", shift)]);
            let other = self.add("composeTransforms", &[motion, pose.clone()])?;
            for (views, pose) in [(&mut left, pose), (&mut right, other)] {
                let points = self.add("transformPoints", &[pose, Value::Doubles(flat.clone())])?;
                views.push(self.add("project", &[camera.clone(), points])?);
            }
            let view = left.last().cloned().unwrap_or(Value::Nothing);
            homographies.push(self.add("fitHomography", &[Value::Doubles(marks.clone()), view])?);
        }
        for views in [&mut left, &mut right] {
            // A hidden mark, and a photo without a board.
            if let Some(Value::Doubles(pixels)) = views.first_mut() {
                pixels[..2].fill(f64::NAN);
            }
            views.push(Value::Nothing);
        }
        let lists = [left, right, homographies].map(Value::List);
        let [left, right, homographies] = lists;
        Ok((left, right, homographies))
    }

    pub(super) fn add_reconstruction(&mut self) -> Result<(), Failure> {
        let photos = Value::List(
            (0..4)
                .map(|index| wedge(160, 120, 0.25 * f64::from(index)))
                .collect(),
        );
        let camera = camera(160.0, 120.0, 150.0, "brown", vec![0.0; 5]);
        let cameras = Value::List(vec![camera]);
        let matched = self.add("matchPhotos", std::slice::from_ref(&photos))?;
        let (images, pairs) = (get(&matched, "images"), get(&matched, "pairs"));
        let result = self.add("reconstruct", &[images, cameras.clone(), pairs])?;
        let Value::List(components) = get(&result, "components") else {
            return Err("components are a list".into());
        };
        if components.is_empty() || doubles(&get(&components[0], "points")).len() < 300 {
            return Err("nothing is reconstructed".into());
        }
        let harris = record([("features", record([("maxFeatures", Value::Number(400.0))]))]);
        let refine = record([("refineFocal", Value::Flag(true))]);
        self.add(
            "reconstructPhotos",
            &[photos.clone(), cameras.clone(), harris, refine],
        )?;
        let one = Value::List(vec![texture(96, 64, 0)]);
        self.fail("reconstructPhotos", &[one, cameras])
    }

    pub(super) fn add_graphs(&mut self) -> Result<(), Failure> {
        let quarter = |along: f64| {
            record([
                ("quaternion", Value::Doubles(vec![0.8, 0.0, 0.6, 0.0])),
                ("translation", Value::Doubles(vec![along, 0.0, 0.1])),
            ])
        };
        let edge = |index: usize, key: &'static str| {
            let measured = quarter(1.0 + 0.01 * index as f64);
            record([
                ("from", Value::Number(index as f64)),
                ("to", Value::Number(((index + 1) % 5) as f64)),
                (key, measured),
            ])
        };
        let count = Value::Number(5.0);
        let edges = Value::List((0..5).map(|index| edge(index, "fromFromTo")).collect());
        let found = self.add("optimizePoseGraph", &[edges.clone(), count.clone()])?;
        let start = get(&found, "worldFromVertex");
        let cauchy = record([("cauchy", record([("width", Value::Number(1.0))]))]);
        self.add(
            "optimizePoseGraph",
            &[edges.clone(), count.clone(), start.clone(), cauchy.clone()],
        )?;
        self.fail("optimizePoseGraph", &[edges, Value::Number(4.0), start])?;
        let rotation_edges = Value::List((0..5).map(|index| edge(index, "toFromFrom")).collect());
        self.add("averageRotations", &[rotation_edges.clone(), count, cauchy])?;
        self.fail("averageRotations", &[rotation_edges, Value::Number(2.0)])
    }
}

/// Camera with its principal point in the middle.
pub(crate) fn camera(
    width: f64,
    height: f64,
    focal: f64,
    kind: &str,
    coefficients: Vec<f64>,
) -> Value {
    record([
        ("width", Value::Number(width)),
        ("height", Value::Number(height)),
        (
            "intrinsics",
            record([
                ("fuPx", Value::Number(focal)),
                ("fvPx", Value::Number(focal)),
                ("cuPx", Value::Number((width - 1.0) / 2.0)),
                ("cvPx", Value::Number((height - 1.0) / 2.0)),
            ]),
        ),
        (
            "lens",
            record([
                ("kind", text(kind)),
                ("coefficients", Value::Doubles(coefficients)),
            ]),
        ),
    ])
}

/// Photo of two walls that meet in an edge, by a camera moved along x.
pub(crate) fn wedge(width: usize, height: usize, along: f64) -> Value {
    let focal = 150.0;
    let gray = |place: usize| {
        let u = (place % width) as f64 - (width - 1) as f64 / 2.0;
        let v = (place / width) as f64 - (height - 1) as f64 / 2.0;
        // The walls are z = 4 - 0.5 |x|.
        let (du, dv) = (u / focal, v / focal);
        let hit = |slope: f64| (4.0 - slope * along) / (1.0 + slope * du);
        let depth = [0.5, -0.5]
            .map(hit)
            .into_iter()
            .fold(f64::INFINITY, f64::min);
        bumps(along + depth * du, depth * dv)
    };
    let data = (0..width * height).map(gray).collect();
    image(width as f64, height as f64, Value::Bytes(data))
}

/// Smooth random texture of two scales.
fn bumps(x: f64, y: f64) -> u8 {
    let at = |x: i64, y: i64| {
        let mixed = (x * 7919 + y * 104_729 + x * y * 31).rem_euclid(251);
        mixed as f64 / 250.0
    };
    let smooth = |x: f64, y: f64| {
        let (column, row) = (x.floor(), y.floor());
        let ease = |t: f64| t * t * (3.0 - 2.0 * t);
        let (s, t) = (ease(x - column), ease(y - row));
        let (column, row) = (column as i64, row as i64);
        let along = |row| at(column, row) * (1.0 - s) + at(column + 1, row) * s;
        along(row) * (1.0 - t) + along(row + 1) * t
    };
    (160.0 * smooth(4.0 * x, 4.0 * y) + 95.0 * smooth(11.0 * x + 3.0, 11.0 * y)) as u8
}
