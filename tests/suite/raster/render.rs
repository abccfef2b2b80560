//! Whole pictures: threads, resolve, backgrounds, layers, points and hairlines, views.

use std::sync::Arc;

use glam::DVec2;
use rasterscope::color::{ResolveSpace, Rgba};
use rasterscope::geometry::{FillRule, Polygon, View};
use rasterscope::raster::{Framebuffer, SamplePattern};
use rasterscope::render::{CancelToken, RenderSettings, Subject, Visualisation, draw, draw_cancellable, replay};
use rasterscope::scene::{Composite, DialectChoice, Fill, PrimitiveKind};

use crate::support::documents;
use crate::support::scenes::{Fills, at_rate, drawn, gallery_scene, one_to_one, random, scene, triangle};

#[test]
fn render_does_not_depend_on_the_number_of_threads() {
    let fills = Fills::Everything;
    let pools = [1, 2, 5].map(|n| rayon::ThreadPoolBuilder::new().num_threads(n).build().expect("a pool"));
    arbtest::arbtest(|u| {
        let (scene, settings) = (random(u, 150, fills)?, at_rate(*u.choose(&[1, 4, 16])?));
        let view = one_to_one([150, 150]);
        let [one, two, five] = pools
            .each_ref()
            .map(|pool| pool.install(|| drawn(&scene, &view, &settings, [150, 150])));
        assert!(one == two && one == five, "threads show in the picture of {settings:?}");
        Ok(())
    })
    .budget_ms(1000);
}

#[test]
fn render_of_a_pixel_aligned_square_is_the_same_at_every_rate() {
    let square = vec![
        triangle([(2.0, 2.0), (7.0, 2.0), (2.0, 7.0)], Rgba::opaque(0.2, 0.4, 0.6)),
        triangle([(7.0, 2.0), (7.0, 7.0), (2.0, 7.0)], Rgba::opaque(0.2, 0.4, 0.6)),
    ];
    let scene = scene(9.0, square);
    let one = drawn(&scene, &one_to_one([9, 9]), &at_rate(1), [9, 9]);
    for side in 2..=16 {
        let many = drawn(&scene, &one_to_one([9, 9]), &at_rate(side * side), [9, 9]);
        assert!(many == one, "rate {}", side * side);
    }
}

#[test]
fn render_resolves_coverage_to_the_fraction_of_samples() {
    // The left half of pixel (1, 0): 8 of 16 samples.
    let half = vec![
        triangle([(1.0, -9.0), (1.5, -9.0), (1.0, 9.0)], Rgba::BLACK),
        triangle([(1.5, -9.0), (1.5, 9.0), (1.0, 9.0)], Rgba::BLACK),
    ];
    let frame = drawn(&scene(3.0, half), &one_to_one([3, 1]), &at_rate(16), [3, 1]);
    assert_eq!(
        frame.pixels(),
        [0xFFFF_FFFF, 0xFF80_8080, 0xFFFF_FFFF],
        "127.5 is rounded up"
    );
}

#[test]
fn render_points_and_hairlines_look_alike_at_every_rate() {
    let kinds = vec![
        PrimitiveKind::Hairline {
            ends: [DVec2::new(0.5, 4.2), DVec2::new(7.3, 1.1)],
            color: Rgba::BLACK,
        },
        PrimitiveKind::Point {
            at: DVec2::new(6.01, 6.99),
            color: Rgba::opaque(1.0, 0.0, 0.0),
        },
    ];
    let scene = scene(8.0, kinds);
    let one = drawn(&scene, &one_to_one([8, 8]), &at_rate(1), [8, 8]);
    assert_eq!(
        one.rgba(6, 6),
        Some([255, 0, 0, 255]),
        "the pixel that the point falls in"
    );
    for rate in [4, 9, 64] {
        assert!(
            drawn(&scene, &one_to_one([8, 8]), &at_rate(rate), [8, 8]) == one,
            "rate {rate}"
        );
    }
}

#[test]
fn render_layer_fades_what_overlaps_inside_it_once() {
    let square = |x: f64| triangle([(x, -20.0), (x + 40.0, 10.0), (x, 40.0)], Rgba::BLACK);
    let kinds = vec![
        PrimitiveKind::BeginLayer,
        square(0.0),
        square(-2.0),
        PrimitiveKind::EndLayer {
            composite: Composite::over(0.5),
        },
    ];
    let frame = drawn(&scene(8.0, kinds), &one_to_one([8, 8]), &at_rate(4), [8, 8]);
    assert!(
        frame.pixels().iter().all(|pixel| *pixel == 0xFF80_8080),
        "no darker where both are: {:X?}",
        frame.rgba(4, 4)
    );
}

