//! The report for people: one HTML file that needs nothing else.

use filpost::nc::plot::{View, svg};
use filpost::plot::{self, Text};
use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::Done;

/// Looks of the report.
const STYLE: &str = "body{font-family:sans-serif;max-width:75em;margin:2em auto;padding:0 1em}\
    table{border-collapse:collapse}td,th{text-align:left;padding:.2em .8em}\
    pre{background:#f4f4f4;padding:.8em;overflow:auto;max-height:40em}\
    .passed{color:#1a7f37}.failed{color:#c62828}\
    .gone{background:#ffdede}.new{background:#dcf5dc}summary{cursor:pointer}";

/// All cases: a table, and for each that failed what differs.
pub fn html(done: &[Done]) -> String {
    let failed = done.iter().filter(|done| done.outcome.failure.is_some()).count();
    let passed = done.len() - failed;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
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
            details open { summary { (fresh.path.display()) } (changes(&fresh.changes)) }
        }
    }
}

/// The path of this run over that of the proven program, as far as they can be read
/// as motion of the case's machine.
fn plot(done: &Done) -> Option<Markup> {
    let program = done.case.program().ok()?;
    let path = |name: &'static str, text: &str| {
        plot::program(Text { name, bytes: text.as_bytes() }, program.commons()).ok()
    };
    let mut drawing = path("this run", done.outcome.nc.as_deref()?)?;
    drawing.under = path("proven", done.outcome.wanted.as_deref()?).map(|proven| proven.path);
    drawing.under_name = "proven program";
    Some(PreEscaped(svg(&drawing, &[View::Xy, View::Zx, View::Isometric])))
}

/// A diff of lines, in colours.
fn changes(text: &str) -> Markup {
    html! {
        pre {
            @for line in text.lines() {
                @match line.as_bytes().first() {
                    Some(b'-') => span.gone { (line) },
                    Some(b'+') => span.new { (line) },
                    _ => (line),
                }
                "\n"
            }
        }
    }
}
