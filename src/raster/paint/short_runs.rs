//! Fills and copies runs of values side by side. Most are a few pixels long, for which a call, or a loop over single values, would take
//! longer: the longest piece that fits is put again and again, and once more up to the end. Copying knows longer pieces, and puts only
//! two: a loop over pieces would be made a call.
//!
//! ```text
//!    |- - - - 8 - - - -|- - - - 8 - - - -|
//!                   |- - - - 8 - - - -|      the last piece overlaps
//! ```

#![expect(clippy::inline_always, reason = "a piece of a known length is put from registers")]

/// Fills a run.
#[inline(always)]
pub(super) fn fill_run<T: Copy>(run: &mut [T], value: T) {
    if !(fill::<T, 8>(run, value) || fill::<T, 4>(run, value) || fill::<T, 2>(run, value))
        && let [one] = run
    {
        *one = value;
    }
}

/// Copies values to a run of as many.
#[inline(always)]
pub(super) fn copy_run<T: Copy>(values: &[T], run: &mut [T]) {
    if run.len() > 2 * LONGEST {
        run.copy_from_slice(values);
    } else if !(copy::<T, LONGEST>(values, run)
        || copy::<T, 16>(values, run)
        || copy::<T, 8>(values, run)
        || copy::<T, 4>(values, run)
        || copy::<T, 2>(values, run))
        && let ([value], [one]) = (values, run)
    {
        *one = *value;
    }
}

/// Values of the longest piece that is copied.
const LONGEST: usize = 32;

/// Fills by pieces of `N`; `false` where there is not even one.
#[inline(always)]
fn fill<T: Copy, const N: usize>(run: &mut [T], value: T) -> bool {
    let Some(last) = run.last_chunk_mut::<N>() else {
        return false;
    };
    *last = [value; N];
    for piece in run.as_chunks_mut::<N>().0 {
        *piece = [value; N];
    }
    true
}

/// Copies by two pieces of `N`, which leave nothing out between them; `false` where there is not even one.
#[inline(always)]
fn copy<T: Copy, const N: usize>(values: &[T], run: &mut [T]) -> bool {
    let (Some(first), Some(last)) = (values.first_chunk::<N>(), values.last_chunk::<N>()) else {
        return false;
    };
    if let Some(to_first) = run.first_chunk_mut::<N>() {
        *to_first = *first;
    }
    if let Some(to_last) = run.last_chunk_mut::<N>() {
        *to_last = *last;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_of_any_length_are_filled_and_copied_and_nothing_around_them() {
        for length in 0..80_usize {
            let values: Vec<usize> = (1..=length).collect();
            let (mut filled, mut copied) = (vec![0; length + 4], vec![0; length + 4]);
            fill_run(&mut filled[2..length + 2], 7);
            copy_run(&values, &mut copied[2..length + 2]);
            let around = |inner: &[usize]| [&[0; 2][..], inner, &[0; 2]].concat();
            assert_eq!(filled, around(&vec![7; length]), "{length} filled");
            assert_eq!(copied, around(&values), "{length} copied");
        }
    }
}
