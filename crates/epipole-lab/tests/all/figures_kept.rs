//! Figures in the files of the export, and in projects from before them.

use crate::common::truth::{control, corners, length, shape, table_points};
use crate::common::{exported, finish, output, solved};
use epipole_lab::project::{Project, Sample, ShapeKind};
use epipole_lab::session::Event;
use epipole_lab::tasks::OpenProject;
use std::io::{Cursor, Write};

#[test]
fn the_report_is_a_page_with_all_measures() {
    let mut project = solved(Sample::Table);
    let points = table_points(&project);
    let four = corners(&points);
    let [a, b, c, d] = four;
    control(&four, &mut project);
    length(&mut project, &a, &c, 1.0);
    length(&mut project, &b, &d, 1.02);
    project.update(Event::MeasureShape(shape(ShapeKind::Area, &four)));
    project.update(Event::MeasureShape(shape(ShapeKind::Angle, &[a, b, c])));
    let mut read = exported(&project);
    let table = String::from_utf8(read("measures.csv")).unwrap();
    let mut lines = table.lines();
    assert_eq!(
        lines.next(),
        Some("kind,name,value,unit,sigma,known,x1,y1,z1,x2,y2,z2,x3,y3,z3,x4,y4,z4")
    );
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert!(rows.iter().all(|row| row.len() == 18), "{table}");
    let kinds: Vec<&str> = rows.iter().map(|row| row[0]).collect();
    let control = "control point residual";
    assert_eq!(
        kinds,
        [
            "length", "length", "area", "angle", control, control, control, control
        ]
    );
    let units: Vec<&str> = rows.iter().map(|row| row[3]).collect();
    assert_eq!(units, ["m", "m", "m²", "°", "m", "m", "m", "m"]);
    // The coordinates are those of the table, whose top is at y = 0.
    for row in &rows {
        for y in row[7..].iter().step_by(3).filter(|y| !y.is_empty()) {
            assert!(y.parse::<f64>().unwrap().abs() < 0.005, "{table}");
        }
    }
    let pdf = read("report.pdf");
    let has = |text: &str| {
        pdf.windows(text.len())
            .any(|bytes| bytes == text.as_bytes())
    };
    assert!(pdf.starts_with(b"%PDF-") && pdf.trim_ascii_end().ends_with(b"%%EOF"));
    assert!(has("/Count 1") && has("Measurement report"));
    for text in [
        "9 of 9 photographs",
        "focal length 600.0 pixels",
        "Known lengths",
    ] {
        assert!(has(text), "{text}");
    }
    for text in ["Control points", "Length 2", "Area 1", "Angle 2", "T3"] {
        assert!(has(text), "{text}");
    }
    let images = pdf
        .windows(15)
        .filter(|bytes| bytes == b"/Subtype /Image")
        .count();
    assert!((2..=5).contains(&images), "{images}");
    assert_eq!(
        pdf,
        exported(&project)("report.pdf"),
        "equal calls give equal bytes"
    );
    if let Ok(path) = std::env::var("EPIPOLE_REPORT") {
        std::fs::write(path, &pdf).unwrap();
    }
}

#[test]
fn a_file_from_before_figures_opens() {
    let mut project = solved(Sample::Table);
    let points = table_points(&project);
    let [a, b, ..] = corners(&points);
    length(&mut project, &a, &b, 1.0);
    let saved = project.save_request().project;
    let mut json = serde_json::to_value(&saved).unwrap();
    let fields = json.as_object_mut().unwrap();
    assert!(fields.remove("shapes").is_some() && fields.remove("control_points").is_some());
    let mut archive = zip::ZipWriter::new(Cursor::new(Vec::new()));
    let options = zip::write::SimpleFileOptions::default();
    archive.start_file("project.json", options).unwrap();
    archive.write_all(json.to_string().as_bytes()).unwrap();
    let archive = archive.finish().unwrap().into_inner().into();
    let opened = output(OpenProject { archive }).unwrap();
    assert_eq!(opened.project, saved);
    let mut again = Project::default();
    again.update(Event::OpenProject(Box::new(opened.project), opened.files));
    finish(&mut again);
    assert_eq!(again.length_words(0), project.length_words(0));
    assert!(again.document().shapes.is_empty() && again.document().control_points.is_empty());
}
