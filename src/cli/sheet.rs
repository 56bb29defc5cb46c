//! Tables of numbers beside the paper's, as aligned text, as CSV and as Markdown.

use tabled::builder::Builder;
use tabled::settings::object::Columns;
use tabled::settings::span::ColumnSpan;
use tabled::settings::style::HorizontalLine;
use tabled::settings::{Alignment, Padding, Style};

use crate::language::grouped;
use crate::pipeline::report::DISCLAIMER;

/// Tables, with what is said of all of them.
pub(super) struct Sheet {
    /// What a reader has to know about all tables.
    pub notes: Vec<String>,
    /// The tables, in the paper's order.
    pub tables: Vec<Table>,
}

/// One table of the paper.
pub(super) struct Table {
    /// Its number in the paper.
    pub number: &'static str,
    /// What it shows.
    pub title: &'static str,
    /// Of which surface: a file or a sample.
    pub input: String,
    /// What its items are, at the head of their column.
    pub of: &'static str,
    /// Its rows, all with the same quantities.
    pub items: Vec<Item>,
    /// What a reader has to know about it.
    pub notes: Vec<String>,
}

/// A row: what the numbers belong to, and the numbers.
pub(super) struct Item {
    /// What they belong to.
    pub name: String,
    /// One number a quantity.
    pub entries: Vec<Entry>,
}

/// A quantity in the paper and here.
pub(super) struct Entry {
    quantity: &'static str,
    unit: &'static str,
    decimals: usize,
    paper: Option<f64>,
    lumen: Option<f64>,
}

impl Entry {
    /// A count.
    pub(super) fn count(quantity: &'static str, paper: Option<usize>, lumen: usize) -> Self {
        Self { quantity, unit: "", decimals: 0, paper: paper.map(|n| n as f64), lumen: Some(lumen as f64) }
    }

    /// A number with a unit, shown with `decimals` digits after the point; `None` where there is none.
    pub(super) fn number(
        quantity: &'static str,
        unit: &'static str,
        decimals: usize,
        paper: Option<f64>,
        lumen: Option<f64>,
    ) -> Self {
        Self { quantity, unit, decimals, paper, lumen }
    }

    /// The difference of what is shown, so that a reader who takes one from the other finds it.
    fn difference(&self) -> Option<f64> {
        Some(self.rounded(self.lumen?) - self.rounded(self.paper?))
    }

    fn rounded(&self, value: f64) -> f64 {
        let scale = libm::pow(10.0, self.decimals as f64);
        (value * scale).round() / scale
    }

    /// For people: thousands in groups.
    fn shown(&self, value: Option<f64>) -> String {
        value.map_or("-".to_owned(), |value| grouped(self.plain(value)))
    }

    fn shown_difference(&self) -> String {
        self.difference().map_or("-".to_owned(), |value| {
            let sign = if self.plain(value.abs()) == self.plain(0.0) {
                ""
            } else if value < 0.0 {
                "-"
            } else {
                "+"
            };
            format!("{sign}{}", grouped(self.plain(value.abs())))
        })
    }

    /// For machines; never a negative nought.
    fn plain(&self, value: f64) -> String {
        format!("{:.*}", self.decimals, self.rounded(value) + 0.0)
    }
}

impl Table {
    /// Two lines of heads, then a line an item. A quantity that the paper has takes three columns, others one.
    fn cells(&self) -> (Vec<[String; 2]>, Vec<Vec<String>>) {
        let of_paper = |i: usize| self.items.iter().any(|item| item.entries[i].paper.is_some());
        let mut heads = vec![[self.of.to_owned(), String::new()]];
        for (i, entry) in self.items.first().map_or(&[][..], |item| &item.entries).iter().enumerate() {
            let unit = if entry.unit.is_empty() { String::new() } else { format!(" [{}]", entry.unit) };
            if of_paper(i) {
                heads.push([format!("{}{unit}", entry.quantity), "paper".to_owned()]);
                heads.extend(["Lumen", "difference"].map(|column| [String::new(), column.to_owned()]));
            } else {
                heads.push([entry.quantity.to_owned(), format!("Lumen{unit}")]);
            }
        }
        let row = |item: &Item| {
            let mut cells = vec![item.name.clone()];
            for (i, entry) in item.entries.iter().enumerate() {
                if of_paper(i) {
                    cells.extend([entry.shown(entry.paper), entry.shown(entry.lumen), entry.shown_difference()]);
                } else {
                    cells.push(entry.shown(entry.lumen));
                }
            }
            cells
        };
        (heads, self.items.iter().map(row).collect())
    }

    fn text(&self, out: &mut String) {
        if self.items.is_empty() {
            return no_rows(out);
        }
        let (heads, rows) = self.cells();
        let mut builder = Builder::default();
        [0, 1].into_iter().for_each(|line| builder.push_record(heads.iter().map(|head| &head[line])));
        rows.into_iter().for_each(|row| builder.push_record(row));
        let mut table = builder.build();
        table.with(Style::empty().horizontals([(2, HorizontalLine::new('-'))])).with(Padding::zero());
        table.modify(Columns::new(1..), Alignment::right()).modify(Columns::new(1..), Padding::new(2, 0, 0, 0));
        // A quantity's head stands over all of its columns; the rule stands under the second line.
        let starts: Vec<usize> = (1..heads.len()).filter(|&i| !heads[i][0].is_empty()).collect();
        let ends = starts.iter().skip(1).copied().chain([heads.len()]);
        for (&start, end) in starts.iter().zip(ends).filter(|(start, end)| end - **start > 1) {
            table.modify((0, start), ColumnSpan::new((end - start) as isize));
        }
        *out += &format!("{table}\n");
    }

