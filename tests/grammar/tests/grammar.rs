//! The parser in the repository is the grammar's. `FILPOST_UPDATE=1` writes it anew.

use std::fs;
use std::path::Path;

#[test]
fn the_parser_is_the_grammars() {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../crates/fil-syntax/src");
    let made = filpost_grammar::parser(&source.join("grammar.lalrpop")).expect("a grammar");
    let path = source.join("grammar.rs");
    if std::env::var_os("FILPOST_UPDATE").is_some() {
        fs::write(&path, &made).expect("the parser is written");
    }
    let kept = fs::read_to_string(&path).unwrap_or_default();
    assert!(
        kept == made,
        "grammar.lalrpop has changed since grammar.rs was made: \
         FILPOST_UPDATE=1 cargo test -p filpost-grammar"
    );
}
