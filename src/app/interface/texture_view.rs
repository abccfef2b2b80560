//! The texture view of a fragment: the mip level that it reads, with the footprint of its pixel and its taps.

use egui::{Color32, Pos2, Rect, RichText, Sense, Shape, Stroke, StrokeKind, Ui, vec2};

use super::contributions::LIT;
use super::look::opaque;
use crate::inspect::{AreaUse, Interpolated, Level, Paint, Tap, TexelPlace, Texture, View};
use crate::raster::Region;
use crate::texture::MipLevel;
use crate::viewer::Viewer;

/// Width of the view at most, in points: a narrower panel has a narrower one.
const WIDTH: f32 = 290.0;
/// Its height, in points.
const HEIGHT: f32 = 150.0;
/// Texels that are shown across at least and at most.
const TEXELS: (f64, f64) = (6.0, 64.0);
const FOOTPRINT: Color32 = Color32::from_rgb(255, 214, 10);
const TAP: Color32 = Color32::from_rgb(230, 60, 60);

/// The part of a level that is shown: texels to points.
struct Window {
    rect: Rect,
    /// The texel position in the middle.
    middle: [f64; 2],
    /// Points per texel.
    scale: f64,
}

/// Draws the level that the fragment of `paint` at `sample` reads most of, nothing where it reads no texture; the texel
/// that the pointer is over.
pub(super) fn show(ui: &mut Ui, viewer: &Viewer, paint: &Paint, sample: usize) -> Option<TexelPlace> {
    let (Some(texture), Some(View::Triangle { value, .. })) = (&paint.texture, paint.views.get(sample)) else {
        return None;
    };
    let Interpolated::Texture {
        uv,
        wrapped,
        taps,
        texels,
        ..
    } = value
    else {
        return None;
    };
    let level = &texture.main_level()?;
    let frame = viewer.frames().frame()?;
    let image = texture.texels(&frame.picture.scene, level)?;
    let (rect, response) = ui.allocate_exact_size(vec2(WIDTH.min(ui.available_width()), HEIGHT), Sense::hover());
    let scale = [0, 1].map(|i| f64::from(level.size[i]) / f64::from(texture.size[i]));
    // Of a texture that goes on beyond its border the copy is shown that is its own; one that is turned round has its steps
    // turned, too.
    let (uv, turned) = wrapped
        .as_ref()
        .map_or((*uv, [false; 2]), |wrapped| (wrapped.uv, wrapped.turned));
    let scale = [0, 1].map(|i| if turned[i] { -scale[i] } else { scale[i] });
    let steps = [texture.right, texture.down].map(|step| [step[0] * scale[0], step[1] * scale[1]]);
    let centre = [uv[0] * f64::from(level.size[0]), uv[1] * f64::from(level.size[1])];
    let across = steps.iter().flatten().fold(0.0_f64, |most, step| most.max(step.abs())) * 2.5;
    let window = Window {
        rect,
        middle: centre,
        scale: f64::from(rect.width()) / across.clamp(TEXELS.0, TEXELS.1),
    };
    window.texels(ui, image);
    window.footprint(ui, centre, steps);
    if let Some(area) = &texture.area {
        window.area(ui, centre, area, turned);
    }
    window.taps(ui, taps, level);
    let under = response.hover_pos().and_then(|at| window.texel_at(at, level));
    let place = under.map(|at| TexelPlace {
        texture: texture.index,
        level: level.number,
        at,
    });
    if let Some(at) = under {
        let weight: f64 = texels
            .iter()
            .filter(|texel| texel.level == level.number && texel.at == at)
            .map(|texel| texel.weight)
            // An empty sum of floats is minus zero.
            .fold(0.0, |sum, weight| sum + weight);
        let [r, g, b, a] = image.texel(at[0].cast_signed(), at[1].cast_signed());
        window.mark(ui, at);
        let contributed = contributed_words(viewer, place).unwrap_or_default();
        response.on_hover_text(format!(
            "texel ({}, {}) of level {}: {r} {g} {b} {a}, {:.2} % of this sample{contributed}",
            at[0],
            at[1],
            level.number,
            weight * 100.0
        ));
    }
    ui.label(RichText::new(legend(texture, level)).size(11.0).weak());
    place
}

/// What the view shows.
fn legend(texture: &Texture, level: &Level) -> String {
    format!(
        "level {} of {}: yellow the steps of a {} and the footprint in them, red the {}",
        level.number,
        short(&texture.name),
        texture.step,
        match &texture.area {
            Some(AreaUse::Ellipse { .. }) => "ellipse that is weighed, and its middle",
            Some(AreaUse::Box { .. }) => "box that is averaged, and its middle",
            Some(AreaUse::Ripmap { .. }) | None if texture.taps == 1 => "point that is read",
            _ => "taps",
        }
    )
}

/// How many pixels a texel contributes to, once that was found out.
fn contributed_words(viewer: &Viewer, texel: Option<TexelPlace>) -> Option<String> {
    let Region { width, height, .. } = viewer
        .inspector()
        .contributions_region()
        .filter(|_| texel == viewer.inspector().pointed_texel())?;
    let around = format!("of the {width} x {height} pixels around the pinned one");
    Some(match viewer.inspector().contributed_pixels().len() {
        0 => format!("\ncontributes to none {around}"),
        count => format!("\ncontributes to {count} {around}, lit in the picture"),
    })
}

