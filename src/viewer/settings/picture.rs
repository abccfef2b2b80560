//! Settings of a picture by their names.
//!
//! Keys, palette, panel, command line, records, lessons, captions and the axes of sheets know settings only by their rows: a
//! value is its text, such as `16` or `bilinear`, in all of them.

pub(in crate::viewer) use super::row::NO_EFFECT;
pub use super::row::{
    About, Control, PanelRow, PictureSetting, SettingChange, SettingCommand, Told, Values, reads_textures,
};

use std::path::Path;

use super::table::picture_settings;
use super::{Settings, values};
use crate::scene::Scene;

/// The settings, in the order of menus and of the command line.
pub fn all() -> impl Iterator<Item = &'static PictureSetting> {
    picture_settings()
}

/// The setting with the option `name`.
pub fn find(name: &str) -> Option<&'static PictureSetting> {
    all().find(|setting| setting.option == name)
}

/// The option of the setting that a person calls `name`: that itself, or the word by which scripts and the palette set it, such
/// as `rate`; else `name` as it is.
pub(in crate::viewer) fn option_meant(name: &str) -> &str {
    let sets = |setting: &&PictureSetting| {
        let mut commands = setting.commands.iter();
        commands.any(|command| command.takes_value && command.id == name)
    };
    find(name)
        .or_else(|| all().find(sets))
        .map_or(name, |setting| setting.option)
}

/// As [`find`].
///
/// # Errors
/// One line that lists the settings there are.
pub fn known(name: &str) -> Result<&'static PictureSetting, String> {
    find(name).ok_or_else(|| {
        let names: Vec<&str> = all().map(|setting| setting.option).collect();
        format!("there is no setting {name}; there are {}", names.join(", "))
    })
}

/// The settings about this that are not at their defaults and that are not told always, in few words each, such as `pattern
/// halton`; none that has no effect on a picture of this scene.
pub fn changed_words(settings: &Settings, about: About, scene: Option<&Scene>) -> Vec<String> {
    let told = told(Told::IfChanged, about).filter(|setting| !setting.is_default(settings));
    let told = told.filter(|setting| setting.idle(settings, scene).is_none());
    told.map(|setting| setting.words(settings)).collect()
}

/// What false colours a picture has, such as `visualise overdraw`; `None` where they are those of its scene.
pub fn false_colors(settings: &Settings) -> Option<String> {
    let setting = find("visualise").filter(|setting| !setting.is_default(settings))?;
    Some(setting.words(settings))
}

/// The same after those that are told always.
pub fn told_words(settings: &Settings, about: About, scene: Option<&Scene>) -> Vec<String> {
    let always = told(Told::Always, about).filter(|setting| setting.idle(settings, scene).is_none());
    let always = always.map(|setting| setting.words(settings));
    always.chain(changed_words(settings, about, scene)).collect()
}

/// What a window's title tells.
pub(in crate::viewer) fn title_words(settings: &Settings, scene: Option<&Scene>) -> Vec<String> {
    let all = [About::Samples, About::Textures].into_iter();
    all.flat_map(|about| told_words(settings, about, scene)).collect()
}

fn told(told: Told, about: About) -> impl Iterator<Item = &'static PictureSetting> {
    all().filter(move |setting| (setting.told, setting.about) == (told, about))
}

/// The settings of sampling and textures, without how documents are read.
pub fn sampling() -> impl Iterator<Item = &'static PictureSetting> {
    all().filter(|setting| setting.about != About::Document)
}

/// Brings every setting of sampling and textures back to its default; how documents are read stays.
pub(in crate::viewer) fn reset(settings: &mut Settings) {
    for setting in sampling() {
        setting.set(settings, &setting.default_value());
    }
}

/// Whether every setting of sampling and textures has its default.
pub fn are_defaults(settings: &Settings) -> bool {
    sampling().all(|setting| setting.is_default(settings))
}

