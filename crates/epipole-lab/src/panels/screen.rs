//! Interface between the panels and the app.

use super::widgets::cloud::CloudView;
use super::widgets::photo::{Lens, Pictures};
use crate::project::{Project, Settings};
use crate::session::{Event, Verdict};
use crate::tasks::{CameraFormat, ExportFormat};
use egui::Ui;

/// Request of a panel to the app.
#[derive(Debug, Clone)]
pub(crate) enum Action {
    /// Change the project.
    Send(Event),
    /// Add photographs from files.
    AddPhotographs,
    /// Open camera files.
    OpenCameras,
    /// Save the calibrated camera as a file, with its uncertainty.
    SaveCamera,
    /// Save the calibrated camera for another program.
    SaveCameraAs(CameraFormat),
    /// Save the reconstruction as a zip file, with cameras and points in this format.
    SaveReconstruction(ExportFormat),
    /// Save an image of the point cloud as last seen.
    SaveView,
    /// Take photographs with the camera of the device.
    TakePhotographs,
}

/// Views that several panels share.
#[derive(Default)]
pub(crate) struct Views {
    /// Textures of photographs.
    pub(crate) pictures: Pictures,
    /// Zoom of the photograph, or of both photographs of a pair.
    pub(crate) lenses: [Lens; 2],
    /// The point cloud.
    pub(crate) cloud: CloudView,
    /// Verdict on the reconstruction with its revision, cached because it takes all pairs into
    /// account.
    pub(crate) verdict: Option<(u64, Option<Verdict>)>,
    /// Settings while a control is dragged.
    pub(crate) draft: Option<Settings>,
}

/// Access of a panel to the Lab during a frame.
pub(crate) struct Screen<'a> {
    /// The open project.
    pub(crate) project: &'a Project,
    /// Views that several panels share.
    pub(crate) views: &'a mut Views,
    /// Requests to the app, carried out after the frame.
    pub(crate) actions: &'a mut Vec<Action>,
}

impl Screen<'_> {
    /// Requests a change of the project.
    pub(crate) fn send(&mut self, event: Event) {
        self.actions.push(Action::Send(event));
    }
}

/// Panel of a step; it keeps its own view state.
pub(crate) trait Panel {
    /// Draws the picture in the middle of the screen.
    fn picture(&mut self, screen: &mut Screen<'_>, ui: &mut Ui);

    /// Draws the controls beside it.
    fn controls(&mut self, screen: &mut Screen<'_>, ui: &mut Ui);
}
