//! What renderers outside of this program draw: scenes as raw numbers, our pictures of them, and our times.

mod llvmpipe;
mod skia;

use std::fs;
use std::io;
use std::path::Path;

use rasterscope::render::RenderSettings;
use rasterscope::scene::Scene;
use serde_json::{Value, json};

use crate::ours::{Ours, pool};
use crate::race::{Budget, Rival, race};

/// The scenes of one folder.
struct Export<'a> {
    folder: &'a Path,
    budget: Budget,
    entries: Vec<Value>,
}

/// One way in which we draw a scene.
struct Case {
    settings: RenderSettings,
    threads: usize,
    /// What the list says of it, an object.
    listed: Value,
}

/// What an option writes into a folder.
pub(crate) fn by_option(option: &str) -> Option<fn(&Path, Budget) -> io::Result<()>> {
    match option {
        "--export" => Some(llvmpipe::export),
        "--export-skia" => Some(skia::export),
        _ => None,
    }
}

impl<'a> Export<'a> {
    fn new(folder: &'a Path, budget: Budget) -> io::Result<Self> {
        fs::create_dir_all(folder)?;
        Ok(Self {
            folder,
            budget,
            entries: Vec::new(),
        })
    }

    /// Writes a file of the scene that comes next, and names it.
    fn write(&self, what: &str, bytes: &[u8]) -> io::Result<String> {
        let file = format!("{}.{what}", self.entries.len());
        fs::write(self.folder.join(&file), bytes).map(|()| file)
    }

    /// Times the scene that comes next in all `cases`, which the list has with their times and pictures.
    fn time(&self, scene: &Scene, size: [u32; 2], cases: &[Case]) -> io::Result<Vec<Value>> {
        let mut ours: Vec<Ours<'_>> = cases
            .iter()
            .map(|case| Ours::new(scene, size, case.settings, pool(case.threads)))
            .collect();
        let draw = |ours: &mut Ours<'_>| {
            ours.draw();
        };
        let mut rivals: Vec<Rival<'_>> = ours.iter_mut().map(|ours| Rival::new(move || draw(ours))).collect();
        let timings = race(&mut rivals, self.budget);
        drop(rivals);
        let mut list = Vec::new();
        for (i, ((case, timing), ours)) in cases.iter().zip(timings).zip(&ours).enumerate() {
            let bytes: Vec<u8> = (0..size[1])
                .flat_map(|y| (0..size[0]).map(move |x| (x, y)))
                .flat_map(|(x, y)| ours.frame().rgba(x, y).unwrap_or_default())
                .collect();
            let mut listed = case.listed.clone();
            listed["median_ms"] = json!(timing.median);
            listed["min_ms"] = json!(timing.min);
            listed["picture"] = json!(self.write(&format!("{i}.rgba"), &bytes)?);
            list.push(listed);
        }
        Ok(list)
    }

    /// Writes `scenes.json`, with `more` beside the scenes.
    fn finish(self, mut more: Value) -> io::Result<()> {
        more["scenes"] = Value::Array(self.entries);
        fs::write(self.folder.join("scenes.json"), more.to_string())
    }
}
