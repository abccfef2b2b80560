//! Texts for the clipboard: a pixel in words, and the command line that makes the picture again.

use std::fmt::Write as _;

use super::settings::background_name;
use super::{Effect, Viewer};
use crate::geometry::View;
use crate::render::RenderSettings;
use crate::scene::DialectChoice;
use crate::texture::FixedLevel;

impl Viewer {
    pub(super) fn copy_pixel(&mut self) -> Vec<Effect> {
        // In the inset the pointer reads pixels that the user looks at; elsewhere it is where it happens to be.
        let in_inset = self.hovered_pixel().filter(|_| self.pointer_over_inset());
        let pinned = in_inset.or(self.pinned_pixel());
        let pixel = pinned.or(self.hovered_pixel()).or(self.inspected_pixel());
        match pixel.and_then(|pixel| self.status_of(pixel)) {
            Some(status) => {
                let other = self
                    .other_status_of(status.pixel)
                    .and_then(|other| other.decimal_text());
                let other = other.map_or(String::new(), |other| format!("  B {other}"));
                self.copy(format!("{status}{other}"))
            }
            None => Vec::new(),
        }
    }

    pub(super) fn copy_command_line(&mut self) -> Vec<Effect> {
        match self.command_line() {
            Some(line) => self.copy(line),
            None => Vec::new(),
        }
    }

    fn copy(&mut self, text: String) -> Vec<Effect> {
        self.messages.done(format!("copied: {text}"));
        vec![Effect::CopyText(text)]
    }

    /// The `rasterscope render` command that makes the current picture, quoted for a POSIX shell; `None` without a
    /// scene or without pixels. Options that have their default value are left out, but for size and view.
    pub fn command_line(&self) -> Option<String> {
        let entry = self.current()?;
        let [width, height] = self.frame_size();
        if width == 0 || height == 0 {
            return None;
        }
        let scene = shell_quoted(&entry.source.address());
        let output = shell_quoted(&output_name(&entry.label));
        let mut line = format!("rasterscope render {scene} -o {output} --size {width}x{height}");
        // Writing to a `String` cannot fail.
        let _ = match entry.camera.view() {
            View::Default => write!(line, " --view default"),
            View::Canvas => write!(line, " --view canvas"),
            View::At {
                center,
                scale,
                rotation,
            } => match rotation {
                0.0 => write!(line, " --view={},{},{scale}", center.x, center.y),
                _ => write!(line, " --view={},{},{scale},{rotation}", center.x, center.y),
            },
        };
        let (render, default) = (&self.settings.render, RenderSettings::default());
        let mut option = |differs: bool, name: &str, value: &str| {
            if differs {
                let _ = write!(line, " --{name} {value}");
            }
        };
        let (rate, pixel, level) = (render.sample_rate, render.pixel_sampling, render.level_sampling);
        option(rate != default.sample_rate, "sample-rate", &rate.samples().to_string());
        option(render.pattern != default.pattern, "pattern", render.pattern.name());
        option(pixel != default.pixel_sampling, "pixel-sampling", pixel.name());
        option(level != default.level_sampling, "level-sampling", level.name());
        let (taps, detail) = (render.anisotropy, render.detail);
        option(taps != default.anisotropy, "anisotropy", &taps.taps().to_string());
        let bias = detail.bias.levels().to_string();
        option(detail.bias != default.detail.bias, "lod-bias", &bias);
        let fixed = detail.fixed.map(FixedLevel::level).unwrap_or_default().to_string();
        option(detail.fixed.is_some(), "lod-level", &fixed);
        let per = detail.derivatives;
        option(per != default.detail.derivatives, "lod-per", per.name());
        let background = background_name(render.background);
        option(
            render.background != default.background,
            "background",
            &shell_quoted(&background),
        );
        let dialect = self.settings.dialect;
        option(dialect != DialectChoice::default(), "dialect", dialect.name());
        option(render.resolve != default.resolve, "resolve", render.resolve.name());
        option(render.rules != default.rules, "rules", render.rules.name());
        Some(line)
    }
}

/// The name of the picture beside the scene's name.
fn output_name(label: &str) -> String {
    let file = label.rsplit(['/', '\\']).next().unwrap_or(label);
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    format!("{}.png", if stem.is_empty() { "picture" } else { stem })
}

/// `word` as one word of a POSIX shell. A leading dash becomes `./-`, since it is a path.
fn shell_quoted(word: &str) -> String {
    let word = if word.starts_with('-') {
        format!("./{word}")
    } else {
        word.to_owned()
    };
    let plain = |c: char| c.is_ascii_alphanumeric() || "/._-+:,@%=".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        return word;
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shell_quoting() {
        for (word, quoted) in [
            ("svg/basic/test4.svg", "svg/basic/test4.svg"),
            ("my scene.svg", "'my scene.svg'"),
            ("it's.svg", r"'it'\''s.svg'"),
            ("#ff8000", "'#ff8000'"),
            ("-o.svg", "./-o.svg"),
            ("$(x)", "'$(x)'"),
            ("", "''"),
        ] {
            assert_eq!(shell_quoted(word), quoted, "{word}");
        }
    }

    #[test]
    fn output_beside_nothing() {
        for (label, name) in [
            ("basic/test4.svg", "test4.png"),
            ("a.b.svg", "a.b.png"),
            (".svg", "picture.png"),
            ("x", "x.png"),
        ] {
            assert_eq!(output_name(label), name, "{label}");
        }
    }
}
