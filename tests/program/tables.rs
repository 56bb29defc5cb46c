//! The tables of the paper, and of any surface.

use crate::program::{Folder, lumen, succeed};

/// The lines of `lumen tables --format csv` without quotes: table, item, quantity, unit, paper, lumen, difference.
fn numbers(csv: &str) -> Vec<Vec<String>> {
    let mut lines = csv.lines();
    assert_eq!(
        lines.next(),
        Some("table,item,quantity,unit,paper,lumen,difference,input,version,disclaimer"),
        "a header, so that a program finds its columns"
    );
    let fields = |line: &str| {
        let mut fields = vec![String::new()];
        let mut is_quoted = false;
        for c in line.chars() {
            match c {
                '"' => is_quoted = !is_quoted,
                ',' if !is_quoted => fields.push(String::new()),
                c => fields.last_mut().unwrap().push(c),
            }
        }
        fields
    };
    let lines: Vec<_> = lines.map(fields).collect();
    assert!(lines.iter().all(|line| line.len() == 10 && line[9] == "Not for clinical decisions."), "{csv}");
    lines
}

/// A column of a quantity of a table, as numbers; `None` where it is empty.
fn column(lines: &[Vec<String>], table: &str, quantity: &str, column: usize) -> Vec<Option<f64>> {
    let chosen = lines.iter().filter(|line| line[0] == table && line[2] == quantity);
    chosen.map(|line| (!line[column].is_empty()).then(|| line[column].parse().unwrap())).collect()
}

#[test]
fn tables_one_and_two_of_the_paper_come_out_of_the_sample() {
    let lines = numbers(&succeed(&["tables", "--format", "csv"]));
    let of = |table, quantity, index| -> Vec<f64> {
        column(&lines, table, quantity, index).into_iter().map(|value| value.expect("a number")).collect()
    };
    // As they are printed in the paper.
    assert_eq!(of("I", "polygons", 4), [74_307.0, 74_307.0]);
    let printed = [66_875.0, 37_153.0, 18_576.0, 7_430.0, 743.0];
    assert_eq!(of("II", "polygons", 4), printed);
    let items: Vec<_> = lines.iter().filter(|line| line[0] == "II" && line[2] == "polygons").map(|l| &l[1]).collect();
    assert_eq!(items, ["10 %", "50 %", "75 %", "90 %", "99 %"]);
    // Equation (7) of the paper.
    for (removed, polygons) in of("II", "removed", 4).into_iter().zip(printed) {
        assert!((removed - (1.0 - polygons / 74_307.0) * 100.0).abs() <= 0.005_001, "{removed} of {polygons}");
    }
    let [before, after] = of("I", "polygons", 5)[..] else { panic!("two rows") };
    assert!(before > after && after == 74_307.0, "{before} {after}");
    let pieces = of("I", "connected pieces", 5);
    assert!(pieces[0] > 1.0 && pieces[1] == 1.0, "{pieces:?}");
    for (ours, printed) in of("II", "polygons", 5).into_iter().zip(printed) {
        assert!((0.0..=2.0).contains(&(printed - ours)), "{ours} beside the paper's {printed}");
    }
    for (table, quantity) in [("I", "polygons"), ("II", "polygons"), ("II", "removed")] {
        let (paper, lumen) = (of(table, quantity, 4), of(table, quantity, 5));
        for (i, difference) in of(table, quantity, 6).into_iter().enumerate() {
            assert!((difference - (lumen[i] - paper[i])).abs() < 1e-9, "{quantity}: {difference}");
        }
    }
    let (mean, max) = (of("II", "deviation, mean", 5), of("II", "deviation, max", 5));
    assert!(mean.is_sorted() && max.is_sorted() && mean.iter().zip(&max).all(|(mean, max)| mean < max), "{mean:?}");
    assert!(column(&lines, "II", "deviation, mean", 4).iter().all(Option::is_none), "the paper has none");
}

