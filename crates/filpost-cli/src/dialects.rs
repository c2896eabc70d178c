//! `filpost cl --dialects`

use filpost::Error;
use filpost::cl::ClDialect;
use filpost::cl::dialect::{ArcSense, AxisRule, DialectRules, Sign};
use filpost::cl::vocabulary::Vocabulary;
use serde_json::{Value, json};

use crate::{Status, output};

/// Lists the dialects of CL text: how each is recognized and what it means.
///
/// # Errors
/// A standard output that can't be written.
pub fn list(as_json: bool) -> Result<Status, Error> {
    if as_json {
        let rows: Value = ClDialect::ALL.iter().map(|dialect| row(dialect.rules())).collect();
        output::print(format!("{rows:#}\n").as_bytes())?;
    } else {
        let text: Vec<String> =
            ClDialect::ALL.iter().map(|dialect| entry(dialect.rules())).collect();
        output::print(text.join("\n").as_bytes())?;
    }
    Ok(Status::Done)
}

fn entry(rules: &DialectRules) -> String {
    let mut text = format!("{}: {}\n", rules.name, rules.title);
    let mut line = |name: &str, value: String| text.push_str(&format!("  {name:<12}{value}\n"));
    if !rules.signs.is_empty() {
        line("recognized", format!("by {}", signs(rules).join(", ")));
    }
    line("arcs", arcs(rules));
    line("tool axis", axis(rules.axis).to_string());
    line("units", units(rules).to_string());
    for (word, reason) in rules.without_effect {
        line("no effect", format!("{word} ({reason})"));
    }
    text
}

fn row(rules: &DialectRules) -> Value {
    let effects = rules.without_effect.iter();
    json!({
        "name": rules.name,
        "title": rules.title,
        "signs": signs(rules),
        "arcs": arcs(rules),
        "tool_axis": axis(rules.axis),
        "units": units(rules),
        "without_effect": effects.map(|(word, reason)| json!({"word": word, "reason": reason})).collect::<Value>(),
    })
}

fn signs(rules: &DialectRules) -> Vec<String> {
    let vocabulary = Vocabulary::new();
    let spell = |sign: &Sign| match sign {
        Sign::Comment(begin) => format!("a comment $$ {begin}…"),
        Sign::Pseudo => "$$-> lines".to_string(),
        Sign::Word(word) => vocabulary.name(*word).to_string(),
        Sign::Name(name) => (*name).to_string(),
        Sign::Prefix(begin) => format!("{begin}…"),
        Sign::Text(word, part) => format!("{part} in {}", vocabulary.name(*word)),
        Sign::TextBegin(word, begin) => {
            format!("{} that begins with {begin}", vocabulary.name(*word))
        }
    };
    rules.signs.iter().map(spell).collect()
}

fn arcs(rules: &DialectRules) -> String {
    let Some(form) = rules.circle else {
        return "not as CIRCLE".to_string();
    };
    let sense = match form.sense {
        ArcSense::RightHand => "the axis by the right-hand rule",
        ArcSense::LeftHand => "the axis opposite to the right-hand rule",
        ArcSense::ByWord => "CLOCKWISE or COUNTERCLOCKWISE decides",
        ArcSense::ByAxis => "the axis by the right-hand rule, whatever word stands behind",
    };
    format!("CIRCLE with {} numbers, {sense}", form.spell_counts())
}

fn axis(rule: AxisRule) -> &'static str {
    match rule {
        AxisRule::AsWritten => "as written; TLAXIS and MULTAX besides",
        AxisRule::Modal => "the last one, where a GOTO has none",
        AxisRule::ModalInMultax => "the last one while MULTAX is on, where a GOTO has none",
        AxisRule::Upright => "0,0,1 where a GOTO has none",
    }
}

fn units(rules: &DialectRules) -> &'static str {
    match rules {
        rules if rules.writes_units => "in each file",
        rules if rules.feeds_tell_unit => {
            "by its feeds: MMPM and MMPR for mm, IPM and IPR for inches"
        }
        _ => "not in each file",
    }
}
