//! What is given as the reason is the reason: small documents in which something else lies near, above, below or beside it.

use rasterscope::inspect::{Detail, Explanation};
use rasterscope::raster::{FilterRadius, PixelCoverage, ResolveFilter, SampleRate, ShadingRate};
use rasterscope::render::RenderSettings;
use rasterscope::rules::Rules;
use rasterscope::scene::{self, DialectChoice, NoResources, ReadOptions};
use rasterscope::viewer::patterns;

use crate::support::explaining::advised;

const SIZE: [u32; 2] = [20, 20];

/// A pixel of white paper, 20 pixels on each side, with this on it.
fn told_of(body: &str, settings: &RenderSettings, pixel: [u32; 2]) -> Explanation {
    let document = format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" width="20" height="20"><rect width="20" height="20" fill="#fff"/>{body}</svg>"##
    );
    let options = ReadOptions {
        dialect: DialectChoice::Svg,
    };
    let scene = scene::read(document.as_bytes(), "reasons.svg", options, &NoResources).unwrap();
    advised(&scene, settings, SIZE, pixel)
}

fn at_rate(samples: u32) -> RenderSettings {
    RenderSettings {
        sample_rate: SampleRate::new(samples).unwrap(),
        outline: false,
        ..RenderSettings::default()
    }
}

fn by_areas() -> RenderSettings {
    RenderSettings {
        coverage: PixelCoverage::Exact,
        ..at_rate(1)
    }
}

fn hints(body: &str, settings: &RenderSettings, pixel: [u32; 2]) -> String {
    told_of(body, settings, pixel).help_lines().join("\n")
}

