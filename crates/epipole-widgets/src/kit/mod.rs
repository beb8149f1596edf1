//! Shared parts of the figures.
//!
//! | module | purpose |
//! |---|---|
//! | [`question`] | a computation that takes long: asked, carried out elsewhere, answered |
//! | [`changed`] | a photograph that is turned, scaled and lit otherwise, around a place |
//! | [`patch`] | what the windows of features show, for comparison |
//! | [`picture`] | photographs of the reader's own, and how photographs travel to a worker |
//! | [`photo`], [`scenes`] | rendered photographs of the book's scenes |
//! | [`rectified`] | a stereo pair of the still life with its true disparities |
//! | [`sequence`] | frames of a camera that moves around the still life |
//! | [`features`] | two photographs of the still life with their features |
//! | [`probe`] | a thing that the reader moves, over a photograph or over a plan |
//! | [`points`] | points that the reader drags, adds and removes |
//! | [`running`], [`timeline`] | a loop that runs, steps and starts over; frames of a video |
//! | [`matches`], [`meeting`] | exact and noisy matches of the still life; where lines meet |
//! | [`line_points`], [`line_plane`] | points near a hidden line, outliers, votes |
//! | [`samples`], [`tally`] | the RANSAC loop, sample by sample; of points near a line, with all votes |
//! | [`orbit`], [`lens`], [`space`] | things in three dimensions, and where the reader looks from |
//! | [`standing`] | photographs that stand among them |
//! | [`reconstruction`] | two photographs to cameras and points in space, stage by stage |
//! | [`geometry`] | the epipolar geometry of two cameras |
//! | [`grid`] | titled panels in rows, one breakpoint, notices |
//! | [`plot`] | axes, linear or logarithmic, and curves |
//! | [`plan`] | a view from above |
//! | [`cells`] | numbers in cells, to be read |
//! | [`heat`], [`terrain`] | numbers as colors, and as a landscape |
//! | [`house`] | a house of wire with cameras around it |
//! | [`pair`] | two photographs of the still life, epipolar lines |
//! | [`corners`] | the corners of a rectangle, dragged in a photograph |
//! | [`warped`] | a photograph through a homography |
//! | [`labels`], [`legend`], [`words`] | words beside marks, what marks mean, numbers in words |

pub(crate) mod cells;
pub(crate) mod changed;
pub(crate) mod corners;
pub(crate) mod features;
pub(crate) mod geometry;
pub(crate) mod grid;
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
