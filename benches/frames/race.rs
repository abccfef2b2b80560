//! Timing rivals fairly: round by round, each once per round, so that whatever disturbs the machine disturbs all.

use std::time::{Duration, Instant};

/// Who draws whole frames.
pub(crate) struct Rival<'a> {
    draw: Box<dyn FnMut() + 'a>,
}

/// What a frame took, in milliseconds.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Timing {
    pub(crate) median: f64,
    pub(crate) min: f64,
}

/// How long rivals are compared.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    /// Rounds are added until this is used up ...
    pub(crate) time: Duration,
    /// ... or there are as many.
    pub(crate) max_rounds: usize,
}

/// Fewest rounds, however slow the rivals.
const MIN_ROUNDS: usize = 3;

impl<'a> Rival<'a> {
    /// `draw` makes one whole frame.
    pub(crate) fn new(draw: impl FnMut() + 'a) -> Self {
        Self { draw: Box::new(draw) }
    }
}

impl Timing {
    /// Of one or more times.
    pub(crate) fn of(mut times: Vec<Duration>) -> Self {
        times.sort_unstable();
        let milliseconds = |at: usize| times[at].as_secs_f64() * 1e3;
        let half = times.len() / 2;
        let median = if times.len() % 2 == 1 {
            milliseconds(half)
        } else {
            f64::midpoint(milliseconds(half - 1), milliseconds(half))
        };
        Self {
            median,
            min: milliseconds(0),
        }
    }
}

/// Times every rival, in their order. The first round, which pays for memory and caches, does not count.
pub(crate) fn race(rivals: &mut [Rival<'_>], budget: Budget) -> Vec<Timing> {
    let mut times = vec![Vec::new(); rivals.len()];
    let start = Instant::now();
    for round in 0..=budget.max_rounds {
        for (rival, times) in rivals.iter_mut().zip(&mut times) {
            let start = Instant::now();
            (rival.draw)();
            if round > 0 {
                times.push(start.elapsed());
            }
        }
        if round >= MIN_ROUNDS && start.elapsed() > budget.time {
            break;
        }
    }
    times.into_iter().map(Timing::of).collect()
}

/// The geometric mean, 1 of nothing.
pub(crate) fn geometric_mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for value in values {
        sum += value.ln();
        count += 1.0;
    }
    if count > 0.0 { (sum / count).exp() } else { 1.0 }
}
