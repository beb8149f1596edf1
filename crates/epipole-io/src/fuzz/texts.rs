//! Cameras, trajectories, matches and points.

use crate::camera::{CameraFormat, read_cameras, read_q};
use crate::damage::{config, damage_bytes, some_damage};
use crate::matches::{read_matches, read_points, read_points_with_pixels};
use crate::trajectory::read_trajectory;
use proptest::prelude::*;

const OPENCV: &str = "%YAML:1.0\n---\nimage_width: 640\nimage_height: 480\nM1: !!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n   \
    data: [ 500., 0., 320., 0., 501., 240., 0., 0., 1. ]\nD1: [ 0.1, 0.2, 0., 0. ]\nM2: [500,0,320,0,501,240,0,0,1]\nD2: [ 0.1, 0.2, 0., 0. ]\n\
    R: [1,0,0,0,1,0,0,0,1]\nT: [-0.1, 0., 0.]\n";
const ROS: &str = "image_width: 640\nimage_height: 480\ncamera_name: a\ncamera_matrix:\n  rows: 3\n  cols: 3\n  \
    data: [414.3, 0, 304.8, 0, 414.1, 240.5, 0, 0, 1]\ndistortion_model: rational_polynomial\ndistortion_coefficients:\n  data: [1, 2, 3, 4, 5, 6, 7, 8]\n";
const KALIBR: &str = "cam0: {camera_model: pinhole, intrinsics: [1,1,1,1], distortion_model: radtan, distortion_coeffs: [0,0,0,0], resolution: [752, 480]}\n\
    cam1:\n  camera_model: pinhole\n  intrinsics: [1,1,1,1]\n  distortion_model: equidistant\n  distortion_coeffs: [0,0,0,0]\n  resolution: [752, 480]\n  \
    T_cn_cnm1:\n  - [1, 0, 0, 1]\n  - [0, 1, 0, 0]\n  - [0, 0, 1, 0]\n  - [0, 0, 0, 1]\n";
const Q: &str = "%YAML:1.0\n---\nQ: !!opencv-matrix\n   rows: 4\n   cols: 4\n   dt: d\n   \
    data: [1, 0, 0, -319.5, 0, 1, 0, -239.5, 0, 0, 0, 700, 0, 0, 8.5, 0.25]\n";
const COLMAP: &str = "# cameras\n1 SIMPLE_RADIAL 640 480 500 320 240 0.1\n2 FULL_OPENCV 640 480 500 500 320 240 1 2 3 4 5 6 7 8\n";
const NERF: &str = r#"{"camera_angle_x": 0.69, "w": 800, "h": 600, "k1": 0.1, "frames": [{"file_path": "a", "fl_x": 500.5}]}"#;
const METASHAPE: &str = "<?xml version=\"1.0\"?>\n<document><chunk><sensors>\n<sensor id=\"0\" label=\"a &amp; b\"><resolution width=\"640\" height=\"480\"/>\
    <calibration type=\"frame\"><f>500</f><cx>1</cx><k1>0.1</k1><b1>0.5</b1></calibration></sensor></sensors></chunk></document>";
const OPENCV_XML: &str = "<?xml version=\"1.0\"?>\n<opencv_storage><image_width>640</image_width><image_height>480</image_height>\
    <K type_id=\"opencv-matrix\"><data>\n500. 0. 320. 0. 500. 240. 0. 0. 1.</data></K></opencv_storage>";
const MATLAB: &str = r#"{"CameraParameters1": {"RadialDistortion": [0.1, 0.2], "K": [[1,0,1],[0,1,1],[0,0,1]], "ImageSize": [480, 640]},
    "CameraParameters2": {"RadialDistortion": [0.1, 0.2], "IntrinsicMatrix": [[1,0,0],[0,1,0],[1,1,1]], "ImageSize": [480, 640]},
    "RotationOfCamera2": [[1,0,0],[0,1,0],[0,0,1]], "TranslationOfCamera2": [1, 2, 3]}"#;
const EPIPOLE: &str = r#"{ "image": { "width": 640, "height": 480 }, "k": [ 532.8 , 532.9 , 342.5 , 233.9 ],
    "distortion": { "model": "brown", "coefficients": [ -0.28 , 0.03 , 0.001 , -0.0001 , 0.1 ] },
    "right": { "image": { "width": 640, "height": 480 }, "k": [ 530 , 531 , 320 , 240 ],
    "distortion": { "model": "fisheye", "coefficients": [ 0.1 , 0 , 0 , 0 ] } },
    "stereo": { "right_from_left": { "rotation": [ 1 , 0 , 0 , 0 , 1 , 0 , 0 , 0 , 1 ], "translation": [ -0.1 , 0.01 , 2e-3 ] } } }"#;

const KITTI: &str = "P0: 718.8 0 607.1 0 0 718.8 185.2 0 0 0 1 0\nK_01: 984 0 690 0 980 233 0 0 1\nD_01: 0.1 0 0 0 0\n\
    S_01: 1392 512\nR_01: 1 0 0 0 1 0 0 0 1\nT_01: -0.5 0 0\n";
