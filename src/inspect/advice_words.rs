//! What would change a pixel for the better, and with which key: the step from why to what to do.
//!
//! A setting is advised only where it was tried on this pixel and brought it nearer to the truth (see [`super::Truth`]).
//! What is said of the reason is read off what was recorded of the pixel, and left away where nothing fits.

use std::collections::BTreeSet;

use super::model::{Causes, Cure, Explanation, Missed, MissedCause, NotDrawn, Paint, Setting, Texture, Truth, View};
use super::numbers::{about, number, percent, significant};
use crate::color::ResolveSpace;
use crate::raster::{PixelCoverage, SampleRate, ShadingRate};
use crate::texture::PyramidFilter;

/// The part of a pixel by which samples may be wrong about coverage before anybody is told.
const WRONG: f64 = 0.2;
/// The part of what a setting brings that a reason has to account for.
pub(super) const MOSTLY: f64 = 0.5;
/// Levels by which two truths may differ before anybody is told: at a plain edge they do by up to so many.
const SURE: f64 = 6.0;

impl Explanation {
    /// How far the pixel is from the truth, then everything that would bring it nearer; empty where nobody asked.
    pub fn help_lines(&self) -> Vec<String> {
        let verdict = self.truth.as_ref().map(|truth| truth.verdict(&self.samples_of_truth()));
        let lacking = verdict.as_ref().and(self.not_drawn.as_ref()).map(NotDrawn::words);
        let untried = self.untried.map(|corners| {
            format!("No setting was tried: {corners} corners reach this pixel's surroundings, too many to draw them again and again.")
        });
        let first = verdict.into_iter().chain(lacking).chain(untried);
        first.chain(self.hints()).collect()
    }

    /// The samples that the truth has, in words.
    fn samples_of_truth(&self) -> String {
        let filter = self.resolve.around.as_ref().map(|around| around.filter);
        let weighed = filter.map_or(String::new(), |filter| format!(" under the same {filter} filter"));
        format!("{} samples{weighed}", SampleRate::MAX)
    }

    /// What is wrong about seams here, then each setting that would bring this pixel nearer to the truth, the best first, with
    /// the reason where one is known; empty where all is well.
    pub fn hints(&self) -> Vec<String> {
        let cures = self.truth.iter().flat_map(|truth| &truth.cures);
        self.seams()
            .into_iter()
            .chain(cures.map(|cure| self.hint(cure)))
            .collect()
    }

    /// The reason, what to do and what it brings.
    fn hint(&self, cure: &Cure) -> String {
        let mut words = self.reason(cure).map_or(String::new(), |reason| reason + " ");
        words += &cure.words();
        words
    }

    /// What is wrong with this pixel that a setting cures.
    fn reason(&self, cure: &Cure) -> Option<String> {
        match cure.setting {
            Setting::SampleRate => self.coverage_reason(cure).or_else(|| self.texels_between(cure)),
            Setting::LevelSampling => self.level_sampling_reason(cure),
            Setting::Anisotropy => self.blurred_or_few(cure),
            Setting::PixelSampling => self.wrong_texture()?.1.single_texels(self.exact),
            Setting::LodLevel => Some("A fixed level of detail is read here, whatever the footprint.".to_owned()),
            Setting::LodBias => Some("A bias is added to the level of detail.".to_owned()),
            Setting::LodPer => self
                .seen_textures()
                .find_map(Texture::of_whole_pixel)
                .map(str::to_owned),
            Setting::Pyramid => self.pyramid_reason(cure),
            Setting::PyramidFilter => match self.wrong_texture()?.1.filtered_by() {
                PyramidFilter::Box => None,
                PyramidFilter::Tent => {
                    Some("Each texel of a mip level holds an eighth of those beside its own.".to_owned())
                }
                PyramidFilter::Kaiser => {
                    Some("The Kaiser filter of the mip levels overshoots beside edges.".to_owned())
                }
            },
            Setting::LodBy => self.wrong_texture().map(|(_, texture)| {
                format!(
                    "The level of detail follows {} of the footprint, and its longer side reaches further.",
                    texture.extent_words()
                )
            }),
            Setting::ShadingRate => self.shaded_elsewhere(cure),
            Setting::PostProcess => Some(match self.smoothing {
                Some(_) => "SMAA has guessed here.".to_owned(),
                None => "A guess from the form of the edges happens to fit here.".to_owned(),
            }),
            Setting::Coverage => self.mixed_areas(),
            Setting::Rules | Setting::Pattern => None,
        }
    }

