//! What textures are between their texels and beyond their borders: where cubic kernels win and lose, what wraps repeat, and
//! what explanations say of both.

use rasterscope::geometry::View;
use rasterscope::inspect::Explanation;
use rasterscope::raster::{Framebuffer, SampleRate};
use rasterscope::render::RenderSettings;
use rasterscope::scene::Scene;
use rasterscope::texture::{FixedLevel, LevelOfDetail, LevelSampling, PixelSampling, Wrap};

use crate::support::explaining::advised_in;
use crate::support::scenes::{at_rate, drawn, gallery_scene, rmse};

/// One pixel per unit.
const SIZE: [u32; 2] = [512, 512];

fn view(scene: &Scene) -> View {
    View::At {
        center: scene.canvas * 0.5,
        scale: 1.0,
        rotation: 0.0,
    }
}

fn picture(scene: &Scene, settings: &RenderSettings) -> Framebuffer {
    drawn(scene, &view(scene).transform(scene.canvas, SIZE), settings, SIZE)
}

fn with(pixel_sampling: PixelSampling) -> RenderSettings {
    RenderSettings {
        pixel_sampling,
        outline: false,
        ..at_rate(16)
    }
}

fn explained(scene: &Scene, settings: &RenderSettings, pixel: [u32; 2]) -> Explanation {
    advised_in(scene, settings, (view(scene), SIZE), pixel)
}

/// All that is said, in one line.
fn words(found: &Explanation) -> String {
    found.to_string().split_whitespace().collect::<Vec<_>>().join(" ")
}

/// What is said of the topmost paint's fragment.
fn told(scene: &Scene, settings: &RenderSettings, pixel: [u32; 2]) -> String {
    let found = explained(scene, settings, pixel);
    let paint = found.paints.len() - 1;
    let sample = found.telling_sample(paint).expect("it paints");
    found.fragment_lines(paint, sample).join("\n")
}

#[test]
fn areas_are_told_instead_of_the_pixel_sampling_that_they_do_not_ask_for() {
    let scene = gallery_scene("study/08_checker_fan.svg");
    for (level_sampling, read) in [
        (LevelSampling::Ewa, "read by a Gaussian over an ellipse"),
        (LevelSampling::SummedArea, "read as the mean of a box"),
        (LevelSampling::Ripmap, "read bilinear"),
    ] {
        let settings = RenderSettings {
            level_sampling,
            ..with(PixelSampling::Bilinear)
        };
        let pixel = [SIZE[0] / 8, SIZE[1] / 2];
        let text = words(&explained(&scene, &settings, pixel));
        assert!(text.contains(read), "{level_sampling:?}: {text}");
    }
}

#[test]
fn ellipses_win_where_footprints_lie_askew() {
    let errors = |name: &str| {
        let scene = gallery_scene(name);
        let with = |level_sampling| RenderSettings {
            level_sampling,
            sample_rate: SampleRate::ONE,
            ..with(PixelSampling::Bilinear)
        };
        let truth = picture(&scene, &with(LevelSampling::Zero).truth());
        [LevelSampling::Ewa, LevelSampling::SummedArea, LevelSampling::Ripmap]
            .map(|level| rmse(&picture(&scene, &with(level)), &truth))
    };
    let [ewa, summed, ripmap] = errors("study/32_checker_fan_turned.svg");
    assert!(
        ewa < 0.75 * summed.min(ripmap),
        "upright boxes do not fit: {ewa}, {summed}, {ripmap}"
    );
    let [ewa, summed, ripmap] = errors("study/08_checker_fan.svg");
    assert!(
        ewa > 0.8 * summed.max(ripmap),
        "upright boxes fit as well: {ewa}, {summed}, {ripmap}"
    );
}

#[test]
fn kernels_win_where_few_texels_are_left_of_a_picture() {
    let scene = gallery_scene("study/25_few_texels.svg");
    let truth = picture(&scene, &with(PixelSampling::Bilinear).truth());
    let error = |pixel: PixelSampling| {
        let settings = RenderSettings {
            detail: LevelOfDetail {
                fixed: FixedLevel::new(2.0),
                ..LevelOfDetail::default()
            },
            ..with(pixel)
        };
        rmse(&picture(&scene, &settings), &truth)
    };
    let all = PixelSampling::ALL.map(error);
    let [nearest, bilinear, catmull_rom, b_spline, mitchell] = all;
    assert!(
        catmull_rom < 0.85 * mitchell && mitchell < 0.97 * bilinear && bilinear < 0.9 * nearest,
        "sharper is nearer: {all:?}"
    );
    assert!(b_spline > 1.2 * bilinear, "the softest is not: {all:?}");
}

#[test]
fn kernels_lose_where_texels_have_edges() {
    let scene = gallery_scene("study/26_hard_texels.svg");
    // Green of the checker's squares, all of them a while inside; nearest has two values there.
    let greens = |pixel: PixelSampling| {
        let picture = picture(&scene, &with(pixel));
        let greens = (20..250).flat_map(|y| (20..490).map(move |x| [x, y]));
        let green = |[x, y]: [u32; 2]| picture.pixels()[(y * SIZE[0] + x) as usize].to_be_bytes()[2];
        let all: Vec<u8> = greens.map(green).collect();
        let ends = (*all.iter().min().expect("some"), *all.iter().max().expect("some"));
        let between = all
            .iter()
            .filter(|green| **green != ends.0 && **green != ends.1)
            .count();
        (ends, between as f64 / all.len() as f64)
    };
    let ((dark, light), blurred) = greens(PixelSampling::Nearest);
    assert!(blurred < 0.02, "two colours, and the pixels between them: {blurred}");
    for (pixel, rings) in [
        (PixelSampling::Bilinear, false),
        (PixelSampling::CatmullRom, true),
        (PixelSampling::BSpline, false),
        (PixelSampling::Mitchell, true),
    ] {
        let (ends, _) = greens(pixel);
        let expected = if rings {
            ends.0 + 3 < dark && ends.1 > light + 3
        } else {
            ends == (dark, light)
        };
        assert!(expected, "{pixel:?} from {ends:?}, texels are {:?}", (dark, light));
    }
    let width = |pixel| greens(pixel).1;
    assert!(
        width(PixelSampling::BSpline) > 2.0 * width(PixelSampling::Bilinear),
        "edges are twice as wide: {} and {}",
        width(PixelSampling::BSpline),
        width(PixelSampling::Bilinear)
    );
}

