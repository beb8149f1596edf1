//! Meshes from depth maps, and their textures.

use super::cloud::Cloud;
use crate::argument::{Argument, check_keys, entry};
use crate::fault::{Fault, Result};
use crate::functions::functions;
use crate::options::Options;
use crate::output::{Floats, Indices, Output, structs};
use crate::types::Types;
use crate::value::Value;
use epipole::image::RgbImage;
use epipole::mvs::{self, DepthMap, Mesh, MeshOptions, MvsView, TextureOptions};

structs! {
    /// Triangle mesh.
    struct Surface as Mesh {
        /// Vertices with normals and colors.
        vertices: Cloud,
        /// Indices of the vertices, 3 for each triangle, counterclockwise as seen from outside.
        triangles: Indices,
    }

    /// Texture of a mesh.
    struct Texture as MeshTexture {
        /// Pixels; black where no triangle needs them.
        image: RgbImage,
        /// Pixel of each corner of each triangle, in the order of its vertices, interleaved; pixel
        /// centers are at integers.
        corners: Floats,
    }
}

impl Output for Mesh {
    fn typescript(types: &mut Types) -> String {
        Surface::typescript(types)
    }

    fn into_value(self) -> Value {
        let triangles = self.triangles.as_flattened().iter();
        let surface = Surface {
            triangles: Indices(triangles.map(|&index| index as usize).collect()),
            vertices: Cloud(self.vertices),
        };
        surface.into_value()
    }
}

impl Argument for Mesh {
    fn typescript(types: &mut Types) -> String {
        let cloud = <Cloud as Argument>::typescript(types);
        let indices = <Indices as Argument>::typescript(types);
        types.interface(
            "MeshLike",
            "Triangle mesh.",
            &[
                ("vertices", &cloud, "Vertices."),
                (
                    "triangles",
                    &indices,
                    "Indices of the vertices, 3 for each triangle, counterclockwise as seen from \
                     outside.",
                ),
            ],
        );
        "MeshLike".to_owned()
    }

    fn read(name: &str, value: &Value) -> Result<Self> {
        check_keys(name, value, &["vertices", "triangles"])?;
        let Indices(corners) = entry(name, value, "triangles")?;
        if corners.len() % 3 != 0 {
            return Err(Fault::of_range(format!(
                "{name}.triangles must have 3 numbers for each triangle, but has {} numbers",
                corners.len()
            )));
        }
        let triangles = corners.chunks_exact(3);
        Ok(Self {
            vertices: entry::<Cloud>(name, value, "vertices")?.0,
            triangles: triangles
                .map(|corners| [0, 1, 2].map(|corner| corners[corner] as u32))
                .collect(),
        })
    }
}

functions! {
    /// Mesh of depth maps, with normals and colors; it has holes where no photo shows the surface.
    fn mesh_depth_maps(
        views: Vec<MvsView>, maps: Vec<DepthMap>, options: Options<MeshOptions>; monitor
    ) -> Mesh {
        mvs::mesh_depth_maps(&views, &maps, &options.0, monitor)?
    }

    /// Texture of a mesh from the photos: each triangle takes its pixels from one of them, with few
    /// seams.
    fn texture_mesh(
        mesh: Mesh, views: Vec<MvsView>, options: Options<TextureOptions>; monitor
    ) -> Texture {
        let found = mvs::texture_mesh(&mesh, &views, &options.0, monitor)?;
        let corners = found.corners.as_flattened().iter();
        Texture {
            image: found.image,
            corners: Floats(corners.flat_map(|corner| [corner.x, corner.y]).collect()),
        }
    }
}