    /// The topmost primitive that is seen.
    pub(super) fn topmost(&self) -> Option<&Paint> {
        self.paints.get(self.topmost_number()?)
    }

    /// Its number among the paints.
    fn topmost_number(&self) -> Option<usize> {
        self.paints.iter().rposition(Paint::is_seen)
    }

    /// The topmost primitive that is seen, as the report numbers it.
    fn topmost_numbered(&self) -> Option<String> {
        self.topmost_number().map(|paint| self.numbered(paint))
    }

    /// The distance of neighbouring samples, in pixels.
    pub(super) fn step(&self) -> f64 {
        1.0 / (self.samples.len().max(1) as f64).sqrt()
    }

    /// Whether a primitive passes between the samples.
    pub(super) fn is_thin(&self, missed: &Missed) -> bool {
        self.is_less_than_apart(missed.width)
    }

    /// Whether so many pixels are less than what lies between samples, by more than snapping takes from a width.
    pub(super) fn is_less_than_apart(&self, width: f64) -> bool {
        const SNAPPED: f64 = 0.99;
        width < self.step() * SNAPPED
    }

    /// What is wrong with what is covered, if most of what a setting brings comes of that.
    fn coverage_reason(&self, cure: &Cure) -> Option<String> {
        let covered = self.truth.as_ref()?.causes.coverage;
        (covered >= cure.nearer * MOSTLY).then_some(())?;
        self.missed_parts(cure)
            .or_else(|| self.thin_topmost(cure))
            .or_else(|| self.wrong_coverage(cure))
    }

    /// What the samples miss, if most of what a setting brings comes of it.
    fn missed_parts(&self, cure: &Cure) -> Option<String> {
        if self.exact || self.resolve.around.is_some() {
            // Neighbours' samples decide, too: the pixel may show too much of it as well as too little.
            return None;
        }
        let Causes { thin, missed, .. } = self.truth.as_ref()?.causes;
        let is_reason = |cause: MissedCause| cause.part > 0.0 && cause.levels >= cure.nearer * MOSTLY;
        if is_reason(thin) {
            let part = thin.part_words();
            return Some(if thin.small {
                format!("What is small lies between the samples here, {part} of the pixel: it vanishes.")
            } else {
                format!("What is thin passes between the samples here, {part} of the pixel: it breaks up.")
            });
        }
        is_reason(missed).then(|| {
            let part = missed.part_words();
            format!("No sample meets some of what is here, {part} of the pixel.")
        })
    }

    /// Whether most of what a setting brings comes of the topmost primitive.
    fn is_of_topmost(&self, cure: &Cure) -> bool {
        let causes = self.truth.as_ref().map(|truth| &truth.causes);
        causes.is_some_and(|causes| causes.topmost >= cure.nearer * MOSTLY)
    }

    /// What is seen here, and is missed where it passes between the samples.
    fn thin_topmost(&self, cure: &Cure) -> Option<String> {
        let paint = self.topmost().filter(|paint| !paint.is_crisp())?;
        let width = paint.width.filter(|width| self.is_less_than_apart(*width))?;
        (self.resolve.around.is_none() && self.is_of_topmost(cure)).then_some(())?;
        let (named, apart) = (self.topmost_numbered()?, significant(self.step()));
        if let Some(length) = paint.length.filter(|length| self.is_less_than_apart(*length)) {
            let length = significant(length);
            return Some(format!(
                "Here {named} is {length} px long, less than samples are apart ({apart} px): it vanishes where it lies between them."
            ));
        }
        let width = significant(width);
        Some(format!(
            "Here {named} is {width} px wide, less than samples are apart ({apart} px): it breaks up where it passes between them."
        ))
    }

