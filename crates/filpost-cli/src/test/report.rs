//! The report for people: one HTML file that needs nothing else.

use filpost::case::{Fresh, Row, side_by_side};
use filpost::nc::plot::{View, svg};
use filpost::plot::{self, Text};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::Done;
use crate::summary;

/// Most rows of two programs beside each other.
const MOST_ROWS: usize = 2000;

/// Looks of the report.
const STYLE: &str = "body{font-family:sans-serif;max-width:75em;margin:2em auto;padding:0 1em}\
    table{border-collapse:collapse}td,th{text-align:left;padding:.2em .8em}\
    pre{background:#f4f4f4;padding:.8em;overflow:auto;max-height:40em}\
    .passed{color:#1a7f37}.failed{color:#c62828}\
    .beside{width:100%;table-layout:fixed;font:13px monospace}.beside td,.beside th{padding:0 .6em}\
    .beside td{white-space:pre-wrap;overflow-wrap:anywhere}\
    .beside th:nth-child(odd){width:4.5em;text-align:right;color:#888;font-weight:normal}\
    .gone{background:#ffe9e9}.gone mark{background:#ffb3b3}.new{background:#e6f7e6}\
    .new mark{background:#a5e0a5}.none,.gap td{background:#f4f4f4}.gap td{color:#888}\
    summary{cursor:pointer}";

/// All cases: a table, and for each that failed what differs.
pub fn html(done: &[Done]) -> String {
    let failed = done.iter().filter(|done| done.outcome.failure.is_some()).count();
    let passed = done.len() - failed;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy"
                    content="default-src 'none'; style-src 'unsafe-inline'";
                title { "filpost test: " (passed) " passed, " (failed) " failed" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "Regression cases" }
                p { span.passed { (passed) " passed" } ", " span.failed { (failed) " failed" } }
                (table(done))
                @for done in done.iter().filter(|done| done.outcome.failure.is_some()) {
                    (failure(done))
                }
            }
        }
    };
    page.into_string() + "\n"
}

fn table(done: &[Done]) -> Markup {
    html! {
        table {
            tr { th { "Case" } th { "Result" } th { "Differences" } th { "Time" } }
            @for done in done {
                tr {
                    @if done.outcome.failure.is_some() {
                        td { a href={ "#" (done.name) } { (done.name) } }
                        td.failed { "failed" }
                    } @else {
                        td { (done.name) }
                        td.passed { "passed" }
                    }
                    td { (done.outcome.differences.len()) }
                    td { (done.time.as_millis()) " ms" }
                }
            }
        }
    }
}

fn failure(done: &Done) -> Markup {
    let outcome = &done.outcome;
    html! {
        h2 id=(done.name) { (done.name) }
        p { (done.case.file.origin) }
        @if !outcome.differences.is_empty() {
            ul { @for difference in &outcome.differences { li { (difference) } } }
        }
        @if outcome.fresh.is_empty() {
            pre { (outcome.failure.as_deref().unwrap_or_default()) }
        }
        @if let Some(plot) = plot(done) {
            details open { summary { "Paths" } (plot) }
        }
        @for fresh in &outcome.fresh {
            details open { summary { (fresh.path.display()) } (beside(fresh)) }
        }
    }
}

/// The path of this run over that of the proven program, as far as they can be read
/// as motion of the case's machine.
fn plot(done: &Done) -> Option<Markup> {
    let program = done.case.program().ok()?;
    let [found, proven] = [&done.outcome.nc, &done.outcome.wanted];
    let text = |name, text| Text { name, bytes: str::as_bytes(text) };
    let found = text("this run", found.as_deref()?);
    let proven = text("proven", proven.as_deref()?);
    let mut drawing = plot::program(found, program.commons()).ok()?;
    drawing.under = plot::program(proven, program.commons()).ok().map(|proven| proven.path);
    drawing.under_name = "proven program";
    Some(PreEscaped(svg(&drawing, &[View::Xy, View::Zx, View::Isometric])))
}

/// The expected program and that of this run beside each other.
fn beside(fresh: &Fresh) -> Markup {
    let found = String::from_utf8_lossy(&fresh.text);
    let rows = side_by_side(&fresh.expected, &found);
    html! {
        table.beside {
            tr { th {} th { "expected" } th {} th { "this run" } }
            @for row in rows.iter().take(MOST_ROWS) { (beside_row(row)) }
        }
        @if let Some(more) = rows.len().checked_sub(MOST_ROWS + 1) {
            p { "and " (more + 1) " more rows" }
        }
    }
}

fn beside_row(row: &Row<'_>) -> Markup {
    match row {
        Row::Same((old, text), (new, _)) => html! {
            tr { th { (old) } td { (text) } th { (new) } td { (text) } }
        },
        Row::Gap(count) => html! {
            tr.gap { td colspan="4" { (summary::counted(u64::from(*count), "equal line")) } }
        },
        Row::Changed(Some((old, one)), Some((new, other))) => html! {
            tr {
                th { (old) } td.gone { (marked(one, other)) }
                th { (new) } td.new { (marked(other, one)) }
            }
        },
        Row::Changed(old, new) => html! { tr { (side(old, "gone")) (side(new, "new")) } },
    }
}

/// A line without one beside it, or the place of the one that is not there.
fn side(line: &Option<(u32, &str)>, class: &str) -> Markup {
    match line {
        Some((number, text)) => html! { th { (number) } td class=(class) { (text) } },
        None => html! { th {} td.none {} },
    }
}

/// A line with the part marked in which it differs from another one, in whole words.
fn marked(line: &str, other: &str) -> Markup {
    let (words, others): (Vec<&str>, Vec<&str>) =
        (line.split_inclusive(' ').collect(), other.split_inclusive(' ').collect());
    let pairs = words.iter().zip(&others);
    let head = pairs.take_while(|(one, other)| one.trim_end() == other.trim_end()).count();
    let least = words.len().min(others.len()) - head;
    let pairs = words.iter().rev().zip(others.iter().rev());
    let tail = pairs.take_while(|(one, other)| one.trim_end() == other.trim_end()).count();
    let end = words.len() - tail.min(least);
    html! { (words[..head].concat()) mark { (words[head..end].concat()) } (words[end..].concat()) }
}
