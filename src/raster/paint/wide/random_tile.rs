//! Tiles for tests.

use arbtest::arbitrary::{Result, Unstructured};

use crate::color::{Premultiplied16, ResolveSpace};
use crate::raster::SampleRate;
use crate::raster::paint::sample_colors::{SampleColors, ShadedColors};
use crate::raster::span::{Span, SpanRect};
use crate::rules::Rules;

/// Pixels of the tile.
pub(super) const SIZE: [i32; 2] = [13, 6];

/// A tile and its margin, some pixels of which are split into so many samples.
pub(super) fn painted(u: &mut Unstructured<'_>, count: i32, margin: i32) -> Result<SampleColors> {
    let rate = SampleRate::new(count.cast_unsigned()).expect("a rate");
    let [x, y] = SIZE.map(|length| Span {
        start: 0,
        end: length + 2 * margin,
    });
    let mut colors = SampleColors::new(rate, Rules::Standard, ResolveSpace::Stored);
    colors.reset(SpanRect { x, y }, Premultiplied16([Premultiplied16::ONE; 4]));
    let opaque = u.ratio(3, 4)?;
    for _ in 0..u.int_in_range(0..=20)? {
        let (row, start) = (u.int_in_range(0..=y.end - 1)?, u.int_in_range(0..=x.end - 1)?);
        let pixels = Span {
            start,
            end: u.int_in_range(start + 1..=x.end)?,
        };
        let samples = if u.arbitrary()? {
            pixels.length() * usize::try_from(count).unwrap_or(0)
        } else {
            1
        };
        let any = |_| {
            let alpha = if opaque {
                Premultiplied16::ONE
            } else {
                u.int_in_range(0..=Premultiplied16::ONE)?
            };
            let mut channel = || u.int_in_range(0..=alpha);
            Ok(Premultiplied16([channel()?, channel()?, channel()?, alpha]))
        };
        let found = (0..samples).map(any).collect::<Result<Vec<_>>>()?;
        if samples == 1 {
            colors.fill(pixels, row, found[0]);
        } else {
            colors.write(pixels, row, ShadedColors { colors: &found, opaque });
        }
    }
    Ok(colors)
}