    fn markdown(&self, out: &mut String) {
        if self.items.is_empty() {
            return no_rows(out);
        }
        let (heads, rows) = self.cells();
        let mut quantity = String::new();
        let mut line = "|".to_owned();
        let mut rule = "|".to_owned();
        for (i, [over, head]) in heads.iter().enumerate() {
            if i == 0 {
                line += &format!(" {over} |");
                rule += "---|";
                continue;
            }
            if !over.is_empty() {
                quantity.clone_from(over);
            }
            line += &format!(" {quantity}, {head} |");
            rule += "---:|";
        }
        *out += &format!("{line}\n{rule}\n");
        for row in &rows {
            *out += &format!("| {} |\n", row.join(" | "));
        }
    }
}

impl Sheet {
    fn heading(&self) -> String {
        let tables: Vec<_> = self.tables.iter().map(|table| table.number).collect();
        let mut inputs: Vec<_> = self.tables.iter().map(|table| table.input.as_str()).collect();
        inputs.dedup();
        format!("Tables {} of the paper, made again for {}", tables.join(" and "), inputs.join(" and "))
    }

    fn footer() -> String {
        format!("Lumen {}. {DISCLAIMER}", env!("CARGO_PKG_VERSION"))
    }

    /// Aligned columns.
    pub(super) fn text(&self) -> String {
        let mut out = format!("{}\n{}\n", self.heading(), "=".repeat(self.heading().chars().count()));
        self.notes.iter().for_each(|note| bullet(&mut out, note));
        for table in &self.tables {
            out += &format!("\nTable {}. {}\n\n", table.number, table.title);
            table.text(&mut out);
            out.push('\n');
            table.notes.iter().for_each(|note| bullet(&mut out, note));
        }
        out += &format!("\n{}\n", Self::footer());
        out
    }

    /// Tables for a document.
    pub(super) fn markdown(&self) -> String {
        let mut out = format!("# {}\n\n", self.heading());
        self.notes.iter().for_each(|note| out += &format!("- {note}\n"));
        for table in &self.tables {
            out += &format!("\n## Table {}. {}\n\n", table.number, table.title);
            table.markdown(&mut out);
            out.push('\n');
            table.notes.iter().for_each(|note| out += &format!("- {note}\n"));
        }
        out += &format!("\n{}\n", Self::footer());
        out
    }

    /// One tidy table for machines: a line a number, with all that it needs to be understood alone (RFC 4180).
    pub(super) fn csv(&self) -> String {
        const HEADS: [&str; 10] =
            ["table", "item", "quantity", "unit", "paper", "lumen", "difference", "input", "version", "disclaimer"];
        let mut out = csv::WriterBuilder::new().terminator(csv::Terminator::CRLF).from_writer(Vec::new());
        let mut write = |fields: [&str; HEADS.len()]| out.write_record(fields).expect("memory takes every line");
        write(HEADS);
        for table in &self.tables {
            for (item, entry) in table.items.iter().flat_map(|item| item.entries.iter().map(move |entry| (item, entry)))
            {
                let number = |value: Option<f64>| value.map_or(String::new(), |value| entry.plain(value));
                write([
                    table.number,
                    &item.name,
                    entry.quantity,
                    entry.unit,
                    &number(entry.paper),
                    &number(entry.lumen),
                    &number(entry.difference()),
                    &table.input,
                    env!("CARGO_PKG_VERSION"),
                    DISCLAIMER,
                ]);
            }
        }
        String::from_utf8(out.into_inner().expect("memory takes every line")).expect("fields are text")
    }
}

/// What stands in place of a table without rows.
fn no_rows(out: &mut String) {
    *out += "(no rows: the notes say why)\n";
}

/// A note as a point of a list, wrapped.
fn bullet(out: &mut String, note: &str) {
    // Names of files stay whole.
    let splitter = textwrap::WordSplitter::NoHyphenation;
    let options = textwrap::Options::new(100).word_splitter(splitter).break_words(false);
    let options = options.initial_indent("- ").subsequent_indent("  ");
    *out += &format!("{}\n", textwrap::fill(note, options));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_of_what_is_shown_and_nought_has_no_sign() {
        let entry = |paper, lumen| Entry::number("x", "%", 2, Some(paper), Some(lumen));
        assert_eq!(entry(10.0, 9.999).shown_difference(), "0.00");
        assert_eq!(entry(10.0, 12.345_6).shown_difference(), "+2.35");
        assert_eq!(entry(99.0, 98.004).shown_difference(), "-1.00");
        assert_eq!(entry(0.0, -0.001).plain(-0.001), "0.00");
        assert_eq!(Entry::number("x", "mm", 2, None, Some(1.0)).shown_difference(), "-");
    }

    #[test]
    fn a_table_without_rows_says_so() {
        let table = Table {
            number: "IV",
            title: "The trial in the whole tree",
            input: "box.stl".to_owned(),
            of: "reduction rate",
            items: Vec::new(),
            notes: Vec::new(),
        };
        let sheet = Sheet { notes: vec!["There is no trial.".to_owned()], tables: vec![table] };
        for shown in [sheet.text(), sheet.markdown()] {
            assert!(
                shown.contains("(no rows: the notes say why)\n") && shown.contains("There is no trial."),
                "{shown}"
            );
        }
        assert_eq!(sheet.csv().lines().count(), 1);
    }
}
