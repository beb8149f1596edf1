//! The window, on a virtual display: it opens, draws with OpenGL, is clicked, and writes files.
//!
//! Needs `Xvfb`, `xdotool` and a software OpenGL; without them it prints that it skips.

#![allow(clippy::unwrap_used, reason = "a test may fail")]
#![cfg(feature = "window")]

mod common;

use common::desk::{Bench, Desk, click, open_with, rest};
use egui_kittest::kittest::Queryable;
use epipole_lab::session::HostEvent;
use image::RgbImage;
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

const SIZE: (u32, u32) = (1280, 800);
/// Nothing of this takes so long; it ends tests that would never end.
const PATIENCE: Duration = Duration::from_secs(420);

/// A program that ends with the test.
struct Ended(Child);

impl Ended {
    /// Its resident memory in MB, from the system.
    fn memory_mb(&self) -> u32 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.0.id())).unwrap();
        let line = status.lines().find(|line| line.starts_with("VmRSS:"));
        let kilobytes: u32 = line
            .and_then(|line| line.split_whitespace().nth(1))
            .unwrap()
            .parse()
            .unwrap();
        kilobytes / 1024
    }
}

impl Drop for Ended {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// A virtual display, and a folder for output files.
struct Display {
    _server: Ended,
    name: String,
    folder: PathBuf,
}

impl Drop for Display {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}

fn is_there(program: &str) -> bool {
    let found = Command::new("sh")
        .args(["-c", &format!("command -v {program}")])
        .output();
    found.is_ok_and(|found| found.status.success())
}

impl Display {
    /// `None` where there is nothing to show a window on.
    fn open(test: &str) -> Option<Self> {
        for program in ["Xvfb", "xdotool"] {
            if !is_there(program) {
                println!("skipped: there is no {program}; tests/tools/window.sh installs it");
                return None;
            }
        }
        let folder = std::env::temp_dir().join(format!("epipole-{test}-{}", std::process::id()));
        std::fs::create_dir_all(folder.join("screen")).unwrap();
        let (width, height) = SIZE;
        let mut server = Command::new("Xvfb")
            .args(["-displayfd", "1", "-nolisten", "tcp", "-fbdir"])
            .arg(folder.join("screen"))
            .args(["-screen", "0", &format!("{width}x{height}x24")])
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .unwrap();
        // The display prints its number when it is ready.
        let mut number = String::new();
        let mut output = BufReader::new(server.stdout.take().unwrap());
        output.read_line(&mut number).unwrap();
        Some(Self {
            _server: Ended(server),
            name: format!(":{}", number.trim()),
            folder,
        })
    }

    /// The Lab with these files. Programs in the folder `programs` are found before others.
    fn start(&self, files: &[PathBuf]) -> Ended {
        let mut programs = self.folder.join("programs").into_os_string();
        programs.push(":");
        programs.push(std::env::var_os("PATH").unwrap_or_default());
        let started = Command::new(env!("CARGO_BIN_EXE_epipole-lab"))
            .args(files)
            .current_dir(&self.folder)
            .env("DISPLAY", &self.name)
            .env("PATH", programs)
            .env("LIBGL_ALWAYS_SOFTWARE", "1")
            .env("WINIT_X11_SCALE_FACTOR", "1")
            .env_remove("WAYLAND_DISPLAY")
            .env_remove("WAYLAND_SOCKET")
            .stdin(Stdio::null())
            .spawn();
        Ended(started.unwrap())
    }

    fn click(&self, at: egui::Pos2) {
        let place = [at.x, at.y].map(|x| (x.round() as i32).to_string());
        let done = Command::new("xdotool")
            .env("DISPLAY", &self.name)
            .args(["mousemove", &place[0], &place[1]])
            .args(["sleep", "0.3", "click", "1", "sleep", "0.3"])
            .status();
        assert!(done.unwrap().success());
    }

    /// Screenshot, from the memory of the display: an XWD file, with a header of four-byte numbers.
    fn screen(&self) -> RgbImage {
        let bytes = std::fs::read(self.folder.join("screen/Xvfb_screen0")).unwrap();
        let number =
            |n: usize| u32::from_be_bytes(bytes[4 * n..4 * n + 4].try_into().unwrap()) as usize;
        let (header, width, height) = (number(0), number(4), number(5));
        let (bits, line, colors) = (number(11), number(12), number(19));
        assert_eq!((bits, width as u32, height as u32), (32, SIZE.0, SIZE.1));
        let first = header + 12 * colors;
        RgbImage::from_fn(SIZE.0, SIZE.1, |u, v| {
            let at = first + v as usize * line + 4 * u as usize;
            // Least significant byte first: blue.
            image::Rgb([bytes[at + 2], bytes[at + 1], bytes[at]])
        })
    }

