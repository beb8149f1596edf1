//! Code that estimates the depth of all views and their surface, as `epipole mvs` does.

use super::all_views::FuseViews;
use super::cloud_vertex::CloudVertex;
use super::convert::sentence;
use super::dense_cloud::DenseCloud;
use super::task::{Monitor, Progress, Run};
use epipole::Error;
use epipole::mvs::{
    DepthMap, Mesh, MeshOptions, MvsOptions, estimate_depth_maps, fuse_depth_maps, mesh_depth_maps,
    prepare_views,
};
use epipole::progress::{Part, Status};
use epipole::sfm::Reconstruction;
use epipole::stereo::PointCloud;
use image::RgbImage;
use nalgebra::Point3;

/// Progress after which views are prepared, depth maps estimated and points fused.
const PREPARED: f32 = 0.02;
const ESTIMATED: f32 = 0.77;
const FUSED: f32 = 0.8;

/// Edge of a voxel, pixels of the depth maps.
const VOXEL_PX: f64 = 1.5;
/// Number of pixels with a depth up to which voxels have this edge: 0.8 million triangles, which a
/// browser draws in a tenth of a second.
const MAX_FINE_PIXELS: f64 = 2e6;

impl Run for FuseViews {
    fn run(self, monitor: Monitor<'_>) -> Result<DenseCloud, String> {
        let full = |n: usize| {
            self.photographs[n]
                .as_ref()
                .map_or((1, 1), |photo| photo.from)
        };
        let sizes = (0..self.photographs.len()).map(full);
        let mut known = self.component.to_core(sizes)?;
        let mut photos = Vec::new();
        let mut pixel_px = 1.0_f64;
        for (camera, photo) in known.cameras.iter_mut().zip(&self.photographs) {
            let (Some(posed), Some(photo)) = (camera, photo) else {
                photos.push(RgbImage::new(0, 0));
                continue;
            };
            let size = (photo.width, photo.height);
            let camera = &mut posed.camera;
            camera.intrinsics = (camera.intrinsics)
                .resized(photo.from, size)
                .map_err(sentence)?;
            (camera.width, camera.height) = size;
            pixel_px = pixel_px.max(f64::from(photo.from.0) / f64::from(size.0.max(1)));
            let image = RgbImage::from_raw(size.0, size.1, photo.rgb.to_vec());
            photos.push(image.ok_or("a photograph did not arrive whole")?);
        }
        let longer = photos.iter().map(|photo| photo.width().max(photo.height()));
        // The photographs are downscaled already.
        let options = MvsOptions::default().with_max_size_px(longer.max().unwrap_or(0).max(32));
        let mut watch =
            |status: Status| monitor(Progress::Share(status.fraction, status.stage.words()));
        let part = &mut Part::new(&mut watch, 0.0, PREPARED);
        let views = prepare_views(&known, &photos, &options, part)
            .map_err(|error| why_no_views(error, &known, &options))?;
        drop(photos);
        let part = &mut Part::new(&mut watch, PREPARED, ESTIMATED);
        let maps = estimate_depth_maps(&views, &options, part).map_err(sentence)?;
        let part = &mut Part::new(&mut watch, ESTIMATED, FUSED);
        let cloud = fuse_depth_maps(&views, &maps, &options, part).map_err(sentence)?;
        if cloud.points.is_empty() {
            return Err(format!(
                "no pixel has a depth on which {} photographs agree: take more photographs that overlap, of surfaces \
                 with texture",
                options.min_views.min(views.len())
            ));
        }
        let num_known = num_known(&maps);
        let num_pixels: usize = maps.iter().map(|map| map.num_views.len()).sum();
        let coarser = libm::sqrt(num_known as f64 / MAX_FINE_PIXELS).max(1.0);
        let mesh_options = MeshOptions::default().with_voxel_size_px(VOXEL_PX * coarser);
        let part = &mut Part::new(&mut watch, FUSED, 1.0);
        let mesh = match mesh_depth_maps(&views, &maps, &mesh_options, part) {
            // Depths that differ by orders of magnitude need too many voxels: only the points
            // remain.
            Err(Error::OutOfRange { .. }) => Mesh::default(),
            mesh => mesh.map_err(sentence)?,
        };
        let triangles = mesh.triangles.as_flattened().iter();
        let sizes = views.iter().map(|view| view.image.dimensions());
        Ok(DenseCloud {
            num_maps: views.len() as u32,
            num_registered: known.num_registered() as u32,
            size: sizes
                .max_by_key(|(width, height)| width * height)
                .unwrap_or((0, 0)),
            pixel_px,
            density: num_known as f64 / num_pixels.max(1) as f64,
            points: bytes_of(&cloud).into(),
            vertices: bytes_of(&mesh.vertices).into(),
            triangles: triangles
                .flat_map(|vertex| vertex.to_le_bytes())
                .collect::<Vec<u8>>()
                .into(),
        })
    }
}

/// Counts pixels with a depth.
fn num_known(maps: &[DepthMap]) -> usize {
    let counts = maps.iter().flat_map(|map| &map.num_views);
    counts.filter(|count| **count > 0).count()
}

fn bytes_of(cloud: &PointCloud) -> Vec<u8> {
    let vertex = |(index, place): (usize, &Point3<f64>)| CloudVertex {
        position: place.coords.into(),
        normal: cloud.normals[index].into(),
        color: cloud.colors[index],
        num_views: cloud.confidences.get(index).map_or(0, |count| *count as u8),
    };
    let vertices = cloud.points.iter().enumerate().map(vertex);
    vertices.flat_map(CloudVertex::to_bytes).collect()
}

/// Explains why no photograph has a neighbor.
fn why_no_views(error: Error, known: &Reconstruction, options: &MvsOptions) -> String {
    let (Error::Degenerate { .. }, Some(widest)) = (&error, widest_deg(known)) else {
        return sentence(error);
    };
    match widest < options.min_angle_deg {
        true => format!(
            "all photographs that show the same points were taken from nearly the same place, {widest:.1}° apart: take \
             some with steps to the side"
        ),
        false => sentence(error),
    }
}

/// Returns the widest angle between two rays to a point, degrees; `None` if no two photographs
/// share a point.
fn widest_deg(known: &Reconstruction) -> Option<f64> {
    let center = |image: u32| {
        let posed = known.cameras.get(image as usize)?.as_ref()?;
        Some(posed.cam_from_world.inverse() * Point3::origin())
    };
    let mut widest = None::<f64>;
    for point in &known.points {
        let rays: Vec<_> = (point.track.iter())
            .filter_map(|element| Some(center(element.image)? - point.position))
            .collect();
        for (n, first) in rays.iter().enumerate() {
            for second in &rays[n + 1..] {
                let angle = first.angle(second).to_degrees();
                widest = Some(widest.map_or(angle, |widest| widest.max(angle)));
            }
        }
    }
    widest
}
