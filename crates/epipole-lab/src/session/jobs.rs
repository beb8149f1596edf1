//! Running jobs: as many as the host allows, and only those still needed.

use super::host::{Host, JobId, Report};
use super::queue::Pending;
use crate::project::{Project, Step};
use crate::tasks::{CameraFormat, Request};
use std::collections::{BTreeSet, VecDeque};

/// Job on a file, not a result of the project.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FileJob {
    /// Write a zip file of the reconstruction.
    SaveReconstruction,
    /// Write a zip file of the project.
    SaveProject,
    /// Write an image of the point cloud.
    SaveView,
    /// Write the project for storage in the browser.
    Store,
    /// Write the calibrated camera for another program.
    SaveCamera(CameraFormat),
    /// Read camera files.
    OpenCameras,
    /// Open a project.
    Open,
    /// Open the stored project.
    Restore,
    /// Choose the sharpest frame of a part of the video of this number.
    Frames(u32),
}

impl FileJob {
    fn label(self) -> &'static str {
        match self {
            Self::SaveReconstruction | Self::SaveProject | Self::SaveView | Self::SaveCamera(_) => {
                "Writing the file"
            }
            Self::OpenCameras => "Reading cameras",
            Self::Store => "Keeping the project",
            Self::Open | Self::Restore => "Opening the project",
            Self::Frames(_) => "Reading the video",
        }
    }
}

#[derive(Debug, Clone, PartialEq, Eq)]
enum Subject {
    /// A result of the project.
    Output(Pending),
    File(FileJob),
}

struct Job {
    id: JobId,
    subject: Subject,
    /// Progress, 0 to 1.
    share: f32,
    stage: String,
}

/// Maximum number of bytes decoded and encoded between two frames, which takes a few milliseconds;
/// one photograph may exceed it.
const MAX_BYTES: usize = 4_000_000;

/// All jobs that are running.
#[derive(Default)]
pub(crate) struct Jobs {
    running: Vec<Job>,
    /// Reports waiting for the next frame.
    reports: VecDeque<Report>,
    last_id: JobId,
    /// Bytes decoded and encoded since the last frame.
    num_bytes: usize,
    /// Revision of the project that was last checked for missing results.
    checked: Option<u64>,
}

impl Jobs {
    /// Takes reports up to the first that ends a file job, and returns its result. Reports beyond
    /// the limit of bytes per frame wait for the next.
    pub(crate) fn receive(
        &mut self,
        project: &mut Project,
        host: &mut impl Host,
    ) -> Option<(FileJob, Result<Vec<u8>, String>)> {
        self.reports.extend(host.reports());
        while self.num_bytes < MAX_BYTES
            && let Some(report) = self.reports.pop_front()
        {
            self.num_bytes += report.num_bytes();
            if let Some(finished) = self.take(report, project) {
                return Some(finished);
            }
        }
        None
    }

    fn take(
        &mut self,
        report: Report,
        project: &mut Project,
    ) -> Option<(FileJob, Result<Vec<u8>, String>)> {
        match report {
            Report::Progress(id, share, stage) => {
                if let Some(job) = self.running.iter_mut().find(|job| job.id == id) {
                    (job.share, job.stage) = (share, stage);
                }
            }
            Report::Partial(id, bytes) => {
                let job = self.running.iter().find(|job| job.id == id)?;
                if let Subject::Output(pending) = &job.subject {
                    project.so_far(pending, &bytes);
                }
            }
            Report::Done(id, result) => match self.ended(id)? {
                Subject::Output(pending) => project.done(&pending, result),
                Subject::File(job) => return Some((job, result)),
            },
            Report::Broken(id, sentence) => match self.ended(id)? {
                Subject::Output(pending) => project.broke_down(&pending, sentence),
                Subject::File(job) => return Some((job, Err(sentence))),
            },
        }
        None
    }

