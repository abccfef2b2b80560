//! What of the picture a spectrum is of, and over it the wave that is pointed at: light and dark stripes, as each pixel sees it.

use egui::{Color32, ColorImage, Rect, Stroke, StrokeKind, TextureHandle, TextureOptions, Ui, pos2, vec2};

use super::places::{beside_insets, points};
use super::profile_line::in_points;
use crate::compare::{SpectrumAnalysis, Wave};
use crate::raster::Region;
use crate::viewer::{SpectrumFound, Viewer};

/// How opaque crests and troughs are.
const OPACITY: f64 = 150.0;
/// The border of the pixels, the widest line first.
const BORDER: [(f32, Color32); 2] = [(3.0, Color32::from_black_alpha(130)), (1.0, Color32::WHITE)];

/// The wave as a picture, a texel for each pixel.
#[derive(Default)]
pub(super) struct WaveOverPicture {
    drawn: Option<((Wave, Region), TextureHandle)>,
}

impl std::fmt::Debug for WaveOverPicture {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("WaveOverPicture").finish_non_exhaustive()
    }
}

impl WaveOverPicture {
    /// Draws the border of the pixels, and the wave `pointed`, where neither panels nor insets lie.
    pub(super) fn show(&mut self, ui: &Ui, viewer: &Viewer, free: Rect, pointed: Option<Wave>) {
        let spectrum = viewer.spectrum();
        let Some(found) = spectrum.found().filter(|_| spectrum.is_open()) else {
            self.drawn = None;
            return;
        };
        let scale = ui.pixels_per_point();
        let texture = pointed.map(|wave| self.texture(ui, found, wave).id());
        if pointed.is_none() {
            self.drawn = None;
            if found.level.is_some() {
                // Texels were transformed, not these pixels.
                return;
            }
        }
        for place in spectrum.panes() {
            let [from, to] = [place.corner, place.corner + place.size].map(|at| in_points(at, scale));
            let rect = Rect::from_min_max(from, to);
            let pane = free.intersect(points(&place.area, scale));
            for part in beside_insets(viewer, pane, scale) {
                let painter = ui.painter().with_clip_rect(part);
                if let Some(texture) = texture {
                    let whole = Rect::from_min_max(pos2(0.0, 0.0), pos2(1.0, 1.0));
                    painter.image(texture, rect, whole, Color32::WHITE);
                }
                for (width, color) in BORDER {
                    painter.rect_stroke(rect, 0.0, Stroke::new(width, color), StrokeKind::Middle);
                }
            }
        }
    }

    fn texture(&mut self, ui: &Ui, found: &SpectrumFound, wave: Wave) -> &TextureHandle {
        let region = SpectrumAnalysis::middle_of(found.place.region);
        let key = (wave, region);
        if self.drawn.as_ref().is_some_and(|(drawn, _)| *drawn != key) {
            self.drawn = None;
        }
        let (_, texture) = self.drawn.get_or_insert_with(|| {
            let image = stripes(&found.analysis, &wave, region);
            (key, ui.ctx().load_texture("wave", image, TextureOptions::NEAREST))
        });
        texture
    }
}

/// Crests in white, troughs in black, and nothing between them.
fn stripes(analysis: &SpectrumAnalysis, wave: &Wave, region: Region) -> ColorImage {
    let full = wave.amplitude.max(f64::MIN_POSITIVE);
    let places = (region.y..region.bottom()).flat_map(|y| (region.x..region.right()).map(move |x| [x, y]));
    let color = |at: [u32; 2]| {
        let value = (analysis.value_at(wave, at) / full).clamp(-1.0, 1.0);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to 150")]
        let alpha = (value.abs() * OPACITY).round() as u8;
        if value > 0.0 {
            Color32::from_white_alpha(alpha)
        } else {
            Color32::from_black_alpha(alpha)
        }
    };
    let size = [region.width, region.height].map(|side| side as usize);
    let mut image = ColorImage::new(size, places.map(color).collect());
    image.source_size = vec2(region.width as f32, region.height as f32);
    image
}

#[cfg(test)]
mod tests {
    use egui::epaint::Color32 as Ink;

    use super::*;
    use crate::texture::MipLevel;

    #[test]
    fn stripes_lie_on_those_of_the_picture() {
        // Two black texels, two white ones, seen one to one.
        let texels = (0..32 * 32).map(|i| if (i % 4) < 2 { [0, 0, 0, 255] } else { [255; 4] });
        let level = MipLevel::new(32, 32, texels.collect());
        let analysis = SpectrumAnalysis::of_level(&level, [16, 16], glam::DAffine2::IDENTITY);
        let wave = analysis.peaks(1)[0].wave;
        let region = Region::of_size([32, 32]);
        let image = stripes(&analysis, &wave, region);
        let is_light = |color: &Ink| color.r() > 0;
        let row: Vec<bool> = image.pixels[..8].iter().map(is_light).collect();
        assert_eq!(
            row,
            [false, false, true, true, false, false, true, true],
            "as the texels"
        );
        assert!(image.pixels[0].a() > 90, "to be seen: {:?}", image.pixels[0]);
    }
}
