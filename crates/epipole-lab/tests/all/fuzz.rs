//! Any sequence of actions leaves the project valid, and undo restores everything.

use crate::common::output;
use epipole_lab::project::{
    Anchor, Blob, CloudPoint, ControlPoint, CropBox, DensePixel, LensCamera, LensModel, Mask,
    Measure, PointSet, Project, Sample, Settings, Shape, ShapeKind, Step,
};
use epipole_lab::session::Event;
use epipole_lab::tasks::OpenProject;
use proptest::prelude::*;

fn length() -> impl Strategy<Value = Option<f64>> {
    prop_oneof![
        Just(None),
        any::<f64>().prop_map(Some),
        (0.1..10.0).prop_map(Some)
    ]
}

fn lens_camera() -> impl Strategy<Value = LensCamera> {
    let numbers = prop::collection::vec(any::<f64>(), 5);
    (any::<[f64; 4]>(), numbers).prop_map(|(k, coefficients)| LensCamera {
        size: (640, 480),
        k,
        lens: LensModel::Brown,
        coefficients,
    })
}

fn settings() -> impl Strategy<Value = Settings> {
    (
        any::<f64>(),
        any::<u32>(),
        any::<f32>(),
        any::<f64>(),
        any::<u32>(),
    )
        .prop_map(|(megapixels, features, ratio, error, enough)| {
            let mut settings = Settings {
                max_megapixels: megapixels,
                ..Settings::default()
            };
            settings.features.max_features = features;
            settings.features.contrast = ratio;
            settings.matching.ratio = ratio;
            settings.pairs.max_error_px = error;
            settings.sfm.min_num_inliers = enough;
            settings.calibration.board.columns = features;
            settings.calibration.board.rows = enough;
            settings.calibration.square_m = error;
            settings.all_views.max_megapixels = megapixels;
            settings.depth.range_px =
                (features % 2 == 0).then_some([features as i32, enough as i32]);
            settings
        })
}

fn crop() -> impl Strategy<Value = CropBox> {
    (any::<[f64; 3]>(), prop::bool::ANY).prop_map(|(low, is_rotation)| CropBox {
        of: 1,
        component: 0,
        origin: [0.0; 3],
        rotation: [0.0, 0.0, 0.0, f64::from(u8::from(is_rotation))],
        low,
        high: low.map(|x| x + 1.0),
    })
}

fn points() -> impl Strategy<Value = PointSet> {
    (0..14_u32, 0..3_u64, 0..99_u32).prop_map(|(photo, cloud, index)| PointSet {
        keypoints: vec![(photo, Mask::of([index]))],
        clouds: vec![(cloud, Mask::of([index]))],
    })
}

