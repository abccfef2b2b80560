//! From what a sheet is to show to its picture: every panel drawn alike, laid out, captioned.

use std::path::Path;
use std::sync::Arc;

use crate::figure::{Ground, Record, SheetPlan, add_furniture, draw_legends};
use crate::raster::Framebuffer;
use crate::render;
use crate::render::Subject;
use crate::scene::{DialectChoice, Scene};
use crate::viewer::export::sheet::axes::{Axis, AxisLists, Choice};
use crate::viewer::export::sheet::captions::{Labels, caption, difference};
use crate::viewer::export::spec::{PictureSpec, as_path, plain_record};
use crate::viewer::library::dialects::told_dialect;

/// Most panels of a sheet.
const MAX_PANELS: usize = 64;

/// An axis of more values than this, if it is the only one, takes several rows.
const MAX_COLUMNS: usize = 5;

/// What a sheet is to show.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetRequest {
    axes: AxisLists,
    /// What each panel draws, the first axis changing fastest.
    panels: Vec<(Choice, PictureSpec)>,
    labels: Labels,
    /// Ground and ink.
    pub theme: Ground,
    /// A sentence that the caption ends with.
    pub note: Option<String>,
}

/// A sheet that was drawn.
#[derive(Debug)]
pub struct Sheet {
    /// The whole of it.
    pub picture: Framebuffer,
    /// What the file of the whole tells.
    pub record: Record,
    /// What stands below the sheet.
    pub caption: String,
    /// One for each combination of settings, row by row.
    pub panels: Vec<Panel>,
}

/// A panel of a sheet.
#[derive(Debug)]
pub struct Panel {
    /// What decides its picture.
    pub spec: PictureSpec,
    /// What it shows.
    pub scene: Arc<Scene>,
    /// Its picture, with its insets.
    pub frame: Framebuffer,
    /// What tells it apart, such as `sample rate 4, pixel sampling nearest`.
    pub words: String,
}

/// Gives the scene as it is read in a dialect; called once for each.
pub type SceneReader<'a> = &'a mut dyn FnMut(DialectChoice) -> Result<Arc<Scene>, String>;

impl SheetRequest {
    /// A sheet of every combination of `axes`; `spec` gives the picture of each.
    ///
    /// # Errors
    /// One line when there are too many of them, and what `spec` says.
    pub fn new(axes: AxisLists, spec: impl Fn(&Choice) -> Result<PictureSpec, String>) -> Result<Self, String> {
        let count = axes.count();
        if count > MAX_PANELS {
            let count = if count > 1_000_000 {
                "over a million".to_owned()
            } else {
                count.to_string()
            };
            return Err(format!(
                "a sheet holds at most {MAX_PANELS} panels, and these lists make {count}; give fewer values"
            ));
        }
        let panels = axes.choices().into_iter().map(|choice| Ok((spec(&choice)?, choice)));
        let panels: Vec<(Choice, PictureSpec)> = panels
            .map(|panel: Result<_, String>| panel.map(|(spec, choice)| (choice, spec)))
            .collect::<Result<_, _>>()?;
        Ok(Self {
            axes,
            labels: Labels::of(&panels),
            panels,
            theme: Ground::default(),
            note: None,
        })
    }

    /// The side of the square panels that make a sheet of these axes as wide as a page.
    pub fn page_panel(axes: &AxisLists) -> u32 {
        let (columns, labelled) = grid(axes);
        SheetPlan::page_panel(u32::try_from(columns).unwrap_or(u32::MAX), labelled)
    }

    /// What the first panel shows: the state that a sheet brings back.
    pub fn first(&self) -> Option<&PictureSpec> {
        self.panels.first().map(|(_, spec)| spec)
    }

    /// What tells each panel apart.
    pub(in crate::viewer) fn words(&self) -> impl Iterator<Item = String> {
        let panels = self.panels.iter();
        panels.map(|panel| difference(self.axes.axes(), panel, &self.labels))
    }

    /// About how many pixels all panels and the whole of them have.
    pub fn pixels(&self) -> u64 {
        let of_panel = |(_, spec): &(Choice, PictureSpec)| u64::from(spec.size[0]) * u64::from(spec.size[1]);
        self.panels.iter().map(of_panel).sum::<u64>().saturating_mul(2)
    }

