//! A difference in a machinist's words.

use super::{Difference, Program, What};
use crate::decimals;

/// Names of functions; the others are called by their codes.
const NAMES: [(u8, i32, &str); 27] = [
    (b'G', 0, "rapid"),
    (b'G', 1, "straight line at feed"),
    (b'G', 2, "arc clockwise"),
    (b'G', 3, "arc counterclockwise"),
    (b'G', 4, "dwell"),
    (b'G', 17, "XY plane"),
    (b'G', 18, "ZX plane"),
    (b'G', 19, "YZ plane"),
    (b'G', 20, "inches"),
    (b'G', 21, "millimetres"),
    (b'G', 40, "compensation off"),
    (b'G', 41, "compensation left"),
    (b'G', 42, "compensation right"),
    (b'G', 43, "tool length on"),
    (b'G', 49, "tool length off"),
    (b'G', 80, "cycle off"),
    (b'G', 90, "absolute"),
    (b'G', 91, "incremental"),
    (b'G', 96, "constant surface speed"),
    (b'G', 97, "constant spindle speed"),
    (b'M', 3, "spindle clockwise"),
    (b'M', 4, "spindle counterclockwise"),
    (b'M', 5, "spindle stop"),
    (b'M', 6, "tool change"),
    (b'M', 7, "mist"),
    (b'M', 8, "coolant on"),
    (b'M', 9, "coolant off"),
];

/// One line about a difference, of the second program as against the first:
/// `block N120: Z deeper by 0.3 (-5 instead of -4.7)`.
pub fn sentence(difference: &Difference, first: &Program, second: &Program) -> String {
    let programs = [first, second];
    let block = block_name(difference, programs);
    let said = match &difference.what {
        What::Only => {
            let side = usize::from(difference.lines[0].is_none());
            let text =
                difference.lines[side].map_or_else(String::new, |line| programs[side].text(line));
            let name = second.name();
            let found = [format!("is missing in {name}"), format!("is in {name} alone")];
            return format!("{block} {}: {text}", found[side]);
        }
        What::Word(letter, values) => word(*letter, *values),
        What::Function(letter, codes) => function(*letter, *codes),
        What::Arc(deviation) => format!("the arc runs up to {} beside", number(*deviation)),
        What::Statement([one, two]) if one.is_empty() => format!("`{two}` is new"),
        What::Statement([one, two]) if two.is_empty() => format!("`{one}` is missing"),
        What::Statement([one, two]) => format!("`{two}` instead of `{one}`"),
        What::Comment([one, two]) => format!("comment ({two}) instead of ({one})"),
        What::Mark(_) => "tape mark or block skip in one program alone".to_string(),
        What::Numbering(count, numbers) => {
            let [one, two] =
                numbers.map(|n| n.map_or("no number".to_string(), |n| format!("N{n}")));
            format!("{two} instead of {one}; numbers differ in {count} blocks")
        }
        What::Points(letter, count) => format!(
            "{} has a decimal point in one program alone, in {count} blocks; many controls read \
             a number without one as thousandths",
            char::from(*letter)
        ),
    };
    format!("{block}: {said}")
}

/// `block N120` by the number of the first program, `line 7` without one.
fn block_name(difference: &Difference, programs: [&Program; 2]) -> String {
    let side = usize::from(difference.lines[0].is_none());
    let Some(line) = difference.lines[side] else { return "program".to_string() };
    match programs[side].sequence_number(line) {
        Some(number) => format!("block N{number}"),
        None => format!("line {line}"),
    }
}

fn word(letter: u8, values: [Option<f64>; 2]) -> String {
    let name = match letter {
        b'F' => "feed".to_string(),
        b'S' => "spindle speed".to_string(),
        b'T' => "tool".to_string(),
        b'H' => "length offset".to_string(),
        b'D' => "radius offset".to_string(),
        b'O' => "program number".to_string(),
        letter => char::from(letter).to_string(),
    };
    match values {
        [Some(one), Some(two)] => {
            let instead = format!("{} instead of {}", number(two), number(one));
            let step = number((two - one).abs());
            match letter {
                b'Z' if two < one => format!("Z deeper by {step} ({instead})"),
                b'Z' => format!("Z higher by {step} ({instead})"),
                b'T' | b'H' | b'D' | b'O' => format!("{name} {instead}"),
                _ => format!(
                    "{name} {} by {step} ({instead})",
                    if two > one { "more" } else { "less" }
                ),
            }
        }
        [Some(one), None] => format!("{name} {} is missing", number(one)),
        [None, Some(two)] => format!("{name} {} is new", number(two)),
        [None, None] => format!("{name} differs"),
    }
}

fn function(letter: u8, codes: [Option<f64>; 2]) -> String {
    let name = |code: f64| {
        let short = format!("{}{}", char::from(letter), number(code));
        let named = NAMES.iter().find(|row| row.0 == letter && f64::from(row.1) == code);
        named.map_or(short.clone(), |row| format!("{} ({short})", row.2))
    };
    match codes {
        [Some(one), Some(two)] => format!("{} instead of {}", name(two), name(one)),
        [Some(one), None] => format!("{} is missing", name(one)),
        [None, Some(two)] => format!("{} is new", name(two)),
        [None, None] => "functions differ".to_string(),
    }
}

/// A number without needless zeros.
fn number(value: f64) -> String {
    decimals::short(value, 5)
}
