//! Small scenes made in code.

use std::sync::Arc;

use arbtest::arbitrary::{Result, Unstructured};
use glam::{DAffine2, DVec2, Vec2};
use rasterscope::color::{BlendMode, Ramp, Rgba, Spread, Stop};
use rasterscope::compare::Pair;
use rasterscope::geometry::{FillRule, GradientShape, Polygon, View, ViewTransform};
use rasterscope::raster::{Framebuffer, SampleRate};
use rasterscope::render::{RenderSettings, draw};
use rasterscope::scene::{
    Composite, Dialect, DialectChoice, Fill, Gradient, GradientId, MaskKind, Paint, Primitive, PrimitiveKind,
    ReadOptions, Scene, Shape, ShapeId, SourceLocation, TextureId, read,
};
use rasterscope::texture::{MipLevel, MipPyramid, Texture};
use rasterscope::viewer::gallery;

/// A scene of the gallery, such as `study/01_zone_plate.svg`.
pub(crate) fn gallery_scene(name: &str) -> Scene {
    let found = gallery::SCENES.iter().find(|scene| scene.name == name);
    let found = found.expect("a scene of the gallery");
    let options = ReadOptions {
        dialect: DialectChoice::Auto,
    };
    read(found.document.as_bytes(), name, options, &gallery::Textures).expect("a good document")
}

/// A scene of `kinds` on a canvas of `side x side`.
pub(crate) fn scene(side: f64, kinds: Vec<PrimitiveKind>) -> Scene {
    let mut scene = Scene::empty(DVec2::splat(side), Dialect::Svg);
    scene.shapes = vec![Shape {
        element: "polygon".into(),
        id: None,
        location: SourceLocation { line: 1, column: 1 },
        used: None,
    }];
    scene.primitives = kinds
        .into_iter()
        .map(|kind| Primitive {
            shape: ShapeId(0),
            kind,
        })
        .collect();
    scene
}

/// A triangle in one colour.
pub(crate) fn triangle(points: [(f64, f64); 3], color: Rgba) -> PrimitiveKind {
    PrimitiveKind::Triangle {
        points: points.map(DVec2::from),
        paint: Paint::Solid(color),
    }
}

/// A view in which one canvas unit is one pixel and the frame shows the canvas from its corner on.
pub(crate) fn one_to_one(size: [u32; 2]) -> ViewTransform {
    let center = DVec2::new(f64::from(size[0]), f64::from(size[1])) / 2.0;
    View::At {
        center,
        scale: 1.0,
        rotation: 0.0,
    }
    .transform(DVec2::ONE, size)
}

/// Settings at a sample rate, without an outline.
pub(crate) fn at_rate(samples: u32) -> RenderSettings {
    let sample_rate = SampleRate::new(samples).expect("a square number");
    RenderSettings {
        sample_rate,
        outline: false,
        ..RenderSettings::default()
    }
}

/// A drawn frame.
pub(crate) fn drawn(scene: &Scene, view: &ViewTransform, settings: &RenderSettings, size: [u32; 2]) -> Framebuffer {
    let mut frame = Framebuffer::new(size[0], size[1]);
    draw(scene, view, settings, &mut frame);
    frame
}

/// Root of the mean square of what the channels of two frames differ by, in levels.
pub(crate) fn rmse(a: &Framebuffer, b: &Framebuffer) -> f64 {
    Pair::new(a, b).expect("one size").levels().rmse()
}

/// A texture in which every texel differs from its neighbours; translucent ones among them if asked for.
pub(crate) fn busy_texture(width: u32, height: u32, translucent: bool) -> Texture {
    let byte = |value: u32| u8::try_from(value % 256).expect("below 256");
    let texels = (0..width * height)
        .map(|i| {
            let (x, y) = (i % width, i / width);
            let alpha = if translucent {
                byte(255 - (x * 31 + y * 7) % 200)
            } else {
                255
            };
            [byte(x * 37 + y * 11), byte(y * 53 + x * 5), byte((x ^ y) * 29), 255].map(|channel| channel.min(alpha))
        })
        .collect();
    Texture::new("busy", MipPyramid::build(MipLevel::new(width, height, texels)))
}

/// A number on a lattice of half pixels, so that ties are common, or anywhere.
pub(crate) fn coordinate(u: &mut Unstructured<'_>, side: i32) -> Result<f64> {
    if u.ratio(2, 3)? {
        Ok(f64::from(u.int_in_range(-4..=2 * side + 4)?) / 2.0)
    } else {
        Ok(f64::from(u.int_in_range(-2000..=1000 * side + 2000)?) / 1000.0)
    }
}

pub(crate) fn point(u: &mut Unstructured<'_>, side: i32) -> Result<DVec2> {
    Ok(DVec2::new(coordinate(u, side)?, coordinate(u, side)?))
}

pub(crate) fn color(u: &mut Unstructured<'_>, translucent: bool) -> Result<Rgba> {
    let [r, g, b, a] = u.arbitrary::<[u8; 4]>()?;
    Ok(Rgba::from_bytes([r, g, b, if translucent { a } else { 255 }]))
}

/// What a random scene may be made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Fills {
    /// Opaque flat colours.
    Flat,
    /// Flat colours of any opacity, and layers.
    Translucent,
    /// Those, vertex colours and textures.
    Everything,
}

