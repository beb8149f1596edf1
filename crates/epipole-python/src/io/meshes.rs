//! Mesh files with textures.

use super::clouds::take_cloud;
use super::source::{or_raise, write};
use crate::images::rgb;
use crate::register::functions;
use epipole::mvs::{Mesh, MeshTexture};
use epipole::nalgebra::Point2;
use epipole_io::mesh;
use epipole_io::photo::encode_jpeg;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyString;

/// Writes a mesh as PLY, glTF or OBJ, depending on the extension of the file.
///
/// Parameters
/// ----------
/// path : str or os.PathLike
///     Ends in ``.ply``, ``.glb`` or ``.obj``.
/// mesh : epipole.mvs.Mesh
/// texture : epipole.mvs.MeshTexture, optional
///     Replaces the vertex colors, for ``.glb`` and ``.obj``. Material and image of an OBJ file are
///     written to the same folder, with the extensions ``.mtl`` and ``.jpg``.
///
/// Raises
/// ------
/// ValueError
///     If the extension is another one, a PLY file is to get a texture, or a triangle refers to a
///     missing vertex.
#[pyfunction]
#[pyo3(signature = (path, mesh, texture=None))]
fn write_mesh(
    path: &Bound<'_, PyAny>,
    mesh: &Bound<'_, PyAny>,
    texture: Option<&Bound<'_, PyAny>>,
) -> PyResult<()> {
    let mesh = take_mesh(mesh)?;
    let texture = texture
        .map(|texture| take_texture(texture, mesh.triangles.len()))
        .transpose()?;
    let name = path.str()?.to_string();
    let (stem, ending) = name.rsplit_once('.').unwrap_or((&name, ""));
    let bytes = match (ending.to_lowercase().as_str(), &texture) {
        ("ply", None) => mesh::write_mesh_ply(&mesh),
        ("glb", None) => mesh::write_mesh_glb(&mesh),
        ("obj", None) => mesh::write_mesh_obj(&mesh).into_bytes(),
        ("glb", Some(texture)) => {
            let image = or_raise(encode_jpeg(&texture.image))?;
            or_raise(mesh::write_textured_glb(&mesh, texture, &image))?
        }
        ("obj", Some(texture)) => {
            let beside = ["mtl", "jpg"].map(|ending| format!("{stem}.{ending}"));
            let files = beside.each_ref().map(|name| {
                let file = name.rsplit(['/', '\\']).next();
                file.unwrap_or_default()
            });
            let [text, material] = mesh::write_textured_obj(&mesh, texture, files);
            let image = or_raise(encode_jpeg(&texture.image))?;
            write(
                PyString::new(path.py(), &beside[0]).as_any(),
                material.as_bytes(),
            )?;
            write(PyString::new(path.py(), &beside[1]).as_any(), &image)?;
            text.into_bytes()
        }
        ("ply", Some(_)) => {
            let message = "texture: PLY files have colors of vertices only: write .glb or .obj";
            return Err(PyValueError::new_err(message));
        }
        _ => {
            let message = format!("path: {name} does not end in .ply, .glb or .obj");
            return Err(PyValueError::new_err(message));
        }
    };
    write(path, &bytes)
}

/// Reads a mesh and checks that its triangles refer to existing vertices.
///
/// # Errors
/// For other objects, and for a triangle with a missing vertex.
pub(crate) fn take_mesh(mesh: &Bound<'_, PyAny>) -> PyResult<Mesh> {
    let vertices = take_cloud("mesh.vertices", &mesh.getattr("vertices")?)?;
    let triangles: Vec<[u32; 3]> = mesh
        .getattr("triangles")?
        .call_method0("tolist")?
        .extract()?;
    let count = vertices.points.len();
    if let Some(index) = triangles
        .as_flattened()
        .iter()
        .find(|&&n| n as usize >= count)
    {
        let message = format!("mesh.triangles: there is no vertex {index}, only {count} vertices");
        return Err(PyValueError::new_err(message));
    }
    Ok(Mesh {
        vertices,
        triangles,
    })
}

/// Reads the texture of a mesh with this number of triangles.
///
/// # Errors
/// For an invalid image, or a wrong shape of the corners.
fn take_texture(texture: &Bound<'_, PyAny>, num_triangles: usize) -> PyResult<MeshTexture> {
    let image = rgb("texture.image", &texture.getattr("image")?)?;
    let corners: Vec<[[f32; 2]; 3]> = (texture.getattr("corners")?)
        .call_method0("tolist")?
        .extract()?;
    if corners.len() != num_triangles {
        return Err(PyValueError::new_err(format!(
            "texture.corners: {} triangles, but the mesh has {num_triangles}",
            corners.len()
        )));
    }
    let corners = corners.into_iter().map(|list| list.map(Point2::from));
    Ok(MeshTexture {
        image,
        corners: corners.collect(),
    })
}

pub(super) fn register(module: &Bound<'_, PyModule>) -> PyResult<()> {
    functions!(module: write_mesh);
    Ok(())
}
