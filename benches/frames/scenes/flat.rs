//! Scenes of polygons in one colour each: what every peer can draw.

use std::f64::consts::TAU;
use std::fmt::Write as _;

use rasterscope::scene::{DialectChoice, NoResources, ReadOptions, Scene, read};

use super::chance::Chance;

/// A filled polygon.
#[derive(Debug)]
pub(crate) struct Polygon {
    /// Its corners in user units.
    pub(crate) corners: Vec<[f64; 2]>,
    /// Straight red, green, blue, alpha.
    pub(crate) color: [u8; 4],
}

/// Polygons in painter's order on a canvas.
#[derive(Debug)]
pub(crate) struct FlatScene {
    /// What tables call it.
    pub(crate) name: &'static str,
    /// Width and height in user units, in the proportions of the frame.
    pub(crate) canvas: [f64; 2],
    /// First to last.
    pub(crate) polygons: Vec<Polygon>,
}

/// Height of every canvas in user units; no frame has as many pixels, so that drawing is not free of a transform.
const HEIGHT: f64 = 700.0;

/// The flat scenes of the table, for frames of `size` pixels.
pub(crate) fn all(size: [u32; 2]) -> Vec<FlatScene> {
    vec![
        poster(size),
        plaid(size),
        illustration(size),
        gears(size),
        confetti(size),
        fans(size),
    ]
}

impl FlatScene {
    fn empty(name: &'static str, size: [u32; 2]) -> Self {
        Self {
            name,
            canvas: [HEIGHT * f64::from(size[0]) / f64::from(size[1]), HEIGHT],
            polygons: Vec::new(),
        }
    }

    fn add(&mut self, color: [u8; 4], corners: Vec<[f64; 2]>) {
        self.polygons.push(Polygon { corners, color });
    }

    /// A closed curve around `center`: one corner per radius, evenly spaced.
    fn ring(&mut self, color: [u8; 4], center: [f64; 2], radii: impl ExactSizeIterator<Item = f64>) {
        let step = TAU / radii.len() as f64;
        let corners = radii.enumerate().map(|(i, radius)| {
            let (sin, cos) = (i as f64 * step).sin_cos();
            [center[0] + radius * cos, center[1] + radius * sin]
        });
        self.add(color, corners.collect());
    }

    fn place(&self, chance: &mut Chance) -> [f64; 2] {
        self.canvas.map(|side| chance.range(0.0, side))
    }

    /// The scene as an SVG document; `attributes` go to its root.
    pub(crate) fn svg(&self, attributes: &str) -> String {
        let [width, height] = self.canvas;
        let mut text = format!(
            "<svg xmlns='http://www.w3.org/2000/svg' width='{width}' height='{height}' viewBox='0 0 {width} {height}' {attributes}>"
        );
        for Polygon { corners, color } in &self.polygons {
            let [r, g, b, a] = *color;
            text.push_str("<polygon points='");
            for [x, y] in corners {
                let _ = write!(text, "{x},{y} ");
            }
            let opacity = f64::from(a) / 255.0;
            let _ = write!(text, "' fill='#{r:02x}{g:02x}{b:02x}' fill-opacity='{opacity}'/>");
        }
        text.push_str("</svg>");
        text
    }

    /// The scene as the program reads it.
    pub(crate) fn read(&self) -> Scene {
        let options = ReadOptions {
            dialect: DialectChoice::Svg,
        };
        read(self.svg("").as_bytes(), self.name, options, &NoResources).expect("a good document")
    }
}

fn opaque(chance: &mut Chance) -> [u8; 4] {
    [chance.byte(), chance.byte(), chance.byte(), 255]
}

fn translucent(chance: &mut Chance, alpha: u8) -> [u8; 4] {
    [chance.byte(), chance.byte(), chance.byte(), alpha]
}

/// A few large polygons that overlap.
fn poster(size: [u32; 2]) -> FlatScene {
    let mut scene = FlatScene::empty("poster", size);
    let chance = &mut Chance::new(1);
    for _ in 0..9 {
        let (color, center) = (opaque(chance), scene.place(chance));
        let corners = 3 + usize::from(chance.byte() % 6);
        let radius = chance.range(120.0, 420.0);
        let radii: Vec<f64> = (0..corners).map(|_| radius * chance.range(0.7, 1.0)).collect();
        scene.ring(color, center, radii.into_iter());
    }
    scene
}

