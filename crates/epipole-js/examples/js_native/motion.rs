//! Calls of functions of features of photos, of known poses, and of paths.

use crate::dense::replaced;
use crate::scenes::{camera, wedge};
use crate::values::*;
use crate::{Calls, Failure};
use epipole_js::value::Value;

/// Distance between the positions of the camera.
const STEP: f64 = 0.25;

/// Distance between the two cameras of the rig.
const BASELINE: f64 = 0.1;

impl Calls {
    pub(super) fn add_motion(&mut self) -> Result<(), Failure> {
        let at = |place: f64| wedge(160, 120, place);
        let mut photos: Vec<Value> = (0..4).map(|k| at(STEP * f64::from(k))).collect();
        // A photo without features.
        photos.push(image(160.0, 120.0, Value::Bytes(vec![90; 160 * 120])));
        let features = (photos.iter())
            .map(|photo| self.add("photoFeatures", std::slice::from_ref(photo)))
            .collect::<Result<Vec<_>, _>>()?;
        let images: Vec<Value> = features.iter().map(|one| get(one, "image")).collect();
        let cameras = Value::List(vec![camera(160.0, 120.0, 150.0, "brown", vec![0.0; 5])]);
        let pairs = self.add("matchFeatures", &[Value::List(features.clone())])?;
        let input = [Value::List(images.clone()), cameras.clone(), pairs.clone()];
        let result = self.add("reconstruct", &input)?;
        let mut asked = input.to_vec();
        asked.push(result.clone());
        let reasons = self.add("whyUnregistered", &asked)?;
        if reasons == Value::List(Vec::new()) {
            return Err("an empty photo is not registered".into());
        }
        let Value::List(components) = get(&result, "components") else {
            return Err("components are a list".into());
        };
        let scene = components.first().ok_or("no motion is reconstructed")?;
        self.add_scene(scene, &images)?;
        self.add_tracks(&input, scene)?;
        self.add_localization(&features, &cameras)?;
        self.add_odometry(&input, &features)?;
        self.add_dense(scene, &Value::List(photos))
    }

    fn add_scene(&mut self, scene: &Value, images: &[Value]) -> Result<(), Failure> {
        let images = Value::List(images.to_vec());
        let given = [scene.clone(), images.clone()];
        self.add("meanReprojectionPx", &given)?;
        self.add("determinesFocal", &given)?;
        self.add("refineLenses", &given)?;
        let bundle = self.add("reconstructionBundle", &given)?;
        self.add("adjustBundle", &[get(&bundle, "bundle")])?;
        let similarity = record([
            ("quaternion", Value::Doubles(vec![0.8, 0.0, 0.6, 0.0])),
            ("translation", Value::Doubles(vec![1.0, -2.0, 0.5])),
            ("scale", Value::Number(2.5)),
        ]);
        let moved = self.add("moveReconstruction", &[scene.clone(), similarity.clone()])?;
        let none = replaced(&similarity, "scale", Value::Number(0.0));
        self.fail("moveReconstruction", &[scene.clone(), none])?;
        let unseen = replaced(scene, "cameras", Value::List(Vec::new()));
        self.fail("meanReprojectionPx", &[unseen, images])?;
        let (from, to) = (get(scene, "points"), get(&moved, "points"));
        let found = self.add("alignPoints", &[from.clone(), to.clone()])?;
        if (numbers(&found, "scale") - 2.5).abs() > 1e-9 {
            return Err("the similarity is found".into());
        }
        self.add("alignPoints", &[from.clone(), to.clone(), text("rigid")])?;
        self.add("absoluteTrajectoryError", &[from.clone(), to.clone()])?;
        let threshold = Value::Number(0.05);
        self.add("estimateSimilarityOfPoints", &[from, to, threshold])?;
        Ok(())
    }

    fn add_tracks(&mut self, input: &[Value; 3], scene: &Value) -> Result<(), Failure> {
        let [images, cameras, pairs] = input.clone();
        let (Value::List(photos), Value::List(matched)) = (&images, &pairs) else {
            return Err("images and pairs are lists".into());
        };
        let count = |photo| doubles(&get(photo, "keypoints")).len() as u32 / 2;
        let counts = Value::Indices(photos.iter().map(count).collect());
        self.add("buildTracks", &[counts, pairs.clone()])?;
        self.fail("buildTracks", &[Value::Indices(vec![1]), pairs.clone()])?;
        let camera = match &cameras {
            Value::List(list) => list[0].clone(),
            _ => Value::Nothing,
        };
        let [first, second] = [0, 1].map(|photo: usize| photos[photo].clone());
        let two = [camera.clone(), camera];
        let given = [matched[0].clone(), first, second];
        self.add("verifyMatches", &[&given[..], &two[..]].concat())?;
        let Value::List(posed) = get(scene, "cameras") else {
            return Err("cameras are a list".into());
        };
        let poses: Vec<Value> = posed.iter().map(|one| get(one, "camFromWorld")).collect();
        let known = [images, cameras, pairs, Value::List(poses)];
        let found = self.add("triangulateTracks", &known)?;
        if doubles(&get(&found, "points")).len() < 300 {
            return Err("known poses have points".into());
        }
        Ok(())
    }

