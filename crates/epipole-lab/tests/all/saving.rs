//! A project that is saved, and opened again.

use crate::common::{png, reopened};
use epipole_lab::project::{Project, RefineFocal, Sample, Source};
use epipole_lab::session::Event;

#[test]
fn a_saved_project_comes_back() {
    let mut project = Project::default();
    project.update(Event::OpenSample(Sample::Alone));
    let file = png(40, 30);
    project.update(Event::Add(vec![("my photo.png".to_owned(), file.clone())]));
    let mut settings = project.document().settings.clone();
    settings.refine_focal = RefineFocal::Never;
    settings.matching.ratio = 0.7;
    project.update(Event::Set(settings));
    let id = project.document().photos[1].id;
    project.update(Event::Focal(vec![id], Some(55.0)));
    project.update(Event::Exclude(id, true));

    let again = reopened(&project);
    assert_eq!(again.document().settings, project.document().settings);
    let same = |project: &Project| -> Vec<(String, Source, bool, Option<f64>)> {
        let photos = project.document().photos.iter();
        photos
            .map(|p| (p.name.clone(), p.source.clone(), p.excluded, p.focal_px))
            .collect()
    };
    assert_eq!(same(&again), same(&project));
    assert_eq!(again.document().photos[1].source, Source::File(file));
}
