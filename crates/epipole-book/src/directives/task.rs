//! `{{#task name | Title}}` … `{{/task}}`: a programming task with the fences `start`, `check` and
//! `solution`. In Python it is part of the notebook. In JavaScript readers solve it in the page;
//! its check is the body of a function that returns "Right: …" or "Not yet: …".

use crate::hash::fnv;
use crate::html::{escape, path_to_root};
use crate::parse::text::Request;
use crate::problems::{Place, name_list};
use crate::render::code::{COPY, Heading, run_button, shown, take_name};
use crate::render::directive::{Directive, ParsedText, Parser, Text};
use crate::render::insert::{Block, Fence, Insert, Words};
use crate::render::listing::pre;
use crate::render::notebook::{self, Cell, Tasks};
use crate::render::page::Solvable;
use crate::render::writer::Writer;
use crate::resolve::book::Book;

/// The fences.
const FENCES: [&str; 3] = ["start", "check", "solution"];

/// The start of a task. `T` is the stage of its title.
pub(super) struct Task<T> {
    name: String,
    /// The title as Markdown.
    written: String,
    title: T,
}

impl Directive for Task<ParsedText> {
    const NAME: &'static str = "task";
    type Resolved = Task<Text>;

    fn parse(request: &Request, parser: &Parser) -> Result<Self, String> {
        let name = request.one_word("name | Title")?;
        let Some(title) = &request.body else {
            return Err("write {{#task name | Title}}".to_owned());
        };
        Ok(Task {
            name: name.to_owned(),
            written: title.text().to_owned(),
            title: parser.text(title),
        })
    }

    fn resolve(self, book: &Book) -> Result<Task<Text>, String> {
        Ok(Task {
            name: self.name,
            written: self.written,
            title: self.title.resolve(book),
        })
    }

    fn render(task: Task<Text>, page: &mut Writer) -> Insert {
        let heading = Heading {
            name: task.name,
            title: task.written,
            html: task.title.inline(page),
        };
        Insert::Opening(Box::new(Opened(heading)))
    }
}

/// A task before its text and fences.
struct Opened(Heading);

impl Block for Opened {
    fn end(&self) -> &'static str {
        "{{/task}}"
    }

    fn render(&self, page: &mut Writer, words: Words, fences: &[Fence], place: &Place) -> String {
        if !take_name(page, &self.0.name, place) {
            return String::new();
        }
        self.html(page, &words, fences).unwrap_or_else(|message| {
            page.report(place.clone(), message);
            String::new()
        })
    }
}

impl Opened {
    fn html(&self, page: &mut Writer, words: &Words, fences: &[Fence]) -> Result<String, String> {
        let Heading { name, title, html } = &self.0;
        let found: Vec<&str> = fences.iter().map(|fence| fence.word.as_str()).collect();
        let [start, check, solution] = fences else {
            return Err(self.wrong_fences());
        };
        let language = start.language.as_str();
        let is_one = fences.iter().all(|fence| fence.language == language);
        if found != FENCES || !is_one || !matches!(language, "python" | "js") {
            return Err(self.wrong_fences());
        }
        let code = pre(&shown(start, page), language);
        let solved = pre(&shown(solution, page), language);
        if language == "js" {
            let chapter = page.page.path.trim_end_matches(".html").replace('/', "-");
            let hash = format!(
                "{:016x}",
                fnv(format!("{}{}", start.code, check.code).as_bytes())
            );
            page.page.has_programs = true;
            page.page.tasks.push(Solvable {
                id: format!("task-{name}"),
                hash: hash.clone(),
            });
            return Ok(format!(
                "{words}<div class=\"listing task\" id=\"task-{name}\" data-chapter=\"{chapter}\" data-hash=\"{hash}\" \
                 role=\"group\" aria-labelledby=\"task-{name}-title\">\n\
                 <div class=\"listing-bar\"><p class=\"listing-title\" id=\"task-{name}-title\">{html}</p>\
                 {run}{COPY}<p class=\"listing-only\">JavaScript</p></div>\n\
                 <div class=\"listing-part\" data-tab=\"js\">\n{code}</div>\n\
                 <template class=\"check\">{check}</template>\n</div>\n\
                 <details><summary>Solution</summary>\n{solved}</details>\n",
                words = words.html,
                run = run_button("Check", ""),
                check = escape(&check.code),
            ));
        }
        let cell = |word: &str, fence: &Fence, solution: Option<&Fence>| Cell::Code {
            id: format!("{name}-{word}"),
            source: fence.code.clone(),
            prints: String::new(),
            solution: solution.map(|fence| fence.code.clone()),
        };
        page.page.cells.extend([
            Cell::text(format!(
                "## Your turn: {title}\n\n{}",
                words.markdown.trim()
            )),
            cell("start", start, Some(solution)),
            Cell::text("The next cell looks at your function and says what is missing.".to_owned()),
            cell("check", check, None),
        ]);
        let (file, root) = (
            notebook::path(&page.page.path, Tasks::Open),
            path_to_root(&page.page.path),
        );
        Ok(format!(
            "{words}<div class=\"listing task\" id=\"task-{name}\" role=\"group\" aria-labelledby=\"task-{name}-title\">\n\
             <div class=\"listing-bar\"><p class=\"listing-title\" id=\"task-{name}-title\">{html}</p>\
             {COPY}<p class=\"listing-only\">Python</p></div>\n\
             <div class=\"listing-part\">\n{code}</div>\n</div>\n\
             <p>Write it in <a href=\"{root}{file}\" download>the notebook</a>. The cell below it says what is wrong.</p>\n\
             <details><summary>Solution</summary>\n{solved}</details>\n",
            words = words.html,
        ))
    }

    fn wrong_fences(&self) -> String {
        let wanted = ["python", "js"].map(|language| {
            let fences: Vec<String> = FENCES.map(|word| format!("{language} {word}")).into();
            name_list(&fences)
        });
        format!(
            "task {} has the fences {}",
            self.0.name,
            wanted.join(", or ")
        )
    }
}
