//! What mip levels are: what of a footprint the level of detail follows, in which values levels were averaged, and by which filter;
//! on scenes where each choice is nearer to the truth, and where it is not.

use std::path::Path;
use std::process::Command;

/// The distance from the truth of a scene of the gallery at one sample per pixel, with each of these values of an option.
fn rmse<const VALUES: usize>(scene: &str, option: &str, values: [&str; VALUES], others: &[&str]) -> [f64; VALUES] {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .arg("sweep")
        .arg(root.join(scene))
        .args([option, &values.join(","), "--frames", "1", "--size", "256x256"])
        .args([
            "--pixel-sampling",
            "bilinear",
            "--level-sampling",
            "linear",
            "--csv",
            "by.csv",
        ])
        .args(others)
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table = std::fs::read_to_string(folder.path().join("by.csv")).unwrap();
    let mut names = table.lines().next().unwrap().split(',');
    let column = names.position(|name| name == "rmse").unwrap();
    values.map(|value| {
        let line = table.lines().find(|line| line.starts_with(value)).unwrap();
        line.split(',').nth(column).unwrap().parse().unwrap()
    })
}

#[test]
fn area_keeps_far_streets_and_makes_squares_sparkle() {
    let extents = ["longer", "area", "shorter"];
    let [longer, area, _] = rmse("svg/study/11_city_floor.svg", "--lod-by", extents, &[]);
    assert!(
        area < 0.8 * longer,
        "streets: {area} by area, {longer} by the longer side"
    );
    let [longer, area, shorter] = rmse("svg/study/08_checker_fan.svg", "--lod-by", extents, &[]);
    assert!(
        area > 1.2 * longer && shorter > area,
        "squares: {longer}, {area}, {shorter}"
    );
}

#[test]
fn levels_averaged_as_samples_are_nearer_to_the_truth() {
    for space in ["stored", "linear"] {
        let options = ["--resolve", space];
        let [stored, linear] = rmse(
            "svg/study/07_checker_floor.svg",
            "--pyramid",
            ["stored", "linear"],
            &options,
        );
        let [same, other] = if space == "stored" {
            [stored, linear]
        } else {
            [linear, stored]
        };
        assert!(
            same < 0.8 * other,
            "{space}: {same} with its own, {other} with the other"
        );
    }
}

#[test]
fn softer_levels_help_where_they_are_read_too_finely_and_sharper_ones_where_they_are_not() {
    let filters = ["box", "tent", "kaiser"];
    let rings = "svg/study/06_zone_texture.svg";
    let [mean, tent, _] = rmse(rings, "--pyramid-filter", filters, &["--lod-bias", "-1"]);
    assert!(tent < 0.85 * mean, "a level too fine: {mean}, by a tent {tent}");
    let [mean, _, kaiser] = rmse(rings, "--pyramid-filter", filters, &["--sample-rate", "16"]);
    assert!(
        kaiser < 0.97 * mean,
        "samples enough: {mean}, by a Kaiser window {kaiser}"
    );
    let [mean, tent, kaiser] = rmse("svg/study/07_checker_floor.svg", "--pyramid-filter", filters, &[]);
    assert!(
        tent > 1.5 * mean && kaiser > 1.2 * mean,
        "squares of whole texels: {mean}, {tent}, {kaiser}"
    );
}
