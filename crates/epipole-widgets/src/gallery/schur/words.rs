//! Readouts and description of `schur`.

use super::model::Schur;
use crate::contract::{Readout, Words, format_number};

impl Words for Schur {
    fn readouts(&self) -> Vec<Readout> {
        let blocks = &self.blocks;
        let [cameras, points] = blocks.unknowns();
        let [filled, coupled] = [blocks.fill_ratio(), blocks.coupled_ratio()];
        vec![
            Readout::count("unknowns", "All unknowns", cameras + points).main(),
            Readout::count("left", "Unknowns left", cameras).main(),
            Readout::number("saving", "Less work", blocks.saving(), 0, "times").main(),
            Readout::percent("filled", "Not zero", filled, 1),
            Readout::percent("coupled", "Coupled cameras", coupled, 0),
        ]
    }

    fn describe(&self) -> String {
        let blocks = &self.blocks;
        let [cameras, points] = blocks.unknowns();
        format!(
            "{} cameras and {} points, each seen by {}: {} unknowns, and {}% of their matrix is not zero. With the \
             points eliminated {} unknowns are left, which takes {} times less work; {}% of the blocks among cameras \
             are not zero.",
            blocks.num_cameras,
            blocks.num_points(),
            self.num_views(),
            cameras + points,
            format_number(100.0 * blocks.fill_ratio(), 1),
            cameras,
            format_number(blocks.saving(), 0),
            format_number(100.0 * blocks.coupled_ratio(), 0)
        )
    }
}
