//! What `benches/skia` draws: polygons and lines in user units.

use std::io;
use std::path::Path;

use rasterscope::scene::Scene;
use serde_json::{Value, json};

use super::{Case, Export};
use crate::ours::settings;
use crate::race::Budget;
use crate::scenes::FRAMES;
use crate::scenes::{flat, strokes};

/// A scene for Skia; its kind decides the row.
struct Drawing<'a> {
    kind: &'a str,
    name: &'a str,
    canvas: [f64; 2],
    shapes: Vec<Value>,
    /// Samples per pixel in ours; Skia antialiases where there are more than one.
    rates: &'a [u32],
}

/// Times every scene and writes it into `folder`, with `scenes.json` that lists them.
pub(super) fn export(folder: &Path, budget: Budget) -> io::Result<()> {
    let mut export = Export::new(folder, budget)?;
    for size in FRAMES {
        for scene in flat::all(size) {
            let shapes = scene.polygons.iter();
            let drawing = Drawing {
                kind: "fills",
                name: scene.name,
                canvas: scene.canvas,
                shapes: shapes
                    .map(|polygon| json!({ "points": polygon.corners, "closed": true, "color": polygon.color }))
                    .collect(),
                rates: &[1],
            };
            export.add_drawing(&drawing, &scene.read(), size)?;
        }
        for scene in strokes::all(size) {
            let drawing = Drawing {
                kind: scene.kind,
                name: scene.name,
                canvas: scene.canvas,
                shapes: vec![json!({
                    "points": scene.points, "closed": scene.closed, "color": [0, 0, 0, 255],
                    // Skia's hairlines have no width.
                    "width": scene.width.unwrap_or(0.0),
                })],
                // A hairline of ours is the same pixels at any rate.
                rates: if scene.width.is_some() { &[1, 16] } else { &[1] },
            };
            export.add_drawing(&drawing, &scene.read(), size)?;
        }
    }
    export.finish(json!({}))
}

impl Export<'_> {
    fn add_drawing(&mut self, drawing: &Drawing<'_>, scene: &Scene, size: [u32; 2]) -> io::Result<()> {
        let both = drawing.rates.iter().flat_map(|rate| [(*rate, 2), (*rate, 1)]);
        let cases: Vec<Case> = both
            .map(|(rate, threads)| Case {
                settings: settings(rate),
                threads,
                listed: json!({ "rate": rate, "threads": threads }),
            })
            .collect();
        let entry = json!({
            "kind": drawing.kind, "name": drawing.name, "size": size, "canvas": drawing.canvas,
            "shapes": drawing.shapes, "ours": self.time(scene, size, &cases)?,
        });
        self.entries.push(entry);
        Ok(())
    }
}