/// Whether two pixels are one, but for rounding.
fn alike(a: u32, b: u32) -> bool {
    let channels = a.to_be_bytes().into_iter().zip(b.to_be_bytes());
    channels.into_iter().all(|(a, b)| a.abs_diff(b) <= 1)
}

#[test]
fn wraps_go_on_beyond_the_border() {
    let scene = gallery_scene("study/27_beyond_the_border.svg");
    let draw = |texture_wrap, pixel| {
        picture(
            &scene,
            &RenderSettings {
                texture_wrap,
                ..with(pixel)
            },
        )
    };
    for pixel in PixelSampling::ALL {
        let [clamp, repeat, mirror] = Wrap::ALL.map(|wrap| draw(wrap, pixel));
        let at = |picture: &Framebuffer, x: u32, y: u32| picture.pixels()[(y * SIZE[0] + x) as usize];
        // The corner of four copies lies at (256, 136); a pair of squares is 200 pixels wide.
        let same = |picture: &Framebuffer, other: &dyn Fn(u32) -> u32| {
            let all = (20..250).flat_map(|y| (260..300).map(move |x| (x, y)));
            let same = all.filter(|(x, y)| alike(at(picture, *x, *y), at(picture, other(*x), *y)));
            same.count() as f64 / f64::from(230 * 40)
        };
        assert!(same(&repeat, &|x| x - 200) > 0.999, "{pixel:?}: squares go on");
        assert!(same(&clamp, &|x| x - 200) < 0.6, "{pixel:?}: they do not");
        assert!(same(&mirror, &|x| 511 - x) > 0.999, "{pixel:?}: they come back");
        // Right of the border every column is the last one.
        assert!(same(&clamp, &|_| 300) > 0.999, "{pixel:?}: the outermost texels go on");
    }
    // What loses: where no coordinate lies beyond, half a texel of the opposite border shines in.
    let changed = |pixel, columns: std::ops::Range<u32>| {
        let [clamp, repeat] = [Wrap::Clamp, Wrap::Repeat].map(|wrap| draw(wrap, pixel));
        let all = (300..490).flat_map(|y| columns.clone().map(move |x| (y * SIZE[0] + x) as usize));
        all.filter(|at| clamp.pixels()[*at] != repeat.pixels()[*at]).count()
    };
    assert_eq!(
        changed(PixelSampling::Nearest, 272..496),
        0,
        "single texels are their own"
    );
    assert!(
        changed(PixelSampling::Bilinear, 272..284) > 1000,
        "half a texel is 14 pixels"
    );
    assert_eq!(changed(PixelSampling::Bilinear, 287..496), 0, "and no more");
}

#[test]
fn explanations_tell_sixteen_texels_and_where_a_wrapped_point_is() {
    let hard = gallery_scene("study/26_hard_texels.svg");
    // Beside an edge, so that weights below zero count.
    let lines = told(&hard, &with(PixelSampling::CatmullRom), [103, 60]);
    let weights: Vec<f64> = lines
        .lines()
        .filter(|line| line.contains("of texel ("))
        .filter_map(|line| line.trim().split(' ').next()?.parse().ok())
        .collect();
    assert_eq!(weights.len(), 16, "{lines}");
    let sum: f64 = weights.iter().sum();
    assert!((sum - 100.0).abs() < 0.2, "{sum} %: {lines}");
    assert!(weights.iter().any(|weight| *weight < 0.0), "{lines}");
    let found = words(&explained(&hard, &with(PixelSampling::CatmullRom), [103, 60]));
    assert!(found.contains("read by the cubic kernel catmull-rom"), "{found}");

    let beyond = gallery_scene("study/27_beyond_the_border.svg");
    let settings = |texture_wrap| RenderSettings {
        texture_wrap,
        ..with(PixelSampling::Bilinear)
    };
    let at = [300, 200];
    for (wrap, copy) in [
        (Wrap::Repeat, Some("in copy (1, 1)")),
        (Wrap::Mirror, Some("in copy (1, 1), turned both ways")),
        (Wrap::Clamp, None),
    ] {
        let lines = told(&beyond, &settings(wrap), at);
        let wrapped = lines.lines().find(|line| line.starts_with("wrapped"));
        assert_eq!(wrapped.is_some(), copy.is_some(), "{wrap:?}: {lines}");
        assert!(
            copy.is_none_or(|copy| wrapped.is_some_and(|line| line.ends_with(copy))),
            "{wrap:?}: {lines}"
        );
        let of_texture = words(&explained(&beyond, &settings(wrap), at));
        let says = of_texture.contains(&format!(
            "{} beyond its border",
            if wrap == Wrap::Repeat { "repeated" } else { "mirrored" }
        ));
        assert_eq!(says, copy.is_some(), "{wrap:?}: {of_texture}");
    }
}
