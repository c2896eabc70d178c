//! `filpost test --coverage`: what of the posts no case has exercised.

use std::collections::BTreeSet;
use std::fmt::Write;
use std::path::Path;

use filpost::case::Programs;
use filpost::coverage::{Coverage, CoveredFile, Share, never};
use maud::{DOCTYPE, Markup, PreEscaped, html};
use rayon::prelude::*;

use super::{Done, settings_of};
use crate::args::TestArgs;
use crate::output;
use filpost::{Error, PendingFiles, files};

/// Looks of the page.
const STYLE: &str = "body{font-family:sans-serif;max-width:75em;margin:2em auto;padding:0 1em}\
    table{border-collapse:collapse}td,th{text-align:left;padding:.1em .8em}\
    .src td{font-family:monospace;white-space:pre;padding:0 .6em}\
    .n{color:#777;text-align:right}.hit{background:#dcf5dc}.miss{background:#ffdede}\
    .part{background:#fff3cd}";

/// Shows the summary and adds the reports that are asked for.
///
/// # Errors
/// Reports that can't be written.
pub fn tell(
    done: &[Done],
    programs: &Programs,
    args: &TestArgs,
    written: &mut PendingFiles,
) -> Result<(), Error> {
    let coverage = collected(done, programs);
    let settings = unnoticed_settings(done, programs);
    output::print(summary(&coverage, &settings).as_bytes())?;
    if let Some(path) = &args.lcov {
        written.add(output::new_file(path, coverage.lcov(absolute).as_bytes())?);
    }
    if let Some(path) = &args.coverage_html {
        written.add(output::new_file(path, page(&coverage, &settings).as_bytes())?);
    }
    Ok(())
}

/// The coverage of all cases whose post can be built.
pub fn collected(done: &[Done], programs: &Programs) -> Coverage {
    let mut coverage = Coverage::default();
    for done in done {
        if let Ok(program) = programs.get(&done.case) {
            coverage.add(&program, &done.recorder);
        }
    }
    coverage
}

/// Settings that differ from the default and that no case notices when they have it: the
/// machine they are from and their name.
pub fn unnoticed_settings(done: &[Done], programs: &Programs) -> BTreeSet<(String, &'static str)> {
    let passed = || done.iter().filter(|done| done.outcome.failure.is_none());
    let mut open: BTreeSet<(String, &'static str)> = BTreeSet::new();
    for done in passed() {
        open.extend(settings_of(done, programs).into_iter().map(|(from, row)| (from, row.name)));
    }
    for done in passed() {
        let of_case = settings_of(done, programs);
        let noticed: Vec<(String, &'static str)> = of_case
            .into_par_iter()
            .filter(|(from, row)| open.contains(&(from.clone(), row.name)))
            .filter(|(_, row)| done.case.outcome_without(programs, row).failure.is_some())
            .map(|(from, row)| (from, row.name))
            .collect();
        noticed.iter().for_each(|setting| {
            open.remove(setting);
        });
    }
    open
}

fn summary(coverage: &Coverage, settings: &BTreeSet<(String, &'static str)>) -> String {
    let mut text = String::new();
    let mut all = [Share::default(); 3];
    for (name, file) in coverage.files() {
        let shares = [file.line_share(), file.branch_share(), file.part_share()];
        all.iter_mut().zip(shares).for_each(|(sum, share)| *sum += share);
        // Writing to a text can't fail.
        let _ = writeln!(text, "{name}: {}", words(shares));
        for part in file.parts().iter().filter(|part| part.count == 0) {
            let _ = writeln!(text, "  line {}: the {} never ran", part.line, part.title);
        }
        let gone = runs(file.lines().into_iter().map(|(line, count)| (line, count > 0)));
        if !gone.is_empty() {
            let _ = writeln!(text, "  lines that never ran: {gone}");
        }
        let lines = file.lines();
        let tested = |line: u32| lines.get(&line).is_some_and(|count| *count > 0);
        for branch in file.branches().iter().filter(|branch| branch.count == 0) {
            if tested(branch.opening) {
                let _ = writeln!(text, "  {}", never(branch));
            }
        }
    }
    for (machine, setting) in settings {
        let _ = writeln!(text, "{machine}: no case notices {setting} at its default");
    }
    let said = if coverage.files().next().is_none() {
        "no FIL in these cases".to_string()
    } else {
        words(all)
    };
    let _ = writeln!(text, "coverage: {said}");
    text
}

fn words([lines, branches, parts]: [Share; 3]) -> String {
    format!("lines {lines}, outcomes of conditions {branches}, sections and macros {parts}")
}

/// Lines that have not run, as `3-7, 12`: lines without statements do not part a run.
fn runs(lines: impl Iterator<Item = (u32, bool)>) -> String {
    let mut runs: Vec<(u32, u32)> = Vec::new();
    let mut goes_on = false;
    for (line, has_run) in lines {
        match runs.last_mut() {
            Some((_, last)) if !has_run && goes_on => *last = line,
            _ if !has_run => runs.push((line, line)),
            _ => {}
        }
        goes_on = !has_run;
    }
    let shown = runs.iter().map(|(first, last)| match first == last {
        true => first.to_string(),
        false => format!("{first}-{last}"),
    });
    shown.collect::<Vec<_>>().join(", ")
}

/// Editors look for files by their whole path.
fn absolute(name: &str) -> String {
    let path = Path::new(name);
    files::plain(path.canonicalize().unwrap_or_else(|_| path.to_path_buf())).display().to_string()
}

fn page(coverage: &Coverage, settings: &BTreeSet<(String, &'static str)>) -> String {
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                title { "filpost test: coverage" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                h1 { "What the cases exercise" }
                table {
                    tr { th { "File" } th { "Lines" } th { "Outcomes of conditions" } th { "Sections and macros" } }
                    @for (number, (name, file)) in coverage.files().enumerate() {
                        tr {
                            td { a href={ "#f" (number) } { (name) } }
                            td { (file.line_share().to_string()) }
                            td { (file.branch_share().to_string()) }
                            td { (file.part_share().to_string()) }
                        }
                    }
                }
                @if !settings.is_empty() {
                    h2 { "Settings that no case notices at their default" }
                    ul { @for (machine, setting) in settings { li { code { (setting) } " of " (machine) } } }
                }
                @for (number, (name, file)) in coverage.files().enumerate() {
                    h2 id={ "f" (number) } { (name) }
                    (source(file))
                }
            }
        }
    };
    page.into_string() + "\n"
}

fn source(file: &CoveredFile) -> Markup {
    let lines = file.lines();
    let missing: Vec<(u32, String)> = file
        .branches()
        .iter()
        .filter(|branch| branch.count == 0)
        .map(|branch| (branch.line, never(branch)))
        .collect();
    html! {
        table.src {
            @for (number, text) in (1u32..).zip(file.text.lines()) {
                @let notes: Vec<&str> = missing.iter().filter(|(line, _)| *line == number).map(|(_, note)| note.as_str()).collect();
                @let class = match lines.get(&number) {
                    None => "",
                    Some(0) => "miss",
                    Some(_) if !notes.is_empty() => "part",
                    Some(_) => "hit",
                };
                tr class=(class) title=(notes.join("; ")) {
                    td.n { (number) }
                    td.n { @if let Some(count) = lines.get(&number) { (count) } }
                    td { (text) }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::runs;

    #[test]
    fn lines_that_follow_each_other_are_a_run() {
        let lines = [(1, false), (2, false), (4, false), (5, true), (9, false)];
        assert_eq!(runs(lines.into_iter()), "1-4, 9");
        assert_eq!(runs([(1, true)].into_iter()), "");
    }
}
