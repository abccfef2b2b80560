//! Pins of a write-up: proposed where the compared settings differ most, and kept in a file that may be edited.

use std::collections::BTreeMap;
use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use glam::DVec2;
use toml::Spanned;

use crate::cli::failure::Failure;
use crate::cli::picture::Picture;
use crate::compare::Pair;
use crate::figure::{InsetPlace, InsetSpec, NewFile};
use crate::viewer::PictureSpec;

/// The file in the folder of a write-up.
pub(super) const FILE: &str = "pins.toml";
/// Largest file that is read, in bytes.
const MAX_BYTES: u64 = 1 << 20;
/// What the file says first.
const HEAD: &str = "# Where insets look: X,Y:REGION@FACTOR:CORNER, with u before X for canvas units.\n\
                    # Edit a line and run `rasterscope writeup` again; a line that is deleted is proposed anew.\n";

/// The pins by their names.
#[derive(Debug, Default)]
pub(super) struct Pins {
    path: PathBuf,
    /// The file as it was, with its comments.
    text: String,
    places: BTreeMap<String, InsetSpec>,
    /// Where those of the file stand in its text.
    spans: BTreeMap<String, Range<usize>>,
    /// Whether a pin of the file was forgotten.
    is_cut: bool,
    /// Names of those that were proposed since.
    new: Vec<String>,
}

impl Pins {
    /// Reads the file, which need not exist; its names must be among `known`.
    pub(super) fn read(path: PathBuf, known: &[&str]) -> Result<Self, Failure> {
        let text = match text_of(&path) {
            Ok(text) => text,
            // What is wrong with the folder is told when it is made.
            Err(error) if matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) => {
                String::new()
            }
            Err(error) => {
                return Err(Failure::input(format!(
                    "{}: cannot read the pins: {error}; give a text file or remove it",
                    path.display()
                )));
            }
        };
        Self::parse(&text, path, known)
    }

    /// The pins in `text`, which is that of the file `path`.
    pub(super) fn parse(text: &str, path: PathBuf, known: &[&str]) -> Result<Self, Failure> {
        let refused = |why: String| Failure::input(format!("{}: {why}", path.display()));
        let lines: BTreeMap<Spanned<String>, Spanned<String>> = toml::from_str(text).map_err(|error| {
            let line = line_of(text, error.span().map_or(0, |span| span.start));
            refused(format!(
                "line {line}: {}; a pin is a line such as test4 = \"u614,777:16@8:auto\"",
                error.message()
            ))
        })?;
        let (mut places, mut spans) = (BTreeMap::new(), BTreeMap::new());
        for (key, value) in lines {
            let span = key.span().start..value.span().end;
            let (name, line) = (key.into_inner(), line_of(text, span.start));
            if !known.contains(&name.as_str()) {
                return Err(refused(format!(
                    "line {line}: no figure has the pin {name}; the pins are {}",
                    known.join(", ")
                )));
            }
            let pin = value.get_ref().parse();
            let pin = pin.map_err(|error| refused(format!("line {line}: {name}: {error}")))?;
            places.insert(name.clone(), pin);
            spans.insert(name, span);
        }
        let new = Vec::new();
        Ok(Self {
            path,
            text: text.to_owned(),
            places,
            spans,
            is_cut: false,
            new,
        })
    }

    /// The pin of that name in the file.
    pub(super) fn kept(&self, name: &str) -> Option<InsetSpec> {
        self.spans.get(name).and(self.places.get(name)).copied()
    }

    /// Takes the pin out of the file, so that it is proposed anew.
    pub(super) fn forget(&mut self, name: &str) -> Result<(), Failure> {
        let Some(span) = self.spans.get(name) else {
            return Ok(());
        };
        let start = self.text[..span.start].rfind('\n').map_or(0, |end| end + 1);
        let end = self.text[span.end..]
            .find('\n')
            .map_or(self.text.len(), |end| span.end + end + 1);
        let text = [&self.text[..start], &self.text[end..]].concat();
        // The others stand elsewhere now.
        let known: Vec<&str> = self.spans.keys().map(String::as_str).collect();
        let Self { places, spans, .. } = Self::parse(&text, self.path.clone(), &known)?;
        (self.text, self.places, self.spans, self.is_cut) = (text, places, spans, true);
        Ok(())
    }

    /// Whether [`Pins::file`] lacks a line of what was there.
    pub(super) fn is_cut(&self) -> bool {
        self.is_cut
    }

    /// Whether the file was made by a write-up, and may be written anew.
    pub(super) fn is_ours(&self) -> bool {
        HEAD.lines().next().is_some_and(|first| self.text.contains(first))
    }

    /// What is wrong with a pin of the file.
    pub(super) fn at_fault(&self, name: &str, why: &str) -> String {
        let line = line_of(&self.text, self.spans.get(name).map_or(0, |span| span.start));
        format!("{}: line {line}: {name}: {why}", self.path.display())
    }

    /// A failure of the figure that looks at a pin, in the terms of the file where that is at fault.
    pub(super) fn blamed(&self, name: &str, failure: Failure) -> Failure {
        match (failure, self.kept(name)) {
            (Failure::Input(problem), Some(pin)) => {
                let why = problem.split_once(&format!("--inset {pin}: "));
                let own = why.map(|(_, why)| self.at_fault(name, why));
                Failure::Input(own.unwrap_or(problem))
            }
            (failure, _) => failure,
        }
    }

    /// The file's name in messages.
    pub(super) fn path(&self) -> &Path {
        &self.path
    }

    /// The pin of that name; a new one lies where the pictures that `specs` gives differ most.
    pub(super) fn get(
        &mut self,
        name: &str,
        specs: impl FnOnce() -> Result<[PictureSpec; 2], Failure>,
    ) -> Result<InsetSpec, Failure> {
        if let Some(pin) = self.places.get(name) {
            return Ok(*pin);
        }
        let pin = propose(&specs()?)?;
        self.places.insert(name.to_owned(), pin);
        self.new.push(name.to_owned());
        Ok(pin)
    }

    /// The file with all pins: what was there stays as it is, and new ones follow. `None` where there is nothing new.
    pub(super) fn file(&self) -> Option<NewFile> {
        if self.new.is_empty() && !self.text.is_empty() {
            return None;
        }
        let mut text = self.text.clone();
        if text.is_empty() {
            text.push_str(HEAD);
        } else if !text.ends_with('\n') {
            text.push('\n');
        }
        for name in &self.new {
            let line = self.places.get(name).map(|pin| format!("{name} = \"{pin}\"\n"));
            text.extend(line);
        }
        Some(NewFile::by_user(&self.path, text.into_bytes()))
    }
}

