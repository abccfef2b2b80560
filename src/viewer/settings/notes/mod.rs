//! What each named value of a setting does and costs, and a scene where it wins and one where it loses.
//!
//! The tool tips of the panel's lists and the page `values` of the reference are made of these rows.

mod samples;
mod textures;

use super::picture::PictureSetting;

/// A value of a setting.
#[derive(Clone, Copy, Debug)]
pub struct ValueNote {
    /// The setting, by its option.
    pub setting: &'static str,
    /// The value.
    pub value: &'static str,
    /// What it does: a sentence without its full stop.
    pub does: &'static str,
    /// What it costs, to go behind "costs".
    pub costs: &'static str,
    /// How near it comes to the truth beside another value, where that can be measured.
    pub compared: Option<Comparison>,
}

/// Where a value comes nearer to the truth than what people would take instead, and where it does not.
#[derive(Clone, Copy, Debug)]
pub struct Comparison {
    /// Where the value is nearer to its own truth than the other one is to that one's.
    pub wins: Study,
    /// Where it is farther from the other one's truth than that is itself.
    pub loses: Study,
}

/// A scene of the gallery, and the settings of two pictures of it.
#[derive(Clone, Copy, Debug)]
pub struct Study {
    /// Its name without folder and ending, such as `01_zone_plate`: all lie in `study`.
    pub scene: &'static str,
    /// What both pictures share, as a list of settings; empty where all others are defaults.
    pub settings: &'static str,
    /// What is taken instead of the value, likewise.
    pub instead: &'static str,
}

impl ValueNote {
    const fn new(setting: &'static str, value: &'static str, does: &'static str, costs: &'static str) -> Self {
        Self {
            setting,
            value,
            does,
            costs,
            compared: None,
        }
    }

    /// The same with scenes: of each the name, the shared settings, and what is taken instead.
    const fn beside(self, wins: [&'static str; 3], loses: [&'static str; 3]) -> Self {
        Self {
            compared: Some(Comparison {
                wins: Study::new(wins),
                loses: Study::new(loses),
            }),
            ..self
        }
    }

    /// The tool tip of the value.
    pub fn tip(&self) -> String {
        let does = self.does.replace('`', "");
        let studies = self.compared.map_or_else(String::new, |Comparison { wins, loses }| {
            format!("\nWins on study/{}, loses on study/{}.", wins.scene, loses.scene)
        });
        format!("{does}.\nCosts {}.{studies}", self.costs)
    }
}

impl Study {
    const fn new([scene, settings, instead]: [&'static str; 3]) -> Self {
        Self {
            scene,
            settings,
            instead,
        }
    }
}

/// All of them: of each setting in the order of its values.
pub fn all() -> impl Iterator<Item = &'static ValueNote> {
    [samples::PATTERNS, samples::PIXELS, textures::NOTES]
        .into_iter()
        .flatten()
}

impl PictureSetting {
    /// What one of its named values does and costs.
    pub fn note(&self, value: &str) -> Option<&'static ValueNote> {
        all().find(|note| note.setting == self.option && note.value == value)
    }
}
