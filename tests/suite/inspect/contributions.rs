//! Which pixels a texel feeds: exactly those whose explanations read it.

use std::collections::HashMap;

use rasterscope::geometry::View as SceneView;
use rasterscope::inspect::{Contributions, Explanation, Interpolated, Question, TexelPlace, View};
use rasterscope::raster::{Region, SampleRate};
use rasterscope::render::{RenderSettings, Subject};
use rasterscope::rules::Rules;
use rasterscope::scene::{self, DialectChoice, ReadOptions, Scene};
use rasterscope::texture::{Anisotropy, LevelSampling, PixelSampling};
use rasterscope::viewer::gallery::{SCENES, Textures};
use rasterscope::viewer::{Command, InspectorCommand, ViewCommand};

use crate::support::session::Session;

/// A texture of 4 x 4 texels three times: over itself, shining through, and once hidden for the most part.
const LAYERS: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" width="20" height="20">
  <image href="data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAIAAAAmkwkpAAAANUlEQVR42h3JMREAMAzDQC2FUSJB4a1ECsgIgs0QeummewEIDOGntK2KzqBc9o17tnKcTtYDWFcSFZnoz+AAAAAASUVORK5CYII=" width="20" height="20"/>
  <image opacity="0.5" href="data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAQAAAAECAIAAAAmkwkpAAAANUlEQVR42h3JMREAMAzDQC2FUSJB4a1ECsgIgs0QeummewEIDOGntK2KzqBc9o17tnKcTtYDWFcSFZnoz+AAAAAASUVORK5CYII=" x="3" y="3" width="9" height="9"/>
  <rect x="8" y="6" width="9" height="9" fill="#336699"/>
</svg>"##;

fn read(name: &str, document: &str) -> Scene {
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    scene::read(document.as_bytes(), name, options, &Textures).unwrap()
}

/// The same from the explanation of every pixel.
fn from_explanations(subject: &Subject<'_>, size: [u32; 2]) -> HashMap<TexelPlace, HashMap<[u32; 2], f64>> {
    let mut found: HashMap<TexelPlace, HashMap<[u32; 2], f64>> = HashMap::new();
    for pixel in (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| [x, y])) {
        let question = Question {
            subject: *subject,
            file: "scene.svg",
            size,
            pixel,
        };
        let explanation = Explanation::new(&question).unwrap();
        for paint in &explanation.paints {
            for fragment in paint.fragments.iter().filter(|fragment| fragment.seen) {
                let Some(View::Triangle {
                    value: Interpolated::Texture { texels, .. },
                    ..
                }) = paint.views.get(fragment.sample)
                else {
                    continue;
                };
                for texel in texels {
                    let place = TexelPlace {
                        texture: paint.texture.as_ref().unwrap().index,
                        level: texel.level,
                        at: texel.at,
                    };
                    *found.entry(place).or_default().entry(pixel).or_default() +=
                        texel.weight / explanation.samples.len() as f64;
                }
            }
        }
    }
    found
}

#[test]
fn feeds_are_what_the_explanations_of_all_pixels_read() {
    let textured = |name: &str| SCENES.iter().find(|scene| scene.name == name).unwrap().document;
    let documents = [
        ("layers.svg", LAYERS),
        ("texmap/test1.svg", textured("texmap/test1.svg")),
        ("study/07_checker_floor.svg", textured("study/07_checker_floor.svg")),
        ("study/09_mip_lanes.svg", textured("study/09_mip_lanes.svg")),
    ];
    let plain = RenderSettings::default();
    let mixed = RenderSettings {
        sample_rate: SampleRate::new(4).unwrap(),
        pixel_sampling: PixelSampling::Bilinear,
        level_sampling: LevelSampling::Linear,
        anisotropy: Anisotropy::new(4).unwrap(),
        ..plain
    };
    let course = RenderSettings {
        rules: Rules::Course,
        anisotropy: Anisotropy::OFF,
        ..mixed
    };
    let size = [17, 14];
    for (name, document) in documents {
        let scene = read(name, document);
        for settings in [plain, mixed, course] {
            let view = SceneView::Canvas.transform(scene.canvas, size);
            let subject = Subject {
                scene: &scene,
                view: &view,
                settings: &settings,
            };
            let feeds = Contributions::around(&subject, size, [9, 7]).unwrap();
            assert_eq!(
                feeds.searched,
                Region::of_size(size),
                "{name}: small pictures are searched wholly"
            );
            let expected = from_explanations(&subject, size);
            assert!(!expected.is_empty(), "{name}: it reads texels");
            assert_eq!(
                feeds.texels().count(),
                expected.len(),
                "{name}: all texels that are read"
            );
            for (texel, pixels) in &expected {
                let fed = feeds.of(*texel);
                assert_eq!(fed.len(), pixels.len(), "{name}: {texel:?} feeds {fed:?}");
                for fed in fed {
                    let weight = pixels.get(&fed.pixel).copied().unwrap_or_default();
                    assert!(
                        (fed.weight - weight).abs() < 1e-12,
                        "{name}: {texel:?}: {fed:?}, not {weight}"
                    );
                }
            }
        }
    }
}

