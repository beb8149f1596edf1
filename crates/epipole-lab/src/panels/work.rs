//! Running jobs: as many as the host allows, and only those still needed.

use super::host::{Host, Report, WorkId};
use super::intake;
use super::keeping::Keeping;
use super::videos::Videos;
use crate::project::{About, Event, Project, Task, count};
use crate::tasks::{Answer, Blob, Request};
use std::collections::VecDeque;

/// Work beside the project's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Errand {
    /// A zip file of the reconstruction.
    Export,
    /// A zip file of the project.
    Save,
    /// The same, to be kept where the Lab runs.
    Keep,
    /// A project to open.
    Open,
    /// The project that was kept.
    Reopen,
    /// The sharpest frame of a part of the video of this number.
    Frames(u32),
    /// The space as a PNG file.
    View,
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum What {
    Task(Task),
    Errand(Errand),
}

struct Running {
    id: WorkId,
    what: What,
    share: f32,
    words: String,
}

/// Bytes decoded and encoded between two frames, plus those of one photograph: a few milliseconds.
const MAX_BYTES: usize = 4_000_000;

/// All work that is under way.
#[derive(Default)]
pub(super) struct Work {
    running: Vec<Running>,
    /// Reports waiting for the next frame.
    told: VecDeque<Report>,
    last: WorkId,
    /// The revision of the project whose tasks were checked last.
    seen: Option<u64>,
    /// Message from the last errand.
    pub(super) news: Option<String>,
    /// Videos that frames are taken from.
    pub(super) videos: Videos,
    /// Keeping of the project.
    pub(super) keeping: Keeping,
    /// Whether the results of the sample are still to arrive.
    pub(super) waits_for_sample: bool,
}

impl Work {
    /// No running jobs; `waits_for_sample` if the sample comes solved.
    pub(super) fn new(waits_for_sample: bool) -> Self {
        Self {
            waits_for_sample,
            ..Self::default()
        }
    }

    /// Takes reports, cancels jobs that are no longer needed, and starts new ones. Larger amounts
    /// of work wait for the next frame.
    pub(super) fn go_on(&mut self, project: &mut Project, host: &mut impl Host) {
        let mut num_bytes = 0;
        self.told.extend(host.reports());
        while num_bytes < MAX_BYTES
            && let Some(report) = self.told.pop_front()
        {
            num_bytes += report.num_bytes();
            self.hear(report, project, host);
        }
        if self.seen == Some(project.revision()) {
            return;
        }
        self.seen = Some(project.revision());
        let waits =
            self.waits_for_sample && project.document().photos.iter().all(intake::is_sample);
        let wanted = match self.is_opening() || waits {
            // Another project, or precomputed results, are about to arrive.
            true => Vec::new(),
            false => project.wanted(),
        };
        self.running.retain(|running| match &running.what {
            What::Errand(_) => true,
            What::Task(task) => {
                let keep = wanted.iter().any(|other| other.key == task.key);
                if !keep {
                    host.cancel(running.id);
                }
                keep
            }
        });
        for task in wanted {
            if self.running.len() >= host.capacity() {
                break;
            }
            if num_bytes >= MAX_BYTES {
                self.seen = None;
                break;
            }
            let under_way = |running: &Running| matches!(&running.what, What::Task(other) if other.key == task.key);
            if self.running.iter().any(under_way) {
                continue;
            }
            if let Some(request) = project.request(&task) {
                num_bytes += self.start(What::Task(task), &request, host);
            }
        }
    }

    /// Whether there is something to do between two frames at once.
    pub(super) fn is_waiting(&self) -> bool {
        !self.told.is_empty() || self.seen.is_none()
    }

    /// Returns how many bytes went out.
    fn start(&mut self, what: What, request: &Request, host: &mut impl Host) -> usize {
        self.last += 1;
        self.running.push(Running {
            id: self.last,
            what,
            share: 0.0,
            words: String::new(),
        });
        let bytes = request.to_bytes();
        let num_bytes = bytes.len();
        host.start(self.last, request.branch(), bytes);
        num_bytes
    }

    /// Starts an errand, unless one of its kind is under way.
    pub(super) fn run(&mut self, errand: Errand, request: &Request, host: &mut impl Host) {
        if !self.runs(errand) {
            self.news = None;
            self.keeping.is_back = false;
            self.start_errand(errand, request, host);
        }
    }

    /// Starts an errand in the background.
    pub(super) fn start_errand(&mut self, errand: Errand, request: &Request, host: &mut impl Host) {
        self.start(What::Errand(errand), request, host);
    }

    /// Whether the errand is running.
    pub(super) fn runs(&self, errand: Errand) -> bool {
        let what = What::Errand(errand);
        self.running.iter().any(|running| running.what == what)
    }

    /// Whether another project is about to replace this one.
    pub(super) fn is_opening(&self) -> bool {
        self.runs(Errand::Open) || self.runs(Errand::Reopen)
    }