    fn add_localization(&mut self, features: &[Value], cameras: &Value) -> Result<(), Failure> {
        let others = [0, 1, 3].map(|photo: usize| features[photo].clone());
        let images = others.iter().map(|one| get(one, "image")).collect();
        let known = Value::List(others.to_vec());
        let pairs = self.add("matchFeatures", std::slice::from_ref(&known))?;
        let result = self.add(
            "reconstruct",
            &[Value::List(images), cameras.clone(), pairs],
        )?;
        let (Value::List(components), Value::List(lenses)) = (get(&result, "components"), cameras)
        else {
            return Err("components are a list".into());
        };
        let scene = components.first().ok_or("three photos are reconstructed")?;
        let given = [scene.clone(), known, features[2].clone(), lenses[0].clone()];
        let found = self.add("localize", &given)?;
        match get(&found, "inlierPoints") {
            Value::Indices(points) if points.len() >= 30 => {}
            _ => return Err("the third photo is localized".into()),
        }
        let [scene, known, _, camera] = given;
        self.fail("localize", &[scene, known, features[4].clone(), camera])
    }

    fn add_odometry(&mut self, input: &[Value; 3], features: &[Value]) -> Result<(), Failure> {
        let path = self.add("monocularOdometry", input)?;
        let Value::List(poses) = get(&path, "worldFromCam") else {
            return Err("a path is a list".into());
        };
        let poses: Vec<Value> = (poses.into_iter())
            .filter(|pose| *pose != Value::Nothing)
            .collect();
        if poses.len() < 4 {
            return Err("four frames are tracked".into());
        }
        let [images, cameras, _] = input;
        let (Value::List(lefts), Value::List(lenses)) = (images, cameras) else {
            return Err("images are a list".into());
        };
        let (mut rights, mut left_right) = (Vec::new(), Vec::new());
        for (frame, left) in features[..4].iter().enumerate() {
            let photo = wedge(160, 120, STEP * frame as f64 + BASELINE);
            let right = self.add("photoFeatures", &[photo])?;
            left_right.push(self.add("matchRectified", &[left.clone(), right.clone()])?);
            rights.push(get(&right, "image"));
        }
        let pairs = self.add("matchFeatures", &[Value::List(features[..4].to_vec())])?;
        let motion = record([("translation", Value::Doubles(vec![-BASELINE, 0.0, 0.0]))]);
        let rig = [
            Value::List(lefts[..4].to_vec()),
            cameras.clone(),
            pairs,
            Value::List(rights),
            Value::List(left_right),
            motion,
            lenses[0].clone(),
        ];
        let driven = self.add("stereoOdometry", &rig)?;
        let Value::List(driven) = get(&driven, "worldFromCam") else {
            return Err("a path is a list".into());
        };
        let last = doubles(&get(
            driven.last().unwrap_or(&Value::Nothing),
            "translation",
        ));
        if last.first().is_none_or(|x| (x - 3.0 * STEP).abs() > 0.01) {
            return Err(format!("the rig moves by three steps, not {last:?}").into());
        }
        let (driven, poses) = (Value::List(driven), Value::List(poses));
        self.add("relativePoseError", &[driven.clone(), poses.clone()])?;
        let far = Value::Number(9.0);
        self.fail("relativePoseError", &[driven, poses.clone(), far])?;
        let turn = record([
            ("translation", Value::Doubles(vec![0.5, 0.0, 0.1])),
            ("scale", Value::Number(0.9)),
        ]);
        let closure = record([
            ("from", Value::Number(0.0)),
            ("to", Value::Number(3.0)),
            ("fromFromTo", turn),
            ("weight", Value::Number(100.0)),
        ]);
        let loops = Value::List(vec![closure]);
        self.add("closeLoops", &[poses.clone(), loops.clone()])?;
        self.add("closeLoops", &[poses.clone(), loops, text("rigid")])?;
        self.fail("closeLoops", &[poses, Value::List(Vec::new())])
    }

    pub(super) fn add_places(&mut self) -> Result<(), Failure> {
        let place = |latitude: f64, longitude: f64| {
            record([
                ("latitudeDeg", Value::Number(latitude)),
                ("longitudeDeg", Value::Number(longitude)),
                ("heightM", Value::Number(430.0)),
            ])
        };
        let (here, there) = (place(47.37, 8.54), place(47.38, 8.55));
        self.add("localFromGeodetic", &[there, here.clone()])?;
        self.fail("localFromGeodetic", &[place(91.0, 0.0), here])
    }
}
