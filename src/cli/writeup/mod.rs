//! `rasterscope writeup`: all figures of a write-up in one go, each of which can be drawn again alone.

mod course;
mod pins;

use std::ffi::OsString;
use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use self::course::{ITEMS, Item, OWN, PinnedInset, Scenes, turned_view};
use self::pins::Pins;
use super::arguments::{self, Verb};
use super::failure::{Failure, print, print_error};
use super::options::sampling::sampling_of;
use super::options::writeup::WriteupOptions;
use super::picture::spec_of_render;
use super::picture::{Picture, on_threads};
use super::render::unwritable;
use super::{progress, sheet};
use crate::figure::{Destination, Figure, Guard, Named, NewFile, html, latex, markdown, save_files, save_picture};
use crate::plain;
use crate::viewer::{PictureSpec, Sheet, caption_of};

/// What shows the figures, in the words of documents.
const PAGES: [&str; 3] = ["index.html", "figures.md", "figures.tex"];
/// How often a panel is drawn for its median time.
const TIMED: usize = 7;

/// Draws every figure and writes the pages that show them.
pub(super) fn run(options: &WriteupOptions) -> Result<(), Failure> {
    let folder = &options.output;
    if folder.exists() && !folder.is_dir() {
        return Err(Failure::input(format!(
            "{}: there is a file of that name; give a folder with -o",
            folder.display()
        )));
    }
    let scenes = Scenes::new(options)?;
    let pins_file = options.pins.clone().unwrap_or_else(|| folder.join(pins::FILE));
    let had_pins = pins_file.exists();
    let mut pins = Pins::read(pins_file, &known_pins())?;
    forget_stale_pin(&scenes, &mut pins)?;
    let inner = folder.join("scenes");
    let guard = guard(options, options.force);
    // Asked before minutes of work, and before a folder is made.
    for page in PAGES.map(|name| folder.join(name)) {
        let target = guard.target(&page, Named::ByProgram);
        target.map_err(|error| unwritable(&page, &error))?;
    }
    std::fs::create_dir_all(&inner).map_err(|error| unwritable(&inner, &error))?;
    save_files(&made_scenes(&scenes, &inner), &guard).map_err(|(path, error)| unwritable(&path, &error))?;
    let figures = on_threads(options.threads, || all(options, &guard, &scenes, &mut pins))??;
    let title = "Figures of the write-up";
    let texts = [html(title, &figures), markdown(&figures), latex(&figures)];
    let pages = PAGES.into_iter().zip(texts);
    let mut files: Vec<_> = pages
        .map(|(name, text)| NewFile::by_program(folder.join(name), text.into_bytes()))
        .collect();
    files.extend(pins.file().filter(|_| !pins.is_cut()));
    save_files(&files, &guard).map_err(|(path, error)| unwritable(&path, &error))?;
    if let Some(file) = pins.file().filter(|_| pins.is_cut()) {
        // A file of ours that lacks one line of ours: its user's words are all in there.
        let guard = self::guard(options, true);
        save_files(&[file], &guard).map_err(|(path, error)| unwritable(&path, &error))?;
    }
    let (count, page) = (figures.len(), folder.join("index.html").display().to_string());
    print(&format!("{count} figures; {} shows all", plain::line(&page)))?;
    match (&options.pins, had_pins) {
        // Whoever names a file of pins may have meant one that is there.
        (Some(file), false) => print(&format!(
            "{}: there was no such file; it has the places of all insets now",
            plain::line(&file.display().to_string())
        )),
        _ => Ok(()),
    }
}

/// Protects what the options name.
fn guard(options: &WriteupOptions, force: bool) -> Guard {
    let mut guard = Guard::new(force);
    for input in [&options.own, &options.robot].into_iter().flatten() {
        guard.protect(input);
    }
    guard
}

