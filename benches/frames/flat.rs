//! Flat scenes and slivers, side by side with the peers.

use rayon::ThreadPool;

use crate::ours::{Ours, pool, settings};
use crate::peers;
use crate::race::{Budget, Rival, Timing, race};
use crate::scenes::FRAMES;
use crate::scenes::flat::{self, FlatScene};
use crate::table::{Row, ratio, say, say_times, times};

/// The rivals, in the order in which they run.
const NAMES: [&str; 11] = [
    "ours",
    "ours/1",
    "ours@16",
    "ours@16/1",
    "tiny",
    "tiny-aa",
    "resvg",
    "resvg-aa",
    "vello/1",
    "vello/1+1",
    "vello/1+2",
];

/// Times of one rival, frame by frame.
type Column = Vec<Timing>;

/// The times of all rivals on some scenes in all frames.
struct Columns(Vec<Column>);

impl Columns {
    fn of(&self, name: &str) -> &Column {
        let at = NAMES.iter().position(|other| *other == name).unwrap_or(0);
        &self.0[at]
    }

    /// `vello_cpu` with whichever number of threads is fastest on each frame.
    fn best_vello(&self) -> Column {
        let [one, two, three] = ["vello/1", "vello/1+1", "vello/1+2"].map(|name| self.of(name));
        let faster = |a: &Timing, b: &Timing| Timing {
            median: a.median.min(b.median),
            min: a.min.min(b.min),
        };
        let pairs = one.iter().zip(two).map(|(a, b)| faster(a, b));
        pairs.zip(three).map(|(a, b)| faster(&a, b)).collect()
    }
}

fn measure(scenes: fn([u32; 2]) -> Vec<FlatScene>, budget: Budget) -> Columns {
    let pools = [pool(1), pool(2)];
    let mut columns = vec![Column::new(); NAMES.len()];
    for size in FRAMES {
        for scene in scenes(size) {
            let timings = race_on(&scene, size, pools, budget);
            say_times(scene.name, size, &NAMES, &timings);
            for (column, timing) in columns.iter_mut().zip(timings) {
                column.push(timing);
            }
        }
    }
    Columns(columns)
}

fn race_on(scene: &FlatScene, size: [u32; 2], pools: [&'static ThreadPool; 2], budget: Budget) -> Vec<Timing> {
    let read = scene.read();
    let ours = |rate, threads: usize| Ours::new(&read, size, settings(rate), pools[threads - 1]);
    let mut rivals: Vec<Rival<'_>> = [(1, 2), (1, 1), (16, 2), (16, 1)]
        .into_iter()
        .map(|(rate, threads)| {
            let mut ours = ours(rate, threads);
            Rival::new(move || {
                ours.draw();
            })
        })
        .collect();
    rivals.push(peers::tiny_skia(scene, size, false));
    rivals.push(peers::tiny_skia(scene, size, true));
    rivals.push(peers::resvg(scene, size, false));
    rivals.push(peers::resvg(scene, size, true));
    rivals.extend((0..3).map(|workers| peers::vello(scene, size, workers)));
    race(&mut rivals, budget)
}

/// The rows of flat scenes.
pub(crate) fn flat(budget: Budget) -> Vec<Row> {
    let columns = measure(flat::all, budget);
    let (one, sixteen) = (columns.of("ours"), columns.of("ours@16"));
    for (name, column) in NAMES.iter().zip(&columns.0) {
        say(&format!(
            "{name:10} takes {} of ours at rate 1, {} at rate 16",
            times(ratio(column, one)),
            times(ratio(column, sixteen))
        ));
    }
    let row = |work, must, aim, here| Row {
        work,
        must,
        aim,
        here,
        part: "flat",
    };
    vec![
        row(
            "flat scenes, rate 1, against tiny-skia without antialiasing",
            "1x as fast",
            "as Skia",
            times(ratio(columns.of("tiny"), one)),
        ),
        row(
            "flat scenes, rate 16, against vello_cpu's analytic antialiasing (its best number of threads)",
            "1x as fast",
            "as Blend2D",
            times(ratio(&columns.best_vello(), sixteen)),
        ),
        row(
            "flat scenes, rate 16, against tiny-skia with antialiasing",
            "3x as fast",
            "",
            times(ratio(columns.of("tiny-aa"), sixteen)),
        ),
        row(
            "flat scenes, rate 16 over rate 1",
            "at most 3x the time",
            "2x",
            times(ratio(sixteen, one)),
        ),
    ]
}

/// The row of slivers.
pub(crate) fn slivers(budget: Budget) -> Vec<Row> {
    let columns = measure(|size| vec![flat::slivers(size)], budget);
    let sixteen = columns.of("ours@16");
    vec![Row {
        work: "500 full-height slivers, rate 16, against vello_cpu's analytic antialiasing",
        must: "faster",
        aim: "as Blend2D",
        here: times(ratio(&columns.best_vello(), sixteen)),
        part: "slivers",
    }]
}
