//! `epipole mvs`: depth maps and a cloud of rendered photos against their depths.

use crate::common::{Folder, epipole, fails, json, moved, path, write_model};
use epipole::camera::{PosedCamera, RigidTransform};
use epipole::math::random::Random;
use epipole_io::cloud::read_ply;
use epipole_io::depth_map::read_colmap_depth;
use epipole_io::model::{Model, ModelFormat, ModelImage, ModelPoint, read_model_folder};
use epipole_scenes::Photograph;
use nalgebra::{Point2, Point3, Vector3};
use std::path::Path;

const SIZE: (u32, u32) = (240, 180);
const COUNT: usize = 4;

/// A camera that moves around the table and looks at it.
fn around(n: usize) -> PosedCamera {
    let rotation_vector = Vector3::new(0.05 * (n % 2) as f64, 0.1 * (n as f64 - 1.5), 0.0);
    let pivot = Vector3::new(0.0, 0.0, 1.3);
    let rotation = RigidTransform::new(Vector3::zeros(), rotation_vector);
    moved(
        SIZE,
        &RigidTransform::new(pivot - rotation * pivot, rotation_vector),
    )
}

fn depth_at(photo: &Photograph, pixel: &Point2<f64>) -> Option<f64> {
    let (u, v) = (pixel.x.round(), pixel.y.round());
    let inside = u >= 0.0 && v >= 0.0 && u < f64::from(SIZE.0) && v < f64::from(SIZE.1);
    inside.then(|| f64::from(photo.depth_m.get_pixel(u as u32, v as u32).0[0]))
}

/// The cameras, and points where the photos see them.
fn model(photos: &[Photograph]) -> Model {
    let mut model = Model {
        cameras: vec![around(0).camera],
        ..Model::default()
    };
    for n in 0..COUNT {
        model.images.push(ModelImage {
            id: n as u32 + 1,
            name: format!("{n}.png"),
            camera: 0,
            cam_from_world: around(n).cam_from_world,
            keypoints: Vec::new(),
        });
    }
    let mut random = Random::new(1);
    for n in 0..400 {
        let (photo, from) = (&photos[n % COUNT], around(n % COUNT));
        let pixel = Point2::new(
            random.below(SIZE.0 as usize) as f64,
            random.below(SIZE.1 as usize) as f64,
        );
        let in_cam = from.camera.intrinsics.ray(&pixel) * depth_at(photo, &pixel).unwrap();
        let position = from
            .cam_from_world
            .inverse_transform_point(&Point3::from(in_cam));
        let mut track = Vec::new();
        for (image, photo) in photos.iter().enumerate() {
            let projected = around(image).project(&position).unwrap();
            let depth = (around(image).cam_from_world * position).z;
            let is_visible =
                depth_at(photo, &projected).is_some_and(|z| (z / depth - 1.0).abs() < 0.005);
            if is_visible {
                track.push((image, model.images[image].keypoints.len()));
                model.images[image].keypoints.push(projected);
            }
        }
        model.points.push(ModelPoint {
            id: model.points.len() as u64 + 1,
            position,
            color: [128; 3],
            error_px: None,
            track,
        });
    }
    model
}

/// Distance along the axis of a camera from a point to the surface at its pixel; `None` for points
/// outside of the picture or hidden.
fn miss(photo: &Photograph, camera: &PosedCamera, point: &Point3<f64>) -> Option<f64> {
    let depth = depth_at(photo, &camera.project(point).ok()?)?;
    let miss = ((camera.cam_from_world * point).z - depth).abs();
    (miss < 0.05 * depth).then_some(miss)
}