    /// Says before anything is read or drawn that the sheet would be too large.
    ///
    /// # Errors
    /// That, in one line.
    pub fn check_size(&self) -> Result<(), String> {
        let first = self.first().ok_or("a sheet without panels")?;
        let layout = self.plan(first).layout().map(|_| ());
        layout.map_err(|problem| format!("{}: {problem}", first.scene.address()))
    }

    /// Draws every panel and puts them together; `output` is the file that the record names.
    ///
    /// # Errors
    /// One line when the sheet would be too large, when an inset has no room, and what `scenes` says.
    pub fn draw(&self, scenes: SceneReader<'_>, output: &Path) -> Result<Sheet, String> {
        self.check_size()?;
        let first = self.first().ok_or("a sheet without panels")?;
        let mut plan = self.plan(first);
        let name = first.scene.address();
        let too_large = |problem| format!("{name}: {problem}");
        let panels = self.panels(scenes)?;
        let scene = panels.first().map(|panel| Arc::clone(&panel.scene));
        let scene = scene.ok_or("a sheet without panels")?;
        let mut legends = Vec::new();
        for panel in &panels {
            let legend = panel.spec.render.visualisation.legend(&panel.scene);
            legends.extend(legend.filter(|legend| !legends.contains(legend)));
        }
        let width = first.size[0].saturating_mul(u32::try_from(plan.columns.len()).unwrap_or(u32::MAX));
        let legend = draw_legends(&legends, width, plan.ground);
        plan.legend = legend.as_ref().map(|legend| [legend.width(), legend.height()]);
        let layout = plan.layout().map_err(too_large)?;
        let frames: Vec<&Framebuffer> = panels.iter().map(|panel| &panel.frame).collect();
        Ok(Sheet {
            picture: layout.draw(&frames, legend.as_ref()),
            record: self.record(first, &scene, output),
            caption: plan.caption.clone(),
            panels,
        })
    }

    /// Draws every panel; a scene is read once for each dialect.
    fn panels(&self, scenes: SceneReader<'_>) -> Result<Vec<Panel>, String> {
        let mut known: Vec<(DialectChoice, Arc<Scene>)> = Vec::new();
        let mut panels = Vec::new();
        for panel @ (_, spec) in &self.panels {
            let read = known.iter().find(|(dialect, _)| *dialect == spec.dialect);
            let scene = if let Some((_, scene)) = read {
                Arc::clone(scene)
            } else {
                let scene = scenes(spec.dialect)?;
                known.push((spec.dialect, Arc::clone(&scene)));
                scene
            };
            let [width, height] = spec.size;
            let mut frame = Framebuffer::new(width, height);
            let view = spec.view.transform(scene.canvas, spec.size);
            render::draw(&scene, &view, &spec.render, &mut frame);
            let subject = Subject {
                scene: &scene,
                view: &view,
                settings: &spec.render,
            };
            add_furniture(&mut frame, &spec.insets, &subject, &[]).map_err(|error| error.to_string())?;
            let mut spec = spec.clone();
            spec.dialect = told_dialect(spec.dialect, spec.render.rules, scene.dialect);
            panels.push(Panel {
                spec,
                scene,
                frame,
                words: difference(self.axes.axes(), panel, &self.labels),
            });
        }
        Ok(panels)
    }

    /// What stands where.
    fn plan(&self, first: &PictureSpec) -> SheetPlan {
        let axes: Vec<&Axis> = self.axes.axes().collect();
        let (columns, _) = grid(&self.axes);
        let count = self.axes.count();
        let mut headers = Vec::new();
        let named: Vec<String> = match axes.first() {
            None => vec![String::new()],
            Some(axis) => axis.values.iter().map(|value| self.labels.words(axis, value)).collect(),
        };
        let (columns, rows) = if self.axes.is_stack() {
            (vec![String::new()], named)
        } else if axes.len() > 1 {
            let rest = AxisLists::rows(&axes[1..], |axis, value| self.labels.words(axis, value));
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
            caption: caption(first, &axes, &self.labels, self.note.as_deref()),
            legend: None,
            ground: self.theme,
        }
    }

