//! Bundle adjustment problems, pose graphs and disparities.

use crate::Error;
use crate::bundle::{read_bal, write_bal};
use crate::damage::{config, damage_bytes, damage_text, some_damage};
use crate::disparity::{read_pfm, write_pfm};
use crate::pose_graph::{read_g2o, write_g2o};
use epipole::optim::{LmOptions, RobustLoss};
use epipole::sfm::{PoseGraph, adjust_bal};
use epipole::stereo::DisparityImage;
use proptest::prelude::*;

const BAL: [&str; 2] = [
    "1 1 1\n0 0 11 20\n0 0 0 0 0 0 100 0 0\n1 2 -10\n",
    "2 3 5\n0 0 -3.3e1 2.6e2\n0 1 8 9\n1 0 1 -2\n1 1 7.5 0\n1 2 -4 4\n\
     1e-2 -2e-3 3e-3 0.1 0.2 -1 400 -1e-7 2e-13\n-0.01 0 0 0.5 0 -1 380 0 0\n\
     0.1 0.2 -5\n-1 0.4 -6\n0.3 -0.2 -4\n",
];

const G2O: [&str; 6] = [
    "VERTEX_SE2 5 0 0 0\nVERTEX_SE2 9 1.5 0 0.25\nFIX 5\nEDGE_SE2 5 9 1 0 0 4 0.5 0 3 0 2\n",
    "# two\n\nVERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_SE3:QUAT 1 1 2 3 0 0 0 -2\n\
     EDGE_SE3:QUAT 0 1 1 2 3 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n",
    "VERTEX_SIM3:QUAT 0 0 0 0 0 0 0 1 1\nVERTEX_SIM3:QUAT 1 1 0 0 0 0 0 1 2\n\
     EDGE_SIM3:QUAT 0 1 1 0 0 0 0 0 1 2 1 0 0 0 0 0 0 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n",
    "VERTEX_SE2 0 0 0 0\nVERTEX_SE2 1 1 0 0\nVERTEX_XY 2 4 4\nEDGE_SE2 0 1 1 0 0 1 0 0 1 0 1\n\
     EDGE_SE2_XY 0 2 4 4 1 0 1\nEDGE_PRIOR_SE2 0 1 2 3 1 0 0 1 0 1\nEDGE_PRIOR_SE2_XY 1 5 5 4 0 4\n",
    "PARAMS_SE3OFFSET 3 0.5 0 0 0 0.6 0 0.8\nVERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n\
     EDGE_SE3_PRIOR 0 3 1 2 3 0 0 0 1 1 0 0 0 0 0 1 0 0 0 0 1 0 0 0 1 0 0 1 0 1\n\
     EDGE_SE3_XYZ_PRIOR 0 3 1 2 3 1 0 0 1 0 1\n",
    "PARAMS_SE3OFFSET 3 0.5 0 0 0 0.6 0 0.8\nVERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\nVERTEX_TRACKXYZ 1 4 -5 6\n\
     EDGE_SE3_TRACKXYZ 0 1 3 0.1 0.2 0.3 2 0.5 0.25 3 1 5\n",
];

/// Returns whether the error names a line of the text.
fn has_message(error: &Error, text: &str) -> bool {
    match error {
        Error::Malformed { line, .. } => {
            line.is_some_and(|line| line >= 1 && line <= text.lines().count().max(1) + 1)
        }
        Error::Invalid(epipole::Error::TooFew { .. }) => true,
        _ => false,
    }
}

#[test]
fn the_texts_to_damage_are_right() {
    assert!(BAL.iter().all(|text| read_bal(text).is_ok()));
    assert!(G2O.iter().all(|text| read_g2o(text).is_ok()));
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn bal(which in 0..BAL.len(), changes in some_damage()) {
        let text = damage_text(BAL[which], &changes);
        match read_bal(&text) {
            Ok(mut problem) => {
                prop_assert_eq!(&read_bal(&write_bal(&problem)).unwrap(), &problem);
                let options = LmOptions::default().with_max_iterations(3);
                let solved = adjust_bal(&mut problem, &options, RobustLoss::Trivial, &mut ());
                if solved.is_ok() {
                    // The output can be read again, so all numbers are finite.
                    prop_assert!(read_bal(&write_bal(&problem)).is_ok());
                }
            }
            Err(error) => prop_assert!(has_message(&error, &text), "{} of {:?}", error, text),
        }
    }

    #[test]
    fn g2o(which in 0..G2O.len(), changes in some_damage()) {
        let text = damage_text(G2O[which], &changes);
        match read_g2o(&text) {
            Ok(read) => {
                let mut graph = read.graph;
                let size = |graph: &PoseGraph| (graph.size(), graph.num_priors());
                let again = read_g2o(&write_g2o(&graph));
                prop_assert_eq!(again.map(|again| size(&again.graph)), Ok(size(&graph)));
                let options = LmOptions::default().with_max_iterations(3);
                if graph.optimize(&options, RobustLoss::Trivial, &mut ()).is_ok() {
                    prop_assert!(read_g2o(&write_g2o(&graph)).is_ok());
                }
            }
            Err(error) => prop_assert!(has_message(&error, &text), "{} of {:?}", error, text),
        }
    }

    #[test]
    fn pfm(width in 0..5_u32, height in 0..4_u32, changes in some_damage()) {
        let values: Vec<f32> = (0..width * height).map(|i| i as f32 * 0.75 - 1.0).collect();
        let right = write_pfm(&DisparityImage::from_raw(width, height, values).unwrap());
        prop_assert!(read_pfm(&right).is_ok());
        match read_pfm(&damage_bytes(&right, &changes)) {
            Ok(read) => {
                prop_assert!(read.as_raw().iter().all(|d| d.is_finite() || d.is_nan()));
                let again = read_pfm(&write_pfm(&read)).unwrap();
                let bits = |image: &DisparityImage| image.as_raw().iter().map(|d| if d.is_nan() { 0 } else { d.to_bits() }).collect::<Vec<_>>();
                prop_assert_eq!(bits(&again), bits(&read));
            }
            Err(error) => prop_assert!(matches!(error, Error::Malformed { .. }), "{}", error),
        }
    }
}
