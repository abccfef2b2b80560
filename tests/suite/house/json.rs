//! The reference of JSON names every field that explanations and benchmarks have.

use std::collections::BTreeSet;
use std::path::Path;

use serde_json::Value;

use crate::support::program::done;

const PAGE: &str = include_str!("../../../src/cli/help/json.md");

/// Pixels that show all kinds of values: scene, pixel, and options.
const PIXELS: [(&str, &str, &str); 12] = [
    (
        "study/07_checker_floor",
        "150,200",
        "--level-sampling linear --pixel-sampling bilinear",
    ),
    (
        "study/07_checker_floor",
        "150,200",
        "--level-sampling ewa --lod-bias 0.5",
    ),
    ("study/07_checker_floor", "150,200", "--level-sampling summed-area"),
    (
        "study/07_checker_floor",
        "150,200",
        "--level-sampling ripmap --texture-wrap mirror",
    ),
    (
        "study/13_thin_rays",
        "150,140",
        "--sample-rate 4 --resolve-filter mitchell",
    ),
    ("study/13_thin_rays", "150,140", "--post-process smaa"),
    ("study/31_seams_of_a_mesh", "150,150", "--coverage exact"),
    ("basic/test4", "150,150", "--sample-rate 4 --shading-rate centroid"),
    ("vector/02_city_map", "150,150", "--sample-rate 4"),
    ("vector/03_plot", "150,150", "--sample-rate 4"),
    ("illustration/01_lighthouse", "150,150", "--sample-rate 4"),
    ("illustration/02_fox", "150,150", "--rules float"),
];

fn keys(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(fields) => {
            for (name, value) in fields {
                found.insert(name.clone());
                keys(value, found);
            }
        }
        Value::Array(values) => values.iter().for_each(|value| keys(value, found)),
        _ => {}
    }
}

#[test]
fn help_names_every_field_of_json() {
    let mut found = BTreeSet::new();
    let mut add = |text: &str| keys(&serde_json::from_str(text).expect("JSON"), &mut found);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    for (scene, pixel, options) in PIXELS {
        let scene = format!("gallery:{scene}.svg");
        let mut words = vec!["inspect", &scene, "--size", "300x300", "--pixel", pixel, "--json"];
        words.extend(options.split(' '));
        add(&done(folder, &words));
    }
    add(&done(
        folder,
        &[
            "bench",
            "gallery:basic/test4.svg",
            "--size",
            "32x32",
            "--frames",
            "1",
            "--json",
        ],
    ));
    assert!(found.len() > 90, "{} fields", found.len());
    found.retain(|name| !PAGE.contains(&format!("`{name}`")));
    assert_eq!(
        found,
        BTreeSet::new(),
        "fields that `rasterscope help json` does not name"
    );
}
