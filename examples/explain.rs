//! Draws an SVG file and explains one of its pixels: `cargo run --example explain drawing.svg drawing.png 120 80`.

#![expect(clippy::print_stdout, reason = "the explanation is for whoever started the program")]

use std::env;
use std::error::Error;
use std::path::Path;

use rasterscope::{Explanation, SampleRate, Scene, Settings, draw, explain, save_png};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [drawing, picture, x, y] = arguments.as_slice() else {
        return Err("give a drawing, a name for its picture, and a pixel: drawing.svg drawing.png 120 80".into());
    };
    println!("{}", run(drawing.as_ref(), picture.as_ref(), [x.parse()?, y.parse()?])?);
    Ok(())
}

/// Draws the file `drawing` into the file `picture`, with 16 samples per pixel, and explains a pixel.
pub(crate) fn run(drawing: &Path, picture: &Path, pixel: [u32; 2]) -> Result<Explanation, Box<dyn Error>> {
    let scene = Scene::load(drawing)?;
    let mut settings = Settings::default();
    settings.render.sample_rate = SampleRate::new(16).ok_or("no such sample rate")?;
    save_png(&draw(&scene, &settings)?, picture)?;
    Ok(explain(&scene, &settings, pixel)?)
}
