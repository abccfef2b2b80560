//! What mip levels are: what of a footprint the level of detail follows, and in which values levels were averaged; on scenes where
//! each choice is nearer to the truth, and where it is not.

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
