//! Generates a function for each Rust listing of the chapters, which `listings/rust.rs` runs.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::{env, fs};

/// A fenced block of Rust code.
struct Block {
    chapter: String,
    /// Name of the listing that the block is part of; empty for a block outside of listings.
    name: String,
    /// Line of the fence.
    line: usize,
    code: String,
}

fn main() {
    let content = Path::new("../content");
    println!("cargo::rerun-if-changed={}", content.display());
    println!("cargo::rerun-if-changed=build.rs");
    let mut chapters: Vec<PathBuf> = fs::read_dir(content)
        .unwrap_or_else(|error| panic!("{}: {error}", content.display()))
        .flatten()
        .map(|entry| entry.path())
        .filter(|path| path.extension().is_some_and(|end| end == "md"))
        .collect();
    chapters.sort();
    let blocks: Vec<Block> = chapters.iter().flat_map(|path| blocks(path)).collect();
    let out = env::var_os("OUT_DIR")
        .map(PathBuf::from)
        .unwrap_or_default();
    let file = out.join("listings.rs");
    fs::write(&file, code_of(&blocks))
        .unwrap_or_else(|error| panic!("{}: {error}", file.display()));
}

fn blocks(path: &Path) -> Vec<Block> {
    let text =
        fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let chapter = path
        .file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned();
    let (mut found, mut name, mut fence) = (Vec::new(), String::new(), None);
    for (number, line) in text.lines().enumerate() {
        let words = line.trim();
        match &mut fence {
            None => {
                if let Some(rest) = words.strip_prefix("{{#listing ") {
                    name = rest.split([' ', '|', '}']).next().unwrap_or("").to_owned();
                } else if words == "{{/listing}}" {
                    name.clear();
                } else if words == "```rust" {
                    let (chapter, name) = (chapter.clone(), name.clone());
                    let (line, code) = (number + 1, String::new());
                    fence = Some(Block {
                        chapter,
                        name,
                        line,
                        code,
                    });
                }
            }
            Some(block) if words != "```" => {
                // As in rustdoc, lines that start with `# ` are hidden on the page.
                let line = if words == "#" {
                    ""
                } else {
                    words.strip_prefix("# ").unwrap_or(line)
                };
                block.code.push_str(line);
                block.code.push('\n');
            }
            Some(_) => found.extend(fence.take()),
        }
    }
    found
}

/// The list of all listings, and a module for each.
fn code_of(blocks: &[Block]) -> String {
    let mut code = String::from("const LISTINGS: &[Listing] = &[\n");
    for (
        index,
        Block {
            chapter,
            name,
            line,
            ..
        },
    ) in blocks.iter().enumerate()
    {
        let _ = writeln!(
            code,
            "    Listing {{ chapter: {chapter:?}, name: {name:?}, line: {line}, run: listing_{index}::run }},"
        );
    }
    code.push_str("];\n");
    for (index, block) in blocks.iter().enumerate() {
        let Block {
            chapter,
            line,
            code: own,
            ..
        } = block;
        // Listings without a `main` of their own may use `?`.
        let main = match own.contains("fn main(") {
            true => own.clone(),
            false => format!("fn main() -> Result<(), epipole::Error> {{\n{own}Ok(())\n}}\n"),
        };
        let _ = write!(
            code,
            "\n// content/{chapter}.md, line {line}\n#[allow(warnings, clippy::all, clippy::unwrap_used)]\n\
             mod listing_{index} {{\n{main}pub fn run() {{ super::Ended::check(main()) }}\n}}\n"
        );
    }
    code
}
