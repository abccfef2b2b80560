//! The report as text for a terminal of 80 columns, and as Markdown for a write-up.

use std::fmt;

use super::model::{Explanation, Shape};
use super::numbers::{number, runs};

/// Columns of a terminal.
const WIDTH: usize = 80;
/// Samples along a side of a pixel that are drawn as a map at most.
const MOST_COLUMNS: usize = 16;

/// What a report tells in full.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Detail {
    /// Of each paint the sample that is most telling.
    #[default]
    Telling,
    /// Of each paint this sample, counted from 0.
    Sample(usize),
}

/// One heading and its lines.
struct Topic {
    title: String,
    lines: Vec<String>,
}

/// The text for a terminal that tells of each paint the most telling sample.
impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.text(Detail::Telling).trim_end())
    }
}

impl Explanation {
    /// For a terminal: lines of at most 80 columns.
    pub fn text(&self, detail: Detail) -> String {
        let mut text = String::new();
        for (i, topic) in self.topics(detail).iter().enumerate() {
            if i > 0 {
                text.push('\n');
            }
            push_wrapped(&mut text, &topic.title, 0);
            for line in &topic.lines {
                push_wrapped(&mut text, line, 2);
            }
        }
        text
    }

    /// For a write-up.
    pub fn markdown(&self, detail: Detail) -> String {
        let mut text = String::new();
        for (i, topic) in self.topics(detail).iter().enumerate() {
            text.push_str(if i == 0 { "## " } else { "\n### " });
            text.push_str(topic.title.trim());
            // The lines stand in columns.
            text.push_str("\n\n```\n");
            for line in &topic.lines {
                push_wrapped(&mut text, line, 0);
            }
            text.push_str("```\n");
        }
        text
    }

    fn topics(&self, detail: Detail) -> Vec<Topic> {
        let [x, y] = self.pixel;
        let [width, height] = self.size;
        let topic = |title: String, lines| Topic { title, lines };
        let mut topics = vec![
            topic(format!("Pixel ({x}, {y}) of {width} x {height}"), self.pixel_lines()),
            topic(self.resolve_title().to_owned(), self.resolve_lines()),
        ];
        if !self.exact {
            topics.push(topic("What each sample shows".to_owned(), self.map_lines()));
        }
        if let Some(words) = self.unlisted_words() {
            topics.push(topic("What is not listed".to_owned(), vec![words]));
        }
        for paint in 0..self.paints.len() {
            let mut lines = self.paint_lines(paint);
            let sample = match detail {
                Detail::Telling => self.telling_sample(paint),
                Detail::Sample(sample) => Some(sample).filter(|sample| *sample < self.samples.len()),
            };
            let is_mark = matches!(self.paints[paint].shape, Shape::BeginLayer);
            if let Some(sample) = sample.filter(|_| !is_mark) {
                lines.push(format!("at {}:", self.sample_title(sample)));
                lines.extend(
                    self.fragment_lines(paint, sample)
                        .iter()
                        .map(|line| format!("  {line}")),
                );
            }
            topics.push(topic(self.paint_title(paint), lines));
        }
        if self.paints.is_empty() {
            let nothing = vec![
                if self.exact {
                    "it shows the background"
                } else {
                    "every sample shows the background"
                }
                .to_owned(),
            ];
            topics.push(topic("Nothing paints this pixel".to_owned(), nothing));
        }
        let help = self.help_lines();
        if !help.is_empty() {
            topics.push(topic("What would help".to_owned(), help));
        }
        if !self.pinholes.is_empty() {
            topics.push(topic(
                "What the float rules leave open".to_owned(),
                self.pinhole_lines(),
            ));
        }
        if !self.missed.is_empty() {
            topics.push(topic("What no sample meets".to_owned(), self.missed_lines()));
        }
        topics
    }

    /// A map of the samples where they lie in rows, then every stack with the samples that have it.
    fn map_lines(&self) -> Vec<String> {
        let mut lines = self.map();
        let mut stacks: Vec<(String, Vec<usize>)> = Vec::new();
        for sample in 0..self.samples.len() {
            let stack = self.stack(sample);
            match stacks.iter_mut().find(|(other, _)| *other == stack) {
                Some((_, samples)) => samples.push(sample),
                None => stacks.push((stack, vec![sample])),
            }
        }
        for (stack, samples) in stacks {
            let plural = if samples.len() == 1 { "" } else { "s" };
            lines.push(format!("sample{plural} {}: {stack}", runs(&samples)));
        }
        lines
    }

    /// A row of words for each row of samples, if they lie on a grid; else their places.
    fn map(&self) -> Vec<String> {
        let side = (1..=MOST_COLUMNS).find(|side| side * side == self.samples.len());
        let word = |seen: Option<usize>| seen.map_or(".".to_owned(), |paint| (paint + 1).to_string());
        let is_grid = |side: usize| {
            self.samples.iter().enumerate().all(|(i, sample)| {
                let place = |i: usize| (i as f64 + 0.5) / side as f64;
                (sample.position[0] - place(i % side)).abs() < 1e-9
                    && (sample.position[1] - place(i / side)).abs() < 1e-9
            })
        };
        let Some(side) = side.filter(|side| is_grid(*side)) else {
            let place = |sample: &super::model::Sample| {
                let [x, y] = sample.position;
                format!("({}, {}) {}", number(x), number(y), word(sample.seen))
            };
            let mut lines = vec![self.samples.iter().map(place).collect::<Vec<_>>().join("  ")];
            lines.extend(self.background_legend());
            return lines;
        };
        let words: Vec<String> = self.samples.iter().map(|sample| word(sample.seen)).collect();
        let width = words.iter().map(String::len).max().unwrap_or(1);
        let mut lines: Vec<String> = words
            .chunks(side)
            .map(|row| {
                let padded: Vec<String> = row.iter().map(|word| format!("{word:>width$}")).collect();
                format!("  {}", padded.join(" "))
            })
            .collect();
        lines.extend(self.background_legend());
        lines
    }

    /// What the mark of samples says that nothing is painted on.
    fn background_legend(&self) -> Option<String> {
        let any = self.samples.iter().any(|sample| sample.seen.is_none());
        any.then(|| "(. is the background)".to_owned())
    }
}

/// Adds a line, indented, broken before it passes the width of a terminal; what is broken off is indented further.
fn push_wrapped(text: &mut String, line: &str, indent: usize) {
    let own = line.chars().take_while(|c| *c == ' ').count();
    let mut rest = line.trim_start();
    let mut column = indent + own;
    loop {
        let room = WIDTH.saturating_sub(column).max(16);
        text.push_str(&" ".repeat(column));
        let Some((limit, next)) = rest.char_indices().nth(room) else {
            text.push_str(rest);
            text.push('\n');
            return;
        };
        // A word longer than a line is broken where the line ends.
        let space = rest[..limit].rfind(' ').filter(|end| *end > 0);
        let end = if next == ' ' { limit } else { space.unwrap_or(limit) };
        text.push_str(rest[..end].trim_end());
        text.push('\n');
        rest = rest[end..].trim_start();
        column = indent + own + 4;
        if rest.is_empty() {
            return;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_broken_at_words() {
        let mut text = String::new();
        push_wrapped(&mut text, &"word ".repeat(40), 2);
        assert!(text.lines().count() > 2, "{text}");
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
        assert_eq!(text.split_whitespace().count(), 40, "no word is lost");
        let mut text = String::new();
        push_wrapped(&mut text, &"\u{e9}".repeat(300), 2);
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
        assert_eq!(
            text.chars().filter(|c| *c == '\u{e9}').count(),
            300,
            "no letter is lost"
        );
    }
}
