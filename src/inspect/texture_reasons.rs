//! What is wrong with how a pixel reads its textures, where a setting cures that: levels, taps and areas, and what lies between
//! samples.

use std::collections::BTreeSet;

use glam::DVec2;

use super::advice_words::MOSTLY;
use super::area_use::AreaUse;
use super::model::{Cure, Explanation, Interpolated, Paint, Texel, Texture, View};
use super::numbers::{counted, number, significant};
use crate::color::ResolveSpace;
use crate::geometry::area_in_pixel;
use crate::texture::{LevelSampling, PixelSampling, Wrap};

/// How many times as long as wide a footprint is from which on averaging it both ways blurs.
const BLURS: f64 = 2.0;
/// Texels between samples from which on some are left out whatever the filter.
const LEAVES_OUT: f64 = 2.0;

impl Explanation {
    /// The primitive with a texture whose colour is farthest from its true one, or else the topmost that is seen, and that texture.
    pub(super) fn wrong_texture(&self) -> Option<(&Paint, &Texture)> {
        let off = self.truth.as_ref().and_then(|truth| truth.causes.off_texture);
        let paint = off
            .and_then(|number| self.paints.get(number))
            .or_else(|| self.topmost())?;
        Some((paint, paint.texture.as_ref()?))
    }

    /// The paints that are seen and read textures, the topmost first.
    fn seen_textured(&self) -> impl Iterator<Item = (&Paint, &Texture)> {
        let seen = self.paints.iter().rev().filter(|paint| paint.is_seen());
        seen.filter_map(|paint| Some((paint, paint.texture.as_ref()?)))
    }

    /// The textures of what is seen, the topmost first.
    pub(super) fn seen_textures(&self) -> impl Iterator<Item = &Texture> {
        self.seen_textured().map(|(_, texture)| texture)
    }

    /// Why other levels, or an area, are better.
    pub(super) fn level_sampling_reason(&self, cure: &Cure) -> Option<String> {
        let (paint, texture) = self.wrong_texture()?;
        if cure.value == LevelSampling::Zero.name() {
            return Some(self.close_enough(paint, texture));
        }
        let blurred = || cure.weighs_area().then(|| self.blurred_or_few(cure)).flatten();
        self.few_of_many(paint, texture).or_else(blurred)
    }

    /// That levels of long footprints blur, or, where many samples of the same levels would be right, that few of their texels are
    /// read.
    pub(super) fn blurred_or_few(&self, cure: &Cure) -> Option<String> {
        let (paint, texture) = self.wrong_texture()?;
        let blurred = texture.blurred_across()?;
        let averaging = self.truth.as_ref()?.causes.averaging;
        if averaging >= cure.nearer * MOSTLY {
            return Some(blurred);
        }
        let read: BTreeSet<(usize, [u32; 2])> = texels_read(paint).map(|texel| (texel.level, texel.at)).collect();
        let levels: Vec<String> = texture.levels.iter().map(|level| level.number.to_string()).collect();
        let plural = if levels.len() == 1 { "" } else { "s" };
        (texture.pixel_sampling == PixelSampling::Nearest.name() && !read.is_empty()).then(|| {
            format!(
                "Of level{plural} {} {} just {}.",
                levels.join(" and "),
                self.readers(paint),
                counted(read.len(), "texel")
            )
        })
    }

    /// In which values levels were averaged, and in which ones samples are.
    pub(super) fn pyramid_reason(&self, cure: &Cure) -> Option<String> {
        let words = |space: ResolveSpace| match space {
            ResolveSpace::Stored => "stored values",
            ResolveSpace::Linear => "linear light",
        };
        let texture = self.seen_textures().find(|texture| texture.is_averaged_before())?;
        let what = match texture.area {
            Some(AreaUse::Box { .. }) => "The table was summed",
            Some(AreaUse::Ripmap { .. }) => "The ripmap's levels were averaged",
            Some(AreaUse::Ellipse { .. }) | None => "Mip levels were averaged",
        };
        let (before, after) = (texture.averaged_in(), self.resolve.space());
        let [levels, samples] = [before, after].map(words);
        if cure.value != after.name() {
            return Some(format!(
                "{what} in {levels}, as samples of the truth are: that another average comes nearer happens to be so here."
            ));
        }
        let samples = match self.samples.len() {
            _ if self.exact => format!("areas are mixed in {samples}"),
            1 => format!("the truth's samples are averaged in {samples}"),
            _ => format!("samples are averaged in {samples}"),
        };
        Some(format!("{what} in {levels}, and {samples}."))
    }

