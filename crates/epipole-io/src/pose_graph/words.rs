//! Sentences on lines that are not read.

/// Returns the reason why a word is not a number.
pub(super) fn no_number(word: &str) -> String {
    let has_point = word.replacen(',', ".", 1).parse::<f64>();
    match word.contains(',') && has_point.is_ok_and(f64::is_finite) {
        true => format!("“{word}” has a decimal comma, where g2o has a point"),
        false => format!("“{word}” is not a finite number"),
    }
}

/// Returns whether a line is an unsupported landmark or measurement.
pub(super) fn is_of_landmark(tag: &str) -> bool {
    const PARTS: [&str; 8] = [
        "XY",
        "POINT",
        "LANDMARK",
        "LINE",
        "PLANE",
        "DEPTH",
        "DISPARITY",
        "CALIB",
    ];
    PARTS.iter().any(|part| tag.contains(part))
}

/// Returns the reason why a tag is not supported.
pub(super) fn unknown(tag: &str) -> String {
    if tag.contains("PRIOR") {
        return format!(
            "the prior “{tag}” is not known: those of poses are EDGE_PRIOR_SE2, EDGE_PRIOR_SE2_XY, \
             EDGE_SE3_PRIOR and EDGE_SE3_XYZ_PRIOR"
        );
    }
    match tag {
        "VERTEX2" | "EDGE2" | "VERTEX3" | "EDGE3" => {
            format!("“{tag}” is of TORO's format: convert the file to g2o")
        }
        _ => format!("the tag “{tag}” is not known"),
    }
}

/// Describes landmarks and measurements that were left out, if any.
pub(super) fn left_out(num_landmarks: usize, num_measurements: usize) -> Option<String> {
    let count = |number: usize, what: &str| match number {
        0 => None,
        1 => Some(format!("1 {what}")),
        _ => Some(format!("{number} {what}s")),
    };
    let both = [
        count(num_landmarks, "landmark"),
        count(num_measurements, "measurement"),
    ];
    let both: Vec<String> = both.into_iter().flatten().collect();
    (!both.is_empty()).then(|| {
        format!(
            "left out: {}. Of landmarks, points are read (VERTEX_XY, VERTEX_TRACKXYZ) and their \
             positions as poses see them (EDGE_SE2_XY, EDGE_SE3_TRACKXYZ)",
            both.join(" and ")
        )
    })
}
