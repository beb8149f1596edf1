//! A small image, a kernel, a border, and a window that moves from pixel to pixel.

use super::kernel::Kernel;
use super::pixels::{self, SIZE};
use crate::contract::{
    Button, ButtonRole, Challenge, Choice, Control, Declared, Event, Handle, Knob, Model, Problem,
    Settings, Slider, knobs,
};
use crate::kit::probe::Probe;
use epipole::imaging::{Border, GrayImage32, correlate};

const PIXELS: Choice = Choice::new(
    "pixels",
    "Pixels",
    &[("patch", "Patch"), ("photograph", "Rim of the mug")],
);
const KERNEL: Choice = Choice::new(
    "kernel",
    "Kernel",
    &[
        ("difference", "Difference, ÷ 2"),
        ("sobel", "Sobel, ÷ 8"),
        ("sobel-raw", "Sobel, as it is"),
        ("gaussian", "Gaussian, ÷ 16"),
        ("own", "Your own"),
    ],
);
const OWN: usize = 4;
const ALONG: Choice = Choice::new(
    "along",
    "Along",
    &[("u", "u, to the right"), ("v", "v, down")],
);
pub(super) const BORDER: Choice = Choice::new(
    "border",
    "Beyond the border",
    &[
        ("replicate", "Repeat"),
        ("reflect", "Mirror"),
        ("zero", "Zero"),
    ],
);
const fn weight(id: &'static str, label: &'static str) -> Slider {
    Slider::new(id, label).range(-9.0, 9.0, 1.0).more()
}
static WEIGHTS: [Slider; 9] = [
    weight("w1", "Above left"),
    weight("w2", "Above"),
    weight("w3", "Above right"),
    weight("w4", "Left"),
    weight("w5", "Middle").at(1.0),
    weight("w6", "Right"),
    weight("w7", "Below left"),
    weight("w8", "Below"),
    weight("w9", "Below right"),
];
const DIVIDE: Slider = Slider::new("divide", "Divide by")
    .range(1.0, 16.0, 1.0)
    .at(1.0)
    .more();
static KNOBS: &[Knob] = knobs![
    KERNEL, ALONG, BORDER, PIXELS, WEIGHTS[0], WEIGHTS[1], WEIGHTS[2], WEIGHTS[3], WEIGHTS[4],
    WEIGHTS[5], WEIGHTS[6], WEIGHTS[7], WEIGHTS[8], DIVIDE,
];
const WINDOW: Probe = Probe::new("window", "pixels", "Window")
    .over(SIZE)
    .at(3.0, 2.0);
const NEXT: Button = Button::new("next", "Next pixel", ButtonRole::Step);

/// The model of `kernel-stepper`.
pub(crate) struct KernelStepper {
    pub(super) settings: Settings,
    pub(super) window: Probe,
    image: GrayImage32,
    /// The sum of products at every pixel.
    sums: Result<GrayImage32, String>,
}

impl KernelStepper {
    pub(super) fn kernel(&self) -> Kernel {
        let turned = self.settings.chosen(&ALONG) == 1;
        match self.settings.chosen(&KERNEL) {
            0 => Kernel::difference(turned),
            1 => Kernel::sobel(8.0, turned),
            2 => Kernel::sobel(1.0, turned),
            3 => Kernel::gaussian(),
            _ => self.own(),
        }
    }

    /// Returns the reader's kernel, even while another one is chosen.
    pub(super) fn own(&self) -> Kernel {
        Kernel {
            weights: std::array::from_fn(|index| self.settings.number(&WEIGHTS[index]) as f32),
            divisor: self.settings.number(&DIVIDE) as f32,
        }
    }

    /// Returns the label of the kernel, and the axis along which it measures a slope, if any.
    pub(super) fn names(&self) -> (&'static str, Option<&'static str>) {
        let measures = self.settings.chosen(&KERNEL) < 3;
        let along = ["u", "v"][self.settings.chosen(&ALONG)];
        (self.settings.label(&KERNEL), measures.then_some(along))
    }