    /// Whether the samples of the topmost texture lie so far apart that it is luck which texels they read, whatever is read around
    /// each.
    pub(super) fn is_luck_between_texels(&self) -> bool {
        let texture = self.topmost().and_then(|paint| paint.texture.as_ref());
        texture.is_some_and(|texture| texture.reads_base_once() && self.texels_apart(texture) > LEAVES_OUT)
    }

    /// Whether the places where textures are read lie so close together that level 0 alone can be read there.
    pub(super) fn reads_closely(&self) -> bool {
        let mut textured = self.seen_textured().peekable();
        textured.peek().is_some() && textured.all(|(paint, texture)| self.reads_apart(paint, texture) <= LEAVES_OUT)
    }

    /// How many texels the places lie apart where a paint reads its texture: samples, or one place in each pixel.
    fn reads_apart(&self, paint: &Paint, texture: &Texture) -> f64 {
        let apart = self.texels_apart(texture);
        if paint.shaded_at.is_some() {
            apart / self.step()
        } else {
            apart
        }
    }

    /// That level 0 can be read as it is.
    fn close_enough(&self, paint: &Paint, texture: &Texture) -> String {
        let places = if self.exact || paint.shaded_at.is_some() {
            "The places that pixels are shaded at"
        } else {
            "Samples"
        };
        let apart = significant(self.reads_apart(paint, texture));
        let plural = if apart == "1" { "" } else { "s" };
        format!(
            "{places} lie only about {apart} texel{plural} apart here, close enough to read level 0 as it is: to average it before blurs."
        )
    }

    /// How many texels the samples of a texture lie apart.
    fn texels_apart(&self, texture: &Texture) -> f64 {
        texture.major * if texture.step == "sample" { 1.0 } else { self.step() }
    }

    /// That samples lie too far apart to read all texels.
    pub(super) fn texels_between(&self, cure: &Cure) -> Option<String> {
        let (paint, texture) = self.wrong_texture()?;
        if paint.shaded_at.is_some() {
            // One place is read, however many samples there are.
            return None;
        }
        let apart = self.texels_apart(texture);
        let causes = self.truth.as_ref().map(|truth| &truth.causes);
        let by_texture = causes.is_none_or(|causes| causes.textures >= cure.nearer * MOSTLY);
        (texture.reads_base_once() && apart > LEAVES_OUT && by_texture).then(|| {
            format!(
                "Samples lie about {} texels apart here, and what is between them is not read.",
                significant(apart)
            )
        })
    }

    /// How many texels the pixel's footprint holds: of a texture that ends at its border, those in it.
    fn texels_held(&self, paint: &Paint, texture: &Texture) -> Option<f64> {
        let to_texels = self.level_of(paint)?.to_texels;
        if texture.wrap != Wrap::Clamp.name() {
            return Some(to_texels.matrix2.determinant().abs());
        }
        let size = DVec2::from(texture.size.map(f64::from));
        let pixel = DVec2::from(self.pixel.map(f64::from));
        let corners = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
        // The texture as a single pixel.
        let [a, b, c, d] = corners.map(|corner| to_texels.transform_point2(pixel + corner) / size);
        let held = area_in_pixel([a, b, c], [0, 0]) + area_in_pixel([a, c, d], [0, 0]);
        Some(held * size.x * size.y)
    }