    /// The record: the command line of the sheet.
    fn record(&self, first: &PictureSpec, scene: &Scene, output: &Path) -> Record {
        let of_panel = first.record(scene, output);
        let plain = plain_record(self.arguments(first, &output.display().to_string()), first.size);
        Record {
            arguments: plain.arguments,
            command_line: plain.command_line,
            ..of_panel
        }
    }

    /// The words of the `sheet` command that draws this into `output`, without the program's name.
    fn arguments(&self, first: &PictureSpec, output: &str) -> Vec<String> {
        let head = [
            "sheet".to_owned(),
            as_path(&first.scene.address()),
            "-o".to_owned(),
            as_path(output),
        ];
        let mut words: Vec<String> = head.into_iter().chain(self.axes.words()).collect();
        words.extend(framing_words(first, self.theme, self.note.as_deref()));
        words
    }
}

/// What follows the settings on the command line of a sheet.
pub(in crate::viewer) fn framing_words(panel: &PictureSpec, theme: Ground, note: Option<&str>) -> Vec<String> {
    let [width, height] = panel.size;
    let mut words = vec![
        format!("--size={width}x{height}"),
        format!("--view={}", panel.view_text()),
    ];
    words.extend(panel.inset_options());
    if theme != Ground::default() {
        words.extend(["--theme".to_owned(), theme.name().to_owned()]);
    }
    if let Some(note) = note {
        words.push(format!("--note={note}"));
    }
    words
}

/// How many columns there are, and whether rows have labels.
fn grid(lists: &AxisLists) -> (usize, bool) {
    if lists.is_stack() {
        return (1, true);
    }
    let mut axes = lists.axes();
    let columns = axes.next().map_or(1, |axis| axis.values.len());
    match axes.next() {
        Some(_) => (columns, true),
        None if columns > MAX_COLUMNS => (columns.div_ceil(columns.div_ceil(MAX_COLUMNS)), false),
        None => (columns, false),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::View;
    use crate::viewer::Settings;
    use crate::viewer::library::SceneSource;
    use crate::viewer::settings::picture::SettingChange;

    #[test]
    fn values_without_effect_say_so_in_panels_and_heads() {
        let axes = [
            ("coverage", "exact,sampled"),
            ("pattern", "sobol,grid"),
            ("seed", "0,1"),
        ];
        let lists: Vec<Axis> = axes
            .iter()
            .map(|(name, values)| Axis::of(name, values).expect("a list"))
            .collect();
        let spec = |choice: &Choice| {
            let mut settings = Settings::default();
            for (name, value) in choice {
                SettingChange::of(name, value)?.apply(&mut settings);
            }
            Ok(PictureSpec {
                scene: SceneSource::from_address(Path::new("gallery:basic/test4.svg")),
                size: [20, 16],
                view: View::Default,
                render: settings.render,
                dialect: settings.dialect,
                insets: Vec::new(),
                legend: false,
            })
        };
        let request = |lists: &[Axis]| SheetRequest::new(lists.iter().cloned().collect(), spec).expect("panels");
        let both = request(&lists[..2]);
        let words: Vec<String> = both.words().collect();
        assert_eq!(
            words[..2],
            [
                "coverage exact, pattern sobol (no effect)",
                "coverage sampled, pattern sobol"
            ],
            "no samples where areas are covered"
        );
        let plan = both.plan(both.first().expect("a panel"));
        assert_eq!(
            plan.rows,
            ["pattern sobol", "pattern grid"],
            "it has one in some panels"
        );
        let seeds = request(&lists[2..]);
        let plan = seeds.plan(seeds.first().expect("a panel"));
        assert_eq!(
            plan.columns,
            ["seed 0 (no effect)", "seed 1 (no effect)"],
            "a grid has no chance in it"
        );
    }

    #[test]
    fn limit_is_that_of_the_help_page() {
        let page = include_str!("../../../cli/help/figures.md");
        assert!(page.contains(&format!("at most {MAX_PANELS} panels")));
    }
}
