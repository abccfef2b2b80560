//! What would change a pixel for the better, and with which key: the step from why to what to do.

use super::model::{Explanation, Paint, Texture};
use super::numbers::{number, percent};

/// Texels along a footprint from which on reading a few of them shimmers.
const SHIMMERS: f64 = 2.0;
/// How many times as long as wide a footprint is from which on averaging it both ways blurs.
const BLURS: f64 = 2.0;
/// Texels along a footprint below which texels are seen as blocks.
const BLOCKS: f64 = 0.7;
/// The part of a pixel by which samples may be wrong about coverage before anybody is told.
const WRONG: f64 = 0.2;

impl Explanation {
    /// One sentence or two for each thing about this pixel that a setting would cure; empty where all is well.
    pub fn hints(&self) -> Vec<String> {
        let mut hints = Vec::new();
        let seen = |paint: &&Paint| paint.fragments.iter().any(|fragment| fragment.seen);
        let topmost = self.paints.iter().rev().find(seen);
        hints.extend(self.seam_hints());
        if let Some((paint, area)) = topmost.and_then(|paint| Some((paint, paint.area?))) {
            let part = paint.fragments.len() as f64 / self.samples.len().max(1) as f64;
            if (part - area).abs() > WRONG {
                hints.push(format!(
                    "The samples say that {} covers {} of the pixel; in truth it is {}. A higher sample rate (=) comes \
                     closer, so that edges are no steps.",
                    paint.name(),
                    percent(part),
                    percent(area)
                ));
            }
        }
        if !self.missed.is_empty() {
            let area: f64 = self.missed.iter().map(|missed| missed.area).sum();
            hints.push(format!(
                "What is thin passes between the samples here, {} of the pixel: it breaks up. A higher sample rate (=) \
                 finds it.",
                percent(area.min(1.0))
            ));
        }
        let textures = self
            .paints
            .iter()
            .rev()
            .filter(seen)
            .filter_map(|paint| paint.texture.as_ref());
        if let Some(texture) = textures.into_iter().next() {
            hints.extend(texture.hint());
        }
        hints
    }
}

impl Texture {
    fn hint(&self) -> Option<String> {
        let long = number((self.major * 10.0).round() / 10.0);
        let fixed_level = self.levels.first().map_or(0, |level| level.number);
        if self.level_sampling == "zero" && fixed_level == 0 && self.major > SHIMMERS {
            return Some(format!(
                "A {} spans {long} texels, but a sample reads only the nearest: its neighbours read others, which shimmers \
                 when the view moves and makes moire. Level sampling linear (L) reads averages of what is spanned.",
                self.step
            ));
        }
        if self.level_sampling != "zero" && self.taps == 1 && self.clamped > 0.0 && self.major > BLURS * self.minor {
            let ratio = if self.minor > 0.0 {
                number((self.major / self.minor).round())
            } else {
                "many".to_owned()
            };
            return Some(format!(
                "The footprint is {ratio} times as long as wide, and its level averages as much across as along: that blurs. \
                 Anisotropy (T) reads along it instead."
            ));
        }
        if self.pixel_sampling == "nearest" && self.major < BLOCKS {
            return Some(
                "A texel is larger than a pixel, so that its edges are seen as steps. Pixel sampling bilinear (P) mixes \
                 neighbours."
                    .to_owned(),
            );
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::super::model::Level;
    use super::*;

    fn texture(pixel_sampling: &'static str, level_sampling: &'static str, [major, minor]: [f64; 2]) -> Texture {
        let clamped = major.max(1.0).log2();
        Texture {
            name: "checker".to_owned(),
            index: 0,
            size: [64, 64],
            pixel_sampling,
            level_sampling,
            right: [major, 0.0],
            down: [0.0, minor],
            step: "pixel",
            major,
            minor,
            taps: 1,
            level_of_detail: Some(major.log2()),
            clamped,
            levels: vec![Level {
                number: 0,
                size: [64, 64],
                weight: 1.0,
            }],
            opacity: 1.0,
        }
    }

    #[test]
    fn textures_are_told_their_cure() {
        let cure = |texture: Texture| texture.hint().unwrap_or_default();
        for (pixel, level, sides, expected) in [
            ("nearest", "zero", [9.0, 8.0], "(L)"),
            ("bilinear", "zero", [9.0, 1.0], "(L)"),
            ("bilinear", "linear", [9.0, 1.0], "(T)"),
            ("bilinear", "nearest", [9.0, 0.0], "(T)"),
            ("nearest", "linear", [0.2, 0.3], "(P)"),
            ("nearest", "zero", [0.2, 0.3], "(P)"),
        ] {
            let found = cure(texture(pixel, level, sides));
            assert!(found.contains(expected), "{pixel} {level} {sides:?}: {found}");
        }
        for (pixel, level, sides) in [
            ("bilinear", "linear", [9.0, 8.0]),
            ("bilinear", "linear", [0.2, 0.3]),
            ("nearest", "zero", [1.0, 1.0]),
        ] {
            assert_eq!(
                cure(texture(pixel, level, sides)),
                "",
                "all is well: {pixel} {level} {sides:?}"
            );
        }
        let along = Texture {
            taps: 5,
            ..texture("bilinear", "linear", [9.0, 1.0])
        };
        assert_eq!(cure(along), "", "taps lie along it");
    }
}
