//! What a sample sees of a triangle: the verdicts of its edges, and what its corners give there.

use glam::DVec2;

use super::area_use::SummedBox;
use super::model::{Edge, Interpolated, RampStop, Tap, Texel, TileTexel, Verdict, View, Wrapped};
use super::samples::straight;
use crate::color::Rgba;
use crate::geometry::edge::{EdgeKind, EdgeTest};
use crate::raster::{Attributes, SampleOfTriangle};
use crate::rules::Rules;
use crate::texture::Wrap;

pub(super) fn triangle_view(sample: &SampleOfTriangle, corners: &[DVec2; 3], rules: Rules) -> View {
    View::Triangle {
        edges: edges(sample, corners, rules),
        weights: sample.weights,
        value: interpolated(&sample.attributes),
    }
}

/// What the edges of a triangle with these corners say of a sample.
pub(super) fn edges(sample: &SampleOfTriangle, corners: &[DVec2; 3], rules: Rules) -> [Edge; 3] {
    [0, 1, 2].map(|i| {
        let test = sample.edges[i];
        let length = corners[i].distance(corners[(i + 1) % 3]);
        let square_pixels = test.value as f64 / (sample.units_per_pixel * sample.units_per_pixel);
        let float = sample.floats.map(|floats| floats[i]);
        Edge {
            value: test.value,
            float,
            distance: if length > 0.0 { square_pixels / length } else { 0.0 },
            verdict: float.map_or_else(|| verdict(test, rules), float_verdict),
        }
    })
}

fn verdict(test: EdgeTest, rules: Rules) -> Verdict {
    match (test.value.signum(), rules, test.kind) {
        (1, ..) => Verdict::Inside,
        (-1, ..) => Verdict::Outside,
        (_, Rules::Course, _) => Verdict::TieInclusive,
        (_, Rules::Standard | Rules::Float, EdgeKind::Top) => Verdict::TieTop,
        (_, Rules::Standard | Rules::Float, EdgeKind::Left) => Verdict::TieLeft,
        (_, Rules::Standard | Rules::Float, EdgeKind::Other) => Verdict::TieNeither,
    }
}

/// By the float rules, which only ask whether a value is above zero.
fn float_verdict(value: f32) -> Verdict {
    if value > 0.0 {
        Verdict::Inside
    } else if value < 0.0 {
        Verdict::Outside
    } else {
        Verdict::TieUndecided
    }
}

/// Where a point beyond the border of a texture is that goes on there.
fn wrapped(uv: [f64; 2], wrap: Wrap) -> Option<Wrapped> {
    let inside = uv.iter().all(|at| (0.0..=1.0).contains(at));
    let places = uv.map(|at| wrap.inside(at));
    (wrap != Wrap::Clamp && !inside).then(|| Wrapped {
        copy: uv.map(f64::floor),
        uv: places.map(|(at, _)| at),
        turned: places.map(|(_, turned)| turned),
    })
}

pub(super) fn interpolated(attributes: &Attributes) -> Interpolated {
    match attributes {
        Attributes::None => Interpolated::Flat,
        Attributes::Color(rgba) => Interpolated::Color { rgba: *rgba },
        Attributes::Pattern { size, read } => Interpolated::Pattern {
            copy: read.copy,
            size: *size,
            texels: read
                .texels
                .iter()
                .map(|texel| TileTexel {
                    at: texel.at,
                    color: straight(texel.color, Rules::Standard),
                    weight: texel.weight,
                })
                .collect(),
        },
        Attributes::Gradient { place, mix } => {
            let stop = |i: usize| RampStop {
                number: mix.stops[i],
                offset: mix.ends[i].offset,
                color: mix.ends[i].color.to_bytes(Rules::Standard),
            };
            let Rgba { r, g, b, a } = mix.color;
            Interpolated::Gradient {
                t: *place,
                at: mix.at,
                stops: [stop(0), stop(1)],
                weight: mix.weight,
                rgba: [r, g, b, a],
            }
        }
        Attributes::OffRamp => Interpolated::OffRamp,
        Attributes::Texture { uv, reads } => Interpolated::Texture {
            uv: *uv,
            wrapped: wrapped(*uv, reads.wrap),
            summed: reads.summed.as_ref().map(|read| Box::new(SummedBox::new(read))),
            taps: reads
                .taps
                .iter()
                .map(|tap| Tap {
                    level: tap.level,
                    at: tap.at.to_array(),
                })
                .collect(),
            texels: reads
                .texels
                .iter()
                .map(|texel| Texel {
                    level: texel.level,
                    at: texel.at,
                    color: texel.color,
                    weight: texel.weight,
                })
                .collect(),
        },
    }
}