#[test]
fn tables_are_made_for_any_file_and_in_every_form() {
    let folder = Folder::new("tables");
    let (vessel, markdown, csv) = (folder.file("a, \"b\".stl"), folder.file("t.md"), folder.file("t.csv"));
    succeed(&["phantom", "aorta", "--triangles", "20000", "-o", &vessel]);
    let text = succeed(&["tables", &vessel]);
    assert!(text.contains("Not for clinical decisions.") && text.contains("another surface than the paper's"));
    assert!(text.lines().all(|line| line.chars().count() <= 130), "{text}");
    let rule = text.lines().position(|line| line.starts_with("-----")).expect("a table");
    let (head, row) = (text.lines().nth(rule - 1).unwrap(), text.lines().nth(rule + 1).unwrap());
    assert_eq!(head.len(), row.len(), "columns are aligned");
    assert!(succeed(&["tables", &vessel, "-o", &markdown]).is_empty());
    let markdown = std::fs::read_to_string(markdown).unwrap();
    assert!(markdown.starts_with("# Tables I and II") && markdown.contains("\n|---|---:|"), "{markdown}");
    assert!(markdown.contains("Not for clinical decisions."));
    succeed(&["tables", &vessel, "-o", &csv]);
    let lines = numbers(&std::fs::read_to_string(csv).unwrap());
    let kept = column(&lines, "I", "polygons", 5)[1].unwrap();
    assert!((kept - 20_000.0).abs() <= 200.0, "{kept}");
    for (rate, ours) in [0.1, 0.5, 0.75, 0.9, 0.99].into_iter().zip(column(&lines, "II", "polygons", 5)) {
        let target = (kept * (1.0 - rate)).floor();
        assert!((0.0..=2.0).contains(&(target - ours.unwrap())), "{rate}: {ours:?} for {target}");
    }
    assert!(lines.iter().all(|line| line[7].ends_with("a, b.stl")), "the name, whatever is in it: {:?}", lines[0]);
    assert_eq!(lumen(&["tables", &vessel, "-o", &vessel]).status.code(), Some(2), "the input is not overwritten");
    assert_eq!(lumen(&["tables", "--format", "docx"]).status.code(), Some(2));
    assert_eq!(lumen(&["tables", "no-such-file.stl"]).status.code(), Some(1));
}

#[test]
fn tables_of_a_surface_without_a_way_say_why_and_have_no_rows() {
    let folder = Folder::new("no-way");
    let closed = folder.file("tetrahedron.obj");
    let corners = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\n";
    std::fs::write(&closed, format!("{corners}f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n")).unwrap();
    let text = succeed(&["tables", "--trial", &closed]);
    for rate in ["0", "90", "95", "99"] {
        assert!(text.contains(&format!("At {rate} % there is no trial: ")), "{text}");
    }
    assert!(text.contains("(no rows: the notes say why)"), "{text}");
}

#[test]
fn the_trial_s_tables_have_the_papers_rates_each_of_its_sample() {
    let csv = succeed(&["tables", "--trial", "--format", "csv"]);
    let rows: Vec<Vec<&str>> = csv.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let of = |table: &str, quantity: &str| -> Vec<(String, String, String)> {
        let is = |row: &&Vec<&str>| row[0] == table && row[2] == quantity;
        rows.iter().filter(is).map(|row| (row[1].to_owned(), row[4].to_owned(), row[7].to_owned())).collect()
    };
    let row = |rate: &str, paper: &str, input: &str| (rate.to_owned(), paper.to_owned(), input.to_owned());
    // Whether the paper's wire arrived: in Table III from 75 % on, in Table IV at 99 %; it has no row for the whole tree.
    let third = [("10 %", "0"), ("50 %", "0"), ("75 %", "1"), ("90 %", "1"), ("99 %", "1")];
    assert_eq!(of("III", "success"), third.map(|(rate, paper)| row(rate, paper, "sample:aorta")));
    let fourth = [("0 %", ""), ("90 %", "0"), ("95 %", "0"), ("99 %", "1")];
    assert_eq!(of("IV", "success"), fourth.map(|(rate, paper)| row(rate, paper, "sample:coronary")));
    assert!(rows.iter().filter(|row| row[2] == "success").all(|row| row[5] == "1"), "{csv}");
}
