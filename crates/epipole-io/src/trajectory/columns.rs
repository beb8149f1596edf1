//! Columns of times, positions and quaternions.

use super::words::words;

/// Indices of the eight values of a pose in a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Columns {
    pub(super) time: usize,
    /// x, y, z.
    pub(super) position: [usize; 3],
    /// x, y, z, w.
    pub(super) quaternion: [usize; 4],
}

impl Columns {
    /// `t tx ty tz qx qy qz qw`.
    pub(super) const TUM: Self = Self {
        time: 0,
        position: [1, 2, 3],
        quaternion: [4, 5, 6, 7],
    };

    /// `t px py pz qw qx qy qz`.
    pub(super) const EUROC: Self = Self {
        time: 0,
        position: [1, 2, 3],
        quaternion: [5, 6, 7, 4],
    };

    /// Returns the minimum number of values of a row.
    pub(super) fn width(&self) -> usize {
        let all = self.position.iter().chain(&self.quaternion);
        all.fold(self.time, |most, place| most.max(*place)) + 1
    }

    /// Returns the columns of a header, such as `#timestamp [ns], p_RS_R_x [m], …` or `num t x y z
    /// qx qy qz qw`; `None` unless all eight are named.
    pub(super) fn of_names(line: &str) -> Option<Self> {
        let line = line.trim().trim_start_matches(['#', '%']).to_lowercase();
        let bare = without_units(&line);
        let names = words(&bare);
        let find = |is_it: &dyn Fn(&str) -> bool| names.iter().position(|name| is_it(name));
        let time = find(&|name| name == "t" || name.contains("time") || name.contains("stamp"))?;
        let axis = |name: &str, axis: char, is_rotation: bool| {
            let stem = name.strip_suffix(axis)?;
            (stem.split(['_', '.', '/']).any(is_of_quaternion) == is_rotation && is_of_pose(stem))
                .then_some(())
        };
        let of = |letter: char, is_rotation: bool| {
            find(&|name| axis(name, letter, is_rotation).is_some())
        };
        Some(Self {
            time,
            position: [of('x', false)?, of('y', false)?, of('z', false)?],
            quaternion: [
                of('x', true)?,
                of('y', true)?,
                of('z', true)?,
                of('w', true)?,
            ],
        })
    }
}

/// Removes the parts of a line in brackets.
fn without_units(line: &str) -> String {
    let mut depth = 0_usize;
    let mut selected = String::new();
    for c in line.chars() {
        match c {
            '[' | '(' => depth += 1,
            ']' | ')' => depth = depth.saturating_sub(1),
            _ if depth == 0 => selected.push(c),
            _ => {}
        }
    }
    selected
}

/// Returns whether a part of a name means a quaternion or an orientation.
fn is_of_quaternion(part: &str) -> bool {
    part == "q"
        || ["quat", "orient", "rot"]
            .iter()
            .any(|start| part.starts_with(start))
}

/// Returns whether a name without its axis is that of a pose, not of a velocity or bias.
fn is_of_pose(stem: &str) -> bool {
    let parts = stem.split(['_', '.', '/']);
    let mut parts = parts.filter(|part| !part.is_empty()).peekable();
    parts.peek().is_none()
        || parts.any(|part| {
            is_of_quaternion(part)
                || matches!(part, "p" | "t")
                || part.starts_with("pos")
                || part.starts_with("trans")
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_order_columns() {
        let of = Columns::of_names;
        assert_eq!(of("# timestamp tx ty tz qx qy qz qw"), Some(Columns::TUM));
        assert_eq!(of("t,x,y,z,qx,qy,qz,qw"), Some(Columns::TUM));
        let euroc = "#timestamp [ns], p_RS_R_x [m], p_RS_R_y [m], p_RS_R_z [m], q_RS_w [], \
            q_RS_x [], q_RS_y [], q_RS_z [], v_RS_R_x [m s^-1], b_w_RS_S_x [rad s^-1]";
        assert_eq!(of(euroc), Some(Columns::EUROC));
        let numbered = of("num t x y z qx qy qz qw").unwrap();
        assert_eq!(
            (numbered.time, numbered.position, numbered.width()),
            (1, [2, 3, 4], 9)
        );
        let ros = "%time,field.header.seq,field.header.stamp,field.header.frame_id,\
            field.pose.position.x,field.pose.position.y,field.pose.position.z,\
            field.pose.orientation.x,field.pose.orientation.y,field.pose.orientation.z,\
            field.pose.orientation.w";
        let columns = of(ros).unwrap();
        assert_eq!((columns.time, columns.position), (0, [4, 5, 6]));
        assert_eq!(columns.quaternion, [7, 8, 9, 10]);
        assert_eq!(of("# a path of poses"), None);
        assert_eq!(of("t x y z vx vy vz vw"), None);
    }
}
