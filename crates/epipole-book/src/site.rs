//! The whole site, stage by stage: parsing, data from the core, pages, files.

use crate::html::path_to_root;
use crate::parse::book;
use crate::phases::Phases;
use crate::reading::{Joined, Reading};
use crate::render::links::LAB_FOLDER;
use crate::render::page::{Page, PanelRequest};
use crate::render::panels;
use crate::resolve::figures::Gallery;
use crate::resolve::posters::Medium;
use crate::slides;
use crate::write::address;
use crate::write::assets::{self, Assets, Modules};
use crate::write::cards;
use crate::write::compress;
use crate::write::disk::{PLACEHOLDER, write};
use crate::write::frames::{self, Frame};
use crate::write::manifest::{MANIFEST, manifest};
use crate::write::manual::{Manual, read_reference};
use crate::write::page_files;
use crate::write::template::{NOT_FOUND, Nav, Template};
use anyhow::{Result, bail};
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::thread::ScopedJoinHandle;

pub use crate::reading::Outcome;

/// Options of a build.
#[derive(Debug, Clone)]
pub struct Options {
    /// The folder with `content/`, `web/` and `crates/`.
    pub project: PathBuf,
    /// Output folder of the site.
    pub out: PathBuf,
    /// Whether to make the files besides the pages: styles, fonts, scripts, WebAssembly. Not needed
    /// for a check of the content.
    pub assets: bool,
    /// Whether to look for problems only, and write nothing but `notebooks`.
    pub check: bool,
    /// Additional output folder for the notebooks of the chapters.
    pub notebooks: Option<PathBuf>,
    /// Folder with the manual of the Python package, which becomes a part of the site.
    pub manual: Option<PathBuf>,
    /// Folder with the reference of the npm package, which becomes a part of the site.
    pub js_reference: Option<PathBuf>,
    /// Whether pages reload themselves and files stay uncompressed, for `serve`.
    pub live: bool,
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
        // The modules take longest and do not depend on the pages.
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
    let medium = (!options.check).then_some(Medium::Screen);
    let reading = Reading::new(&options.project, gallery, medium, phases);
    let panels = |pages: &[Page]| match options.assets && !options.check {
        true => phases.run("make panels", 0, |_| {
            let requests = pages.iter().flat_map(|page| &page.panels);
            let requests: Vec<&PanelRequest> = requests.collect();
            panels::make(&options.project, &requests)
        }),
        false => Ok(Vec::new()),
    };
    reading.joined(panels, |joined| {
        write_site(options, joined, phases, modules)
    })
}

fn write_site(
    options: &Options,
    joined: Joined,
    phases: &Phases,
    modules: impl FnOnce() -> Result<Option<Modules>>,
) -> Result<Outcome> {
    let Joined {
        config,
        contents,
        mut pages,
        content,
        book,
    } = joined;
    let mut files = page_files::files(&mut pages, content);
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
    let frames = phases.run("draw frames", 0, |_| frames::draw(book))?;
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

/// Pages with the data shared by all.
struct Bound<'a> {
    config: &'a mdbook_driver::config::Config,
    contents: &'a [book::Entry],
    pages: &'a mut [Page],
    frames: Vec<Frame>,
    manual: Option<Manual>,
}

impl Bound<'_> {
    /// Adds all pages, filled into their templates, and the files for search and servers.
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
        let mut template = Template::load(
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
        let root = address::address(config);
        if root.is_some() {
            let title = config.book.title.as_deref().unwrap_or("Book");
            template.add_cards(cards::add(files, title, pages)?);
        }
        for (index, page) in pages.iter().enumerate() {
            let nav = Nav::new(contents, pages, index);
            files.insert(page.path.clone(), template.page(page, &nav)?.into_bytes());
        }
        frames::add(files, &options.project, config, assets, frames)?;
        slides::add(files, &options.project, config, assets, pages)?;
        if !files.contains_key("index.html")
            && let Some(first) = pages.first()
            && let Some(html) = files.get(&first.path).cloned()
        {
            files.insert("index.html".to_owned(), html);
        }
        let others = [
            (NOT_FOUND.to_owned(), template.not_found(contents, pages)?),
            (
                format!("{LAB_FOLDER}/index.html"),
                template.without_lab(contents, pages)?,
            ),
            (format!("{LAB_FOLDER}/{PLACEHOLDER}"), String::new()),
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
