//! What the dialog of sheets is set to, and the command line that it stands for.

use crate::figure::{Ground, InsetSpec};
use crate::geometry::View;
use crate::raster::{SamplePattern, SampleRate};
use crate::viewer::export::sheet::axes::{Axis, AxisLists};
use crate::viewer::export::sheet::drawing::{SheetRequest, framing_words};
use crate::viewer::export::spec::{PictureSpec, as_path};

/// A sheet of the current scene as it is being put together: settings that are not axes are those of the picture.
#[derive(Clone, Debug, PartialEq)]
pub struct SheetDraft {
    /// What differs from left to right.
    pub columns: Option<Axis>,
    /// What differs from top to bottom.
    pub rows: Option<Axis>,
    /// Whether the pinned pixel is magnified in every panel.
    pub inset: bool,
    /// Pixels of each panel.
    pub panels: PanelSize,
    /// Ground and ink.
    pub theme: Ground,
    /// A sentence that the caption ends with; may be empty.
    pub note: String,
}

/// One thing about a sheet that changes.
#[derive(Clone, Debug, PartialEq)]
pub enum SheetChange {
    /// What differs between its columns, or its rows.
    Axis(SheetSide, Option<Axis>),
    /// Whether the pinned pixel is magnified.
    Inset(bool),
    /// Pixels of each panel.
    Panels(PanelSize),
    /// Ground and ink.
    Theme(Ground),
    /// The sentence that the caption ends with.
    Note(String),
}

/// A direction of a sheet.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SheetSide {
    /// From left to right.
    Columns,
    /// From top to bottom.
    Rows,
}

/// The size of panels. Whatever it is, they show the part of the scene that the window shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PanelSize {
    /// The frame's: every panel is the picture in the window, pixel by pixel.
    #[default]
    Window,
    /// The frame's shape, as large as makes the sheet 16 cm wide at 300 dots per inch.
    Page,
    /// So many pixels.
    Exact([u32; 2]),
}

/// The columns to begin with.
const RATES: (&str, [&str; 3]) = ("sample-rate", ["1", "4", "16"]);
/// The same where the pattern takes only some rates.
const FILTERS: (&str, [&str; 3]) = ("resolve-filter", ["box", "tent", "mitchell"]);

fn axis((name, values): (&str, [&str; 3])) -> Axis {
    Axis {
        name: name.to_owned(),
        values: values.map(str::to_owned).to_vec(),
    }
}

impl Default for SheetDraft {
    fn default() -> Self {
        Self {
            columns: Some(axis(RATES)),
            rows: None,
            inset: true,
            panels: PanelSize::default(),
            theme: Ground::default(),
            note: String::new(),
        }
    }
}

impl SheetDraft {
    /// Columns to begin with have values that `pattern` takes. Where no axis is that of patterns, that is.
    pub(in crate::viewer) fn suit(&mut self, pattern: SamplePattern) {
        let mut rates = RATES.1.iter().filter_map(|rate| SampleRate::new(rate.parse().ok()?));
        let is_first = self.columns == Some(axis(RATES));
        let chooses_pattern = self.rows.as_ref().is_some_and(|axis| axis.name == "pattern");
        if is_first && !chooses_pattern && !rates.all(|rate| pattern.takes(rate)) {
            self.change(SheetChange::Axis(SheetSide::Columns, Some(axis(FILTERS))));
        }
    }

    /// Changes one thing. An axis that is given to one side is taken from the other.
    pub(in crate::viewer) fn change(&mut self, change: SheetChange) {
        match change {
            SheetChange::Axis(side, axis) => {
                let (this, other) = match side {
                    SheetSide::Columns => (&mut self.columns, &mut self.rows),
                    SheetSide::Rows => (&mut self.rows, &mut self.columns),
                };
                let is_taken = |other: &mut Axis| axis.as_ref().is_some_and(|axis| axis.name == other.name);
                other.take_if(is_taken);
                *this = axis;
            }
            SheetChange::Inset(inset) => self.inset = inset,
            SheetChange::Panels(panels) => self.panels = panels,
            SheetChange::Theme(theme) => self.theme = theme,
            SheetChange::Note(note) => self.note = note,
        }
    }

