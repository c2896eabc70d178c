//! CIMFIL sections and their keys.

use fil_cl::record::{kind, motion};
use fil_syntax::tree::{Section, SectionKey};

use super::Compiler;
use crate::errors::CompileCode;
use crate::module::{self, SectionId};

/// Types that are a word of their own: a key of numbers and one of the word
/// stand for the same records.
const TYPE_WORDS: &[(u32, Option<u32>, &str)] = &[
    (kind::MOTION, Some(motion::FROM), "FROM"),
    (kind::MOTION, Some(motion::GODLTA), "GODLTA"),
    (kind::MOTION, Some(motion::GOTO), "GOTO"),
    (kind::CUTTER, Some(6), "CUTTER"),
    (kind::MODE, Some(1), "TLAXIS"),
    (kind::MODE, Some(2), "MULTAX"),
    (kind::FINI, None, "FINI"),
];

/// The key of a section for all records that no other section takes.
pub(crate) const ALL: &str = "ALL";

impl Compiler<'_> {
    pub(super) fn section(&mut self, section: &Section) {
        let key = written(&section.key);
        let chunk = self.build_chunk(format!("section {key}"), section.span, |this| {
            this.collect_labels(&section.body, &mut Vec::new());
            this.statements(&section.body);
        });
        let id = SectionId(self.index(self.module.sections.len(), section.span, "sections"));
        let file = self.unit as u16;
        if let Some(other) = self.add_key(&section.key, id) {
            self.report_same_key(section, &key, other);
        }
        self.module.sections.push(module::Section { key, chunk, file, span: section.span });
    }

    fn add_key(&mut self, key: &SectionKey, id: SectionId) -> Option<SectionId> {
        match key {
            SectionKey::Words { major, minors } if major.text == ALL && minors.is_empty() => {
                self.module.matcher.add_rest(id)
            }
            SectionKey::Words { major, minors } => {
                let major = self.vocab.intern(&major.text);
                let minors = minors.iter().map(|minor| self.vocab.intern(&minor.text)).collect();
                self.module.matcher.add_words(major, minors, id)
            }
            SectionKey::Types { kind, sub, .. } => {
                match TYPE_WORDS.iter().find(|(k, s, _)| (*k, *s) == (*kind, *sub)) {
                    Some((_, _, word)) => {
                        let major = self.vocab.intern(word);
                        self.module.matcher.add_words(major, Vec::new(), id)
                    }
                    None => self.module.matcher.add_types(*kind, *sub, id),
                }
            }
        }
    }

    fn report_same_key(&mut self, section: &Section, key: &str, other: SectionId) {
        let first = &self.module.sections[usize::from(other.0)];
        let first_place =
            self.module.files[usize::from(first.file)].place(first.span).label("the first one");
        let message = format!("CIMFIL/ON,{key} takes the same records as CIMFIL/ON,{}", first.key);
        self.report(CompileCode::SectionTwice, section.span, message);
        if let Some(diag) = self.diags.last_mut() {
            diag.spans.push(first_place);
        }
    }

    /// True while statements outside of sections and macros are compiled.
    pub(super) fn in_global_area(&self) -> bool {
        self.module.globals.len() < self.found.roots.len()
    }
}

/// A key as FIL writes it.
pub(crate) fn written(key: &SectionKey) -> String {
    match key {
        SectionKey::Words { major, minors } => {
            let words = std::iter::once(major).chain(minors);
            words.map(|word| word.text.as_str()).collect::<Vec<_>>().join(",")
        }
        SectionKey::Types { kind, sub: Some(sub), .. } => format!("{kind},{sub}"),
        SectionKey::Types { kind, sub: None, .. } => kind.to_string(),
    }
}
