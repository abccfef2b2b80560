//! The table.

use super::Measurement;
use super::log::{Line, spread};

/// Its first two lines.
pub(crate) fn head() {
    println!(
        "| hand | pictures | apart | behind | draw | window's thread | drawn onto | layout | tessellate | paint | compose | present | pixels |"
    );
    println!("| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |");
}

/// What was shown while the hand moved, pictures and panels apart.
pub(crate) fn rows(measured: &Measurement, lines: &[Line], spans: &[[f64; 2]]) {
    let Measurement { name, does, .. } = measured;
    println!("| **{name}**: {does} | | | | | | | | | | | | |");
    let moving = |line: &&Line| spans.iter().any(|[start, end]| (*start..=*end).contains(&line.at));
    let mut kinds: Vec<&str> = lines.iter().filter(moving).map(|line| line.shows.as_str()).collect();
    kinds.sort_unstable();
    kinds.dedup();
    let pictures: Vec<&Line> = lines.iter().filter(moving).filter(|line| !line.is_panels()).collect();
    if pictures.len() > 1 {
        row("all pictures", &pictures, spans);
    }
    for kind in kinds {
        let shown: Vec<&Line> = lines.iter().filter(moving).filter(|line| line.shows == kind).collect();
        row(kind, &shown, &[]);
    }
}

fn row(kind: &str, lines: &[&Line], spans: &[[f64; 2]]) {
    let of = |number: fn(&Line) -> f64| words(spread(lines.iter().map(|line| number(line)).collect()));
    println!(
        "| {kind} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |",
        lines.len(),
        words(spread(gaps(lines, spans))),
        of(|line| line.behind),
        of(|line| line.draw),
        of(Line::work),
        of(|line| line.onto),
        of(|line| line.layout),
        of(|line| line.tessellate),
        of(|line| line.paint),
        of(|line| line.compose),
        of(|line| line.present),
        pixels(lines),
    );
}

/// The times between pictures of the same span.
fn gaps(lines: &[&Line], spans: &[[f64; 2]]) -> Vec<f64> {
    let within = |span: &[f64; 2]| {
        let inside: Vec<f64> = lines
            .iter()
            .map(|line| line.at)
            .filter(|at| (span[0]..=span[1]).contains(at))
            .collect();
        inside.windows(2).map(|pair| pair[1] - pair[0]).collect::<Vec<f64>>()
    };
    spans.iter().flat_map(within).collect()
}

fn words([median, most, maximum]: [f64; 3]) -> String {
    if median.is_nan() {
        return String::new();
    }
    format!("{median:.1} {most:.1} {maximum:.1}")
}

fn pixels(lines: &[&Line]) -> String {
    let [median, _, maximum] = spread(lines.iter().map(|line| line.pixels).collect());
    format!("{median:.0} {maximum:.0}")
}
