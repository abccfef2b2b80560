//! How textures are sampled.

use super::idle;
use crate::color::ResolveSpace;
use crate::texture::{
    Anisotropy, Derivatives, FixedLevel, FootprintExtent, LevelSampling, LodBias, PixelSampling, PyramidFilter, Wrap,
};
use crate::viewer::key_chords::Chord;
use crate::viewer::settings::row::{About, Control, PanelRow, PictureSetting, SettingCommand, Told, Values};
use crate::viewer::settings::{Settings, values};

/// The rows.
pub(super) const ROWS: &[PictureSetting] = &[
    PictureSetting {
        help: "How a texture is read inside a mip level",
        about: About::Textures,
        told: Told::Always,
        panel: Some(PanelRow::new("Pixel", "Pixel sampling of textures", Control::List)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Catmull-Rom is the sharpest and rings at edges, the B-spline blurs, Mitchell lies between; sixteen texels cost four to seven times as much as the nearest",
            keys: &[Chord::char('p')],
            ..SettingCommand::new(
                "pixel-sampling",
                "Pixel sampling",
                "Reads the nearest texel, bilinear the four around a point, or sixteen by a cubic kernel",
            )
        }],
        ..named!("pixel-sampling", "pixel sampling", PixelSampling, render.pixel_sampling)
    },
    PictureSetting {
        help: "What a texture shows beyond its border",
        about: About::Textures,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("", "Texture wrap", Control::ShortList)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Filters read across the border then, so that the first texels take on the colour of the last ones; what is filtered takes up to twice as long",
            ..SettingCommand::new(
                "texture-wrap",
                "Texture wrap",
                "Goes on beyond a texture's border with its outermost texels, or repeats it, or mirrors it",
            )
        }],
        ..named!("texture-wrap", "wrap", Wrap, render.texture_wrap)
    },
    PictureSetting {
        help: "Which mip levels of a texture are read, or by what its area is weighed",
        about: About::Textures,
        told: Told::Always,
        panel: Some(PanelRow::new("Level", "Level sampling of textures", Control::List)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "An ellipse blurs least and costs some fifteen times level zero at 16 samples; a box from sums, some seven times, and a ripmap, some three, blur what lies across the axes",
            keys: &[Chord::char('l')],
            ..SettingCommand::new(
                "level-sampling",
                "Level sampling",
                "Reads mip level zero, the nearest or two mixed; or weighs the footprint's area, by an ellipse (ewa), a summed-area table or a ripmap",
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
        panel: Some(PanelRow::new("Anisotropy", "Anisotropy", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "The level then fits the footprint's width, so that floors stay sharp towards the horizon",
            keys: &[Chord::char('t')],
            ..SettingCommand::new(
                "anisotropy",
                "Anisotropy",
                "Doubles the most texture taps along a footprint that is longer than wide: 1, which is off, to 64",
            )
        }],
        signed: false,
        goes_round: true,
        idle: idle::taps,
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
        label: "level bias",
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
        panel: Some(PanelRow::new(
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
                more: "Below zero textures are sharper and shimmer, above zero they are blurred; level sampling zero has no level to change, unless one is fixed",
                ..SettingCommand::new(
                    "lod-bias",
                    "Level of detail bias",
                    "Adds to the level of detail of every texture",
                )
            },
            SettingCommand {
                step: Some(-0.5),
                keys: &[Chord::char(',')],
                ..SettingCommand::new(
                    "sharper",
                    "Sharper textures",
                    "Lowers the bias of the level of detail to the next half",
                )
            },
            SettingCommand {
                step: Some(0.5),
                keys: &[Chord::char('.')],
                ..SettingCommand::new(
                    "softer",
                    "Softer textures",
                    "Raises the bias of the level of detail to the next half",
                )
            },
        ],
        signed: true,
        goes_round: false,
        idle: idle::levels,
        former: |_| None,
        get: |settings| settings.render.detail.bias.levels().to_string(),
        set: |settings, text| {
            settings.render.detail.bias = values::number(text).and_then(LodBias::new)?;
            Some(())
        },
        step: |settings, by| settings.render.detail.bias = settings.render.detail.bias.next_multiple(by),
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
        panel: Some(PanelRow::new(
            "",
            "Fixed level",
            Control::Number {
                range: [0.0, FixedLevel::MAX],
                digits: 2,
                prefix: "level ",
                none: Some(values::AUTO),
            },
        )),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Level sampling linear also takes levels between two, up to 16; a texture with fewer levels shows its last",
            keys: &[Chord::char('m')],
            ..SettingCommand::new(
                "lod-level",
                "Fixed level",
                "Reads every texture at one mip level instead of the one that fits: auto, 0, 1, 2 ... 8",
            )
        }],
        signed: false,
        goes_round: true,
        idle: |_| None,
        former: |_| None,
        get: |settings| {
            let level = settings.render.detail.fixed;
            level.map_or(values::AUTO.to_owned(), |level| level.level().to_string())
        },
        set: |settings, text| {
            settings.render.detail.fixed = match text {
                values::AUTO => None,
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
        panel: Some(PanelRow::new("Level per", "Level of detail per", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Per sample, higher rates read finer levels and leave the averaging to the samples",
            ..SettingCommand::new(
                "lod-per",
                "Level of detail per",
                "Switches between the level of detail of a pixel's footprint and of a sample's",
            )
        }],
        idle: idle::lod_per,
        ..named!("lod-per", "level per", Derivatives, render.detail.derivatives)
    },
    PictureSetting {
        help: "What of a footprint the level of detail follows: its longer side, its area, or its shorter axis",
        about: About::Textures,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("Level by", "Level of detail by", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "The longer side blurs what lies across it, the shorter axis misses what lies along; anisotropic taps need neither, and beside them it counts only where one tap is enough: in footprints about as wide as long, and in enlarged textures",
            ..SettingCommand::new(
                "lod-by",
                "Level of detail by",
                "Chooses what of a footprint the level of detail follows: its longer side, its area, or its shorter axis",
            )
        }],
        idle: idle::lod_by,
        ..named!("lod-by", "level by", FootprintExtent, render.detail.extent)
    },
    PictureSetting {
        help: "In which values the texels of coarser mip levels are averaged",
        about: About::Textures,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("Pyramid", "Mip levels averaged in", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "The one in which samples are averaged fits: another one makes fine patterns darker or brighter as they shrink",
            ..SettingCommand::new(
                "pyramid",
                "Pyramid",
                "Averages the texels of coarser mip levels in stored values or in linear light",
            )
        }],
        idle: idle::levels,
        ..named!("pyramid", "pyramid", ResolveSpace, render.pyramid)
    },
    PictureSetting {
        help: "By which filter coarser mip levels are made",
        about: About::Textures,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("", "Filter of mip levels", Control::List)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "A tent has fewer aliases and is softer, a Kaiser window sharper and rings at edges; both cost only when a level is made",
            ..SettingCommand::new(
                "pyramid-filter",
                "Pyramid filter",
                "Makes coarser mip levels by the mean over a texel, by a tent, or by a sinc under a Kaiser window",
            )
        }],
        idle: idle::levels,
        ..named!("pyramid-filter", "pyramid filter", PyramidFilter, render.pyramid_filter)
    },
];

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
