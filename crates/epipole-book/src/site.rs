//! The whole site: chapters through mdBook's loader, pages through our renderer, files to disk.

use crate::html::{escape, forbidden_inline, path_to_root};
use crate::parse::include::include;
use crate::parse::source::Source;
use crate::problems::{Problem, Problems, name_list};
use crate::render::links;
use crate::render::markdown::Renderer;
use crate::render::notebook;
use crate::render::page::Page;
use crate::render::panels;
use crate::render::progress::{progress_table, solved_mark};
use crate::render::symbols;
use crate::resolve::figures::Gallery;
use crate::resolve::shared::{PAGE_OF_REFERENCES, Shared, resolve};
use crate::write::assets::{self, Assets, LAB_FOLDER};
use crate::write::compress;
use crate::write::frames;
use crate::write::template::{Nav, Template};
use anyhow::{Context, Result, bail};
use mdbook_driver::MDBook;
use mdbook_driver::book::{Book, BookItem, Chapter};
use mdbook_driver::config::Config;
use mdbook_renderer::RenderContext;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::thread::ScopedJoinHandle;

/// What to build, and how.
#[derive(Debug, Clone)]
pub struct Options {
    /// The folder with `content/`, `web/` and `crates/`.
    pub project: PathBuf,
    /// Where the site goes.
    pub out: PathBuf,
    /// Whether to make what the browser downloads beside the pages: styles, fonts, scripts,
    /// WebAssembly. A check of the content needs none of it.
    pub assets: bool,
    /// Look for problems only: write nothing but `notebooks`.
    pub check: bool,
    /// Where the notebooks of the chapters go as well.
    pub notebooks: Option<PathBuf>,
    /// For `serve`: pages reload themselves, and files are compressed fast rather than well.
    pub live: bool,
}

/// How a build ended.
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

/// Builds the book.
///
/// # Errors
/// A missing tool or an unreadable folder. What is wrong in the content is not an error but
/// [`Outcome::Problems`].
pub fn build(options: &Options, gallery: &dyn Gallery) -> Result<Outcome> {
    std::thread::scope(|scope| {
        // The modules take longest and need nothing of the pages.
        let wanted = options.assets && !options.check;
        let modules = wanted.then(|| scope.spawn(|| assets::modules(options)));
        let modules = || match modules.map(ScopedJoinHandle::join) {
            None => Ok(None),
            Some(Ok(modules)) => modules,
            Some(Err(_)) => bail!("the figures could not be built for the browser"),
        };
        build_pages(options, gallery, modules)
    })
}

fn build_pages(
    options: &Options,
    gallery: &dyn Gallery,
    modules: impl FnOnce() -> Result<Option<assets::Modules>>,
) -> Result<Outcome> {
    let content = options.project.join("content");
    let problems = Problems::default();
    let posters = assets::target_folder(&options.project).join("book-work/posters");
    if !options.check {
        std::fs::create_dir_all(&posters)
            .with_context(|| format!("cannot make the folder {}", posters.display()))?;
    }
    let posters = (!options.check).then_some(posters);
    let shared = Shared::new(&content, gallery, posters, &problems);
    check_summary(&shared);
    if !problems.sorted().is_empty() {
        return Ok(Outcome::Problems(problems.sorted()));
    }

    let config_file = content.join("book.toml");
    let mut config = Config::from_disk(&config_file)
        .with_context(|| format!("{} cannot be read", config_file.display()))?;
    config.book.src = ".".into();
    config.build.create_missing = false;
    config.build.use_default_preprocessors = false;
    let book = MDBook::load_with_config(&content, config)?;
    let site = Site {
        shared: &shared,
        pages: Mutex::default(),
    };
    book.execute_build_process(&site)?;
    let mut pages = site
        .pages
        .into_inner()
        .unwrap_or_else(PoisonError::into_inner);

    let summary = Summary::of(&book.book, first_chapter(&book.config));
    let panels = match options.assets && !options.check {
        true => panels::make(&options.project, &shared.wanted_panels())?,
        false => Vec::new(),
    };
    resolve_pages(&mut pages, &shared, &panels);
    links::check(&pages, &summary.drafts, &problems);
    for page in &pages {
        if let Some(offence) = forbidden_inline(&page.html) {
            let place = shared.place(&page.path.replace(".html", ".md"), 1);
            problems.report(
                place,
                format!("{offence}: pages hold no inline scripts and styles"),
            );
        }
    }
    if !problems.sorted().is_empty() {
        return Ok(Outcome::Problems(problems.sorted()));
    }

    let frames = frames::draw(&shared)?;
    let mut files = shared.take_files();
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

    let assets = if options.assets {
        let used = assets::used_letters(&pages);
        assets::make(options, &used, modules()?.as_ref())?
    } else {
        Assets::default()
    };
    files.extend(assets.files.clone());
    let search = serde_json::to_vec(
        &pages
            .iter()
            .flat_map(|page| &page.sections)
            .collect::<Vec<_>>(),
    )?;
    let search = assets::add_hashed(&mut files, "search", "json", search);

    let template_file = options.project.join("web/theme/index.hbs");
    let template = Template::load(&template_file, &book.config, &assets, &search, options.live)?;
    for page in &mut pages {
        let styles = assets.figure_css.as_deref().unwrap_or_default();
        let address = format!("{}{styles}", path_to_root(&page.path));
        page.html = page.html.replace(panels::STYLES, &address);
    }
    for (index, page) in pages.iter().enumerate() {
        let nav = Nav::new(&summary.entries, &pages, index);
        files.insert(page.path.clone(), template.page(page, &nav)?.into_bytes());
    }
    frames::add(&mut files, &options.project, &book.config, &assets, &frames)?;
    if !files.contains_key("index.html")
        && let Some(first) = pages.first()
        && let Some(html) = files.get(&first.path).cloned()
    {
        files.insert("index.html".to_owned(), html);
    }
    files.insert(
        "404.html".to_owned(),
        template.not_found(&summary.entries, &pages)?.into_bytes(),
    );
    let stand_in = template.without_lab(&summary.entries, &pages)?;
    files.insert(format!("{LAB_FOLDER}/index.html"), stand_in.into_bytes());
    files.insert(format!("{LAB_FOLDER}/{STAND_IN}"), Vec::new());
    files.insert(
        "robots.txt".to_owned(),
        b"User-agent: *\nAllow: /\n".to_vec(),
    );
    files.insert(".nojekyll".to_owned(), Vec::new());
    compress::add(&mut files, options.live)?;
    let report = Outcome::Built {
        pages: pages.len(),
        files: files.len(),
    };
    write(&files, &options.out)?;
    Ok(report)
}

