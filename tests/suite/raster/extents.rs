//! What of a footprint the level of detail follows: where its area is nearer to the truth than its longer side, and where not.

use std::path::Path;
use std::process::Command;

/// The distance from the truth of a scene of the gallery at one sample per pixel, by each extent.
fn rmse(scene: &str) -> [f64; 3] {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let output = Command::new(env!("CARGO_BIN_EXE_rasterscope"))
        .arg("sweep")
        .arg(root.join(scene))
        .args(["--lod-by", "longer,area,shorter", "--frames", "1", "--size", "256x256"])
        .args([
            "--pixel-sampling",
            "bilinear",
            "--level-sampling",
            "linear",
            "--csv",
            "by.csv",
        ])
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table = std::fs::read_to_string(folder.path().join("by.csv")).unwrap();
    let column = table
        .lines()
        .next()
        .unwrap()
        .split(',')
        .position(|name| name == "rmse")
        .unwrap();
    let of = |extent: &str| -> f64 {
        let line = table.lines().find(|line| line.starts_with(extent)).unwrap();
        line.split(',').nth(column).unwrap().parse().unwrap()
    };
    ["longer", "area", "shorter"].map(of)
}

#[test]
fn area_keeps_far_streets_and_makes_squares_sparkle() {
    let [longer, area, _] = rmse("svg/study/11_city_floor.svg");
    assert!(
        area < 0.8 * longer,
        "streets: {area} by area, {longer} by the longer side"
    );
    let [longer, area, shorter] = rmse("svg/study/08_checker_fan.svg");
    assert!(
        area > 1.2 * longer && shorter > area,
        "squares: {longer}, {area}, {shorter}"
    );
}
