//! A local server for readers and authors. It behaves like a good static host (MIME types,
//! compressed copies, Content-Security-Policy, CORS for embedding sites), watches the sources, and
//! reloads open pages.

use crate::html::escape;
use crate::phases::Phases;
use crate::problems::Problem;
use crate::render::links::LAB_FOLDER;
use crate::resolve::figures::Widgets;
use crate::site::{Options, Outcome, build};
use crate::write::manual::{MANUAL_FOLDER, REFERENCE_FOLDER};
use crate::write::policy::{FRAME_POLICY, LAB_POLICY, MANUAL_POLICY, PROGRAM_POLICY};
use anyhow::{Context, Result};
use axum::Router;
use axum::extract::Request;
use axum::http::header::{self, HeaderName, HeaderValue};
use axum::middleware::{Next, from_fn};
use axum::response::sse::{Event, KeepAlive, Sse};
use axum::response::{IntoResponse, Response};
use axum::routing::get;
use notify::{RecursiveMode, Watcher};
use std::collections::BTreeSet;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::mpsc;
use std::time::{Duration, Instant};
use tokio::sync::broadcast;
use tokio_stream::StreamExt;
use tokio_stream::wrappers::BroadcastStream;
use tower_http::services::{ServeDir, ServeFile};

/// Reloads an open page on a message from the server.
const RELOAD_SCRIPT: &str = "new EventSource(document.currentScript.dataset.events)\
    .addEventListener('reload', () => location.reload());\n";

/// Watched paths, below the project.
const WATCHED: &[&str] = &[
    "content",
    "web/src",
    "web/theme",
    "web/book",
    "web/offline",
    "web/run",
    "web/vision/src",
    "crates/epipole/src",
    "crates/epipole-canvas/src",
    "crates/epipole-widgets/src",
    "crates/epipole-web/src",
    "crates/epipole-js/src",
];

/// Serves the site at `http://localhost:PORT`. With `watch`, builds it first, and again when a
/// source changes.
///
/// # Errors
/// A busy port, or a missing tool at the first build.
pub fn serve(options: &Options, port: u16, watch: bool) -> Result<()> {
    let listener = listen(port)?;
    let (reload, _) = broadcast::channel(16);
    if watch {
        println!("building …");
        rebuild(options, false)?;
        let (options, reload) = (options.clone(), reload.clone());
        std::thread::spawn(move || {
            if let Err(error) = watch_sources(&options, &reload) {
                eprintln!("error: the sources cannot be watched: {error:#}");
            }
        });
    }
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()?;
    runtime.block_on(async {
        let listener = tokio::net::TcpListener::from_std(listener)?;
        println!("the book is at http://localhost:{port}");
        axum::serve(listener, app(&options.out, reload)).await
    })?;
    Ok(())
}

fn listen(port: u16) -> Result<std::net::TcpListener> {
    let listener = std::net::TcpListener::bind(("127.0.0.1", port)).map_err(|error| {
        if error.kind() == ErrorKind::AddrInUse {
            let other = port.checked_add(1).unwrap_or(8000);
            anyhow::anyhow!("port {port} is in use: take another, as in `make serve PORT={other}`")
        } else {
            anyhow::anyhow!("port {port} cannot be used: {error}")
        }
    })?;
    listener.set_nonblocking(true)?;
    Ok(listener)
}

/// Returns a router for the site in `folder`, with the headers of a good host.
pub fn app(folder: &Path, reload: broadcast::Sender<()>) -> Router {
    let files = ServeDir::new(folder)
        .precompressed_br()
        .precompressed_gzip()
        .not_found_service(ServeFile::new(folder.join("404.html")));
    let events = move || {
        let stream = BroadcastStream::new(reload.subscribe())
            .map(|_| Ok::<_, std::convert::Infallible>(Event::default().event("reload").data("")));
        async move { Sse::new(stream).keep_alive(KeepAlive::default()) }
    };
    let script = || async { ([(header::CONTENT_TYPE, "text/javascript")], RELOAD_SCRIPT) };
    Router::new()
        .route("/-/reload", get(events))
        .route("/-/reload.js", get(script))
        .fallback_service(files)
        .layer(from_fn(headers))
}