/// The scenes that are made for the write-up, in the folder `inner`. The picture beside them is a copy of the user's, so
/// that a scene of ours that shows it is what tells that it may be replaced.
fn made_scenes(scenes: &Scenes<'_>, inner: &Path) -> Vec<NewFile> {
    let has_scene = inner.join("own.svg").is_file();
    let made = scenes.files.iter().map(|(path, bytes)| {
        let is_copy = path.extension().is_none_or(|ending| ending != "svg");
        let named = if is_copy && has_scene {
            Named::ByUser
        } else {
            Named::ByProgram
        };
        let (path, bytes) = (path.clone(), bytes.clone());
        NewFile { path, bytes, named }
    });
    made.collect()
}

/// Whether `text` is a file of pins that `writeup` takes.
///
/// # Errors
/// One line for the first mistake.
pub(super) fn check_pins(text: &str) -> Result<(), Failure> {
    Pins::parse(text, pins::FILE.into(), &known_pins()).map(drop)
}

/// The names that pins may have, each once.
fn known_pins() -> Vec<&'static str> {
    let mut names: Vec<&str> = Vec::new();
    for name in ITEMS.iter().filter_map(|item| Some(item.pin?.name)) {
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// Says that the pin in the user's own picture is proposed anew, where that picture is another than the pin was meant for. A
/// file that somebody else wrote keeps its pins, and those outside of the picture are refused.
fn forget_stale_pin(scenes: &Scenes<'_>, pins: &mut Pins) -> Result<(), Failure> {
    let Some(pin) = pins.kept(OWN) else { return Ok(()) };
    if !pins.is_ours() {
        let why = scenes.why_outside(pin.at);
        let cure = "move it, or delete the line, and it is proposed anew";
        return why.map_or(Ok(()), |why| {
            Err(Failure::Input(pins.at_fault(OWN, &format!("{why}; {cure}"))))
        });
    }
    let Some(why) = scenes.why_stale(pin.at) else {
        return Ok(());
    };
    let path = pins.path().display();
    print_error(&format!("{path}: the pin {OWN} is proposed anew, for {why}"));
    pins.forget(OWN)
}

/// Draws the figures one after the other.
fn all(options: &WriteupOptions, guard: &Guard, scenes: &Scenes<'_>, pins: &mut Pins) -> Result<Vec<Figure>, Failure> {
    progress::count(ITEMS.len());
    let mut figures = Vec::new();
    for item in ITEMS {
        progress::begin(item.name);
        let output = options.output.join(item.name).with_extension("png");
        let figure = one(item, &output, guard, scenes, pins)?;
        figures.push(Figure {
            caption: format!("{}. {}", item.says, figure.caption),
            alternative: format!("{}. {}", item.says, figure.alternative),
            ..figure
        });
        progress::done();
    }
    Ok(figures)
}

/// Draws one figure and writes it.
fn one(item: &Item, output: &Path, guard: &Guard, scenes: &Scenes<'_>, pins: &mut Pins) -> Result<Figure, Failure> {
    // Asked before the work as well.
    let target = guard.target(output, Named::ByProgram);
    target.map_err(|error| unwritable(output, &error))?;
    let (mut words, scene) = words_of(item, output, scenes)?;
    if let Some(PinnedInset { name, compared }) = item.pin {
        // A sheet has the smaller panels: what is to be seen in one is to be seen in a larger picture.
        let shares = |other: &&Item| other.verb == "sheet" && other.pin.is_some_and(|pin| pin.name == name);
        let proposes = || {
            let sheet = ITEMS.iter().find(shares).unwrap_or(item);
            let (words, scene) = words_of(sheet, output, scenes)?;
            pair(&spec_of(&words, &scene)?, compared)
        };
        let pin = pins.get(name, proposes)?;
        words.push(format!("--inset={pin}"));
    }
    let figure = draw(item, (&words, &scene), output, guard);
    figure.map_err(|failure| match item.pin {
        Some(pin) => pins.blamed(pin.name, failure),
        None => failure,
    })
}

/// Draws what the words ask for of a scene and writes it.
fn draw(item: &Item, (words, scene): (&[String], &str), output: &Path, guard: &Guard) -> Result<Figure, Failure> {
    match parsed(words, scene)? {
        Verb::Sheet(options) => {
            let named = Destination::by_program(output);
            sheet::check(&sheet::request(&options).map_err(Failure::Input)?, named, guard)?;
            let sheet = sheet::draw(&options, output)?;
            let figure = sheet::write(&sheet, named, guard)?;
            let times = if item.timed { times(&sheet) } else { String::new() };
            Ok(Figure {
                caption: format!("{}{times}", figure.caption),
                ..figure
            })
        }
        _ => render(spec_of(words, scene)?, output, guard),
    }
}

/// The words of a figure but for its inset, and its scene.
fn words_of(item: &Item, output: &Path, scenes: &Scenes<'_>) -> Result<(Vec<String>, String), Failure> {
    let (scene, more) = scenes.find(item.subject);
    let mut words = vec!["rasterscope".to_owned(), item.verb.to_owned()];
    words.extend([format!("--output={}", output.display())]);
    words.extend(item.words.iter().map(|word| (*word).to_owned()));
    words.extend(more);
    if let Some(degrees) = item.turned {
        let picture = Picture::read(spec_of(&words, &scene)?)?;
        let size = [picture.frame().width(), picture.frame().height()];
        words.push(turned_view(picture.scene.canvas, size, degrees));
    }
    Ok((words, scene))
}

/// Draws and writes a single picture.
fn render(spec: PictureSpec, output: &Path, guard: &Guard) -> Result<Figure, Failure> {
    let caption = caption_of(&spec);
    let mut picture = Picture::read(spec)?;
    picture.draw_figure()?;
    let record = picture.record(output);
    let named = Destination::by_program(output);
    let mut guard = guard.clone();
    picture.protect(&mut guard);
    save_picture(picture.frame(), Some(&record), named, &guard).map_err(|error| unwritable(output, &error))?;
    Ok(Figure {
        file: output.file_name().unwrap_or_default().to_string_lossy().into_owned(),
        alternative: format!("The scene {caption}"),
        caption,
        command_line: record.command_line,
    })
}

/// The command that words stand for; the scene comes last, as a path that may look like an option.
fn parsed(words: &[String], scene: &str) -> Result<Verb, Failure> {
    let words = words.iter().map(String::as_str).chain(["--", scene]);
    Ok(arguments::parse_words(words.map(OsString::from).collect(), false)?.verb)
}

/// What the words draw, or the first panel of it.
fn spec_of(words: &[String], scene: &str) -> Result<PictureSpec, Failure> {
    match parsed(words, scene)? {
        Verb::Render(options) => Ok(spec_of_render(&options)),
        Verb::Sheet(options) => sheet::spec(&options).map_err(Failure::Input),
        _ => Err(Failure::other("a figure is a picture or a sheet")),
    }
}

/// The picture with both settings that are compared.
fn pair(spec: &PictureSpec, compared: [&[&str]; 2]) -> Result<[PictureSpec; 2], Failure> {
    let with = |words: &[&str]| {
        let words = words.iter().map(|word| (*word).to_owned());
        let sampling = sampling_of(words).map_err(Failure::Input)?;
        Ok(PictureSpec {
            render: sampling.settings(spec.view),
            insets: Vec::new(),
            ..spec.clone()
        })
    };
    Ok([with(compared[0])?, with(compared[1])?])
}

/// How long the panels take, as a sentence: of this machine, and therefore not on the picture.
fn times(sheet: &Sheet) -> String {
    let told = sheet.panels.iter().map(|panel| {
        let mut picture = Picture::of(panel.spec.clone(), Arc::clone(&panel.scene));
        let mut times: Vec<Duration> = (0..TIMED).map(|_| picture.draw().total()).collect();
        times.sort_unstable();
        let median = times.get(TIMED / 2).copied().unwrap_or_default();
        format!("{} {:.1} ms", panel.words, median.as_secs_f64() * 1000.0)
    });
    let told: Vec<String> = told.collect();
    let threads = rayon::current_num_threads();
    format!(
        " Time to draw, median of {TIMED} on {threads} threads of this machine: {}.",
        told.join(", ")
    )
}
