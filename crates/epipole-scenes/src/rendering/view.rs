//! A scene in one camera: image regions of bodies, and ray tracing.

use super::Sampling;
use super::outline::outline;
use super::shading::{self, Look};
use crate::detail::Detail;
use crate::light::{Decal, LightMap, Lighting, single};
use crate::objects::body::{Body, Placement};
use crate::scene::Scene;
use crate::shape::{Contact, Ray, TOP};
use epipole::camera::PosedCamera;
use nalgebra::{Matrix3, Point2, Vector2, Vector3};

/// Side of the tiles that share a list of candidates, pixels.
pub(super) const TILE: u32 = 8;
const NEAR: f64 = 1e-9;
/// A body in the view of a camera.
struct VisibleBody<'a> {
    body: &'a Body,
    lights: &'a [LightMap],
    origin: Vector3<f64>,
    local_from_cam: Matrix3<f64>,
    /// Scale relative to the modeled size.
    scale: f64,
    /// Pixels that may show it: columns and rows, inclusive.
    columns: (i64, i64),
    rows: (i64, i64),
    /// The same range as left, right, top and bottom.
    edges: [f64; 4],
    /// Lower bound of its depth; infinite for the room, which is behind everything.
    nearest: f64,
    /// Index in the scene.
    number: usize,
}

impl VisibleBody<'_> {
    /// Returns whether the ray through an image point may meet it.
    #[inline(always)]
    fn may_be_at(&self, u: f64, v: f64) -> bool {
        let [left, right, top, bottom] = self.edges;
        (u >= left) & (u <= right) & (v >= top) & (v <= bottom)
    }
}

/// Result of one ray.
#[derive(Clone, Copy, Default)]
pub(super) struct Sample {
    /// Body and chart.
    pub(super) key: u32,
    pub(super) depth_m: f32,
    pub(super) inverse_depth: f32,
    pub(super) color: [f32; 3],
}

/// View of a picture to render.
pub(super) struct View<'a> {
    visible: Vec<VisibleBody<'a>>,
    lighting: &'a Lighting,
    /// Shade of the movable object, its placement, and the index of the body under it.
    shade: Option<(&'a Decal, Placement, usize)>,
    center: Vector3<f64>,
    world_from_cam: Matrix3<f64>,
    principal: Point2<f64>,
    inverse_focal: Vector2<f64>,
    pixel_rad: f64,
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) sampling: Sampling,
}

impl<'a> View<'a> {
    pub(super) fn new(
        scene: &'a Scene,
        camera: &PosedCamera,
        width: u32,
        height: u32,
        sampling: Sampling,
    ) -> Self {
        let center = camera.center_in_world().coords;
        let k = &camera.camera.intrinsics;
        let inverse_focal = Vector2::new(1.0 / k.fu_px(), 1.0 / k.fv_px());
        let cam_from_world = camera.cam_from_world.rotation.to_rotation_matrix();
        let world_from_cam = cam_from_world.matrix().transpose();
        let detail = match sampling {
            Sampling::Draft => Detail::Sketch,
            Sampling::Full => Detail::Full,
        };
        let all = scene.placed().zip(scene.lights(detail)).enumerate().map(
            |(number, ((body, placed), lights))| {
                let (columns, rows, nearest) = outline(camera, body, &placed);
                VisibleBody {
                    body,
                    lights,
                    origin: body.local_point(&center, &placed),
                    local_from_cam: body.local_from_world * (world_from_cam / placed.scale),
                    scale: placed.scale,
                    columns,
                    rows,
                    edges: [columns.0, columns.1, rows.0, rows.1].map(|edge| edge as f64),
                    nearest,
                    number,
                }
            },
        );
        // Sorted front to back; equal depths keep the order of bodies.
        let mut visible: Vec<VisibleBody> = Vec::new();
        for body in all {
            let is_before = |other: &VisibleBody| other.nearest.total_cmp(&body.nearest).is_le();
            visible.insert(visible.partition_point(is_before), body);
        }
        Self {
            lighting: &scene.fixed.lighting,
            shade: scene.shade(detail),
            visible,
            center,
            world_from_cam,
            principal: k.principal_point(),
            inverse_focal,
            pixel_rad: (inverse_focal.x * inverse_focal.y).sqrt(),
            width,
            height,
            sampling,
        }
    }