/// Returns the Content-Security-Policy of the page at this path.
fn policy_of(path: &str) -> &'static str {
    let is_in = |folder: &str| path.contains(&format!("/{folder}/"));
    // Pages of single figures are meant for frames on other sites.
    if is_in("embed") {
        FRAME_POLICY
    } else if is_in(LAB_FOLDER) {
        LAB_POLICY
    } else if is_in(MANUAL_FOLDER) || is_in(REFERENCE_FOLDER) {
        MANUAL_POLICY
    } else {
        // Pages without runnable code restrict it further themselves.
        PROGRAM_POLICY
    }
}

async fn headers(request: Request, next: Next) -> Response {
    let hashed = request.uri().path().contains("/assets/");
    let policy = policy_of(request.uri().path());
    let mut response = next.run(request).await.into_response();
    let caching = if hashed {
        "public, max-age=31536000, immutable"
    } else {
        "no-cache"
    };
    let caching = if response.status().is_success() {
        caching
    } else {
        "no-cache"
    };
    let fixed = [
        (header::CONTENT_SECURITY_POLICY, policy),
        (header::ACCESS_CONTROL_ALLOW_ORIGIN, "*"),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::REFERRER_POLICY, "no-referrer"),
        (
            HeaderName::from_static("cross-origin-resource-policy"),
            "cross-origin",
        ),
        (header::CACHE_CONTROL, caching),
    ];
    for (name, value) in fixed {
        response
            .headers_mut()
            .insert(name, HeaderValue::from_static(value));
    }
    response
}

/// Rebuilds after changes, combining those in quick succession.
fn watch_sources(options: &Options, reload: &broadcast::Sender<()>) -> Result<()> {
    let (sender, changes) = mpsc::channel();
    let mut watcher = notify::recommended_watcher(move |event: notify::Result<notify::Event>| {
        if let Ok(event) = event
            && !event.kind.is_access()
        {
            // The receiver exists until the server stops.
            let _ = sender.send(event.paths);
        }
    })?;
    for folder in WATCHED {
        let folder = options.project.join(folder);
        if folder.is_dir() {
            watcher.watch(&folder, RecursiveMode::Recursive)?;
        }
    }
    let mut own_code_changed = false;
    while let Ok(first) = changes.recv() {
        let mut paths: BTreeSet<PathBuf> = first.into_iter().collect();
        while let Ok(more) = changes.recv_timeout(Duration::from_millis(120)) {
            paths.extend(more);
        }
        let is_noise = |path: &Path| {
            let name = path.file_name().unwrap_or_default().to_string_lossy();
            name.starts_with('.') || name.ends_with('~') || name.ends_with(".part")
        };
        paths.retain(|path| !is_noise(path));
        let Some(path) = paths.first() else { continue };
        let shown = path
            .strip_prefix(&options.project)
            .unwrap_or(path)
            .display();
        println!("{shown} changed; building …");
        own_code_changed |= paths
            .iter()
            .any(|path| path.starts_with(options.project.join("crates")));
        match rebuild(options, own_code_changed) {
            Ok(true) => {
                // No page may be open.
                let _ = reload.send(());
            }
            Ok(false) => {}
            Err(error) => eprintln!("error: {error:#}"),
        }
    }
    Ok(())
}

