//! `epipole compare`: errors of trajectories, against evo.

use crate::common::{Folder, fails, json, path};
use serde_json::Value;

const TRUTH: &str = "\
100.0 0.0 0.0 0.0 0.0 0.0 0.099833 0.995004\n\
100.1 0.5 0.564642 0.1 0.024948 0.041987 0.099794 0.993809\n\
100.2 1.0 0.932039 0.4 0.049879 0.045355 0.099757 0.992725\n\
100.3 1.5 0.973848 0.9 0.074804 0.007038 0.099739 0.992173\n\
100.4 2.0 0.675463 0.3 0.099643 -0.037705 0.099643 0.989303\n\
100.5 2.5 0.14112 1.2 0.124419 -0.047723 0.099535 0.986071\n\
100.6 3.0 -0.44252 1.0 0.149184 -0.013895 0.099456 0.983697\n\
100.7 3.5 -0.871576 1.0 0.173786 0.032621 0.099306 0.97922\n\
100.8 4.0 -0.996165 1.2 0.198256 0.049037 0.099128 0.973891\n\
100.9 4.5 -0.772764 0.3 0.222718 0.020397 0.098986 0.96963\n\
101.0 5.0 -0.279415 0.9 0.246959 -0.02687 0.098784 0.963603\n\
101.1 5.5 0.311541 0.4 0.270979 -0.049268 0.098538 0.95626\n\
";
/// Scaled by 0.4, moved, with noise; the fourth pose is missing.
const ESTIMATE: &str = "\
99.999198 0.973513 1.995033 3.008409 0.011343 0.001095 0.094331 0.995476\n\
100.099215 1.214975 2.258553 3.045455 0.012636 0.032412 0.115717 0.992673\n\
100.200203 1.365357 2.371142 3.136735 0.043618 0.040502 0.092678 0.993915\n\
100.400553 1.798738 2.258397 3.128193 0.107863 -0.054052 0.097041 0.987941\n\
100.499019 1.996537 2.03066 3.480414 0.124079 -0.050768 0.089131 0.986956\n\
100.599604 2.178173 1.795888 3.404496 0.138195 -0.002256 0.106617 0.984647\n\
100.698002 2.405443 1.629335 3.400661 0.174255 0.012878 0.097008 0.979826\n\
100.799744 2.61924 1.577905 3.494761 0.187557 0.0458 0.090891 0.976967\n\
100.901449 2.811364 1.739529 3.132838 0.230961 0.028703 0.092933 0.968089\n\
100.99993 3.027008 1.880303 3.363776 0.246796 -0.020856 0.095197 0.964155\n\
101.099848 3.204848 2.126677 3.142701 0.279608 -0.062019 0.086641 0.954184\n\
";

fn check(found: &Value, expected: [f64; 7], within: f64, what: &str) {
    let names = ["rmse", "mean", "median", "std", "min", "max", "sse"];
    for (name, expected) in names.iter().zip(expected) {
        let found = found[name].as_f64().unwrap();
        assert!(
            (found - expected).abs() < within,
            "{what} {name}: {found}, not {expected}"
        );
    }
}

