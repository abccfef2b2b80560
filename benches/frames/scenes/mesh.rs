//! Scenes that only a rasterizer of triangles draws: textured meshes, a million tiny triangles, points.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DAffine2, DVec2, Vec2};
use rasterscope::color::Rgba;
use rasterscope::scene::{Dialect, Paint, Primitive, PrimitiveKind, Scene, ShapeId, TextureId};
use rasterscope::texture::{MipLevel, MipPyramid, Texture};

use super::chance::Chance;

/// Width and height of the texture of every mesh.
pub(crate) const TEXTURE_SIDE: u32 = 1024;

/// A scene and its name in tables.
#[derive(Debug)]
pub(crate) struct MeshScene {
    /// What tables call it.
    pub(crate) name: &'static str,
    /// Ready to draw; its canvas is the frame.
    pub(crate) scene: Scene,
}

/// A grid of cells over the unit square, each cut into two triangles, its inner corners moved by chance.
struct Grid {
    columns: u32,
    rows: u32,
    corners: Vec<DVec2>,
}

impl Grid {
    /// `wobble` in cells.
    fn new(columns: u32, rows: u32, wobble: f64, seed: u64) -> Self {
        let mut chance = Chance::new(seed);
        let mut move_by = |at: u32, count: u32| {
            let by = chance.range(-wobble, wobble);
            let free = at > 0 && at < count;
            (f64::from(at) + if free { by } else { 0.0 }) / f64::from(count)
        };
        let mut corners = Vec::new();
        for y in 0..=rows {
            for x in 0..=columns {
                corners.push(DVec2::new(move_by(x, columns), move_by(y, rows)));
            }
        }
        Self { columns, rows, corners }
    }

    /// Each triangle's corners: where it lies in the wobbly grid, and where it would lie in an even one.
    fn triangles(&self) -> impl Iterator<Item = [(DVec2, DVec2); 3]> + '_ {
        let corner = |x: u32, y: u32| {
            let even = DVec2::new(
                f64::from(x) / f64::from(self.columns),
                f64::from(y) / f64::from(self.rows),
            );
            (self.corners[(y * (self.columns + 1) + x) as usize], even)
        };
        (0..self.columns * self.rows).flat_map(move |i| {
            let (x, y) = (i % self.columns, i / self.columns);
            let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)];
            [[a, b, c], [b, d, c]]
        })
    }
}

/// The picture on every mesh: stripes, discs and grain, so that a wrong level or texel shows.
pub(crate) fn texture() -> Arc<Texture> {
    let mut chance = Chance::new(7);
    let texels = (0..TEXTURE_SIDE * TEXTURE_SIDE).map(|i| {
        let (x, y) = (i % TEXTURE_SIDE, i / TEXTURE_SIDE);
        let grain = chance.byte() / 8;
        let ramp = |at: u32| (at / 5).to_le_bytes()[0];
        let disc = (x % 128).abs_diff(64).pow(2) + (y % 128).abs_diff(64).pow(2) < 45 * 45;
        let stripe = if (x / 16 + y / 32) % 2 == 0 { 90 } else { 0 };
        [
            ramp(x) / 2 + stripe + grain,
            ramp(y) / 2 + grain,
            if disc { 220 } else { 40 } + grain,
            255,
        ]
    });
    let base = MipLevel::new(TEXTURE_SIDE, TEXTURE_SIDE, texels.collect());
    Arc::new(Texture::new("noise", MipPyramid::build(base)))
}

fn canvas(size: [u32; 2]) -> DVec2 {
    DVec2::new(f64::from(size[0]), f64::from(size[1]))
}

fn primitive(kind: PrimitiveKind) -> Primitive {
    Primitive {
        shape: ShapeId(0),
        kind,
    }
}

/// The textured meshes of the table, for frames of `size` pixels.
pub(crate) fn textured(size: [u32; 2]) -> Vec<MeshScene> {
    let texture = texture();
    let whole = DAffine2::from_scale(canvas(size));
    let mut magnified = Mesh::new("magnified", size, &texture);
    magnified.add(&Grid::new(50, 50, 0.3, 11), whole, [0.3, 0.55]);
    let mut even = Mesh::new("one to one", size, &texture);
    let turn = DAffine2::from_translation(canvas(size) / 2.0)
        * DAffine2::from_scale_angle_translation(DVec2::splat(1100.0), 0.5, DVec2::ZERO)
        * DAffine2::from_translation(DVec2::splat(-0.5));
    even.add(&Grid::new(71, 71, 0.3, 12), turn, [0.0, 1.0]);
    let mut minified = Mesh::new("minified", size, &texture);
    for tile in 0..16 {
        let place = DVec2::new(f64::from(tile % 4), f64::from(tile / 4)) / 4.0;
        let quarter = DAffine2::from_scale(canvas(size))
            * DAffine2::from_translation(place)
            * DAffine2::from_scale(DVec2::splat(0.25));
        minified.add(&Grid::new(25, 25, 0.3, 13), quarter, [0.0, 1.0]);
    }
    [magnified, even, minified].map(|mesh| mesh.0).into()
}

