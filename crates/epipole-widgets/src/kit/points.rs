//! Points that the reader drags, adds and removes. Each keeps its number.

use crate::contract::{Event, Handle};
use crate::kit::probe::Probe;
use nalgebra::Point2;

/// A point with its number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Numbered {
    /// Number, from 1.
    pub(crate) number: usize,
    pub(crate) place: Point2<f64>,
}

/// Numbered points. The handle of number 3 is "p3".
pub(crate) struct Points {
    /// Template of the handles; "#" in its label is replaced by the number.
    kind: Probe,
    /// Minimum number of points.
    fewest: usize,
    /// Points by number.
    points: Vec<Numbered>,
}

impl Points {
    /// Creates points numbered from 1.
    ///
    /// * `fewest`: minimum number of points
    pub(crate) fn new(
        kind: Probe,
        fewest: usize,
        places: impl IntoIterator<Item = Point2<f64>>,
    ) -> Self {
        let points = places.into_iter().enumerate();
        let points = points.map(|(index, place)| Numbered {
            number: index + 1,
            place,
        });
        Self {
            kind,
            fewest,
            points: points.collect(),
        }
    }

    pub(crate) fn len(&self) -> usize {
        self.points.len()
    }

    /// Iterates over the points by number.
    pub(crate) fn iter(&self) -> impl DoubleEndedIterator<Item = &Numbered> {
        self.points.iter()
    }

    pub(crate) fn places(&self) -> Vec<Point2<f64>> {
        self.points.iter().map(|point| point.place).collect()
    }

    pub(crate) fn has(&self, number: usize) -> bool {
        self.points.iter().any(|point| point.number == number)
    }

    fn handle(&self, point: &Numbered) -> Handle {
        let number = point.number.to_string();
        let handle = self.kind.at(point.place.x, point.place.y).handle();
        Handle {
            id: format!("p{number}"),
            label: handle.label.replace('#', &number),
            removable: self.points.len() > self.fewest,
            ..handle
        }
    }

    pub(crate) fn handles(&self) -> Vec<Handle> {
        self.points.iter().map(|point| self.handle(point)).collect()
    }

    /// Moves the point with this number to a position, clamped to its range, or adds it.
    pub(crate) fn put(&mut self, number: usize, x: f64, y: f64) {
        let Some((x, y)) = self.kind.handle().admit(x, y) else {
            return;
        };
        let place = Point2::new(x, y);
        let at = self.points.partition_point(|other| other.number < number);
        match self.points.get_mut(at) {
            Some(point) if point.number == number => point.place = place,
            _ => self.points.insert(at, Numbered { number, place }),
        }
    }

    pub(crate) fn remove(&mut self, number: usize) {
        self.points.retain(|point| point.number != number);
    }

    /// Applies a drag or a removal; returns the number of the point.
    pub(crate) fn update(&mut self, event: &Event) -> Option<usize> {
        let (Event::HandleMoved { id, .. } | Event::HandleRemoved { id }) = event else {
            return None;
        };
        let number = number_of(id).filter(|number| self.has(*number))?;
        match event {
            Event::HandleMoved { x, y, .. } => self.put(number, *x, *y),
            _ => self.remove(number),
        }
        Some(number)
    }
}

/// Parses the number of a handle, such as 3 of "p3".
pub(crate) fn number_of(id: &str) -> Option<usize> {
    let number: usize = id.strip_prefix('p')?.parse().ok()?;
    (id == format!("p{number}")).then_some(number)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_dragged_added_and_removed_and_keep_their_numbers() {
        let kind = Probe::new("p", "plane", "Point # here").over((100, 50));
        let mut points = Points::new(kind, 1, [1.0, 2.0, 3.0].map(|u| Point2::new(u, 9.0)));
        assert_eq!(points.update(&Event::moved("p2", 20.4, 99.0)), Some(2));
        assert_eq!(points.places()[1], Point2::new(20.0, 49.0));
        let gone = Event::HandleRemoved {
            id: "p1".to_owned(),
        };
        assert_eq!(
            (points.update(&gone), points.update(&gone)),
            (Some(1), None)
        );
        points.put(7, 0.0, 0.0);
        points.put(8, f64::NAN, 0.0);
        points.put(5, 4.0, 4.0);
        let numbers: Vec<usize> = points.iter().map(|point| point.number).collect();
        assert_eq!(numbers, [2, 3, 5, 7]);
        let handles = points.handles();
        assert_eq!(
            (&*handles[2].id, &*handles[2].label),
            ("p5", "Point 5 here")
        );
        assert!(handles.iter().all(|handle| handle.removable));
        for number in [3, 5, 7] {
            points.remove(number);
        }
        assert!(!points.handles()[0].removable && points.len() == 1 && points.has(2));
        for id in ["p", "p02", "q1", "p1.0", "p9"] {
            assert_eq!(points.update(&Event::moved(id, 1.0, 1.0)), None, "{id}");
        }
    }
}
