//! `[effects]` of a machine: what calls and codes of the shop do. Nothing about an author's block
//! that has them is in doubt.

use std::str::FromStr;

use crate::FunctionCode;

/// What a block of an author does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// It changes the tool, as M6 does.
    ToolChange,
    /// It moves the axes and leaves them clear of the part, as G28 does.
    ReturnsClear,
    /// It switches coolant.
    Coolant,
    /// It may change modes, and the axes stand behind it where they stood.
    KeepsPosition,
    /// It changes nothing that a program counts on.
    Nothing,
}

impl Effect {
    /// All of them.
    pub const ALL: [Effect; 5] = [
        Effect::ToolChange,
        Effect::ReturnsClear,
        Effect::Coolant,
        Effect::KeepsPosition,
        Effect::Nothing,
    ];

    /// Its name in `[effects]`.
    pub const fn name(self) -> &'static str {
        match self {
            Effect::ToolChange => "tool change",
            Effect::ReturnsClear => "returns clear",
            Effect::Coolant => "coolant",
            Effect::KeepsPosition => "keeps position",
            Effect::Nothing => "nothing",
        }
    }
}

impl FromStr for Effect {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Effect::ALL.into_iter().find(|effect| effect.name() == name).ok_or(())
    }
}

/// What a text matches, and what it does then.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rule {
    /// As the machine says it.
    pub said: String,
    /// Capital letters without blanks; `*` stands for any characters.
    pattern: String,
    /// The words of the pattern.
    words: Vec<String>,
    /// What it does.
    pub effect: Effect,
}

/// What a block of an author is, by the rules.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Found<'r> {
    /// The rule.
    pub rule: &'r Rule,
    /// The rule names one M function of the block; its other words do what they say.
    pub is_function: bool,
}

/// The rules of a machine.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Effects {
    rules: Vec<Rule>,
}

impl Rule {
    /// True for a rule of a pattern, which may match more than its author knows.
    pub fn is_pattern(&self) -> bool {
        self.pattern.contains('*')
    }

    /// The M function that the rule names, where it names nothing else.
    pub fn function(&self) -> Option<FunctionCode> {
        FunctionCode::of_value(self.pattern.strip_prefix('M')?.parse().ok()?)
    }
}

impl Effects {
    /// Adds a rule; a later one for the same text takes the place of an earlier one. False for
    /// an empty text and for one of nothing but `*`.
    pub fn add(&mut self, said: &str, effect: Effect) -> bool {
        let pattern = plain(said);
        if pattern.bytes().all(|byte| byte == b'*') {
            return false;
        }
        self.rules.retain(|rule| rule.pattern != pattern);
        let words = words(&pattern).map(str::to_string).collect();
        self.rules.push(Rule { said: said.trim().to_string(), pattern, words, effect });
        true
    }

    /// True for a machine without rules.
    pub fn is_empty(&self) -> bool {
        self.rules.is_empty()
    }

    /// The rules, in the order in which they were added.
    pub fn rules(&self) -> &[Rule] {
        &self.rules
    }

    /// What a block does: its exact text goes before one of its words, a word before several words
    /// in a row, these before a pattern, a longer pattern before a shorter one. A G word takes the
    /// others as its arguments. A sequence number and the block-delete character do not count.
    pub fn of(&self, block: &str) -> Option<Found<'_>> {
        if self.is_empty() {
            return None;
        }
        let text = plain(block);
        let text = without_number(&text);
        let exact = self.rules.iter().find(|rule| rule.pattern == text);
        if let Some(rule) = exact {
            return Some(Found { rule, is_function: false });
        }
        let words: Vec<&str> = words(text).collect();
        let in_block = self.rules.iter().filter_map(|rule| {
            let count = rule.words.len();
            let is_there = words.windows(count.max(1)).any(|run| run == rule.words);
            is_there.then_some((count, rule))
        });
        if let Some((_, rule)) = in_block.min_by_key(|(count, _)| *count) {
            return Some(Found { rule, is_function: rule.function().is_some() });
        }
        let patterns = self.rules.iter().filter(|rule| rule.is_pattern());
        let matching = patterns.filter(|rule| matches(&rule.pattern, text));
        let rule = matching.max_by_key(|rule| rule.pattern.len())?;
        Some(Found { rule, is_function: false })
    }
}

/// Capital letters without blanks.
fn plain(text: &str) -> String {
    text.chars().filter(|c| !c.is_whitespace()).map(|c| c.to_ascii_uppercase()).collect()
}

