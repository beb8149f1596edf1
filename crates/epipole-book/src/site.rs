//! The whole site, stage by stage: chapters to data, answers of the core, pages, files.

use crate::directives::VOCABULARY;
use crate::html::path_to_root;
use crate::parallel;
use crate::parse::book::{self, Chapter, Manuscript};
use crate::parse::content::Content;
use crate::phases::Phases;
use crate::problems::{Problem, Problems};
use crate::render::chapter::Draft;
use crate::render::links::LAB_FOLDER;
use crate::render::page::{Page, PanelRequest};
use crate::render::{join, panels};
use crate::resolve::book::Book;
use crate::resolve::cache::Cache;
use crate::resolve::figures::Gallery;
use crate::tools::target_folder;
use crate::write::address;
use crate::write::assets::{self, Assets, Modules};
use crate::write::compress;
use crate::write::disk::{STAND_IN, write};
use crate::write::frames::{self, Frame};
use crate::write::gathered;
use crate::write::manifest::{MANIFEST, manifest};
use crate::write::manual::{Manual, read_reference};
use crate::write::template::{Nav, Template};
use anyhow::{Context, Result, bail};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::thread::ScopedJoinHandle;

/// Options of a build.
#[derive(Debug, Clone)]
pub struct Options {
    /// The folder with `content/`, `web/` and `crates/`.
    pub project: PathBuf,
    /// Output folder of the site.
    pub out: PathBuf,
    /// Whether to make the files besides the pages: styles, fonts, scripts, WebAssembly. A check of
    /// the content needs none.
    pub assets: bool,
    /// Look for problems only: write nothing but `notebooks`.
    pub check: bool,
    /// Additional output folder for the notebooks of the chapters.
    pub notebooks: Option<PathBuf>,
    /// Folder with the manual of the Python package, which becomes a part of the site.
    pub manual: Option<PathBuf>,
    /// Folder with the reference of the npm package, which becomes a part of the site.
    pub js_reference: Option<PathBuf>,
    /// For `serve`: pages reload themselves, and files are not compressed.
    pub live: bool,
}

/// Outcome of a build.
#[derive(Debug)]
pub enum Outcome {
    /// The site is in place.
    Built {
        /// Number of pages.
        pages: usize,
        /// Number of files, compressed ones included.
        files: usize,
    },
    /// The content has problems; nothing was written.
    Problems(Vec<Problem>),
}

/// Files of the site by their paths.
type Files = BTreeMap<String, Vec<u8>>;

/// Builds the book.
///
/// # Errors
/// A missing tool or an unreadable folder. Problems of the content are not an error but
/// [`Outcome::Problems`].
pub fn build(options: &Options, gallery: &dyn Gallery, phases: &Phases) -> Result<Outcome> {
    std::thread::scope(|scope| {
        // The modules take longest and need nothing of the pages.
        let wanted = options.assets && !options.check;
        let modules = wanted.then(|| {
            scope.spawn(|| {
                phases.beside("build WebAssembly (beside the others)", || {
                    assets::modules(&options.project)
                })
            })
        });
        let modules = || match modules.map(ScopedJoinHandle::join) {
            None => Ok(None),
            Some(Ok(modules)) => modules,
            Some(Err(_)) => bail!("the figures could not be built for the browser"),
        };
        build_beside(options, gallery, phases, modules)
    })
}

fn build_beside(
    options: &Options,
    gallery: &dyn Gallery,
    phases: &Phases,
    modules: impl FnOnce() -> Result<Option<Modules>>,
) -> Result<Outcome> {
    let content = Content::new(&options.project.join("content"));
    let problems = Problems::default();
    let read = phases.run("read chapters", 0, |_| book::read(&content, &problems))?;
    let Some(manuscript) = read else {
        return Ok(Outcome::Problems(problems.sorted()));
    };
    let Manuscript {
        config,
        contents,
        chapters,
    } = manuscript;
    let draws_posters = !options.check;
    let book = Book::new(&content, gallery, cache(options)?, draws_posters, &problems);
    let mut pages = pages(chapters, &content, &book, phases);
    let panels = match options.assets && !options.check {
        true => phases.run("make panels", 0, |_| {
            let requests = pages.iter().flat_map(|page| &page.panels);
            let requests: Vec<&PanelRequest> = requests.collect();
            panels::make(&options.project, &requests)
        })?,
        false => Vec::new(),
    };
    phases.run("check links", 0, |_| {
        join::join(&mut pages, &panels, &problems);
        join::check(&pages, &content, &problems);
    });
    if !problems.sorted().is_empty() {
        return Ok(Outcome::Problems(problems.sorted()));
    }

    let mut files = gathered::files(&mut pages, &content);
    if let Some(folder) = &options.notebooks {
        let notebooks = files
            .iter()
            .filter_map(|(path, bytes)| Some((path.strip_prefix("notebooks/")?, bytes)));
        let notebooks = notebooks.map(|(path, bytes)| (path.to_owned(), bytes.clone()));
        write(&notebooks.collect(), folder)?;
    }
    if options.check {
        return Ok(Outcome::Built {
            pages: pages.len(),
            files: 0,
        });
    }
    let frames = phases.run("draw frames", 0, |_| frames::draw(&book))?;
    let assets = if options.assets {
        let used = assets::used_letters(&pages);
        let modules = phases.run("wait for WebAssembly", 0, |_| modules())?;
        phases.run("bundle scripts and fonts", 0, |_| {
            assets::make(&options.project, options.live, &used, modules.as_ref())
        })?
    } else {
        Assets::default()
    };
    files.extend(assets.files.clone());
    let manual = options.manual.as_deref().map(Manual::read).transpose()?;
    if let Some(folder) = &options.js_reference {
        files.extend(read_reference(folder)?);
    }
    phases.run("fill templates", 0, |_| {
        let book = Bound {
            config: &config,
            contents: &contents,
            pages: &mut pages,
            frames,
            manual,
        };
        book.add(options, &assets, &mut files)
    })?;
    if !options.live {
        phases.run("compress", 0, |_| compress::add(&mut files))?;
    }
    let report = Outcome::Built {
        pages: pages.len(),
        files: files.len(),
    };
    phases.run("write", 0, |_| write(&files, &options.out))?;
    Ok(report)
}

