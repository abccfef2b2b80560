//! What a picture shows, by whose rules.

use crate::render::Visualisation;
use crate::rules::Rules;
use crate::scene::DialectChoice;
use crate::viewer::key_chords::{Chord, Key, Modifiers};
use crate::viewer::settings::row::{About, Control, PanelRow, PictureSetting, SettingCommand, Told, Values};
use crate::viewer::settings::values;

/// The rows.
pub(super) const ROWS: &[PictureSetting] = &[
    PictureSetting {
        placeholder: "WHAT",
        help: "What the pixels show; all but colour come with a legend",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("Visualise", "Visualisation", Control::List)),
        commands: &[
            SettingCommand {
                step: Some(1.0),
                takes_value: true,
                more: "Shapes and samples stay those of the picture, only what they are painted with changes; the legend says how",
                keys: &[Chord::char('v')],
                ..SettingCommand::new(
                    "visualise",
                    "Visualisation",
                    "Shows the next of what decides the picture, such as coverage, wireframe or mip levels, in place of its colours",
                )
            },
            SettingCommand {
                step: Some(-1.0),
                keys: &[Chord::new(Key::Char('v'), Modifiers::SHIFT)],
                ..SettingCommand::new(
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
        panel: Some(PanelRow::new("Rules", "Rules", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "A first draft has edges in 32-bit floats and no rule for ties: samples on a shared edge are nobody's",
            ..SettingCommand::new(
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
            ..SettingCommand::new(
                "background",
                "Background",
                "Sets what lies below the scene: white, transparent or a colour",
            )
        }],
        signed: false,
        goes_round: true,
        idle: |_| None,
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
        panel: Some(PanelRow::new("Dialect", "Dialect", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            ..SettingCommand::new(
                "dialect",
                "Dialect",
                "Switches how documents are read: auto, course or svg",
            )
        }],
        ..named!("dialect", "dialect", DialectChoice, dialect)
    },
];