    fn wrong_coverage(&self, cure: &Cure) -> Option<String> {
        let paint = self.topmost()?;
        let (part, area) = (self.covered_part(paint), paint.area.filter(|_| !paint.is_crisp())?);
        let is_wrong = (part - area).abs() > WRONG && self.explains(paint, area) && self.is_of_topmost(cure);
        let named = self.topmost_numbered().filter(|_| is_wrong)?;
        let [part, area] = [part, area].map(percent);
        Some(format!(
            "By its samples {named} covers {part} of the pixel; by area, {area}."
        ))
    }

    /// Whether the truth can be a paint's colour over this part of the pixel and some colour over the rest.
    fn explains(&self, paint: &Paint, area: f64) -> bool {
        /// Levels that a truth of so many samples, and a paint of several colours, may be away.
        const ABOUT: f64 = 8.0;
        if paint.layers > 0 || self.resolve.space == ResolveSpace::Linear.name() {
            // Elsewhere a mean is no sum of parts.
            return true;
        }
        let shades = || paint.fragments.iter().map(|fragment| fragment.after);
        let count = shades().count().max(1) as f64;
        self.truth.as_ref().is_none_or(|truth| {
            let [.., alpha] = truth.color.map(f64::from);
            (0..4).all(|channel| {
                let own = shades().map(|color| color[channel]).sum::<f64>() / count;
                let whole = f64::from(truth.color[channel]) * if channel < 3 { alpha / 255.0 } else { 1.0 };
                let rest = whole - area * own;
                (-ABOUT..=255.0 * (1.0 - area) + ABOUT).contains(&rest)
            })
        })
    }

    /// That the colour which is wrong was computed once for the pixel, and where, if `cure` computes it at each sample or elsewhere.
    fn shaded_elsewhere(&self, cure: &Cure) -> Option<String> {
        /// Weights of places on an edge are zero but for rounding.
        const OUTSIDE: f64 = -1e-9;
        let is_outside = |view: &View| match view {
            View::Triangle { weights, .. } => weights.iter().any(|weight| *weight < OUTSIDE),
            View::Polygon { .. } => false,
        };
        let number = self.truth.as_ref()?.causes.off_color?;
        let (paint, named) = (self.paints.get(number)?, self.numbered(number));
        let extrapolates = paint.is_shaded_in_centre()? && paint.views.first().is_some_and(is_outside);
        if extrapolates {
            return Some(format!(
                "For the whole pixel {named} is shaded once, in its centre, which lies outside: its colour is extrapolated."
            ));
        }
        let is_at_each = cure.value == ShadingRate::Sample.name();
        is_at_each.then(|| format!("For the whole pixel {named} is shaded once, not at each of its samples."))
    }

    /// The part of the samples that any piece of a paint's primitive covers.
    pub(super) fn covered_part(&self, paint: &Paint) -> f64 {
        if self.exact {
            return paint.covered.unwrap_or(1.0);
        }
        let pieces = self
            .paints
            .iter()
            .filter(|other| other.primitive == paint.primitive && other.area.is_some());
        let covered: BTreeSet<usize> = pieces.flat_map(Paint::samples).collect();
        covered.len() as f64 / self.samples.len().max(1) as f64
    }
}

impl NotDrawn {
    /// What the truth lacks.
    fn words(&self) -> String {
        let others = match self.others {
            0 => String::new(),
            1 => " and one other thing".to_owned(),
            others => format!(" and {others} other things"),
        };
        format!(
            "The truth is that of what is drawn: {} (line {}){others} in the document {} not.",
            self.name,
            self.line,
            if self.others == 0 { "is" } else { "are" },
        )
    }
}