    /// What differs on a side.
    pub fn axis(&self, side: SheetSide) -> Option<&Axis> {
        match side {
            SheetSide::Columns => self.columns.as_ref(),
            SheetSide::Rows => self.rows.as_ref(),
        }
    }

    fn axes(&self) -> AxisLists {
        let axes: AxisLists = self.columns.iter().chain(&self.rows).cloned().collect();
        axes.stacked(self.columns.is_none())
    }

    /// What a panel shows where the window shows `picture`; without insets.
    pub(in crate::viewer) fn panel(&self, picture: PictureSpec) -> PictureSpec {
        let size = match self.panels {
            PanelSize::Window => picture.size,
            PanelSize::Exact(size) => size,
            PanelSize::Page => {
                let width = SheetRequest::page_panel(&self.axes());
                let [w, h] = picture.size.map(u64::from);
                let height = (u64::from(width) * h + w / 2) / w.max(1);
                [width, u32::try_from(height).unwrap_or(u32::MAX).max(1)]
            }
        };
        let ratio = |side: usize| f64::from(size[side]) / f64::from(picture.size[side].max(1));
        let factor = ratio(0).min(ratio(1));
        let view = match picture.view {
            View::At {
                center,
                scale,
                rotation,
            } => View::At {
                center,
                scale: scale * factor,
                rotation,
            },
            // These follow the size by themselves.
            named => named,
        };
        PictureSpec {
            size,
            view,
            insets: Vec::new(),
            legend: false,
            ..picture
        }
    }

    /// The words of the `sheet` command that writes `output`, without the program's name: every panel as `panel`, but for the
    /// axes.
    pub(in crate::viewer) fn arguments(
        &self,
        panel: &PictureSpec,
        inset: Option<InsetSpec>,
        output: &str,
    ) -> Vec<String> {
        let scene = as_path(&panel.scene.address());
        let mut words = vec!["sheet".to_owned(), scene, "-o".to_owned(), as_path(output)];
        let axes = self.axes();
        words.extend(axes.words());
        let is_axis = |name: &str| self.columns.iter().chain(&self.rows).any(|axis| axis.name == name);
        let settings = panel.settings();
        let shared = settings.into_iter().filter(|(name, _)| !is_axis(name));
        words.extend(shared.map(|(name, value)| format!("--{name}={value}")));
        let panel = PictureSpec {
            insets: inset.filter(|_| self.inset).into_iter().collect(),
            ..panel.clone()
        };
        let note = Some(self.note.trim()).filter(|note| !note.is_empty());
        // The caption ends with a full stop of its own.
        let note = note.map(|note| note.strip_suffix('.').unwrap_or(note));
        words.extend(framing_words(&panel, self.theme, note));
        words
    }
}

impl SheetSide {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Columns, Self::Rows];

    /// The name for people.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Columns => "columns",
            Self::Rows => "rows",
        }
    }
}

impl PanelSize {
    /// Reads `window`, `page` or `WIDTHxHEIGHT`.
    pub fn parse(text: &str) -> Option<Self> {
        match text.trim() {
            "window" => Some(Self::Window),
            "page" => Some(Self::Page),
            size => {
                let (width, height) = size.split_once('x')?;
                let side = |text: &str| text.trim().parse().ok().filter(|side| *side > 0);
                Some(Self::Exact([side(width)?, side(height)?]))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::viewer::settings::picture::SettingChange;

    #[test]
    fn first_columns_have_values_that_the_pattern_takes() {
        let mut settings = crate::viewer::Settings::default();
        let mut draft = SheetDraft::default();
        draft.suit(settings.render.pattern);
        assert_eq!(draft, SheetDraft::default(), "a grid takes these rates");
        let change = SettingChange::of("pattern", "msaa-8").expect("a pattern");
        change.apply(&mut settings);
        draft.suit(settings.render.pattern);
        let axis = draft.columns.expect("columns");
        assert_eq!(
            axis.name, "resolve-filter",
            "this one takes eight samples and no others"
        );
        Axis::of(&axis.name, &axis.values.join(",")).expect("values of the setting");
        let mut chosen = SheetDraft::default();
        let rates = Axis::of("sample-rate", "8").expect("rates");
        chosen.change(SheetChange::Axis(SheetSide::Columns, Some(rates.clone())));
        chosen.suit(settings.render.pattern);
        assert_eq!(chosen.columns, Some(rates), "what somebody chose stays");
    }
}
