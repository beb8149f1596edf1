//! A chapter's Python as a Jupyter notebook.

use serde_json::{Value, json};

/// A cell of a notebook.
#[derive(Debug, Clone)]
pub enum Cell {
    /// Text, in Markdown.
    Text(String),
    /// Python, with its recorded output.
    Code {
        /// Id, unique in the notebook.
        id: String,
        /// Code.
        source: String,
        /// Output; empty if there is none, or none that is reproducible.
        prints: String,
        /// Solution of the task that starts here.
        solution: Option<String>,
    },
}

/// Content of task cells in a notebook.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Tasks {
    /// The initial code, for students.
    Open,
    /// The solution.
    Solved,
}

impl Cell {
    /// Creates a text cell, without empty lines around the text.
    pub(crate) fn text(words: String) -> Cell {
        Cell::Text(words.trim().to_owned())
    }
}

/// Returns the path of a page's notebook, from the root of the site.
pub(crate) fn path(page: &str, tasks: Tasks) -> String {
    let name = page.trim_end_matches(".html").replace('/', "-");
    match tasks {
        Tasks::Open => format!("notebooks/{name}.ipynb"),
        Tasks::Solved => format!("notebooks/{name}-solutions.ipynb"),
    }
}

/// Returns the notebook of a chapter, in nbformat 4.5.
pub(crate) fn notebook(title: &str, cells: &[Cell], tasks: Tasks) -> String {
    let (names, packages) = needs(cells);
    let head = format!(
        "# {title}\n\nThe code of this chapter of *Epipole*, to run and to change. It needs {names}: \
         `pip install {packages}`. Run the cells from the top, because later ones use what earlier ones define."
    );
    let mut all = vec![text_cell("title", &head)];
    for (number, cell) in cells.iter().enumerate() {
        all.push(match cell {
            Cell::Text(words) => text_cell(&format!("text-{number}"), words),
            Cell::Code {
                id,
                source,
                prints,
                solution,
            } => json!({
                "cell_type": "code",
                "id": id,
                "metadata": {},
                "execution_count": Value::Null,
                "source": lines(match (tasks, solution) {
                    (Tasks::Solved, Some(solution)) => solution.trim_end(),
                    _ => source.trim_end(),
                }),
                "outputs": match prints.as_str() {
                    "" => json!([]),
                    prints => json!([{
                        "output_type": "stream",
                        "name": "stdout",
                        "text": lines(&format!("{prints}\n")),
                    }]),
                },
            }),
        });
    }
    let notebook = json!({
        "nbformat": 4,
        "nbformat_minor": 5,
        "metadata": {
            "kernelspec": { "name": "python3", "display_name": "Python 3", "language": "python" },
            "language_info": { "name": "python" },
        },
        "cells": all,
    });
    format!("{notebook:#}\n")
}

/// Returns the packages that the cells import, as text and as arguments of `pip install`.
fn needs(cells: &[Cell]) -> (&'static str, &'static str) {
    let imports = |module: &str| {
        let starts = [format!("import {module}"), format!("from {module}")];
        let is_import = |line: &str| starts.iter().any(|start| line.starts_with(start));
        cells.iter().any(|cell| match cell {
            Cell::Code { source, .. } => source.lines().any(is_import),
            Cell::Text(_) => false,
        })
    };
    match (imports("cv2"), imports("epipole")) {
        (true, true) => ("NumPy, OpenCV and Epipole", "numpy opencv-python epipole"),
        (true, false) => ("NumPy and OpenCV", "numpy opencv-python"),
        (false, true) => ("NumPy and Epipole", "numpy epipole"),
        (false, false) => ("NumPy", "numpy"),
    }
}

fn text_cell(id: &str, words: &str) -> Value {
    json!({ "cell_type": "markdown", "id": id, "metadata": {}, "source": lines(words) })
}

/// Splits a text into lines with their line feeds, as notebooks store it.
fn lines(text: &str) -> Vec<&str> {
    text.split_inclusive('\n').collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cells_keep_their_lines_and_their_output() {
        let cells = [
            Cell::text("## Rays\n".to_owned()),
            Cell::Code {
                id: "rays-numpy".to_owned(),
                source: "import numpy\nprint(1)\n".to_owned(),
                prints: "1".to_owned(),
                solution: Some("print(2)\n".to_owned()),
            },
        ];
        let read =
            |tasks| -> Value { serde_json::from_str(&notebook("A title", &cells, tasks)).unwrap() };
        let made = read(Tasks::Open);
        let all = made["cells"].as_array().unwrap();
        assert_eq!(all.len(), 3);
        let head = all[0]["source"][0].as_str().unwrap();
        assert_eq!(head, "# A title\n");
        assert_eq!(all[1]["source"], json!(["## Rays"]));
        assert_eq!(all[2]["source"], json!(["import numpy\n", "print(1)"]));
        assert_eq!(all[2]["outputs"][0]["text"], json!(["1\n"]));
        assert_eq!(
            read(Tasks::Solved)["cells"][2]["source"],
            json!(["print(2)"])
        );
        assert_eq!(
            path("part/one.html", Tasks::Open),
            "notebooks/part-one.ipynb"
        );
    }

    #[test]
    fn the_head_names_the_packages_that_cells_import() {
        let of = |source: &str| {
            needs(&[
                Cell::text("from epipole import nothing".to_owned()),
                Cell::Code {
                    id: "a".to_owned(),
                    source: source.to_owned(),
                    prints: String::new(),
                    solution: None,
                },
            ])
            .1
        };
        assert_eq!(of("import numpy as np\n"), "numpy");
        assert_eq!(of("import numpy\nimport cv2\n"), "numpy opencv-python");
        assert_eq!(of("from epipole import robust\n"), "numpy epipole");
        assert_eq!(
            of("import cv2\nimport epipole\n"),
            "numpy opencv-python epipole"
        );
    }
}