/// Rebuilds in this process or, when the figures' code has changed since it started, with a new
/// one. True if there is a new site.
fn rebuild(options: &Options, by_cargo: bool) -> Result<bool> {
    let start = Instant::now();
    if by_cargo {
        let status = Command::new(std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
            .args([
                "run",
                "--quiet",
                "--package",
                "epipole-book",
                "--",
                "build",
                "--live",
                "--out",
            ])
            .arg(&options.out)
            .current_dir(&options.project)
            .status()
            .context("cargo cannot be started")?;
        return Ok(status.success());
    }
    match build(options, &Widgets, &Phases::on_stderr())? {
        Outcome::Built { pages, .. } => {
            println!("{pages} pages in {:.1} s", start.elapsed().as_secs_f64());
            Ok(true)
        }
        Outcome::Problems(problems) => {
            for problem in &problems {
                eprintln!("{problem}");
            }
            if !options.out.join("index.html").is_file() {
                std::fs::create_dir_all(&options.out)?;
                std::fs::write(options.out.join("index.html"), problem_page(&problems))?;
            }
            Ok(false)
        }
    }
}

/// Returns the page shown while there is no site.
fn problem_page(problems: &[Problem]) -> String {
    let lines: Vec<String> = problems
        .iter()
        .map(|problem| escape(&problem.to_string()))
        .collect();
    format!(
        "<!doctype html>\n<html lang=\"en\"><meta charset=\"utf-8\"><title>Problems</title>\n\
         <script src=\"/-/reload.js\" data-events=\"/-/reload\"></script>\n\
         <h1>The book has problems</h1>\n<pre>{}</pre>\n</html>\n",
        lines.join("\n")
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::{Read, Write};

    /// Returns the response to a request, headers and body.
    fn response(folder: &Path, request: &str) -> String {
        let listener = listen(0).unwrap();
        let address = listener.local_addr().unwrap();
        let folder = folder.to_path_buf();
        std::thread::spawn(move || {
            let runtime = tokio::runtime::Builder::new_current_thread()
                .enable_all()
                .build()
                .unwrap();
            runtime.block_on(async {
                let listener = tokio::net::TcpListener::from_std(listener).unwrap();
                axum::serve(listener, app(&folder, broadcast::channel(1).0))
                    .await
                    .unwrap();
            });
        });
        let mut stream = std::net::TcpStream::connect(address).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        let mut bytes = Vec::new();
        stream.read_to_end(&mut bytes).unwrap();
        String::from_utf8_lossy(&bytes).into_owned()
    }

    #[test]
    fn headers_types_and_compressed_copies() {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("assets")).unwrap();
        std::fs::write(folder.path().join("assets/a-1.wasm"), "plain").unwrap();
        std::fs::write(folder.path().join("assets/a-1.wasm.br"), "small").unwrap();
        std::fs::write(folder.path().join("404.html"), "<p>none").unwrap();
        let request = |path: &str, more: &str| {
            format!("GET {path} HTTP/1.1\r\nhost: a\r\nconnection: close\r\n{more}\r\n")
        };
        let got = response(
            folder.path(),
            &request("/assets/a-1.wasm", "accept-encoding: br\r\n"),
        );
        for part in [
            "200 OK",
            "content-type: application/wasm",
            "content-encoding: br",
            "access-control-allow-origin: *",
            "content-security-policy: default-src 'none'; script-src 'self' 'wasm-unsafe-eval'",
            "max-age=31536000, immutable",
            "\r\n\r\nsmall",
        ] {
            assert!(got.contains(part), "{part}: {got}");
        }
        let got = response(folder.path(), &request("/assets/a-1.wasm", ""));
        assert!(got.ends_with("plain"), "{got}");
        let got = response(folder.path(), &request("/nothing", ""));
        assert!(
            got.contains("404 Not Found") && got.contains("<p>none"),
            "{got}"
        );
        assert!(got.contains("cache-control: no-cache"), "{got}");
    }

    #[test]
    fn a_busy_port_is_named_with_the_remedy() {
        let taken = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
        let port = taken.local_addr().unwrap().port();
        let message = listen(port).unwrap_err().to_string();
        assert!(
            message.contains(&format!("port {port} is in use")),
            "{message}"
        );
        assert!(message.contains("PORT="), "{message}");
    }
}
