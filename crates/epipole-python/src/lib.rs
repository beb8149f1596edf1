//! Native module of the Python package `epipole`.
//!
//! Paths are those of the library: `epipole::epipolar::sampson_px` is `epipole.epipolar.sampson_px`
//! in Python. Each folder or file below is a module of the library and registers its functions
//! and classes itself.
//!
//! | module | content |
//! |---|---|
//! | [`arrays`] | NumPy arrays to points and matrices, and back |
//! | [`errors`] | errors of the library as exceptions |
//! | [`fork`] | threads in forked processes |
//! | [`images`] | NumPy images to images of the library, and back |
//! | [`options`] | keyword options to the library's option structs |
//! | [`progress`] | long computations without the GIL, progress, Ctrl-C |
//! | [`record`] | `repr`, equality and pickling of classes |
//! | [`register`] | registration of classes and functions in a module |
//! | [`threads`] | number of threads for a block of Python |

mod absolute_pose;
mod arrays;
mod calibration;
mod camera;
mod epipolar;
mod errors;
mod feature;
mod fork;
mod homography;
mod images;
mod imaging;
mod io;
mod math;
mod mvs;
mod optim;
mod options;
mod progress;
mod record;
mod register;
mod robust;
mod sfm;
mod steps;
mod stereo;
mod stitch;
mod synthetic;
mod threads;
mod triangulation;
mod two_view;

use pyo3::prelude::*;

/// Adds functions and classes to a module.
type Register = fn(&Bound<'_, PyModule>) -> PyResult<()>;

/// The library's modules, in its order.
const MODULES: [(&str, Register); 18] = [
    ("camera", camera::register),
    ("robust", robust::register),
    ("epipolar", epipolar::register),
    ("homography", homography::register),
    ("absolute_pose", absolute_pose::register),
    ("triangulation", triangulation::register),
    ("two_view", two_view::register),
    ("imaging", imaging::register),
    ("feature", feature::register),
    ("stereo", stereo::register),
    ("calibration", calibration::register),
    ("sfm", sfm::register),
    ("mvs", mvs::register),
    ("stitch", stitch::register),
    ("math", math::register),
    ("optim", optim::register),
    ("synthetic", synthetic::register),
    ("io", io::register),
];

#[pymodule]
fn _epipole(package: &Bound<'_, PyModule>) -> PyResult<()> {
    let loaded = package.py().import("sys")?.getattr("modules")?;
    package.add("__version__", env!("CARGO_PKG_VERSION"))?;
    errors::register(package)?;
    fork::register(package)?;
    threads::register(package)?;
    for (name, register) in MODULES {
        let path = format!("epipole.{name}");
        let module = PyModule::new(package.py(), &path)?;
        register(&module)?;
        package.add(name, &module)?;
        // Lets `from epipole.camera import Camera` find the module, which has no file.
        loaded.set_item(path, module)?;
    }
    Ok(())
}
