//! `rasterscope sheet`: one picture for each combination of settings, in a labelled grid.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::arguments::SheetOptions;
use super::axes::{Axis, AxisLists, Choice};
use super::failure::{Failure, print_error};
use super::picture::{Picture, on_threads};
use super::recorded;
use super::render::{name_for_png, unwritable};
use super::size::FrameSize;
use crate::figure::{Figure, Ground, Record, SheetPlan, draw_legends, encode_png, html, latex, markdown, save_files};
use crate::raster::Framebuffer;
use crate::render::Legend;
use crate::scene::{DialectChoice, Scene};
use crate::viewer::{PictureSpec, Restored, SceneSource, as_path, plain_record};

/// Most panels of a sheet.
const MAX_PANELS: usize = 64;
/// An axis of more values than this, if it is the only one, takes several rows.
const MAX_COLUMNS: usize = 5;

/// A sheet that was drawn.
pub(super) struct Sheet {
    pub(super) picture: Framebuffer,
    pub(super) record: Record,
    panels: Vec<Panel>,
    /// What stands below the sheet.
    caption: String,
    pub(super) scene: Arc<Scene>,
}

impl Sheet {
    /// What tells each panel apart, and its picture.
    pub(super) fn panels_mut(&mut self) -> impl Iterator<Item = (&str, &mut Picture)> {
        self.panels
            .iter_mut()
            .map(|panel| (panel.words.as_str(), &mut panel.picture))
    }
}

struct Panel {
    picture: Picture,
    /// What tells it apart, such as `sample rate 4, pixel sampling nearest`.
    words: String,
}

/// Draws the sheet and writes it, its panels and the snippets.
pub(super) fn run(options: &SheetOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    name_for_png(&options.output)?;
    let sheet = on_threads(options.framing.threads, || draw(options, &options.output))??;
    if let Some(change) = restored.and_then(|restored| restored.changes(&sheet.scene.files)) {
        print_error(&change);
    }
    write(&sheet, &options.output).map(|_| ())
}

/// What the first panel shows: the state that a sheet brings back.
pub(super) fn spec(options: &SheetOptions) -> Result<PictureSpec, Failure> {
    let choices = choices(options)?;
    let first = choices
        .first()
        .ok_or_else(|| Failure::other("a sheet without panels"))?;
    panel_spec(options, first)
}

fn choices(options: &SheetOptions) -> Result<Vec<Choice>, Failure> {
    let count = options.axes.count();
    if count > MAX_PANELS {
        let count = if count > 1_000_000 {
            "over a million".to_owned()
        } else {
            count.to_string()
        };
        return Err(Failure::input(format!(
            "a sheet holds at most {MAX_PANELS} panels, and these lists make {count}; give fewer values"
        )));
    }
    Ok(options.axes.choices())
}

fn panel_spec(options: &SheetOptions, choice: &Choice) -> Result<PictureSpec, Failure> {
    let sampling = AxisLists::sampling(choice)?;
    let (columns, labelled) = grid(options);
    let size = options.size.map_or_else(
        || [SheetPlan::page_panel(u32::try_from(columns).unwrap_or(u32::MAX), labelled); 2],
        |FrameSize(size)| size,
    );
    Ok(PictureSpec {
        scene: SceneSource::from_address(&options.scene),
        size,
        view: options.framing.view,
        render: sampling.settings(options.framing.view),
        dialect: sampling.dialect,
        insets: options.insets.clone(),
        // The sheet has one for all panels.
        legend: false,
    })
}

/// How many columns there are, and whether rows have labels.
fn grid(options: &SheetOptions) -> (usize, bool) {
    let mut axes = options.axes.axes();
    let columns = axes.next().map_or(1, |axis| axis.values.len());
    match axes.next() {
        Some(_) => (columns, true),
        None if columns > MAX_COLUMNS => (columns.div_ceil(columns.div_ceil(MAX_COLUMNS)), false),
        None => (columns, false),
    }
}

/// Draws every panel and puts them together; `output` is the file that the record names.
pub(super) fn draw(options: &SheetOptions, output: &Path) -> Result<Sheet, Failure> {
    let choices = choices(options)?;
    let specs: Vec<PictureSpec> = choices
        .iter()
        .map(|choice| panel_spec(options, choice))
        .collect::<Result<_, _>>()?;
    let first = specs.first().ok_or_else(|| Failure::other("a sheet without panels"))?;
    let mut plan = plan(options, first);
    let too_large = |problem| Failure::input(format!("{}: {problem}", options.scene.display()));
    // Asked before anything is read or drawn.
    plan.layout().map_err(too_large)?;
    let panels = panels(options, &specs, &choices)?;
    let scene = match panels.first() {
        Some(panel) => Arc::clone(&panel.picture.scene),
        None => return Err(Failure::other("a sheet without panels")),
    };
    let mut legends: Vec<Legend> = Vec::new();
    for legend in panels.iter().filter_map(|panel| panel.picture.legend()) {
        if !legends.contains(&legend) {
            legends.push(legend);
        }
    }
    let width = first.size[0].saturating_mul(u32::try_from(plan.columns.len()).unwrap_or(u32::MAX));
    let legend = draw_legends(&legends, width, plan.ground);
    plan.legend = legend.as_ref().map(|legend| [legend.width(), legend.height()]);
    let layout = plan.layout().map_err(too_large)?;
    let frames: Vec<&Framebuffer> = panels.iter().map(|panel| panel.picture.frame()).collect();
    Ok(Sheet {
        picture: layout.draw(&frames, legend.as_ref()),
        record: record(options, (first, &scene), output),
        caption: plan.caption.clone(),
        panels,
        scene,
    })
}

