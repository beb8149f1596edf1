//! The depth of pairs: what it depends on, what there is of it, and which of it is part of the
//! cloud.

use super::Project;
use super::document::Given;
use super::keys::Key;
use crate::tasks::{CameraFound, Dense, Request};
use std::rc::Rc;

impl Project {
    /// The name of a pair's depth; `None` unless both have a camera in the part that is looked at.
    pub fn depth_key(&self, first: &Given, second: &Given) -> Option<Key> {
        self.cameras_of(first, second)?;
        let photographs = (self.photograph_key(first).0, self.photograph_key(second).0);
        let (reconstruction, part) = (self.reconstruction_key()?.0, self.view.component);
        let options = self.document.settings.depth;
        Some(Key::of(&(
            "depth",
            photographs,
            reconstruction,
            part,
            options,
        )))
    }

    /// The depth of a pair, if it is there; the first stands before the second in the list.
    pub fn depth(&self, first: &Given, second: &Given) -> Option<&Rc<Dense>> {
        self.results.depth(self.depth_key(first, second)?)
    }

    /// Why the depth of a pair cannot be found, if it is known.
    pub fn depth_failure(&self, first: &Given, second: &Given) -> Option<&str> {
        self.failure(self.depth_key(first, second)?)
    }

    /// The pairs whose depth is part of the cloud and is there, with its name.
    pub fn dense_pairs(&self) -> Vec<(Key, &Given, &Given, &Rc<Dense>)> {
        let pairs = self.document.dense.iter();
        let ready = |pair: &(u32, u32)| {
            let (first, second) = self.document.pair(*pair)?;
            let key = self.depth_key(first, second)?;
            Some((key, first, second, self.results.depth(key)?))
        };
        pairs.filter_map(ready).collect()
    }

    fn cameras_of(&self, first: &Given, second: &Given) -> Option<[CameraFound; 2]> {
        let cameras = &self.component()?.cameras;
        let camera = |photo: &Given| *cameras.get(self.place(photo.id)?)?;
        Some([camera(first)?, camera(second)?])
    }

    pub(super) fn depth_request(&self, first: &Given, second: &Given) -> Option<Request> {
        let component = self.component()?;
        let places = [self.place(first.id)? as u32, self.place(second.id)? as u32];
        let is_shared = |track: &[(u32, u32)]| {
            places
                .iter()
                .all(|place| track.iter().any(|(image, _)| image == place))
        };
        let points = component
            .points
            .iter()
            .filter(|point| is_shared(&point.track));
        Some(Request::Depth {
            photographs: [
                (**self.photograph(first)?).clone(),
                (**self.photograph(second)?).clone(),
            ],
            cameras: self.cameras_of(first, second)?,
            lens: component.lens,
            points: points.map(|point| point.position).collect(),
            options: self.document.settings.depth,
        })
    }

    /// A pair's name in files: those of both photographs without their endings.
    pub(super) fn pair_name(first: &Given, second: &Given) -> String {
        let stem = |name: &str| {
            name.rsplit_once('.')
                .map_or(name, |(stem, _)| stem)
                .to_owned()
        };
        format!("{}_{}", stem(&first.name), stem(&second.name))
    }
}
