//! The report that continuous-integration servers read.

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::Done;

/// JUnit XML with one test case a regression case.
pub fn xml(done: &[Done]) -> String {
    let mut suite = TestSuite::new("filpost");
    for Done { name, outcome, time, .. } in done {
        let status = match &outcome.failure {
            None => TestCaseStatus::success(),
            Some(failure) => {
                let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
                let first = outcome.differences.first().map(String::as_str);
                status.set_message(first.or(failure.lines().next()).unwrap_or_default());
                status.set_description(failure);
                status
            }
        };
        let mut case = TestCase::new(name.as_str(), status);
        case.set_classname("filpost").set_time(*time);
        suite.add_test_case(case);
    }
    let mut report = Report::new("filpost test");
    report.add_test_suite(suite);
    // Writing to a text can't fail; what can is a character that XML has not,
    // and the library leaves those out.
    report.to_string().unwrap_or_default()
}
