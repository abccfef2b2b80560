//! The rules of first drafts: the pinholes that they leave are there to be seen, and told truly.

use rasterscope::geometry::View;
use rasterscope::inspect::{Setting, Verdict};
use rasterscope::raster::Framebuffer;
use rasterscope::render::RenderSettings;
use rasterscope::rules::Rules;
use rasterscope::scene::{self, NoResources, ReadOptions, Scene};

use crate::support::explaining::{advised, advised_by_default, explained};
use crate::support::scenes::{at_rate, drawn, gallery_scene};

fn picture(scene: &Scene, size: [u32; 2], settings: &RenderSettings) -> Framebuffer {
    drawn(scene, &View::Default.transform(scene.canvas, size), settings, size)
}

fn by(rules: Rules) -> RenderSettings {
    RenderSettings { rules, ..at_rate(1) }
}

/// The pixels that two pictures show differently.
fn different(a: &Framebuffer, b: &Framebuffer) -> Vec<[u32; 2]> {
    let pixels = a.pixels().iter().zip(b.pixels()).zip(0..);
    pixels
        .filter(|((a, b), _)| a != b)
        .map(|(_, i)| [i % a.width(), i / a.width()])
        .collect()
}

#[test]
fn float_rules_show_pinholes_in_the_windows_first_size_and_the_standard_rules_close_them() {
    let (scene, size) = (gallery_scene("basic/test4.svg"), [1280, 800]);
    let [float, standard] = [Rules::Float, Rules::Standard].map(|rules| picture(&scene, size, &by(rules)));
    let holes = different(&float, &standard);
    assert!(holes.len() > 300, "{} pixels differ", holes.len());
    let mut told = 0;
    for pixel in holes.iter().step_by(7) {
        let found = explained(&scene, &by(Rules::Float), size, *pixel);
        if let [hole] = &found.pinholes[..] {
            told += 1;
            let open = |verdict| matches!(verdict, Verdict::TieUndecided | Verdict::Outside);
            assert!(hole.edges.iter().any(|edge| open(edge.verdict)), "{hole:?}");
            assert!(found.hints()[0].contains("a pinhole"), "{:?}", found.hints());
            assert!(found.hints()[0].contains("standard rules"), "{:?}", found.hints());
        }
        let cured = explained(&scene, &by(Rules::Standard), size, *pixel);
        assert!(cured.pinholes.is_empty() && !cured.hints().concat().contains("pinhole"));
    }
    // Where 32 bits give a sample to a neighbour, nothing is open.
    assert!(told * 7 > holes.len() * 3 / 4, "{told} of a seventh of {}", holes.len());
}

/// More samples do not close a pinhole: the truth has none, and the standard rules are the first advice.
#[test]
fn float_rules_are_measured_against_a_truth_without_pinholes() {
    let scene = gallery_scene("basic/test4.svg");
    let mut checked = 0;
    for size in [[1280, 800], [1366, 768]] {
        let [float, standard] = [Rules::Float, Rules::Standard].map(|rules| picture(&scene, size, &by(rules)));
        for pixel in different(&float, &standard).iter().step_by(17) {
            let [found, cured] =
                [Rules::Float, Rules::Standard].map(|rules| advised_by_default(&scene, &by(rules), size, *pixel));
            let [truth, own] = [found.truth.unwrap(), cured.truth.unwrap()];
            assert_eq!(truth.color, own.color, "one truth at {pixel:?}");
            let first = truth.cures.first();
            let gain = truth.distance - own.distance;
            let of_rules = truth.cures.iter().find(|cure| cure.setting == Setting::Rules);
            assert!(gain <= 1.0 || of_rules.is_some() || first.is_some_and(|cure| cure.nearer > gain));
            // Where one rule closes the hole to within rounding, nothing stands before it.
            if own.distance <= 1.0 && truth.distance > 2.0 {
                checked += 1;
                assert_eq!(
                    first.map(|cure| cure.setting),
                    Some(Setting::Rules),
                    "{pixel:?}: {truth:?}"
                );
            }
        }
    }
    assert!(checked > 10, "{checked} pixels");
}

#[test]
fn float_rules_leave_the_lines_of_the_colour_wheel_to_nobody() {
    let (scene, size) = (gallery_scene("basic/test7.svg"), [801, 801]);
    let [float, standard] = [Rules::Float, Rules::Standard].map(|rules| picture(&scene, size, &by(rules)));
    let white = |frame: &Framebuffer, x: u32, y: u32| frame.pixels()[(y * 801 + x) as usize] == 0xFFFF_FFFF;
    // In the middle the wheel itself is white.
    for at in (190..395).chain(406..610) {
        assert!(white(&float, 400, at) && white(&float, at, 400), "a hole at {at}");
        assert!(!white(&standard, 400, at) && !white(&standard, at, 400), "none at {at}");
    }
    let found = explained(&scene, &by(Rules::Float), size, [400, 380]);
    let [hole] = &found.pinholes[..] else {
        panic!("one sample, one hole: {found:?}");
    };
    let ties = hole.edges.iter().filter(|edge| edge.verdict == Verdict::TieUndecided);
    assert_eq!(
        ties.map(|edge| (edge.value, edge.float)).collect::<Vec<_>>(),
        [(0, Some(0.0))]
    );
    let text = found.text(rasterscope::inspect::Detail::Telling);
    assert!(text.contains("no rule says whose it is, so nobody's"), "{text}");
    assert!(
        text.contains("edge function 0 in 32-bit floats") || text.contains("0 in 32-bit floats"),
        "{text}"
    );
    assert!(
        found.missed.iter().all(|missed| missed.primitive != hole.primitive),
        "it is not missed"
    );
}

#[test]
fn float_rules_leave_whole_frames_alike_however_they_are_drawn() {
    let (scene, size) = (gallery_scene("basic/test4.svg"), [203, 151]);
    for samples in [1, 4, 16] {
        let settings = RenderSettings {
            rules: Rules::Float,
            ..at_rate(samples)
        };
        let draw = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| picture(&scene, size, &settings))
        };
        assert!(draw(1) == draw(3), "rate {samples}");
    }
}

/// A sheet of glass hides no hole, and a board does.
#[test]
fn float_rules_pinholes_are_told_below_what_shines_through() {
    let halves = r##"<polygon points="1,2 9,2 9,10" fill="#FF0000"/><polygon points="1,2 9,10 1,10" fill="#FF0000"/>"##;
    let sheet =
        |opacity| format!(r##"<rect x="0" y="1" width="11" height="4" fill="#0000FF" fill-opacity="{opacity}"/>"##);
    for (above, is_told) in [(String::new(), true), (sheet("0.5"), true), (sheet("1"), false)] {
        let document = format!(
            r##"<svg width="12" height="12"><rect x="0" y="0" width="12" height="12" fill="#FFFFFF"/>{halves}{above}</svg>"##
        );
        let scene = scene::read(document.as_bytes(), "holes.svg", ReadOptions::default(), &NoResources).unwrap();
        let found = advised(&scene, &by(Rules::Float), [12, 12], [3, 4]);
        assert_eq!(found.pinholes.len(), usize::from(is_told), "{above}");
        assert_eq!(found.hints().concat().contains("in a pinhole"), is_told, "{above}");
    }
}