/// The line of a byte, from 1.
fn line_of(text: &str, byte: usize) -> usize {
    let before = text.as_bytes().iter().take(byte);
    1 + before.filter(|byte| **byte == b'\n').count()
}

fn text_of(path: &Path) -> io::Result<String> {
    let about = std::fs::metadata(path)?;
    if !about.is_file() || about.len() > MAX_BYTES {
        return Err(io::Error::new(
            io::ErrorKind::InvalidInput,
            "it is not a small text file",
        ));
    }
    std::fs::read_to_string(path)
}

/// An inset of a quarter of the picture around the place where two pictures of it differ most.
fn propose(specs: &[PictureSpec; 2]) -> Result<InsetSpec, Failure> {
    let mut pictures = Vec::new();
    for spec in specs {
        let mut picture = Picture::read(spec.clone())?;
        picture.draw();
        pictures.push(picture);
    }
    let [a, b] = pictures.as_slice() else {
        return Err(Failure::other("two pictures make a pair"));
    };
    let side = a.frame().width().min(a.frame().height());
    let region = 16;
    let factor = (side / 4 / region).clamp(3, 24) - 1;
    let pair = Pair::new(a.frame(), b.frame()).map_err(Failure::input)?;
    // Settings that make no difference are looked at in the middle.
    let middle = [a.frame().width() / 2, a.frame().height() / 2];
    let [x, y] = pair.busiest(region).unwrap_or(middle).map(f64::from);
    let view = specs[0].view.transform(a.scene.canvas, specs[0].size);
    let place = view.to_scene(DVec2::new(x, y) + 0.5);
    // A hundredth of a pixel is exact enough, and short to read.
    let digits = 10.0_f64.powf(
        (view.to_pixels(DVec2::X) - view.to_pixels(DVec2::ZERO))
            .length()
            .log10()
            .ceil()
            + 2.0,
    );
    let short = (place * digits).round() / digits;
    let inset = InsetSpec::around(InsetPlace::User(short), region, factor);
    Ok(inset.beside(&a.subject(), specs[0].size))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Pins, String> {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let path = folder.path().join(FILE);
        std::fs::write(&path, text).expect("a small file");
        Pins::read(path, &["test4", "own"]).map_err(|failure| match failure {
            Failure::Input(problem) => problem,
            other => panic!("{other:?}"),
        })
    }

    #[test]
    fn pins_are_read_as_they_are_written() {
        let text = |pins: &Pins| String::from_utf8(pins.file().expect("a new pin").bytes).expect("text");
        let mut pins = read("").expect("no pins");
        for (name, pin) in [("own", "3,4"), ("test4", "u614,777:16@8:auto")] {
            pins.places.insert(name.to_owned(), pin.parse().expect("a pin"));
            pins.new.push(name.to_owned());
        }
        let text = text(&pins);
        assert!(text.starts_with("# Where insets look"), "{text}");
        assert!(
            text.contains("own = \"3,4:16@8:auto\"\ntest4 = \"u614,777:16@8:auto\"\n"),
            "{text}"
        );
        assert_eq!(read(&text).expect("its own").places, pins.places, "and back");
    }

    #[test]
    fn pins_keep_what_their_user_wrote() {
        let written = "# mine\r\ntest4 = \"u614,777:16@8:auto\" # the tip";
        let mut pins = read(written).expect("one pin");
        assert!(pins.file().is_none(), "nothing new, nothing written");
        pins.places.insert("own".to_owned(), "3,4".parse().expect("a pin"));
        pins.new.push("own".to_owned());
        let file = pins.file().expect("a new pin");
        let text = String::from_utf8(file.bytes).expect("text");
        assert_eq!(
            text,
            format!("{written}\nown = \"3,4:16@8:auto\"\n"),
            "as it was, and the new one"
        );
        assert_eq!(read(&text).expect("its own").places, pins.places, "and back");
    }

    #[test]
    fn pins_that_are_forgotten_are_proposed_anew() {
        let mut pins = read("# mine\nown = \"3,4\" # old\ntest4 = \"5,6\"").expect("two pins");
        pins.forget("own").expect("the rest is as it was");
        assert_eq!(
            (pins.kept("own"), pins.text.as_str()),
            (None, "# mine\ntest4 = \"5,6\""),
            "its line"
        );
        pins.forget("own").expect("nothing to do");
        let test4 = pins.kept("test4").expect("the other");
        let outside = || Failure::input(format!("--inset {test4}: outside"));
        match pins.blamed("test4", outside()) {
            Failure::Input(problem) => assert!(problem.ends_with("pins.toml: line 2: test4: outside"), "{problem}"),
            other => panic!("{other:?}"),
        }
        assert_eq!(
            pins.blamed("own", outside()).into_line(),
            format!("--inset {test4}: outside"),
            "no pin of the file"
        );
    }

    #[test]
    fn pins_at_fault_are_told_in_one_line() {
        for (text, words) in [
            ("# mine\ntest4 = \"middle\"", "line 2: test4: an inset is X,Y"),
            (
                "own = \"3,4\"\n\ntest5 = \"3,4\"",
                "line 3: no figure has the pin test5; the pins are test4, own",
            ),
            ("\ntest4 = ", "line 2:"),
            ("test4 = 5", "line 1:"),
            ("[test4]\nx = 1", "line 1:"),
        ] {
            let problem = read(text).expect_err("at fault");
            assert!(problem.contains(words) && problem.contains(FILE), "{text}: {problem}");
        }
    }
}