    /// Removes a finished job; returns its subject if it was still running.
    fn ended(&mut self, id: JobId) -> Option<Subject> {
        let place = self.running.iter().position(|job| job.id == id)?;
        self.checked = None;
        Some(self.running.remove(place).subject)
    }

    /// Cancels jobs that are no longer needed, and starts new ones, within the limit of bytes per
    /// frame.
    ///
    /// * `is_held`: whether to start no computation for the project now
    pub(crate) fn schedule(&mut self, project: &Project, host: &mut impl Host, is_held: bool) {
        let mut num_bytes = std::mem::take(&mut self.num_bytes);
        if self.checked == Some(project.revision()) {
            return;
        }
        self.checked = Some(project.revision());
        let all = match is_held {
            true => Vec::new(),
            false => project.pending(),
        };
        self.running.retain(|job| match &job.subject {
            Subject::File(_) => true,
            Subject::Output(pending) => {
                let is_needed = all.iter().any(|other| other.key == pending.key);
                if !is_needed {
                    host.cancel(job.id);
                }
                is_needed
            }
        });
        for pending in all {
            if self.running.len() >= host.capacity() {
                break;
            }
            if num_bytes >= MAX_BYTES {
                self.checked = None;
                break;
            }
            let is_same = |job: &Job| matches!(&job.subject, Subject::Output(other) if other.key == pending.key);
            if self.running.iter().any(is_same) {
                continue;
            }
            if let Some(request) = pending.request(project) {
                num_bytes += self.start(Subject::Output(pending), &request, host);
            }
        }
    }

    /// Starts a job. Returns the number of bytes sent.
    fn start(&mut self, subject: Subject, request: &Request, host: &mut impl Host) -> usize {
        self.last_id += 1;
        self.running.push(Job {
            id: self.last_id,
            subject,
            share: 0.0,
            stage: String::new(),
        });
        let bytes = request.to_bytes();
        let num_bytes = bytes.len();
        host.start(self.last_id, request.branch(), bytes);
        num_bytes
    }

    /// Starts a file job.
    pub(crate) fn start_file(&mut self, job: FileJob, request: &Request, host: &mut impl Host) {
        self.start(Subject::File(job), request, host);
    }

    /// Whether a file job is running.
    pub(crate) fn runs(&self, job: FileJob) -> bool {
        let subject = Subject::File(job);
        self.running
            .iter()
            .any(|running| running.subject == subject)
    }

    /// Whether another project is about to replace this one.
    pub(crate) fn is_opening(&self) -> bool {
        self.runs(FileJob::Open) || self.runs(FileJob::Restore)
    }

    /// Whether reports or missing results wait for the next frame.
    pub(crate) fn is_waiting(&self) -> bool {
        !self.reports.is_empty() || self.checked.is_none()
    }

    /// Whether no job is running.
    pub(crate) fn is_empty(&self) -> bool {
        self.running.is_empty()
    }

    /// Steps whose outputs are being computed.
    pub(crate) fn steps(&self) -> BTreeSet<Step> {
        let step = |job: &Job| match job.subject {
            Subject::Output(pending) => Some(pending.query.step()),
            Subject::File(_) => None,
        };
        self.running.iter().filter_map(step).collect()
    }

    /// Returns description and progress of the oldest running job.
    ///
    /// * `video`: progress of the video that is being read
    pub(crate) fn progress(
        &self,
        project: &Project,
        video: Option<String>,
    ) -> Option<(String, f32)> {
        let Some(job) = self.running.first() else {
            return Some((video?, 0.0));
        };
        let mut words = match &job.subject {
            Subject::Output(pending) => pending.query.label(project),
            Subject::File(FileJob::Frames(_)) if let Some(video) = video => video,
            Subject::File(job) => job.label().to_owned(),
        };
        if !job.stage.is_empty() {
            words.push_str(&format!(": {}", job.stage));
        }
        Some((words, job.share))
    }
}