#[test]
fn photos_of_a_model_become_depth_maps_and_a_cloud() {
    let folder = Folder::new("mvs");
    let names: Vec<String> = (0..COUNT).map(|n| format!("photos/{n}.png")).collect();
    std::fs::create_dir_all(folder.file("photos")).unwrap();
    let photos: Vec<Photograph> = (names.iter().enumerate())
        .map(|(n, name)| folder.write_photo(name, &around(n), SIZE))
        .collect();
    let model = model(&photos);
    let known = folder.file("reconstruction");
    write_model(&model, ModelFormat::ColmapBinary, &known);
    let [images, out] = ["photos", "dense"].map(|name| folder.file(name));
    let base = ["mvs", path(&known), path(&images), "-o", path(&out)];
    let result = json(&base);
    assert_eq!(result["num_depth_maps"], COUNT);
    assert!(result["density"].as_f64().unwrap() > 0.4, "{result}");
    assert!(result["mean_views"].as_f64().unwrap() >= 3.0);
    let (cloud, notes) = read_ply(&std::fs::read(out.join("fused.ply")).unwrap()).unwrap();
    assert_eq!(
        (cloud.points.len() as u64, notes),
        (result["num_points"].as_u64().unwrap(), vec![])
    );
    assert_eq!(cloud.normals.len(), cloud.points.len());
    assert_eq!(cloud.confidences.len(), cloud.points.len());

    let mut errors = Vec::new();
    for (n, photo) in photos.iter().enumerate() {
        let file = out.join(format!("stereo/depth_maps/{n}.png.geometric.bin"));
        let depth = read_colmap_depth(&std::fs::read(file).unwrap()).unwrap();
        let normals = out.join(format!("stereo/normal_maps/{n}.png.geometric.bin"));
        assert!(std::fs::read(normals).unwrap().starts_with(b"240&180&3&"));
        let pairs = depth.as_raw().iter().zip(photo.depth_m.as_raw());
        errors.extend(
            pairs
                .filter(|(z, _)| !z.is_nan())
                .map(|(z, t)| (z / t - 1.0).abs()),
        );
    }
    errors.sort_by(f32::total_cmp);
    let median = errors[errors.len() / 2];
    println!("median error {median:.5} of the depth");
    assert!(median < 0.003, "{median}");
    let sparse = read_model_folder(&|name: &str| std::fs::read(out.join("sparse").join(name)).ok());
    let sparse = sparse.unwrap().unwrap().model;
    assert_eq!(
        sparse.images[1].cam_from_world,
        model.images[1].cam_from_world
    );

    // A surface.
    let surface = json(&[&base[..], &["--mesh", "ply"]].concat());
    assert!(
        surface["num_triangles"].as_u64().unwrap() > 2000,
        "{surface}"
    );
    let (vertices, notes) = read_ply(&std::fs::read(out.join("mesh.ply")).unwrap()).unwrap();
    assert_eq!(
        vertices.points.len() as u64,
        surface["num_vertices"].as_u64().unwrap()
    );
    assert!(notes[0].contains("faces are not read"), "{notes:?}");
    let mut misses: Vec<f64> = (vertices.points.iter())
        .filter_map(|point| miss(&photos[1], &around(1), point))
        .collect();
    misses.sort_by(f64::total_cmp);
    println!(
        "median distance of vertices {:.5} m",
        misses[misses.len() / 2]
    );
    assert!(misses.len() > 500 && misses[misses.len() / 2] < 0.004);
    let few = json(&[&base[..], &["--mesh", "glb", "--voxel-size", "0.05"]].concat());
    assert!(few["num_triangles"].as_u64() < surface["num_triangles"].as_u64());
    assert!(
        std::fs::read(out.join("mesh.glb"))
            .unwrap()
            .starts_with(b"glTF")
    );
    assert!(!out.join("mesh.ply").exists());
    let textured = ["--mesh", "obj", "--voxel-size", "0.02", "--texture"];
    let textured = json(&[&base[..], &textured[..]].concat());
    let sides = [0, 1].map(|n| textured["texture_size"][n].as_u64().unwrap() as u32);
    let texture = image::open(out.join("texture.jpg")).unwrap();
    assert_eq!([texture.width(), texture.height()], sides);
    let text = std::fs::read_to_string(out.join("mesh.obj")).unwrap();
    assert!(text.starts_with("mtllib mesh.mtl\nv ") && text.contains("\nusemtl surface\nf 1/"));
    let material = std::fs::read_to_string(out.join("mesh.mtl")).unwrap();
    assert!(material.contains("map_Kd texture.jpg"), "{material}");
    fails(
        &folder,
        &[&base[..], &["--mesh", "ply", "--texture"]].concat(),
        2,
        "--texture is for --mesh glb and --mesh obj",
    );
    let page = json(&[&base[..], &["--mesh", "html", "--voxel-size", "0.05"]].concat());
    let text = std::fs::read_to_string(out.join("model.html")).unwrap();
    let title = format!("{} triangles</title>", page["num_triangles"]);
    assert!(text.contains(&title), "{title}");
    assert!(page["mesh"].as_str().unwrap().ends_with("model.html"));
    assert!(!out.join("mesh.glb").exists());
    let coarse = ["--mesh", "ply", "--voxel-size", "100"];
    let empty = epipole(&[&base[..], &coarse].concat());
    let stderr = String::from_utf8(empty.stderr).unwrap();
    assert!(
        empty.status.success() && stderr.contains("the mesh is empty"),
        "{stderr}"
    );

    // Twice the same, and at half the size.
    let bytes = std::fs::read(out.join("fused.ply")).unwrap();
    json(&base);
    assert!(std::fs::read(out.join("fused.ply")).unwrap() == bytes);
    let half = json(&[&base[..], &["--max-size", "120"]].concat());
    assert_eq!(half["images"][0]["width"], 120);
    let plain = epipole(&[&base[..], &["--max-size", "120", "--quiet"]].concat());
    let table = String::from_utf8(plain.stdout).unwrap();
    assert!(
        table.contains("4 of 4 images") && plain.stderr.is_empty(),
        "{table}"
    );

    // Without one image.
    std::fs::remove_file(folder.file("photos/3.png")).unwrap();
    let output = epipole(&[&base[..], &["--max-size", "120"]].concat());
    let stderr = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.success() && stderr.contains("1 of 4 images of the model are not in"),
        "{stderr}"
    );
}

