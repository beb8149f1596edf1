//! Events of the host: videos, the solved sample, and failed workers.

use crate::common::desk::{Bench, click, open, rest};
use egui_kittest::kittest::Queryable;
use epipole_lab::project::Sample;
use epipole_lab::session::HostEvent;

#[test]
fn a_video_gives_its_sharpest_frames() {
    let mut bench = open(1280.0, 720.0);
    click(&mut bench, "Photographs");
    click(&mut bench, "Take photographs…");
    assert_eq!(bench.state_mut().host().asked, 1);
    let bring = |bench: &mut Bench<'_>, host_event| {
        bench.state_mut().host().host_events.push(host_event);
        bench.run_steps(2);
        rest(bench);
    };
    let mut settings = bench.state().project().document().settings.clone();
    settings.num_frames = 3;
    let link = vec![("frames".to_owned(), "3".to_owned())];
    bring(&mut bench, HostEvent::Link(link));
    assert_eq!(bench.state().project().document().settings, settings);
    // One video after the other, and of each one part after the other.
    bring(&mut bench, HostEvent::Video(3));
    bring(&mut bench, HostEvent::Video(4));
    assert_eq!(bench.state_mut().host().frames, [(3, 0, 3)]);
    let picture = |blur: f32| -> epipole_lab::project::Blob {
        let sharp = image::RgbImage::from_fn(60, 40, |u, v| {
            image::Rgb([if (u / 7 + v / 5) % 2 == 0 { 20 } else { 230 }; 3])
        });
        let mut bytes = std::io::Cursor::new(Vec::new());
        let blurred = image::imageops::blur(&sharp, blur);
        blurred
            .write_to(&mut bytes, image::ImageFormat::Png)
            .unwrap();
        bytes.into_inner().into()
    };
    let [soft, sharp] = [picture(3.0), picture(0.5)];
    let frames = |bench: &mut Bench<'_>, video, frames: Vec<_>| {
        bring(
            bench,
            HostEvent::Frames(video, "walk.mp4".to_owned(), frames),
        );
    };
    frames(&mut bench, 3, vec![soft.clone(), sharp.clone()]);
    assert_eq!(bench.state_mut().host().frames[1..], [(3, 1, 3)]);
    // Frames that were not requested are ignored.
    frames(&mut bench, 4, vec![sharp.clone()]);
    frames(&mut bench, 3, vec![vec![1_u8, 2, 3].into()]);
    assert_eq!(
        bench.state().project().document().photos.len(),
        9,
        "the sample is still there"
    );
    frames(&mut bench, 3, vec![sharp.clone(), soft]);
    let photos = &bench.state().project().document().photos;
    let names: Vec<&str> = photos.iter().map(|photo| photo.name.as_str()).collect();
    assert_eq!(names, ["walk-01.jpg", "walk-03.jpg"]);
    let source = epipole_lab::project::Source::File(sharp);
    assert!(photos.iter().all(|photo| photo.source == source));
    let said = bench.state_mut().host().said.clone();
    assert!(
        said.contains("2 frames were taken from the video."),
        "{said}"
    );
    // Then the next video is read, and fails.
    assert_eq!(bench.state_mut().host().frames[2..], [(3, 2, 3), (4, 0, 3)]);
    let refused = "walk.mp4 cannot be decoded here.".to_owned();
    bring(&mut bench, HostEvent::NoFrames(4, refused.clone()));
    let said = bench.state_mut().host().said.clone();
    assert!(said.contains(&refused), "{said}");
    assert_eq!(bench.state().project().document().photos.len(), 2);
}

#[test]
fn what_broke_down_is_told_and_tried_again() {
    let mut bench = open(1280.0, 720.0);
    let said = |bench: &mut Bench<'_>| bench.state_mut().host().said.clone();
    let step = |bench: &mut Bench<'_>, name| {
        click(bench, name);
        rest(bench);
    };
    bench.state_mut().host().breaks = true;
    step(&mut bench, "Features");
    step(&mut bench, "SIFT");
    step(&mut bench, "Photographs");
    let words = said(&mut bench);
    assert!(words.contains("there is not enough memory"), "{words}");
    assert_eq!(bench.state().project().document().photos.len(), 9);
    bench.state_mut().host().breaks = false;
    step(&mut bench, "Try again");
    step(&mut bench, "Reconstruction");
    let words = said(&mut bench);
    assert!(
        words.contains("9 of 9 photographs have a camera"),
        "{words}"
    );
    assert!(bench.query_by_label("Try again").is_none());
}

#[test]
fn the_sample_comes_solved_or_is_computed_where_it_does_not_come() {
    let computed = crate::common::solved(Sample::Table)
        .light_computed()
        .to_bytes();
    // Only photographs are rendered, or there is more to do.
    for (bytes, is_solved) in [(computed, true), (Vec::new(), false)] {
        let mut bench = crate::common::desk::open_with(
            crate::common::desk::Desk {
                brings_sample: true,
                ..Default::default()
            },
            1280.0,
            720.0,
        );
        assert_eq!(bench.state_mut().host().num_started, 0, "it waits");
        assert!(bench.get_all_by_label("Reconstructing.").next().is_some());
        let host_event = HostEvent::Results(bytes.into());
        bench.state_mut().host().host_events.push(host_event);
        rest(&mut bench);
        bench.get_by_label("9 of 9");
        let started = bench.state_mut().host().num_started;
        assert_eq!(started == 9, is_solved, "{started}");
        // Another sample is computed as ever.
        click(&mut bench, "Samples");
        click(&mut bench, Sample::Alone.title());
        rest(&mut bench);
        assert!(bench.state_mut().host().num_started > started);
    }
}
