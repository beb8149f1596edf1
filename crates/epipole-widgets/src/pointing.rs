//! Conversion of pointer and key input to events: mouse, touch and arrow keys all give
//! [`Event::HandleMoved`].

use crate::contract::{Event, Handle, Layout, Panel};

/// Maximum distance at which a finger or mouse grabs a handle, CSS pixels.
pub const GRAB_RADIUS: f64 = 22.0;

/// Direction of an arrow key on the page.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[cfg_attr(test, ts(rename_all = "kebab-case"))]
pub enum Direction {
    /// Towards the left edge.
    Left,
    /// Towards the right edge.
    Right,
    /// Towards the top edge.
    Up,
    /// Towards the bottom edge.
    Down,
}

/// Returns the position of a handle on the page, CSS pixels.
pub fn place_of(handle: &Handle, layout: &Layout) -> (f64, f64) {
    layout
        .panel(handle.panel)
        .canvas_from_world((handle.x, handle.y))
}

/// Returns the handle that a press at `place` grabs: the nearest within [`GRAB_RADIUS`].
pub fn handle_at<'a>(
    handles: &'a [Handle],
    layout: &Layout,
    place: (f64, f64),
) -> Option<&'a Handle> {
    let distance = |handle: &Handle| {
        let (x, y) = place_of(handle, layout);
        libm::hypot(x - place.0, y - place.1)
    };
    handles
        .iter()
        .map(|handle| (distance(handle), handle))
        .filter(|(distance, _)| *distance <= GRAB_RADIUS)
        .min_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, handle)| handle)
}

/// Returns the event of dragging a handle to `place` on the page.
pub fn drag(handle: &Handle, layout: &Layout, place: (f64, f64)) -> Event {
    let (x, y) = layout.panel(handle.panel).world_from_canvas(place);
    Event::HandleMoved {
        id: handle.id.clone(),
        x,
        y,
    }
}

/// Returns the event of an arrow key: `steps` times the handle's step towards `direction` on the
/// page, whatever the direction of the panel's axis.
pub fn nudge(handle: &Handle, layout: &Layout, direction: Direction, steps: f64) -> Event {
    let panel = layout.panel(handle.panel);
    let (x_sign, y_sign) = signs(panel);
    let (dx, dy) = match direction {
        Direction::Left => (-x_sign, 0.0),
        Direction::Right => (x_sign, 0.0),
        Direction::Up => (0.0, -y_sign),
        Direction::Down => (0.0, y_sign),
    };
    Event::HandleMoved {
        id: handle.id.clone(),
        x: handle.x + dx * steps * handle.step[0],
        y: handle.y + dy * steps * handle.step[1],
    }
}

/// Returns the event of Home (`Left`) and End (`Right`), which move a handle to the end of its
/// range. A handle that cannot move horizontally moves vertically instead.
pub fn to_the_end(handle: &Handle, layout: &Layout, direction: Direction) -> Event {
    let panel = layout.panel(handle.panel);
    let (x_sign, y_sign) = signs(panel);
    let far = |[low, high]: [f64; 2], sign: f64| if sign > 0.0 { high } else { low };
    let (mut x, mut y) = (handle.x, handle.y);
    let sideways = handle.x_range[0] < handle.x_range[1];
    match direction {
        Direction::Right if sideways => x = far(handle.x_range, x_sign),
        Direction::Left if sideways => x = far(handle.x_range, -x_sign),
        Direction::Right | Direction::Down => y = far(handle.y_range, y_sign),
        Direction::Left | Direction::Up => y = far(handle.y_range, -y_sign),
    }
    Event::HandleMoved {
        id: handle.id.clone(),
        x,
        y,
    }
}

/// Returns the event of a click at `place`, if the panel there is clickable.
pub fn click(layout: &Layout, place: (f64, f64)) -> Option<Event> {
    let panel = layout.panel_at(place).filter(|panel| panel.clickable)?;
    let (x, y) = panel.world_from_canvas(place);
    Some(Event::Clicked {
        panel: panel.id.to_owned(),
        x,
        y,
    })
}

fn signs(panel: &Panel) -> (f64, f64) {
    (
        (panel.x_axis.end - panel.x_axis.start).signum(),
        (panel.y_axis.end - panel.y_axis.start).signum(),
    )
}
