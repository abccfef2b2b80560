//! Small documents, and what is in the scenes that they become.

use rasterscope::scene::{self, DialectChoice, NoResources, PrimitiveKind, ReadOptions, Scene, SceneError};

/// A document with these attributes of the root element, and this inside.
pub(crate) fn svg(attributes: &str, body: &str) -> String {
    format!("<svg xmlns='http://www.w3.org/2000/svg' {attributes}>{body}</svg>")
}

/// Reads bytes without any other files.
pub(crate) fn try_read(document: &[u8], dialect: DialectChoice) -> Result<Scene, SceneError> {
    scene::read(document, "test.svg", ReadOptions { dialect }, &NoResources)
}

/// Reads a document that has no faults.
pub(crate) fn read(document: &str, dialect: DialectChoice) -> Scene {
    try_read(document.as_bytes(), dialect).expect("a scene")
}

/// The scene of a document of 100 x 100 units in the dialect `svg`, with this inside.
pub(crate) fn svg_scene(body: &str) -> Scene {
    read(&svg("width='100' height='100'", body), DialectChoice::Svg)
}

/// The primitives without their shapes.
pub(crate) fn kinds(scene: &Scene) -> Vec<PrimitiveKind> {
    scene
        .primitives
        .iter()
        .map(|primitive| primitive.kind.clone())
        .collect()
}

/// The lines of the report.
pub(crate) fn lines(scene: &Scene) -> Vec<String> {
    scene.report.lines().collect()
}

/// The sum of the areas of all triangles and polygons.
pub(crate) fn area(scene: &Scene) -> f64 {
    let of_one = |kind: &PrimitiveKind| match kind {
        PrimitiveKind::Triangle { points: [a, b, c], .. } => (b - a).perp_dot(c - a).abs() / 2.0,
        PrimitiveKind::Polygon { polygon, .. } => polygon.area().expect("few crossings"),
        _ => 0.0,
    };
    scene.primitives.iter().map(|primitive| of_one(&primitive.kind)).sum()
}
