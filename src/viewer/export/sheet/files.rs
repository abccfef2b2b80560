//! The files of a sheet: the whole, its panels in a folder beside it, and what documents say about them.

use std::io;
use std::path::{Path, PathBuf};

use crate::figure::{Destination, Figure, Guard, NewFile, Unwritable, encode_png, html, latex, markdown, save_files};
use crate::viewer::export::sheet::captions::title;
use crate::viewer::export::sheet::drawing::{Panel, Sheet, SheetRequest};
use crate::viewer::settings::picture::NO_EFFECT;

/// What documents say about the sheet: for Markdown, HTML and LaTeX.
const SNIPPETS: [&str; 3] = ["figures.md", "figures.html", "figures.tex"];

impl SheetRequest {
    /// The files beside the sheet `output`, whose names the program chooses.
    pub fn files_beside(&self, output: &Path) -> Vec<PathBuf> {
        let panels = self.words().enumerate();
        let panels = panels.map(|(number, words)| panel_name(number, &words));
        let names = panels.chain(SNIPPETS.map(str::to_owned));
        let folder = output.with_extension("");
        names.map(|name| folder.join(name)).collect()
    }
}

impl Sheet {
    /// Writes all files of the sheet, or none, where `guard` has nothing against it; gives what documents say about the sheet,
    /// from the folder it lies in.
    ///
    /// # Errors
    /// When one cannot be written.
    pub fn save(&self, output: Destination<'_>, guard: &Guard) -> Result<Figure, Unwritable> {
        let mut guard = guard.clone();
        for panel in &self.panels {
            panel.spec.scene.protect(&panel.scene.files, &mut guard);
        }
        let folder = output.path.with_extension("");
        // Before the rest: records tell the way from there to the scene.
        let made = make_folder(&folder).map_err(|error| (folder.clone(), error))?;
        let (whole, files) = self.files(output, &folder).inspect_err(|_| remove(made, &folder))?;
        save_files(&files, &guard).inspect_err(|_| remove(made, &folder))?;
        Ok(whole)
    }

    /// What documents say about the sheet, and all its files.
    fn files(&self, output: Destination<'_>, folder: &Path) -> Result<(Figure, Vec<NewFile>), Unwritable> {
        let Destination { path: output, named } = output;
        let at = |path: &Path| {
            let path = path.to_owned();
            move |error| (path, error)
        };
        let bytes = encode_png(&self.picture, Some(&self.record)).map_err(at(output))?;
        let path = output.to_owned();
        let mut files = vec![NewFile { path, bytes, named }];
        let name = output.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let whole = Figure {
            file: name,
            caption: self.caption.clone(),
            alternative: format!("{} panels in a grid. {}", self.panels.len(), self.caption),
            command_line: self.record.command_line.clone(),
        };
        let mut figures = vec![Figure {
            file: format!("../{}", whole.file),
            ..whole.clone()
        }];
        for (number, panel) in self.panels.iter().enumerate() {
            let name = panel_name(number, &panel.words);
            let path = folder.join(&name);
            let record = panel.spec.record(&panel.scene, &path);
            let bytes = encode_png(&panel.frame, Some(&record)).map_err(at(&path))?;
            figures.push(panel.figure(name, record.command_line));
            files.push(NewFile::by_program(path, bytes));
        }
        files.extend(snippets(folder, &whole.file, &figures));
        Ok((whole, files))
    }
}

impl Panel {
    /// What documents say about the panel alone.
    fn figure(&self, file: String, command_line: String) -> Figure {
        let scene = title(&self.spec.scene);
        let said = if self.words.is_empty() {
            scene
        } else {
            format!("{scene}, {}", self.words)
        };
        Figure {
            file,
            caption: format!("{said}."),
            alternative: format!("The scene {said}."),
            command_line,
        }
    }
}

/// Removes a folder that this `made`, while it is empty.
fn remove(made: bool, folder: &Path) {
    if made {
        // The first error is the one to tell.
        let _ = std::fs::remove_dir(folder);
    }
}

/// Makes the folder of panels and snippets; whether it was not there.
fn make_folder(folder: &Path) -> io::Result<bool> {
    if folder.is_dir() {
        return Ok(false);
    }
    std::fs::create_dir(folder).map(|()| true)
}

/// The figures in the words of documents.
fn snippets(folder: &Path, title: &str, figures: &[Figure]) -> [NewFile; 3] {
    let texts = [markdown(figures), html(title, figures), latex(figures)];
    let mut names = SNIPPETS.into_iter();
    texts.map(|text| NewFile::by_program(folder.join(names.next().unwrap_or_default()), text.into_bytes()))
}

/// The file of a panel: its number and what tells it apart.
fn panel_name(number: usize, words: &str) -> String {
    let plain = |c: char| {
        if c.is_ascii_alphanumeric() || c == '-' || c == '.' {
            c
        } else {
            '-'
        }
    };
    let words: String = words
        .replace(&format!(" {NO_EFFECT}"), "")
        .replace(", ", "_")
        .replace(['(', ')'], "")
        .chars()
        .map(|c| if c == '_' { c } else { plain(c) })
        .take(120)
        .collect();
    let number = number + 1;
    if words.is_empty() {
        format!("{number:02}.png")
    } else {
        format!("{number:02}_{words}.png")
    }
}