impl Truth {
    /// How far the pixel is from it, in one sentence.
    fn verdict(&self, samples: &str) -> String {
        let is_sure = self.unsure <= SURE;
        let far = levels(self.distance);
        let verdict = if self.distance == 0.0 && is_sure {
            return format!("This pixel is what it should be: it has the colour of the truth ({samples}).");
        } else if self.distance <= 1.0 && is_sure {
            return format!("This pixel is what it should be, within 1 level of the truth ({samples}).");
        } else if self.distance == 0.0 {
            format!("This pixel has the colour of the truth ({samples}).")
        } else if self.is_reached() {
            format!("This pixel is within {far} of the truth ({samples}).")
        } else if self.cures.is_empty() {
            format!(
                "This pixel is within {far} of the truth ({samples}); no setting that was tried brings it nearer by more than {} by itself.",
                levels(self.least())
            )
        } else {
            format!("This pixel is {far} from the truth ({samples}).")
        };
        if is_sure && !self.is_reached() {
            return verdict;
        }
        let apart = levels(self.unsure);
        format!("{verdict} So many are too few to be sure here: as many at other places give a colour {apart} away.")
    }
}

impl MissedCause {
    /// The part of the pixel in words, as exactly as it is known.
    fn part_words(&self) -> String {
        match self.area {
            Some(area) => percent(area),
            None => about(self.part),
        }
    }
}

impl Cure {
    /// What to set, the key that steps through the values, and what it brings.
    fn words(&self) -> String {
        let value = &self.value;
        let what = match self.setting {
            Setting::Rules => match self.dialect {
                Some(dialect) => format!("Rules {value} with dialect {dialect}"),
                None => format!("Rules {value}"),
            },
            Setting::LodLevel => "The level of detail as computed (key M steps to it in the window)".to_owned(),
            Setting::LodBias => format!("Bias {value} (keys comma and full stop step to it in the window)"),
            Setting::LevelSampling => format!("Level sampling {value} (key L steps to it in the window)"),
            Setting::Anisotropy => format!("Anisotropy {value} (key T steps to it in the window)"),
            Setting::LodPer => format!("Level of detail per {value}"),
            Setting::LodBy => format!("Level of detail by the {value} side"),
            Setting::Pyramid => format!("Pyramid {value}"),
            Setting::PyramidFilter => format!("Pyramid filter {value}"),
            Setting::PixelSampling => format!("Pixel sampling {value} (key P steps to it in the window)"),
            Setting::ShadingRate if value == ShadingRate::Centroid.name() => {
                "Shading in the centroid of the covered samples".to_owned()
            }
            Setting::ShadingRate => format!("Shading per {value}"),
            Setting::Coverage if value == PixelCoverage::Exact.name() => "Coverage by exact areas".to_owned(),
            Setting::Coverage => match self.samples {
                Some(samples) => format!("Coverage by {samples} samples"),
                None => "Coverage by samples".to_owned(),
            },
            Setting::SampleRate if value == "256" => format!("{value} samples"),
            Setting::SampleRate => format!("{value} samples (key = steps to it in the window)"),
            Setting::Pattern => {
                let rate = self
                    .samples
                    .map_or(String::new(), |samples| format!(" with {samples} samples"));
                format!(
                    "Pattern {value}{rate} (key A steps to it in the window), whose samples share neither columns nor rows"
                )
            }
            Setting::PostProcess => format!("Post-process {value}"),
        };
        // Kernels continue a texture between its texels, in the truth, too: the next verdict is by another one.
        let moves = if self.setting == Setting::PixelSampling {
            ", which it moves, too"
        } else {
            ""
        };
        format!("{what}: {} nearer to the truth{moves}.", levels(self.nearer))
    }
}

/// Levels with one digit after the point at most.
fn levels(count: f64) -> String {
    let count = number((count * 10.0).round() / 10.0);
    let plural = if count == "1" { "" } else { "s" };
    format!("{count} level{plural}")
}
