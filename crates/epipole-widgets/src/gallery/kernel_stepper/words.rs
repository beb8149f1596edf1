//! Readouts and description of `kernel-stepper`.

use super::kernel::Kernel;
use super::model::{BORDER, KernelStepper};
use crate::contract::{Readout, Words};
use crate::kit::words::{after, short};

impl Kernel {
    /// Formats the rows, such as "0 1 0; 1 −4 1; 0 1 0", and the divisor.
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
        let pixel = self.window.pixel();
        let number = |id, label, value: f64, digits| Readout::number(id, label, value, digits, "");
        vec![
            number("sum", "Sum", self.sum(pixel), 0).main(),
            number("divisor", "Divisor", self.kernel().divisor.into(), 0).main(),
            number("answer", "Answer", self.answer(pixel), 2).main(),
            Readout::words("place", "Pixel", self.window.text()),
            number("level", "Gray level", self.window()[4].into(), 0),
            Readout::words("beyond", "Border", self.settings.label(&BORDER)),
            Readout::words("own-kernel", "Your kernel", self.own().words()),
        ]
    }

    fn describe(&self) -> String {
        let pixel = self.window.pixel();
        let (name, along) = self.names();
        let along = along.map_or(String::new(), |axis| format!(" along {axis}"));
        let remark = after(self.remark());
        format!(
            "A window of 3 by 3 pixels at {}. Kernel: {name}{along}. The products add up to \
             {}; divided by {} that is {}.{remark}",
            self.window.text(),
            short(self.sum(pixel)),
            short(self.kernel().divisor.into()),
            short(self.answer(pixel)),
        )
    }
}