/// mdBook's view of our renderer.
struct Site<'a> {
    shared: &'a Shared<'a>,
    pages: Mutex<Vec<Page>>,
}

impl mdbook_renderer::Renderer for Site<'_> {
    fn name(&self) -> &str {
        "epipole"
    }

    fn render(&self, context: &RenderContext) -> Result<()> {
        let first = first_chapter(&context.config);
        let pages: Vec<Page> = context
            .book
            .chapters()
            .map(|chapter| self.page(chapter, first))
            .collect();
        *self.pages.lock().unwrap_or_else(PoisonError::into_inner) = pages;
        Ok(())
    }
}

impl Site<'_> {
    fn page(&self, chapter: &Chapter, first: u32) -> Page {
        let file = chapter
            .path
            .as_deref()
            .unwrap_or(Path::new(""))
            .to_string_lossy();
        let file = file.replace('\\', "/");
        let source = Source::new(chapter.content.clone(), self.shared.place(&file, 1));
        let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
        let source = include(&source, folder, self.shared);
        let page = Page {
            path: html_path(&file),
            title: chapter.name.clone(),
            number: number(chapter, first),
            symbols: symbols::wanted(&source),
            ..Page::default()
        };
        let mut renderer = Renderer::new(self.shared, page, Some(&source));
        let html = renderer.block(&source);
        let mut page = renderer.page;
        page.html = html + &self.notebook(&page);
        page.end_section();
        if page
            .headings
            .iter()
            .filter(|heading| heading.level == 1)
            .count()
            != 1
        {
            let message = "a chapter starts with its title, `# …`, and has no other of that level";
            self.shared.problems.report(source.place(0), message);
        }
        page
    }
}

impl Site<'_> {
    /// Makes the notebook of a page that has Python, and says where it is.
    fn notebook(&self, page: &Page) -> String {
        if page.cells.is_empty() {
            return String::new();
        }
        let path = notebook::path(&page.path);
        let title = page.headings.first().map_or("", |heading| &heading.title);
        self.shared
            .add_file(&path, notebook::notebook(title, &page.cells).into_bytes());
        for data in self.shared.files_in("listings/data") {
            if let Ok(bytes) = std::fs::read(self.shared.path(&format!("listings/data/{data}"))) {
                self.shared.add_file(&format!("notebooks/{data}"), bytes);
            }
        }
        let name = path.rsplit('/').next().unwrap_or(&path);
        format!(
            "<p class=\"notebook\"><a href=\"{root}{path}\" download>Download the notebook of this chapter</a> \
             <span>{name}: all of its Python, to run and to change in Jupyter, VS Code or Colab</span></p>\n",
            root = path_to_root(&page.path),
        )
    }
}

fn html_path(file: &str) -> String {
    format!("{}.html", file.strip_suffix(".md").unwrap_or(file))
}

/// `[output.epipole] first-chapter = 0` in `book.toml`: the number of the first numbered chapter.
fn first_chapter(config: &Config) -> u32 {
    config
        .get::<u32>("output.epipole.first-chapter")
        .ok()
        .flatten()
        .unwrap_or(1)
}

fn number(chapter: &Chapter, first: u32) -> Option<String> {
    let numbers = chapter.number.as_ref()?;
    let shifted = numbers
        .iter()
        .enumerate()
        .map(|(level, &number)| match level {
            0 => (number + first).saturating_sub(1).to_string(),
            _ => number.to_string(),
        });
    Some(shifted.collect::<Vec<_>>().join("."))
}

