//! A simulation in words.

use std::io::Write;

use filpost::nc::source::Source;
use filpost::plot::Text;
use filpost::stock::{Finding, Report};
use filpost::{CodePage, Error};

use crate::output;
use crate::summary::counted;

/// Prints the findings, each with its block and what made it, and the sum.
///
/// # Errors
/// Standard output that can't be written.
pub fn write_report(nc: Text<'_>, page: CodePage, report: &Report) -> Result<(), Error> {
    let mut wanted: Vec<u32> = report.findings.iter().map(|found| found.line).collect();
    wanted.sort_unstable();
    let source = Source::memory(nc.bytes).into_page(page);
    let lines = source.lines(nc.name, &wanted).map_err(Error::Run)?;
    output::print_with(|out| {
        for found in &report.findings {
            let block = lines.iter().find(|(line, _)| *line == found.line);
            write_finding(out, found, block.map(|(_, block)| block.as_str()))?;
        }
        if report.more > 0 {
            writeln!(out, "and {} more", counted(report.more, "finding"))?;
        }
        if !report.without_holder.is_empty() {
            let tools: Vec<String> = report.without_holder.iter().map(u32::to_string).collect();
            let (noun, verb) = if tools.len() == 1 { ("tool", "is") } else { ("tools", "are") };
            writeln!(
                out,
                "holder not checked: that of {noun} {} {verb} not known",
                tools.join(", ")
            )?;
        }
        if report.ends_only > 0 {
            let rapids = counted(report.ends_only, "rapid");
            writeln!(out, "{rapids} from or to an unknown position: at most the end was checked")?;
        }
        writeln!(out, "{}", summary(report))
    })
}

fn write_finding(out: &mut dyn Write, found: &Finding, block: Option<&str>) -> std::io::Result<()> {
    let lines = if found.last == found.line {
        format!("NC line {}", found.line)
    } else {
        format!("NC lines {} to {}", found.line, found.last)
    };
    let cl = found.source.as_ref().map(|source| source.cl_line).filter(|line| *line > 0);
    let cl = cl.map_or(String::new(), |line| format!(" (CL line {line})"));
    let (severity, code) = (found.severity.name(), found.code);
    writeln!(out, "{severity} {}: {lines}{cl}: {}: {}", code.name(), code.title, found.message())?;
    if let Some(block) = block {
        writeln!(out, "    {block}")?;
    }
    for line in found.source.iter().flat_map(|source| source.text.lines()) {
        writeln!(out, "    made by {line}")?;
    }
    Ok(())
}

/// The last line.
fn summary(report: &Report) -> String {
    let tools: Vec<String> = report
        .removed
        .iter()
        .map(|(tool, volume)| format!("tool {tool}: {}", thousands(*volume)))
        .collect();
    let by_tool = if tools.is_empty() { String::new() } else { format!(" ({})", tools.join(", ")) };
    format!(
        "removed {} of {} mm3{by_tool} in {}, cells of {} mm; {}",
        thousands(report.total()),
        thousands(report.stock),
        counted(report.motions, "motion"),
        filpost::nc::decimals::short(report.cell, 3),
        counted(report.findings.len() as u64 + report.more, "finding"),
    )
}

/// A volume without decimals, its digits in threes.
fn thousands(value: f64) -> String {
    let digits = format!("{:.0}", value.max(0.0));
    let mut shown = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index) % 3 == 0 {
            shown.push(',');
        }
        shown.push(digit);
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn digits_stand_in_threes() {
        let shown: Vec<String> = [0.0, 999.4, 1000.0, 1_234_567.0].map(thousands).to_vec();
        assert_eq!(shown, ["0", "999", "1,000", "1,234,567"]);
    }
}
