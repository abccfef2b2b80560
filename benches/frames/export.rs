//! What `benches/llvmpipe` draws: meshes in pixels as raw arrays, our pictures of them, and our times.

use std::fs;
use std::io;
use std::path::Path;

use rasterscope::render::RenderSettings;
use rasterscope::scene::{Fill, Paint, PrimitiveKind, Scene};
use rasterscope::texture::Anisotropy;
use serde_json::{Value, json};

use crate::ours::{Ours, pool, settings};
use crate::race::{Budget, Rival, race};
use crate::scenes::FRAMES;
use crate::scenes::{flat, mesh};

/// Sample rates of the comparison, for which llvmpipe supersamples by the square root, and the most taps of anisotropic
/// filtering: the last case is of textured scenes only.
const CASES: [(u32, u32); 3] = [(1, 1), (16, 1), (1, 16)];

/// The scenes of one folder.
struct Export<'a> {
    folder: &'a Path,
    budget: Budget,
    entries: Vec<Value>,
}

/// Times every scene on two threads and writes it into `folder`, with `scenes.json` that lists them.
pub(crate) fn export(folder: &Path, budget: Budget) -> io::Result<()> {
    fs::create_dir_all(folder)?;
    let mut export = Export {
        folder,
        budget,
        entries: Vec::new(),
    };
    for size in FRAMES {
        for scene in flat::all(size) {
            export.add("flat", scene.name, &scene.read(), size)?;
        }
        for mesh::MeshScene { name, scene } in mesh::textured(size) {
            export.add("textured", name, &scene, size)?;
        }
    }
    let base = mesh::texture();
    let level = &base.pyramid.levels()[0];
    let texels = (0..level.height().cast_signed()).flat_map(|y| (0..level.width().cast_signed()).map(move |x| (x, y)));
    let bytes: Vec<u8> = texels.flat_map(|(x, y)| level.texel(x, y)).collect();
    fs::write(folder.join("texture.rgba"), bytes)?;
    let list = json!({
        "texture": { "file": "texture.rgba", "side": mesh::TEXTURE_SIDE },
        "scenes": export.entries,
    });
    fs::write(folder.join("scenes.json"), list.to_string())
}

impl Export<'_> {
    fn add(&mut self, kind: &str, name: &str, scene: &Scene, size: [u32; 2]) -> io::Result<()> {
        let pool = pool(2);
        let cases = if kind == "textured" { &CASES[..] } else { &CASES[..2] };
        let draws = cases.iter().map(|(rate, taps)| {
            let settings = RenderSettings {
                anisotropy: Anisotropy::new(*taps).unwrap_or_default(),
                ..settings(*rate)
            };
            Ours::new(scene, size, settings, pool)
        });
        let mut ours: Vec<Ours<'_>> = draws.collect();
        let number = self.entries.len();
        let view = *ours[0].view();
        let (mut points, mut attributes, mut translucent) = (Vec::new(), Vec::new(), false);
        for primitive in &scene.primitives {
            let (triangles, paint) = match &primitive.kind {
                PrimitiveKind::Triangle { points, paint } => (std::slice::from_ref(points), *paint),
                PrimitiveKind::Polygon {
                    polygon,
                    fill: Fill::Solid(color),
                } => {
                    let triangles = polygon.triangles().expect("few crossings");
                    (triangles, Paint::Solid(*color))
                }
                _ => continue,
            };
            for (i, corner) in triangles.iter().flat_map(|corners| corners.iter().enumerate()) {
                let place = view.to_pixels(*corner).as_vec2();
                points.extend([place.x, place.y].map(f32::to_le_bytes).concat());
                match paint {
                    Paint::Solid(color) => {
                        translucent |= color.a < 1.0;
                        let premultiplied = [color.r * color.a, color.g * color.a, color.b * color.a, color.a];
                        attributes.extend(premultiplied.map(f32::to_le_bytes).concat());
                    }
                    Paint::Texture { uv, .. } => attributes.extend(uv[i].to_array().map(f32::to_le_bytes).concat()),
                    Paint::Vertex(_) => {}
                }
            }
        }
        let write = |what: &str, bytes: &[u8]| {
            let file = format!("{number}.{what}");
            fs::write(self.folder.join(&file), bytes).map(|()| file)
        };
        let (points, attributes) = (write("points", &points)?, write("attributes", &attributes)?);
        let draw = |ours: &mut Ours<'_>| {
            ours.draw();
        };
        let mut rivals: Vec<Rival<'_>> = ours.iter_mut().map(|ours| Rival::new(move || draw(ours))).collect();
        let timings = race(&mut rivals, self.budget);
        drop(rivals);
        let mut listed = Vec::new();
        for (((rate, taps), timing), ours) in cases.iter().zip(timings).zip(&ours) {
            let bytes: Vec<u8> = (0..size[1])
                .flat_map(|y| (0..size[0]).map(move |x| (x, y)))
                .flat_map(|(x, y)| ours.frame().rgba(x, y).unwrap_or_default())
                .collect();
            listed.push(json!({
                "rate": rate,
                "anisotropy": taps,
                "median_ms": timing.median,
                "min_ms": timing.min,
                "picture": write(&format!("at{rate}_{taps}.rgba"), &bytes)?,
            }));
        }
        self.entries.push(json!({
            "kind": kind, "name": name, "size": size, "translucent": translucent,
            "points": points, "attributes": attributes, "ours": listed,
        }));
        Ok(())
    }
}
