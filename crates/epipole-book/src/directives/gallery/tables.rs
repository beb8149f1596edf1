//! Tables of a figure's settings, readouts, buttons and keys, from its snapshot.

use crate::html::escape;
use serde_json::Value;

/// Renders all tables; those without rows are omitted.
pub(super) fn tables(snapshot: &Value) -> String {
    let all = [settings, readouts, buttons, keys];
    all.map(|table| table(snapshot)).concat()
}

fn entries<'a>(snapshot: &'a Value, list: &str) -> impl Iterator<Item = &'a Value> {
    snapshot[list].as_array().into_iter().flatten()
}

fn words<'a>(entry: &'a Value, key: &str) -> &'a str {
    entry[key].as_str().unwrap_or_default()
}

/// Formats a number or boolean as an attribute value.
fn plain(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Null => String::new(),
        other => other.to_string(),
    }
}

/// A row of a table, starting with a name.
struct Row {
    cells: Vec<String>,
    /// Attribute of the element that shows or hides this.
    shown_by: Option<&'static str>,
}

fn table(summary: &str, columns: &[&str], rows: &[Row]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let head: String = columns
        .iter()
        .map(|column| format!("<th scope=\"col\">{column}</th>"))
        .collect();
    let body: String = rows
        .iter()
        .map(|row| {
            let mut cells = row.cells.iter();
            let shown_by = (row.shown_by.iter())
                .map(|attribute| format!(" data-shown-by=\"{attribute}\""))
                .collect::<String>();
            let name = cells.next().map_or("", String::as_str);
            let rest: String = cells
                .map(|cell| format!("<td>{}</td>", escape(cell)))
                .collect();
            format!(
                "<tr{shown_by}><th scope=\"row\"><code>{}</code></th>{rest}</tr>\n",
                escape(name)
            )
        })
        .collect();
    format!(
        "<details><summary>{summary}</summary>\n<div class=\"table\"><table>\n\
         <thead><tr>{head}</tr></thead>\n<tbody>\n{body}</tbody>\n</table></div>\n</details>\n"
    )
}

/// Lists everything that an attribute, a property or an address can set.
fn settings(snapshot: &Value) -> String {
    let controls = entries(snapshot, "controls").filter_map(|control| {
        let values = match words(control, "kind") {
            "slider" => format!(
                "{} to {}, in steps of {}",
                plain(&control["min"]),
                plain(&control["max"]),
                plain(&control["step"])
            ),
            "toggle" => "true or false".to_owned(),
            "choice" => {
                let options = entries(control, "options").filter_map(|option| option[0].as_str());
                options.collect::<Vec<_>>().join(", ")
            }
            _ => return None,
        };
        let (id, label) = (words(control, "id"), words(control, "label"));
        Some(Row {
            cells: vec![
                id.to_owned(),
                label.to_owned(),
                values,
                plain(&control["default"]),
            ],
            shown_by: shown_by(control),
        })
    });
    let handles = entries(snapshot, "handles").map(|handle| {
        let digits = handle["digits"].as_u64().unwrap_or(2) as usize;
        let place = |axis: &str| handle[axis].as_f64().unwrap_or_default();
        Row {
            cells: vec![
                words(handle, "id").to_owned(),
                words(handle, "label").to_owned(),
                "a point: x,y".to_owned(),
                format!("{:.digits$},{:.digits$}", place("x"), place("y")),
            ],
            shown_by: None,
        }
    });
    let rows: Vec<Row> = controls.chain(handles).collect();
    let columns = ["Name", "Label", "Values", "At first"];
    table("What can be set", &columns, &rows)
}

/// A control without a place is never shown.
fn shown_by(control: &Value) -> Option<&'static str> {
    (words(control, "place") != "hidden").then_some("controls")
}

fn readouts(snapshot: &Value) -> String {
    let row = |readout: &Value| Row {
        cells: ["id", "label", "text"]
            .map(|key| words(readout, key).to_owned())
            .to_vec(),
        shown_by: Some("readouts"),
    };
    let rows: Vec<Row> = entries(snapshot, "readouts").map(row).collect();
    table("What can be read", &["Name", "Label", "At first"], &rows)
}

fn buttons(snapshot: &Value) -> String {
    let row = |button: &Value| Row {
        cells: ["id", "label"]
            .map(|key| words(button, key).to_owned())
            .to_vec(),
        shown_by: shown_by(button),
    };
    let rows: Vec<Row> = entries(snapshot, "controls")
        .filter(|control| words(control, "kind") == "button")
        .map(row)
        .collect();
    table("What can be pressed", &["Name", "Label"], &rows)
}

/// Lists the keys of this figure's items, matching `web/src/handles.ts`.
fn keys(snapshot: &Value) -> String {
    let has = |list: &str, what: &dyn Fn(&Value) -> bool| entries(snapshot, list).any(what);
    let points = has("handles", &|_| true);
    let removable = has("handles", &|handle| handle["removable"] == true);
    let sliders = has("controls", &|control| words(control, "kind") == "slider");
    let spaces = has("spaces", &|_| true);
    let panels = snapshot["layout"]["panels"].as_array();
    let clickable = panels
        .into_iter()
        .flatten()
        .any(|panel| panel["clickable"] == true);
    let mut rows = vec![("Tab", "to the next thing that can be operated, and out")];
    if points || sliders {
        rows.push((
            "arrows",
            "one step of the point or slider that has the focus",
        ));
    }
    if points {
        rows.push(("Shift and arrows", "a fifth of a step of the point"));
    }
    if points || sliders {
        rows.push(("Page Up, Page Down", "several steps"));
        rows.push(("Home, End", "as far as it goes"));
    }
    if removable {
        rows.push(("Delete", "removes the point"));
    }
    if spaces {
        rows.push((
            "+, −",
            "larger and smaller, on the point that turns the space",
        ));
    }
    if clickable {
        rows.push((
            "Enter",
            "clicks where the crosshair stands, which arrows move",
        ));
    }
    rows.push(("Escape", "gives the focus back to the page"));
    let rows: Vec<Row> = rows
        .into_iter()
        .map(|(key, deed)| Row {
            cells: vec![key.to_owned(), deed.to_owned()],
            shown_by: None,
        })
        .collect();
    table("Keys", &["Key", "What it does"], &rows)
}
