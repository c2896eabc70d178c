//! Reading what was printed gives the same tree; no text makes the reader panic.

mod generate;

use fil_syntax::print::print;
use fil_syntax::{decode, parse};
use proptest::prelude::*;

/// A tree as text in which all spans are dropped.
fn shape(program: &fil_syntax::tree::Program) -> String {
    let text = format!("{program:?}");
    let mut parts = text.split("Span { start: ");
    let mut out = parts.next().unwrap_or_default().to_string();
    for part in parts {
        out.push_str(part.split_once('}').map_or(part, |(_, rest)| rest));
    }
    out
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, ..ProptestConfig::default() })]

    #[test]
    fn printed_trees_are_read_back(program in generate::program()) {
        let text = print(&program);
        let parsed = parse("t.fil", &text);
        prop_assert!(parsed.diags.is_empty(), "{text}\n{:#?}", parsed.diags);
        prop_assert_eq!(shape(&parsed.program), shape(&program), "{}", text);
    }

    #[test]
    fn any_bytes_are_read(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let (text, _) = decode(&bytes, None).expect("a guess always succeeds");
        parse("t.fil", &text);
    }

    #[test]
    fn any_words_and_signs_are_read(
        parts in prop::collection::vec(prop::sample::select(generate::PIECES), 0..120)
    ) {
        let text = parts.concat();
        let parsed = parse("t.fil", &text);
        for diag in &parsed.diags {
            for place in &diag.places {
                prop_assert!(place.excerpt.get(place.span.clone()).is_some());
            }
        }
        let printed = print(&parsed.program);
        if parsed.diags.iter().all(|diag| !diag.is_error()) {
            let again = parse("t.fil", &printed);
            prop_assert_eq!(shape(&again.program), shape(&parsed.program), "{}", text);
        }
    }
}
