//! Triangles of one element in two explanations: each is compared with its like, and all of them with the element as a whole.

use rasterscope::inspect::{Explanation, Shape};
use rasterscope::raster::SamplePattern;
use rasterscope::render::RenderSettings;
use rasterscope::rules::Rules;

use crate::support::explaining::explained;
use crate::support::scenes::{at_rate, gallery_scene};

const SIZE: [u32; 2] = [1280, 800];
/// On the diagonal of the scene's largest rect: its two triangles paint all samples together, and by different numbers.
const PIXEL: [u32; 2] = [610, 429];

fn by(rules: Rules, samples: u32) -> RenderSettings {
    RenderSettings {
        rules,
        ..at_rate(samples)
    }
}

/// How many samples each triangle of a primitive paints.
fn painted(explanation: &Explanation, primitive: u32) -> Vec<usize> {
    let triangles = explanation
        .paints
        .iter()
        .filter(|paint| paint.primitive == primitive && matches!(paint.shape, Shape::Triangle { .. }));
    triangles.map(|paint| paint.fragments.len()).collect()
}

#[test]
fn triangles_of_one_element_are_told_apart() {
    let scene = gallery_scene("basic/test4.svg");
    let few = explained(&scene, &by(Rules::Float, 16), SIZE, PIXEL);
    let many = explained(&scene, &by(Rules::Float, 64), SIZE, PIXEL);
    let rect = few.paints[0].primitive;
    assert_eq!(painted(&few, rect), [10, 6], "on the diagonal");
    let parts = painted(&few, rect).into_iter().zip(painted(&many, rect));
    let expected = parts.filter(|(few, many)| few * 4 != *many);
    let count = |samples: usize| u32::try_from(samples).ok();
    let expected: Vec<[Option<u32>; 2]> = expected.map(|(few, many)| [count(few * 4), count(many)]).collect();
    let told = few.differences(&many);
    let of_rect = format!("{} (", few.paints[0].name());
    let covers = told.iter().filter(|row| row.what.starts_with(&of_rect));
    let of_64 = |text: &str| {
        let percent: f64 = text.trim_end_matches(" %").parse().expect("a part");
        (0..=64).find(|count| (f64::from(*count) / 0.64 - percent).abs() < 0.7)
    };
    let covers: Vec<[Option<u32>; 2]> = covers.map(|row| [of_64(&row.a), of_64(&row.b)]).collect();
    assert_eq!(covers, expected, "{told:?}");
    assert!(few.differences(&few).is_empty(), "nothing differs from itself");
}

#[test]
fn samples_that_lie_elsewhere_are_a_difference() {
    let scene = gallery_scene("basic/test4.svg");
    let with = |pattern| RenderSettings {
        pattern,
        ..by(Rules::Standard, 16)
    };
    let [grid, scattered] =
        [SamplePattern::Grid, SamplePattern::Hammersley].map(|pattern| explained(&scene, &with(pattern), SIZE, PIXEL));
    let differences = grid.differences(&scattered);
    let places = differences
        .iter()
        .find(|row| row.what == "their places")
        .expect("a row");
    assert_eq!(places.a, "sample 1 at 0.125, 0.125");
    let [x, y] = scattered.samples[0].position;
    let told: Vec<f64> = places.b["sample 1 at ".len()..]
        .split(", ")
        .flat_map(str::parse)
        .collect();
    assert!(
        (told[0] - x).abs() < 0.001 && (told[1] - y).abs() < 0.001,
        "{places:?}: {x}, {y}"
    );
    let fewer = explained(&scene, &by(Rules::Standard, 4), SIZE, PIXEL);
    let is_told = grid.differences(&fewer).iter().any(|row| row.what == "their places");
    assert!(!is_told, "there are others");
}

#[test]
fn element_in_pieces_is_compared_as_a_whole() {
    let scene = gallery_scene("basic/test4.svg");
    let pieces = explained(&scene, &by(Rules::Float, 16), SIZE, PIXEL);
    let whole = explained(&scene, &by(Rules::Standard, 16), SIZE, PIXEL);
    for told in [pieces.differences(&whole), whole.differences(&pieces)] {
        assert!(
            !told.iter().any(|row| row.what.contains("of rect, line 8 covers")),
            "both cover all of the pixel: {told:?}"
        );
    }
}