const MIDDLEBURY: &str = "cam0=[3997.684 0 1176.728; 0 3997.684 1011.728; 0 0 1]\n\
    cam1=[3997.684 0 1307.839; 0 3997.684 1011.728; 0 0 1]\nbaseline=193.001\nwidth=2964\nheight=1988\n";
const ORB_SLAM: &str = "%YAML:1.0\nCamera.type: \"PinHole\"\nCamera1.fx: 500\nCamera1.fy: 500\nCamera1.cx: 320\nCamera1.cy: 240\n\
    Camera1.k1: 0.1\nCamera.width: 640\nCamera.height: 480\nCamera2.fx: 500\nCamera2.fy: 500\nCamera2.cx: 320\nCamera2.cy: 240\n\
    Stereo.T_c1_c2: [1, 0, 0, 0.1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]\n";
const FLAT: &str = r#"{"width": 640, "height": 480, "fx": 615, "fy": 615, "ppx": 320, "ppy": 240, "coeffs": [0.1, 0, 0, 0, 0]}"#;

const CAMERAS: [(CameraFormat, &str); 12] = [
    (CameraFormat::OpenCv, OPENCV),
    (CameraFormat::Ros, ROS),
    (CameraFormat::Kalibr, KALIBR),
    (CameraFormat::Colmap, COLMAP),
    (CameraFormat::NerfStudio, NERF),
    (CameraFormat::Metashape, METASHAPE),
    (CameraFormat::OpenCv, OPENCV_XML),
    (CameraFormat::Matlab, MATLAB),
    (CameraFormat::Epipole, EPIPOLE),
    (CameraFormat::Middlebury, MIDDLEBURY),
    (CameraFormat::Flat, ORB_SLAM),
    (CameraFormat::Flat, FLAT),
];

const TRAJECTORIES: [&str; 5] = [
    "# t tx ty tz qx qy qz qw\n1305031102.175304 1.5 0 -2e-3 0 0 0 1\n1305031102.2 1 2 3 0.1 0.2 0.3 0.9\n",
    "1 0 0 0.5 0 1 0 1e-3 0 0 1 2\n0 -1 0 0.5 1 0 0 1e-3 0 0 1 2\n",
    "num,t,x,y,z,qw,qx,qy,qz,vx\n1,0.5,1,2,3,0.8,0,0,0.6,9\n2,1.5,1,2,3,0.8,0,0,0.6,9\n",
    "1403636579763555584.000000 1 2 3 0 0 0.6 0.8\n1403636579813555456.000000 1 2 3 0 0 0.6 0.8\n",
    "#timestamp,x,y,z,w,x,y,z\r\n1403636580838555648,4.6,-1.7,0.7,0.5,-0.1,-0.8,-0.08,1,2\r\n1403636580838555649,4.6,-1.7,0.7,0.5,-0.1,-0.8,-0.08,1,2\r\n",
];

const MATCHES: [&str; 5] = [
    "# u1 v1 u2 v2\n1 2 3 4\n1e2, -2.5, 3 , 4 # and more\n\n10 20 30.25 40 7\n",
    "id;u;v;x;y;z\n7;1,5;2;3;4;5\r\n8;1;2;3;4;-5e-1\n9;\"1\";'2';3;4;5\n",
    "[1 2] [3 4] 5.5\n[[10, 20], [30, 40]] 5D+01\n(1, 2) (3, 4) 7\n",
    "[[1, 2, 3, 4, 5], [[1, 2], [3, 4.5], 6],\n [1e2, -2.5, 3, 4, 7]]",
    "[{\"u1\": 1, \"v1\": 2, \"U2\": 3, \"v2\": 4}, {\"u1\": 1, \"v1\": 2, \"U2\": 3, \"v2\": 4.5, \"z\": null}]",
];

/// Returns COLMAP's binary file of one `SIMPLE_PINHOLE` camera.
fn colmap_binary() -> Vec<u8> {
    let mut bytes = 1_u64.to_le_bytes().to_vec();
    bytes.extend(1_u32.to_le_bytes());
    bytes.extend(0_i32.to_le_bytes());
    bytes.extend([640_u64, 480].iter().flat_map(|side| side.to_le_bytes()));
    bytes.extend(
        [500.0_f64, 320.0, 240.0]
            .iter()
            .flat_map(|x| x.to_le_bytes()),
    );
    bytes
}

