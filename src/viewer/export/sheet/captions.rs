//! What is said below pictures: the scene, the settings, size and view.

use crate::plain;
use crate::viewer::export::sheet::axes::{Axis, Choice};
use crate::viewer::export::spec::PictureSpec;
use crate::viewer::library::SceneSource;
use crate::viewer::settings::picture::NO_EFFECT;
use crate::viewer::settings::{Settings, picture};

/// Settings of samples, by their options.
const PATTERN: &str = "pattern";
const RATE: &str = "sample-rate";
/// Longest name of a scene, in characters.
const MAX_NAME: usize = 200;

/// What is said of a single picture.
pub fn caption_of(spec: &PictureSpec) -> String {
    let settings = shared_words(spec, |name| has_no_effect(spec, name));
    let what = match settings.as_str() {
        "" => title(&spec.scene),
        settings => format!("{} with {settings}", title(&spec.scene)),
    };
    let parts = std::iter::once(what).chain(seen(spec, ""));
    format!("{}.", parts.collect::<Vec<_>>().join(". "))
}

/// What a measure of a picture says of it: the sample rate, the settings that differ from their defaults, size and view.
pub fn conditions_of(spec: &PictureSpec) -> String {
    let told = |name: &str| has_no_effect(spec, name) || name == RATE;
    // Whoever measures asks for it first.
    let rate = picture::find(RATE).filter(|_| !has_no_effect(spec, RATE));
    let rate = rate.map(|rate| rate.words(&Settings::of(spec.render, spec.dialect)));
    let settings = shared_words(spec, told);
    let settings: Vec<String> = rate
        .into_iter()
        .chain(Some(settings).filter(|words| !words.is_empty()))
        .collect();
    let settings = Some(settings.join(", ")).filter(|settings| !settings.is_empty());
    let parts: Vec<String> = settings.into_iter().chain(seen(spec, "")).collect();
    let mut said = format!("{}.", parts.join(". "));
    if let Some(first) = said.get_mut(..1) {
        first.make_ascii_uppercase();
    }
    said
}

/// What the values of axes are called. Patterns may bring numbers of samples of their own: then each is told with its number.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::viewer) struct Labels {
    /// Values of the axis of patterns, and the samples of their panels.
    rates: Vec<(String, u32)>,
    /// Names and values of axes that have no effect in any of their panels.
    idle: Choice,
    /// Settings that have none in any panel.
    idle_everywhere: Vec<&'static str>,
}

impl Labels {
    /// Those of some panels.
    pub(in crate::viewer) fn of(panels: &[(Choice, PictureSpec)]) -> Self {
        let rate = |(_, spec): &(Choice, PictureSpec)| spec.render.sample_rate;
        let value = |choice: &Choice, wanted: &str| {
            let known = choice.iter().find(|(name, _)| name == wanted);
            known.map(|(_, value)| value.clone())
        };
        let is_chosen = |(choice, _): &(Choice, PictureSpec)| value(choice, RATE).is_some();
        let differ = panels.windows(2).any(|two| rate(&two[0]) != rate(&two[1]));
        let of_pattern =
            |panel: &(Choice, PictureSpec)| value(&panel.0, PATTERN).map(|pattern| (pattern, rate(panel).samples()));
        Self {
            rates: if differ && !panels.iter().any(is_chosen) {
                panels.iter().filter_map(of_pattern).collect()
            } else {
                Vec::new()
            },
            idle: idle_values(panels),
            idle_everywhere: picture::all()
                .map(|setting| setting.option)
                .filter(|name| panels.iter().all(|(_, spec)| has_no_effect(spec, name)))
                .collect(),
        }
    }

    /// A value, such as `nearest` or `msaa-8 (8 samples)`.
    fn value(&self, axis: &Axis, value: &str) -> String {
        let mut rates = self.rates.iter().filter(|_| axis.name == PATTERN);
        let short = axis.short(value);
        match rates.find(|(known, _)| known == value) {
            Some((_, 1)) => format!("{short} (1 sample)"),
            Some((_, samples)) => format!("{short} ({samples} samples)"),
            None => short.to_owned(),
        }
    }

