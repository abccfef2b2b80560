//! Tables of what was measured, as others read them: for spreadsheets, for documents, for a terminal.

/// How a table is written for others.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TableFormat {
    /// For documents.
    Markdown,
    /// For spreadsheets.
    Csv,
}

impl TableFormat {
    /// Every value, in the order of menus.
    pub const ALL: [Self; 2] = [Self::Markdown, Self::Csv];

    /// The name in scripts.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Markdown => "markdown",
            Self::Csv => "csv",
        }
    }
}

/// Lines of cells; the first has the names of the columns.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Table {
    /// All lines, each with as many cells as the first.
    pub lines: Vec<Vec<String>>,
}

impl Table {
    /// Values with commas between them (RFC 4180).
    pub fn csv(&self) -> String {
        let line = |cells: &Vec<String>| {
            let cells: Vec<String> = cells.iter().map(|cell| csv_cell(cell)).collect();
            cells.join(",") + "\r\n"
        };
        self.lines.iter().map(line).collect()
    }

    /// A table of Markdown (GitHub Flavored Markdown); what a cell would have to say as a mark it says as a character.
    pub fn markdown(&self) -> String {
        let line = |cells: &Vec<String>| {
            let cells: Vec<String> = cells.iter().map(|cell| markdown_cell(cell)).collect();
            format!("| {} |\n", cells.join(" | "))
        };
        let mut lines = self.lines.iter();
        let head = lines.next();
        let rule = head.map(|cells| format!("|{}\n", "---|".repeat(cells.len())));
        let head = head.map(line);
        head.into_iter().chain(rule).chain(lines.map(line)).collect()
    }

    /// Columns that stand below each other where letters are equally wide; no line break at the end.
    pub fn text(&self) -> String {
        let columns = self.lines.first().map_or(0, Vec::len);
        let width = |column: usize| self.lines.iter().map(|cells| cells[column].chars().count()).max();
        let widths: Vec<usize> = (0..columns).map(|column| width(column).unwrap_or(0)).collect();
        let line = |cells: &Vec<String>| {
            let padded = cells.iter().zip(&widths).map(|(cell, width)| format!("{cell:>width$}"));
            padded.collect::<Vec<_>>().join("  ")
        };
        self.lines.iter().map(line).collect::<Vec<_>>().join("\n")
    }
}

fn csv_cell(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.to_owned()
    }
}

fn markdown_cell(cell: &str) -> String {
    cell.replace('\\', "\\\\")
        .replace('|', "\\|")
        .replace(['\n', '\r'], " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let line = |cells: [&str; 2]| cells.map(str::to_owned).to_vec();
        Table {
            lines: vec![
                line(["settings", "rmse"]),
                line(["a, \"b\"", "1.5"]),
                line(["c|d", "12"]),
            ],
        }
    }

    #[test]
    fn tables_quote_what_would_end_a_cell() {
        assert_eq!(
            table().csv(),
            "settings,rmse\r\n\"a, \"\"b\"\"\",1.5\r\nc|d,12\r\n",
            "commas and quotes"
        );
        assert_eq!(
            table().markdown(),
            "| settings | rmse |\n|---|---|\n| a, \"b\" | 1.5 |\n| c\\|d | 12 |\n",
            "bars"
        );
        assert_eq!(Table::default().markdown(), "", "nothing of nothing");
    }

    #[test]
    fn tables_for_terminals_are_aligned() {
        assert_eq!(
            table().text(),
            "settings  rmse\n  a, \"b\"   1.5\n     c|d    12",
            "to the right"
        );
    }
}
