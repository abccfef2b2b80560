//! Settings that are said to have no effect have none.

use arbtest::arbitrary::{Result, Unstructured};
use rasterscope::geometry::{View, ViewTransform};
use rasterscope::scene::{DialectChoice, ReadOptions, Scene, read};
use rasterscope::viewer::gallery::{SCENES, Textures};
use rasterscope::viewer::{PictureSetting, Settings, picture};

use crate::support::scenes::drawn;

const SIZE: [u32; 2] = [14, 11];
/// Textures, magnified and minified; gradients, a tile of a pattern and edges.
const OF_SCENES: [&str; 4] = ["07_checker_floor.svg", "texmap/test1.svg", "", "plain"];

/// Settings that need few others to have an effect, and to have none: they are looked for until both were met, which takes longer
/// on slow machines.
const SOON: [&str; 7] = [
    "sample-rate",
    "pattern",
    "coverage",
    "resolve-filter",
    "post-process",
    "lod-bias",
    "anisotropy",
];

fn scenes() -> Vec<(Scene, ViewTransform)> {
    let own = r##"<svg xmlns="http://www.w3.org/2000/svg" width="28" height="22">
        <linearGradient id="g"><stop stop-color="#f00"/><stop offset="1" stop-color="#0f0" stop-opacity=".4"/></linearGradient>
        <pattern id="p" width="3" height="3" patternUnits="userSpaceOnUse"><circle cx="1.4" cy="1.6" r="1.2" fill="#03c"/></pattern>
        <rect x="1.3" y=".7" width="15" height="12.4" fill="url(#g)" transform="rotate(7)"/>
        <path d="M3 20L27 1 25 21z" fill="url(#p)" stroke="#505" stroke-width=".8"/></svg>"##;
    let scenes = OF_SCENES.map(|path| {
        let known = || {
            let known = SCENES.iter().find(|scene| scene.name.contains(path));
            known.expect("a scene").document
        };
        let plain = own.replace("url(#p)", "#888");
        let plain = plain.replace("<pattern", "<!--").replace("</pattern>", "-->");
        let document = match path {
            "" => own,
            "plain" => plain.as_str(),
            _ => known(),
        };
        let options = ReadOptions {
            dialect: DialectChoice::Auto,
        };
        read(document.as_bytes(), "scene.svg", options, &Textures).expect("a scene")
    });
    let with_view = |scene: Scene| {
        let view = View::Canvas.transform(scene.canvas, SIZE);
        (scene, view)
    };
    scenes.into_iter().map(with_view).collect()
}

/// Sets `setting` to a value, as a user does.
fn set(settings: &mut Settings, setting: &'static PictureSetting, value: &str) {
    let change = setting.to(value).expect("one of its values");
    change.apply(settings);
}

fn any(u: &mut Unstructured<'_>, all: &[&'static PictureSetting]) -> Result<Settings> {
    let mut settings = Settings::default();
    for _ in 0..u.int_in_range(0..=6)? {
        let setting = *u.choose(all)?;
        let value = *u.choose(&setting.some_values())?;
        set(&mut settings, setting, value);
    }
    Ok(settings)
}

#[test]
fn settings_without_effect_move_no_byte() {
    let scenes = scenes();
    let all: Vec<&'static PictureSetting> = picture::all().filter(|setting| setting.option != "dialect").collect();
    let pixels = |(scene, view): &(Scene, ViewTransform), settings: &Settings| {
        drawn(scene, view, &settings.render, SIZE).pixels().to_vec()
    };
    let (mut idle, mut counts) = (Vec::new(), Vec::new());
    for _ in 0..20 {
        arbtest::arbtest(|u| {
            let settings = any(u, &all)?;
            let of_scene = u.choose(&scenes)?;
            let before = pixels(of_scene, &settings);
            for setting in &all {
                let others = setting.some_values().into_iter().map(|value| {
                    let mut other = settings;
                    set(&mut other, setting, value);
                    other
                });
                // Another pattern may change the rate with it.
                let mut others = others.filter(|other| {
                    setting.option == "sample-rate" || other.render.sample_rate == settings.render.sample_rate
                });
                if let Some(why) = setting.idle(&settings, Some(&of_scene.0)) {
                    idle.push(setting.option);
                    for other in others {
                        assert!(
                            pixels(of_scene, &other) == before,
                            "{} {} has an effect beside {:?}, though {why}",
                            setting.option,
                            setting.value(&other),
                            settings.render
                        );
                    }
                } else if !counts.contains(&setting.option) && others.any(|other| pixels(of_scene, &other) != before) {
                    counts.push(setting.option);
                }
            }
            Ok(())
        })
        .budget_ms(1500);
        if SOON
            .iter()
            .all(|option| idle.contains(option) && counts.contains(option))
        {
            return;
        }
    }
    panic!("{SOON:?}: without effect are {idle:?}, with one {counts:?}");
}