    pub(super) fn border(&self) -> Border {
        let borders = [Border::Replicate, Border::Reflect101, Border::Constant(0.0)];
        borders[self.settings.chosen(&BORDER)]
    }

    /// Returns the gray level at a position inside the image or beyond its border.
    pub(super) fn level(&self, u: i32, v: i32) -> f32 {
        self.border().value(&self.image, u as isize, v as isize)
    }

    /// Returns the nine gray levels in the window, in row order.
    pub(super) fn window(&self) -> [f32; 9] {
        let (u, v) = self.window.pixel();
        std::array::from_fn(|index| {
            let (column, row) = (index as i32 % 3 - 1, index as i32 / 3 - 1);
            self.level(u as i32 + column, v as i32 + row)
        })
    }

    /// Returns the sum of products at a pixel.
    pub(super) fn sum(&self, (u, v): (u32, u32)) -> f64 {
        let sums = self.sums.as_ref();
        sums.map_or(0.0, |sums| f64::from(sums.get_pixel(u, v).0[0]))
    }

    /// Returns the output of the filter at a pixel: the sum divided by the divisor.
    pub(super) fn answer(&self, pixel: (u32, u32)) -> f64 {
        self.sum(pixel) / f64::from(self.kernel().divisor)
    }

    /// Returns a message for a failed filter or a kernel of zeros.
    pub(super) fn remark(&self) -> Option<&str> {
        match &self.sums {
            Err(sentence) => Some(sentence),
            Ok(_) => (self.kernel().is_zero())
                .then_some("All nine weights are zero, so the answer is 0 everywhere."),
        }
    }

    fn filter(&mut self) {
        let sums = correlate(&self.image, &self.kernel().image(), self.border(), &mut ());
        self.sums = sums.map_err(|error| format!("There is no answer: {error}."));
    }
}

impl Declared for KernelStepper {
    const NAME: &'static str = "kernel-stepper";
    const TITLE: &'static str = "Nine products and a sum";
    const HELP: &'static str = "Drag the window over the pixels, or move it with the arrow keys; a click puts \
        it elsewhere. Nine sliders make a kernel of your own.";
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        let mut model = Self {
            settings: Settings::new(KNOBS),
            window: WINDOW,
            image: pixels::image(false),
            sums: Err(String::new()),
        };
        model.filter();
        model
    }
}

impl Model for KernelStepper {
    fn controls(&self) -> Vec<Control> {
        let kernel = self.settings.chosen(&KERNEL);
        let is_weight = |id: &str| id == DIVIDE.id || WEIGHTS.iter().any(|weight| weight.id == id);
        let mut controls = self.settings.controls_enabled(|id| match id {
            id if id == ALONG.id => kernel < 3,
            id if is_weight(id) => kernel == OWN,
            _ => true,
        });
        controls.push(NEXT.control(true, false));
        controls
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.window.handle()]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        if self.window.update(event) {
            return Ok(());
        }
        if let Some(id) = self.settings.update(event)? {
            if id == PIXELS.id {
                self.image = pixels::image(self.settings.chosen(&PIXELS) == 1);
            }
            self.filter();
        }
        if *event == Event::press(NEXT.id) {
            let (u, v) = self.window.pixel();
            let next = (v * SIZE.0 + u + 1) % (SIZE.0 * SIZE.1);
            let (u, v) = (next % SIZE.0, next / SIZE.0);
            self.window = self.window.at(f64::from(u), f64::from(v));
        }
        Ok(())
    }
}

