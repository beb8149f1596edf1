//! A worked example of each number, and messages for errors.

use super::*;

fn printed(call: &str) -> Result<String, String> {
    let mut words = call.split_whitespace();
    let name = words.next().unwrap();
    let settings: Vec<(String, String)> = words
        .map(|word| word.split_once('=').unwrap())
        .map(|(key, value)| (key.to_owned(), value.to_owned()))
        .collect();
    print(name, &settings)
}

/// The worked examples of the book. Each can be checked by hand.
#[test]
fn worked_numbers() {
    let pair = "f=500 cu=320 cv=240 tx=-0.2 ty=0 tz=-0.5";
    let matched = format!("{pair} u=400 v=300 u2=362 v2=324 digits=2");
    let corner = "u1=4 v1=0 u2=0 v2=3 u3=2 v3=2";
    let edge = "u1=4 v1=0 u2=5 v2=0 u3=3 v3=0";
    let patch = "a=10 b=30 c=40 d=80";
    let mut used = Vec::new();
    // u′u, u′v, u′, v′u, v′v, v′, u, v, 1
    let row = [
        "11000", "5500", "110", "4800", "2400", "48", "100", "50", "1",
    ];
    for (k, expected) in row.into_iter().enumerate() {
        let call = format!("eight-point.row u=100 v=50 u2=110 v2=48 k={}", k + 1);
        assert_eq!(printed(&call).as_deref(), Ok(expected), "{call}");
    }
    for (call, expected) in [
        // 320 + 500 · 0.1 / 2
        ("camera.project-u f=500 cu=320 x=0.1 z=2", "345.0"),
        // 800 · 0.3 / 1.5 and / 2; (400 − 320) / 800 and (160 − 240) / 800
        ("camera.size-px f=800 h=0.3 z=1.5", "160"),
        ("camera.size-px f=800 h=0.3 z=2", "120"),
        ("camera.ray f=800 c=320 u=400", "0.1"),
        ("camera.ray f=800 c=240 u=160", "-0.1"),
        // 2000 / tan 35°
        ("camera.focal-px width=4000 view=70", "2856"),
        // √8 and √2
        ("rays.sigma a=2 b=2 c=-1 d=1 k=1", "2.83"),
        ("rays.sigma a=2 b=2 c=-1 d=1 k=2", "1.41"),
        // NumPy: h = np.linalg.svd(A)[2][-1], h / h[2]
        ("rays.least-sigma u1=395 u2=295 u3=195", "0.0000"),
        ("rays.least-sigma u1=395 u2=295 u3=196", "0.0007"),
        ("rays.meeting u1=395 u2=295 u3=195 k=1", "0.300"),
        ("rays.meeting u1=395 u2=295 u3=195 k=2", "2.000"),
        ("rays.meeting u1=395 u2=295 u3=196 k=1", "0.301"),
        ("rays.meeting u1=395 u2=295 u3=196 k=2", "2.010"),
        // NumPy: singular values of the rows, raw and after Hartley's normalization.
        ("eight-point.row u=100 v=50 u2=110 v2=48 k=1", "11000"),
        ("eight-point.sigma normalized=0 k=1", "837858.69"),
        ("eight-point.sigma normalized=0 k=8", "12.85"),
        ("eight-point.sigma normalized=1 k=1", "7.79"),
        ("eight-point.sigma normalized=1 k=8 digits=3", "0.394"),
        ("eight-point.sigma normalized=1 k=9 digits=4", "0.0025"),
        ("eight-point.condition normalized=0", "65203"),
        ("eight-point.condition normalized=1 digits=1", "19.8"),
        ("eight-point.distance-px normalized=0", "0.24"),
        ("eight-point.distance-px normalized=1", "0.13"),
        // 320 + 600 / 3, 240 + 600 · 1.5 / 3, and back
        ("planes.floor-u f=600 cu=320 cv=240 h=1.5 x=1 z=3", "520"),
        ("planes.floor-v f=600 cu=320 cv=240 h=1.5 x=1 z=3", "540"),
        (
            "planes.floor-x f=600 cu=320 cv=240 h=1.5 u=420 v=390",
            "1.00",
        ),
        (
            "planes.floor-z f=600 cu=320 cv=240 h=1.5 u=420 v=390",
            "6.00",
        ),
        // 20 · 20 / (10 · 30), and 120 · 75 / (45 · 150)
        ("planes.cross-ratio a=0 b=10 c=20 d=30", "1.333"),
        ("planes.cross-ratio a=540 b=465 c=420 d=390", "1.333"),
        // √(850 · 450 − 150²)
        (
            "planes.focal cu=320 cv=240 u1=1170 v1=90 u2=-130 v2=90",
            "600",
        ),
        // atan(200 / 600); 320 + 600 tan(18.43° − 20°)
        ("planes.angle-deg f=600 cu=320 u=520", "18.4"),
        ("planes.turned-u f=600 cu=320 u=520 deg=20", "303.6"),
        // 600 · 0.2 (1 / 1.5 − 1 / 3)
        ("planes.parallax-px f=600 b=0.2 z=1.5 wall=3", "40"),
        // 1 − 0.2 · 0.25; 320 + 600 · 0.285, 240 + 600 · 0.38
        ("calibration.factor x=0.3 y=0.4 k1=-0.2", "0.950"),
        ("calibration.bent-u x=0.3 y=0.4 k1=-0.2 f=600 cu=320", "491"),
        ("calibration.bent-v x=0.3 y=0.4 k1=-0.2 f=600 cv=240", "468"),
        // 600 tan 60°, 600 · 60 π / 180
        ("calibration.pinhole-px f=600 deg=60", "1039"),
        ("calibration.fisheye-px f=600 deg=60", "628"),
        // 4.25 / 5.6 · 4032
        ("calibration.exif-px mm=4.25 sensor=5.6 width=4032", "3060"),
        // 2 · 1 + 2 · 1; 4 · 4 + 2 · 4, 3 · 3 + 2 · 4
        // NumPy: np.linalg.solve([[20, 4], [4, 13]], [24, 17])
        ("tracking.change u=2 v=2 du=1 dv=1", "-4"),
        (
            "tracking.right-u u1=4 v1=0 u2=0 v2=3 u3=2 v3=2 du=1 dv=1",
            "24",
        ),
        (
            "tracking.right-v u1=4 v1=0 u2=0 v2=3 u3=2 v3=2 du=1 dv=1",
            "17",
        ),
        (
            "tracking.found-u u1=4 v1=0 u2=0 v2=3 u3=2 v3=2 du=1 dv=1",
            "1.0",
        ),
        (
            "tracking.found-v u1=4 v1=0 u2=0 v2=3 u3=2 v3=2 du=1 dv=1",
            "1.0",
        ),
        // 600 tan 1°; 24 / 8; 0.05 √900
        ("tracking.turned-px f=600 deg=1", "10.5"),
        ("tracking.level-px px=24 level=3", "3.0"),
        ("tracking.levels px=20 reach=3", "4"),
        ("tracking.levels px=3 reach=3", "1"),
        ("tracking.drift-px sigma=0.05 steps=900", "1.5"),
        // (140 − 40) / 2, (120 − 60) / 2; √(50² + 30²); atan(30 / 50)
        ("gradients.slope before=40 after=140 digits=0", "50"),
        ("gradients.slope before=60 after=120", "30.0"),
        ("gradients.magnitude du=50 dv=30", "58.31"),
        ("gradients.angle-deg du=50 dv=30", "30.96"),
        // 50 cos 90° + 30 sin 90°; 120.96° is a right angle away from 30.96°
        ("gradients.along du=50 dv=30 angle=90", "30.00"),
        ("gradients.along du=50 dv=30 angle=120.96", "0.00"),
        // 60 + 2 · 100 + 115, 5 + 2 · 60 + 60; an eighth of them; √(2 · 6), √12 / 8
        ("gradients.sobel axis=1", "375"),
        ("gradients.sobel axis=2", "185"),
        ("gradients.sobel-slope axis=1", "46.88"),
        ("gradients.sobel-slope axis=2 digits=3", "23.125"),
        ("gradients.sobel-noise divisor=1 digits=3", "3.464"),
        ("gradients.sobel-noise divisor=8 digits=3", "0.433"),
        // NumPy: x = np.arange(-r, r + 1), g = exp(−x²/2σ²) / Σ, d = x g / Σ x² g, r = 8 and 16;
        // Σ d ramp, and 20 √(Σ g² Σ d²)
        ("gradients.noise sigma=0 noise=20", "14.14"),
        ("gradients.noise sigma=2 noise=20 digits=3", "0.998"),
        ("gradients.noise sigma=4 noise=20 digits=3", "0.250"),
        ("gradients.edge-slope sigma=0", "20.00"),
        ("gradients.edge-slope sigma=2 digits=3", "17.495"),
        ("gradients.edge-slope sigma=4 digits=3", "10.987"),
        // 17.495 / 0.99774
        ("gradients.ratio sigma=2 noise=20", "17.5"),
        ("gradients.kernel-size sigma=2", "17"),
        ("gradients.multiplications sigma=2 passes=1", "289"),
        ("gradients.multiplications sigma=2 passes=2", "34"),
        // √(25 + 4); 0.587 · 255, 0.114 · 255
        ("gradients.root-of-squares a=5 b=2", "5.4"),
        ("gradients.gray r=0 g=255 b=0", "150"),
        ("gradients.gray r=0 g=0 b=255", "29"),
        // 4² + 0² + 2², 0² + 3² + 2², 4·0 + 0·3 + 2·2; 20 · 13 − 4²; 244 − 0.04 · 33²
        (&format!("corners.a {corner}"), "20"),
        (&format!("corners.b {corner}"), "13"),
        (&format!("corners.c {corner}"), "4"),
        (&format!("corners.det {corner}"), "244"),
        (&format!("corners.trace {corner}"), "33"),
        (&format!("corners.harris {corner} k=0.04"), "200.44"),
        // 16.5 ± √(3.5² + 4²)
        (&format!("corners.lambda1 {corner}"), "21.82"),
        (&format!("corners.lambda2 {corner}"), "11.18"),
        // 20 · 1 + 2 · 4 · (−1) + 13 · 1
        (&format!("corners.change {corner} du=1 dv=-1"), "25"),
        // 4² + 5² + 3²; 0 − 0.04 · 50²
        (&format!("corners.a {edge}"), "50"),
        (&format!("corners.b {edge}"), "0"),
        (&format!("corners.det {edge}"), "0"),
        (&format!("corners.harris {edge} k=0.04"), "-100.00"),
        (&format!("corners.change {edge} du=0 dv=1"), "0"),
        // 22.96: 22.96 / 23.96² = 0.0400; 14.60 / 15.60² = 0.0600; 2.618 / 3.618² = 0.2000
        ("corners.ratio-limit k=0.04", "22.96"),
        ("corners.ratio-limit k=0.06 digits=1", "14.6"),
        ("corners.ratio-limit k=0.2 digits=3", "2.618"),
        // 1 − 0.1 + √0.8 over 0.1
        ("corners.ratio-limit k=0.05", "17.94"),
        // (3, 0), (0, 1), (0, 2): A = 9, B = 5, C = 0; 45 − 0.04 · 14²
        (
            "corners.harris u1=3 v1=0 u2=0 v2=1 u3=0 v3=2 k=0.04",
            "37.16",
        ),
        // OpenCV's corner.cpp: 2^(3 − 1) · block · 255
        ("corners.opencv-divisor block=2", "2040"),
        ("corners.opencv-divisor block=3", "3060"),
        // √(4 · 60²); √(10² + 30² + 40² + 80²); √(30² + 20² + 40² + 50²); √(70² + 10² + 10² + 70²)
        (
            &format!("matching.patch-distance {patch} e=70 f=90 g=100 h=140 normalized=0"),
            "120.0",
        ),
        (
            &format!("matching.patch-distance {patch} e=20 f=60 g=80 h=160 normalized=0"),
            "94.9",
        ),
        (
            &format!("matching.patch-distance {patch} e=40 f=10 g=80 h=30 normalized=0"),
            "73.5",
        ),
        (
            &format!("matching.patch-distance {patch} e=80 f=40 g=30 h=10 normalized=0"),
            "100.0",
        ),
        // NumPy: p = (p - p.mean()) / np.linalg.norm(p - p.mean())
        (
            &format!("matching.patch-distance {patch} e=70 f=90 g=100 h=140 normalized=1 digits=2"),
            "0.00",
        ),
        (
            &format!("matching.patch-distance {patch} e=40 f=10 g=80 h=30 normalized=1 digits=2"),
            "1.44",
        ),
        (
            &format!("matching.patch-distance {patch} e=80 f=40 g=30 h=10 normalized=1 digits=2"),
            "1.96",
        ),
        // 0.18 / 0.21, 0.12 / 0.40 and 0.24 / 0.32
        ("matching.ratio d1=0.18 d2=0.21", "0.857"),
        ("matching.ratio d1=0.12 d2=0.40", "0.300"),
        ("matching.ratio d1=0.24 d2=0.32", "0.750"),
        // 320 + 500 · (−0.2) / (−0.5), and 240.
        (&format!("epipolar.epipole2-u {pair}"), "520"),
        (&format!("epipolar.epipole2-v {pair}"), "240"),
        // From (400, 300) to (520, 240); from (420, 340) to (520, 240).
        (
            &format!("epipolar.slope {pair} u=400 v=300 digits=1"),
            "-0.5",
        ),
        (
            &format!("epipolar.slope {pair} u=420 v=340 digits=2"),
            "-1.00",
        ),
        // (362 + 2 · 324 − 1000) / √5
        (&format!("epipolar.distance2-px {matched}"), "4.47"),
        // NumPy: |x2ᵀ F x1| / √((Fx1)₁² + (Fx1)₂² + (Fᵀx2)₁² + (Fᵀx2)₂²), F = K⁻ᵀ [t]ₓ K⁻¹
        (&format!("epipolar.sampson-px {matched}"), "2.68"),
        // The table of scikit-image's `dynamic_max_trials`.
        ("ransac.trials s=2 w=0.95 p=0.99", "2"),
        ("ransac.trials s=2 w=0.9 p=0.99", "3"),
        ("ransac.trials s=2 w=0.7 p=0.99", "7"),
        ("ransac.trials s=2 w=0.5 p=0.99", "17"),
        ("ransac.trials s=8 w=0.9 p=0.99", "9"),
        ("ransac.trials s=8 w=0.7 p=0.99", "78"),
        ("ransac.trials s=8 w=0.5 p=0.99", "1177"),
        ("ransac.trials-exact s=2 w=0.5 p=0.99 digits=3", "16.008"),
        // 1 − 0.75¹⁶
        (
            "ransac.confidence-percent s=2 w=0.5 n=16 digits=3",
            "98.998",
        ),
        // COLMAP's test of RANSAC.
        (
            "ransac.trials-without-replacement inliers=10 data=100 s=3 p=0.99",
            "6204",
        ),
        (
            "ransac.trials-without-replacement inliers=50 data=100 s=3 p=0.99",
            "36",
        ),
        // (0, 0, 4) is seen from (1, 0, 0) along (−1, 0, 4), which is (−0.25, 0, 1).
        ("sfm.depth camera=1 turned=0 sign=1 x=-0.25", "4"),
        ("sfm.depth camera=2 turned=0 sign=1 x=-0.25", "4"),
        ("sfm.depth camera=1 turned=0 sign=-1 x=-0.25", "-4"),
        ("sfm.depth camera=2 turned=0 sign=-1 x=-0.25", "-4"),
        // λ1 (0, 0, −1) + (−1, 0, 0) = λ2 (−0.25, 0, 1)
        ("sfm.depth camera=1 turned=1 sign=1 x=-0.25", "-4"),
        ("sfm.depth camera=2 turned=1 sign=1 x=-0.25", "4"),
        ("sfm.depth camera=1 turned=1 sign=-1 x=-0.25", "4"),
        ("sfm.depth camera=2 turned=1 sign=-1 x=-0.25", "-4"),
        // NumPy: 1.01 ** 100
        ("sfm.drift rate=0.01 steps=100 digits=2", "2.70"),
        ("sfm.unknowns cameras=100 points=50000", "150600"),
        // 8 · 150600² bytes
        ("sfm.matrix-gigabytes unknowns=150600 digits=0", "181"),
        ("stereo.disparity left=410 right=380", "30"),
        // 700 · 0.12 = 84
        ("stereo.depth f=700 b=0.12 d=30 digits=2", "2.80"),
        ("stereo.depth f=700 b=0.12 d=60 digits=2", "1.40"),
        ("stereo.depth f=700 b=0.12 d=3 digits=1", "28.0"),
        ("stereo.depth f=700 b=0.12 d=4 digits=1", "21.0"),
        // 100 / 42
        ("stereo.depth-error f=700 b=0.06 z=10 digits=1", "2.4"),
        // d = 20: 500 · 0.1 / 20
        (
            "triangulation.point f=500 b=0.1 u=320 v=240 u2=300 v2=240 axis=3",
            "2.500",
        ),
        (
            "triangulation.point f=500 b=0.1 u=345 v=265 u2=320 v2=265 axis=2",
            "0.100",
        ),
        // NumPy: the midpoint and the DLT as they are defined; angles and pixels by Gauss–Newton.
        ("triangulation.ahead-mm method=1 axis=2", "4.0"),
        ("triangulation.ahead-mm method=4 axis=2", "-1.5"),
        ("triangulation.miss-px method=1 image=1", "1.20"),
        ("triangulation.miss-px method=1 image=2", "6.02"),
        ("triangulation.miss-px method=2 image=2", "6.01"),
        ("triangulation.miss-px method=3 image=1", "2.30"),
        ("triangulation.miss-px method=4 image=2", "0.46"),
        ("triangulation.error-px method=1", "4.34"),
        ("triangulation.error-px method=2 digits=3", "4.334"),
        ("triangulation.error-px method=3 digits=4", "1.6640"),
        ("triangulation.error-px method=4 digits=3", "1.664"),
        // 2 / (500 √2 sin 45°) and 2 / (500 √2 sin 1°) and 2 / (500 √2 cos 1°)
        (
            "triangulation.sigma-mm f=500 r=2 angle=90 sigma=1 axis=1",
            "4.0",
        ),
        (
            "triangulation.sigma-mm f=500 r=2 angle=2 sigma=1 axis=1",
            "162.1",
        ),
        (
            "triangulation.sigma-mm f=500 r=2 angle=2 sigma=1 axis=2",
            "2.8",
        ),
        // √2 · 2² / (500 · 0.4)
        (
            "triangulation.sigma-depth f=500 b=0.4 z=2 sigma=1 digits=3",
            "0.028",
        ),
    ] {
        assert_eq!(printed(call).as_deref(), Ok(expected), "{call}");
        used.push(call.split(' ').next().unwrap().to_owned());
    }
    for entry in registry() {
        assert!(
            used.iter().any(|name| name == entry.name),
            "{} is not pinned",
            entry.name
        );
    }
}

