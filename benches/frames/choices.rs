//! What choices of sampling cost: patterns off the grid over the grid, a resolve in linear light over one of stored values.

use rasterscope::color::ResolveSpace;
use rasterscope::raster::SamplePattern;
use rasterscope::render::RenderSettings;
use rasterscope::scene::Scene;

use crate::ours::{Ours, pool, settings};
use crate::race::{Budget, Rival, Timing, geometric_mean, race};
use crate::scenes::{FRAMES, flat, mesh};
use crate::table::{Row, ratio, say, say_times, times};

/// Samples per pixel.
const RATE: u32 = 16;

/// Scenes of each kind: flat, textured, with colours at corners, slivers.
fn scenes() -> Vec<(&'static str, Vec<(&'static str, Scene)>)> {
    let size = FRAMES[0];
    let meshes = |scenes: Vec<mesh::MeshScene>| scenes.into_iter().map(|mesh| (mesh.name, mesh.scene)).collect();
    let flats = flat::all(size).iter().map(|flat| (flat.name, flat.read())).collect();
    let slivers = flat::slivers(size);
    vec![
        ("flat", flats),
        ("textured", meshes(mesh::textured(size))),
        ("colours", meshes(mesh::colored(size))),
        ("slivers", vec![(slivers.name, slivers.read())]),
    ]
}

/// Times every scene under each of `choices`, the first of which is what the others are compared with; the geometric mean of
/// how many times as long each kind of scene takes, by choice.
fn compare(names: &[&str], choices: &[RenderSettings], budget: Budget) -> Vec<Vec<[f64; 2]>> {
    let mut ratios = Vec::new();
    for (kind, scenes) in scenes() {
        let mut columns = vec![Vec::new(); choices.len()];
        for (name, scene) in &scenes {
            let mut rivals: Vec<Rival<'_>> = choices
                .iter()
                .map(|settings| {
                    let mut ours = Ours::new(scene, FRAMES[0], *settings, pool(2));
                    Rival::new(move || {
                        ours.draw();
                    })
                })
                .collect();
            let timings: Vec<Timing> = race(&mut rivals, budget);
            say_times(name, FRAMES[0], names, &timings);
            for (column, timing) in columns.iter_mut().zip(timings) {
                column.push(timing);
            }
        }
        let by_choice: Vec<[f64; 2]> = columns[1..].iter().map(|column| ratio(column, &columns[0])).collect();
        for (name, ratio) in names[1..].iter().zip(&by_choice) {
            say(&format!("{kind}: {name} takes {}", times(*ratio)));
        }
        ratios.push(by_choice);
    }
    ratios
}

/// By medians and by minima, over all.
fn mean(ratios: impl Iterator<Item = [f64; 2]>) -> [f64; 2] {
    let ratios: Vec<[f64; 2]> = ratios.collect();
    [0, 1].map(|by| geometric_mean(ratios.iter().map(|ratio| ratio[by])))
}

/// The row of patterns.
pub(crate) fn patterns(budget: Budget) -> Vec<Row> {
    let names = SamplePattern::ALL.map(SamplePattern::name);
    let choices = SamplePattern::ALL.map(|pattern| RenderSettings {
        pattern,
        ..settings(RATE)
    });
    let ratios = compare(&names, &choices, budget);
    let all = mean(ratios.iter().flatten().copied());
    let by_pattern = (1..names.len()).map(|at| mean(ratios.iter().map(|kind| kind[at - 1])));
    let slowest = by_pattern
        .zip(&names[1..])
        .max_by(|(a, _), (b, _)| a[0].total_cmp(&b[0]));
    let slowest = slowest.map_or_else(String::new, |(ratio, name)| {
        format!("; slowest {name} {:.2}x", ratio[0])
    });
    vec![Row {
        work: "patterns off the grid over the grid, rate 16 (flat, textured, colours at corners, slivers)",
        must: "at most 2x the time",
        aim: "1.3x",
        here: format!("{}{slowest}", times(all)),
        part: "patterns",
    }]
}

/// The row of the resolve.
pub(crate) fn resolve(budget: Budget) -> Vec<Row> {
    let choices = [ResolveSpace::Stored, ResolveSpace::Linear].map(|resolve| RenderSettings {
        resolve,
        ..settings(RATE)
    });
    let ratios = compare(&["stored", "linear"], &choices, budget);
    vec![Row {
        work: "resolve in linear light over stored values, rate 16 (the same scenes)",
        must: "at most 1.5x the time",
        aim: "1.15x",
        here: times(mean(ratios.iter().flatten().copied())),
        part: "resolve",
    }]
}
