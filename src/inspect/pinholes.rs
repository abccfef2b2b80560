//! The holes that edges in 32-bit floats leave between neighbours, in words.

use super::model::{Edge, Explanation, Pinhole, Verdict};

impl Explanation {
    /// Whether the float rules leave a sample open.
    pub(super) fn is_pinhole(&self, sample: usize) -> bool {
        self.pinholes.iter().any(|pinhole| pinhole.sample == sample)
    }

    /// What leaves samples open, and what closes them.
    pub(super) fn pinhole_hint(&self) -> Option<String> {
        let first = self.pinholes.first()?;
        let tie = first.edges.iter().any(|edge| edge.verdict == Verdict::TieUndecided);
        let why = if tie {
            "There its edge function in 32-bit floats is 0, neither above nor below, and no rule says whose the sample is"
        } else {
            "There its edge function in 32-bit floats is below 0, though exactly it is not"
        };
        Some(format!(
            "{} in a pinhole, at the edge of the {}. {why}: what is below shows. By the standard rules (Rules in the panel), \
             exact and with a rule for ties, it is painted.",
            self.count_words(self.pinholes.len()),
            first.name(),
        ))
    }

    /// For each sample that the float rules leave open what its triangle's edges say.
    pub fn pinhole_lines(&self) -> Vec<String> {
        let lines = |pinhole: &Pinhole| {
            let super::model::Source { file, line, column, .. } = &pinhole.source;
            let title = format!(
                "sample {}: by the standard rules it is the {} at {file}:{line}:{column}",
                pinhole.sample + 1,
                pinhole.name(),
            );
            let edges = ["AB", "BC", "CA"].iter().zip(&pinhole.edges);
            let edge = |(name, edge): (&&str, &Edge)| format!("  edge {name}   {}", edge.words());
            std::iter::once(title).chain(edges.map(edge)).collect::<Vec<String>>()
        };
        self.pinholes.iter().flat_map(lines).collect()
    }
}

impl Pinhole {
    /// Such as `triangle of polygon, line 7`.
    pub fn name(&self) -> String {
        format!("triangle of {}, line {}", self.source.name(), self.source.line)
    }
}