/// The last part of a texture's address.
fn short(name: &str) -> &str {
    name.rsplit('/').next().unwrap_or(name)
}

impl Window {
    #[expect(clippy::cast_possible_truncation, reason = "places on a screen")]
    fn place(&self, texel: [f64; 2]) -> Pos2 {
        let at = [0, 1].map(|i| ((texel[i] - self.middle[i]) * self.scale) as f32);
        self.rect.center() + vec2(at[0], at[1])
    }

    /// The texels in sight.
    fn texels(&self, ui: &Ui, image: &MipLevel) {
        let painter = ui.painter().with_clip_rect(self.rect);
        painter.rect_filled(self.rect, 0.0, ui.visuals().extreme_bg_color);
        let range = |axis: usize, points: f32, size: u32| {
            let half = f64::from(points) / 2.0 / self.scale;
            let clamp = |at: f64| whole(at.clamp(0.0, f64::from(size)));
            clamp((self.middle[axis] - half).floor())..clamp((self.middle[axis] + half).ceil())
        };
        let gap = if self.scale > 8.0 { 0.5 } else { 0.0 };
        for y in range(1, self.rect.height(), image.height()) {
            for x in range(0, self.rect.width(), image.width()) {
                let corner = [f64::from(x), f64::from(y)];
                let square = Rect::from_two_pos(self.place(corner), self.place([corner[0] + 1.0, corner[1] + 1.0]));
                let color = opaque(image.texel(x.cast_signed(), y.cast_signed()));
                painter.rect_filled(square.shrink(gap), 0.0, color);
            }
        }
    }

    /// The parallelogram of the two steps and the ellipse in it, about the point that a sample stands for.
    fn footprint(&self, ui: &Ui, centre: [f64; 2], [right, down]: [[f64; 2]; 2]) {
        let painter = ui.painter().with_clip_rect(self.rect);
        let at = |a: f64, b: f64| self.place([0, 1].map(|i| centre[i] + right[i] * a + down[i] * b));
        let corners = vec![at(-0.5, -0.5), at(0.5, -0.5), at(0.5, 0.5), at(-0.5, 0.5)];
        let ellipse: Vec<Pos2> = (0..48)
            .map(|i| {
                let (sin, cos) = (f64::from(i) / 48.0 * std::f64::consts::TAU).sin_cos();
                at(0.5 * cos, 0.5 * sin)
            })
            .collect();
        for (width, color) in [(3.0, Color32::from_black_alpha(150)), (1.5, FOOTPRINT)] {
            painter.add(Shape::closed_line(corners.clone(), Stroke::new(width, color)));
            painter.add(Shape::closed_line(ellipse.clone(), Stroke::new(width, color)));
        }
    }

    /// The rim of what is weighed, about the same point: the ellipse or the box.
    fn area(&self, ui: &Ui, centre: [f64; 2], area: &AreaUse, turned: [bool; 2]) {
        let sign = turned.map(|turned| if turned { -1.0 } else { 1.0 });
        let at = |x: f64, y: f64| self.place([centre[0] + x * sign[0], centre[1] + y * sign[1]]);
        let rim: Vec<Pos2> = match area {
            AreaUse::Ellipse { axes: [long, short] } => (0..64)
                .map(|i| {
                    let (sin, cos) = (f64::from(i) / 64.0 * std::f64::consts::TAU).sin_cos();
                    at(long[0] * cos + short[0] * sin, long[1] * cos + short[1] * sin)
                })
                .collect(),
            AreaUse::Box { sides: [width, height] } => [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)]
                .map(|(x, y)| at(x * width, y * height))
                .to_vec(),
            AreaUse::Ripmap { .. } => return,
        };
        let painter = ui.painter().with_clip_rect(self.rect);
        for (width, color) in [(3.0, Color32::from_black_alpha(150)), (1.5, TAP)] {
            painter.add(Shape::closed_line(rim.clone(), Stroke::new(width, color)));
        }
    }

    fn taps(&self, ui: &Ui, taps: &[Tap], level: &Level) {
        let painter = ui.painter().with_clip_rect(self.rect);
        for tap in taps.iter().filter(|tap| tap.level == level.number) {
            let at = self.place(tap.at);
            painter.circle_filled(at, 3.0, TAP);
            painter.circle_stroke(at, 3.0, Stroke::new(1.0, Color32::WHITE));
        }
    }

    /// Frames a texel.
    fn mark(&self, ui: &Ui, texel: [u32; 2]) {
        let corner = texel.map(f64::from);
        let square = Rect::from_two_pos(self.place(corner), self.place([corner[0] + 1.0, corner[1] + 1.0]));
        let painter = ui.painter().with_clip_rect(self.rect);
        for (width, color) in LIT {
            painter.rect_stroke(square, 0.0, Stroke::new(width, color), StrokeKind::Middle);
        }
    }

    /// The texel of the level under a point of the screen.
    fn texel_at(&self, at: Pos2, level: &Level) -> Option<[u32; 2]> {
        let from_middle = at - self.rect.center();
        let texel = |axis: usize, points: f32| {
            let at = self.middle[axis] + f64::from(points) / self.scale;
            (at >= 0.0 && at < f64::from(level.size[axis])).then(|| whole(at))
        };
        Some([texel(0, from_middle.x)?, texel(1, from_middle.y)?])
    }
}

#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to a level's size, which is at most 16 384"
)]
fn whole(at: f64) -> u32 {
    at as u32
}