#[test]
fn feeds_end_where_the_work_becomes_too_much() {
    let floor = SCENES
        .iter()
        .find(|scene| scene.name == "study/07_checker_floor.svg")
        .unwrap();
    let scene = read(floor.name, floor.document);
    let size = [400, 300];
    let view = SceneView::Default.transform(scene.canvas, size);
    let searched = |rate, taps, pixel| {
        let settings = RenderSettings {
            sample_rate: SampleRate::new(rate).unwrap(),
            pixel_sampling: PixelSampling::Bilinear,
            level_sampling: LevelSampling::Linear,
            anisotropy: Anisotropy::new(taps).unwrap(),
            ..RenderSettings::default()
        };
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        Contributions::around(&subject, size, pixel).map(|feeds| feeds.searched)
    };
    let cheap = searched(1, 1, [200, 200]).unwrap();
    assert!(cheap.width == cheap.height && cheap.width > 60, "far: {cheap:?}");
    let corner = searched(1, 1, [2, 299]).unwrap();
    assert_eq!([corner.x, corner.bottom()], [0, 300], "inside the frame");
    let dear = searched(64, 16, [200, 180]).unwrap();
    assert!(
        (7..cheap.width).contains(&dear.width),
        "less far, but the neighbours always: {dear:?}"
    );
    assert_eq!(searched(1, 1, [400, 0]), None, "outside the frame");
}

#[test]
fn feeds_are_found_for_the_texel_that_is_pointed_at() {
    let mut session = Session::open(&[LAYERS], [60, 40]);
    session.run(Command::Inspector(InspectorCommand::Pin([20, 12])));
    let texel = session
        .viewer
        .inspector()
        .explanation()
        .unwrap()
        .paints
        .iter()
        .rev()
        .find_map(|paint| {
            let texture = paint.texture.as_ref()?;
            match &paint.views[0] {
                View::Triangle {
                    value: Interpolated::Texture { texels, .. },
                    ..
                } => Some(TexelPlace {
                    texture: texture.index,
                    level: texels[0].level,
                    at: texels[0].at,
                }),
                _ => None,
            }
        });
    assert!(texel.is_some(), "the pixel shows a texture");
    assert_eq!(
        session.viewer.inspector().contributions_region(),
        None,
        "nothing is looked for unasked"
    );
    session.run(Command::Inspector(InspectorCommand::PointAtTexel(texel)));
    let lit: Vec<[u32; 2]> = session
        .viewer
        .inspector()
        .contributed_pixels()
        .iter()
        .map(|fed| fed.pixel)
        .collect();
    assert!(
        lit.contains(&[20, 12]) && lit.len() > 1,
        "the pinned pixel and others: {lit:?}"
    );
    session.run(Command::View(ViewCommand::PanBy {
        by: glam::dvec2(3.0, 0.0),
    }));
    let moved: Vec<[u32; 2]> = session
        .viewer
        .inspector()
        .contributed_pixels()
        .iter()
        .map(|fed| fed.pixel)
        .collect();
    assert!(moved.contains(&[23, 12]), "they follow the picture: {moved:?}");
    session.run(Command::Inspector(InspectorCommand::Unpin));
    assert!(
        session.viewer.inspector().contributed_pixels().is_empty(),
        "without an explanation nothing is lit"
    );
    assert_eq!(session.viewer.inspector().pointed_texel(), None, "nor pointed at");
}
