//! Puts the values of pixels that were shaded together where they belong.

use crate::raster::frame::block::PixelBlock;
use crate::raster::paint::short_runs::{copy_run, fill_run};
use crate::raster::shading::context::PixelRun;

/// Puts values into runs of pixels, one after the other. Where all pixels of a run are alike (`is_level`) there is one for each.
pub(super) fn put_runs(runs: &[PixelRun], is_level: bool, mut values: &[u32], block: &mut PixelBlock<'_>) {
    for run in runs {
        let line = block.run(run.row, run.columns());
        let (of_run, others) = values.split_at(if is_level { 1 } else { run.len() });
        values = others;
        if is_level {
            fill_run(line, of_run[0]);
            continue;
        }
        copy_run(of_run, line);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::raster::span::{Span, SpanRect};

    #[test]
    fn runs_get_their_values() {
        const WIDTH: u16 = 30;
        arbtest::arbtest(|u| {
            let is_level: bool = u.arbitrary()?;
            let mut runs = Vec::new();
            let (mut values, mut expected) = (Vec::new(), vec![0; 3 * usize::from(WIDTH)]);
            for row in 0..3 {
                let start = u.int_in_range(0..=WIDTH - 1)?;
                let end = u.int_in_range(start + 1..=WIDTH)?;
                let run = PixelRun { row, start, end };
                for (i, [x, y]) in run.places().enumerate() {
                    if i == 0 || !is_level {
                        values.push(u.int_in_range(1..=u32::MAX)?);
                    }
                    expected[usize::from(y * WIDTH + x)] = values[values.len() - 1];
                }
                runs.push(run);
            }
            let span = |length: u16| Span {
                start: 0,
                end: length.into(),
            };
            let rect = SpanRect {
                x: span(WIDTH),
                y: span(3),
            };
            let mut found = vec![0; expected.len()];
            put_runs(
                &runs,
                is_level,
                &values,
                &mut PixelBlock::new(rect, &mut found, WIDTH.into()),
            );
            assert_eq!(found, expected, "{runs:?}");
            Ok(())
        })
        .budget_ms(100);
    }
}
