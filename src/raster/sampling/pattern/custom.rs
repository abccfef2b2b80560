//! Custom patterns: places and weights that somebody wrote down, such as the standard ones of graphics hardware.
//!
//! A sample of weight `w` is taken `w` times, so that the resolve counts it as often and no other pattern pays for weights. A
//! process keeps each pattern that it is given, once, so that a [`CustomPattern`] is a reference that is compared by its address;
//! how many there are is bounded, because records and scripts of strangers bring them, too.

use std::fmt;
use std::hash::{Hash, Hasher};
use std::sync::{Arc, Mutex, PoisonError};

use super::arrange::{Arrange, Fixed, Place, Position};
use super::entry::{Entry, Spread};
use crate::geometry::subpixel::SubpixelGrid;
use crate::raster::sampling::rate::SampleRate;

/// A sample of a custom pattern.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CustomSample {
    /// Right and down from the pixel's corner, in points of the lattice: 1/256 of a pixel.
    pub place: [u8; 2],
    /// How often it counts: 1 at least.
    pub weight: u32,
}

/// What people say of a custom pattern.
#[derive(Clone, Copy, Debug, Default)]
pub struct CustomWords<'w> {
    /// The name used in the command line and the interface: up to [`CustomPattern::LONGEST_NAME`] letters, digits and hyphens, a
    /// letter first.
    pub name: &'w str,
    /// Where its samples lie, in few words; nothing where nobody said it.
    pub description: &'w str,
    /// Whom it goes back to, or nothing.
    pub source: &'w str,
}

/// A pattern of places and weights that somebody wrote down. Equal ones are the same one.
pub struct CustomPattern {
    samples: Vec<CustomSample>,
    rate: SampleRate,
    pub(super) entry: Entry,
}

/// Why samples are no pattern.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CustomPatternError {
    /// The name is none.
    #[error("\"{0}\" is not a name for a pattern; take up to 32 letters, digits and hyphens, a letter first")]
    Name(String),
    /// There are no samples, or too many.
    #[error("{0} samples; a pattern has 1 to 256, each counted as often as its weight says")]
    Count(u64),
    /// A weight is none.
    #[error("a weight of 0; take a whole number from 1 to 256, or leave the sample out")]
    Weight,
    /// The program has seen too many patterns.
    #[error("more than {most} patterns in one run of the program; start it again", most = CustomPattern::MOST)]
    Full,
}

/// Every pattern that there is.
static KNOWN: Mutex<Vec<&'static CustomPattern>> = Mutex::new(Vec::new());

impl CustomPattern {
    /// Characters of the longest name.
    pub const LONGEST_NAME: usize = 32;
    /// Different patterns that a process takes.
    pub const MOST: usize = 2048;

    /// The pattern of these samples. Where one of this name has the same samples it is that one, with its other words.
    ///
    /// # Errors
    /// When name, weights or the number of samples are none of a pattern, or after too many patterns.
    pub fn new(words: CustomWords<'_>, samples: &[CustomSample]) -> Result<&'static Self, CustomPatternError> {
        let is_word = |c: char| c.is_ascii_alphanumeric() || c == '-';
        let name = words.name;
        if name.len() > Self::LONGEST_NAME
            || !name.starts_with(|c: char| c.is_ascii_alphabetic())
            || !name.chars().all(is_word)
        {
            let short: String = name.chars().take(2 * Self::LONGEST_NAME).collect();
            return Err(CustomPatternError::Name(short));
        }
        if samples.iter().any(|sample| sample.weight == 0) {
            return Err(CustomPatternError::Weight);
        }
        let count: u64 = samples.iter().map(|sample| u64::from(sample.weight)).sum();
        let rate = u32::try_from(count).ok().and_then(SampleRate::new);
        let rate = rate.ok_or(CustomPatternError::Count(count))?;
        // Nothing panics while it is held.
        let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(same) = known
            .iter()
            .find(|other| other.entry.name == name && other.samples == samples)
        {
            return Ok(same);
        }
        if known.len() >= Self::MOST {
            return Err(CustomPatternError::Full);
        }
        let pattern: &'static Self = Box::leak(Box::new(Self::of(words, samples, rate)));
        known.push(pattern);
        Ok(pattern)
    }

    fn of(words: CustomWords<'_>, samples: &[CustomSample], rate: SampleRate) -> Self {
        let keep = |text: &str| -> &'static str { Box::leak(text.to_owned().into_boxed_str()) };
        let repeated = |sample: &CustomSample| std::iter::repeat_n(sample.place, sample.weight as usize);
        let places: &'static Places = Box::leak(Box::new(Places(samples.iter().flat_map(repeated).collect())));
        Self {
            samples: samples.to_vec(),
            rate,
            entry: Entry {
                name: keep(words.name),
                description: match words.description {
                    "" => "places that somebody wrote down",
                    description => keep(description),
                },
                source: keep(words.source),
                needs_square: false,
                spread: Spread::Fixed,
                arrange: places,
            },
        }
    }

    /// Its name.
    pub const fn name(&self) -> &'static str {
        self.entry.name
    }