    /// Clicks these places in turn until a file can be read; a window that has not opened yet
    /// receives nothing.
    fn click_until(&self, lab: &mut Ended, places: &[egui::Pos2], name: &str) -> Vec<String> {
        let begun = Instant::now();
        loop {
            for place in places {
                self.click(*place);
            }
            if let Some(names) = names_in(&self.folder.join(name)) {
                return names;
            }
            assert_eq!(lab.0.try_wait().unwrap(), None, "the Lab has ended");
            assert!(
                begun.elapsed() < PATIENCE,
                "no {name} came of clicking {places:?}"
            );
            std::thread::sleep(Duration::from_secs(1));
        }
    }
}

/// The names in a zip file, if it is whole.
fn names_in(path: &Path) -> Option<Vec<String>> {
    let file = std::fs::File::open(path).ok()?;
    let archive = zip::ZipArchive::new(file).ok()?;
    Some(archive.file_names().map(str::to_owned).collect())
}

/// Center of a control in a window of this size: the layout is the same everywhere.
fn middle(bench: &Bench<'_>, name: &str) -> egui::Pos2 {
    bench.get_all_by_label(name).next().unwrap().rect().center()
}

fn bench() -> Bench<'static> {
    let desk = Desk {
        keeps_nothing: true,
        ..Desk::default()
    };
    open_with(desk, SIZE.0 as f32, SIZE.1 as f32)
}

#[test]
fn the_sample_is_solved_in_a_window_and_saved() {
    let Some(display) = Display::open("window") else {
        return;
    };
    let mut lab = display.start(&[]);
    let mut bench = bench();
    let export = middle(&bench, "Export");
    click(&mut bench, "Export");
    let save = middle(&bench, "Save reconstruction.zip");
    let names = display.click_until(&mut lab, &[export, save], "reconstruction.zip");
    for name in [
        "sparse/0/points3D.txt",
        "points.ply",
        "images/table-9.png",
        "README.txt",
    ] {
        assert!(names.iter().any(|other| other == name), "{name}: {names:?}");
    }
    let resting_mb = lab.memory_mb();
    assert!(resting_mb < 300, "the window holds {resting_mb} MB at rest");
    // The space has thousands of points, and nine photographs standing in it.
    let screen = display.screen();
    let space = image::imageops::crop_imm(&screen, 180, 60, 760, 700).to_image();
    let colors: BTreeSet<[u8; 3]> = space.pixels().map(|pixel| pixel.0).collect();
    if let Some(path) = std::env::var_os("EPIPOLE_SCREEN") {
        screen.save(path).unwrap();
    }
    assert!(colors.len() > 2000, "{} colors", colors.len());
}

/// Two small photographs in the folder of the display.
fn two_photographs(display: &Display) -> [PathBuf; 2] {
    let files = ["one.png", "two.png"].map(|name| display.folder.join(name));
    for (n, path) in files.iter().enumerate() {
        let image = RgbImage::from_fn(64, 48, |u, v| {
            image::Rgb([(u * 3) as u8, (v * 5) as u8, n as u8])
        });
        image.save(path).unwrap();
    }
    files
}

/// Positions of "Project" and its "Save" with these files open.
fn save_places(files: &[PathBuf]) -> [egui::Pos2; 2] {
    let mut bench = bench();
    let photographs = files.iter().map(|path| {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (name, std::fs::read(path).unwrap().into())
    });
    let host_event = HostEvent::Photographs(photographs.collect());
    bench.state_mut().host().host_events.push(host_event);
    bench.run_steps(3);
    rest(&mut bench);
    let menu = middle(&bench, "Project");
    click(&mut bench, "Project");
    [menu, middle(&bench, "Save")]
}

const SAVED: [&str; 3] = ["photographs/one.png", "photographs/two.png", "project.json"];

#[test]
fn files_that_are_given_take_the_place_of_the_sample() {
    let Some(display) = Display::open("files") else {
        return;
    };
    let files = two_photographs(&display);
    let mut lab = display.start(&files);
    let names = display.click_until(&mut lab, &save_places(&files), "project.zip");
    for name in SAVED {
        assert!(names.iter().any(|other| other == name), "{name}: {names:?}");
    }
}

#[test]
fn files_are_chosen_in_the_dialog_of_the_desktop() {
    use std::os::unix::fs::PermissionsExt;
    let Some(display) = Display::open("dialog") else {
        return;
    };
    let files = two_photographs(&display);
    // A dialog program that returns these files at once.
    let programs = display.folder.join("programs");
    std::fs::create_dir(&programs).unwrap();
    let [one, two] = files.each_ref().map(|path| path.display().to_string());
    let zenity = programs.join("zenity");
    std::fs::write(
        &zenity,
        format!("#!/bin/sh\nprintf '%s\\n%s\\n' '{one}' '{two}'\ntouch asked\n"),
    )
    .unwrap();
    std::fs::set_permissions(&zenity, std::fs::Permissions::from_mode(0o755)).unwrap();
    let add = middle(&bench(), "Add photographs…");
    let mut lab = display.start(&[]);
    let begun = Instant::now();
    while !display.folder.join("asked").exists() {
        assert_eq!(lab.0.try_wait().unwrap(), None, "the Lab has ended");
        assert!(
            begun.elapsed() < PATIENCE,
            "no dialog came of clicking {add:?}"
        );
        display.click(add);
    }
    let names = display.click_until(&mut lab, &save_places(&files), "project.zip");
    for name in SAVED {
        assert!(names.iter().any(|other| other == name), "{name}: {names:?}");
    }
}