    /// Collects, for each tile of a row of tiles, the bodies that it may show.
    pub(super) fn candidates(&self, tile_row: u32, lists: &mut Vec<Vec<u16>>) {
        lists.resize(self.width.div_ceil(TILE) as usize, Vec::new());
        lists.iter_mut().for_each(Vec::clear);
        let tile = i64::from(TILE);
        let (top, bottom) = (
            i64::from(tile_row) * tile,
            i64::from(tile_row) * tile + tile - 1,
        );
        for (index, visible) in self.visible.iter().enumerate() {
            if visible.rows.1 < top || visible.rows.0 > bottom {
                continue;
            }
            let first = visible.columns.0.max(0) / tile;
            let last = visible.columns.1.min(i64::from(self.width) - 1);
            if last < 0 {
                continue;
            }
            for list in lists
                .iter_mut()
                .take((last / tile + 1) as usize)
                .skip(first as usize)
            {
                list.push(index as u16);
            }
        }
    }

    /// Traces the ray through an image point among the candidates.
    #[inline]
    pub(super) fn trace(&self, u: f64, v: f64, candidates: &[u16]) -> Sample {
        let x = (u - self.principal.x) * self.inverse_focal.x;
        let y = (v - self.principal.y) * self.inverse_focal.y;
        let rotate = |m: &Matrix3<f64>| {
            Vector3::new(
                m.m11 * x + m.m12 * y + m.m13,
                m.m21 * x + m.m22 * y + m.m23,
                m.m31 * x + m.m32 * y + m.m33,
            )
        };
        let mut nearest = Contact {
            along: f64::INFINITY,
            part: 0,
        };
        let mut found = usize::MAX;
        for &index in candidates {
            let visible = &self.visible[usize::from(index)];
            if visible.nearest > nearest.along {
                break;
            }
            // Some rays of a tile miss some of its candidates.
            if !visible.may_be_at(u, v) {
                continue;
            }
            let ray = Ray {
                origin: visible.origin,
                direction: rotate(&visible.local_from_cam),
            };
            if let Some(contact) = visible.body.shape.meet(&ray, NEAR, nearest.along) {
                nearest = contact;
                found = usize::from(index);
            }
        }
        let Some(visible) = self.visible.get(found) else {
            return Sample {
                key: u32::MAX,
                depth_m: f32::MAX,
                inverse_depth: 0.0,
                color: [0.0; 3],
            };
        };
        let local = visible.origin + rotate(&visible.local_from_cam) * nearest.along;
        let place = visible.body.shape.place(&local, nearest.part);
        let direction_in_world = rotate(&self.world_from_cam);
        let x_in_world = self.center + direction_in_world * nearest.along;
        let decal = match &self.shade {
            // Shade falls on the top of the object's support, not on its sides.
            Some((decal, placed, ground)) if *ground == visible.number && place.chart == TOP => {
                let from_foot = (x_in_world - placed.foot) / placed.scale;
                decal.sample(from_foot.x, from_foot.z)
            }
            _ => None,
        };
        let look = Look {
            x_in_world: single(&x_in_world),
            direction_in_world: single(&direction_in_world),
            pixel_m: (nearest.along * self.pixel_rad / visible.scale) as f32,
            decal,
            smooth: self.sampling == Sampling::Full,
        };
        let color = shading::color(visible.body, visible.lights, &place, self.lighting, &look);
        Sample {
            key: (visible.number as u32) << 8 | place.chart as u32,
            depth_m: nearest.along as f32,
            inverse_depth: 1.0 / nearest.along as f32,
            color,
        }
    }
}