#[test]
fn render_on_transparent_keeps_straight_colour() {
    let kinds = vec![triangle(
        [(-9.0, -9.0), (30.0, -9.0), (-9.0, 30.0)],
        Rgba {
            r: 1.0,
            g: 0.5,
            b: 0.0,
            a: 0.25,
        },
    )];
    let settings = RenderSettings {
        background: Rgba::TRANSPARENT,
        ..at_rate(4)
    };
    let frame = drawn(&scene(4.0, kinds), &one_to_one([4, 4]), &settings, [4, 4]);
    assert_eq!(
        frame.rgba(1, 1),
        Some([255, 128, 0, 64]),
        "colour is not darkened by its opacity"
    );
    let nothing = drawn(&scene(4.0, vec![]), &one_to_one([4, 4]), &settings, [4, 4]);
    assert_eq!(nothing.rgba(1, 1), Some([0, 0, 0, 0]), "nothing at all");
}

#[test]
fn render_default_view_outlines_the_canvas() {
    let settings = RenderSettings {
        outline: true,
        ..at_rate(1)
    };
    let view = View::Default.transform(DVec2::splat(100.0), [120, 120]);
    let frame = drawn(&scene(100.0, vec![]), &view, &settings, [120, 120]);
    assert_eq!(frame.rgba(60, 60), Some([255; 4]), "white inside");
    let black = frame.pixels().iter().filter(|pixel| **pixel == 0xFF00_0000).count();
    assert!((400..=410).contains(&black), "one pixel around 100 x 100: {black}");
    assert_eq!(
        frame.rgba(9, 60),
        Some([0, 0, 0, 255]),
        "just left of the canvas, which begins at pixel 10"
    );
    assert_eq!(frame.rgba(10, 60), Some([255; 4]), "the canvas itself is free");
}

#[test]
fn render_canvas_view_fills_the_frame() {
    let kinds = vec![
        triangle([(0.0, 0.0), (50.0, 0.0), (0.0, 80.0)], Rgba::BLACK),
        triangle([(50.0, 0.0), (50.0, 80.0), (0.0, 80.0)], Rgba::BLACK),
    ];
    let mut scene = scene(50.0, kinds);
    scene.canvas = DVec2::new(50.0, 80.0);
    let view = View::Canvas.transform(scene.canvas, [25, 40]);
    let frame = drawn(&scene, &view, &at_rate(4), [25, 40]);
    assert!(
        frame.pixels().iter().all(|pixel| *pixel == 0xFF00_0000),
        "the canvas is the frame"
    );
}

#[test]
fn render_gives_up_when_cancelled() {
    let cancel = CancelToken::default();
    cancel.cancel();
    let mut frame = Framebuffer::new(10, 10);
    let scene = scene(10.0, vec![triangle([(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)], Rgba::BLACK)]);
    assert!(
        draw_cancellable(&scene, &one_to_one([10, 10]), &at_rate(1), &mut frame, &cancel).is_none(),
        "unfinished"
    );
}

#[test]
fn render_of_nothing_is_no_crash() {
    for size in [[0, 0], [0, 7], [7, 0], [1, 1]] {
        let scene = scene(10.0, vec![triangle([(0.0, 0.0), (9.0, 0.0), (0.0, 9.0)], Rgba::BLACK)]);
        let settings = RenderSettings {
            outline: true,
            ..at_rate(16)
        };
        let view = View::Default.transform(scene.canvas, size);
        assert_eq!(
            drawn(&scene, &view, &settings, size).pixels().len(),
            (size[0] * size[1]) as usize,
            "{size:?}"
        );
    }
}

