//! File dialogs of the desktop, by an external program, to avoid another toolkit as a dependency.

use std::io::ErrorKind;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// Kind of file dialog.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FileKind {
    /// Any number of photographs.
    Photographs,
    /// One project.
    Project,
    /// Camera files: one file, or those of a model.
    Cameras,
}

impl FileKind {
    fn title(self) -> &'static str {
        match self {
            Self::Photographs => "Add photographs",
            Self::Project => "Open a project",
            Self::Cameras => "Open cameras",
        }
    }

    fn label(self) -> &'static str {
        match self {
            Self::Photographs => "Photographs",
            Self::Project => "Projects",
            Self::Cameras => "Cameras",
        }
    }

    /// Extensions of the files, lower case.
    pub(super) fn endings(self) -> &'static [&'static str] {
        match self {
            Self::Photographs => &[
                "jpg", "jpeg", "png", "webp", "tif", "tiff", "bmp", "pgm", "ppm",
            ],
            Self::Project => &["zip"],
            Self::Cameras => &["yml", "yaml", "json", "xml", "txt", "bin", "out"],
        }
    }

    /// Patterns of the files: `*.jpg *.JPG …`.
    fn patterns(self) -> String {
        let endings = self.endings().iter();
        let both =
            endings.flat_map(|end| [format!("*.{end}"), format!("*.{}", end.to_uppercase())]);
        both.collect::<Vec<_>>().join(" ")
    }

    /// Dialog programs with their arguments; they print one path per line.
    fn programs(self) -> Vec<(&'static str, Vec<String>)> {
        let title = self.title();
        let name = self.label();
        if cfg!(target_os = "macos") {
            let many = match self {
                Self::Photographs => " with multiple selections allowed",
                Self::Project | Self::Cameras => "",
            };
            // `as list` makes a single file a list, so that the loop handles both.
            let script = format!(
                "set all to \"\"\nrepeat with one in ((choose file with prompt \"{title}\"{many}) as list)\n\
                 set all to all & POSIX path of one & linefeed\nend repeat\nall"
            );
            return vec![("osascript", vec!["-e".to_owned(), script])];
        }
        if cfg!(windows) {
            let patterns = self.patterns().replace(' ', ";");
            let many = self != Self::Project;
            let script = format!(
                "Add-Type -AssemblyName System.Windows.Forms; [Console]::OutputEncoding = [Text.Encoding]::UTF8; \
                 $d = New-Object System.Windows.Forms.OpenFileDialog; $d.Title = '{title}'; $d.Multiselect = ${many}; \
                 $d.Filter = '{name}|{patterns}'; if ($d.ShowDialog() -eq 'OK') {{ $d.FileNames }}"
            );
            let words = ["-NoProfile", "-STA", "-Command", &script];
            return vec![("powershell", words.map(str::to_owned).to_vec())];
        }
        let patterns = self.patterns();
        let mut zenity = vec![
            "--file-selection".to_owned(),
            format!("--title={title}"),
            format!("--file-filter={name} | {patterns}"),
        ];
        let mut kdialog = vec!["--title".to_owned(), title.to_owned()];
        if self != Self::Project {
            zenity.extend(["--multiple".to_owned(), "--separator=\n".to_owned()]);
            kdialog.extend(["--multiple", "--separate-output"].map(str::to_owned));
        }
        kdialog.extend([
            "--getopenfilename".to_owned(),
            ".".to_owned(),
            format!("{name} ({patterns})"),
        ]);
        vec![("zenity", zenity), ("kdialog", kdialog)]
    }
}

/// Opens the dialog and waits for the choice: empty if canceled, `None` without a dialog program.
pub(super) fn ask(kind: FileKind) -> Option<Vec<PathBuf>> {
    for (program, arguments) in kind.programs() {
        let asked = Command::new(program)
            .args(arguments)
            .stdin(Stdio::null())
            .stderr(Stdio::null())
            .output();
        match asked {
            Ok(output) => {
                let words = String::from_utf8_lossy(&output.stdout);
                let lines = words.lines().map(|line| line.trim_end_matches('\r'));
                return Some(
                    lines
                        .filter(|line| !line.is_empty())
                        .map(PathBuf::from)
                        .collect(),
                );
            }
            Err(error) if error.kind() == ErrorKind::NotFound => {}
            Err(_) => return None,
        }
    }
    None
}