    /// Its samples, in their order.
    pub fn samples(&self) -> &[CustomSample] {
        &self.samples
    }

    /// How many samples a pixel has, each as often as it counts: the only rate that the pattern takes.
    pub fn rate(&self) -> SampleRate {
        self.rate
    }

    /// Whether it is one sample in the pixel's centre.
    pub(super) fn is_centre(&self) -> bool {
        const CENTRE: [u8; 2] = [128; 2];
        matches!(self.samples.as_slice(), [sample] if sample.place == CENTRE && sample.weight == 1)
    }

    /// The pattern that [`CustomPattern`]'s `Display` writes: `None` where the text is none.
    pub fn parse(text: &str) -> Option<&'static Self> {
        let (name, list) = text.split_once(':')?;
        // A sample takes three characters at least, and each sample counts.
        let most = SampleRate::MAX as usize;
        let samples: Option<Vec<CustomSample>> = list.split('+').take(most + 1).map(sample).collect();
        let words = CustomWords {
            name,
            ..CustomWords::default()
        };
        Self::new(words, &samples?).ok()
    }
}

/// `X/Y` or `X/YxWEIGHT`.
fn sample(text: &str) -> Option<CustomSample> {
    let digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
    let (x, rest) = text.split_once('/')?;
    let (y, weight) = rest.split_once('x').unwrap_or((rest, "1"));
    if ![x, y, weight].into_iter().all(digits) {
        return None;
    }
    Some(CustomSample {
        place: [x.parse().ok()?, y.parse().ok()?],
        weight: weight.parse().ok()?,
    })
}

/// Name and samples in one word without commas, blanks and signs of shells: `NAME:X/Y+X/YxWEIGHT`, in 1/256 of a pixel.
impl fmt::Display for CustomPattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.entry.name)?;
        for (sample, sign) in self
            .samples
            .iter()
            .zip(std::iter::once(':').chain(std::iter::repeat('+')))
        {
            let [x, y] = sample.place;
            write!(f, "{sign}{x}/{y}")?;
            if sample.weight > 1 {
                write!(f, "x{}", sample.weight)?;
            }
        }
        Ok(())
    }
}

impl fmt::Debug for CustomPattern {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{self}")
    }
}

impl PartialEq for CustomPattern {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
    }
}

impl Eq for CustomPattern {}

impl Hash for CustomPattern {
    fn hash<H: Hasher>(&self, state: &mut H) {
        std::ptr::hash(self, state);
    }
}

/// The places of all samples, each as often as it counts.
#[derive(Debug)]
struct Places(Vec<Position>);

impl Arrange for Places {
    fn prepare(&self, rate: SampleRate) -> Arc<dyn Place> {
        let mut places = self.0.iter().cycle();
        let lattice = SubpixelGrid::FINE_SIDE;
        debug_assert_eq!(self.0.len(), rate.samples() as usize, "the only rate that it takes");
        let all: Vec<[u32; 2]> = (0..rate.samples())
            .map(|_| places.next().map_or([lattice / 2; 2], |place| place.map(u32::from)))
            .collect();
        Fixed::by(rate, |sample| all[sample as usize])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::SamplePattern;

    fn pattern(text: &str) -> &'static CustomPattern {
        CustomPattern::parse(text).expect(text)
    }

    #[test]
    fn custom_patterns_are_read_as_they_are_written() {
        for text in ["a:0/0", "Cross-5:128/128x4+0/255+255/0", "b:1/2+1/2"] {
            assert_eq!(pattern(text).to_string(), text, "as it was");
            assert_eq!(pattern(text), pattern(text), "the same one");
        }
        assert_ne!(pattern("a:0/0"), pattern("a:0/1"), "of the same name");
        assert_eq!(pattern("c:1/2x3+4/5").rate().samples(), 4, "weights count");
        for wrong in [
            "",
            "a",
            "a:",
            ":1/1",
            "1a:1/1",
            "a b:1/1",
            "a:256/0",
            "a:1/1x0",
            "a:1/1x257",
            "a:+1/1",
            "a:1/-1",
            "a:1/1,2/2",
        ] {
            assert_eq!(CustomPattern::parse(wrong), None, "{wrong}");
        }
        assert_eq!(
            CustomPattern::parse(&format!("a:1/1{}", "+1/1".repeat(256))),
            None,
            "257 samples"
        );
    }

    #[test]
    fn custom_patterns_take_their_own_rate_alone() {
        let three = SamplePattern::Custom(pattern("three:1/2+3/4+5/6"));
        let rate = |samples| SampleRate::new(samples).expect("a rate");
        assert!(three.takes(rate(3)) && !three.takes(rate(4)), "3 samples");
        assert_eq!(three.nearest(rate(16)), rate(3), "no other");
        let refusal = three.refusal(rate(16)).expect("another rate");
        assert!(
            refusal.starts_with("pattern three takes 3 samples, not 16; "),
            "{refusal}"
        );
        let centre = SamplePattern::Custom(pattern("middle:128/128"));
        assert_eq!(centre.simplest(SampleRate::ONE), SamplePattern::Grid, "drawn fastest");
    }
}