    fn hear(&mut self, report: Report, project: &mut Project, host: &mut impl Host) {
        match report {
            Report::Progress(id, share, words) => {
                if let Some(running) = self.running.iter_mut().find(|running| running.id == id) {
                    running.share = share;
                    running.words = words;
                }
            }
            Report::SoFar(id, bytes) => {
                let of_task = |running: &Running| match &running.what {
                    What::Task(task) if running.id == id => Some(task.key),
                    _ => None,
                };
                if let Some(key) = self.running.iter().find_map(of_task) {
                    project.so_far(key, &bytes);
                }
            }
            Report::Done(id, result) => match self.ended(id) {
                Some(What::Task(task)) => project.done(task.key, result),
                Some(What::Errand(errand)) => self.end_errand(errand, result, project, host),
                None => {}
            },
            Report::Broken(id, sentence) => match self.ended(id) {
                Some(What::Task(task)) => project.broke_down(task.key, sentence),
                Some(What::Errand(errand)) => {
                    self.end_errand(errand, Err(sentence), project, host);
                }
                None => {}
            },
        }
    }

    /// Removes a finished job; returns its subject if it was still running.
    fn ended(&mut self, id: WorkId) -> Option<What> {
        let place = self.running.iter().position(|running| running.id == id)?;
        self.seen = None;
        Some(self.running.remove(place).what)
    }

    fn end_errand(
        &mut self,
        errand: Errand,
        result: Result<Vec<u8>, String>,
        project: &mut Project,
        host: &mut impl Host,
    ) {
        match errand {
            Errand::Frames(video) => self.frames(video, result, project, host),
            Errand::Keep => self.written(answer_of(result), host),
            Errand::Reopen => self.reopened(answer_of(result), project),
            _ => {
                self.keeping.is_back = false;
                self.news = Some(finish(errand, result, project, host));
            }
        }
    }

    /// Requests the next part of a video, or adds the frames of all parts.
    fn frames(
        &mut self,
        video: u32,
        result: Result<Vec<u8>, String>,
        project: &mut Project,
        host: &mut impl Host,
    ) {
        let frames = match answer_of(result) {
            Ok(Answer::Frames(frames)) => frames,
            Ok(_) => Vec::new(),
            Err(sentence) => {
                self.videos.give_up(video, host);
                self.news = Some(sentence);
                return;
            }
        };
        let Some(chosen) = self.videos.take(video, frames, host) else {
            return;
        };
        if chosen.is_empty() {
            self.news = Some("No frame of the video can be read.".to_owned());
            return;
        }
        let verb = if chosen.len() == 1 { "was" } else { "were" };
        let frames = count(chosen.len(), "frame");
        self.news = Some(format!("{frames} {verb} taken from the video."));
        intake::photographs(project, chosen);
    }

    pub(super) fn is_busy(&self) -> bool {
        !self.running.is_empty() || self.is_waiting()
    }

    /// Description of the running jobs, with the progress of the longest.
    pub(super) fn words(&self, project: &Project) -> Option<(String, f32)> {
        let Some(first) = self.running.first() else {
            return Some((self.videos.words()?, 0.0));
        };
        let name = |id| project.document().photo(id).map_or("", |photo| &photo.name);
        let mut words = match &first.what {
            What::Task(task) => match task.about {
                About::Photograph(id) => format!("Reading {}", name(id)),
                About::Features(id) => format!("Finding features in {}", name(id)),
                About::Matches(..) => "Matching pairs".to_owned(),
                About::TwoViews(..) => "Verifying pairs".to_owned(),
                About::Reconstruction => "Reconstructing".to_owned(),
                About::Depth(..) => "Computing depth".to_owned(),
                About::Board(id) => {
                    let board = project.document().board(id);
                    format!(
                        "Looking for the board in {}",
                        board.map_or("", |photo| &photo.name)
                    )
                }
                About::Calibration => "Calibrating".to_owned(),
            },
            What::Errand(Errand::Export | Errand::Save | Errand::View) => {
                "Writing the file".to_owned()
            }
            What::Errand(Errand::Frames(_)) => {
                let words = self.videos.words();
                words.unwrap_or_else(|| "Reading the video".to_owned())
            }
            What::Errand(Errand::Keep) => "Keeping the project".to_owned(),
            What::Errand(Errand::Open | Errand::Reopen) => "Opening the project".to_owned(),
        };
        if !first.words.is_empty() {
            words.push_str(&format!(": {}", first.words));
        }
        Some((words, first.share))
    }
}

fn answer_of(result: Result<Vec<u8>, String>) -> Result<Answer, String> {
    result.and_then(|bytes| Answer::from_bytes(&bytes))
}

/// Handles the result of an errand; returns the message to show.
fn finish(
    errand: Errand,
    result: Result<Vec<u8>, String>,
    project: &mut Project,
    host: &mut impl Host,
) -> String {
    let answer = answer_of(result);
    let mut save = |name: &str, bytes: Blob| match host.save(name, bytes.to_vec()) {
        Ok(sentence) | Err(sentence) => sentence,
    };
    match (errand, answer) {
        (_, Err(sentence)) => sentence,
        (Errand::Export, Ok(Answer::Archive(bytes))) => save("reconstruction.zip", bytes),
        (Errand::Save, Ok(Answer::Archive(bytes))) => save("project.zip", bytes),
        (
            Errand::Open,
            Ok(Answer::Opened {
                project: saved,
                files,
                computed,
            }),
        ) => {
            project.update(Event::OpenProject(Box::new(saved), files));
            project.bring(computed);
            "The project is open.".to_owned()
        }
        (Errand::View, Ok(Answer::Archive(bytes))) => save("view.png", bytes),
        (_, Ok(_)) => "an unexpected answer arrived".to_owned(),
    }
}
