//! Triangles of one element in two explanations: each is compared with its like, and all of them with the element as a whole.

use rasterscope::inspect::{Explanation, Shape};
use rasterscope::render::RenderSettings;
use rasterscope::rules::Rules;
use rasterscope::scene::Scene;

use crate::support::explaining::explained;
use crate::support::scenes::{at_rate, gallery_scene};

const SIZE: [u32; 2] = [160, 120];

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

/// A pixel on the diagonal of a rect: its two triangles paint all samples together, and by different numbers.
fn on_a_diagonal(scene: &Scene, settings: &RenderSettings) -> ([u32; 2], Explanation) {
    let pixels = (0..SIZE[1]).flat_map(|y| (0..SIZE[0]).map(move |x| [x, y]));
    let mut found = pixels.map(|pixel| (pixel, explained(scene, settings, SIZE, pixel)));
    let is_on_diagonal = |(_, told): &([u32; 2], Explanation)| {
        let [paint, _] = &told.paints[..] else { return false };
        let painted = painted(told, paint.primitive);
        let [one, other] = painted[..] else { return false };
        one != other && one + other == told.samples.len()
    };
    found.find(is_on_diagonal).expect("a rect with a diagonal")
}

#[test]
fn triangles_of_one_element_are_told_apart() {
    let scene = gallery_scene("basic/test4.svg");
    let (pixel, few) = on_a_diagonal(&scene, &by(Rules::Float, 16));
    let many = explained(&scene, &by(Rules::Float, 64), SIZE, pixel);
    let rect = few.paints[0].primitive;
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
fn element_in_pieces_is_compared_as_a_whole() {
    let scene = gallery_scene("basic/test4.svg");
    let (pixel, pieces) = on_a_diagonal(&scene, &by(Rules::Float, 16));
    let whole = explained(&scene, &by(Rules::Standard, 16), SIZE, pixel);
    for told in [pieces.differences(&whole), whole.differences(&pieces)] {
        assert!(
            !told.iter().any(|row| row.what.contains("covers")),
            "both cover all of the pixel: {told:?}"
        );
    }
}
