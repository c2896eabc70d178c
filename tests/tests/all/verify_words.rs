//! The verifier knows each post word: it reads the word, or says why no step comes of it.

use fil_cl::Vocabulary;
use fil_nc::verify::{ignored_words, knows_word};
use fil_post::dispatch::HANDLERS;

#[test]
fn each_handler_is_known_to_verify() {
    let vocabulary = Vocabulary::new();
    let unknown: Vec<&str> = HANDLERS
        .iter()
        .filter(|(word, _)| !knows_word(*word))
        .map(|(word, _)| vocabulary.name(*word))
        .collect();
    assert!(
        unknown.is_empty(),
        "post words without a row in WORDS of fil-nc's verify/cl_path/words.rs: {unknown:?}"
    );
}

#[test]
fn each_ignored_word_is_one_that_the_post_handles() {
    let vocabulary = Vocabulary::new();
    for (word, why) in ignored_words() {
        let name = vocabulary.name(word);
        assert!(HANDLERS.iter().any(|(handled, _)| *handled == word), "{name} is no post word");
        assert!(!why.is_empty(), "{name} is ignored without a reason");
    }
}