/// Meshes with a colour at each corner, for frames of `size` pixels: large triangles around a point, and small ones in rows.
pub(crate) fn colored(size: [u32; 2]) -> Vec<MeshScene> {
    let mut chance = Chance::new(41);
    let mut color = || Rgba::from_bytes([chance.byte(), chance.byte(), chance.byte(), 255]);
    let triangle = |points, colors| {
        primitive(PrimitiveKind::Triangle {
            points,
            paint: Paint::Vertex(colors),
        })
    };
    let (center, radius) = (canvas(size) / 2.0, canvas(size).min_element() * 0.48);
    let rim: Vec<(DVec2, Rgba)> = (0..48)
        .map(|i| (center + DVec2::from_angle(f64::from(i) * TAU / 48.0) * radius, color()))
        .collect();
    let mut wheel = Scene::empty(canvas(size), Dialect::Svg);
    wheel.primitives = (0..rim.len())
        .map(|i| {
            let (a, b) = (rim[i], rim[(i + 1) % rim.len()]);
            triangle([center, a.0, b.0], [Rgba::WHITE, a.1, b.1])
        })
        .collect();
    let mut rows = Scene::empty(canvas(size), Dialect::Svg);
    rows.primitives = Grid::new(40, 40, 0.3, 42)
        .triangles()
        .map(|corners| {
            let points = corners.map(|(wobbly, _)| wobbly * canvas(size));
            triangle(points, [color(), color(), color()])
        })
        .collect();
    vec![
        MeshScene {
            name: "wheel",
            scene: wheel,
        },
        MeshScene {
            name: "colour mesh",
            scene: rows,
        },
    ]
}

/// A textured mesh in the making.
struct Mesh(MeshScene);

impl Mesh {
    fn new(name: &'static str, size: [u32; 2], texture: &Arc<Texture>) -> Self {
        let mut scene = Scene::empty(canvas(size), Dialect::Svg);
        scene.textures = Arc::new([Arc::clone(texture)]);
        Self(MeshScene { name, scene })
    }

    /// The grid at `place`, with the part `from..to` of the texture on it.
    fn add(&mut self, grid: &Grid, place: DAffine2, [from, to]: [f32; 2]) {
        let kinds = grid.triangles().map(|corners| PrimitiveKind::Triangle {
            points: corners.map(|(wobbly, _)| place.transform_point2(wobbly)),
            paint: Paint::Texture {
                texture: TextureId(0),
                uv: corners.map(|(_, even)| Vec2::splat(from) + even.as_vec2() * (to - from)),
                opacity: 1.0,
            },
        });
        self.0.scene.primitives.extend(kinds.map(primitive));
    }
}

/// A million triangles of two pixels' area, once as a mesh that fills the frame, once two pixels wide and strewn.
pub(crate) fn million(size: [u32; 2]) -> Vec<MeshScene> {
    let mut chance = Chance::new(21);
    let mut color = || Paint::Solid(Rgba::from_bytes([chance.byte(), chance.byte(), chance.byte(), 255]));
    let mut mesh = Scene::empty(canvas(size), Dialect::Svg);
    mesh.primitives = Grid::new(1000, 500, 0.3, 22)
        .triangles()
        .map(|corners| {
            primitive(PrimitiveKind::Triangle {
                points: corners.map(|(wobbly, _)| wobbly * canvas(size)),
                paint: color(),
            })
        })
        .collect();
    let mut place = Chance::new(23);
    let mut strewn = Scene::empty(canvas(size), Dialect::Svg);
    strewn.primitives = (0..1_000_000)
        .map(|_| {
            let at = canvas(size) * DVec2::new(place.unit(), place.unit());
            let mut corner = || at + DVec2::new(place.range(0.0, 2.0), place.range(0.0, 2.0));
            primitive(PrimitiveKind::Triangle {
                points: [corner(), corner(), corner()],
                paint: color(),
            })
        })
        .collect();
    vec![
        MeshScene {
            name: "mesh",
            scene: mesh,
        },
        MeshScene {
            name: "strewn",
            scene: strewn,
        },
    ]
}

/// 20 000 points.
pub(crate) fn points(size: [u32; 2]) -> MeshScene {
    let mut chance = Chance::new(31);
    let mut scene = Scene::empty(canvas(size), Dialect::Course);
    scene.primitives = (0..20_000)
        .map(|_| {
            primitive(PrimitiveKind::Point {
                at: canvas(size) * DVec2::new(chance.unit(), chance.unit()),
                color: Rgba::from_bytes([chance.byte(), chance.byte(), chance.byte(), 255]),
            })
        })
        .collect();
    MeshScene { name: "points", scene }
}