const CHALLENGES: &[Challenge<KernelStepper>] = &[
    Challenge {
        id: "border",
        goal: "With the difference along u, get exactly 0 in the first column.",
        hint: "The pixel on the left is not there. Which border makes it equal to the one on the right?",
        why: "A mirrored border puts the right neighbor on the left as well, so across the border the image \
              looks flat. Every border invents a slope.",
        check: |model| {
            let chosen = [&KERNEL, &ALONG].map(|choice| model.settings.chosen(choice));
            let pixel = model.window.pixel();
            chosen == [0, 0] && pixel.0 == 0 && model.answer(pixel) == 0.0
        },
        solution: || {
            vec![
                Event::set(&BORDER, "reflect"),
                Event::moved("window", 0.0, 2.0),
            ]
        },
    },
    Challenge {
        id: "shift",
        goal: "Build a kernel of your own that moves the image by one pixel.",
        hint: "Your own kernel starts with a 1 in the middle, which leaves the image as it is. Its weights are under \
              More settings.",
        why: "The answer belongs to the middle of the window, so a 1 to the right of it fetches the right \
              neighbor, and the image moves to the left.",
        check: |model| model.settings.chosen(&KERNEL) == OWN && model.own().is_shift(),
        solution: || {
            vec![
                Event::set(&KERNEL, "own"),
                Event::set(&WEIGHTS[4], 0.0),
                Event::set(&WEIGHTS[5], 1.0),
            ]
        },
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use epipole::imaging::{centered_difference, separable_filter, sobel};

    fn with(events: &[Event]) -> KernelStepper {
        let mut model = KernelStepper::new();
        for event in events {
            model.update(event).unwrap();
        }
        model
    }

    #[test]
    fn the_default_is_the_patch_of_the_chapter() {
        let model = KernelStepper::new();
        assert_eq!(
            model.window(),
            [30.0, 60.0, 90.0, 40.0, 90.0, 140.0, 35.0, 120.0, 150.0]
        );
        assert_eq!((model.sum((3, 2)), model.answer((3, 2))), (100.0, 50.0));
        assert_eq!(with(&[Event::set(&ALONG, "v")]).answer((3, 2)), 30.0);
    }

    #[test]
    fn every_kernel_answers_what_the_filter_of_that_name_does() {
        let quarter = [0.25, 0.5, 0.25];
        for border in ["replicate", "reflect", "zero"] {
            for (kernel, along) in [
                ("difference", "u"),
                ("difference", "v"),
                ("sobel", "u"),
                ("sobel-raw", "v"),
                ("gaussian", "u"),
            ] {
                let model = with(&[
                    Event::set(&PIXELS, "photograph"),
                    Event::set(&KERNEL, kernel),
                    Event::set(&ALONG, along),
                    Event::set(&BORDER, border),
                ]);
                let (image, border) = (&model.image, model.border());
                let gradient = match kernel {
                    "difference" => centered_difference(image, border),
                    _ => sobel(image, border),
                };
                let expected = match (kernel, along) {
                    ("gaussian", _) => {
                        separable_filter(image, &quarter, &quarter, border, &mut ()).unwrap()
                    }
                    (_, "u") => gradient.du,
                    _ => gradient.dv,
                };
                let gain = if kernel == "sobel" { 8.0 } else { 1.0 };
                for (u, v, value) in expected.enumerate_pixels() {
                    let off = model.answer((u, v)) - f64::from(value.0[0]) / gain;
                    assert!(off.abs() < 1e-4, "{kernel} {along} {border:?} {u} {v}");
                }
            }
        }
    }

    #[test]
    fn products_add_up_to_the_sum_and_the_window_walks_on() {
        let mut model = with(&[
            Event::set(&KERNEL, "sobel-raw"),
            Event::set(&BORDER, "zero"),
        ]);
        model.update(&Event::moved("window", 6.0, 5.0)).unwrap();
        for expected in [(7, 5), (0, 0), (1, 0)] {
            model.update(&Event::press("next")).unwrap();
            assert_eq!(model.window.pixel(), expected);
            let products = model.window().into_iter().zip(model.kernel().weights);
            let sum: f32 = products.map(|(level, weight)| level * weight).sum();
            assert_eq!(f64::from(sum), model.sum(expected));
        }
    }

    #[test]
    fn a_kernel_of_zeros_is_a_sentence() {
        let model = with(&[Event::set(&KERNEL, "own"), Event::set(&WEIGHTS[4], 0.0)]);
        assert!(model.remark().unwrap().contains("zero") && model.answer((3, 2)) == 0.0);
        assert!(
            KernelStepper::new()
                .update(&Event::set(&WEIGHTS[4], 1e9))
                .is_err()
        );
    }
}