/// Draws every panel; a scene is read once for each dialect.
fn panels(options: &SheetOptions, specs: &[PictureSpec], choices: &[Choice]) -> Result<Vec<Panel>, Failure> {
    let mut scenes: Vec<(DialectChoice, Arc<Scene>)> = Vec::new();
    let mut panels = Vec::new();
    for (spec, choice) in specs.iter().zip(choices) {
        let known = scenes.iter().find(|(dialect, _)| *dialect == spec.dialect);
        let scene = if let Some((_, scene)) = known {
            Arc::clone(scene)
        } else {
            let scene = Picture::read(spec.clone())?.scene;
            scenes.push((spec.dialect, Arc::clone(&scene)));
            scene
        };
        let mut picture = Picture::of(spec.clone(), scene);
        picture.draw_figure()?;
        panels.push(Panel {
            picture,
            words: difference(options, choice),
        });
    }
    Ok(panels)
}

/// What stands where.
fn plan(options: &SheetOptions, first: &PictureSpec) -> SheetPlan {
    let axes: Vec<&Axis> = options.axes.axes().collect();
    let (columns, _) = grid(options);
    let count = options.axes.count();
    let mut headers = Vec::new();
    let named: Vec<String> = match axes.first() {
        None => vec![String::new()],
        Some(axis) => axis.values.iter().map(|value| axis.words(value)).collect(),
    };
    let (columns, rows) = if axes.len() > 1 {
        let rest = AxisLists::rows(&axes[1..]);
        (named, rest)
    } else if named.len() > columns {
        headers = named;
        (
            vec![String::new(); columns],
            vec![String::new(); count.div_ceil(columns)],
        )
    } else {
        (named, vec![String::new()])
    };
    SheetPlan {
        panel: first.size,
        columns,
        rows,
        headers,
        caption: caption(options, first, &axes),
        legend: None,
        ground: options.theme,
    }
}

/// What differs and what all panels share.
fn caption(options: &SheetOptions, first: &PictureSpec, axes: &[&Axis]) -> String {
    let list = |axis: &Axis| format!("{} {}", axis.title(), axis.values.join(", "));
    let scene = title(&first.scene);
    let what = match axes {
        [] => scene,
        [across] => format!("{scene} with {}", list(across)),
        [across, down @ ..] => {
            let down: Vec<String> = down.iter().map(|axis| list(axis)).collect();
            format!(
                "{scene}: from left to right {}; from top to bottom {}",
                list(across),
                down.join("; ")
            )
        }
    };
    let shared = shared_words(first, |name| axes.iter().any(|axis| axis.name == name));
    let shared = (!shared.is_empty()).then(|| format!("In all: {shared}"));
    let parts = [Some(what), shared]
        .into_iter()
        .flatten()
        .chain(seen(first, "Each "))
        .chain(options.note.clone());
    format!("{}.", parts.collect::<Vec<_>>().join(". "))
}

/// What is said of a single picture.
pub(super) fn caption_of(spec: &PictureSpec) -> String {
    let settings = shared_words(spec, |_| false);
    let what = match settings.as_str() {
        "" => title(&spec.scene),
        settings => format!("{} with {settings}", title(&spec.scene)),
    };
    let parts = std::iter::once(what).chain(seen(spec, ""));
    format!("{}.", parts.collect::<Vec<_>>().join(". "))
}

/// A scene's name on a picture: not its folder, for a picture that is drawn again where both were moved must be the same.
fn title(scene: &SceneSource) -> String {
    let address = scene.address();
    match scene {
        SceneSource::File(path) => path
            .file_name()
            .map_or(address, |name| name.to_string_lossy().into_owned()),
        SceneSource::Gallery(_) => address.trim_start_matches("gallery:").to_owned(),
    }
}

/// The settings in words that differ from their defaults, but for those that are `told` elsewhere.
fn shared_words(spec: &PictureSpec, told: impl Fn(&str) -> bool) -> String {
    let settings = spec.settings().into_iter().filter(|(name, _)| !told(name));
    let words = settings.map(|(name, value)| format!("{} {value}", name.replace('-', " ")));
    words.collect::<Vec<_>>().join(", ")
}

