//! Depth of all views for other programs: a cloud with normals, and a surface.

use super::contents::{Export, ExportFormat};
use super::frame::file_from_world;
use crate::tasks::archive::Archive;
use crate::tasks::cloud_vertex::CloudVertex;
use epipole::mvs::{Mesh, MeshTexture};
use epipole::stereo::PointCloud;
use epipole_io::cloud::write_ply;
use epipole_io::mesh::{
    write_mesh_glb, write_mesh_obj, write_mesh_ply, write_textured_glb, write_textured_obj,
};
use epipole_io::photo::encode_jpeg;
use nalgebra::{Point3, Similarity3, Vector3};

/// Returns the surface of all views in the frame of the files; empty without one.
pub(super) fn surface(export: &Export) -> Mesh {
    let mut mesh = Mesh::default();
    if let Some(all_views) = &export.all_views {
        let frame = file_from_world(export);
        for vertex in all_views.vertices() {
            add_point(&mut mesh.vertices, &frame, &vertex);
        }
        mesh.triangles = all_views.triangles().collect();
    }
    mesh
}

/// Adds `fused.ply` and the files of the surface, if there is depth of all views.
///
/// # Errors
/// A message, if a file cannot be written.
pub(super) fn add(
    archive: &mut Archive,
    export: &Export,
    surface: &Mesh,
    texture: Option<&MeshTexture>,
) -> Result<(), String> {
    let Some(all_views) = &export.all_views else {
        return Ok(());
    };
    let frame = file_from_world(export);
    let mut cloud = PointCloud::default();
    for point in all_views.points(1) {
        add_point(&mut cloud, &frame, &point);
        cloud.confidences.push(f32::from(point.num_views));
    }
    archive.add("fused.ply", &write_ply(&cloud))?;
    if surface.triangles.is_empty() {
        return Ok(());
    }
    let name = export.format.mesh();
    if let Some(texture) = texture {
        let image = encode_jpeg(&texture.image).map_err(|error| error.to_string())?;
        if export.format == ExportFormat::Glb {
            let glb = write_textured_glb(surface, texture, &image);
            return archive.add(name, &glb.map_err(|error| error.to_string())?);
        }
        let files = ["mesh.mtl", "texture.jpg"];
        let [text, material] = write_textured_obj(surface, texture, files);
        archive.add(name, text.as_bytes())?;
        archive.add(files[0], material.as_bytes())?;
        return archive.add(files[1], &image);
    }
    match export.format {
        ExportFormat::Glb => archive.add(name, &write_mesh_glb(surface)),
        ExportFormat::Bundler => archive.add(name, write_mesh_obj(surface).as_bytes()),
        _ => archive.add(name, &write_mesh_ply(surface)),
    }
}

fn add_point(cloud: &mut PointCloud, file_from_world: &Similarity3<f64>, point: &CloudVertex) {
    let rotation = file_from_world.isometry.rotation;
    (cloud.points).push(file_from_world * Point3::from(point.position));
    (cloud.normals).push(rotation * Vector3::from(point.normal));
    cloud.colors.push(point.color);
}