/// A layer that is painted over what is below, clips or masks it. Modes that divide are left out: they make much of little.
fn composite(u: &mut Unstructured<'_>) -> Result<Composite> {
    let opacity = f32::from(u.arbitrary::<u8>()?) / 255.0;
    Ok(match u.int_in_range(0..=5)? {
        0 => Composite::Clip,
        1 => Composite::Mask(*u.choose(&[MaskKind::Alpha, MaskKind::Luminance])?),
        2 => Composite::Over {
            opacity,
            blend: *u.choose(&[
                BlendMode::Multiply,
                BlendMode::Screen,
                BlendMode::Difference,
                BlendMode::Exclusion,
            ])?,
        },
        _ => Composite::over(opacity),
    })
}

/// A linear or radial gradient of a few stops.
fn gradient(u: &mut Unstructured<'_>, side: i32, fills: Fills) -> Result<Gradient> {
    let mut stops = Vec::new();
    for i in 0..u.int_in_range(1..=4_u8)? {
        stops.push(Stop {
            offset: f32::from(i) * 0.25 + f32::from(u.int_in_range(0..=15_u8)?) / 64.0,
            color: color(u, fills != Fills::Flat)?,
        });
    }
    let spread = *u.choose(&[Spread::Pad, Spread::Reflect, Spread::Repeat])?;
    let (first, second) = (point(u, side)?, point(u, side)?);
    let geometry = if u.arbitrary()? {
        GradientShape::Linear {
            from: first,
            to: second,
        }
    } else {
        GradientShape::Radial {
            center: first,
            radius: f64::from(u.int_in_range(1..=side)?),
            focus: first.lerp(second, 0.1),
            focal_radius: f64::from(u.int_in_range(0..=2)?),
        }
    };
    Ok(Gradient {
        shape: ShapeId(0),
        geometry,
        ramp: Ramp::new(stops, spread).expect("some stops"),
        to_user: DAffine2::from_angle_translation(0.3, DVec2::new(2.0, 1.0)),
    })
}

/// Random triangles, polygons, hairlines, points and layers on a canvas of `side` pixels.
pub(crate) fn random(u: &mut Unstructured<'_>, side: i32, fills: Fills) -> Result<Scene> {
    let mut kinds = Vec::new();
    let mut open = 0;
    for _ in 0..u.int_in_range(1..=14)? {
        kinds.push(match u.int_in_range(0..=9)? {
            0 => PrimitiveKind::Point {
                at: point(u, side)?,
                color: color(u, fills != Fills::Flat)?,
            },
            1 => PrimitiveKind::Hairline {
                ends: [point(u, side)?, point(u, side)?],
                color: color(u, fills != Fills::Flat)?,
            },
            2 if fills != Fills::Flat && open < 3 => {
                open += 1;
                PrimitiveKind::BeginLayer
            }
            3 if open > 0 => {
                open -= 1;
                PrimitiveKind::EndLayer {
                    composite: composite(u)?,
                }
            }
            4 | 5 => PrimitiveKind::Polygon {
                polygon: Arc::new(polygon(u, side)?),
                fill: match u.int_in_range(0..=3)? {
                    0 if fills == Fills::Everything => Fill::Gradient(GradientId(u.int_in_range(0..=1)?)),
                    _ => Fill::Solid(color(u, fills != Fills::Flat)?),
                },
            },
            _ => {
                let points = [point(u, side)?, point(u, side)?, point(u, side)?];
                PrimitiveKind::Triangle {
                    points,
                    paint: paint(u, fills)?,
                }
            }
        });
    }
    kinds.extend((0..open).map(|_| PrimitiveKind::EndLayer {
        composite: Composite::over(0.5),
    }));
    let mut scene = scene(f64::from(side), kinds);
    scene.gradients = vec![gradient(u, side, fills)?, gradient(u, side, fills)?];
    scene.textures = Arc::new([
        Arc::new(busy_texture(16, 16, fills != Fills::Flat)),
        Arc::new(busy_texture(9, 5, false)),
    ]);
    Ok(scene)
}

/// One or two contours that cross themselves and each other, large or of a few samples, some far beyond the canvas.
pub(crate) fn polygon(u: &mut Unstructured<'_>, side: i32) -> Result<Polygon> {
    let (scale, corner) = (*u.choose(&[1.0, 1.0, 1.0, 0.1, 40.0])?, point(u, side)?);
    let mut contours = Vec::new();
    for _ in 0..u.int_in_range(1..=2)? {
        let mut contour = Vec::new();
        for _ in 0..u.int_in_range(3..=12)? {
            contour.push(corner + (point(u, side)? - corner) * scale);
        }
        contours.push(contour);
    }
    let rule = *u.choose(&[FillRule::NonZero, FillRule::EvenOdd])?;
    Ok(Polygon::new(contours, rule))
}

fn paint(u: &mut Unstructured<'_>, fills: Fills) -> Result<Paint> {
    let choice = if fills == Fills::Everything {
        u.int_in_range(0..=2)?
    } else {
        0
    };
    Ok(match choice {
        0 => Paint::Solid(color(u, fills != Fills::Flat)?),
        1 => Paint::Vertex([
            color(u, fills != Fills::Flat)?,
            color(u, fills != Fills::Flat)?,
            color(u, fills != Fills::Flat)?,
        ]),
        _ => {
            let mut uv = || -> Result<Vec2> {
                let mut unit = || Ok((u.int_in_range(-100..=1100)? as f32) / 1000.0);
                Ok(Vec2::new(unit()?, unit()?))
            };
            let uv = [uv()?, uv()?, uv()?];
            let opacity = if fills == Fills::Flat {
                1.0
            } else {
                f32::from(u.arbitrary::<u8>()?) / 255.0
            };
            Paint::Texture {
                texture: TextureId(u.int_in_range(0..=1)?),
                uv,
                opacity,
            }
        }
    })
}
