//! Morphological antialiasing: against its definition, in parts and as a whole, where it wins and where it loses.

use std::sync::Mutex;

use rasterscope::color::{ResolveSpace, Rgba};
use rasterscope::geometry::View;
use rasterscope::post::{PostProcess, REACH, Values, smaa};
use rasterscope::raster::{Framebuffer, Region};
use rasterscope::render::{CancelToken, RenderSettings, Subject, draw_onto, draw_regions, refine};
use rasterscope::rules::Rules;
use rasterscope::viewer::gallery::SCENES;

use crate::support::scenes::{at_rate, drawn, gallery_scene, rmse};
use crate::support::smaa::Picture;

const SIZE: [u32; 2] = [200, 160];

fn smoothed(samples: u32) -> RenderSettings {
    RenderSettings {
        post_process: PostProcess::Smaa,
        ..at_rate(samples)
    }
}

#[test]
fn smaa_agrees_with_its_definition() {
    let mut changed = 0;
    // However slow the machine is.
    while changed < 500 {
        agrees(&mut changed);
    }
}

/// Compares random pictures, and counts the pixels that change.
fn agrees(changed: &mut usize) {
    arbtest::arbtest(|u| {
        const SIDE: usize = 40;
        // Runs of few colours, each row much like the one above: all patterns come, and long ones.
        let colors = [0xFF00_0000, 0xFFFF_FFFF, 0xFF40_4040, 0x80FF_FFFF, 0xFF30_8050_u32];
        let count = u.int_in_range(2..=colors.len())?;
        let mut pixels: Vec<u32> = Vec::new();
        for y in 0..SIDE {
            if y > 0 && u.ratio(3, 4)? {
                let shift = u.int_in_range(0..=2)?;
                pixels.extend(
                    (0..SIDE)
                        .map(|x| pixels[(y - 1) * SIDE + (x + SIDE - shift) % SIDE])
                        .collect::<Vec<_>>(),
                );
                continue;
            }
            while pixels.len() < (y + 1) * SIDE {
                let length = u.int_in_range(1..=20)?.min((y + 1) * SIDE - pixels.len());
                let color = colors[u.choose_index(count)?];
                pixels.extend(std::iter::repeat_n(color, length));
            }
        }
        let space = *u.choose(&ResolveSpace::ALL)?;
        let bytes = |pixel: u32| {
            let [a, r, g, b] = pixel.to_be_bytes();
            [r, g, b, a]
        };
        let picture = Picture {
            size: [40, 40],
            pixels: pixels.iter().copied().map(bytes).collect(),
        };
        let mut found = pixels.clone();
        let rules = Rules::Standard;
        smaa(&mut found, [40, 40], Values { space, rules });
        for (i, found) in (0..).zip(&found) {
            let (x, y) = (i % 40, i / 40);
            let expected = picture.smoothed(x, y, space);
            let is_near = |expected: &[f64; 4]| {
                let channels = bytes(*found).into_iter().zip(expected);
                channels
                    .map(|(found, expected)| (f64::from(found) - expected).abs())
                    .fold(0.0, f64::max)
                    < 1.1
            };
            assert!(
                expected.iter().any(is_near),
                "{x}, {y}: {found:08X} for {expected:?}, {space:?}"
            );
        }
        *changed += pixels.iter().zip(&found).filter(|(a, b)| a != b).count();
        Ok(())
    })
    .budget_ms(1000);
}

#[test]
fn smaa_of_parts_is_that_of_the_whole_frame() {
    for (name, samples) in [("study/02_siemens_star.svg", 1), ("study/28_guessed_edges.svg", 4)] {
        let scene = gallery_scene(name);
        let settings = smoothed(samples);
        let view = View::Default.transform(scene.canvas, SIZE);
        let whole = drawn(&scene, &view, &settings, SIZE);
        assert!(
            whole != drawn(&scene, &view, &at_rate(samples), SIZE),
            "{name}: something is smoothed"
        );
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        let never = CancelToken::default();
        let region = |x, y, width, height| Region { x, y, width, height };
        for regions in [
            vec![region(0, 0, 1, 1), region(199, 159, 9, 9)],
            vec![region(70, 50, 33, 20), region(90, 60, 40, 1)],
            vec![region(REACH, REACH, 60, 1), region(300, 0, 4, 4)],
        ] {
            let mut frame = Framebuffer::new(SIZE[0], SIZE[1]);
            draw_regions(&subject, &mut frame, &regions, &never).expect("not cancelled");
            for region in regions {
                assert!(frame.cut(region) == whole.cut(region), "{name} {region:?}");
            }
        }
        let refined = Mutex::new((Framebuffer::new(SIZE[0], SIZE[1]), 0));
        refine(&subject, SIZE, [20, 90], &never, |tile, pixels| {
            let mut refined = refined.lock().expect("nobody fails");
            refined.0.copy_from(tile, pixels, tile);
            refined.1 += pixels.len();
        });
        let (refined, count) = refined.into_inner().expect("nobody fails");
        assert!(refined == whole, "{name}: tile by tile");
        assert_eq!(count, whole.pixels().len(), "{name}: each pixel once");
        let mut surface = vec![7; whole.pixels().len()];
        let mut kept = Framebuffer::new(SIZE[0], SIZE[1]);
        draw_onto(&subject, &mut surface, &mut kept, &never).expect("not cancelled");
        assert!(surface == whole.pixels() && kept == whole, "{name}: on a surface");
        for threads in [1, 3] {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .expect("threads");
            let again = pool.install(|| drawn(&scene, &view, &settings, SIZE));
            assert!(again == whole, "{name}: on {threads} threads");
        }
    }
}

#[test]
fn smaa_leaves_the_truth_and_other_pictures_alone() {
    let settings = smoothed(1);
    assert_eq!(settings.truth().post_process, PostProcess::None, "samples are right");
    let scene = gallery_scene(SCENES[1].name);
    let view = View::Default.transform(scene.canvas, SIZE);
    let shown = |post_process| RenderSettings {
        post_process,
        visualisation: rasterscope::render::Visualisation::Overdraw,
        background: Rgba::WHITE,
        ..settings
    };
    let [plain, processed] = PostProcess::ALL.map(|process| drawn(&scene, &view, &shown(process), SIZE));
    assert!(plain == processed, "numbers in false colours are not blended");
}

#[test]
fn smaa_wins_along_long_edges_and_loses_where_samples_missed() {
    const WHOLE: [u32; 2] = [512, 384];
    let errors = |name: &str| {
        let scene = gallery_scene(name);
        let view = View::Default.transform(scene.canvas, WHOLE);
        let truth = drawn(&scene, &view, &at_rate(64), WHOLE);
        [at_rate(1), smoothed(1), at_rate(4)].map(|settings| rmse(&drawn(&scene, &view, &settings, WHOLE), &truth))
    };
    let [one, smaa, four] = errors("study/28_guessed_edges.svg");
    assert!(smaa < one * 0.6 && smaa < four, "long edges: {one} {smaa} {four}");
    let [one, smaa, four] = errors("study/29_what_guesses_miss.svg");
    assert!(
        one - smaa < 0.5 * (one - four) && four < smaa * 0.6,
        "rays and words: {one} {smaa} {four}"
    );
}