/// Cache of posters and snapshots.
fn cache(options: &Options) -> Result<Cache> {
    let folder = target_folder(&options.project).join("book-work/posters");
    std::fs::create_dir_all(&folder)
        .with_context(|| format!("cannot make the folder {}", folder.display()))?;
    Ok(Cache::new(&folder))
}

/// Parses, resolves and renders all chapters.
fn pages(chapters: Vec<Chapter>, content: &Content, book: &Book, phases: &Phases) -> Vec<Page> {
    let (count, problems) = (chapters.len(), book.problems);
    let parsed: Vec<_> = phases.run("parse chapters", 0, |_| {
        let chapters = chapters.into_iter();
        chapters
            .map(|chapter| Draft::parse(chapter, VOCABULARY, content, problems))
            .collect()
    });
    let resolved: Vec<_> = phases.run("ask figures and draw posters", count, |steps| {
        parallel::map(parsed, |draft| {
            let resolved = draft.resolve(book);
            steps.done();
            resolved
        })
    });
    phases.run("render pages", 0, |_| {
        let pages = resolved.into_iter().map(|draft| draft.render(problems));
        pages.collect()
    })
}

/// The pages with their surroundings.
struct Bound<'a> {
    config: &'a mdbook_driver::config::Config,
    contents: &'a [book::Entry],
    pages: &'a mut [Page],
    frames: Vec<Frame>,
    manual: Option<Manual>,
}

impl Bound<'_> {
    /// Adds all pages in their templates, and the files for search and servers.
    fn add(self, options: &Options, assets: &Assets, files: &mut Files) -> Result<()> {
        let Bound {
            config,
            contents,
            pages,
            frames,
            manual,
        } = self;
        let has_manual = manual.is_some();
        let manual = manual.unwrap_or_default();
        let sections = pages.iter().flat_map(|page| &page.sections);
        let sections = sections.chain(&manual.sections);
        let search = serde_json::to_vec(&sections.collect::<Vec<_>>())?;
        let search = assets::add_hashed(files, "search", "json", search);
        let file = options.project.join("web/theme/index.hbs");
        let template = Template::load(
            &file,
            config,
            assets,
            &search,
            has_manual,
            options.js_reference.is_some(),
            options.live,
        )?;
        for page in pages.iter_mut() {
            let styles = assets.figure_css.as_deref().unwrap_or_default();
            let address = format!("{}{styles}", path_to_root(&page.path));
            page.html = page.html.replace(panels::STYLES, &address);
        }
        for (index, page) in pages.iter().enumerate() {
            let nav = Nav::new(contents, pages, index);
            files.insert(page.path.clone(), template.page(page, &nav)?.into_bytes());
        }
        frames::add(files, &options.project, config, assets, frames)?;
        if !files.contains_key("index.html")
            && let Some(first) = pages.first()
            && let Some(html) = files.get(&first.path).cloned()
        {
            files.insert("index.html".to_owned(), html);
        }
        let root = address::address(config);
        let others = [
            ("404.html".to_owned(), template.not_found(contents, pages)?),
            (
                format!("{LAB_FOLDER}/index.html"),
                template.without_lab(contents, pages)?,
            ),
            (format!("{LAB_FOLDER}/{STAND_IN}"), String::new()),
            ("robots.txt".to_owned(), address::robots(root.as_deref())),
            (".nojekyll".to_owned(), String::new()),
        ];
        files.extend(others.map(|(path, text)| (path, text.into_bytes())));
        if let Some(root) = &root {
            let paths = pages.iter().map(|page| page.path.as_str());
            let sitemap = address::sitemap(root, paths).into_bytes();
            files.insert("sitemap.xml".to_owned(), sitemap);
        }
        files.extend(manual.files);
        if !options.live {
            let manifest = serde_json::to_vec(&manifest(config, assets))?;
            files.insert(MANIFEST.to_owned(), manifest);
        }
        if options.assets {
            let paths = pages.iter().map(|page| page.path.as_str());
            let paths: Vec<&str> = paths.chain(["index.html"]).collect();
            assets::add_offline(&options.project, options.live, &paths, files)?;
        }
        Ok(())
    }
}
