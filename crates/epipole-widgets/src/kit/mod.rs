//! Shared parts of the figures.
//!
//! | module | purpose |
//! |---|---|
//! | [`question`] | a long computation: requested, run elsewhere, answered |
//! | [`changed`] | a photograph that is rotated, scaled and changed in brightness |
//! | [`patch`] | windows of features, for comparison |
//! | [`picture`] | photographs of the reader, and serialization of photographs |
//! | [`photo`], [`scenes`] | rendered photographs of the book's scenes |
//! | [`rectified`] | a stereo pair of the still life with its true disparities |
//! | [`sequence`] | frames of a camera that moves around the still life |
//! | [`features`] | two photographs of the still life with their features |
//! | [`probe`] | a handle over a photograph or a top view |
//! | [`points`] | points that the reader drags, adds and removes |
//! | [`running`], [`timeline`] | a loop that runs, steps and restarts; frames of a video |
//! | [`matches`], [`meeting`] | exact and noisy matches of the still life; intersections of lines |
//! | [`line_points`], [`line_plane`] | points near a hidden line, outliers, votes |
//! | [`samples`], [`tally`] | the RANSAC loop by samples; the same for points near a line, with all
//! votes |
//! | [`orbit`], [`lens`], [`space`] | 3D views and their viewpoint |
//! | [`standing`] | photographs in 3D views |
//! | [`reconstruction`] | from two photographs to cameras and points in 3D, stage by stage |
//! | [`geometry`] | the epipolar geometry of two cameras |
//! | [`guess`] | a hidden answer and the reader's guess |
//! | [`grid`] | titled panels in rows, breakpoints, notices |
//! | [`plot`] | axes, linear or logarithmic, and curves |
//! | [`plan`] | a top view |
//! | [`board`] | a board for calibration, placed by its middle |
//! | [`cells`] | cells with readable numbers |
//! | [`heat`], [`terrain`] | numbers as colors, and as a terrain |
//! | [`house`] | a wireframe house with cameras around it |
//! | [`pair`] | two photographs of the still life, epipolar lines |
//! | [`corners`] | the corners of a rectangle, dragged in a photograph |
//! | [`warped`] | a photograph through a homography |
//! | [`labels`], [`legend`], [`words`] | labels of marks, legends, formatting of numbers |

pub(crate) mod board;
pub(crate) mod cells;
pub(crate) mod changed;
pub(crate) mod corners;
pub(crate) mod features;
pub(crate) mod geometry;
pub(crate) mod grid;
pub(crate) mod guess;
pub(crate) mod heat;
pub(crate) mod house;
pub(crate) mod labels;
pub(crate) mod legend;
pub(crate) mod lens;
pub(crate) mod line_plane;
pub(crate) mod line_points;
pub(crate) mod matches;
pub(crate) mod meeting;
pub(crate) mod orbit;
pub(crate) mod pair;
pub(crate) mod patch;
pub(crate) mod photo;
pub(crate) mod picture;
pub(crate) mod plan;
pub(crate) mod plot;
pub(crate) mod points;
pub(crate) mod probe;
pub(crate) mod question;
pub(crate) mod reconstruction;
pub(crate) mod rectified;
pub(crate) mod running;
pub(crate) mod samples;
pub(crate) mod scenes;
pub(crate) mod sequence;
pub(crate) mod sfm_image;
pub(crate) mod space;
pub(crate) mod standing;
pub(crate) mod tally;
pub(crate) mod terrain;
pub(crate) mod timeline;
pub(crate) mod warped;
pub(crate) mod words;
