//! How the picture in the window is made again: its command line, its record, what a screenshot of it shows.

use std::path::Path;
use std::sync::Arc;

use crate::compare::Gain;
use crate::figure::{Guard, InsetPlace, InsetSpec, Record};
use crate::render::Visualisation;
use crate::scene::Scene;
use crate::viewer::ab::other::{Arrangement, Other};
use crate::viewer::ab::sides::Filling;
use crate::viewer::board::entry::BoardEntry;
use crate::viewer::control::both::Both;
use crate::viewer::control::pointing::Pointing;
use crate::viewer::export::saver::{Recipe, RecipeOfB, Shot};
use crate::viewer::export::spec::{PictureSpec, output_name, shell_line};
use crate::viewer::frames::frame::{Frame, Picture};
use crate::viewer::settings::Settings;

/// What is in the window, as somebody else can make it again.
#[derive(Clone, Copy, Debug)]
pub struct Recipes<'a> {
    pub(in crate::viewer) both: Both<'a>,
    pub(in crate::viewer) pixels: Pointing<'a>,
}

impl Recipes<'_> {
    /// The `rasterscope render` command that makes the current picture, quoted for a POSIX shell: of B where that fills the
    /// frame, of A where both share it; `None` without a scene or without pixels. Options that have their default value are
    /// left out, but for size and view.
    pub fn command_line(&self) -> Option<String> {
        let output = output_name(&self.both.scene_list.current()?.label);
        Some(shell_line(&self.shown_spec()?.arguments(&output)))
    }

    /// Whether [`Recipes::command_line`] draws A where more than A is to be seen, or something else.
    pub(in crate::viewer) fn draws_a_alone(&self) -> bool {
        matches!(self.both.ab.filling(), Filling::Outside | Filling::Shared)
    }

    /// The record of a picture of the window that is written to `output`; `None` without a scene.
    pub fn record_of_window(&self, output: &Path) -> Option<Record> {
        Some(self.recipe_of_window()?.record(output))
    }

    /// What decides A's picture; `None` without a scene or without pixels.
    pub(in crate::viewer) fn picture_spec(&self) -> Option<PictureSpec> {
        self.spec_of(self.both.settings, self.both.scene_list.current()?.scene())
    }

    /// The same of the picture that fills the frame; of A where both share it.
    fn shown_spec(&self) -> Option<PictureSpec> {
        match self.settings_of_b() {
            Some(settings) => self.spec_of(&settings, self.shown_scene()),
            None => self.picture_spec(),
        }
    }

    /// B's settings where B fills the frame.
    fn settings_of_b(&self) -> Option<Settings> {
        let (ab, own) = (self.both.ab, self.both.settings);
        let render = ab.other_settings(own).filter(|_| ab.filling() == Filling::B)?;
        Some(Settings {
            render,
            dialect: ab.own_dialect_of_b(own).unwrap_or(own.dialect),
            ..*own
        })
    }

    /// The scene as the picture that fills the frame shows it, which may be read in B's dialect.
    fn shown_scene(&self) -> Option<&Arc<Scene>> {
        let (ab, own) = (self.both.ab, self.both.settings);
        let entry = self.both.scene_list.current()?;
        match ab.own_dialect_of_b(own).filter(|_| ab.filling() == Filling::B) {
            Some(_) => entry.other_state.scene(),
            None => entry.scene(),
        }
    }

    fn spec_of(&self, settings: &Settings, scene: Option<&Arc<Scene>>) -> Option<PictureSpec> {
        let (entry, size) = (self.both.scene_list.current()?, self.both.layout.frame_size());
        (!size.contains(&0)).then(|| PictureSpec {
            scene: entry.source.clone(),
            size,
            view: entry.camera.view(),
            render: settings.render,
            dialect: self.both.scene_list.dialect_of_picture(settings, scene),
            legend: true,
            insets: self.inset_spec().into_iter().collect(),
        })
    }

    /// The inspector's inset as figures carry it: as large as the frame has room for. `None` while it is not to be seen, or
    /// where there is no room at all.
    fn inset_spec(&self) -> Option<InsetSpec> {
        let pixel = self.pixels.inspector.inset.and(self.pixels.inspected())?;
        let (entry, context) = (self.both.scene_list.current()?, self.both.view_context()?);
        let (region, magnification) = (
            self.pixels.inspector.magnifier.region,
            self.pixels.inspector.magnifier.magnification,
        );
        let spec = InsetSpec::around(InsetPlace::Pixel(pixel), region, magnification);
        spec.fitted(self.both.layout.frame_size(), &entry.camera.transform(&context))
    }

    /// How the picture of the whole window was made.
    pub(in crate::viewer) fn recipe_of_window(&self) -> Option<Recipe> {
        let differs = if self.draws_a_alone() {
            "a picture of the window; the command line draws A alone, without panels"
        } else {
            "a picture of the window; the command line draws what it shows, without panels"
        };
        Some(Recipe {
            spec: self.shown_spec()?,
            scene: Arc::clone(self.shown_scene()?),
            command: None,
            differs: Some(differs.to_owned()),
            compared: self.compared(),
        })
    }

    /// The frame that a picture of this moment shows: B's where that fills it, else A's `own`.
    pub(in crate::viewer) fn shown_frame<'f>(&'f self, own: &'f Arc<Frame>) -> &'f Arc<Frame> {
        let ab = self.both.ab;
        let other = ab.drawn_other().filter(|_| ab.filling() == Filling::B);
        let other = other.and_then(|drawing| drawing.final_frame(drawing.newest_request()));
        other.unwrap_or(own)
    }

    /// How a frame was made that [`Recipes::shown_frame`] gave, and what else its picture shows.
    pub(in crate::viewer) fn recipe_of_frame(&self, frame: &Frame) -> Option<Recipe> {
        let now = self.shown_spec()?;
        let picture = &frame.picture;
        let filling = self.both.ab.filling();
        let spec = PictureSpec {
            size: picture.size,
            render: picture.settings,
            // What A and B share has its own insets, in window pixels.
            insets: match filling {
                Filling::A | Filling::B => now.insets.clone(),
                Filling::Outside | Filling::Shared => Vec::new(),
            },
            ..now
        };
        let drawn_of_now = self
            .shown_scene()
            .is_some_and(|scene| Arc::ptr_eq(scene, &picture.scene));
        let seen_from_there = spec.view.transform(picture.scene.canvas, picture.size) == picture.view;
        let compared = self.compared();
        let differs = match &compared {
            _ if !drawn_of_now || !seen_from_there => {
                Some("the view moved on while this picture was saved; the command line draws where it went".to_owned())
            }
            Some(RecipeOfB { against, .. }) if filling == Filling::Outside => Some(format!(
                "this picture is B, {against}, which comes from outside; the command line draws A alone"
            )),
            Some(RecipeOfB {
                against, arrangement, ..
            }) => Some(format!(
                "A and B share this picture ({arrangement}; B: {against}); the command line draws A alone"
            )),
            // B is still to come.
            None if self.draws_a_alone() => {
                Some("A and B share this picture; the command line draws A alone".to_owned())
            }
            None => None,
        };
        Some(Recipe {
            spec,
            scene: Arc::clone(&picture.scene),
            command: None,
            differs,
            compared,
        })
    }

    /// B, where a picture shows it and no command line of one picture draws that.
    fn compared(&self) -> Option<RecipeOfB> {
        let ab = self.both.ab;
        let other = ab.other().filter(|_| self.draws_a_alone())?;
        let against = match other {
            Other::Settings { render, dialect } => {
                let (render, dialect) = (*render, *dialect);
                let changes = BoardEntry { render, dialect }.change_text(BoardEntry::of(self.both.settings));
                if changes.is_empty() {
                    "settings".to_owned()
                } else {
                    changes
                }
            }
            Other::Truth(None) => "truth".to_owned(),
            Other::Truth(Some(space)) => format!("truth {}", space.name()),
            Other::Picture(picture) => picture.path.display().to_string(),
        };
        let style = ab.difference_style();
        let shared = match (ab.arrangement(), style.gain) {
            (Arrangement::Wipe, _) => format!("wipe {}", self.part_of_a()),
            (Arrangement::Difference, Gain::Normalize) => format!("difference {}; normalize on", style.measure.name()),
            (Arrangement::Difference, Gain::Factor(gain)) => {
                format!("difference {}; gain {gain}", style.measure.name())
            }
            (arrangement, _) => format!("arrange {}", arrangement.name()),
        };
        let arrangement = if ab.is_swapped() {
            format!("swap; {shared}")
        } else {
            shared
        };
        let picture = match other {
            Other::Picture(picture) => Some(picture.path.clone()),
            Other::Settings { .. } | Other::Truth(_) => None,
        };
        Some(RecipeOfB {
            against,
            arrangement,
            picture,
        })
    }

    /// How much of the width of both is A's in a wipe: `0.0..=1.0`, with four decimals.
    fn part_of_a(&self) -> f64 {
        let width = self.both.layout.frame_size()[0].max(1);
        let column = self.both.ab.wipe_column(width, &self.both.layout);
        (f64::from(column) / f64::from(width) * 1e4).round() / 1e4
    }

    /// What a screenshot of this frame shows: where it fills the window, what its command line draws and nothing else.
    pub(in crate::viewer) fn shot_of(&self, frame: &Arc<Frame>, recipe: Option<&Recipe>) -> Shot {
        if self.draws_a_alone() {
            return Shot::Ready(self.picture_of_both());
        }
        let Picture { settings, scene, .. } = &frame.picture;
        let shown = Some(settings.visualisation).filter(|shown| *shown != Visualisation::Color);
        Shot::Frame {
            frame: Arc::clone(frame),
            insets: recipe.map_or(Vec::new(), |recipe| recipe.spec.insets.clone()),
            legends: shown
                .and_then(|shown| shown.legend_of(scene, shown.clamped(frame.pixels.pixels())))
                .into_iter()
                .collect(),
        }
    }

    /// Protects what is shown: the scene with its textures, and a picture that is compared with it.
    pub fn guard(&self) -> Guard {
        let mut guard = Guard::default();
        if let Some((entry, scene)) = self
            .both
            .scene_list
            .current()
            .and_then(|entry| Some((entry, entry.scene()?)))
        {
            entry.source.protect(&scene.files, &mut guard);
        }
        if let Some(Other::Picture(picture)) = self.both.ab.other() {
            guard.protect(&picture.path);
        }
        guard
    }
}