/// The changes that settings such as `sample-rate 16, dialect svg` ask for.
///
/// # Errors
/// One line for the first that is none.
pub(in crate::viewer) fn changes(text: &str) -> Result<Vec<SettingChange>, String> {
    let one = |part: &str| match part.trim().split_once(|c: char| c.is_whitespace() || c == '=') {
        Some((name, value)) => {
            SettingChange::of(option_meant(name), value).map_err(|problem| format!("{name}: {problem}"))
        }
        None => Err(format!(
            "\"{}\" is not a setting with its value, such as sample-rate 16",
            part.trim()
        )),
    };
    text.split(',').map(one).collect()
}

/// A text for `changes` with what lies in files in place of their names, from `folder` where a name is not
/// absolute. Only what a user typed or opened comes here.
///
/// # Errors
/// One line where a file holds no value of its setting.
pub fn read_files(text: &str, folder: Option<&Path>) -> Result<String, String> {
    let one = |part: &str| match part.trim().split_once(|c: char| c.is_whitespace() || c == '=') {
        Some((name, value)) => match find(option_meant(name)).filter(|setting| setting.reads_files()) {
            Some(setting) => Ok(format!("{name} {}", setting.read(value.trim(), folder)?)),
            None => Ok(part.to_owned()),
        },
        None => Ok(part.to_owned()),
    };
    let parts: Result<Vec<String>, String> = values::list(text).into_iter().map(one).collect();
    Ok(parts?.join(","))
}

/// What `changes` finds; `None` where one of them is none.
pub(in crate::viewer) fn parse_changes(text: &str) -> Option<Vec<SettingChange>> {
    changes(text).ok()
}

/// Whether a text is meant to be settings: it starts with an option's name and a blank, or is all settings under their other
/// names. A file may be called like those.
pub(in crate::viewer) fn are_meant(text: &str) -> bool {
    let name = text.trim_start().split_once(char::is_whitespace);
    name.is_some_and(|(name, _)| find(name).is_some() || (find(option_meant(name)).is_some() && changes(text).is_ok()))
}

/// Changes the settings by all of these; tells in one line what else had to change.
///
/// Whether a pattern takes a rate is seen once both are there, whichever was named first.
pub fn apply_all(changes: &[SettingChange], settings: &mut Settings) -> Option<String> {
    let mut apply = || changes.iter().filter_map(|change| change.apply(settings)).last();
    apply();
    apply()
}

