//! Spectra, found out in a thread.

use std::io;
use std::sync::Arc;

use crate::compare::{SpectrumAnalysis, SpectrumOf};
use crate::inspect::{Explanation, Question};
use crate::raster::Region;
use crate::render::Subject;
use crate::viewer::frames::frame::Picture;
use crate::viewer::jobs::latest::Latest;
use crate::viewer::jobs::mailbox::Mailbox;

/// The state of finding out; what has no spectrum is `None`.
pub(in crate::viewer) type Spectra = Latest<SpectrumQuestion, Option<Arc<SpectrumFound>>>;

/// What a spectrum is asked of.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::viewer) struct SpectrumQuestion {
    pub(in crate::viewer) picture: Picture,
    pub(in crate::viewer) place: SpectrumPlace,
    pub(in crate::viewer) of: SpectrumOf,
}

/// Where in a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SpectrumPlace {
    /// The pixels that are transformed, or those in their middle.
    pub region: Region,
    /// The pixel whose texture counts.
    pub pixel: [u32; 2],
}

/// A spectrum, and what it is of.
#[derive(Clone, Debug, PartialEq)]
pub struct SpectrumFound {
    /// The spectrum.
    pub analysis: SpectrumAnalysis,
    /// Where in the picture.
    pub place: SpectrumPlace,
    /// The mip level and its texture, such as `level 2 of floor.png`.
    pub level: Option<String>,
}

/// The spectrum of a picture of `size` pixels; `None` where there are no pixels, or no texture at the one that counts.
pub fn spectrum_of(
    subject: &Subject<'_>,
    size: [u32; 2],
    place: SpectrumPlace,
    of: SpectrumOf,
) -> Option<SpectrumFound> {
    let analyse = match of {
        SpectrumOf::Frame => SpectrumAnalysis::of_frame,
        SpectrumOf::Difference => SpectrumAnalysis::of_difference,
        SpectrumOf::Scene => SpectrumAnalysis::of_scene,
        SpectrumOf::Texture => return of_texture(subject, size, place),
    };
    Some(SpectrumFound {
        analysis: analyse(subject, size, place.region)?,
        place,
        level: None,
    })
}

fn of_texture(subject: &Subject<'_>, size: [u32; 2], place: SpectrumPlace) -> Option<SpectrumFound> {
    let explanation = Explanation::new(&Question {
        subject: *subject,
        file: "",
        size,
        pixel: place.pixel,
    })?;
    let used = explanation.level_in_use()?;
    let texels = used.texture.texels(subject.scene, &used.level)?;
    let name = &used.texture.name;
    let name = name.rsplit('/').next().unwrap_or(name);
    Some(SpectrumFound {
        analysis: SpectrumAnalysis::of_level(texels, place.pixel, used.to_texels),
        place,
        level: Some(format!("level {} of {name}", used.level.number)),
    })
}

/// Starts the thread.
pub(in crate::viewer) fn start(
    mailbox: Mailbox<(SpectrumQuestion, Option<Arc<SpectrumFound>>)>,
) -> io::Result<Spectra> {
    Latest::answering("spectrum", mailbox, |asked: &SpectrumQuestion| {
        spectrum_of(&asked.picture.subject(), asked.picture.size, asked.place, asked.of).map(Arc::new)
    })
}