/// Size, view and insets in words.
fn seen(spec: &PictureSpec, each: &str) -> Vec<String> {
    let [width, height] = spec.size;
    let mut parts = vec![format!(
        "{each}{width} \u{d7} {height} pixels, view {}",
        spec.view_text()
    )];
    for inset in &spec.insets {
        let [region, factor] = [inset.region, inset.magnification];
        parts.push(format!(
            "Inset: {region} \u{d7} {region} pixels around {}, {factor}\u{d7}",
            inset.at.words()
        ));
    }
    parts
}

/// What tells a panel from the others.
fn difference(options: &SheetOptions, choice: &Choice) -> String {
    let words = options.axes.axes().filter_map(|axis| {
        let (_, value) = choice.iter().find(|(name, _)| *name == axis.name)?;
        Some(axis.words(value))
    });
    words.collect::<Vec<_>>().join(", ")
}

/// The record: the command line of the sheet.
fn record(options: &SheetOptions, (first, scene): (&PictureSpec, &Scene), output: &Path) -> Record {
    let mut words = vec![
        "sheet".to_owned(),
        as_path(&first.scene.address()),
        "-o".to_owned(),
        as_path(&output.display().to_string()),
    ];
    words.extend(options.axes.words());
    let [width, height] = first.size;
    words.extend([
        format!("--size={width}x{height}"),
        format!("--view={}", first.view_text()),
    ]);
    words.extend(first.inset_options());
    if options.theme != Ground::default() {
        words.extend(["--theme".to_owned(), options.theme.name().to_owned()]);
    }
    if let Some(note) = &options.note {
        words.push(format!("--note={note}"));
    }
    let of_panel = first.record(scene, output);
    let plain = plain_record(words, first.size);
    Record {
        arguments: plain.arguments,
        command_line: plain.command_line,
        ..of_panel
    }
}

/// Writes all files of a sheet, or none; gives what documents say about the sheet, from the folder it lies in.
pub(super) fn write(sheet: &Sheet, output: &Path) -> Result<Figure, Failure> {
    let folder = output.with_extension("");
    let encoded = |frame: &Framebuffer, record: &Record| {
        encode_png(frame, Some(record)).map_err(|error| unwritable(output, &error))
    };
    let mut files = vec![(output.to_owned(), encoded(&sheet.picture, &sheet.record)?)];
    let name = output.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let whole = Figure {
        file: name,
        caption: sheet.caption.clone(),
        alternative: format!("{} panels in a grid. {}", sheet.panels.len(), sheet.caption),
        command_line: sheet.record.command_line.clone(),
    };
    let mut figures = vec![Figure {
        file: format!("../{}", whole.file),
        ..whole.clone()
    }];
    let made = make_folder(&folder)?;
    for (number, panel) in sheet.panels.iter().enumerate() {
        let name = panel_name(number, &panel.words);
        let path = folder.join(&name);
        let record = panel.picture.record(&path);
        let scene = title(&panel.picture.spec().scene);
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
        files.push((path, encoded(panel.picture.frame(), &record)?));
    }
    files.extend(snippets(&folder, &whole.file, &figures));
    save_files(&files).map_err(|error| {
        if made {
            // Only a folder that this made, and only while it is empty.
            let _ = std::fs::remove_dir(&folder);
        }
        unwritable(output, &error)
    })?;
    Ok(whole)
}

/// Makes the folder of panels and snippets; whether it was not there.
fn make_folder(folder: &Path) -> Result<bool, Failure> {
    if folder.is_dir() {
        return Ok(false);
    }
    std::fs::create_dir(folder).map_err(|error| unwritable(folder, &error))?;
    Ok(true)
}

/// The figures in the words of documents.
pub(super) fn snippets(folder: &Path, title: &str, figures: &[Figure]) -> [(PathBuf, Vec<u8>); 3] {
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

impl AxisLists {
    /// The labels of rows that several axes make, the first of them changing fastest.
    fn rows(axes: &[&Axis]) -> Vec<String> {
        let mut labels = vec![String::new()];
        for axis in axes.iter().rev() {
            labels = labels
                .iter()
                .flat_map(|rest| {
                    axis.values.iter().map(move |value| match rest.as_str() {
                        "" => axis.words(value),
                        rest => format!("{}, {rest}", axis.words(value)),
                    })
                })
                .collect();
        }
        labels
    }
}

/// Where the scene of a sheet was named, for the state that it brings back.
pub(super) fn restored_spec(options: &SheetOptions) -> Result<PictureSpec, String> {
    spec(options).map_err(|failure| match failure {
        Failure::Input(problem) | Failure::Other(problem) => problem,
        Failure::Text(_) | Failure::Different => recorded::NO_SCENE.to_owned(),
    })
}
