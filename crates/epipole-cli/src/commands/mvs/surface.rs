//! The mesh of `epipole mvs` and its files.

use super::arguments::{Arguments, MeshFormat};
use crate::context::Context;
use crate::failure::Failure;
use crate::report::Report;
use epipole::mvs::{
    DepthMap, Mesh, MeshTexture, MvsView, TextureOptions, mesh_depth_maps, texture_mesh,
};
use epipole::progress::{Monitor, Part};
use epipole_io::mesh::{
    write_mesh_glb, write_mesh_obj, write_mesh_ply, write_textured_glb, write_textured_obj,
};
use epipole_io::model::Model;
use epipole_io::photo::encode_jpeg;
use std::path::PathBuf;

/// Progress when the mesh is known.
const MESHED: f32 = 0.6;

/// A mesh, its texture if requested, and the format of its files.
pub(super) struct Surface {
    mesh: Mesh,
    texture: Option<MeshTexture>,
    format: MeshFormat,
}

impl Surface {
    /// # Errors
    /// `--texture` for a format without textures.
    pub(super) fn check(arguments: &Arguments) -> Result<(), Failure> {
        match (arguments.texture, arguments.mesh) {
            (true, Some(MeshFormat::Ply | MeshFormat::Html)) => Err(Failure::usage(
                "--texture is for --mesh glb and --mesh obj: the other files have colors of vertices",
            )),
            _ => Ok(()),
        }
    }

    /// Makes the mesh of `--mesh`, if given. Warns of an empty one.
    ///
    /// # Errors
    /// As [`mesh_depth_maps`] and [`texture_mesh`].
    pub(super) fn of(
        arguments: &Arguments,
        views: &[MvsView],
        maps: &[DepthMap],
        context: &Context,
        monitor: &mut dyn Monitor,
    ) -> Result<Option<Self>, Failure> {
        let Some(format) = arguments.mesh else {
            return Ok(None);
        };
        let part = &mut Part::new(monitor, 0.0, MESHED);
        let mesh = mesh_depth_maps(views, maps, &arguments.mesh_options(), part)?;
        let is_empty = mesh.triangles.is_empty();
        if is_empty {
            context.warn(
                "the mesh is empty: no connected piece has enough triangles; try a smaller --voxel-size or \
                 --min-triangles",
            );
        }
        let part = &mut Part::new(monitor, MESHED, 1.0);
        let texture = (arguments.texture && !is_empty)
            .then(|| texture_mesh(&mesh, views, &TextureOptions::default(), part))
            .transpose()?;
        Ok(Some(Self {
            mesh,
            texture,
            format,
        }))
    }

    /// Names and contents of the files, that of the mesh first.
    ///
    /// # Errors
    /// As [`Model::to_html`] and [`encode_jpeg`].
    pub(super) fn files(&self, model: &Model) -> Result<Vec<(&'static str, Vec<u8>)>, Failure> {
        let mesh = &self.mesh;
        if let Some(texture) = &self.texture {
            let image = encode_jpeg(&texture.image)?;
            return Ok(match self.format {
                MeshFormat::Obj => {
                    let [material_file, image_file] = ["mesh.mtl", "texture.jpg"];
                    let [text, material] =
                        write_textured_obj(mesh, texture, [material_file, image_file]);
                    vec![
                        ("mesh.obj", text.into_bytes()),
                        (material_file, material.into_bytes()),
                        (image_file, image),
                    ]
                }
                _ => vec![("mesh.glb", write_textured_glb(mesh, texture, &image)?)],
            });
        }
        Ok(vec![match self.format {
            MeshFormat::Ply => ("mesh.ply", write_mesh_ply(mesh)),
            MeshFormat::Glb => ("mesh.glb", write_mesh_glb(mesh)),
            MeshFormat::Obj => ("mesh.obj", write_mesh_obj(mesh).into_bytes()),
            MeshFormat::Html => ("model.html", model.to_html(mesh)?),
        }])
    }

    /// Adds the numbers of the mesh and its files.
    pub(super) fn report(&self, report: Report, files: &[PathBuf]) -> Report {
        let (num_triangles, num_vertices) =
            (self.mesh.triangles.len(), self.mesh.vertices.points.len());
        let mut report = report.row(
            "mesh",
            format!("{num_triangles} triangles, {num_vertices} vertices"),
        );
        if let Some(texture) = &self.texture {
            let (width, height) = texture.image.dimensions();
            report = report
                .row("texture", format!("{width} × {height}"))
                .field("texture_size", [width, height]);
        }
        for file in files {
            report = report.row("written", file.display());
        }
        report
            .field("num_triangles", num_triangles)
            .field("num_vertices", num_vertices)
            .field("mesh", files.first().map(|file| file.display().to_string()))
    }
}
