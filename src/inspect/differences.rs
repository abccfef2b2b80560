//! What differs between two explanations of the same pixel: A's settings against B's.

use super::model::{Explanation, Texture};
use super::numbers::{number, percent};
use super::siblings::parts;

/// One thing that differs, in words.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Difference {
    /// What.
    pub what: String,
    /// What it is in A.
    pub a: String,
    /// What it is in B.
    pub b: String,
}

impl Explanation {
    /// What differs in `b`, from the colour back to the texels; empty where both tell the same.
    pub fn differences(&self, b: &Self) -> Vec<Difference> {
        let mut found = Vec::new();
        let mut compare = |what: &str, a: String, b: String| {
            if a != b {
                let what = what.to_owned();
                found.push(Difference { what, a, b });
            }
        };
        compare("colour", self.hex.clone(), b.hex.clone());
        if let Some([mine, other]) = self.means(b) {
            compare("mean", mine, other);
        }
        let samples = |of: &Self| {
            if of.exact {
                "none: exact areas".to_owned()
            } else {
                of.samples.len().to_string()
            }
        };
        compare("samples", samples(self), samples(b));
        if let Some([mine, other]) = self.places(b) {
            compare("their places", mine, other);
        }
        let filter = |of: &Self| {
            let wide = of.resolve.around.as_ref();
            wide.map_or("box".to_owned(), |wide| {
                format!("{} of radius {}", wide.filter, number(wide.radius))
            })
        };
        compare("filter", filter(self), filter(b));
        let smoothed = |of: &Self| {
            of.smoothing
                .as_ref()
                .map_or("none", |smoothing| smoothing.by)
                .to_owned()
        };
        compare("post-process", smoothed(self), smoothed(b));
        compare("averaged as", self.resolve.space.to_owned(), b.resolve.space.to_owned());
        if let [Some(mine), Some(other)] = [self, b].map(Self::background) {
            compare("background", percent(mine), percent(other));
        }
        let mut textures: Vec<(String, Difference)> = Vec::new();
        for part in parts(self, b) {
            let covered = |side: usize, of: &Self| match part.covered(side, of) {
                None if of.exact => "nothing".to_owned(),
                None => "no sample".to_owned(),
                Some(covered) => percent(covered),
            };
            compare(&format!("{} covers", part.name), covered(0, self), covered(1, b));
            if let [Some(mine), Some(other)] = [0, 1].map(|side| part.texture(side)) {
                let of_paint = TEXTURE.iter().map(|(what, words)| Difference {
                    what: (*what).to_owned(),
                    a: words(mine),
                    b: words(other),
                });
                textures.extend(of_paint.map(|difference| (part.name.clone(), difference)));
            }
        }
        found.extend(by_what(&textures));
        found
    }

    /// Where the first sample that lies elsewhere lies; `None` where all lie alike, or there are not equally many.
    fn places(&self, b: &Self) -> Option<[String; 2]> {
        if self.exact || b.exact || self.samples.len() != b.samples.len() {
            return None;
        }
        let mut pairs = self.samples.iter().zip(&b.samples).zip(1..);
        let is_elsewhere = |[a, b]: [[f64; 2]; 2]| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) > 1e-6;
        let ((mine, other), sample) = pairs.find(|((mine, other), _)| is_elsewhere([mine.position, other.position]))?;
        Some([mine, other].map(|of| {
            let [x, y] = of.position.map(|at| number((at * 1000.0).round() / 1000.0));
            format!("sample {sample} at {x}, {y}")
        }))
    }

    /// Both means in one unit: light and stored values are two, and there the mean is told as it is stored. `None` where these
    /// show one colour.
    fn means(&self, b: &Self) -> Option<[String; 2]> {
        let one_unit = self.resolve.space == b.resolve.space;
        if !one_unit && self.hex == b.hex {
            return None;
        }
        let words = |of: &Self| {
            let mean = if one_unit {
                of.resolve.mean
            } else {
                of.resolve.stored_mean()
            };
            mean.map(|channel| number((channel * 100.0).round() / 100.0)).join(", ")
        };
        Some([words(self), words(b)])
    }

    /// The part of the pixel that shows the background; `None` where its one colour does not tell.
    fn background(&self) -> Option<f64> {
        if self.exact {
            return self.area_shares().map(|shares| shares.background);
        }
        let shown = self.samples.iter().filter(|sample| sample.seen.is_none()).count();
        Some(shown as f64 / self.samples.len().max(1) as f64)
    }
}

/// What differs of textures, in the table's order: once where it is the same of all, else with the names of the primitives.
fn by_what(textures: &[(String, Difference)]) -> Vec<Difference> {
    let of_row = |(what, _): &(&str, InWords)| {
        let rows: Vec<&(String, Difference)> = textures.iter().filter(|(_, row)| row.what == *what).collect();
        let alike = rows.windows(2).all(|pair| pair[0].1 == pair[1].1);
        let mut told: Vec<Difference> = Vec::new();
        for (name, row) in rows.into_iter().filter(|(_, row)| row.a != row.b) {
            let mut row = row.clone();
            if !alike {
                row.what = format!("{name}: {what}");
            }
            if !told.contains(&row) {
                told.push(row);
            }
        }
        told
    };
    TEXTURE.iter().flat_map(of_row).collect()
}

/// Something about a texture in words.
type InWords = fn(&Texture) -> String;

/// How a textured primitive may be read differently.
const TEXTURE: [(&str, InWords); 6] = [
    ("pixel sampling", |texture| texture.pixel_sampling.to_owned()),
    ("texture wrap", |texture| texture.wrap.to_owned()),
    ("level sampling", |texture| texture.level_sampling.to_owned()),
    ("taps", |texture| texture.taps.to_string()),
    ("level of detail", |texture| {
        number((texture.clamped * 1000.0).round() / 1000.0)
    }),
    ("levels read", |texture| {
        let levels: Vec<String> = texture
            .levels
            .iter()
            .map(|level| format!("{} of {}", percent(level.weight), level.number))
            .collect();
        levels.join(", ")
    }),
];