    /// How many texels the pixel's footprint holds, and how few of them its samples read.
    fn few_of_many(&self, paint: &Paint, texture: &Texture) -> Option<String> {
        let held = self.texels_held(paint, texture)?;
        let read: BTreeSet<[u32; 2]> = texels_read(paint).map(|texel| texel.at).collect();
        let is_whole = paint.fragments.len() == self.samples.len();
        // A texture that goes on beyond its border may be read whole.
        let [width, height] = texture.size.map(u64::from);
        let leaves_out = (read.len() as u64) < width * height;
        (is_whole && leaves_out && texture.reads_base_once() && held > 2.0 * read.len() as f64).then(|| {
            let readers = self.readers(paint);
            let texels = if read.len() == 1 {
                "one"
            } else {
                &read.len().to_string()
            };
            format!(
                "The pixel's footprint holds about {} texels, of which {readers} {texels}.",
                significant(held)
            )
        })
    }

    /// Who reads the texture of a paint.
    fn readers(&self, paint: &Paint) -> &'static str {
        if self.exact || paint.shaded_at.is_some() {
            "the one place that is shaded reads"
        } else if self.samples.len() == 1 {
            "its only sample reads"
        } else {
            "its samples read"
        }
    }
}

/// The texels that a paint's places read, some several times.
fn texels_read(paint: &Paint) -> impl Iterator<Item = &Texel> {
    let texels = paint.views.iter().filter_map(|view| match view {
        View::Triangle {
            value: Interpolated::Texture { texels, .. },
            ..
        } => Some(texels),
        _ => None,
    });
    texels.flatten()
}

impl Texture {
    /// Whether a sample reads a single place of the base level.
    fn reads_base_once(&self) -> bool {
        self.taps == 1 && self.area.is_none() && matches!(self.levels.as_slice(), [level] if level.number == 0)
    }

    /// That a sample reads one texel.
    pub(super) fn single_texels(&self, exact: bool) -> Option<String> {
        let is_point = self.taps == 1 && self.area.is_none();
        let one = self.pixel_sampling == "nearest" && is_point && self.levels.len() == 1;
        let reader = if exact { "The pixel's centre" } else { "A sample" };
        one.then(|| format!("{reader} reads only the nearest texel."))
    }

    /// That a level averages as much across a long footprint as along it.
    pub(super) fn blurred_across(&self) -> Option<String> {
        // Neither fixed nor biased: the level is that of the longer side.
        let follows = (self.clamped - self.major.log2()).abs() < 0.01;
        let [long, wide] = self.footprint();
        let is_long = self.taps == 1 && self.area.is_none() && self.clamped > 0.0 && long > BLURS * wide;
        (self.level_sampling != "zero" && follows && is_long).then(|| {
            let ratio = if wide > 0.0 {
                number((long / wide).round())
            } else {
                "many".to_owned()
            };
            format!("The footprint is {ratio} times as long as wide, and its level averages as much across as along: that blurs.")
        })
    }

    /// Whether what is read was averaged, or summed, before.
    fn is_averaged_before(&self) -> bool {
        matches!(self.area, Some(AreaUse::Box { .. })) || self.reads_coarse_levels()
    }

    fn reads_coarse_levels(&self) -> bool {
        self.levels.iter().any(|level| level.number > 0)
    }

