//! What the reference says of values: each has a note, and wins and loses where the note says so, by the figures of its table.

use std::collections::{BTreeSet, HashMap};

use rasterscope::compare::Pair;
use rasterscope::geometry::View;
use rasterscope::raster::Framebuffer;
use rasterscope::render::RenderSettings;
use rasterscope::scene::Scene;
use rasterscope::viewer::{BoardEntry, Settings, Study, ValueNote, notes, picture};

use crate::support::golden::check_table;
use crate::support::scenes::{drawn, gallery_scene};

const START: &str = "<!-- values: measured, `BLESS=1 cargo test values` writes it anew -->\n";
const END: &str = "<!-- /values -->\n";
/// Pixels of a picture.
const SIZE: [u32; 2] = [512, 512];
/// What has no note: it decides what is shown, or how documents are read.
const OTHERS: [&str; 3] = ["visualise", "rules", "dialect"];

#[test]
fn every_named_value_says_what_it_does_and_costs() {
    let mut told: BTreeSet<_> = notes::all().map(|note| (note.setting, note.value)).collect();
    assert_eq!(told.len(), notes::all().count(), "one for each");
    for setting in picture::all().filter(|setting| !OTHERS.contains(&setting.option)) {
        let values = setting.offered(&Settings::default());
        for value in values.iter().filter(|_| !setting.names().is_empty()) {
            let note = setting.note(value).expect("a note for every value");
            assert!(told.remove(&(note.setting, note.value)), "{value}");
            assert!(note.does.starts_with(char::is_uppercase), "{value}: {}", note.does);
            assert!(note.costs.starts_with(char::is_lowercase), "{value}: {}", note.costs);
            assert!(
                ![note.does, note.costs].iter().any(|text| text.ends_with('.')),
                "{value}: no full stops"
            );
            let tip = note.tip();
            assert!(tip.contains(note.costs) && tip.len() < 300, "{value}: {tip}");
        }
    }
    assert!(told.is_empty(), "none without a value: {told:?}");
}

/// Scenes and pictures that are drawn already.
#[derive(Default)]
struct Gallery {
    scenes: HashMap<&'static str, Scene>,
    drawn: Vec<(&'static str, RenderSettings, Framebuffer)>,
}

impl Gallery {
    /// Where in `drawn` a picture stands.
    fn place(&mut self, name: &'static str, settings: &RenderSettings) -> usize {
        let known = |drawn: &(&str, RenderSettings, _)| drawn.0 == name && drawn.1 == *settings;
        if let Some(place) = self.drawn.iter().position(known) {
            return place;
        }
        let scene = self.scenes.entry(name);
        let scene = scene.or_insert_with(|| gallery_scene(&format!("study/{name}.svg")));
        let view = View::Default.transform(scene.canvas, SIZE);
        self.drawn.push((name, *settings, drawn(scene, &view, settings, SIZE)));
        self.drawn.len() - 1
    }

    /// How far a picture is from a truth, in levels.
    fn error(&mut self, scene: &'static str, settings: &RenderSettings, truth: &RenderSettings) -> f64 {
        let [own, truth] = [*settings, truth.truth()].map(|settings| self.place(scene, &settings));
        let pair = Pair::new(&self.drawn[own].2, &self.drawn[truth].2).expect("one size");
        pair.levels().rmse()
    }

    /// The errors of a value, and of what is taken instead: each from its own truth, or both from that of the latter.
    fn errors(&mut self, note: &ValueNote, study: Study, own: bool) -> [f64; 2] {
        let shared = BoardEntry::of(&Settings::default());
        let shared = if study.settings.is_empty() {
            shared
        } else {
            shared.with(study.settings).expect(study.settings)
        };
        let value = shared
            .with(&format!("{} {}", note.setting, note.value))
            .expect(note.value);
        let instead = shared.with(study.instead).expect(study.instead);
        let [value, instead] = [value.render, instead.render];
        let truth = if own { value } else { instead };
        [
            self.error(study.scene, &value, &truth),
            self.error(study.scene, &instead, &instead),
        ]
    }
}

/// A cell of the table.
fn cell(study: Study, [value, instead]: [f64; 2]) -> String {
    let settings = if study.settings.is_empty() {
        String::new()
    } else {
        format!(", {}", study.settings)
    };
    format!(
        "`{}`{settings}: {value:.2}; {}: {instead:.2}",
        study.scene, study.instead
    )
}

#[test]
fn values_win_and_lose_where_the_reference_says_so() {
    let mut gallery = Gallery::default();
    let mut lines = vec!["| value | does | costs | wins on | loses on |\n|---|---|---|---|---|\n".to_owned()];
    let mut wrong = Vec::new();
    for note in notes::all() {
        let [wins, loses] = match note.compared {
            None => [String::new(), String::new()],
            Some(compared) => {
                let errors = [
                    gallery.errors(note, compared.wins, true),
                    gallery.errors(note, compared.loses, false),
                ];
                if errors[0][0] > 0.95 * errors[0][1] || errors[1][0] < 1.02 * errors[1][1] {
                    wrong.push(format!("{} {}: {errors:.2?}", note.setting, note.value));
                }
                [cell(compared.wins, errors[0]), cell(compared.loses, errors[1])]
            }
        };
        let ValueNote {
            setting,
            value,
            does,
            costs,
            ..
        } = note;
        lines.push(format!(
            "| {setting} `{value}` | {does} | {costs} | {wins} | {loses} |\n"
        ));
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
    check_table("src/cli/help/values.md", [START, END], &lines.concat());
}