/// A block without its block-delete character and sequence number.
fn without_number(text: &str) -> &str {
    let text = text.trim_start_matches('/');
    match text.strip_prefix('N') {
        Some(rest) if rest.starts_with(|c: char| c.is_ascii_digit()) => {
            rest.trim_start_matches(|c: char| c.is_ascii_digit())
        }
        _ => text,
    }
}

/// The words of a block, each a letter with what follows it. A comment ends them.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let mut rest = text.split(['(', ';']).next().unwrap_or_default();
    rest = rest.trim_start_matches(|c: char| !c.is_ascii_alphabetic());
    std::iter::from_fn(move || {
        let behind = rest.get(1..)?;
        let end = behind.find(|c: char| c.is_ascii_alphabetic()).map_or(rest.len(), |at| at + 1);
        let (word, others) = rest.split_at(end);
        rest = others;
        Some(word)
    })
}

/// True where `*` of a pattern can stand for characters of the text.
fn matches(pattern: &str, text: &str) -> bool {
    let mut parts = pattern.split('*');
    let Some(mut rest) = parts.next().and_then(|first| text.strip_prefix(first)) else {
        return false;
    };
    let parts: Vec<&str> = parts.collect();
    let Some((last, between)) = parts.split_last() else { return rest.is_empty() };
    for part in between {
        let Some(at) = rest.find(part) else { return false };
        rest = &rest[at + part.len()..];
    }
    rest.ends_with(last)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn effects(rules: &[(&str, Effect)]) -> Effects {
        let mut effects = Effects::default();
        rules.iter().for_each(|(said, effect)| assert!(effects.add(said, *effect), "{said}"));
        effects
    }

    fn of(effects: &Effects, block: &str) -> Option<Effect> {
        effects.of(block).map(|found| found.rule.effect)
    }

    #[test]
    fn an_exact_text_goes_before_a_word_and_a_word_before_a_pattern() {
        let effects = effects(&[
            ("G65 P98*", Effect::ReturnsClear),
            ("G65 P9810", Effect::Nothing),
            ("M73", Effect::Coolant),
        ]);
        assert_eq!(of(&effects, "N10 G65P9811 Z3."), Some(Effect::ReturnsClear));
        assert_eq!(of(&effects, "/g65 p9810"), Some(Effect::Nothing));
        assert_eq!(of(&effects, "G65 P9810 M73"), Some(Effect::Coolant));
        assert_eq!(of(&effects, "G65 P97"), None);
        assert_eq!(of(&effects, "(M73)"), None);
        assert_eq!(of(&effects, "M730"), None);
    }

    #[test]
    fn a_call_is_found_beside_other_words() {
        let effects = effects(&[("M98 P9001", Effect::ToolChange), ("M98*", Effect::Nothing)]);
        assert_eq!(of(&effects, "T7 M98 P9001"), Some(Effect::ToolChange));
        assert_eq!(of(&effects, "M98 P90012"), Some(Effect::Nothing));
        assert_eq!(of(&effects, "M98 (P9001)"), Some(Effect::Nothing));
    }

    #[test]
    fn the_longer_pattern_wins_and_stars_stand_for_anything() {
        let effects = effects(&[("M98*", Effect::Nothing), ("M98 P90*", Effect::ToolChange)]);
        assert_eq!(of(&effects, "M98 P9001 L2"), Some(Effect::ToolChange));
        assert_eq!(of(&effects, "M98 P1"), Some(Effect::Nothing));
        assert!(matches("A*B*C", "AXBYBC") && matches("A*", "A") && !matches("A*B*C", "ACB"));
    }

    #[test]
    fn a_rule_for_everything_is_none() {
        let mut effects = Effects::default();
        assert!(!effects.add(" * ", Effect::Nothing) && !effects.add("", Effect::Nothing));
        assert!(effects.add("M66", Effect::ToolChange) && effects.add("m66", Effect::Nothing));
        assert_eq!(of(&effects, "M66 T2"), Some(Effect::Nothing));
    }

    #[test]
    fn a_g_word_takes_the_whole_block_and_an_m_word_only_itself() {
        let effects = effects(&[("G65", Effect::Nothing), ("M66", Effect::ToolChange)]);
        assert!(!effects.of("G65 P1 Z3.").is_some_and(|found| found.is_function));
        assert!(effects.of("T5 M66").is_some_and(|found| found.is_function));
    }
}
