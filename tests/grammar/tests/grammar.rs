//! The lexer and the parser in the repository are those of their grammars. `FILPOST_UPDATE=1`
//! writes them anew.

use std::error::Error;
use std::fs;
use std::path::Path;

/// Fails where the file beside `grammar` is not what `make` makes of it.
fn is_made_by(grammar: &str, make: fn(&Path) -> Result<String, Box<dyn Error>>) {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../crates/fil-syntax/src");
    let grammar = source.join(grammar);
    let made = make(&grammar).expect("a grammar");
    let path = grammar.with_extension("rs");
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        fs::write(&path, &made).expect("the file is written");
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == made,
        "{} has changed since {} was made: FILPOST_UPDATE=1 cargo test -p filpost-grammar",
        grammar.display(),
        path.display()
    );
}

#[test]
fn the_parser_is_the_grammars() {
    is_made_by("grammar.lalrpop", filpost_grammar::parser);
}

#[test]
fn the_lexer_is_its_enums() {
    is_made_by("lexer.logos", filpost_grammar::lexer);
}
