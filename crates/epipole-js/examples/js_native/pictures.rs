//! Calls of functions of images.

use crate::values::*;
use crate::{Calls, Failure};
use epipole_js::value::Value;

impl Calls {
    pub(super) fn add_imaging(&mut self) -> Result<(), Failure> {
        let bytes = texture(40, 30, 0);
        let levels = with_data(&bytes, |bytes| {
            Value::Floats(bytes.iter().map(|&byte| f32::from(byte)).collect())
        });
        let constant = record([("constant", Value::Number(0.5))]);
        for image in [bytes.clone(), levels.clone()] {
            self.add("centeredDifference", std::slice::from_ref(&image))?;
            self.add("sobel", &[image.clone(), text("replicate")])?;
            self.add(
                "gaussianBlur",
                &[image, Value::Number(1.5), constant.clone()],
            )?;
        }
        self.add("derivative", &[levels.clone(), text("scharr")])?;
        self.add("gaussianDerivative", &[levels.clone(), Value::Number(2.0)])?;
        self.add("boxFilter", &[levels.clone(), Value::Number(5.0)])?;
        self.fail("boxFilter", &[levels.clone(), Value::Number(4.0)])?;
        self.fail("gaussianBlur", &[levels.clone(), Value::Number(0.0)])?;
        let kernel = image(3.0, 1.0, Value::Floats(vec![-0.5, 0.0, 0.5]));
        self.add("correlate", &[levels, kernel])?;
        Ok(())
    }

    pub(super) fn add_pyramids(&mut self) -> Result<(), Failure> {
        let gray = texture(41, 30, 0);
        let size = |u: f64, v: f64| [Value::Number(u), Value::Number(v)];
        for (width, height) in [(20.0, 15.0), (60.0, 50.0)] {
            let [width, height] = size(width, height);
            self.add("resize", &[gray.clone(), width, height])?;
        }
        let [width, none] = size(20.0, 0.0);
        self.fail("resize", &[gray.clone(), width, none])?;
        let half = self.add("pyramidDown", &[gray.clone(), text("replicate")])?;
        let [width, height] = size(41.0, 30.0);
        self.add("pyramidUp", &[half, width, height])?;
        let levels = Value::Number(4.0);
        self.add("gaussianPyramid", &[gray.clone(), levels.clone()])?;
        let bands = self.add("laplacianPyramid", &[gray.clone(), levels])?;
        self.add("fromLaplacianPyramid", &[bands])?;
        self.fail("fromLaplacianPyramid", &[Value::List(Vec::new())])?;
        self.add("sharpness", &[gray])?;
        Ok(())
    }

    pub(super) fn add_windows(&mut self) -> Result<(), Failure> {
        let gray = texture(96, 64, 0);
        let response = self.add("harrisResponse", &[gray.clone(), Value::Number(0.05)])?;
        let (radius, threshold) = (Value::Number(3.0), Value::Number(0.01));
        self.add("nonMaximumSuppression", &[response, radius, threshold])?;
        let (u, v) = (Value::Number(21.0), Value::Number(25.0));
        let tensor = self.add("windowTensor", &[gray.clone(), u.clone(), v.clone()])?;
        self.add("windowHarris", &[tensor, Value::Number(0.05)])?;
        let gradients = Value::Doubles(vec![4.0, 0.0, 0.0, 3.0, 2.0, 2.0]);
        self.add("windowTensorFromGradients", &[gradients])?;
        let (half, reach) = (Value::Number(3.0), Value::Number(2.0));
        self.add(
            "shiftSurface",
            &[gray.clone(), u, v.clone(), half.clone(), reach.clone()],
        )?;
        let far = Value::Number(96.0);
        self.fail("shiftSurface", &[gray, far, v, half, reach])
    }

    pub(super) fn add_features(&mut self) -> Result<(), Failure> {
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
                let described = [first.clone(), get(&features1, "keypoints")];
                self.add("describeSift", &described)?;
                let [image, keypoints] = described;
                let (size, spacing) = (Value::Number(8.0), Value::Number(1.5));
                self.add("describePatches", &[image, keypoints, size, spacing])?;
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

    pub(super) fn add_stereo(&mut self, exact: &Value) -> Result<(), Failure> {
        let (left, right) = (texture(96, 64, 0), texture(96, 64, 6));
        let few_disparities = record([("numDisparities", Value::Number(16.0))]);
        self.add(
            "stereoBm",
            &[left.clone(), right.clone(), few_disparities.clone()],
        )?;
        let found = self.add(
            "stereoSgm",
            &[left.clone(), right.clone(), few_disparities.clone()],
        )?;
        self.add(
            "stereoSgm",
            &[floats(&left), floats(&right), few_disparities],
        )?;
        let (size, range) = (Value::Number(20.0), Value::Number(1.0));
        let clean = self.add("removeSpeckles", &[found, size, range])?;
        self.add("fillGaps", &[clean.clone(), left.clone()])?;
        self.fail("fillGaps", &[clean.clone(), floats(&left)])?;
        let (focal, baseline) = (Value::Number(500.0), Value::Number(0.1));
        let (cu, cv) = (Value::Number(47.5), Value::Number(31.5));
        self.add("qFromRig", &[focal.clone(), baseline.clone(), cu, cv])?;
        self.add(
            "depthImage",
            &[clean.clone(), focal.clone(), baseline.clone()],
        )?;
        self.add(
            "depthFromDisparity",
            &[focal.clone(), baseline.clone(), Value::Number(12.5)],
        )?;
        for error in [0.5, 13.0] {
            let arguments = [focal.clone(), baseline.clone()].into_iter();
            let arguments = arguments.chain([12.5, error].map(Value::Number));
            self.add("depthInterval", &arguments.collect::<Vec<_>>())?;
        }
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
            let mut arguments = vec![image1, image2];
            arguments.extend(rig.clone());
            self.add("rectifyImages", &arguments)?;
        }
        let (pixels1, pixels2) = (get(exact, "pixels1"), get(exact, "pixels2"));
        let (camera1, camera2) = cameras(exact);
        let f = self.add("fundamentalFromCameras", &[camera1, camera2])?;
        let (width, height) = (Value::Number(640.0), Value::Number(480.0));
        self.add("rectifyUncalibrated", &[f, pixels1, pixels2, width, height])?;
        Ok(())
    }
}
