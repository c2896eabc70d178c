//! Markdown as text for a terminal.

/// A page as plain text: headings without signs, links as their text, tables as columns,
/// examples indented.
pub fn text(page: &str) -> String {
    let mut lines = Vec::new();
    let mut table: Vec<Vec<String>> = Vec::new();
    let mut is_example = false;
    for line in page.lines() {
        if line.starts_with("```") {
            is_example = !is_example;
        } else if is_example {
            lines.push(format!("    {line}").trim_end().to_string());
        } else if let Some(row) = line.strip_prefix('|') {
            table.push(
                row.trim_end_matches('|').split('|').map(|cell| inline(cell.trim())).collect(),
            );
        } else {
            lines.extend(columns(&std::mem::take(&mut table)));
            lines.push(inline(heading(line)));
        }
    }
    lines.extend(columns(&table));
    lines.join("\n")
}

fn heading(line: &str) -> &str {
    if line.starts_with('#') { line.trim_start_matches('#').trim_start() } else { line }
}

/// A line without backquotes, asterisks of bold type and the targets of links.
fn inline(line: &str) -> String {
    let mut text = String::new();
    let mut rest = line;
    while let Some((before, link)) = rest.split_once("](") {
        let Some((label, end)) = before.rsplit_once('[').zip(link.find(')')) else { break };
        text.push_str(label.0);
        text.push_str(label.1);
        rest = &link[end + 1..];
    }
    text.push_str(rest);
    text.replace("**", "").replace('`', "")
}

/// The rows of a table with aligned columns; the line below the head is left out.
fn columns(rows: &[Vec<String>]) -> Vec<String> {
    let is_rule = |row: &&Vec<String>| row.iter().all(|cell| cell.starts_with("--"));
    let rows: Vec<&Vec<String>> = rows.iter().filter(|row| !is_rule(row)).collect();
    let count = rows.iter().map(|row| row.len()).max().unwrap_or(0);
    let width = |column: usize| {
        rows.iter().filter_map(|row| row.get(column)).map(|cell| cell.chars().count()).max()
    };
    let widths: Vec<usize> = (0..count).map(|column| width(column).unwrap_or(0)).collect();
    let line = |row: &&Vec<String>| {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:<width$}"));
        format!("  {}", cells.collect::<Vec<_>>().join("  ")).trim_end().to_string()
    };
    rows.iter().map(line).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_has_no_signs_of_markdown() {
        let page = "# A `page`\n\nSee [the codes](errors/README.md), **all** of [them](x.md).\n\n\
                    | a | b |\n|---|---|\n| `one` | 2 |\n\n```cl\nFINI\n```\n- a point [0, 1]";
        let plain = "A page\n\nSee the codes, all of them.\n\n  a    b\n  one  2\n\n    FINI\n\
                     - a point [0, 1]";
        assert_eq!(text(page), plain);
    }
}