    /// A setting and its value, such as `pixel sampling nearest`; a value without effect in all panels that have it says so.
    pub(in crate::viewer) fn words(&self, axis: &Axis, value: &str) -> String {
        let is_idle = self
            .idle
            .iter()
            .any(|(name, known)| (name, known.as_str()) == (&axis.name, value));
        self.words_of(axis, value, is_idle)
    }

    fn words_of(&self, axis: &Axis, value: &str, is_idle: bool) -> String {
        let words = format!("{} {}", axis.title(), self.value(axis, value));
        if is_idle { format!("{words} {NO_EFFECT}") } else { words }
    }

    /// Whether a setting that is no axis is told by them, or need not be told.
    fn tell(&self, option: &str) -> bool {
        (option == RATE && !self.rates.is_empty()) || self.idle_everywhere.contains(&option)
    }
}

/// Whether the value of a setting makes no difference to a picture, whatever its scene.
fn has_no_effect(spec: &PictureSpec, option: &str) -> bool {
    let settings = Settings::of(spec.render, spec.dialect);
    picture::find(option).is_some_and(|setting| setting.idle(&settings, None).is_some())
}

/// Names and values of axes that have no effect in any of their panels.
fn idle_values(panels: &[(Choice, PictureSpec)]) -> Choice {
    let mut idle = Choice::new();
    for chosen in panels.iter().flat_map(|(choice, _)| choice) {
        let mut with = panels.iter().filter(|(choice, _)| choice.contains(chosen));
        if !idle.contains(chosen) && with.all(|(_, spec)| has_no_effect(spec, &chosen.0)) {
            idle.push(chosen.clone());
        }
    }
    idle
}

/// What differs between the panels of a sheet and what all of them share.
pub(in crate::viewer) fn caption(first: &PictureSpec, axes: &[&Axis], labels: &Labels, note: Option<&str>) -> String {
    let list = |axis: &Axis| {
        let values: Vec<String> = axis.values.iter().map(|value| labels.value(axis, value)).collect();
        format!("{} {}", axis.title(), values.join(", "))
    };
    if axes.is_empty() {
        let caption = caption_of(first);
        return match note {
            Some(note) => format!("{caption} {}.", plain::line(note)),
            None => caption,
        };
    }
    let scene = title(&first.scene);
    let what = match axes {
        [] => scene,
        [across] => format!("{scene} with {}", list(across)),
        [across, down @ ..] => {
            let down: Vec<String> = down.iter().map(|axis| list(axis)).collect();
            format!(
                "{scene}: from left to right {}; from top to bottom {}",
                list(across),
                down.join("; ")
            )
        }
    };
    let shared = shared_words(first, |name| {
        labels.tell(name) || axes.iter().any(|axis| axis.name == name)
    });
    let shared = (!shared.is_empty()).then(|| format!("In all: {shared}"));
    let parts = [Some(what), shared]
        .into_iter()
        .flatten()
        .chain(seen(first, "Each "))
        .chain(note.map(|note| plain::line(note).into_owned()));
    format!("{}.", parts.collect::<Vec<_>>().join(". "))
}

/// What tells a panel from the others; a value without effect in this one says so.
pub(in crate::viewer) fn difference<'a>(
    axes: impl Iterator<Item = &'a Axis>,
    (choice, spec): &(Choice, PictureSpec),
    labels: &Labels,
) -> String {
    let words = axes.filter_map(|axis| {
        let (_, value) = choice.iter().find(|(name, _)| *name == axis.name)?;
        Some(labels.words_of(axis, value, has_no_effect(spec, &axis.name)))
    });
    words.collect::<Vec<_>>().join(", ")
}