/// Numbers of evo 1.38: `evo_ape tum` and `evo_rpe tum` with `-r trans_part` and `angle_deg`.
#[test]
fn errors_are_those_of_evo() {
    let folder = Folder::new("compare");
    let truth = folder.write("truth.txt", TRUTH);
    let estimate = folder.write("estimate.txt", ESTIMATE);
    let run = |align| json(&["compare", path(&truth), path(&estimate), "--align", align]);
    let axes = [
        2.7686808464087598,
        2.649307766997022,
        2.602259584605659,
        0.8042151360177061,
        1.048367357679964,
        3.984038740941879,
        76.65593629270727,
    ];
    for (align, scale, ape, ape_deg, rpe) in [
        (
            "none",
            1.0,
            [
                3.5888661678672276,
                3.5721054877393654,
                3.635351990260503,
                0.34644300443840953,
                3.004018045113079,
                4.145850792369282,
                141.679564079482,
            ],
            [
                1.8115789030338698,
                1.7357457777525154,
                1.6296999278421667,
                0.5186566464740576,
                0.8051329876441062,
                2.5575205149563875,
                36.09999934109139,
            ],
            [
                0.5233230860914544,
                0.5106848614516751,
                0.5177859554242138,
                0.11431546142305977,
                0.3136710338180909,
                0.696632294783801,
                2.738670524362837,
            ],
        ),
        (
            "se3",
            1.0,
            [
                1.138151752121544,
                1.0435471292450549,
                1.0987023619918224,
                0.4543113468776072,
                0.32012381516339716,
                1.7342783525983114,
                14.24928351943075,
            ],
            [
                2.0652999827719585,
                1.9869474324337355,
                1.9838143774099926,
                0.5634748615358426,
                1.0046328367188195,
                2.9208787591710377,
                46.92010420721637,
            ],
            [
                0.5233230860914544,
                0.5106848614516751,
                0.5177859554242139,
                0.11431546142305983,
                0.3136710338180909,
                0.6966322947838016,
                2.7386705243628375,
            ],
        ),
        (
            "sim3",
            2.4587465553148347,
            [
                0.07226487440784811,
                0.06418611641683301,
                0.053111254665904904,
                0.03320172484234548,
                0.02846155372588601,
                0.1351505080964348,
                0.057444332805002656,
            ],
            [
                2.0652999827719585,
                1.9869474324337355,
                1.9838143774099926,
                0.5634748615358426,
                1.0046328367188195,
                2.9208787591710377,
                46.92010420721637,
            ],
            [
                0.11458029795354524,
                0.09938688839979111,
                0.08282631479534405,
                0.057016586124834526,
                0.03776231009640478,
                0.20607068324517305,
                0.13128644679123203,
            ],
        ),
    ] {
        let found = run(align);
        assert_eq!(
            (&found["num_pairs"], &found["associated_by"]),
            (&11.into(), &"time".into())
        );
        assert!((found["scale"].as_f64().unwrap() - scale).abs() < 1e-12);
        check(&found["ape"]["translation_m"], ape, 1e-9, align);
        check(&found["ape"]["rotation_deg"], ape_deg, 1e-4, align);
        check(&found["rpe"]["translation_m"], rpe, 1e-9, align);
        check(&found["rpe"]["rotation_deg"], axes, 1e-4, align);
        assert_eq!(found["ate_rmse_m"], found["ape"]["translation_m"]["rmse"]);
        assert_eq!(found["rpe_rmse"], found["rpe"]["translation_m"]["rmse"]);
    }
}

#[test]
fn the_plot_shows_both_paths_and_the_error() {
    let folder = Folder::new("compare-plot");
    let truth = folder.write("a & b.txt", TRUTH);
    let estimate = folder.write("estimate.txt", ESTIMATE);
    let plot = folder.file("plot.svg");
    let with = ["--align", "sim3", "--plot", path(&plot)];
    json(&[&["compare", path(&truth), path(&estimate)], &with[..]].concat());
    let svg = std::fs::read_to_string(&plot).unwrap();
    assert!(svg.contains("true: a &amp; b.txt") && svg.contains("mean square, 0.072265 m"));
    // Both paths, the mean and the error; the line of the mean has two ends.
    let lines: Vec<usize> = (svg.split("points=\"").skip(1))
        .map(|line| line.split('"').next().unwrap().split(' ').count())
        .collect();
    assert_eq!(lines, [11, 11, 2, 11]);
    let picture = folder.file("plot.png");
    let arguments = [
        "compare",
        path(&truth),
        path(&estimate),
        "--plot",
        path(&picture),
    ];
    fails(&folder, &arguments, 2, "must end in .svg");
}