fn event() -> impl Strategy<Value = Event> {
    let id = 0..14_u32;
    let pixel = || {
        let pixel = (0..14_u32, 0..9_u32, 0..9_u32);
        pixel.prop_map(|(second, u, v)| DensePixel { second, at: [u, v] })
    };
    let anchor = move || {
        let point = (0..3_u64, 0..9_u32);
        let point = point.prop_map(|(cloud, index)| CloudPoint { cloud, index });
        let anchor = (
            0..14_u32,
            0..9_u32,
            prop::option::of(pixel()),
            prop::option::of(point),
        );
        anchor.prop_map(|(photo, keypoint, pixel, cloud)| Anchor {
            photo,
            keypoint,
            pixel,
            cloud,
        })
    };
    prop_oneof![
        ("[a/.é ]{0,4}", prop::collection::vec(any::<u8>(), 0..6))
            .prop_map(|(name, bytes)| Event::Add(vec![(name, Blob::from(bytes))])),
        ("[a/.é ]{0,4}", prop::collection::vec(any::<u8>(), 0..6))
            .prop_map(|(name, bytes)| Event::Begin(vec![(name, Blob::from(bytes))])),
        prop::option::of([anchor(), anchor(), anchor()]).prop_map(Event::Floor),
        (0..Sample::ALL.len()).prop_map(|n| Event::OpenSample(Sample::ALL[n])),
        id.clone().prop_map(Event::Remove),
        Just(Event::Clear),
        ("[a/.é ]{0,4}", prop::collection::vec(any::<u8>(), 0..6))
            .prop_map(|(name, bytes)| Event::AddBoards(vec![(name, Blob::from(bytes))])),
        Just(Event::OpenBoards),
        Just(Event::ClearBoards),
        prop::option::of(lens_camera()).prop_map(Event::UseCamera),
        any::<bool>().prop_map(Event::AllViews),
        prop::option::of(crop()).prop_map(Event::Crop),
        points().prop_map(Event::Delete),
        Just(Event::Restore),
        (id.clone(), any::<bool>()).prop_map(|(id, out)| Event::Exclude(id, out)),
        (id.clone(), length()).prop_map(|(id, f)| Event::Focal(vec![id], f)),
        id.clone().prop_map(Event::Earlier),
        settings().prop_map(Event::Set),
        (anchor(), anchor(), length()).prop_map(|(a, b, length_m)| Event::Measure(Measure {
            ends: [a, b],
            length_m
        })),
        (0..4_usize, length()).prop_map(|(n, m)| Event::Length(n, m)),
        (0..4_usize).prop_map(Event::Forget),
        (0..4_usize, prop::collection::vec(anchor(), 0..5)).prop_map(|(n, points)| {
            let kinds = [
                ShapeKind::Angle,
                ShapeKind::Area,
                ShapeKind::Volume,
                ShapeKind::VolumeOverFloor,
            ];
            let kind = kinds[n];
            Event::MeasureShape(Shape { kind, points })
        }),
        (0..4_usize).prop_map(Event::ForgetShape),
        (anchor(), "[a/.é\n ]{0,4}").prop_map(|(point, name)| {
            Event::AddControl(ControlPoint {
                point,
                name,
                position_m: None,
            })
        }),
        (0..4_usize, "[a/.é\n ]{0,4}", length()).prop_map(|(n, name, x)| Event::ChangeControl(
            n,
            name,
            x.map(|x| [x, 0.0, x])
        )),
        (0..4_usize).prop_map(Event::ForgetControl),
        (id.clone(), id.clone(), any::<bool>())
            .prop_map(|(a, b, is_part)| Event::Dense(a, b, is_part)),
        Just(Event::Undo),
        Just(Event::Redo),
        (0..9_usize).prop_map(|n| Event::Show(Step::ALL[n])),
        id.clone().prop_map(Event::Look),
        (id.clone(), id).prop_map(|(a, b)| Event::LookAtPair(a, b)),
        any::<usize>().prop_map(Event::LookAtComponent),
        any::<bool>().prop_map(Event::Pause),
        Just(Event::TryAgain),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn events_in_any_order(events in prop::collection::vec(event(), 0..40)) {
        let mut project = Project::default();
        for event in events {
            project.update(event);
            let document = project.document();
            let names: std::collections::BTreeSet<_> = document.photos.iter().map(|p| &p.name).collect();
            prop_assert_eq!(names.len(), document.photos.len());
            prop_assert_eq!(document.settings.clone().checked(), document.settings.clone());
            prop_assert!(!project.describe().is_empty());
            prop_assert!(!project.describe().contains("NaN"));
            for photo in &document.photos {
                prop_assert!(!project.outcome_words(photo).is_empty());
            }
            for photo in &document.boards {
                prop_assert!(!project.board_words(photo).is_empty());
            }
            let names: std::collections::BTreeSet<_> = document.boards.iter().map(|p| &p.name).collect();
            prop_assert_eq!(names.len(), document.boards.len());
            for pending in project.pending() {
                prop_assert!(pending.request(&project).is_some());
            }
        }
        let last = project.document().clone();
        let mut undone = 0;
        while project.can_undo() {
            project.update(Event::Undo);
            undone += 1;
        }
        let document = project.document();
        prop_assert!(document.photos.is_empty() && document.boards.is_empty() || undone >= 200);
        for _ in 0..undone {
            project.update(Event::Redo);
        }
        prop_assert_eq!(project.document(), &last);
    }

    #[test]
    fn what_is_saved_opens_as_the_same(events in prop::collection::vec(event(), 0..30)) {
        let mut project = Project::default();
        for event in events {
            project.update(event);
        }
        let archive = output(project.save_request()).map_err(TestCaseError::fail)?;
        let opened = output(OpenProject { archive }).map_err(TestCaseError::fail)?;
        let mut again = Project::default();
        again.update(Event::OpenProject(Box::new(opened.project), opened.files));
        let (a, b) = (project.document(), again.document());
        prop_assert_eq!(&a.settings, &b.settings);
        prop_assert_eq!(a.measures.len(), b.measures.len());
        prop_assert_eq!(a.shapes.len(), b.shapes.len());
        prop_assert_eq!(a.control_points.len(), b.control_points.len());
        let plain = |p: &epipole_lab::project::InputPhoto| (p.name.clone(), p.source.clone(), p.excluded, p.focal_px);
        let photos = |d: &epipole_lab::project::Document| d.photos.iter().map(plain).collect::<Vec<_>>();
        prop_assert_eq!(photos(a), photos(b));
        let boards = |d: &epipole_lab::project::Document| d.boards.iter().map(plain).collect::<Vec<_>>();
        prop_assert_eq!(boards(a), boards(b));
        prop_assert_eq!(a.dense.len(), b.dense.len());
    }

    #[test]
    fn bytes_that_are_no_request_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        // Random bytes give an answer or an error message.
        let result = epipole_lab::tasks::compute(&bytes, &mut |_| std::ops::ControlFlow::Continue(()));
        if let Err(sentence) = result {
            prop_assert!(!sentence.is_empty());
        }
        let mut project = Project::default();
        project.update(Event::OpenSample(Sample::Alone));
        let pending = project.pending()[0];
        project.done(&pending, Ok(bytes));
        prop_assert!(!project.describe().is_empty());
    }
}
