//! Matches of two photographs.

use super::features::{Described, FeaturesOf};
use super::task::{Destination, Query, Task};
#[cfg(feature = "vision")]
use super::task::{Monitor, Progress, Run};
use crate::project::{Key, MatchOptions, PhotoId, Project, Step, pairs};
use serde::{Deserialize, Serialize};

/// A match.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Match {
    /// Index in the first photograph.
    pub first: u32,
    /// Index in the second photograph.
    pub second: u32,
    /// Ratio of the descriptor distances to the nearest and the second nearest.
    pub ratio: f32,
}

/// Matches the features of two photographs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct MatchFeatures {
    /// Descriptors of the first photograph.
    pub first: Described,
    /// Descriptors of the second photograph.
    pub second: Described,
    /// Matching settings.
    pub options: MatchOptions,
}

impl Task for MatchFeatures {
    type Output = Vec<Match>;
}

/// Query for the matches of a pair, in the order of the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MatchesOf(pub PhotoId, pub PhotoId);

impl Query for MatchesOf {
    type Task = MatchFeatures;
    const STEP: Step = Step::Matches;

    fn all(project: &Project) -> Vec<Self> {
        let photos = project.taking_part();
        pairs(&photos)
            .map(|(first, second)| Self(first.id, second.id))
            .collect()
    }

    fn key(self, project: &Project) -> Option<Key> {
        let first = FeaturesOf(self.0).key(project)?;
        let second = FeaturesOf(self.1).key(project)?;
        let options = project.document.settings.matching;
        Some(Key::of(&("matches", (first.0, second.0), options)))
    }

    fn is_ready(self, project: &Project, is_imported: bool) -> bool {
        let features = [self.0, self.1].map(|id| project.get(FeaturesOf(id)));
        features
            .into_iter()
            .all(|found| found.is_some_and(|found| is_imported || found.has_descriptors()))
    }

    fn priority(self, _project: &Project) -> u8 {
        40
    }

    fn task(self, project: &Project) -> Option<MatchFeatures> {
        Some(MatchFeatures {
            first: project.get(FeaturesOf(self.0))?.described.clone(),
            second: project.get(FeaturesOf(self.1))?.described.clone(),
            options: project.document.settings.matching,
        })
    }

    fn label(self, project: &Project) -> String {
        let all = Self::all(project);
        let done = all.iter().filter(|pair| pair.is_settled(project)).count();
        format!("Matching pairs: {done} of {}", all.len())
    }

    fn stored(output: &Vec<Match>, _destination: Destination) -> Option<Vec<Match>> {
        Some(output.clone())
    }

    fn fits(self, project: &Project, output: &Vec<Match>) -> bool {
        let counts = (project.num_features(self.0), project.num_features(self.1));
        let (Some(first), Some(second)) = counts else {
            return false;
        };
        output.iter().all(|m| {
            (m.first as usize) < first && (m.second as usize) < second && m.ratio.is_finite()
        })
    }
}

impl MatchesOf {
    /// Returns `u1, v1, u2, v2` for each match.
    pub fn places(self, project: &Project) -> Option<Vec<[f64; 4]>> {
        let matches = project.get(self)?;
        let first = project.get(FeaturesOf(self.0))?;
        let second = project.get(FeaturesOf(self.1))?;
        let place = |m: &Match| {
            let a = first.list.get(m.first as usize)?;
            let b = second.list.get(m.second as usize)?;
            Some([a.u, a.v, b.u, b.v])
        };
        matches.iter().map(place).collect()
    }
}

#[cfg(feature = "vision")]
impl Run for MatchFeatures {
    fn run(self, monitor: Monitor<'_>) -> Result<Vec<Match>, String> {
        use super::convert::sentence;
        use epipole::feature::match_descriptors;
        let how = epipole::feature::MatchOptions::default()
            .with_max_ratio(Some(self.options.ratio))
            .with_mutual(self.options.mutual);
        let mut watch = |_| monitor(Progress::Share(0.0, ""));
        let (first, second) = (read(self.first)?, read(self.second)?);
        let found = match_descriptors(&first, &second, &how, &mut watch);
        let found = found.map_err(sentence)?;
        let plain = |m: &epipole::feature::Match| Match {
            first: m.index1 as u32,
            second: m.index2 as u32,
            ratio: m.ratio,
        };
        Ok(found.iter().map(plain).collect())
    }
}

#[cfg(feature = "vision")]
fn read(described: Described) -> Result<epipole::feature::Descriptors, String> {
    let dimension = described.dimension as usize;
    epipole::feature::Descriptors::from_bytes(dimension, described.values.0.to_vec())
        .map_err(|error| error.to_string())
}