/// A scene's name on a picture: not its folder, for a picture that is drawn again where both were moved must be the same.
pub fn title(scene: &SceneSource) -> String {
    let address = scene.address();
    let name = match scene {
        SceneSource::File(path) => path
            .file_name()
            .map_or(address, |name| name.to_string_lossy().into_owned()),
        SceneSource::Gallery(_) => address.trim_start_matches("gallery:").to_owned(),
    };
    plain::short_line(&name, MAX_NAME)
}

/// The settings in words that differ from their defaults, but for those that are `told` elsewhere.
pub(in crate::viewer) fn shared_words(spec: &PictureSpec, told: impl Fn(&str) -> bool) -> String {
    let settings = Settings::of(spec.render, spec.dialect);
    let changed = picture::all().filter(|setting| !setting.is_default(&settings) && !told(setting.option));
    changed
        .map(|setting| setting.words(&settings))
        .collect::<Vec<_>>()
        .join(", ")
}

/// Size, view and insets in words; the view has no more digits than can be seen, for the record has them all.
fn seen(spec: &PictureSpec, each: &str) -> Vec<String> {
    let [width, height] = spec.size;
    let mut parts = vec![format!(
        "{each}{width} \u{d7} {height} pixels, view {}",
        spec.view.rounded()
    )];
    for inset in &spec.insets {
        let [region, factor] = [inset.region, inset.magnification];
        parts.push(format!(
            "Inset: {region} \u{d7} {region} pixels around {}, {factor}\u{d7}",
            inset.at.words()
        ));
    }
    parts
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::geometry::View;
    use crate::raster::{PixelCoverage, SamplePattern};
    use crate::render::RenderSettings;
    use crate::scene::DialectChoice;
    use crate::viewer::export::sheet::axes::Axis;
    use crate::viewer::settings::picture::SettingChange;

    #[test]
    fn conditions_tell_what_differs_from_the_defaults() {
        let mut spec = PictureSpec {
            scene: SceneSource::from_address(Path::new("gallery:basic/test4.svg")),
            size: [200, 160],
            view: View::Default,
            render: RenderSettings::default(),
            dialect: DialectChoice::default(),
            insets: Vec::new(),
            legend: false,
        };
        let said = "Sample rate 1. 200 \u{d7} 160 pixels, view default.";
        assert_eq!(conditions_of(&spec), said, "nothing but the rate, whatever that is");
        spec.render.pattern = SamplePattern::Sobol;
        let said = "Sample rate 1, pattern sobol. 200 \u{d7} 160 pixels, view default.";
        assert_eq!(conditions_of(&spec), said, "a setting");
        spec.render.coverage = PixelCoverage::Exact;
        let said = "Coverage exact. 200 \u{d7} 160 pixels, view default.";
        assert_eq!(conditions_of(&spec), said, "where no sample lies, no pattern is told");
    }

    #[test]
    fn settings_have_the_same_names_everywhere() {
        let mut settings = Settings::default();
        for (option, value) in [
            ("texture-wrap", "repeat"),
            ("lod-bias", "1.5"),
            ("resolve-filter", "gaussian"),
        ] {
            let change = SettingChange::of(option, value).expect("a value");
            assert!(change.apply(&mut settings).is_none(), "{option}");
        }
        let spec = PictureSpec {
            scene: SceneSource::from_address(Path::new("gallery:basic/test4.svg")),
            size: [200, 160],
            view: View::Default,
            render: settings.render,
            dialect: settings.dialect,
            insets: Vec::new(),
            legend: false,
        };
        let words = shared_words(&spec, |_| false);
        for setting in picture::all().filter(|setting| !setting.is_default(&settings)) {
            let own = setting.words(&settings);
            assert!(words.contains(&own), "{words} has no {own}");
            let axis = Axis::of(setting.option, &setting.value(&settings)).expect("a value");
            assert!(
                own.starts_with(&axis.title()),
                "{own} is called {} on sheets",
                axis.title()
            );
        }
    }
}
