//! The one table of picture settings.
//!
//! A setting that a picture knows is a row here and the code that reads it: keys, help and palette, the panel, the options of
//! the command line and their help, records, lessons, captions and the axes of sheets come from the rows.

use super::row::{About, Control, PanelRow, PictureSetting, SettingCommand, Told, Values};
use super::{Settings, values};
use crate::color::ResolveSpace;
use crate::raster::{FilterRadius, ResolveFilter, SamplePattern, SampleRate, Seed};
use crate::render::Visualisation;
use crate::rules::Rules;
use crate::scene::DialectChoice;
use crate::texture::{Anisotropy, Derivatives, FixedLevel, LevelSampling, LodBias, PixelSampling};
use crate::viewer::key_chords::{Chord, Key, Modifiers};

/// What stands for a level that nobody fixed, or a radius.
const AUTO: &str = "auto";

/// A setting whose values have names; `$field` is where [`Settings`] keep it.
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

/// Every setting that decides the pixels of a picture, in the order of menus and of the command line.
pub(super) static PICTURE_SETTINGS: &[PictureSetting] = &[
    PictureSetting {
        option: "sample-rate",
        label: "sample rate",
        placeholder: "N",
        help: "Samples per pixel: a square number up to 256; with the patterns halton and r2 any number up to that",
        values: Values::Open {
            form: "a whole number from 1 to 256",
            range: "1, 4, 9 ... 256",
            some: &["1", "4", "16"],
            offered: rates,
        },
        about: About::Samples,
        told: Told::Always,
        panel: Some(row(
            "Samples per pixel",
            "Samples per pixel",
            Control::WideButtons(usize::MAX),
        )),
        commands: &[
            SettingCommand {
                step: Some(-1.0),
                keys: &[Chord::char('-')],
                ..command("rate-down", "Lower sample rate", "Takes fewer samples per pixel")
            },
            SettingCommand {
                step: Some(1.0),
                keys: &[Chord::char('='), Chord::anywhere('+')],
                ..command("rate-up", "Higher sample rate", "Takes more samples per pixel")
            },
            SettingCommand {
                takes_value: true,
                ..command(
                    "rate",
                    "Sample rate",
                    "Sets the samples per pixel: 1, 4, 9, 16 ... 256; with the patterns halton and r2 any number",
                )
            },
        ],
        signed: false,
        goes_round: false,
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
        help: "Where the samples of a pixel lie",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(row("Pattern", "Sample pattern", Control::List)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Off the grid, edges that are nearly upright or level get more shades, and jitter turns aliases into noise",
            keys: &[Chord::char('a')],
            ..command(
                "pattern",
                "Sample pattern",
                "Moves the samples inside their pixels, by the next pattern",
            )
        }],
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
        panel: Some(row(
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
            more: "Patterns without chance stay as they are: grid, rotated, halton, hammersley and r2",
            ..command(
                "seed",
                "Seed of random patterns",
                "Places the samples of random patterns otherwise, by the next seed",
            )
        }],
        signed: false,
        goes_round: true,
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
        help: "How a texture is read inside a mip level",
        about: About::Textures,
        told: Told::Always,
        panel: Some(row("Pixel", "Pixel sampling", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            keys: &[Chord::char('p')],
            ..command(
                "pixel-sampling",
                "Pixel sampling",
                "Switches between nearest and bilinear texels",
            )
        }],
        ..named!("pixel-sampling", "pixel sampling", PixelSampling, render.pixel_sampling)
    },
    PictureSetting {
        help: "Which mip levels of a texture are read",
        about: About::Textures,
        told: Told::Always,
        panel: Some(row("Level", "Level sampling", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            keys: &[Chord::char('l')],
            ..command(
                "level-sampling",
                "Level sampling",
                "Switches between mip level zero, nearest and linear",
            )
        }],
        ..named!("level-sampling", "level sampling", LevelSampling, render.level_sampling)
    },
    PictureSetting {
        option: "anisotropy",
        label: "anisotropy",
        placeholder: "N",
        help: "The most taps along a footprint that is longer than wide: 1 (off) to 64",
        values: Values::Open {
            form: "a whole number from 1, which is off, to 64",
            range: "1 ... 64",
            some: &["1", "4", "16"],
            offered: taps,
        },
        about: About::Textures,
        told: Told::IfChanged,
        panel: Some(row("Anisotropy", "Anisotropy", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "The level then fits the footprint's width, so that floors stay sharp towards the horizon",
            keys: &[Chord::char('t')],
            ..command(
                "anisotropy",
                "Anisotropy",
                "Doubles the most texture taps along a footprint that is longer than wide: 1, which is off, to 64",
            )
        }],
        signed: false,
        goes_round: true,
        former: |_| None,
        get: |settings| settings.render.anisotropy.taps().to_string(),
        set: |settings, text| {
            settings.render.anisotropy = values::whole(text).and_then(Anisotropy::new)?;
            Some(())
        },
        step: |settings, by| {
            let taps = settings.render.anisotropy;
            settings.render.anisotropy = if by < 0.0 {
                values::next_of(&Anisotropy::STEPS, taps, by)
            } else {
                taps.doubled()
            };
        },
    },
    PictureSetting {
        option: "lod-bias",
        label: "bias",
        placeholder: "B",
        help: "Levels added to a texture's level of detail: -16 to 16; below zero sharpens",
        values: Values::Open {
            form: "a number of levels from -16 to 16",
            range: "-16 ... 16",
            some: &["-1", "0", "1"],
            offered: |_| Vec::new(),
        },
        about: About::Textures,
        told: Told::IfChanged,
        panel: Some(row(
            "Level bias",
            "Level of detail bias",
            Control::Number {
                range: [-LodBias::MAX, LodBias::MAX],
                digits: 2,
                prefix: "",
                none: None,
            },
        )),
        commands: &[
            SettingCommand {
                takes_value: true,
                more: "Below zero textures are sharper and shimmer, above zero they are blurred; level sampling zero has no level to change",
                ..command(
                    "lod-bias",
                    "Level of detail bias",
                    "Adds to the level of detail of every texture",
                )
            },
            SettingCommand {
                step: Some(-0.5),
                keys: &[Chord::char(',')],
                ..command(
                    "sharper",
                    "Sharper textures",
                    "Lowers the bias of the level of detail by a half",
                )
            },
            SettingCommand {
                step: Some(0.5),
                keys: &[Chord::char('.')],
                ..command(
                    "softer",
                    "Softer textures",
                    "Raises the bias of the level of detail by a half",
                )
            },
        ],
        signed: true,
        goes_round: false,
        former: |_| None,
        get: |settings| settings.render.detail.bias.levels().to_string(),
        set: |settings, text| {
            settings.render.detail.bias = values::number(text).and_then(LodBias::new)?;
            Some(())
        },
        step: |settings, by| settings.render.detail.bias = settings.render.detail.bias.stepped(by),
    },
    PictureSetting {
        option: "lod-level",
        label: "level",
        placeholder: "L",
        help: "The level of detail instead of the footprint's: auto, or 0 to 16",
        values: Values::Open {
            form: "auto, or a number from 0, the base, to 16",
            range: "`auto`, 0 ... 16",
            some: &["0", "1", "2"],
            offered: |_| Vec::new(),
        },
        about: About::Textures,
        told: Told::IfChanged,
        panel: Some(row(
            "",
            "Fixed level",
            Control::Number {
                range: [0.0, FixedLevel::MAX],
                digits: 2,
                prefix: "level ",
                none: Some(AUTO),
            },
        )),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Level sampling linear also takes levels between two, up to 16; a texture with fewer levels shows its last",
            keys: &[Chord::char('m')],
            ..command(
                "lod-level",
                "Fixed level",
                "Reads every texture at one mip level instead of the one that fits: auto, 0, 1, 2 ... 8",
            )
        }],
        signed: false,
        goes_round: true,
        former: |_| None,
        get: |settings| {
            let level = settings.render.detail.fixed;
            level.map_or(AUTO.to_owned(), |level| level.level().to_string())
        },
        set: |settings, text| {
            settings.render.detail.fixed = match text {
                AUTO => None,
                _ => Some(values::number(text).and_then(FixedLevel::new)?),
            };
            Some(())
        },
        step: |settings, _| settings.render.detail.fixed = FixedLevel::after(settings.render.detail.fixed),
    },
    PictureSetting {
        help: "Whether a footprint is a pixel's or a sample's",
        about: About::Textures,
        told: Told::IfChanged,
        panel: Some(row("Level per", "Level of detail per", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Per sample, higher rates read finer levels and leave the averaging to the samples",
            ..command(
                "lod-per",
                "Level of detail per",
                "Switches between the level of detail of a pixel's footprint and of a sample's",
            )
        }],
        ..named!("lod-per", "level per", Derivatives, render.detail.derivatives)
    },
    PictureSetting {
        help: "What samples weigh in a pixel, its own and its neighbours'",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(row("Filter", "Resolve filter", Control::List)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Wider ones than the box take samples of neighbours too: less moire, for some blur or ringing, and for more time",
            ..command(
                "resolve-filter",
                "Resolve filter",
                "Weighs the samples of a pixel and its neighbours by the next filter, such as Mitchell's or Lanczos'",
            )
        }],
        ..named!("resolve-filter", "filter", ResolveFilter, render.resolve_filter)
    },
    PictureSetting {
        option: "filter-radius",
        label: "filter radius",
        placeholder: "R",
        help: "How far the resolve filter reaches, in pixels: auto, or 0.5 to 4",
        values: Values::Open {
            form: "auto, or a number of pixels from 0.5 to 4",
            range: "`auto`, 0.5 ... 4",
            some: &["1", "1.5", "2"],
            offered: |_| Vec::new(),
        },
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(row(
            "Radius",
            "Radius of the resolve filter",
            Control::Number {
                range: [FilterRadius::MIN, FilterRadius::MAX],
                digits: 2,
                prefix: "",
                none: Some(AUTO),
            },
        )),
        commands: &[SettingCommand {
            step: Some(0.5),
            takes_value: true,
            more: "A wider one blurs more and takes longer; auto is each filter's own: 0.5 for the box, 2 for Mitchell's",
            ..command(
                "filter-radius",
                "Filter radius",
                "Stretches the resolve filter to the next radius, half a pixel wider: 0.5 to 4, then auto",
            )
        }],
        signed: false,
        goes_round: true,
        former: |_| None,
        get: |settings| {
            let radius = settings.render.filter_radius;
            radius.map_or(AUTO.to_owned(), |radius| radius.pixels().to_string())
        },
        set: |settings, text| {
            settings.render.filter_radius = match text {
                AUTO => None,
                _ => Some(values::number(text).and_then(FilterRadius::new)?),
            };
            Some(())
        },
        step: |settings, by| {
            let render = &mut settings.render;
            let now = render.resolve_filter.sized(render.filter_radius).radius();
            render.filter_radius = FilterRadius::new(now + by);
        },
    },
    PictureSetting {
        help: "In which values the samples of a pixel are averaged",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(row("Resolve", "Resolve space", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "In linear light half black and half white is 188, which from afar looks like the pattern itself; stored it is 128 and looks darker",
            ..command(
                "resolve",
                "Resolve space",
                "Switches between averaging the samples of a pixel as stored and as the light that they stand for",
            )
        }],
        ..named!("resolve", "resolve", ResolveSpace, render.resolve)
    },
    PictureSetting {
        placeholder: "WHAT",
        help: "What the pixels show; all but colour come with a legend",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(row("Show", "Visualisation", Control::List)),
        commands: &[
            SettingCommand {
                step: Some(1.0),
                takes_value: true,
                more: "Shapes and samples stay those of the picture, only what they are painted with changes; the legend says how",
                keys: &[Chord::char('v')],
                ..command(
                    "visualise",
                    "Visualisation",
                    "Shows the next of what decides the picture, such as coverage, wireframe or mip levels, in place of its colours",
                )
            },
            SettingCommand {
                step: Some(-1.0),
                keys: &[Chord::new(Key::Char('v'), Modifiers::SHIFT)],
                ..command(
                    "visualise-back",
                    "Previous visualisation",
                    "Shows the visualisation before this one",
                )
            },
        ],
        former: |name| {
            Visualisation::ALL
                .into_iter()
                .find(|value| value.name() == name)?
                .former_name()
        },
        ..named!("visualise", "visualise", Visualisation, render.visualisation)
    },
    PictureSetting {
        help: "Whose conventions decide edges, texels and bytes",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(row("Rules", "Rules", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "A first draft has edges in 32-bit floats and no rule for ties: samples on a shared edge are nobody's",
            ..command(
                "rules",
                "Rules",
                "Shows the picture by the next rules: standard, the course's, a first draft's",
            )
        }],
        ..named!("rules", "rules", Rules, render.rules)
    },
    PictureSetting {
        option: "background",
        label: "background",
        placeholder: "COLOUR",
        help: "What lies below the scene: white, transparent or #RRGGBB",
        values: Values::Open {
            form: "white|transparent|#RRGGBB",
            range: "`white`, `transparent`, `#RRGGBB`",
            some: &["white", "#808080"],
            offered: |_| Vec::new(),
        },
        about: About::Samples,
        told: Told::IfDifferent,
        panel: None,
        commands: &[SettingCommand {
            takes_value: true,
            ..command(
                "background",
                "Background",
                "Sets what lies below the scene: white, transparent or a colour",
            )
        }],
        signed: false,
        goes_round: true,
        former: |_| None,
        get: |settings| values::color_name(settings.render.background),
        set: |settings, text| {
            settings.render.background = values::color(text)?;
            Some(())
        },
        step: |_, _| {},
    },
    PictureSetting {
        help: "How documents are read",
        about: About::Document,
        told: Told::IfDifferent,
        panel: Some(row("Dialect", "Dialect", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            ..command(
                "dialect",
                "Dialect",
                "Switches how documents are read: auto, course or svg",
            )
        }],
        ..named!("dialect", "dialect", DialectChoice, dialect)
    },
];

const fn row(label: &'static str, name: &'static str, control: Control) -> PanelRow {
    PanelRow { label, name, control }
}

const fn command(id: &'static str, name: &'static str, help: &'static str) -> SettingCommand {
    SettingCommand {
        id,
        name,
        help,
        more: "",
        keys: &[],
        step: None,
        takes_value: false,
    }
}

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

/// The steps, with the current number in the place of the next lower one, so that the row does not get longer.
fn taps(settings: &Settings) -> Vec<String> {
    let current = settings.render.anisotropy;
    let mut steps = Anisotropy::STEPS;
    if !steps.contains(&current) {
        let at = steps.iter().rposition(|step| *step < current).unwrap_or(0);
        steps[at] = current;
    }
    steps.map(|step| step.taps().to_string()).to_vec()
}
