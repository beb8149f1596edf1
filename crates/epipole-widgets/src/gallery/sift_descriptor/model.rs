//! A keypoint, its window before and after the photograph has changed, and what three fingerprints
//! make of it.

use super::prints::{Change, MIDDLE, Prints, SIGMA_PX};
use super::question::Question;
use crate::contract::{
    Challenge, Compute, Control, Declared, Event, Handle, Job, JobResult, Knob, Model, Problem,
    Settings, Slider, Toggle,
};
use crate::kit::features::SIZE;
use crate::kit::patch::Spot;
use crate::kit::probe::Probe;
use crate::kit::question::{Asked, carry_out};
use epipole::Error;
use epipole::feature::{Descriptors, nearest_few};
use epipole::imaging::{BT601_WEIGHTS, GrayImage32, rgb_to_gray_f32};

const TURN: Slider = Slider::new("turn", "Turn")
    .range(-180.0, 180.0, 5.0)
    .at(40.0)
    .unit("°");
const ZOOM: Slider = Slider::new("zoom", "Scale")
    .range(0.6, 1.8, 0.05)
    .at(1.3)
    .digits(2);
const BRIGHTER: Slider = Slider::new("brighter", "Brighten")
    .range(-120.0, 120.0, 5.0)
    .at(30.0)
    .unit("levels");
const CONTRAST: Slider = Slider::new("contrast", "Contrast")
    .range(0.3, 2.0, 0.05)
    .at(1.0)
    .digits(2)
    .more();
const DIRECTION: Toggle = Toggle::new("direction", "Turn the window").on();
const SCALE: Toggle = Toggle::new("scale", "Scale the window").on();
const KNOBS: &[Knob] = &[
    Knob::Slider(&TURN),
    Knob::Slider(&ZOOM),
    Knob::Slider(&BRIGHTER),
    Knob::Slider(&CONTRAST),
    Knob::Toggle(&DIRECTION),
    Knob::Toggle(&SCALE),
];
/// Where the keypoint is at first.
const PLACE: (f64, f64) = (348.0, 244.0);
/// Features that share so much of the window are no others, pixels.
const OTHERS_BEYOND_PX: f64 = 12.0;

/// A window of a photograph and its fingerprints.
pub(super) struct Look {
    pub(super) piece: GrayImage32,
    pub(super) prints: Prints,
}

impl Look {
    /// Its window in the piece, pixels.
    pub(super) fn spot(&self) -> Spot {
        Spot {
            place: [MIDDLE; 2],
            scale_px: self.prints.scale_px,
            angle_rad: self.prints.angle_rad,
        }
    }
}

/// How far a fingerprint is from its original, in its own unit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Distance {
    pub(super) original: f64,
    /// From the nearest one of another place.
    pub(super) other: f64,
}

impl Distance {
    /// As in the ratio test.
    pub(super) fn ratio(&self) -> f64 {
        self.original / self.other.max(1e-9)
    }
}

/// All that follows from the state.
pub(super) struct Compared {
    place: (f64, f64),
    finds_direction: bool,
    /// Before and after.
    pub(super) looks: [Look; 2],
    pub(super) distances: [Distance; 3],
}

/// The model of `sift-descriptor`.
pub(crate) struct SiftDescriptor {
    settings: Settings,
    asked: Asked<Question>,
    probe: Probe,
    known: Option<(GrayImage32, [Descriptors; 3])>,
    compared: Option<Compared>,
    version: u64,
}

impl SiftDescriptor {
    pub(super) fn asked(&self) -> &Asked<Question> {
        &self.asked
    }

    pub(super) fn place(&self) -> (f64, f64) {
        self.probe.place(SIZE)
    }

    pub(super) fn compared(&self) -> Option<&Compared> {
        self.compared.as_ref()
    }

    /// Changes whenever the pieces do.
    pub(super) fn version(&self) -> u64 {
        self.version
    }

    pub(super) fn change(&self) -> Change {
        Change {
            turn_rad: self.settings.number(&TURN).to_radians(),
            zoom: self.settings.number(&ZOOM),
            brighter: self.settings.number(&BRIGHTER) / 255.0,
            contrast: self.settings.number(&CONTRAST),
        }
    }

    fn ratio(&self, way: usize) -> Option<f64> {
        Some(self.compared()?.distances[way].ratio())
    }

    /// Looks at both photographs anew, at the one before the change only if it is another place.
    fn look(&mut self) {
        self.version += 1;
        let (place, finds_direction) = (self.place(), self.settings.flag(&DIRECTION));
        let is_same = |old: &Compared| old.place == place && old.finds_direction == finds_direction;
        let before = self.compared.take().filter(is_same);
        let before = before.map(
            |Compared {
                 looks: [before, _], ..
             }| before,
        );
        self.compared = self.compare(before).ok().flatten();
    }