impl SettingChange {
    /// The setting `option` to this value.
    ///
    /// # Errors
    /// One line where there is no such setting or no such value.
    pub fn of(option: &str, value: &str) -> Result<Self, String> {
        known(option)?.to(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::SamplePattern;
    use crate::viewer::commands;
    use crate::viewer::settings::patterns;

    fn after(option: &str, value: &str) -> Settings {
        let mut settings = Settings::default();
        SettingChange::of(option, value).expect(option).apply(&mut settings);
        settings
    }

    #[test]
    fn every_setting_takes_what_it_gives() {
        for setting in all() {
            assert_eq!(find(setting.option), Some(setting), "{setting:?} stands once");
            for value in setting.some_values() {
                let settings = after(setting.option, value);
                assert_eq!(setting.value(&settings), value, "{setting:?}");
                let others = all().filter(|other| *other != setting);
                for other in others {
                    assert!(other.is_default(&settings), "{setting:?} leaves {other:?} alone");
                }
            }
            assert!(setting.some_values().len() > 1, "{setting:?} can be an axis");
            let refused = setting.to("no such value").expect_err("no value");
            assert!(refused.contains(&setting.form()), "{refused}");
        }
    }

    #[test]
    fn steps_reach_every_name_and_lead_back() {
        for setting in all() {
            let names = setting.names();
            let mut settings = Settings::default();
            let mut seen: Vec<String> = Vec::new();
            for _ in &names {
                seen.push(setting.value(&settings));
                setting.step(1.0).apply(&mut settings);
            }
            assert_eq!(seen, names, "{setting:?} from its first name on");
            assert!(setting.is_default(&settings), "{setting:?} ends where it began");
            let Some(last) = names.last() else { continue };
            setting.step(-1.0).apply(&mut settings);
            assert_eq!(setting.value(&settings), *last, "{setting:?} back");
        }
    }

    #[test]
    fn rates_that_a_pattern_refuses_become_the_nearest() {
        let mut settings = after("pattern", "r2");
        let five = SettingChange::of("sample-rate", "5").expect("a rate");
        assert_eq!(five.apply(&mut settings), None, "as asked");
        assert_eq!(settings.render.sample_rate.samples(), 5, "any number");
        let grid = SettingChange::of("pattern", "grid").expect("a pattern");
        assert!(grid.apply(&mut settings).is_some(), "the user is told");
        assert_eq!(settings.render.sample_rate.samples(), 4, "the nearest square");
    }

    #[test]
    fn tip_of_the_seed_names_all_patterns_without_chance() {
        let tip = known("seed").expect("a setting").commands[0].more;
        let words: Vec<&str> = tip.split([' ', ',', ':']).collect();
        for pattern in SamplePattern::ALL {
            let is_named = words.contains(&pattern.name());
            assert_eq!(is_named, !pattern.is_seeded(), "{} in: {tip}", pattern.name());
        }
        for pattern in patterns::shipped() {
            let is_named = words.iter().any(|word| pattern.name().starts_with(&format!("{word}-")));
            assert!(is_named && !pattern.is_seeded(), "{} in: {tip}", pattern.name());
        }
    }

    #[test]
    fn tip_of_the_truth_tells_what_is_not_that_of_the_picture() {
        let tip = commands::find("truth").expect("a command").tip();
        let truth = Settings::default().render.truth();
        assert!(tip.contains(&truth.sample_rate.samples().to_string()), "{tip}");
        assert!(tip.contains(truth.pattern.name()), "{tip}");
        let mut float = after("rules", "float").render;
        assert_ne!(float.truth().rules, float.rules, "they give way");
        float.rules = float.truth().rules;
        assert!(tip.contains("float") && tip.contains(float.rules.name()), "{tip}");
    }

    #[test]
    fn words_are_short_and_only_where_something_differs() {
        assert_eq!(
            changed_words(&Settings::default(), About::Samples, None),
            [""; 0],
            "nothing"
        );
        assert_eq!(
            changed_words(&after("pattern", "halton"), About::Samples, None),
            ["pattern halton"]
        );
        assert_eq!(
            told_words(&Settings::default(), About::Samples, None),
            ["sample rate 1"]
        );
    }

    #[test]
    fn words_tell_what_decides_the_picture() {
        let after = |changes: &str| {
            let mut settings = Settings::default();
            apply_all(&super::changes(changes).expect("settings"), &mut settings);
            settings
        };
        let biased = after("level-sampling linear, lod-bias 0.5");
        assert_eq!(changed_words(&biased, About::Textures, None), ["level bias +0.5"]);
        let zero = after("lod-bias 0.5");
        assert_eq!(
            changed_words(&zero, About::Textures, None),
            [""; 0],
            "only level zero is read"
        );
        let bias = known("lod-bias").expect("a setting");
        assert_eq!(bias.candid_words(&zero), "level bias +0.5 (no effect)", "asked for");
        assert_eq!(bias.candid_words(&biased), "level bias +0.5", "it has one");
        let exact = after("coverage exact, sample-rate 4, pattern sobol");
        assert_eq!(
            told_words(&exact, About::Samples, None),
            ["coverage exact"],
            "no samples"
        );
        let area = after("level-sampling ewa, anisotropy 4, lod-by area");
        assert_eq!(
            told_words(&area, About::Textures, None).len(),
            2,
            "pixel and level sampling alone"
        );
        let fill = "<svg xmlns='http://www.w3.org/2000/svg'/>";
        let options = crate::scene::ReadOptions::default();
        let plain = crate::scene::read(fill.as_bytes(), "plain.svg", options, &crate::viewer::gallery::Textures);
        let plain = plain.expect("a scene");
        assert_eq!(told_words(&area, About::Textures, Some(&plain)), [""; 0], "no texture");
    }

    #[test]
    fn false_colors_are_told() {
        assert_eq!(false_colors(&Settings::default()), None, "the scene's own");
        let words = false_colors(&after("visualise", "overdraw"));
        assert_eq!(words.as_deref(), Some("visualise overdraw"));
    }

    #[test]
    fn visualisations_by_old_names() {
        assert_eq!(
            after("visualise", "color"),
            after("visualise", "colour"),
            "as it was called once"
        );
    }
}
