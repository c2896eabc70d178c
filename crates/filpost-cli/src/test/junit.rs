//! The report that continuous-integration servers read.

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesText, Event};

use super::Done;

type Xml = Writer<Vec<u8>>;

/// JUnit XML with one test case a regression case.
pub fn xml(done: &[Done]) -> String {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 4);
    // Writing to memory can't fail.
    report(&mut xml, done).expect("a report in memory");
    String::from_utf8_lossy(&xml.into_inner()).into_owned() + "\n"
}

fn report(xml: &mut Xml, done: &[Done]) -> std::io::Result<()> {
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    let failures = done.iter().filter(|case| case.outcome.failure.is_some()).count().to_string();
    let counts =
        [("tests", done.len().to_string()), ("failures", failures), ("errors", "0".into())];
    let counts = || counts.iter().map(|(name, count)| (*name, count.as_str()));
    let suites = xml.create_element("testsuites").with_attribute(("name", "filpost test"));
    suites.with_attributes(counts()).write_inner_content(|xml| {
        let suite = xml.create_element("testsuite").with_attribute(("name", "filpost"));
        let suite = suite.with_attributes(counts());
        suite.write_inner_content(|xml| done.iter().try_for_each(|done| case(xml, done)))?;
        Ok(())
    })?;
    Ok(())
}

fn case(xml: &mut Xml, Done { name, outcome, time, .. }: &Done) -> std::io::Result<()> {
    let seconds = format!("{:.3}", time.as_secs_f64());
    let case = xml.create_element("testcase").with_attribute(("name", printable(name).as_str()));
    let case = case.with_attributes([("classname", "filpost"), ("time", seconds.as_str())]);
    let Some(failure) = &outcome.failure else {
        return case.write_empty().map(|_| ());
    };
    let first = outcome.differences.first().map(String::as_str).or(failure.lines().next());
    let message = printable(first.unwrap_or_default());
    case.write_inner_content(|xml| {
        let element = xml.create_element("failure").with_attribute(("message", message.as_str()));
        element.write_text_content(BytesText::new(&printable(failure)))?;
        Ok(())
    })?;
    Ok(())
}

/// The text without the characters that XML 1.0 has not.
fn printable(text: &str) -> String {
    let has = |c: &char| {
        matches!(c, '\t' | '\n' | '\r') || (*c >= ' ' && !matches!(*c, '\u{fffe}' | '\u{ffff}'))
    };
    text.chars().filter(has).collect()
}
