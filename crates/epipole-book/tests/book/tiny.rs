//! A gallery of one figure, and books of a few lines in temporary folders.

use epipole_book::edition::EditionOptions;
use epipole_book::epub::{EpubOptions, epub};
use epipole_book::phases::Phases;
use epipole_book::resolve::figures::{Figure, Gallery, Poster, Room};
use epipole_book::site::{Options, Outcome, build};
use std::fs;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// One figure, `dot`, with the parameter `size`.
pub(crate) struct OneDot;

struct Dot(f64);

impl Gallery for OneDot {
    fn names(&self) -> Vec<String> {
        vec!["dot".to_owned()]
    }

    fn about(&self, _: &str) -> (String, String) {
        ("A dot".to_owned(), "Look at it.".to_owned())
    }

    fn open(&self, _: &str, settings: &[(String, String)]) -> Result<Box<dyn Figure>, String> {
        let mut size = 3.0;
        for (key, value) in settings {
            match key.as_str() {
                "size" => {
                    size = value
                        .parse()
                        .map_err(|_| format!("{key}={value} is no number"))?
                }
                _ => return Err(format!("no parameter \"{key}\"; its parameters are size")),
            }
        }
        Ok(Box::new(Dot(size)))
    }
}

impl Figure for Dot {
    fn snapshot(&self) -> Result<String, String> {
        let size = self.0;
        Ok(format!(
            r#"{{"aspect":"broad","description":"A \"dot\" of size {size}.",
            "readouts":[{{"id":"area","text":"{area} px²","value":{area}}}],
            "controls":[{{"id":"size","kind":"slider","value":{size},"value_text":"{size} px"}}],
            "challenges":[{{"id":"large","solved":{large}}}]}}"#,
            area = size * size,
            large = size > 8.0
        ))
    }

    fn posters(&self, room: Room, scale: u32) -> Result<[Poster; 2], String> {
        let (width, height) = (room.width() * scale, 10 * scale);
        Ok([255, 0].map(|level| {
            let rgba = [level, level, level, 255].repeat((width * height) as usize);
            Poster {
                width,
                height,
                rgba,
            }
        }))
    }
}

/// Files of the project that are the real ones.
const TEMPLATES: [&str; 8] = [
    "web/theme/index.hbs",
    "web/theme/frame.hbs",
    "web/slides/deck.hbs",
    "web/epub/book.css",
    "web/epub/contents.hbs",
    "web/epub/package.hbs",
    "web/epub/page.hbs",
    "web/epub/title.hbs",
];

/// A project with the real templates and these content files.
pub(crate) struct Book {
    folder: TempDir,
    /// Folder of the manual, if it is part of the site.
    pub(crate) manual: Option<PathBuf>,
    /// Folder of the reference of the npm package, if it is part of the site.
    pub(crate) js_reference: Option<PathBuf>,
}

impl Book {
    pub(crate) fn new(files: &[(&str, &str)]) -> Book {
        let folder = tempfile::tempdir().unwrap();
        let book = Book {
            folder,
            manual: None,
            js_reference: None,
        };
        for template in TEMPLATES {
            let own = Path::new(env!("CARGO_MANIFEST_DIR"))
                .join("../..")
                .join(template);
            book.write(template, &fs::read_to_string(own).unwrap());
        }
        book.write(
            "content/book.toml",
            "[book]\ntitle = \"Tiny\"\nlanguage = \"en\"\nsrc = \".\"\n[output.epipole]\nfirst-chapter = 0\n",
        );
        for (path, text) in files {
            book.write(&format!("content/{path}"), text);
        }
        book
    }

    /// A book of one chapter.
    pub(crate) fn of_chapter(text: &str) -> Book {
        Book::new(&[("SUMMARY.md", "- [One](one.md)\n"), ("one.md", text)])
    }

    pub(crate) fn write(&self, path: &str, text: &str) {
        let path = self.folder.path().join(path);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }

    pub(crate) fn build(&self) -> Outcome {
        self.try_build().unwrap()
    }

    pub(crate) fn try_build(&self) -> anyhow::Result<Outcome> {
        let options = Options {
            project: self.folder.path().to_path_buf(),
            out: self.out(),
            assets: false,
            live: false,
            check: false,
            notebooks: None,
            manual: self.manual.clone(),
            js_reference: self.js_reference.clone(),
        };
        build(&options, &OneDot, &Phases::silent())
    }

    /// Writes the EPUB file, and returns its path.
    pub(crate) fn epub(&self, address: Option<&str>) -> PathBuf {
        let options = EpubOptions {
            edition: EditionOptions {
                project: self.folder.path().to_path_buf(),
                out: self.path("target/epub/tiny.epub"),
                address: address.map(str::to_owned),
            },
            modified: "2026-01-31T12:00:00Z".to_owned(),
            font: false,
        };
        match epub(&options, &OneDot, &Phases::silent()).unwrap() {
            Outcome::Built { .. } => options.edition.out,
            Outcome::Problems(problems) => panic!("{problems:#?}"),
        }
    }

    /// A path inside the project.
    pub(crate) fn path(&self, path: &str) -> PathBuf {
        self.folder.path().join(path)
    }

    pub(crate) fn out(&self) -> PathBuf {
        self.folder.path().join("target/book")
    }

    pub(crate) fn page(&self, path: &str) -> String {
        fs::read_to_string(self.out().join(path)).unwrap()
    }

    pub(crate) fn article(&self, path: &str) -> String {
        let page = self.page(path);
        let (_, article) = page.split_once("<article").unwrap();
        let (_, inner) = article.split_once('>').unwrap();
        let (inner, _) = inner.split_once("</article>").unwrap();
        inner.trim().to_owned()
    }

    #[track_caller]
    pub(crate) fn must_build(&self) {
        if let Outcome::Problems(problems) = self.build() {
            panic!("{problems:#?}");
        }
    }

    #[track_caller]
    pub(crate) fn problems(&self) -> Vec<String> {
        match self.build() {
            Outcome::Problems(problems) => problems.iter().map(ToString::to_string).collect(),
            Outcome::Built { .. } => panic!("it was built"),
        }
    }
}
