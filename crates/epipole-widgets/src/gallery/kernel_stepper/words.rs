//! What `kernel-stepper` says.

use super::kernel::Kernel;
use super::model::KernelStepper;
use crate::contract::{Readout, Words, format_number};

/// A number with as few decimals as it needs, two at most.
pub(super) fn short(value: f64) -> String {
    let digits = (0..2).find(|&digits| {
        let times = [1.0, 10.0][digits];
        ((value * times).round() - value * times).abs() < 1e-4
    });
    format_number(value, digits.unwrap_or(2))
}

impl Kernel {
    /// Its rows, such as "0 1 0; 1 −4 1; 0 1 0", and the divisor.
    fn words(&self) -> String {
        let row = |row: &[f32]| {
            let weights: Vec<String> = row.iter().map(|weight| short((*weight).into())).collect();
            weights.join("\u{a0}")
        };
        let rows: Vec<String> = self.weights.chunks(3).map(row).collect();
        format!("{}, ÷ {}", rows.join("; "), short(self.divisor.into()))
    }
}

impl Words for KernelStepper {
    fn readouts(&self) -> Vec<Readout> {
        let pixel = self.pixel();
        let place = format!("column {}, row {}", pixel.0, pixel.1);
        let number = |id, label, value: f64, digits| Readout::number(id, label, value, digits, "");
        vec![
            number("sum", "Sum", self.sum(pixel), 0).main(),
            number("divisor", "Divisor", self.kernel().divisor.into(), 0).main(),
            number("answer", "Answer", self.answer(pixel), 2).main(),
            Readout::words("place", "Pixel", place),
            number("level", "Gray level", self.window()[4].into(), 0),
            Readout::words("beyond", "Border", self.border_name()),
            Readout::words("own-kernel", "Your kernel", self.own().words()),
        ]
    }

    fn describe(&self) -> String {
        let pixel = self.pixel();
        let (name, along) = self.names();
        let along = along.map_or(String::new(), |axis| format!(" along {axis}"));
        let remark = self.remark();
        let remark = remark.map_or(String::new(), |remark| format!(" {remark}"));
        format!(
            "A window of 3 by 3 pixels at column {}, row {}. Kernel: {name}{along}. The products add up to \
             {}; divided by {} that is {}.{remark}",
            pixel.0,
            pixel.1,
            short(self.sum(pixel)),
            short(self.kernel().divisor.into()),
            short(self.answer(pixel)),
        )
    }
}
