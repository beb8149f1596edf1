//! Scene of the 3D view: points, cameras, photographs and the grid of the floor.

use super::cloud::CloudView;
use super::ground::grid;
use super::marks::{add_dense, dense_keys, frustum, standing};
use super::scene_inputs::{Coloring, Made};
use super::shade::Shade;
use super::steer::frame;
use crate::project::{Key, Project};
use crate::tasks::Component;
use epipole_canvas::cloud::Orbit;
use epipole_canvas::theme::{Role, Theme};

/// Length of a frustum, relative to the distance of the first view.
const REACH: f64 = 0.06;

impl CloudView {
    pub(super) fn make(
        &mut self,
        project: &Project,
        component: &Component,
        key: Key,
        theme: Theme,
    ) {
        let made = Made {
            key,
            component: project.view().component,
            coloring: self.coloring,
            theme,
            photographs: match self.photographs {
                true => (project.taking_part().into_iter())
                    .filter(|photo| project.shown(photo).is_some())
                    .count(),
                false => 0,
            },
            growing: (project.component().is_none()).then(|| component.num_registered()),
            layers: self.layers(project),
            cameras: self.cameras,
            grid: self
                .grid
                .then(|| project.scale().map_or(1.0, |scale| scale.meters_per_unit)),
            through: self.through.as_ref().map(|through| through.photo),
            crop: project.crop().copied(),
            deleted: project.document().deleted.clone(),
            selected: self.selection.points.clone(),
            dense: dense_keys(project),
            floor: project.floor(),
        };
        if self.made.as_ref() == Some(&made) {
            return;
        }
        let same_place = self.made.as_ref().is_some_and(|before| {
            (before.key, before.component, before.growing)
                == (made.key, made.component, made.growing)
                && before.floor == made.floor
        });
        // A growing reconstruction keeps its viewing direction.
        let side = (self.made.as_ref())
            .filter(|before| before.growing.is_some() && before.key == made.key)
            .and(self.orbit);
        self.scene.points.clear();
        self.scene.triangles.clear();
        let shade = Shade {
            kept: project.remaining(),
            selected: project.members(&self.selection.points),
            color: theme.color(Role::Grip),
        };
        let shared = component.points.iter().filter(|_| made.layers.sparse);
        self.scene.points.extend(shared.map(|point| {
            let color = match self.coloring {
                Coloring::Photographs => point.color,
                Coloring::Error => theme.scale(point.error_px / 2.0),
                Coloring::Track => theme.scale(point.track.len() as f64 / 8.0),
            };
            shade.point(point, color)
        }));
        self.num_shared = self.scene.points.len();
        self.scene.first_vertex = self.num_shared;
        if self.dense {
            add_dense(&mut self.scene, project, self.surface, &shade);
        }
        let mut sum = nalgebra::Vector3::zeros();
        for camera in component.cameras.iter().flatten() {
            let [_, _, cu, cv] = camera.intrinsics;
            let down = camera.ray([cu, cv + 1000.0]) - camera.ray([cu, cv]);
            sum += down.normalize();
        }
        if let Some(floor) = made.floor {
            sum = -floor.up;
        }
        if !same_place || self.orbit.is_none() {
            let mut orbit = Orbit::around(&self.scene, sum.into());
            frame(&mut orbit, component, &shade.kept, side);
            self.orbit = Some(orbit);
            self.reach = orbit.distance * REACH;
            self.through = None;
            self.point = None;
        }
        let reach = self.reach;
        let color = theme.color(Role::Series(1));
        self.scene.lines.clear();
        self.scene.pictures.clear();
        let cameras = project.taking_part().into_iter().zip(&component.cameras);
        for (photo, camera) in cameras.filter(|_| made.cameras) {
            if let (Some(camera), Some(size)) = (camera, project.camera(photo)) {
                frustum(
                    &mut self.scene.lines,
                    camera,
                    (size.width, size.height),
                    reach,
                    color,
                );
                if self.photographs
                    // It would hide all that its camera sees.
                    && made.through != Some(photo.id)
                    && let Some(pixels) = project.shown(photo)
                {
                    let size = (size.width, size.height);
                    let picture = standing(camera, size, reach, &pixels.small);
                    self.scene.pictures.push(picture);
                }
            }
        }
        if let (Some(floor), Some(meters_per_unit)) = (&made.floor, made.grid) {
            let places = self.scene.points.iter().map(|(place, _)| *place);
            let color = theme.color(Role::Edge);
            grid(&mut self.scene.lines, floor, places, meters_per_unit, color);
        }
        self.num_fixed_lines = self.scene.lines.len();
        self.made = Some(made);
        self.drawn = None;
    }
}
