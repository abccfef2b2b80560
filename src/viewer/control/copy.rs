//! What goes to the clipboard: a pixel in words, the picture, an explanation, a command line.

use crate::inspect::Detail;
use crate::viewer::command::Effect;
use crate::viewer::control::pointing::Pointing;
use crate::viewer::control::recipes::Recipes;

/// What is copied, and what the user is told of it.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::viewer) struct Copied {
    pub(in crate::viewer) effect: Effect,
    pub(in crate::viewer) message: String,
}

impl Copied {
    /// A text, which the user is shown.
    pub(in crate::viewer) fn text(text: String) -> Self {
        Self {
            message: format!("copied: {text}"),
            effect: Effect::CopyText(text),
        }
    }

    /// The command line of the current picture, with a word about what it leaves out; `None` without a picture.
    pub(in crate::viewer) fn command_line(recipes: &Recipes<'_>) -> Option<Self> {
        let line = recipes.command_line()?;
        let whose = if recipes.draws_a_alone() { ", of A alone" } else { "" };
        Some(Self {
            message: format!("copied{whose}: {line}"),
            effect: Effect::CopyText(line),
        })
    }

    /// The pixel that the user means in words; `None` where there is none.
    pub(in crate::viewer) fn pixel(pixels: &Pointing<'_>) -> Option<Self> {
        // In the inset the pointer reads pixels that the user looks at; elsewhere it is where it happens to be.
        let in_inset = pixels.hovered().filter(|_| pixels.over_inset());
        let pinned = in_inset.or(pixels.pinned());
        let pixel = pinned.or(pixels.hovered()).or(pixels.inspected())?;
        let status = pixels.status_of(pixel)?;
        let other = pixels.other_status_of(pixel).and_then(|other| other.decimal_text());
        let other = other.map_or(String::new(), |other| format!("  B {other}"));
        Some(Self::text(format!("{status}{other}")))
    }

    /// The picture as a screenshot of this moment shows it.
    ///
    /// # Errors
    /// One line for the user when there is none.
    pub(in crate::viewer) fn picture(recipes: &Recipes<'_>) -> Result<Self, String> {
        let both = &recipes.both;
        let drawing = &both.frames.drawing;
        let frame = drawing.final_frame(drawing.newest_request());
        let both_current = !both.ab.shows_both() || both.ab.is_current();
        let frame = frame
            .filter(|_| both_current)
            .ok_or("nothing copied: there is no finished picture yet; copy again when it is drawn")?;
        let frame = recipes.shown_frame(frame);
        let recipe = recipes.recipe_of_frame(frame);
        let picture = recipes.shot_of(frame, recipe.as_ref()).picture()?;
        let (width, height) = (picture.width(), picture.height());
        Ok(Self {
            effect: Effect::CopyPicture(picture),
            message: format!("copied the picture, {width} x {height} pixels"),
        })
    }

    /// The explanation as Markdown; explained now if nobody did yet.
    ///
    /// # Errors
    /// One line for the user when there is nothing to explain.
    pub(in crate::viewer) fn explanation(recipes: &Recipes<'_>) -> Result<Self, String> {
        let pixels = &recipes.pixels;
        let pixel = pixels.inspected().filter(|_| pixels.inspector.magnifier.open);
        let asked = pixel.and_then(|pixel| pixels.question(pixel));
        let explained = asked
            .and_then(|asked| asked.explain())
            .ok_or("no pixel to explain: open the inspector with Z, or pin a pixel")?;
        Ok(Self {
            effect: Effect::CopyText(explained.own.markdown(Detail::Telling)),
            message: "copied the explanation as Markdown".to_owned(),
        })
    }
}