/// A hundred tilted stripes and squares, half of them translucent.
fn plaid(size: [u32; 2]) -> FlatScene {
    let mut scene = FlatScene::empty("plaid", size);
    let chance = &mut Chance::new(8);
    let [width, height] = scene.canvas;
    for i in 0..30 {
        let (y, thick) = (height * f64::from(i) / 30.0, chance.range(4.0, 16.0));
        let color = translucent(chance, if i % 2 == 0 { 255 } else { 120 });
        scene.add(
            color,
            vec![[0.0, y], [width, y + 60.0], [width, y + 60.0 + thick], [0.0, y + thick]],
        );
    }
    for i in 0..70 {
        let (center, radius) = (scene.place(chance), chance.range(10.0, 50.0));
        let color = translucent(chance, if i % 2 == 0 { 255 } else { 120 });
        scene.ring(color, center, [radius; 4].into_iter());
    }
    scene
}

/// Hills, houses, leaves and clouds: some hundreds of polygons of all sizes, one in five translucent.
fn illustration(size: [u32; 2]) -> FlatScene {
    let mut scene = FlatScene::empty("illustration", size);
    let chance = &mut Chance::new(2);
    let [width, height] = scene.canvas;
    for hill in 0..6 {
        let base = height * (0.35 + 0.11 * f64::from(hill));
        let (phase, waves) = (chance.range(0.0, TAU), chance.range(3.0, 9.0));
        let mut corners = vec![[width, height + 1.0], [0.0, height + 1.0]];
        corners.extend((0..=60).map(|i| {
            let x = f64::from(i) / 60.0;
            [x * width, base + 35.0 * (phase + waves * x).sin()]
        }));
        scene.add(opaque(chance), corners);
    }
    for _ in 0..90 {
        let [x, y] = scene.place(chance);
        let (w, h) = (chance.range(15.0, 60.0), chance.range(20.0, 80.0));
        let turn = chance.range(-4.0, 4.0);
        scene.add(
            opaque(chance),
            vec![
                [x, y],
                [x + w, y + turn],
                [x + w - turn, y + h],
                [x - turn, y + h - turn],
            ],
        );
        scene.add(
            opaque(chance),
            vec![[x - 4.0, y], [x + w / 2.0, y - h / 2.0], [x + w + 4.0, y + turn]],
        );
    }
    for leaf in 0..240 {
        let center = scene.place(chance);
        let alpha = if leaf % 3 == 0 { 140 } else { 255 };
        let color = translucent(chance, alpha);
        let (radius, lobes, phase) = (
            chance.range(5.0, 30.0),
            f64::from(3 + chance.byte() % 4),
            chance.range(0.0, TAU),
        );
        let radii = (0..32_u32).map(|i| radius * (1.0 + 0.45 * (phase + lobes * f64::from(i) / 32.0 * TAU).sin()));
        scene.ring(color, center, radii.collect::<Vec<_>>().into_iter());
    }
    scene
}

/// Concave polygons of 120 corners.
fn gears(size: [u32; 2]) -> FlatScene {
    let mut scene = FlatScene::empty("gears", size);
    let chance = &mut Chance::new(3);
    for gear in 0..20 {
        let center = scene.place(chance);
        let color = translucent(chance, if gear % 4 == 0 { 160 } else { 255 });
        let radius = chance.range(40.0, 170.0);
        let radii = (0..120_u32).map(|i| if i / 3 % 2 == 0 { radius } else { radius * 0.86 });
        scene.ring(color, center, radii.collect::<Vec<_>>().into_iter());
    }
    scene
}

/// Thousands of small triangles.
fn confetti(size: [u32; 2]) -> FlatScene {
    let mut scene = FlatScene::empty("confetti", size);
    let chance = &mut Chance::new(4);
    for _ in 0..4000 {
        let [x, y] = scene.place(chance);
        let color = opaque(chance);
        let corners = (0..3).map(|_| [x + chance.range(-9.0, 9.0), y + chance.range(-9.0, 9.0)]);
        scene.add(color, corners.collect());
    }
    scene
}

/// Fans of triangles around shared centres, which leave gaps.
fn fans(size: [u32; 2]) -> FlatScene {
    let mut scene = FlatScene::empty("fans", size);
    let chance = &mut Chance::new(5);
    for _ in 0..6 {
        let center = scene.place(chance);
        let radius = chance.range(90.0, 260.0);
        for blade in 0..100 {
            let angle = f64::from(blade) / 100.0 * TAU;
            let at = |angle: f64| [center[0] + radius * angle.cos(), center[1] + radius * angle.sin()];
            scene.add(opaque(chance), vec![center, at(angle), at(angle + TAU / 160.0)]);
        }
    }
    scene
}

/// 500 slivers as high as the frame that fan out from its corner.
pub(crate) fn slivers(size: [u32; 2]) -> FlatScene {
    let mut scene = FlatScene::empty("slivers", size);
    let chance = &mut Chance::new(6);
    let [width, height] = scene.canvas;
    for i in 0..500 {
        let x = width * f64::from(i) / 500.0;
        scene.add(
            opaque(chance),
            vec![[0.0, 0.0], [x, height], [x + width / 800.0, height]],
        );
    }
    scene
}
