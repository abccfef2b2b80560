//! What `benches/llvmpipe` draws: meshes in pixels as raw arrays.

use std::fs;
use std::io;
use std::path::Path;

use rasterscope::color::Rgba;
use rasterscope::geometry::View;
use rasterscope::render::RenderSettings;
use rasterscope::scene::{Fill, Paint, PrimitiveKind, Scene};
use rasterscope::texture::{Anisotropy, LevelSampling, PixelSampling};
use serde_json::json;

use super::{Case, Export};
use crate::ours::settings;
use crate::race::Budget;
use crate::scenes::FRAMES;
use crate::scenes::{flat, mesh};

/// Times every scene on two threads and writes it into `folder`, with `scenes.json` that lists them.
pub(super) fn export(folder: &Path, budget: Budget) -> io::Result<()> {
    let mut export = Export::new(folder, budget)?;
    for size in FRAMES {
        for scene in flat::all(size) {
            export.add_mesh("flat", scene.name, &scene.read(), size)?;
        }
        for mesh::MeshScene { name, scene } in mesh::textured(size) {
            export.add_mesh("textured", name, &scene, size)?;
        }
        for mesh::MeshScene { name, scene } in mesh::colored(size) {
            export.add_mesh("colored", name, &scene, size)?;
        }
    }
    let base = mesh::texture();
    let level = &base.pyramid.levels()[0];
    let texels = (0..level.height().cast_signed()).flat_map(|y| (0..level.width().cast_signed()).map(move |x| (x, y)));
    let bytes: Vec<u8> = texels.flat_map(|(x, y)| level.texel(x, y)).collect();
    fs::write(folder.join("texture.rgba"), bytes)?;
    export.finish(json!({ "texture": { "file": "texture.rgba", "side": mesh::TEXTURE_SIDE } }))
}

/// A sample rate, for which llvmpipe supersamples by the square root, a filter with the most taps of anisotropic filtering,
/// and whether llvmpipe's time has the mean of its samples in it.
fn case(rate: u32, (filter, taps): (&str, u32), downsampled: bool) -> Case {
    let (pixel_sampling, level_sampling) = match filter {
        "nearest" => (PixelSampling::Nearest, LevelSampling::Zero),
        "bilinear" => (PixelSampling::Bilinear, LevelSampling::Zero),
        _ => (PixelSampling::Bilinear, LevelSampling::Linear),
    };
    Case {
        settings: RenderSettings {
            pixel_sampling,
            level_sampling,
            anisotropy: Anisotropy::new(taps).unwrap_or_default(),
            ..settings(rate)
        },
        threads: 2,
        listed: json!({ "rate": rate, "filter": filter, "anisotropy": taps, "downsampled": downsampled }),
    }
}

/// How scenes of a kind are compared; without textures any filter is none.
fn cases(kind: &str) -> Vec<Case> {
    let trilinear = ("trilinear", 1);
    match kind {
        "flat" => vec![case(1, trilinear, true), case(16, trilinear, true)],
        "colored" => vec![case(1, trilinear, false), case(4, trilinear, false)],
        _ => vec![
            case(1, trilinear, true),
            case(16, trilinear, true),
            case(1, ("trilinear", 16), true),
            case(4, ("nearest", 1), false),
            case(16, ("nearest", 1), false),
            case(4, ("bilinear", 1), false),
            case(16, ("bilinear", 1), false),
        ],
    }
}

/// Corners of triangles, three by three.
#[derive(Default)]
struct Corners {
    /// Where they are, in pixels.
    points: Vec<u8>,
    /// Premultiplied colours or texture coordinates.
    attributes: Vec<u8>,
    translucent: bool,
}

impl Corners {
    fn of(scene: &Scene, size: [u32; 2]) -> Self {
        let view = View::Canvas.transform(scene.canvas, size);
        let mut corners = Self::default();
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
                corners.points.extend([place.x, place.y].map(f32::to_le_bytes).concat());
                match paint {
                    Paint::Solid(color) => corners.color(color),
                    Paint::Vertex(colors) => corners.color(colors[i]),
                    Paint::Texture { uv, .. } => {
                        corners
                            .attributes
                            .extend(uv[i].to_array().map(f32::to_le_bytes).concat());
                    }
                }
            }
        }
        corners
    }

    fn color(&mut self, color: Rgba) {
        self.translucent |= color.a < 1.0;
        let premultiplied = [color.r * color.a, color.g * color.a, color.b * color.a, color.a];
        self.attributes.extend(premultiplied.map(f32::to_le_bytes).concat());
    }
}

impl Export<'_> {
    fn add_mesh(&mut self, kind: &str, name: &str, scene: &Scene, size: [u32; 2]) -> io::Result<()> {
        let corners = Corners::of(scene, size);
        let entry = json!({
            "kind": kind, "name": name, "size": size, "translucent": corners.translucent,
            "points": self.write("points", &corners.points)?,
            "attributes": self.write("attributes", &corners.attributes)?,
            "ours": self.time(scene, size, &cases(kind))?,
        });
        self.entries.push(entry);
        Ok(())
    }
}
