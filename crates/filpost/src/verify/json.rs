//! What a back-check found, as data for other programs.

use fil_nc::verify::{Between, Deviation, Finding, Peak, Report, Unverified, Verdict};
use serde_json::{Value, json};

use super::Reference;

/// What a back-check found, as one object: what `filpost verify --format json` prints and the C
/// library gives. Lengths in mm, angles in degrees.
pub fn as_json(report: &Report, reference: Reference) -> Value {
    let deviation = |of: &Deviation| {
        let line = (of.nc_line > 0).then_some(of.nc_line);
        json!({ "max": of.max, "rms": of.rms(), "nc_line": line })
    };
    let peak = |peak: &Peak| json!({ "max": peak.max, "nc_line": peak.nc_line });
    let between = |between: &Between| json!({ "position": peak(&between.position), "axis": peak(&between.axis) });
    let open = |open: &Unverified| json!({ "cl_line": open.cl_line, "what": open.what });
    json!({
        "verdict": match report.verdict() {
            Verdict::Agrees => "agrees",
            Verdict::Partly => "partly",
            Verdict::Differs => "differs",
        },
        "reference": match reference {
            Reference::ClFile => "cl-file",
            Reference::SecondRun => "second-run",
        },
        "findings": report.findings.iter().map(finding_as_json).collect::<Value>(),
        "more": report.more,
        "not_compared": report.unverified.iter().map(open).collect::<Value>(),
        "more_not_compared": report.more_unverified,
        "motions": { "asked": report.compared, "made": report.matched },
        "position": deviation(&report.position),
        "axis": deviation(&report.axis),
        "between": report.between.as_ref().map(between),
    })
}

/// A finding as one object.
pub(crate) fn finding_as_json(finding: &Finding) -> Value {
    json!({
        "kind": finding.kind.name(),
        "nc_line": finding.nc_line,
        "cl_line": finding.cl_line,
        "message": finding.message,
    })
}