#[test]
fn replay_tells_the_samples_that_make_the_pixel() {
    arbtest::arbtest(|u| {
        // What is shaded is summed over the samples of a pixel before it is rounded, here each sample is.
        let (fills, rounding) = *u.choose(&[(Fills::Translucent, 1e-9), (Fills::Everything, 0.25)])?;
        let (scene, mut settings) = (random(u, 12, fills)?, at_rate(*u.choose(&[1, 4, 9])?));
        settings.pattern = *u.choose(&SamplePattern::ALL)?;
        let view = one_to_one([12, 12]);
        let frame = drawn(&scene, &view, &settings, [12, 12]);
        let (x, y) = (u.int_in_range(0..=11)?, u.int_in_range(0..=11)?);
        let subject = Subject {
            scene: &scene,
            view: &view,
            settings: &settings,
        };
        let replayed = replay(&subject, [12, 12], [x, y]).expect("inside the frame");
        assert_eq!(
            replayed.pixel,
            frame.pixels()[(y * 12 + x) as usize],
            "the frame's pixel"
        );
        let samples = &replayed.samples;
        assert_eq!(
            samples.len(),
            settings.sample_rate.samples() as usize,
            "one colour per sample"
        );
        let mean = |channel: usize| {
            let sum = samples
                .iter()
                .map(|sample| u32::from(sample.color.0[channel]))
                .sum::<u32>();
            f64::from(sum) / (256.0 * samples.len() as f64)
        };
        // A mask on the picture itself lets it shine through: its pixels are straight, its samples premultiplied.
        let [red, _, _, alpha] = frame.rgba(x, y).expect("inside the frame").map(f64::from);
        assert!(
            (mean(3) - alpha).abs() <= 0.5 + rounding,
            "alpha {} and {alpha}",
            mean(3)
        );
        if mean(3) > 1.0 {
            let thinned = 255.0 / mean(3);
            let straight = mean(0) * thinned;
            assert!(
                (straight - red).abs() <= 0.5 + rounding * thinned,
                "mean {straight} of the samples, pixel {red}"
            );
        }
        let known = |source: u32| (source as usize) < scene.primitives.len();
        assert!(
            replayed.sources().into_iter().all(|source| source.is_none_or(known)),
            "sources are primitives"
        );
        Ok(())
    })
    .budget_ms(500);
    let scene = scene(4.0, vec![triangle([(0.0, 0.0), (2.0, 0.0), (0.0, 4.0)], Rgba::BLACK)]);
    let view = one_to_one([4, 4]);
    let settings = at_rate(4);
    let subject = Subject {
        scene: &scene,
        view: &view,
        settings: &settings,
    };
    let replayed = replay(&subject, [4, 4], [1, 0]).expect("inside the frame");
    assert_eq!(
        replayed.sources(),
        [Some(0), Some(0), Some(0), None],
        "the slanted edge leaves the lower right sample white"
    );
    assert!(replay(&subject, [4, 4], [4, 0]).is_none(), "outside");
}

#[test]
fn study_of_half_the_light_is_what_it_says() {
    let scene = gallery_scene("study/17_half_the_light.svg");
    let size = [1024, 1024];
    // The square on the left, the stripes, the square on the right.
    let pixels = |resolve| {
        let settings = RenderSettings { resolve, ..at_rate(4) };
        let frame = drawn(&scene, &View::Default.transform(scene.canvas, size), &settings, size);
        [310, 512, 712].map(|x| frame.rgba(x, 712).unwrap()[0])
    };
    assert_eq!(pixels(ResolveSpace::Stored), [128, 128, 188], "as stored");
    assert_eq!(pixels(ResolveSpace::Linear), [128, 188, 188], "in linear light");
}

#[test]
fn render_drops_what_is_hidden_and_still_counts_and_tells_it() {
    let corners = [(20.0, 10.0), (170.0, 10.0), (170.0, 190.0), (20.0, 190.0)].map(DVec2::from);
    let square = |shade: f32| PrimitiveKind::Polygon {
        polygon: Arc::new(Polygon::new([corners.to_vec()], FillRule::NonZero)),
        fill: Fill::Solid(Rgba::opaque(shade, 0.5, 0.2)),
    };
    let half = |shade: f32, lower: bool| {
        let last = if lower { (15.0, 195.0) } else { (175.0, 5.0) };
        triangle([(15.0, 5.0), (175.0, 195.0), last], Rgba::opaque(shade, 0.1, 0.9))
    };
    let all: Vec<PrimitiveKind> = [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]
        .into_iter()
        .flat_map(|shade| [square(shade), half(shade, false), half(shade, true)])
        .collect();
    let last = all[all.len() - 2..].to_vec();
    let (all, last) = (scene(200.0, all), scene(200.0, last));
    let (view, size) = (one_to_one([200, 200]), [200, 200]);
    for samples in [1, 4, 16] {
        let settings = at_rate(samples);
        assert!(
            drawn(&all, &view, &settings, size) == drawn(&last, &view, &settings, size),
            "rate {samples}"
        );
        let mut frame = Framebuffer::new(200, 200);
        let stats = draw(&all, &view, &settings, &mut frame);
        assert_eq!(stats.triangles, 18, "all are counted");
        let overdraw = RenderSettings {
            visualisation: Visualisation::Overdraw,
            ..settings
        };
        assert!(
            drawn(&all, &view, &overdraw, size) != drawn(&last, &view, &overdraw, size),
            "overdraw shows them"
        );
        let subject = Subject {
            scene: &all,
            view: &view,
            settings: &settings,
        };
        let told = replay(&subject, size, [100, 50]).expect("a pixel of the frame");
        assert_eq!(told.painted.len(), 12, "of each six the pixel saw two");
    }
}

