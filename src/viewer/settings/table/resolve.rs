//! How samples become a pixel.

use super::idle;
use crate::color::ResolveSpace;
use crate::post::PostProcess;
use crate::raster::{FilterRadius, ResolveFilter};
use crate::viewer::settings::row::{About, Control, PanelRow, PictureSetting, SettingCommand, Told, Values};
use crate::viewer::settings::values;

/// The rows.
pub(super) const ROWS: &[PictureSetting] = &[
    PictureSetting {
        help: "What samples weigh in a pixel, its own and its neighbours'",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("Filter", "Resolve filter", Control::List)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "Wider ones than the box take samples of neighbours too: less moire, for some blur or ringing, and for more time",
            ..SettingCommand::new(
                "resolve-filter",
                "Resolve filter",
                "Weighs the samples of a pixel and its neighbours by the next filter, such as Mitchell's or Lanczos'",
            )
        }],
        idle: idle::colours,
        ..named!("resolve-filter", "filter", ResolveFilter, render.resolve_filter)
    },
    PictureSetting {
        help: "What is done to the finished pixels: nothing, or morphological antialiasing (SMAA)",
        about: About::Samples,
        told: Told::IfChanged,
        panel: Some(PanelRow::new("", "Post-process of finished pixels", Control::ShortList)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "It smooths the stairs of long edges for little time, and invents what no sample saw: thin lines stay broken, and fine detail is blurred",
            ..SettingCommand::new(
                "post-process",
                "Post-process",
                "Leaves the finished pixels as they are, or guesses the lines behind stairs of pixels and blends along them (SMAA)",
            )
        }],
        idle: idle::colours,
        ..named!("post-process", "post-process", PostProcess, render.post_process)
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
        panel: Some(PanelRow::new(
            "Radius",
            "Radius of the resolve filter",
            Control::Number {
                range: [FilterRadius::MIN, FilterRadius::MAX],
                digits: 2,
                prefix: "",
                none: Some(values::AUTO),
            },
        )),
        commands: &[SettingCommand {
            step: Some(0.5),
            takes_value: true,
            more: "A wider one blurs more and takes longer; auto is each filter's own: 0.5 for the box, 2 for Mitchell's",
            ..SettingCommand::new(
                "filter-radius",
                "Filter radius",
                "Stretches the resolve filter to the next radius, half a pixel wider: 0.5 to 4, then auto",
            )
        }],
        signed: false,
        goes_round: true,
        idle: idle::colours,
        former: |_| None,
        get: |settings| {
            let radius = settings.render.filter_radius;
            radius.map_or(values::AUTO.to_owned(), |radius| radius.pixels().to_string())
        },
        set: |settings, text| {
            settings.render.filter_radius = match text {
                values::AUTO => None,
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
        panel: Some(PanelRow::new("Resolve", "Resolve space", Control::Buttons)),
        commands: &[SettingCommand {
            step: Some(1.0),
            takes_value: true,
            more: "In linear light half black and half white is 188, which from afar looks like the pattern itself; stored it is 128 and looks darker",
            ..SettingCommand::new(
                "resolve",
                "Resolve space",
                "Switches between averaging the samples of a pixel as stored and as the light that they stand for",
            )
        }],
        idle: idle::resolve,
        ..named!("resolve", "resolve", ResolveSpace, render.resolve)
    },
];