fn check_cameras(bytes: &[u8]) {
    match read_q(bytes) {
        Ok(q) => assert!(q.iter().all(|entry| entry.is_finite())),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    match read_cameras(bytes, Some((640, 480))) {
        Ok((_, cameras)) => {
            assert!(!cameras.cameras.is_empty());
            for named in &cameras.cameras {
                let camera = &named.camera;
                assert!(camera.width > 0 && camera.height > 0);
                assert!(camera.intrinsics.matrix().iter().all(|x| x.is_finite()));
                assert!(camera.lens.coefficients().iter().all(|x| x.is_finite()));
            }
            let motion = cameras.right_from_left.unwrap_or_default();
            assert!(motion.to_homogeneous().iter().all(|x| x.is_finite()));
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

fn check_trajectory(bytes: &[u8]) {
    match read_trajectory(bytes) {
        Ok((_, path)) => {
            let poses = &path.world_from_cam;
            assert!(!poses.is_empty());
            assert!(
                poses
                    .iter()
                    .all(|pose| pose.to_homogeneous().iter().all(|x| x.is_finite()))
            );
            if let Some(stamps) = path.stamps_ns {
                assert_eq!(stamps.len(), poses.len());
                assert!(stamps.is_sorted());
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

fn check_matches(bytes: &[u8]) {
    let has_message = |error: &crate::Error| !error.to_string().is_empty();
    match read_matches(bytes) {
        Ok([first, second]) => {
            assert_eq!(first.len(), second.len());
            let mut all = first.iter().chain(&second);
            assert!(all.all(|p| !p.x.is_nan() && !p.y.is_nan()));
        }
        Err(error) => assert!(has_message(&error)),
    }
    match read_points_with_pixels(bytes) {
        Ok((pixels, points)) => {
            assert_eq!(pixels.len(), points.len());
            assert!(points.iter().all(|p| !p.iter().any(|x| x.is_nan())));
        }
        Err(error) => assert!(has_message(&error)),
    }
    if let Err(error) = read_points(bytes) {
        assert!(has_message(&error));
    }
}

#[test]
fn the_files_to_damage_are_right() {
    assert!(read_q(Q.as_bytes()).is_ok());
    for (format, text) in CAMERAS {
        assert_eq!(read_cameras(text.as_bytes(), None).unwrap().0, format);
    }
    let (format, _) = read_cameras(KITTI.as_bytes(), Some((1241, 376))).unwrap();
    assert_eq!(format, CameraFormat::Kitti);
    let (format, cameras) = read_cameras(&colmap_binary(), None).unwrap();
    assert_eq!(format, CameraFormat::Colmap);
    assert_eq!(
        cameras.cameras[0].camera.intrinsics.principal_point().x,
        319.5
    );
    for n in [0, 2] {
        assert_eq!(read_matches(MATCHES[n].as_bytes()).unwrap()[0].len(), 3);
    }
    let (pixels, _) = read_points_with_pixels(MATCHES[1].as_bytes()).unwrap();
    assert_eq!(pixels.len(), 3);
    for text in TRAJECTORIES {
        assert_eq!(
            read_trajectory(text.as_bytes())
                .unwrap()
                .1
                .world_from_cam
                .len(),
            2
        );
    }
}

/// Half a megabyte of one pattern each takes 15 ms, but minutes in quadratic time.
#[test]
fn long_files_take_no_quadratic_time() {
    let patterns = [
        "[",
        "{",
        "- ",
        "? ",
        "a: ",
        "&a ",
        "!a ",
        "<a>",
        "<a b=''>",
        "\n",
        "#",
        "\"",
        "'",
        "a: 1\n",
        "a, ",
        "[a, ",
        "{a: ",
        "%",
        "---\n",
        "...\n",
        "*a ",
        "|\n",
        ">\n ",
        "&amp;",
        "a b=\"\" ",
        "1 ",
        "cam0: ",
        "-\n ",
    ];
    let check = |pattern: &str| {
        for before in ["", "K: [", "{\"K\": [", "<a ", "<a>", "a: \"", "K: {"] {
            let text = format!("{before}{}", pattern.repeat((1 << 19) / pattern.len()));
            check_cameras(text.as_bytes());
            check_trajectory(text.as_bytes());
            check_matches(text.as_bytes());
        }
    };
    std::thread::scope(|scope| {
        for some in patterns.chunks(patterns.len() / 4) {
            scope.spawn(move || some.iter().copied().for_each(check));
        }
    });
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn damaged_cameras(which in 0..CAMERAS.len(), changes in some_damage()) {
        check_cameras(&damage_bytes(CAMERAS[which].1.as_bytes(), &changes));
        check_cameras(&damage_bytes(Q.as_bytes(), &changes));
        check_cameras(&damage_bytes(KITTI.as_bytes(), &changes));
    }

    #[test]
    fn damaged_binary_cameras(changes in some_damage()) {
        check_cameras(&damage_bytes(&colmap_binary(), &changes));
    }

    #[test]
    fn damaged_trajectories(which in 0..TRAJECTORIES.len(), changes in some_damage()) {
        check_trajectory(&damage_bytes(TRAJECTORIES[which].as_bytes(), &changes));
    }

    #[test]
    fn damaged_matches(which in 0..MATCHES.len(), changes in some_damage()) {
        check_matches(&damage_bytes(MATCHES[which].as_bytes(), &changes));
    }

    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..2000)) {
        check_cameras(&bytes);
        check_trajectory(&bytes);
        check_matches(&bytes);
    }

    #[test]
    fn random_signs(text in "[\\[\\]{}:,\\-?&*!|>'\"%@`#<>/= \n\t0-9a-eK.]{0,200}") {
        check_cameras(text.as_bytes());
        check_trajectory(text.as_bytes());
        check_matches(text.as_bytes());
    }
}
