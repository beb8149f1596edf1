//! What a reader brings: photographs, of a board while that step is open, projects, videos, links.

use super::host::{Arrival, Host};
use super::work::{Errand, Work};
use crate::project::{Event, Given, Project, Step};
use crate::tasks::{Blob, Request, Source};

/// Takes what has come.
pub(super) fn take(arrival: Arrival, project: &mut Project, work: &mut Work, host: &mut impl Host) {
    match arrival {
        Arrival::Photographs(files) => photographs(project, files),
        Arrival::Project(archive) => work.run(Errand::Open, &Request::Open { archive }, host),
        Arrival::Link(parameters) => {
            let problems = project.open_link(&parameters);
            if !problems.is_empty() {
                work.news = Some(problems.join(" "));
            }
        }
        Arrival::Video(video) => {
            let count = project.document().settings.num_frames;
            host.ask_for_frames(video, count);
        }
        Arrival::Frames(video, name, parts) => {
            let request = Request::Frames { name, parts };
            work.run(Errand::Frames(video), &request, host);
        }
        Arrival::News(sentence) => work.news = Some(sentence),
    }
}

/// Takes photographs, which take the place of a sample.
pub(super) fn photographs(project: &mut Project, files: Vec<(String, Blob)>) {
    let is_sample = |photo: &Given| matches!(photo.source, Source::Rendered(..));
    let document = project.document();
    if project.view().step == Step::Calibrate {
        if document.boards.iter().all(is_sample) {
            project.update(Event::ClearBoards);
        }
        project.update(Event::AddBoards(files));
        return;
    }
    if document.photos.iter().all(is_sample) {
        project.update(Event::Clear);
    }
    project.update(Event::Add(files));
    project.update(Event::Show(Step::Photographs));
}