#[test]
fn a_circle_is_round_at_ten_thousand_per_cent() {
    let document =
        "<svg xmlns='http://www.w3.org/2000/svg' width='100' height='100'><circle cx='50' cy='50' r='40'/></svg>";
    let scene = documents::read(document, DialectChoice::Svg);
    let size = [200, 160];
    for (scale, angle) in [(1.0, 0.3_f64), (10.0, 1.1), (100.0, 2.0), (1000.0, 4.0)] {
        // A part of its border, magnified.
        let center = DVec2::splat(50.0) + DVec2::from_angle(angle) * 40.0;
        let view = View::At {
            center,
            scale,
            rotation: 0.0,
        }
        .transform(scene.canvas, size);
        let frame = drawn(&scene, &view, &at_rate(16), size);
        let mut wrong = 0;
        for (i, pixel) in (0..).zip(frame.pixels()) {
            let corner = DVec2::new(f64::from(i % size[0]), f64::from(i / size[0]));
            // Samples within a seventh of their distance from the border may lie on either side of it: a tenth is for
            // flattening, the rest for coordinates of 32 bits.
            let near = 0.035 / scale;
            let inside = |radius: f64| {
                let samples = (0..16).filter(|sample| {
                    let offset = DVec2::new(f64::from(sample % 4), f64::from(sample / 4)) / 4.0 + 0.125;
                    view.to_scene(corner + offset).distance(DVec2::splat(50.0)) < radius
                });
                255 - (samples.count() * 255 + 8) / 16
            };
            let red = (pixel >> 16 & 0xFF) as usize;
            wrong += u32::from(red + 1 < inside(40.0 + near) || red > inside(40.0 - near) + 1);
        }
        assert_eq!(wrong, 0, "pixels with a sample on the wrong side at {scale}");
    }
}

#[test]
fn render_gradients_do_not_depend_on_layers() {
    let defs = "<defs><linearGradient id='down' x2='0' y2='1'><stop stop-color='#123'/><stop offset='1' stop-color='#fa4'/></linearGradient>\
        <linearGradient id='slope' x2='1' y2='0.4' spreadMethod='reflect'><stop offset='.2' stop-color='#e31'/><stop offset='.4' stop-color='#18a'/></linearGradient>\
        <radialGradient id='round' fx='.3' spreadMethod='repeat' r='.2'><stop stop-color='#fff'/><stop offset='.5' stop-color='#284'/><stop offset='1'/></radialGradient></defs>";
    let shapes = "<rect width='200' height='200' fill='url(#down)'/><rect x='20.3' y='20.7' width='90' height='61' fill='url(#slope)'/>\
        <circle cx='70' cy='70' r='45' fill='url(#round)'/><path d='M0 130 180 20 190 60Z' fill='url(#down)'/><circle cx='120' cy='30' r='9' fill='#222'/>";
    let picture = |body: &str, rate: u32| {
        let document = documents::svg(
            "width='200' height='200' viewBox='0 0 200 200'",
            &format!("{defs}{body}"),
        );
        let scene = documents::read(&document, DialectChoice::Svg);
        drawn(&scene, &one_to_one([200, 200]), &at_rate(rate), [200, 200])
    };
    for rate in [1, 4, 9, 16, 64] {
        let plain = picture(shapes, rate);
        let isolated = picture(&format!("<g style='isolation: isolate'>{shapes}</g>"), rate);
        assert!(plain == isolated, "rate {rate}: a group for itself");
        // Far from the layer, in other tiles.
        let beside = picture(
            &format!("{shapes}<g opacity='0.5'><rect x='190' y='190' width='9' height='9'/></g>"),
            rate,
        );
        let upper = |frame: &Framebuffer| frame.pixels()[..200 * 120].to_vec();
        assert!(upper(&plain) == upper(&beside), "rate {rate}: with a layer elsewhere");
        assert!(plain != beside, "rate {rate}: which is to be seen");
    }
}