#[test]
fn formats_mix_and_causes_are_named() {
    let folder = Folder::new("compare-formats");
    let line = |i: i32| format!("1 0 0 {i} 0 1 0 {} 0 0 1 0\n", i * i);
    let kitti: String = (0..6).map(line).collect();
    let kitti = folder.write("kitti.txt", &kitti);
    let tum: String = (0..6)
        .map(|i| format!("{i} {i} {} 0 0 0 0 1\n", i * i))
        .collect();
    let tum = folder.write("tum.txt", &tum);
    let [kitti, tum] = [&kitti, &tum].map(|file| path(file));
    let same = json(&["compare", kitti, tum]);
    assert_eq!(
        (&same["associated_by"], &same["num_pairs"]),
        (&"index".into(), &6.into())
    );
    assert_eq!(same["formats"], serde_json::json!(["KITTI", "TUM"]));
    assert!(same["ate_rmse_m"].as_f64().unwrap() < 1e-12);
    let later = folder.write("later.txt", "100 0 0 0 0 0 0 1\n101 1 0 0 0 0 0 1\n");
    let line: String = (0..6).map(|i| format!("{i} {i} 0 0 0 0 0 1\n")).collect();
    let straight = folder.write("straight.txt", &line);
    for (second, message) in [
        (path(&later), "no two poses are within 0.01 s"),
        (path(&straight), "--align none compares without"),
    ] {
        fails(&folder, &["compare", tum, second], 1, message);
    }
    let both = ["compare", tum, path(&later), "--by-index"];
    fails(&folder, &both, 1, "there are 6 and 2");
    let backwards = folder.write("backwards.txt", "2 0 0 0 0 0 0 1\n1 0 0 0 0 0 0 1\n");
    fails(
        &folder,
        &["compare", tum, path(&backwards)],
        1,
        "line 2: time goes backwards",
    );
}

#[test]
fn images_of_models_are_compared_by_their_names() {
    let folder = Folder::new("compare-models");
    let cameras = "1 PINHOLE 640 480 500 500 320 240\n";
    let model = |name: &str, images: &[(&str, [f64; 3])]| {
        let at = folder.file(name);
        std::fs::create_dir_all(&at).unwrap();
        folder.write(&format!("{name}/cameras.txt"), cameras);
        let lines = images.iter().enumerate().map(|(n, (name, [x, y, z]))| {
            format!("{} 1 0 0 0 {} {} {} 1 {name}\n\n", n + 1, -x, -y, -z)
        });
        folder.write(&format!("{name}/images.txt"), &lines.collect::<String>());
        at
    };
    let places = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.2],
        [2.0, 1.0, 0.0],
        [2.0, 3.0, 1.0],
    ];
    let truth = model(
        "truth",
        &["a2.jpg", "a10.jpg", "b c.jpg", "d.jpg"]
            .into_iter()
            .zip(places)
            .collect::<Vec<_>>(),
    );
    // In another order, twice as large, moved, without one, in a folder.
    let moved = |n: usize| places[n].map(|x| 2.0 * x + 1.0);
    let estimate = model(
        "estimate",
        &[
            ("x/d.png", moved(3)),
            ("x/a10.png", moved(1)),
            ("x/a2.png", moved(0)),
        ],
    );
    let binary = folder.file("binary");
    json(&[
        "convert",
        path(&estimate),
        path(&binary),
        "--to",
        "colmap-binary",
    ]);
    for second in [
        path(&estimate),
        path(&binary),
        path(&binary.join("images.bin")),
    ] {
        let result = json(&["compare", path(&truth), second, "--align", "sim3"]);
        assert_eq!(result["associated_by"], "name");
        assert_eq!(
            (&result["num_pairs"], &result["num_poses"][0]),
            (&3.into(), &4.into())
        );
        assert!((result["scale"].as_f64().unwrap() - 0.5).abs() < 1e-9);
        assert!(result["ate_rmse_m"].as_f64().unwrap() < 1e-9);
    }
    // Against a trajectory of as many poses, in the natural order of names.
    let kitti = folder.file("path.kitti");
    json(&["convert", path(&truth), path(&kitti), "--to", "kitti"]);
    let result = json(&["compare", path(&truth), path(&kitti)]);
    assert_eq!(result["associated_by"], "index");
    assert!(result["ate_rmse_m"].as_f64().unwrap() < 1e-9);
    let other = model("other", &[("z.jpg", places[0])]);
    let arguments = ["compare", path(&truth), path(&other)];
    fails(&folder, &arguments, 1, "no image has the name of another");
}
