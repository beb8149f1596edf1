//! Closed loops of a path.

use super::alignment::Similarity;
use super::pose_graph::loss as loss_or_default;
use crate::argument::{Argument, check_keys, entry};
use crate::fault::Result;
use crate::functions::functions;
use crate::options::{NoOptions, Setting};
use crate::output::{Numbers, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::camera::RigidTransform;
use epipole::optim::RobustLoss;
use epipole::sfm::{self, LoopClosure, LoopMotion, PoseGraphReport};

structs! {
    /// Path after its loops are closed.
    struct ClosedPath as ClosedPath {
        /// Pose of the camera of each frame in the world.
        world_from_cam: Vec<RigidTransform>,
        /// Factor for lengths around each frame.
        scale: Numbers,
        /// Report of the optimization.
        report: PoseGraphReport,
    }
}

impl Argument for LoopClosure {
    fn typescript(types: &mut Types) -> String {
        let similarity = <Similarity as Argument>::typescript(types);
        types.interface(
            "LoopClosure",
            "Motion between two frames that show the same place.",
            &[
                ("from", "number", "Index of the earlier frame."),
                ("to", "number", "Index of the later frame."),
                (
                    "fromFromTo",
                    &similarity,
                    "Pose of the later camera in the frame of the earlier one, with the ratio of \
                     their scales.",
                ),
                (
                    "weight?",
                    "number",
                    "Weight relative to one step of the path. 1 if not given.",
                ),
            ],
        );
        "LoopClosure".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["from", "to", "fromFromTo", "weight"])?;
        Ok(Self {
            from: entry::<u32>(name, value, "from")? as usize,
            to: entry::<u32>(name, value, "to")? as usize,
            from_from_to: entry::<Similarity>(name, value, "fromFromTo")?.0,
            weight: entry::<Option<f64>>(name, value, "weight")?.unwrap_or(1.0),
        })
    }
}

functions! {
    /// Spreads the error of closed loops over a path, with its scale unless `motion` is "rigid".
    /// The first frame stays where it is. The width of the loss is in standard deviations.
    fn close_loops(
        world_from_cam: Vec<RigidTransform>, loops: Vec<LoopClosure>,
        motion: Option<Setting<LoopMotion>>, loss: Option<Setting<RobustLoss>>,
        options: NoOptions; monitor
    ) -> ClosedPath {
        let NoOptions = options;
        let motion = motion.map_or(LoopMotion::default(), |motion| motion.0);
        let loss = loss_or_default(loss);
        let closed = sfm::close_loops(&world_from_cam, &loops, motion, loss, monitor)?;
        ClosedPath {
            world_from_cam: closed.world_from_cam,
            scale: Numbers(closed.scale),
            report: closed.report,
        }
    }
}