    /// What of each sample's reading is that of a whole pixel's footprint; `None` where nothing follows the footprint.
    pub(super) fn of_whole_pixel(&self) -> Option<&'static str> {
        let follows = !self.fixed && self.level_sampling != LevelSampling::Zero.name() && self.reads_coarse_levels();
        match self.area {
            Some(_) if self.fixed => None,
            Some(AreaUse::Box { .. }) => {
                Some("The box that each sample averages is that of a whole pixel, not of the sample's part of it.")
            }
            Some(AreaUse::Ellipse { .. }) => {
                Some("The ellipse that each sample weighs is that of a whole pixel, not of the sample's part of it.")
            }
            Some(AreaUse::Ripmap { .. }) => {
                Some("The ripmap's levels are those of a whole pixel's footprint, for each of its samples.")
            }
            None if self.taps > 1 && follows => {
                Some("The level of detail is that of a whole pixel, for each of its samples, and so are their taps.")
            }
            None if self.taps > 1 => Some(
                "The taps of each sample lie along the footprint of a whole pixel, not of the sample's part of it.",
            ),
            None => follows.then_some("The level of detail is that of a whole pixel, for each of its samples."),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::model::Level;
    use super::*;

    fn texture(pixel_sampling: &'static str, level_sampling: &'static str, [major, minor]: [f64; 2]) -> Texture {
        let clamped = if level_sampling == "zero" {
            0.0
        } else {
            major.max(1.0).log2()
        };
        let level = |number, weight| Level {
            number,
            size: [64, 64],
            weight,
        };
        Texture {
            name: "checker".to_owned(),
            index: 0,
            size: [64, 64],
            pixel_sampling,
            wrap: "clamp",
            asked: false,
            level_sampling,
            right: [major, 0.0],
            down: [0.0, minor],
            step: "pixel",
            major,
            minor,
            extent: "longer",
            taps: 1,
            level_of_detail: Some(major.log2()),
            clamped,
            bias: 0.0,
            fixed: false,
            levels: match level_sampling {
                "linear" => vec![level(3, 0.5), level(4, 0.5)],
                _ => vec![level(0, 1.0)],
            },
            area: None,
            pyramid: "stored",
            pyramid_filter: "box",
            opacity: 1.0,
        }
    }

    #[test]
    fn only_one_texel_is_said_to_be_the_only_one() {
        let taps = |taps, texture| Texture { taps, ..texture };
        for (texture, expected) in [
            (texture("nearest", "zero", [9.0, 8.0]), true),
            (texture("bilinear", "zero", [9.0, 8.0]), false),
            (texture("nearest", "linear", [9.0, 8.0]), false),
            (taps(16, texture("nearest", "zero", [9.0, 1.0])), false),
        ] {
            assert_eq!(texture.single_texels(false).is_some(), expected, "{texture:?}");
        }
    }

    #[test]
    fn long_footprints_are_blurred_where_one_tap_reads_their_level() {
        let long = texture("bilinear", "linear", [9.0, 1.0]);
        let blurs = |texture: &Texture| texture.blurred_across().is_some();
        assert!(blurs(&long), "nine times as long");
        for (texture, why) in [
            (texture("bilinear", "zero", [9.0, 1.0]), "level 0 averages nothing"),
            (texture("bilinear", "linear", [9.0, 8.0]), "nearly square"),
            (
                Texture {
                    taps: 5,
                    ..long.clone()
                },
                "taps lie along it",
            ),
            (Texture { clamped: 0.0, ..long }, "another level is fixed"),
        ] {
            assert!(!blurs(&texture), "{why}");
        }
    }

    #[test]
    fn what_is_of_a_whole_pixel_is_what_follows_its_footprint() {
        let coarse = texture("bilinear", "linear", [9.0, 8.0]);
        let base = texture("bilinear", "zero", [9.0, 1.0]);
        let area = |area| Texture {
            area: Some(area),
            ..texture("bilinear", "zero", [9.0, 8.0])
        };
        let boxed = area(AreaUse::Box { sides: [9.0, 8.0] });
        let level = "The level of detail is that of a whole pixel";
        for (texture, expected) in [
            (coarse.clone(), Some(level)),
            (base.clone(), None),
            (
                Texture {
                    fixed: true,
                    ..coarse.clone()
                },
                None,
            ),
            (Texture { taps: 3, ..coarse }, Some(level)),
            (
                Texture {
                    taps: 3,
                    ..base.clone()
                },
                Some("The taps of each sample lie along"),
            ),
            (
                Texture {
                    taps: 3,
                    fixed: true,
                    ..base
                },
                Some("The taps of each sample lie along"),
            ),
            (boxed.clone(), Some("The box that each sample averages")),
            (Texture { fixed: true, ..boxed }, None),
            (
                area(AreaUse::Ellipse { axes: [[9.0, 0.0]; 2] }),
                Some("The ellipse that each sample weighs"),
            ),
            (
                area(AreaUse::Ripmap {
                    detail: [3.0; 2],
                    widths: 7,
                }),
                Some("The ripmap's levels are those of"),
            ),
        ] {
            let told = texture.of_whole_pixel();
            let is_so = match expected {
                Some(expected) => told.is_some_and(|told| told.starts_with(expected)),
                None => told.is_none(),
            };
            assert!(is_so, "{told:?} of {texture:?}");
        }
    }
}
