//! Frames of videos, one video after the other, part by part: only the sharpest frame of each part
//! is used.

use super::host::Host;
use crate::project::Blob;
use std::collections::VecDeque;

/// A video being read or waiting.
struct Reading {
    video: u32,
    num_parts: u32,
    /// The requested part.
    part: u32,
    chosen: Vec<(String, Blob)>,
}

/// Queue of videos; the first is being read.
#[derive(Default)]
pub(crate) struct Videos(VecDeque<Reading>);

impl Videos {
    /// Adds a video, from which `num_parts` frames are taken.
    pub(crate) fn add(&mut self, video: u32, num_parts: u32, host: &mut impl Host) {
        self.0.push_back(Reading {
            video,
            num_parts,
            part: 0,
            chosen: Vec::new(),
        });
        // Others wait: decoding a video needs the whole machine.
        if self.0.len() == 1 {
            host.ask_for_frames(video, 0, num_parts);
        }
    }

    /// Returns the requested part of a video, if it is the one being read.
    pub(crate) fn part_of(&self, video: u32) -> Option<u32> {
        let first = self.0.front().filter(|reading| reading.video == video);
        first.map(|reading| reading.part)
    }

    /// Describes the progress of the first video.
    pub(crate) fn words(&self) -> Option<String> {
        let first = self.0.front()?;
        Some(format!(
            "Reading the video: part {} of {}",
            first.part + 1,
            first.num_parts
        ))
    }

    /// Keeps the sharpest frame of the requested part, if any. Returns the frames of all parts
    /// after the last.
    pub(crate) fn take(
        &mut self,
        video: u32,
        frames: Vec<(String, Blob)>,
        host: &mut impl Host,
    ) -> Option<Vec<(String, Blob)>> {
        let first = self
            .0
            .front_mut()
            .filter(|reading| reading.video == video)?;
        first.chosen.extend(frames);
        first.part += 1;
        if first.part < first.num_parts {
            host.ask_for_frames(video, first.part, first.num_parts);
            return None;
        }
        let done = self.0.pop_front()?;
        self.go_on(host);
        Some(done.chosen)
    }

    /// Drops a video and starts the next.
    pub(crate) fn give_up(&mut self, video: u32, host: &mut impl Host) {
        let before = self.part_of(video);
        self.0.retain(|reading| reading.video != video);
        if before.is_some() {
            self.go_on(host);
        }
    }

    fn go_on(&self, host: &mut impl Host) {
        if let Some(next) = self.0.front() {
            host.ask_for_frames(next.video, next.part, next.num_parts);
        }
    }
}