/// A line of the table of contents.
#[derive(Debug, Clone)]
pub(crate) enum Entry {
    Part(String),
    Separator,
    Chapter {
        number: Option<String>,
        title: String,
        path: Option<String>,
    },
}

struct Summary {
    entries: Vec<Entry>,
    drafts: BTreeSet<String>,
}

impl Summary {
    fn of(book: &Book, first: u32) -> Summary {
        let mut entries = Vec::new();
        for item in book.iter() {
            entries.push(match item {
                BookItem::Separator => Entry::Separator,
                BookItem::PartTitle(title) => Entry::Part(title.clone()),
                BookItem::Chapter(chapter) => Entry::Chapter {
                    number: number(chapter, first),
                    title: chapter.name.clone(),
                    path: chapter
                        .path
                        .as_ref()
                        .map(|path| html_path(&path.to_string_lossy())),
                },
            });
        }
        Summary {
            entries,
            drafts: BTreeSet::new(),
        }
    }
}

/// Chapters that `SUMMARY.md` names but that do not exist, by line.
fn check_summary(shared: &Shared) {
    use pulldown_cmark::{Event, Parser, Tag};
    let Some(source) = shared.read("SUMMARY.md") else {
        shared.problems.report(
            shared.place("SUMMARY.md", 1),
            "there is no table of contents",
        );
        return;
    };
    for (event, range) in Parser::new(source.text()).into_offset_iter() {
        if let Event::Start(Tag::Link { dest_url, .. }) = event
            && !dest_url.is_empty()
            && !shared.path(&dest_url).is_file()
        {
            let message = format!("there is no chapter {dest_url} (a draft has empty parentheses)");
            shared.problems.report(source.place(range.start), message);
        }
    }
}

/// Fills in what pages say of one another.
fn resolve_pages(pages: &mut [Page], shared: &Shared, panels: &[String]) {
    let mut figures: BTreeMap<String, (String, String)> = BTreeMap::new();
    for page in pages.iter() {
        for figure in &page.figures {
            figures.insert(
                figure.id.clone(),
                (page.path.clone(), figure.number.clone()),
            );
        }
    }
    for (id, place) in shared.wanted_figures() {
        if !figures.contains_key(&id) {
            let known: Vec<&String> = figures.keys().collect();
            let message = format!(
                "no figure is called \"{id}\"; figures: {}",
                name_list(&known)
            );
            shared.problems.report(place, message);
        }
    }
    let list = pages
        .iter()
        .find(|page| page.has_references)
        .map(|page| page.path.clone());
    if let (None, Some(place)) = (&list, shared.wanted_references()) {
        let message = "something is cited, but no chapter holds {{#references}}";
        shared.problems.report(place, message);
    }
    let list = list.unwrap_or_default();
    let progress = progress_table(shared);
    for page in pages {
        let root = path_to_root(&page.path);
        let own = page.path.clone();
        page.html = resolve(&page.html, |kind, name| match kind {
            "figure-page" => match figures.get(name) {
                Some((path, _)) if *path == own => format!("#{}", escape(name)),
                Some((path, _)) => format!("{root}{path}#{}", escape(name)),
                None => String::new(),
            },
            "figure-number" => figures
                .get(name)
                .map(|(_, number)| format!("Figure {number}"))
                .unwrap_or_default(),
            "solved" => solved_mark(shared, name),
            "progress" => progress.replace("href=\"", &format!("href=\"{root}")),
            "panel" => name
                .parse()
                .ok()
                .and_then(|index: usize| panels.get(index))
                .map_or_else(String::new, |panel| {
                    format!("<template shadowrootmode=\"open\">{panel}</template>")
                }),
            PAGE_OF_REFERENCES => format!("{root}{list}"),
            _ => String::new(),
        });
    }
}

/// The mark of a folder with the page that stands where the Lab will be.
const STAND_IN: &str = ".stand-in";

/// Writes the site beside its place and then moves it there, so that a reader never sees half.
fn write(files: &BTreeMap<String, Vec<u8>>, out: &Path) -> Result<()> {
    let next = out.with_extension("next");
    remove(&next)?;
    for (path, bytes) in files {
        let path = next.join(path);
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)
                .with_context(|| format!("cannot make the folder {}", folder.display()))?;
        }
        std::fs::write(&path, bytes).with_context(|| format!("cannot write {}", path.display()))?;
    }
    // The Lab takes minutes to build, and a chapter's words seconds.
    let (lab, kept) = (out.join(LAB_FOLDER), next.join(LAB_FOLDER));
    if lab.is_dir() && !lab.join(STAND_IN).exists() {
        remove(&kept)?;
        std::fs::rename(&lab, &kept)
            .with_context(|| format!("cannot keep the Lab at {}", lab.display()))?;
    }
    remove(out)?;
    std::fs::rename(&next, out).with_context(|| format!("cannot put the site at {}", out.display()))
}

fn remove(folder: &Path) -> Result<()> {
    match std::fs::remove_dir_all(folder) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
            Err(error).with_context(|| format!("cannot remove {}", folder.display()))
        }
        _ => Ok(()),
    }
}