#[test]
fn what_is_missed_is_told_by_what_of_it_shows() {
    let bar = r#"<rect x="1" y="7.6" width="16" height="0.4"/>"#;
    let clip = r#"<clipPath id="c"><rect width="12.1" height="20"/></clipPath>"#;
    let mask = r##"<mask id="m" maskUnits="userSpaceOnUse" x="0" y="0" width="20" height="20"><rect width="12.1" height="20" fill="#fff"/></mask>"##;
    for (body, part) in [
        (bar.to_owned(), "40 %"),
        (format!(r#"{clip}<g clip-path="url(#c)">{bar}</g>"#), "about 4 %"),
        (format!(r#"{mask}<g mask="url(#m)">{bar}</g>"#), "about 4 %"),
        (format!(r#"<svg width="12.1" height="20">{bar}</svg>"#), "about 4 %"),
        // What lies on it is part of it once.
        (format!("{bar}{bar}{bar}"), "about 40 %"),
        (
            r##"<rect x="1" y="7.05" width="16" height="0.4"/><rect x="1" y="7.1" width="16" height="0.38" fill="#a00"/>"##
                .to_owned(),
            "about 43 %",
        ),
    ] {
        let told = hints(&body, &at_rate(1), [12, 7]);
        let expected = format!("What is thin passes between the samples here, {part}");
        assert!(told.contains(&expected), "{body}: {told}");
    }
}

#[test]
fn what_is_clipped_away_is_not_said_to_show() {
    let body = r#"<clipPath id="c"><rect width="12.1" height="20"/></clipPath>
        <g clip-path="url(#c)"><rect x="1" y="7.6" width="16" height="0.4"/></g>"#;
    let told = |pixel| told_of(body, &at_rate(1), pixel).missed_lines().join("\n");
    // The clip path itself, which covers a tenth of that pixel, is told besides.
    let (whole, part, nothing) = (told([5, 7]), told([12, 7]), told([13, 7]));
    let (part, clip) = part.split_once('\n').unwrap();
    assert!(
        clip.ends_with("covers 10 % of the pixel, and no sample; it is part of a clip path or mask"),
        "{clip}"
    );
    assert!(whole.ends_with("covers 40 % of the pixel, and no sample"), "{whole}");
    assert!(part.ends_with("no sample; about 4 % of the pixel shows it"), "{part}");
    assert!(nothing.ends_with("nothing of it shows there"), "{nothing}");
}

#[test]
fn what_hardly_shows_is_not_blamed() {
    // The edge of the black rectangle is what few samples get wrong; the stroke on it is all but transparent.
    let body = r##"<rect x="1" y="1.7" width="8" height="5"/>
        <path d="M1 1.75H9" stroke="#f00" stroke-width="0.3" stroke-opacity="0.04"/>"##;
    let told = hints(body, &at_rate(4), [2, 1]);
    assert!(told.contains("nearer") && !told.contains("px wide"), "{told}");
    // The white rectangle is thin, and as white as what it lies on; what sticks out below it is the line.
    let body =
        r##"<rect x="1" y="1.05" width="8" height="0.4"/><rect x="2.3" y="1" width="0.7" height="1" fill="#fff"/>"##;
    let told = hints(body, &at_rate(1), [2, 1]);
    assert!(
        told.contains("What is thin passes between the samples here, about 12 %"),
        "{told}"
    );
}

#[test]
fn what_passes_between_neighbours_is_the_reason() {
    let body = r##"<rect x="11" y="1" width="2.3" height="3" fill="#f00"/><rect x="13.3" y="1" width="0.2" height="3"/>
        <rect x="13.5" y="1" width="3" height="3" fill="#f00"/>"##;
    for rate in [1, 4] {
        let told = hints(body, &at_rate(rate), [13, 2]);
        let expected = "What is thin passes between the samples here, 20 % of the pixel: it breaks up.";
        assert!(told.contains(expected), "rate {rate}: {told}");
    }
}

/// A dot has no length in which it could break up.
#[test]
fn what_is_small_vanishes() {
    for dot in [
        r#"<circle cx="6.2" cy="6.3" r="0.17"/>"#,
        r#"<rect x="6.05" y="6.1" width="0.35" height="0.32"/>"#,
    ] {
        let told = hints(dot, &at_rate(1), [6, 6]);
        assert!(
            told.contains("What is small lies between the samples here, "),
            "{dot}: {told}"
        );
        assert!(told.contains(" of the pixel: it vanishes."), "{dot}: {told}");
        let met = dot
            .replace("6.2", "6.5")
            .replace("6.3", "6.5")
            .replace("6.05", "6.35")
            .replace("6.1", "6.35");
        let told = hints(&met, &at_rate(1), [6, 6]);
        assert!(
            told.contains(" px long, less than samples are apart (1 px): it vanishes where it lies"),
            "{met}: {told}"
        );
    }
    let line = hints(
        r#"<rect x="6.05" y="6.1" width="9" height="0.32"/>"#,
        &at_rate(1),
        [6, 6],
    );
    assert!(line.contains("it breaks up"), "{line}");
}

/// A document of the course's dialect.
fn told_of_course(body: &str, settings: &RenderSettings, pixel: [u32; 2]) -> Explanation {
    let document = format!(
        r##"<svg width="20" height="20"><rect x="0" y="0" width="20" height="20" fill="#FFFFFF"/>{body}</svg>"##
    );
    let scene = scene::read(document.as_bytes(), "reasons.svg", ReadOptions::default(), &NoResources).unwrap();
    advised(&scene, settings, SIZE, pixel)
}

/// Two triangles of one colour make a stripe that is wide, though each ends in a point.
#[test]
fn what_a_neighbour_continues_is_not_thin() {
    let triangle =
        |points: &str, color: &str| format!(r#"<colortri points="{points}" colors="{color} {color} {color}"/>"#);
    let stripe = |other: &str| triangle("8.4,1 10.3,1 10.3,19", "0 0 0 1") + &triangle("8.4,1 10.3,19 8.4,19", other);
    for (rate, pixel) in [(1, [8, 3]), (1, [10, 16]), (4, [8, 3]), (4, [10, 16])] {
        let told = told_of_course(&stripe("0 0 0 1"), &at_rate(rate), pixel);
        let words = told.help_lines().join("\n");
        assert!(!words.contains("breaks up"), "{rate}, {pixel:?}: {words}");
    }
    let alone = told_of_course(&triangle("8.7,1 8.9,1 8.9,19", "0 0 0 1"), &at_rate(1), [8, 3]);
    let words = alone.help_lines().join("\n");
    assert!(words.contains("breaks up"), "{words}");
}

#[test]
fn what_is_as_wide_as_samples_are_apart_is_not_thin() {
    let body = r##"<path d="M0 10L20 12.5" stroke="#000" stroke-width="1"/>"##;
    for y in 9..13 {
        let told = hints(body, &at_rate(1), [10, y]);
        assert!(!told.contains("px wide"), "{y}: {told}");
    }
}

#[test]
fn seams_between_areas_are_told_where_they_show() {
    let left = r##"<rect x="11" y="1" width="2.5" height="3" fill="#00f"/>"##;
    let right = r##"<rect x="13.5" y="1" width="3" height="3" fill="#00f"/>"##;
    let between = r##"<rect x="11" y="1" width="8" height="3" fill="#fff" fill-opacity="0.5"/>"##;
    let seam = |body: &str| hints(body, &by_areas(), [13, 2]).contains("shows through");
    assert!(seam(&format!("{left}{right}")), "two halves");
    assert!(
        !seam(&format!("{left}{between}{right}")),
        "what lies between takes its part"
    );
    assert!(!seam(&format!("{left}{right}{between}")), "and what lies above");
    let white = format!("{left}{right}").replace("#00f", "#fff");
    assert!(!seam(&white), "white on white");
}

#[test]
fn samples_are_advised_where_areas_make_a_seam_and_areas_where_no_rate_helps() {
    let body = r##"<rect x="11" y="1" width="2.5" height="3" fill="#00f"/><rect x="13.5" y="1" width="3" height="3" fill="#00f"/>"##;
    let told = hints(body, &by_areas(), [13, 2]);
    assert!(told.contains("Coverage by 16 samples: "), "{told}");
    let told = hints(
        body,
        &RenderSettings {
            sample_rate: SampleRate::new(64).unwrap(),
            ..by_areas()
        },
        [13, 2],
    );
    assert!(
        told.contains("Coverage by samples: "),
        "as many as are set already: {told}"
    );
}

#[test]
fn an_outline_that_was_cut_is_measured_whole() {
    let settings = RenderSettings {
        rules: Rules::Course,
        ..at_rate(4)
    };
    let found = told_of(
        r#"<polygon points="8,1 12,1 12,5 8,5" fill-opacity="0.5"/>"#,
        &settings,
        [9, 2],
    );
    let lines: Vec<String> = (0..found.paints.len())
        .flat_map(|paint| found.paint_lines(paint))
        .collect();
    let whole = "with the other triangles of its outline covers 100 % of the pixel's area, 100 % of its samples";
    assert!(lines.iter().any(|line| line == whole), "{lines:?}");
}

#[test]
fn a_truth_that_is_not_sure_says_so() {
    // Hammersley's points lie in rows along diagonals, and so do these lines.
    let lines: Vec<String> = (0..32)
        .map(|i| format!("M{} 0l20 20", f64::from(i) * 1.25 - 20.0))
        .collect();
    let hatch = format!(r##"<path d="{}" stroke="#000" stroke-width="0.375"/>"##, lines.concat());
    let found: Vec<Explanation> = (4..12).map(|x| told_of(&hatch, &at_rate(4), [x, 7])).collect();
    let unsure = |found: &&Explanation| found.truth.as_ref().is_some_and(|truth| truth.unsure > 6.0);
    let not_sure = found
        .iter()
        .find(unsure)
        .expect("a pixel of which 256 samples do not tell");
    let told = not_sure.help_lines().join("\n");
    assert!(
        told.contains("So many are too few to be sure here") && !told.contains("what it should be"),
        "{told}"
    );
    // Where it is as near as can be told, nothing was tried.
    let reached = found.iter().find(|found| {
        let truth = found.truth.as_ref();
        truth.is_some_and(|truth| truth.distance > 1.0 && truth.distance <= truth.unsure)
    });
    let told = reached.expect("a pixel nearer than is known").help_lines().join("\n");
    assert!(
        told.contains("too few to be sure here") && !told.contains("was tried"),
        "{told}"
    );
    for truth in found.iter().filter_map(|found| found.truth.as_ref()) {
        assert!(truth.cures.iter().all(|cure| cure.nearer > truth.unsure), "{truth:?}");
    }
    let even = told_of("", &at_rate(1), [10, 10]).help_lines().join("\n");
    let expected = "This pixel is what it should be: it has the colour of the truth (256 samples).";
    assert_eq!(even, expected, "white paper");
}

#[test]
fn one_sample_is_told_in_the_singular() {
    let body = r##"<rect x="4" y="4" width="8" height="8" fill="#0a0"/>"##;
    let text = told_of(body, &at_rate(1), [6, 6]).text(Detail::Telling);
    assert!(
        text.contains("paints the only sample") && !text.contains("1 samples"),
        "{text}"
    );
}

#[test]
fn a_curved_line_is_as_wide_as_it_was_drawn() {
    let width = |body: &str, pixel| {
        let told = told_of(body, &at_rate(1), pixel);
        told.paints.iter().find_map(|paint| paint.width)
    };
    for (body, pixel, expected) in [
        (
            r##"<circle cx="11.64" cy="11.64" r="5.01" fill="none" stroke="#000" stroke-width="0.17"/>"##,
            [15, 8],
            0.17,
        ),
        (
            r##"<path d="M1 12.58C6.93 19.11 14.91 5.6 19 14.65" fill="none" stroke="#000" stroke-width="0.28"/>"##,
            [14, 11],
            0.28,
        ),
        (
            r##"<circle cx="10.5" cy="6.5" r="1" fill="none" stroke="#000" stroke-width="0.15"/>"##,
            [10, 7],
            0.15,
        ),
        (r#"<rect x="6.45" width="0.2" height="20"/>"#, [6, 5], 0.2),
    ] {
        let found = width(body, pixel).unwrap_or_else(|| panic!("{body} is met"));
        assert!((found - expected).abs() < expected * 0.1, "{body}: {found}");
    }
}

#[test]
fn tiles_of_patterns_are_read_in_other_ways() {
    let pattern = r##"<pattern id="p" width="2.7" height="2.7" patternUnits="userSpaceOnUse" patternTransform="rotate(30)">
        <rect width="1.3" height="2.7" fill="#000"/></pattern><rect width="20" height="20" fill="url(#p)"/>"##;
    let told = hints(pattern, &at_rate(1), [9, 10]);
    assert!(told.contains("Pixel sampling "), "{told}");
    let flat = hints(r#"<rect width="9.5" height="20"/>"#, &at_rate(1), [9, 10]);
    assert!(!flat.contains("Pixel sampling "), "nothing is read there: {flat}");
}

#[test]
fn areas_give_way_to_as_many_samples_as_it_takes() {
    // A slit of a tenth of a pixel, of which areas let 28 % through, and 16 samples a quarter.
    let slit = r#"<rect x="2" y="2" width="6.6" height="16"/><rect x="8.7" y="2" width="6" height="16"/>"#;
    let told = told_of(slit, &by_areas(), [8, 5]);
    let truth = told.truth.as_ref().expect("little to draw");
    let cure = truth.cures.first().expect("some");
    assert!(cure.nearer > truth.distance * 0.7, "{cure:?} of {}", truth.distance);
    assert!(cure.samples.is_some_and(|samples| samples > 16), "{cure:?}");
    let told = told.help_lines().join("\n");
    assert!(
        told.contains("mixed as if each lay anywhere in it (conflation). Coverage by "),
        "{told}"
    );
}

#[test]
fn what_changes_nothing_is_not_said_to_show() {
    let multiplied = |fill: &str| {
        let body = format!(
            r##"<rect width="20" height="20" fill="#e00000"/><rect id="w" x="4" y="4" width="12" height="12" fill="{fill}" style="mix-blend-mode:multiply"/>"##
        );
        told_of(&body, &at_rate(1), [9, 9])
    };
    let text = |told: &Explanation| told.text(Detail::Telling);
    let white = multiplied("#fff");
    let sentence = white.pixel_lines().join("\n");
    assert!(
        sentence.contains("Its only sample shows 3 (polygon of rect"),
        "{sentence}"
    );
    assert!(
        text(&white).contains("its layer changes nothing of what is below it"),
        "{}",
        text(&white)
    );
    let grey = multiplied("#888").pixel_lines().join("\n");
    assert!(grey.contains(r#"rect "w""#), "{grey}");
    // The same colour once more is what shows all the same.
    let again = r##"<rect width="20" height="20" fill="#fff" id="again"/>"##;
    let again = told_of(again, &at_rate(1), [9, 9]).pixel_lines().join("\n");
    assert!(again.contains(r#"rect "again""#), "{again}");
}

#[test]
fn what_the_truth_does_not_meet_either_is_not_said_to_be_hidden() {
    let line = r##"<line x1="0" y1="13.0" x2="20" y2="17.7" stroke="#000" stroke-width="0.101"/>"##;
    let told = told_of(line, &at_rate(1), [17, 16]).missed_lines().join("\n");
    assert!(told.ends_with("of the pixel, and no sample"), "{told}");
    let hidden =
        format!(r#"<rect x="9.6" width="0.3" height="20"/><rect x="9.55" width="0.4" height="20" fill="red"/>{line}"#);
    let told = told_of(&hidden, &at_rate(1), [9, 3]).missed_lines().join("\n");
    assert!(told.contains("; nothing of it shows there"), "{told}");
}

#[test]
fn the_only_sample_is_told_in_the_singular() {
    let mask = r##"<mask id="m"><rect width="20" height="20" fill="#888"/></mask><rect width="20" height="20" mask="url(#m)"/>"##;
    let told = told_of(mask, &at_rate(1), [9, 9]).text(Detail::Telling);
    let told = told.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(told.contains("it takes a part of the only sample"), "{told}");
}

#[test]
fn what_a_mask_takes_between_samples_is_told() {
    let masked = |slit: &str, content: &str| {
        let body = format!(
            r##"<mask id="m" maskUnits="userSpaceOnUse" x="0" y="0" width="20" height="20"><rect width="20" height="20" fill="#fff"/>{slit}</mask>{content}"##
        );
        told_of(&body, &at_rate(1), [8, 8])
    };
    let slit = r#"<rect x="8.7" width="0.2" height="20"/>"#;
    let content = r##"<rect x="1" y="1" width="18" height="18" fill="#006" mask="url(#m)"/>"##;
    let told = masked(slit, content);
    let missed = told.missed_lines().join("\n");
    assert!(
        missed.contains("covers 20 % of the pixel, and no sample; it is part of a clip path or mask"),
        "{missed}"
    );
    let help = told.help_lines().join("\n");
    assert!(
        help.contains("What is thin passes between the samples here, 20 %"),
        "{help}"
    );
    // A mask of something that does not reach the pixel changes nothing there.
    let far = masked(
        slit,
        r##"<rect x="12" y="1" width="4" height="18" fill="#006" mask="url(#m)"/>"##,
    );
    assert!(far.missed.is_empty(), "{:?}", far.missed);
    let clip = r#"<clipPath id="c"><path d="M8.6 0h12v20h-12z"/></clipPath><rect width="20" height="20" clip-path="url(#c)"/>"#;
    let clipped = told_of(clip, &at_rate(1), [8, 8]).missed_lines().join("\n");
    assert!(clipped.contains("covers 40 % of the pixel, and no sample"), "{clipped}");
}

#[test]
fn a_shape_beside_another_of_its_colour_is_not_blamed() {
    let slit = r#"<rect x="2" y="2" width="6.6" height="16"/><rect x="8.7" y="2" width="6" height="16"/>"#;
    let told = hints(slit, &at_rate(1), [8, 5]);
    assert!(
        !told.contains("by area"),
        "a tenth of the pixel is missing, not 40 %: {told}"
    );
    let alone = hints(r#"<rect x="2" y="2" width="6.6" height="16"/>"#, &at_rate(1), [8, 5]);
    assert!(alone.contains("covers 100 % of the pixel; by area, 60 %"), "{alone}");
}

/// A line of a document may hold all of its elements.
#[test]
fn advice_numbers_what_it_names() {
    let wide = r#"<rect x="2" y="2" width="6.6" height="16"/>"#;
    let told = hints(wide, &at_rate(1), [8, 5]);
    let expected = "By its samples 2 (polygon of rect, line 1) covers 100 % of the pixel; by area, 60 %.";
    assert!(told.contains(expected), "{told}");
    let thin = r#"<rect x="8.4" y="2" width="0.2" height="16"/>"#;
    let told = hints(thin, &at_rate(1), [8, 5]);
    let expected = "Here 2 (polygon of rect, line 1) is 0.2 px wide, less than samples are apart (1 px): it breaks up";
    assert!(told.contains(expected), "{told}");
    let steep = r##"<linearGradient id="g" gradientUnits="userSpaceOnUse" x1="8" x2="9"><stop offset="0.7"/><stop offset="0.7" stop-color="#fff"/></linearGradient><rect x="8" width="8" height="20" fill="url(#g)"/>"##;
    let once = RenderSettings {
        shading: ShadingRate::Centre,
        ..at_rate(16)
    };
    let told = hints(steep, &once, [8, 5]);
    let expected =
        "For the whole pixel 2 (polygon of rect, line 1) is shaded once, not at each of its samples. Shading per";
    assert!(told.contains(expected), "{told}");
}

/// A tent of radius 1 is 0 at the middles of the neighbours, which is where areas count.
#[test]
fn a_filter_that_takes_one_pixel_says_so() {
    let settings = RenderSettings {
        resolve_filter: ResolveFilter::Tent,
        ..by_areas()
    };
    let told = told_of(r#"<rect x="2" y="2" width="6.6" height="16"/>"#, &settings, [8, 5]);
    let lines = told.resolve_lines();
    assert_eq!(
        lines[0],
        "Filter tent, radius 1: this pixel weighs 1, and no other weighs anything."
    );
    assert!(!lines.join("\n").contains("Each pixel weighs"), "{lines:?}");
}

/// All samples of the pattern lie where this filter weighs less than nothing.
#[test]
fn a_filter_whose_weights_add_up_to_too_little_is_said_to_be_set_aside() {
    let settings = |radius| RenderSettings {
        resolve_filter: ResolveFilter::Lanczos3,
        filter_radius: FilterRadius::new(radius),
        pattern: patterns::named("msaa-8").expect("it comes with the program"),
        ..at_rate(8)
    };
    let body = r#"<path d="M2 2 18 4 7 17z"/>"#;
    let told = told_of(body, &settings(0.5), [7, 3]);
    let lines = told.resolve_lines();
    assert_eq!(
        lines[0],
        "Filter lanczos3, radius 0.5: set aside here, for its weights add up to less than an eighth of what even ones do: the pixel is \
         the mean of its own samples."
    );
    assert!(told.resolve.around.expect("a wide filter").is_own_mean);
    let told = told_of(body, &settings(3.0), [7, 3]);
    let lines = told.resolve_lines();
    assert!(!lines[0].contains("set aside"), "{lines:?}");
}

#[test]
fn the_only_sample_on_an_edge_is_given_away_by_the_top_left_rule() {
    let by_rule = "and is the neighbour's by the top-left rule";
    for (body, pixel, told) in [
        // Each orientation of an edge that is not owned.
        (
            r#"<rect x="1" y="1" width="7.5" height="9"/>"#,
            [8, 5],
            format!("covers 50 % of the pixel, and no sample: the only one lies exactly on its right edge, {by_rule}"),
        ),
        (
            r#"<rect x="1" y="1" width="9" height="7.5"/>"#,
            [5, 8],
            format!("covers 50 % of the pixel, and no sample: the only one lies exactly on its bottom edge, {by_rule}"),
        ),
        (
            r#"<rect x="1" y="1" width="7.5" height="7.5"/>"#,
            [8, 8],
            format!("covers 25 % of the pixel, and no sample: the only one lies exactly on its last corner, {by_rule}"),
        ),
        (
            r#"<path d="M8.5 8.5L11 11L6 11z"/>"#,
            [8, 8],
            format!(
                "covers 25 % of the pixel, and no sample: the only one lies exactly on a corner that points up, where a right edge begins, {by_rule}"
            ),
        ),
        (
            r#"<path d="M8.5 8.5L11 6L6 6z"/>"#,
            [8, 8],
            format!("covers 25 % of the pixel, and no sample: the only one lies exactly on its last corner, {by_rule}"),
        ),
        (
            r#"<polygon points="0,0 20,0 0,20"/>"#,
            [9, 10],
            format!("covers 50 % of the pixel, and no sample: the only one lies exactly on its right edge, {by_rule}"),
        ),
        (
            r#"<polygon points="0,20 0,0 20,0"/>"#,
            [9, 10],
            format!("covers 50 % of the pixel, and no sample: the only one lies exactly on its right edge, {by_rule}"),
        ),
        (
            r#"<path d="M8.5 1V12H1V1Z M3 3V4H4V3Z" fill-rule="evenodd"/>"#,
            [8, 5],
            format!("covers 50 % of the pixel, and no sample: the only one lies exactly on its right edge, {by_rule}"),
        ),
        // Beside it, and on none.
        (
            r#"<rect x="1" y="1" width="7.49" height="9"/>"#,
            [8, 5],
            "covers 49 % of the pixel, and no sample".to_owned(),
        ),
    ] {
        let missed = told_of(body, &at_rate(1), pixel).missed_lines().join("\n");
        let told = format!(" {told}");
        assert!(missed.contains(&told), "{body}: {missed}");
        assert!(told.contains(':') || !missed.contains("exactly"), "{body}: {missed}");
    }
    // Edges that own their line have the sample.
    for body in [
        r#"<rect x="8.5" y="1" width="9" height="9"/>"#,
        r#"<rect x="1" y="5.5" width="9" height="9"/>"#,
        r#"<polygon points="20,0 20,20 -2,16"/>"#,
    ] {
        let told = told_of(body, &at_rate(1), [8, 5]);
        assert!(!told.missed_lines().join("\n").contains("exactly"), "{body}");
    }
}

#[test]
fn samples_on_an_edge_are_told_by_the_rules_in_force() {
    let body = r#"<rect x="1" y="1" width="7.25" height="9"/>"#;
    let told = told_of(body, &at_rate(4), [8, 5]).missed_lines().join("\n");
    assert!(
        told.ends_with(
            "and no sample: samples 1, 3 lie exactly on its right edge, and are the neighbours' by the top-left rule"
        ),
        "{told}"
    );
    let by = |rules| RenderSettings { rules, ..at_rate(4) };
    let told = told_of(body, &by(Rules::Float), [8, 5]).missed_lines().join("\n");
    assert!(
        told.ends_with("on its right edge, and are nobody's: the float rules have none for ties"),
        "{told}"
    );
    let told = told_of(body, &by(Rules::Course), [8, 5]);
    assert!(told.missed.is_empty(), "every edge owns its line: {:?}", told.missed);
}

/// An image is two triangles: the sample on their common edge is one's, and that is no miss of the image.
#[test]
fn what_is_missed_of_an_image_is_a_triangle_of_it() {
    let image = "<image width='20' height='20' preserveAspectRatio='none' href='data:image/png;base64,\
                 iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAYAAAAfFcSJAAAADUlEQVR42mNk+M9QDwADhgGAWjR9awAAAABJRU5ErkJggg=='/>";
    let told = told_of(image, &at_rate(1), [10, 9]);
    let lines = told.missed_lines();
    assert!(
        lines.iter().all(|line| line.starts_with("triangle of image")),
        "{lines:?}"
    );
    assert_eq!(told.missed.iter().filter(|missed| missed.part).count(), lines.len());
    assert!(!lines.is_empty(), "one of them has no sample");
}

/// The truth is drawn by the same code, and lacks what that does not draw.
#[test]
fn what_is_not_drawn_is_not_part_of_the_truth() {
    let blurred = "<filter id='f'><feGaussianBlur stdDeviation='2'/></filter><rect x='5' y='5' width='10' height='10' filter='url(#f)'/>";
    let told = told_of(blurred, &at_rate(1), [3, 9]);
    let lines = told.help_lines();
    let expected = "The truth is that of what is drawn: filter (line 1) in the document is not.";
    assert!(lines.iter().any(|line| line == expected), "{lines:?}");
    let plain = hints("<rect x='5' y='5' width='10' height='10'/>", &at_rate(1), [3, 9]);
    assert!(!plain.contains("is not"), "{plain}");
}

#[test]
fn the_truth_under_a_filter_says_so() {
    let settings = RenderSettings {
        resolve_filter: ResolveFilter::Mitchell,
        ..at_rate(16)
    };
    let bar = "<rect x='5' y='5' width='10' height='10'/>";
    let told = hints(bar, &settings, [18, 18]);
    assert!(told.contains("(256 samples under the same mitchell filter)"), "{told}");
    assert!(
        hints(bar, &at_rate(16), [18, 18]).contains("(256 samples)"),
        "no filter to tell of"
    );
}

#[test]
fn too_much_to_draw_again_is_told() {
    let corners: Vec<String> = (0..600_000).map(|i| format!("{},{} ", i % 20, (i / 7) % 19)).collect();
    let polygon = format!("<polygon points='{}'/>", corners.concat());
    let told = told_of(&polygon, &at_rate(1), [10, 9]);
    assert_eq!(told.truth, None);
    let lines = told.help_lines();
    assert!(
        lines.len() == 1 && lines[0].starts_with("No setting was tried: 600"),
        "{lines:?}"
    );
}
