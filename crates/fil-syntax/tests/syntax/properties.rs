//! Reading what was printed gives the same tree; no text makes the reader panic;
//! formatting changes no tree and is done in one go.

use fil_syntax::print::print;
use fil_syntax::{decode, format, parse};
use proptest::prelude::*;

use crate::generate;

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

/// What may be done to a line of a printed program without changing what it says.
#[derive(Clone, Copy, Debug)]
enum Noise {
    None,
    Indented,
    BlankAbove,
    CommentAbove,
    IndentedCommentAbove,
    BannerAbove,
    CommentBehind,
    EmptyStatement,
    CommaContinued,
    CommaContinuedWithComment,
    JoinedWithNext,
    LowerCase,
}

fn noise() -> impl Strategy<Value = Vec<Noise>> {
    use Noise::*;
    let one = prop::sample::select(vec![
        None,
        None,
        Indented,
        BlankAbove,
        CommentAbove,
        IndentedCommentAbove,
        BannerAbove,
        CommentBehind,
        EmptyStatement,
        CommaContinued,
        CommaContinuedWithComment,
        JoinedWithNext,
        LowerCase,
    ]);
    prop::collection::vec(one, 1..60)
}

/// True when the blanks, commas and letters of a line are all FIL's own.
fn is_plain(line: &str) -> bool {
    let free = ["PARTNO", "PPRINT", "INSERT", "LETTER", "REMARK", "INCLUD"];
    !line.contains('\'') && !free.iter().any(|word| line.contains(word))
}

/// A printed program with its lines in disorder.
fn disordered(printed: &str, noise: &[Noise]) -> String {
    let mut text = String::new();
    for (line, noise) in printed.lines().zip(noise.iter().cycle()) {
        text.push_str(&match noise {
            Noise::Indented => format!(" \t{line} \t\n"),
            Noise::BlankAbove => format!("\n  \n{line}\n"),
            Noise::CommentAbove => format!("$$ Comment 'я \n{line}\n"),
            Noise::IndentedCommentAbove => format!("   $$ $ comment\n\n{line}\n"),
            Noise::BannerAbove => format!("$$ =====\n$$ banner\n$$ ---\n{line}\n"),
            Noise::CommentBehind => format!("{line}$$;comment $\n"),
            Noise::EmptyStatement if is_plain(line) => format!("; {line} ;;\n"),
            Noise::CommaContinued if is_plain(line) => format!("{}\n", line.replace(',', "$\n,")),
            Noise::CommaContinuedWithComment if is_plain(line) => {
                format!("{}\n", line.replace(',', " , $ $$ part\n"))
            }
            Noise::JoinedWithNext if is_plain(line) && line != "FINI" => format!("{line}; "),
            Noise::LowerCase if is_plain(line) => format!("{}\n", line.to_ascii_lowercase()),
            _ => format!("{line}\n"),
        });
    }
    text
}

/// The comments of a text whose comments hold no apostrophe but one of their own.
fn comments(text: &str) -> usize {
    ["$$ Comment", "$$ $ comment", "$$ =====", "$$ banner", "$$ ---", "$$;comment $", "$$ part"]
        .iter()
        .map(|comment| text.matches(comment).count())
        .sum()
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
            for place in &diag.spans {
                prop_assert!(place.excerpt.get(place.span.clone()).is_some());
            }
        }
        let printed = print(&parsed.program);
        if parsed.diags.iter().all(|diag| !diag.is_error()) {
            let again = parse("t.fil", &printed);
            prop_assert_eq!(shape(&again.program), shape(&parsed.program), "{}", text);
        }
    }
    #[test]
    fn formatting_keeps_the_tree_and_the_comments(
        program in generate::program(),
        noise in noise(),
    ) {
        let source = disordered(&print(&program), &noise);
        let text = format("t.fil", &source).expect("no errors");
        let parsed = parse("t.fil", &text);
        prop_assert_eq!(shape(&parsed.program), shape(&program), "{}\n{}", source, text);
        prop_assert_eq!(comments(&text), comments(&source), "{}\n{}", source, text);
        let again = format("t.fil", &text).expect("no errors");
        prop_assert_eq!(&again, &text, "{}", source);
        prop_assert!(!text.contains("\n\n\n") && !text.contains(" \n"), "{}", text);
    }

    #[test]
    fn there_is_one_layout(program in generate::program(), noise in noise()) {
        let kept = |noise: &&Noise| {
            matches!(noise, Noise::Indented | Noise::CommaContinued | Noise::LowerCase)
        };
        let noise: Vec<_> = noise.iter().filter(kept).copied().chain([Noise::None]).collect();
        let printed = print(&program);
        let source = disordered(&printed, &noise);
        prop_assert_eq!(format("t.fil", &source).ok(), format("t.fil", &printed).ok());
    }

    #[test]
    fn whatever_is_read_is_formatted_in_one_go(
        parts in prop::collection::vec(prop::sample::select(generate::PIECES), 0..60)
    ) {
        let source = parts.concat();
        if let Ok(text) = format("t.fil", &source) {
            let (before, after) = (parse("t.fil", &source), parse("t.fil", &text));
            prop_assert_eq!(shape(&before.program), shape(&after.program), "{}", source);
            prop_assert_eq!(format("t.fil", &text).ok(), Some(text), "{}", source);
        }
    }
}
