//! The files of a sheet: the whole, its panels in a folder beside it, and what documents say about them.

use std::io;
use std::path::{Path, PathBuf};

use super::Sheet;
use super::captions::title;
use crate::figure::{Figure, encode_png, html, latex, markdown, save_files};

/// A file or folder that could not be written, and why.
pub type Unwritable = (PathBuf, io::Error);

impl Sheet {
    /// Writes all files of the sheet, or none, replacing those that were there; gives what documents say about it, from the
    /// folder it lies in.
    ///
    /// # Errors
    /// When one cannot be written.
    pub fn save(&self, output: &Path) -> Result<Figure, Unwritable> {
        let at = |path: &Path| {
            let path = path.to_owned();
            move |error| (path, error)
        };
        let folder = output.with_extension("");
        let whole_bytes = encode_png(&self.picture, Some(&self.record)).map_err(at(output))?;
        let mut files = vec![(output.to_owned(), whole_bytes)];
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
            let scene = title(&panel.spec.scene);
            let said = if panel.words.is_empty() {
                scene
            } else {
                format!("{scene}, {}", panel.words)
            };
            figures.push(Figure {
                file: name,
                caption: format!("{said}."),
                alternative: format!("The scene {said}."),
                command_line: record.command_line.clone(),
            });
            let bytes = encode_png(&panel.frame, Some(&record)).map_err(at(&path))?;
            files.push((path, bytes));
        }
        files.extend(snippets(&folder, &whole.file, &figures));
        let made = make_folder(&folder).map_err(at(&folder))?;
        save_files(&files).map_err(|error| {
            if made {
                // Only a folder that this made, and only while it is empty.
                let _ = std::fs::remove_dir(&folder);
            }
            (output.to_owned(), error)
        })?;
        Ok(whole)
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
fn snippets(folder: &Path, title: &str, figures: &[Figure]) -> [(PathBuf, Vec<u8>); 3] {
    [
        ("figures.md", markdown(figures)),
        ("figures.html", html(title, figures)),
        ("figures.tex", latex(figures)),
    ]
    .map(|(name, text)| (folder.join(name), text.into_bytes()))
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
        .replace(", ", "_")
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
