//! The one table of picture settings.
//!
//! A setting that a picture knows is a row here and the code that reads it: keys, help and palette, the panel, the options of
//! the command line and their help, records, lessons, captions and the axes of sheets come from the rows.

use super::row::PictureSetting;

/// A setting whose values have names; `$field` is where the settings keep it.
macro_rules! named {
    ($option:literal, $label:literal, $kind:ty, $($field:ident).+) => {
        PictureSetting {
            option: $option,
            label: $label,
            placeholder: "",
            help: "",
            values: Values::Named(|| <$kind>::ALL.map(<$kind>::name).to_vec()),
            about: About::Samples,
            told: Told::IfDifferent,
            panel: None,
            commands: &[],
            signed: false,
            goes_round: true,
            idle: |_| None,
            former: |_| None,
            get: |settings| settings.$($field).+.name().to_owned(),
            set: |settings, text| {
                settings.$($field).+ = values::named(&<$kind>::ALL, <$kind>::name, text)?;
                Some(())
            },
            step: |settings, by| settings.$($field).+ = values::next_of(&<$kind>::ALL, settings.$($field).+, by),
        }
    };
}

mod idle;
mod resolve;
mod samples;
mod shown;
mod textures;

/// Every setting that decides the pixels of a picture, in the order of menus and of the command line.
pub(super) fn picture_settings() -> impl Iterator<Item = &'static PictureSetting> {
    [samples::ROWS, textures::ROWS, resolve::ROWS, shown::ROWS]
        .into_iter()
        .flatten()
}
