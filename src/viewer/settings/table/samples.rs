//! Where samples lie, and how many.

use super::idle;
use crate::raster::{PixelCoverage, SamplePattern, SampleRate, Seed, ShadingRate};
use crate::viewer::key_chords::Chord;
use crate::viewer::settings::row::{About, Control, PanelRow, PictureSetting, SettingCommand, Told, Values};
use crate::viewer::settings::{Settings, patterns, values};

/// The rows.
pub(super) const ROWS: &[PictureSetting] = &[
    PictureSetting {
        option: "sample-rate",
        label: "sample rate",
        placeholder: "N",
        help: "Samples per pixel: a square number up to 256; with patterns such as halton and sobol any number up to that",
        values: Values::Open {
            form: "a whole number from 1 to 256",
            range: "1, 4, 9 ... 256",
            some: &["1", "4", "16"],
            offered: rates,
        },
        about: About::Samples,
        told: Told::Always,
        panel: Some(PanelRow::new(
            "Samples per pixel",
            "Samples per pixel",
            Control::WideButtons(usize::MAX),
        )),
        commands: &[
            SettingCommand {
                step: Some(-1.0),
                keys: &[Chord::char('-')],
                ..SettingCommand::new("rate-down", "Lower sample rate", "Takes fewer samples per pixel")
            },
            SettingCommand {
                step: Some(1.0),
                keys: &[Chord::char('='), Chord::anywhere('+')],
                ..SettingCommand::new("rate-up", "Higher sample rate", "Takes more samples per pixel")
            },
            SettingCommand {
                takes_value: true,
                ..SettingCommand::new(
                    "rate",
                    "Sample rate",
                    "Sets the samples per pixel: 1, 4, 9, 16 ... 256; with patterns such as halton and sobol any number",
                )
            },
        ],
        signed: false,
        goes_round: false,
        idle: idle::samples,
        former: |_| None,
        get: |settings| settings.render.sample_rate.samples().to_string(),
        set: |settings, text| {
            settings.render.sample_rate = values::whole(text).and_then(SampleRate::new)?;
            Some(())
        },
        step: |settings, by| {
            let rate = settings.render.sample_rate;
            settings.render.sample_rate = if by < 0.0 { rate.lower() } else { rate.higher() };
        },
    },
    PictureSetting {
        help: "Where the samples of a pixel lie: a pattern by name, or a TOML file of places and weights",
        values: Values::NamedOrWritten {
            names: || SamplePattern::ALL.map(SamplePattern::name).to_vec(),
            more: patterns::shipped_names,
            form: patterns::FORM,
            short: patterns::name_in,
            kept: |settings| settings.own_pattern.map(patterns::value_of),
            is_file: patterns::is_file_name,
            of_file: patterns::of_file,
        },
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("Pattern", "Sample pattern", Control::List)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Off the grid, edges that are nearly upright or level get more shades, and jitter turns aliases into noise",
            keys: &[Chord::char('a')],
            ..SettingCommand::new(
                "pattern",
                "Sample pattern",
                "Moves the samples inside their pixels, by the next pattern",
            )
        }],
        idle: idle::samples,
        get: |settings| patterns::value_of(settings.render.pattern),
        set: |settings, text| {
            let pattern = patterns::named(text)?;
            settings.render.pattern = pattern;
            if patterns::is_own(pattern) {
                settings.own_pattern = Some(pattern);
            }
            Some(())
        },
        step: |settings, by| {
            // After those that take any rate come the custom ones that take this one.
            let rate = settings.render.sample_rate;
            let custom = patterns::shipped().iter().copied().chain(settings.own_pattern);
            let fitting = custom.filter(|pattern| pattern.takes(rate));
            let all: Vec<SamplePattern> = SamplePattern::ALL.into_iter().chain(fitting).collect();
            let now = settings.render.pattern;
            settings.render.pattern = match all.contains(&now) {
                true => values::next_of(&all, now, by),
                // A user's own pattern stands before the first one.
                false if by < 0.0 => all[all.len() - 1],
                false => SamplePattern::Grid,
            };
        },
        ..named!("pattern", "pattern", SamplePattern, render.pattern)
    },
    PictureSetting {
        option: "seed",
        label: "seed",
        placeholder: "N",
        help: "Which places samples have where chance decides about them: 0 to 65535",
        values: Values::Open {
            form: "a whole number from 0 to 65535",
            range: "0 ... 65535",
            some: &["0", "1", "2", "3"],
            offered: |_| Vec::new(),
        },
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(PanelRow::new(
            "",
            "Seed of random patterns",
            Control::Number {
                range: [0.0, 65_535.0],
                digits: 0,
                prefix: "seed ",
                none: None,
            },
        )),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Patterns without chance stay as they are: grid, rotated, halton, hammersley, r2, those of msaa and custom ones",
            ..SettingCommand::new(
                "seed",
                "Seed of random patterns",
                "Places the samples of random patterns otherwise, by the next seed",
            )
        }],
        signed: false,
        goes_round: true,
        idle: idle::seed,
        former: |_| None,
        get: |settings| settings.render.seed.number().to_string(),
        set: |settings, text| {
            settings.render.seed = values::whole(text).and_then(Seed::new)?;
            Some(())
        },
        step: |settings, by| {
            let seed = settings.render.seed.number();
            let next = if by < 0.0 { seed.wrapping_sub(1) } else { seed + 1 };
            settings.render.seed = Seed::new(next % (Seed::MAX + 1)).unwrap_or_default();
        },
    },
    PictureSetting {
        help: "Where colours are computed: at every sample, or once per primitive and pixel, in the pixel's centre or in the centroid of the covered samples",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("Shading", "Shading rate of primitives", Control::List)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Once is multisampling: edges stay smooth for the price of one colour, and textures alias as with one sample per pixel",
            ..SettingCommand::new(
                "shading-rate",
                "Shading rate",
                "Computes colours at every sample, or once per primitive and pixel: in its centre or the centroid of what is covered",
            )
        }],
        idle: idle::samples,
        ..named!("shading-rate", "shading rate", ShadingRate, render.shading)
    },
    PictureSetting {
        help: "What tells how much of a pixel a primitive covers: its samples, or its exact area, composited source-over as renderers of vector graphics do",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("", "Coverage of pixels", Control::List)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Exact areas give edges every shade for the price of one colour per pixel, but let the background through between neighbours that share an edge; samples, their pattern and their shading are without effect then",
            ..SettingCommand::new(
                "coverage",
                "Coverage",
                "Covers pixels by samples, or by exact areas that are composited source-over",
            )
        }],
        idle: idle::colours,
        ..named!("coverage", "coverage", PixelCoverage, render.coverage)
    },
];

/// The rates that keys reach, and the current one if it lies beyond.
fn rates(settings: &Settings) -> Vec<String> {
    let current = settings.render.sample_rate;
    let mut rates = vec![SampleRate::ONE];
    while let Some(last) = rates.last()
        && last.higher() != *last
    {
        rates.push(last.higher());
    }
    if !rates.contains(&current) {
        rates.push(current);
    }
    rates.into_iter().map(|rate| rate.samples().to_string()).collect()
}