#[test]
fn every_entry_is_pinned_by_name_once() {
    let mut names: Vec<&str> = registry().map(|entry| entry.name).collect();
    names.sort_unstable();
    let count = names.len();
    names.dedup();
    assert_eq!(names.len(), count);
}

#[test]
fn mistakes_are_sentences() {
    for (call, part) in [
        (
            "nosuch",
            "unknown number \"nosuch\"; known numbers: camera.project-u, camera.size-px",
        ),
        (
            "camera.project-u f=1 cu=1 x=1 w=1",
            "has no parameter \"w\"; its parameters: f, cu",
        ),
        ("camera.project-u f=1 cu=1 x=1", "needs z=…"),
        (
            "camera.project-u f=1 cu=1 x=1 z=two",
            "z=two is not a number",
        ),
        (
            "camera.project-u f=1 cu=1 x=1 z=NaN",
            "z=NaN is not a finite number",
        ),
        (
            "camera.project-u f=1 cu=1 x=1 z=-1",
            "not in front of the camera",
        ),
        (
            "camera.project-u f=1 cu=1 x=1 z=1 digits=-1",
            "not a small whole number",
        ),
        ("ransac.trials s=2.5 w=0.5 p=0.99", "s=2.5 is not a count"),
        ("ransac.trials s=2 w=1.5 p=0.99", "the inlier ratio"),
        ("stereo.depth f=700 b=0.12 d=0", "infinitely far away"),
        (
            "epipolar.epipole2-u f=500 cu=320 cv=240 tx=1 ty=0 tz=0",
            "infinitely far away",
        ),
    ] {
        let message = printed(call).unwrap_err();
        assert!(message.contains(part), "{call}: {message}");
    }
}

#[test]
fn minus_zero_has_no_sign() {
    assert_eq!(fixed(-0.0004, 2), "0.00");
    assert_eq!(fixed(-100.0, 0), "-100");
}
