//! Scenes that the peers cannot draw: how two threads compare with one, and what a triangle costs.

use crate::ours::{Ours, pool, settings};
use crate::race::{Budget, Rival, Timing, geometric_mean, race};
use crate::scenes::FRAMES;
use crate::scenes::mesh::{self, MeshScene};
use crate::table::{Row, ratio, say_times, times};

/// Two threads and one at rate 1, then at rate 16.
const NAMES: [&str; 4] = ["ours", "ours/1", "ours@16", "ours@16/1"];

fn race_on(MeshScene { name, scene }: &MeshScene, size: [u32; 2], budget: Budget) -> Vec<Timing> {
    let pools = [pool(1), pool(2)];
    let mut rivals: Vec<Rival<'_>> = [(1, 2), (1, 1), (16, 2), (16, 1)]
        .into_iter()
        .map(|(rate, threads)| {
            let mut ours = Ours::new(scene, size, settings(rate), pools[threads - 1]);
            Rival::new(move || {
                ours.draw();
            })
        })
        .collect();
    let timings = race(&mut rivals, budget);
    say_times(name, size, &NAMES, &timings);
    timings
}

/// The row of two threads over one on textured meshes.
pub(crate) fn textured(budget: Budget) -> Vec<Row> {
    let mut columns = [Vec::new(), Vec::new()];
    for size in FRAMES {
        for scene in mesh::textured(size) {
            let timings = race_on(&scene, size, budget);
            columns[0].push(timings[2]);
            columns[1].push(timings[3]);
        }
    }
    vec![Row {
        work: "two threads over one, textured, rate 16",
        must: "1.7x",
        aim: "1.9x",
        here: times(ratio(&columns[1], &columns[0])),
        part: "textured",
    }]
}

/// The row of a million triangles.
pub(crate) fn million(budget: Budget) -> Vec<Row> {
    let size = [1920, 1080];
    let scenes = mesh::million(size);
    let timings: Vec<Timing> = scenes.iter().map(|scene| race_on(scene, size, budget)[0]).collect();
    // A million nanoseconds are a millisecond.
    let each = scenes
        .iter()
        .zip(&timings)
        .map(|(scene, timing)| format!("{} {:.0}", scene.name, timing.median));
    let mean = |time: fn(&Timing) -> f64| geometric_mean(timings.iter().map(time));
    vec![Row {
        work: "a million triangles of 2 px, rate 1, 1920x1080",
        must: "under 60 ns a triangle",
        aim: "30 ns",
        here: format!(
            "{:.1} ns (minima {:.1} ns; {})",
            mean(|timing| timing.median),
            mean(|timing| timing.min),
            each.collect::<Vec<_>>().join(", ")
        ),
        part: "million",
    }]
}

/// 20 000 points: no row, but times.
pub(crate) fn points(budget: Budget) {
    for size in FRAMES {
        race_on(&mesh::points(size), size, budget);
    }
}
