//! Programs with tool-tip control, written from the CL file without the post.

use fil_cl::Options;
use fil_nc::dialect::Dialect;
use fil_nc::interpret;
use fil_nc::verify::{Check, Kind, Report, Verdict, verify};
use filpost::{Diag, Post};
use filpost_tests::tip_program::{MACHINES, cases, part};

fn check(post: &Post, cl: &str, nc: &str) -> Result<Report, Box<Diag>> {
    let events = interpret::events(nc.as_bytes(), "out.nc", &Dialect::new(post.commons())?)?;
    verify(Check {
        cl: cl.as_bytes(),
        cl_name: "part.ncl",
        options: Options::default(),
        nc: nc.as_bytes(),
        events: &events,
        commons: post.commons(),
        tolerance: None,
    })
}

/// The plain program of the post and the one with tool-tip control move the tool alike.
#[test]
fn both_forms_agree_with_the_cl_file() {
    for case in cases() {
        let report = check(&case.post, &part(), &case.nc).unwrap_or_else(|d| panic!("{d}"));
        let name = &case.name;
        assert_eq!(
            report.verdict(),
            Verdict::Agrees,
            "{name}: {:#?}\n{}",
            report.findings,
            case.nc
        );
        assert_eq!((report.compared, report.matched), (14, 14), "{name}");
        let off = (report.position.max, report.axis.max);
        println!("{name}: tip off by at most {} mm, axis by {} degrees", off.0, off.1);
        assert!(!name.ends_with("tip") || off.0 < 5.001e-4, "{name}: {off:?}");
    }
}
