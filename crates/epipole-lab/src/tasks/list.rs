//! List of all tasks, with the request for a worker and the query of the project.

use super::task::{Destination, Query, Task};
use super::{
    AllViews, BoardOf, Calibrate, CalibrationOfBoards, ChooseFrame, DepthOf, Export, FeaturesOf,
    FindBoard, FindDepth, FindFeatures, FuseViews, MatchFeatures, MatchesOf, OpenProject,
    PhotographOf, ReadCameras, ReadPhotograph, Reconstruct, ReconstructionOfAll, ReducePhotograph,
    ReducedOf, SaveProject, TwoViewsOf, VerifyPair, WriteCamera, WritePicture,
};
use crate::project::{Key, Project, Step, to_bytes};
use serde::{Deserialize, Serialize};
use std::any::Any;

/// Code module that runs a task; the browser loads each one separately.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Branch {
    /// Vision on prepared photographs.
    Vision,
    /// Reading, rendering and writing of files, and processing of full-size photographs.
    Files,
}

/// Declares [`Request`], [`AnyQuery`] and [`compute`].
///
/// Each line is a name, the task, the branch and its feature; tasks whose output the project caches
/// also name their query.
macro_rules! tasks {
    (
        cached { $($cached:ident: $query:ident => $input:ident in $branch:ident $feature:tt;)* }
        once { $($once:ident: $task:ident in $once_branch:ident $once_feature:tt;)* }
    ) => {
        /// A task of any kind, as sent to a worker.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
        pub enum Request {
            $(#[doc = concat!("See [`", stringify!($input), "`].")] $cached($input),)*
            $(#[doc = concat!("See [`", stringify!($task), "`].")] $once($task),)*
        }

        $(impl From<$input> for Request {
            fn from(task: $input) -> Self {
                Self::$cached(task)
            }
        })*
        $(impl From<$task> for Request {
            fn from(task: $task) -> Self {
                Self::$once(task)
            }
        })*

        impl Request {
            /// Returns the code module that it needs.
            pub fn branch(&self) -> Branch {
                match self {
                    $(Self::$cached(_) => Branch::$branch,)*
                    $(Self::$once(_) => Branch::$once_branch,)*
                }
            }
        }

        /// Runs the task of a request and returns its output as bytes.
        ///
        /// # Errors
        /// A message for the reader, also if the task belongs to the other code module.
        #[cfg(any(feature = "vision", feature = "files"))]
        pub fn compute(request: &[u8], monitor: super::Monitor<'_>) -> Result<Vec<u8>, String> {
            use super::task::Run;
            match Request::from_bytes(request)? {
                $(#[cfg(feature = $feature)]
                Request::$cached(task) => Ok($input::write(&task.run(monitor)?)),)*
                $(#[cfg(feature = $once_feature)]
                Request::$once(task) => Ok($task::write(&task.run(monitor)?)),)*
                #[cfg(not(all(feature = "vision", feature = "files")))]
                _ => Err("this computation belongs to the other module of the Lab".to_owned()),
            }
        }

        /// A query of any kind.
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum AnyQuery {
            $(#[doc = concat!("See [`", stringify!($query), "`].")] $cached($query),)*
        }

        impl AnyQuery {
            /// Returns all queries of the current document.
            pub(crate) fn all(project: &Project) -> Vec<Self> {
                let mut all = Vec::new();
                $(all.extend($query::all(project).into_iter().map(Self::$cached));)*
                all
            }

            /// See [`Query::key`].
            pub fn key(self, project: &Project) -> Option<Key> {
                match self { $(Self::$cached(query) => query.key(project),)* }
            }

            /// See [`Query::STEP`].
            pub(crate) fn step(self) -> Step {
                match self { $(Self::$cached(_) => $query::STEP,)* }
            }

            /// See [`Query::is_ready`].
            pub(crate) fn is_ready(self, project: &Project, is_imported: bool) -> bool {
                match self { $(Self::$cached(query) => query.is_ready(project, is_imported),)* }
            }

            /// See [`Query::is_settled`].
            pub(crate) fn is_settled(self, project: &Project) -> bool {
                match self { $(Self::$cached(query) => query.is_settled(project),)* }
            }

            /// See [`Query::priority`].
            pub(crate) fn priority(self, project: &Project) -> u8 {
                match self { $(Self::$cached(query) => query.priority(project),)* }
            }

            /// See [`Query::task`].
            pub(crate) fn request(self, project: &Project) -> Option<Request> {
                match self { $(Self::$cached(query) => query.task(project).map(Into::into),)* }
            }

            /// See [`Query::label`].
            pub fn label(self, project: &Project) -> String {
                match self { $(Self::$cached(query) => query.label(project),)* }
            }

            /// Decodes an output.
            pub(crate) fn read(self, bytes: &[u8]) -> Result<Box<dyn Any>, String> {
                match self { $(Self::$cached(_) => Ok(Box::new($input::read(bytes)?)),)* }
            }

            /// Decodes an output from a file, if it is valid.
            pub(crate) fn import(self, project: &Project, bytes: &[u8]) -> Option<Box<dyn Any>> {
                match self {
                    $(Self::$cached(query) => {
                        let output = $input::read(bytes).ok()?;
                        query.fits(project, &output).then(|| Box::new(output) as Box<dyn Any>)
                    })*
                }
            }

            /// Encodes its output for a file.
            pub(crate) fn stored(self, project: &Project, destination: Destination) -> Option<Vec<u8>> {
                match self {
                    $(Self::$cached(query) => {
                        Some($input::write(&$query::stored(project.get(query)?, destination)?))
                    })*
                }
            }
        }
    };
}

tasks! {
    cached {
        Photograph: PhotographOf => ReadPhotograph in Files "files";
        Features: FeaturesOf => FindFeatures in Vision "vision";
        Matches: MatchesOf => MatchFeatures in Vision "vision";
        TwoViews: TwoViewsOf => VerifyPair in Vision "vision";
        Reconstruction: ReconstructionOfAll => Reconstruct in Vision "vision";
        Depth: DepthOf => FindDepth in Vision "vision";
        Reduced: ReducedOf => ReducePhotograph in Vision "vision";
        Cloud: AllViews => FuseViews in Vision "vision";
        Board: BoardOf => FindBoard in Files "files";
        Calibration: CalibrationOfBoards => Calibrate in Vision "vision";
    }
    once {
        Frames: ChooseFrame in Files "files";
        Picture: WritePicture in Files "files";
        Export: Export in Files "files";
        SaveProject: SaveProject in Files "files";
        OpenProject: OpenProject in Files "files";
        ReadCameras: ReadCameras in Files "files";
        WriteCamera: WriteCamera in Files "files";
    }
}

impl Request {
    /// Inverse of [`Request::from_bytes`].
    pub fn to_bytes(&self) -> Vec<u8> {
        to_bytes(self)
    }

    /// Parses a request.
    ///
    /// # Errors
    /// A message for invalid bytes.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, String> {
        postcard::from_bytes(bytes).map_err(|_| "the request did not arrive whole".to_owned())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::project::Source;

    #[test]
    fn a_message_takes_the_room_of_its_bytes_alone() {
        let file = |len: usize| {
            Request::from(ReadPhotograph {
                source: Source::File(vec![7; len].into()),
                max_pixels: 3_000_000,
                camera: None,
            })
        };
        for len in [0, 100, 1_000_003] {
            let request = file(len);
            let bytes = request.to_bytes();
            assert!((len..len + 20).contains(&bytes.len()), "{}", bytes.len());
            assert_eq!(bytes.capacity(), bytes.len());
            assert_eq!(Request::from_bytes(&bytes), Ok(request));
        }
    }
}
