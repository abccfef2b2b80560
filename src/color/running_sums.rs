//! What pieces of a list of samples add up to: differences of running sums.
//!
//! ```text
//!   samples      a    b    c    d    e    f
//!   running   0  a  a..b a..c a..d a..e a..f
//!   pieces       [   a..c   ] [d]  [  e..f  ]     a..e less a..c is d
//! ```
//!
//! A piece is a fragment: a few samples, and how many no processor foresees. A loop over each of them would end in a mispredicted
//! branch, which takes as long as the sums.

use crate::color::{Light, LightResolver, Premultiplied16};

/// Running sums of channels of samples, and the memory for them.
#[derive(Debug, Default)]
pub(crate) struct RunningSums {
    stored: Vec<[u32; 4]>,
    light: Vec<[u64; 3]>,
}

impl RunningSums {
    /// Visits what red, green, blue and alpha of each piece add up to; pieces are so many samples long, one after the other, and
    /// all of `samples` together. No piece has more than 256.
    #[inline]
    pub(crate) fn stored(
        &mut self,
        samples: &[Premultiplied16],
        pieces: impl Iterator<Item = u32>,
        mut visit: impl FnMut([u32; 4]),
    ) {
        // What runs over in long lists, differences do not know.
        run(&mut self.stored, samples, |sum, Premultiplied16(channels)| {
            for (sum, channel) in sum.iter_mut().zip(channels) {
                *sum = sum.wrapping_add(u32::from(channel));
            }
        });
        let mut before = [0; 4];
        each_end(&self.stored, pieces, |sum, _| {
            visit([0, 1, 2, 3].map(|k| sum[k].wrapping_sub(before[k])));
            before = *sum;
        });
    }

    /// The same of the light of opaque samples.
    #[inline]
    pub(crate) fn opaque_light(
        &mut self,
        resolver: &LightResolver,
        samples: &[Premultiplied16],
        pieces: impl Iterator<Item = u32>,
        mut visit: impl FnMut(Light),
    ) {
        let light = resolver.of_stored();
        run(&mut self.light, samples, |sum, Premultiplied16([r, g, b, _])| {
            for (sum, channel) in sum.iter_mut().zip([r, g, b]) {
                *sum += u64::from(light[usize::from(channel)]);
            }
        });
        let mut before = [0; 3];
        each_end(&self.light, pieces, |sum, count| {
            visit(Light::of_opaque([0, 1, 2].map(|k| sum[k] - before[k]), count));
            before = *sum;
        });
    }
}

/// Fills `running`: none of the samples, the first one, the first two and so on, as `add` adds them.
#[inline(always)]
#[expect(clippy::inline_always, reason = "for what is added to stay in registers")]
fn run<const N: usize, T: Copy + Default>(
    running: &mut Vec<[T; N]>,
    samples: &[Premultiplied16],
    add: impl Fn(&mut [T; N], Premultiplied16),
) where
    [T; N]: Default,
{
    if running.len() <= samples.len() {
        running.resize(samples.len() + 1, [T::default(); N]);
    }
    let mut sum = [T::default(); N];
    for (running, sample) in running[1..].iter_mut().zip(samples) {
        add(&mut sum, *sample);
        *running = sum;
    }
}

/// Visits the running sum at the end of each piece, and how long the piece is.
#[inline]
fn each_end<T>(running: &[T], pieces: impl Iterator<Item = u32>, mut visit: impl FnMut(&T, u32)) {
    let mut end = 0;
    for count in pieces {
        end += count as usize;
        visit(&running[end], count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rules::Rules;

    #[test]
    fn pieces_add_up_to_the_sums_of_their_samples() {
        let mut running = RunningSums::default();
        arbtest::arbtest(|u| {
            let mut pieces = Vec::new();
            for _ in 0..u.int_in_range(0..=40)? {
                pieces.push(u.int_in_range(0..=9)?);
            }
            let count: u32 = pieces.iter().sum();
            let samples = (0..count)
                .map(|_| {
                    let mut channel = || u.int_in_range(0..=Premultiplied16::ONE);
                    Ok(Premultiplied16([
                        channel()?,
                        channel()?,
                        channel()?,
                        Premultiplied16::ONE,
                    ]))
                })
                .collect::<Result<Vec<_>, arbtest::arbitrary::Error>>()?;
            let resolver = LightResolver::new(16, Rules::Standard);
            let (mut stored, mut light) = (Vec::new(), Vec::new());
            running.stored(&samples, pieces.iter().copied(), |sum| stored.push(sum));
            running.opaque_light(&resolver, &samples, pieces.iter().copied(), |sum| light.push(sum));
            let mut rest = &samples[..];
            for (i, piece) in pieces.iter().enumerate() {
                let (of_piece, others) = rest.split_at(*piece as usize);
                rest = others;
                assert_eq!(stored[i], Premultiplied16::sums(of_piece), "piece {i} of {pieces:?}");
                assert_eq!(
                    light[i],
                    resolver.opaque_light(of_piece),
                    "light of piece {i} of {pieces:?}"
                );
            }
            assert_eq!([stored.len(), light.len()], [pieces.len(); 2]);
            Ok(())
        })
        .budget_ms(300);
    }

    #[test]
    fn sums_that_run_over_do_not_matter() {
        let samples = vec![Premultiplied16([Premultiplied16::ONE; 4]); 70_000];
        let mut found = Vec::new();
        let pieces = [69_990, 10].into_iter();
        RunningSums::default().stored(&samples, pieces, |sum| found.push(sum));
        assert_eq!(found[1], Premultiplied16::sums(&samples[..10]));
    }
}
