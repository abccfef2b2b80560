//! `rasterscope inspect`: why a pixel has its colour.

use super::failure::{Failure, print, print_error, print_json};
use super::options::inspect::InspectOptions;
use super::picture::{Picture, on_threads, spec};
use crate::inspect::{Detail, Explanation, Question};
use crate::render::Visualisation;
use crate::viewer::{Restored, SceneSource};

/// Explains the pixel that the options ask for.
pub(super) fn run(options: &InspectOptions, restored: Option<&Restored>) -> Result<(), Failure> {
    let report = on_threads(options.picture.framing.threads, || report(options, restored))??;
    if options.json {
        return print_json(report.trim_end());
    }
    print(report.trim_end())
}

fn report(options: &InspectOptions, restored: Option<&Restored>) -> Result<String, Failure> {
    let source = SceneSource::from_address(&options.scene);
    let size = options.picture.size.0;
    let [x, y] = options.pixel.0;
    let [width, height] = size;
    let outside = || {
        Failure::input(format!(
            "--pixel {x},{y}: outside the picture of {width}x{height} pixels; give 0,0 to {},{}",
            width - 1,
            height - 1
        ))
    };
    if x >= width || y >= height {
        return Err(outside());
    }
    let picture = Picture::read(spec(&options.scene, &options.picture))?;
    picture.tell_changes(restored);
    let shown = picture.subject().settings.visualisation;
    if shown != Visualisation::Color {
        print_error(&format!(
            "--visualise {}: it is the colour that is explained, whatever is shown in its place",
            shown.name()
        ));
    }
    let file = source.address();
    let question = Question {
        subject: picture.subject(),
        file: &file,
        size,
        pixel: [x, y],
    };
    let explanation = Explanation::advised(&question).ok_or_else(outside)?;
    let detail = detail(options, explanation.samples.len())?;
    if options.json {
        return serde_json::to_string_pretty(&explanation)
            .map_err(|error| Failure::other(format!("cannot write JSON: {error}")));
    }
    Ok(explanation.text(detail))
}

/// `samples` is how many the pixel has.
fn detail(options: &InspectOptions, samples: usize) -> Result<Detail, Failure> {
    match options.sample.map(|sample| (sample, sample as usize)) {
        None => Ok(Detail::Telling),
        Some((_, sample)) if (1..=samples).contains(&sample) => Ok(Detail::Sample(sample - 1)),
        Some((sample, _)) => Err(Failure::input(format!(
            "--sample {sample}: no such sample; a pixel has samples 1 to {samples}"
        ))),
    }
}
