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
    let detail = detail(options, &explanation)?;
    if options.json {
        return serde_json::to_string_pretty(&explanation)
            .map_err(|error| Failure::other(format!("cannot write JSON: {error}")));
    }
    Ok(explanation.text(detail))
}

fn detail(options: &InspectOptions, explanation: &Explanation) -> Result<Detail, Failure> {
    let Some(sample) = options.sample else {
        return Ok(Detail::Telling);
    };
    let samples = explanation.samples.len();
    let index = (sample as usize).checked_sub(1).filter(|index| *index < samples);
    index.map(Detail::Sample).ok_or_else(|| {
        let words = match samples {
            _ if explanation.exact => {
                "exact areas are covered, and the pixel has no samples; 1 stands for its centre".to_owned()
            }
            1 => "no such sample; the pixel has one, number 1".to_owned(),
            samples => format!("no such sample; a pixel has samples 1 to {samples}"),
        };
        Failure::input(format!("--sample {sample}: {words}"))
    })
}