#[test]
fn input_without_depth_is_refused() {
    let folder = Folder::new("mvs-bad");
    let cameras: Vec<PosedCamera> = (0..COUNT).map(around).collect();
    folder.write_photos("photos", &cameras, SIZE);
    let render = |n: usize| folder.write_photo(&format!("photos/{n}.png"), &around(n), SIZE);
    let photos: Vec<Photograph> = (0..COUNT).map(render).collect();
    let whole = model(&photos);
    let images = folder.file("photos");
    let out = folder.file("dense");
    let refuse = |name: &str, model: &Model, images: &Path, expected: &str| {
        let known = folder.file(name);
        write_model(model, ModelFormat::ColmapBinary, &known);
        let arguments = ["mvs", path(&known), path(images), "-o", path(&out)];
        fails(&folder, &arguments, 1, expected);
    };
    let pointless = Model {
        points: Vec::new(),
        ..whole.clone()
    };
    refuse(
        "pointless",
        &pointless,
        &images,
        "the model has no points that two images observe",
    );
    let mut single = pointless.clone();
    single.images.truncate(1);
    refuse(
        "single",
        &single,
        &images,
        "needs at least 2 images, but it has 1",
    );
    refuse(
        "elsewhere",
        &whole,
        &folder.file("elsewhere"),
        "none of the model's 4 images is there",
    );
    let mut still = whole.clone();
    for image in &mut still.images {
        image.cam_from_world = around(0).cam_from_world;
    }
    refuse(
        "still",
        &still,
        &images,
        "no two of them show the same points from different places",
    );
    folder.blank("photos/2.png", (180, 240));
    refuse(
        "other",
        &whole,
        &images,
        "the image is 180 × 240, and its camera in the model 240 × 180",
    );
    for n in 0..COUNT {
        folder.blank(&format!("photos/{n}.png"), SIZE);
    }
    refuse(
        "blank",
        &whole,
        &images,
        "no pixel has a depth on which 3 photos agree",
    );
    let known = folder.file("other");
    fails(
        &folder,
        &["mvs", path(&known), "-o", path(&out)],
        2,
        "give IMAGES",
    );
    let zero = [
        "mvs",
        path(&known),
        path(&images),
        "-o",
        path(&out),
        "--num-neighbors",
        "0",
    ];
    fails(
        &folder,
        &zero,
        1,
        "the number of neighbors must be 1 to 16, but is 0",
    );
}