    fn compare(&self, before: Option<Look>) -> Result<Option<Compared>, Error> {
        let (Some((gray, others)), Some(answer)) = (&self.known, self.asked.answer()) else {
            return Ok(None);
        };
        let (change, place) = (self.change(), self.place());
        let finds_direction = self.settings.flag(&DIRECTION);
        let scale_px = match self.settings.flag(&SCALE) {
            true => SIGMA_PX * change.zoom,
            false => SIGMA_PX,
        };
        let look = |change: Change, scale_px: f64| -> Result<Look, Error> {
            let piece = change.piece(gray, place)?;
            let middle = [(MIDDLE, MIDDLE)];
            let prints = Prints::of(&piece, &middle, scale_px, finds_direction)?;
            Ok(Look { piece, prints })
        };
        let before = before.map_or_else(|| look(Change::NONE, SIGMA_PX), Ok)?;
        let looks = [before, look(change, scale_px)?];
        let mut distances = [Distance {
            original: 0.0,
            other: 0.0,
        }; 3];
        for (way, distance) in distances.iter_mut().enumerate() {
            let [before, after] = looks.each_ref().map(|look| &look.prints.lists[way]);
            let query = after.get(0).unwrap_or_default();
            let original = nearest_few(&query, before, 1)?;
            let ranked = nearest_few(&query, &others[way], others[way].len())?;
            let is_other = |(index, _): &&(usize, f32)| {
                let (u, v) = answer.places[*index];
                libm::hypot(u - place.0, v - place.1) > OTHERS_BEYOND_PX
            };
            let in_units = |found: Option<&(usize, f32)>| {
                Prints::in_units(way, found.map_or(0.0, |(_, far)| f64::from(*far)))
            };
            *distance = Distance {
                original: in_units(original.first()),
                other: in_units(ranked.iter().find(is_other)),
            };
        }
        Ok(Some(Compared {
            place,
            finds_direction,
            looks,
            distances,
        }))
    }
}

impl Declared for SiftDescriptor {
    const NAME: &'static str = "sift-descriptor";
    const TITLE: &'static str = "A fingerprint that lasts";
    const HELP: &'static str = "Drag the keypoint over the photograph, then turn, scale and brighten the \
        photograph. The bars say how far each fingerprint is from its original, as a share of the distance \
        to the nearest other feature: below 0.8, it would be recognized.";
    const COMPUTE: Compute = carry_out::<Question>;
    const CHALLENGES: &'static [Challenge<Self>] = CHALLENGES;

    fn new() -> Self {
        Self {
            settings: Settings::new(KNOBS),
            asked: Asked::about(Question),
            probe: Probe::new("keypoint", "photograph", "Keypoint").at(PLACE.0, PLACE.1),
            known: None,
            compared: None,
            version: 0,
        }
    }
}

impl Model for SiftDescriptor {
    fn controls(&self) -> Vec<Control> {
        self.settings.controls()
    }

    fn handles(&self) -> Vec<Handle> {
        vec![self.probe.handle(SIZE, 4.0)]
    }

    fn update(&mut self, event: &Event) -> Result<(), Problem> {
        let mut has_changed = self.probe.update(event, SIZE);
        if let Event::Set { id, value } = event {
            has_changed |= self.settings.set(id, value)? == Some(true);
        }
        if has_changed {
            self.look();
        }
        Ok(())
    }

    fn job(&self) -> Option<&dyn Job> {
        self.asked.job()
    }

    fn job_done(&mut self, result: JobResult) {
        if self.asked.take(result)
            && let Some(answer) = self.asked.answer()
        {
            let gray = rgb_to_gray_f32(answer.photograph.image(), &BT601_WEIGHTS);
            self.known = answer.lists().map(|lists| (gray, lists));
            self.look();
        }
    }
}

const CHALLENGES: &[Challenge<SiftDescriptor>] = &[
    Challenge {
        id: "light-only",
        goal: "Change the photograph so that the normalized patch is recognized and the raw one is not.",
        hint: "Undo what moves pixels, keep what changes their values.",
        why: "Subtracting the mean and dividing by the spread removes brightness and contrast, and nothing \
              else.",
        check: |model| match (model.ratio(0), model.ratio(1)) {
            (Some(raw), Some(normalized)) => raw > 0.8 && normalized < 0.5,
            _ => false,
        },
        solution: || {
            vec![
                Event::set(&TURN, 0.0),
                Event::set(&ZOOM, 1.0),
                Event::set(&BRIGHTER, 60.0),
            ]
        },
    },
    Challenge {
        id: "lost",
        goal: "Leave the scale at 1 or above and make SIFT lose the keypoint.",
        hint: "Its window follows the photograph because two things were found out first.",
        why: "The 128 numbers themselves know nothing of turning: the window must be turned before they are \
              counted.",
        check: |model| {
            model.change().zoom >= 1.0 && model.ratio(2).is_some_and(|ratio| ratio > 0.8)
        },
        solution: || vec![Event::set(&DIRECTION, false), Event::set(&TURN, 90.0)],
    },
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::question::settled;

    #[test]
    fn sift_survives_what_patches_do_not() {
        let mut model: SiftDescriptor = settled(&[]);
        let [raw, normalized, sift] = model.compared().unwrap().distances;
        assert!(sift.ratio() < 0.6 && normalized.ratio() > 0.8 && raw.ratio() > 0.8);
        // Nothing changed: nothing differs.
        for (knob, value) in [(&TURN, 0.0), (&ZOOM, 1.0), (&BRIGHTER, 0.0)] {
            model.update(&Event::set(knob, value)).unwrap();
        }
        assert!(
            model
                .compared()
                .unwrap()
                .distances
                .iter()
                .all(|d| d.original == 0.0 && d.other > 0.0)
        );
        // A right angle moves pixels onto pixels, up to the interpolation at the middle.
        model.update(&Event::set(&TURN, 90.0)).unwrap();
        let turned = model.compared().unwrap();
        let angles = turned.looks.each_ref().map(|look| look.prints.angle_rad);
        let apart = libm::remainder(angles[1] - angles[0], std::f64::consts::TAU);
        assert!(
            (apart - std::f64::consts::FRAC_PI_2).abs() < 1e-3,
            "{apart}"
        );
        assert!(
            turned.distances[2].original < 0.02,
            "{:?}",
            turned.distances
        );
    }
}
