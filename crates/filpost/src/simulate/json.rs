//! A simulation as data for other programs.

use fil_stock::{Finding, Report};
use serde_json::{Value, json};

/// A report as one object: what `filpost simulate --format json` prints. Lengths in mm, volumes in
/// mm³.
pub fn as_json(report: &Report) -> Value {
    let finding = |found: &Finding| {
        let cl_line = found.source.as_ref().map(|source| source.cl_line).filter(|line| *line > 0);
        json!({
            "code": found.code.name(),
            "severity": found.severity.name(),
            "title": found.code.title,
            "message": found.message(),
            "nc_line": found.line,
            "nc_last_line": found.last,
            "cl_line": cl_line,
            "source": found.source.as_ref().map(|source| source.text.lines().collect::<Vec<_>>()),
            "tool": found.tool,
            "depth": found.depth,
            "length": found.length,
            "at": found.at,
        })
    };
    let removed =
        report.removed.iter().map(|(tool, volume)| json!({ "tool": tool, "volume": volume }));
    json!({
        "fails": report.fails,
        "findings": report.findings.iter().map(finding).collect::<Value>(),
        "more": report.more,
        "removed": report.total(),
        "removed_by_tool": removed.collect::<Value>(),
        "stock": report.stock,
        "motions": report.motions,
        "ends_only": report.ends_only,
        "without_holder": report.without_holder,
        "cell": report.cell,
    })
}
