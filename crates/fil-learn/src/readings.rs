//! What can be read off the text of the proven programs: line ends, marks, blanks, the form of
//! numbers, the order of letters, sequence numbers.

use std::collections::{BTreeMap, BTreeSet};

use filpost::Commons;
use filpost::commons::EMPTY;

use crate::change::{self, Address, Changes, Key, UNUSED, Value};
use crate::trial::Bench;
use crate::words::Block;

/// Form of the numbers of a letter, as they are seen.
#[derive(Debug, Default)]
struct Form {
    plus: bool,
    point: bool,
    /// A number with a point begins with a zero, or with the point.
    zero_before_point: bool,
    no_zero_before_point: bool,
    /// A whole number begins with a zero.
    padded: bool,
    /// Digits before and after the point: fewest and most.
    whole: (usize, usize),
    decimals: (usize, usize),
    /// A fraction ends with a zero.
    ends_with_zero: bool,
    /// A number ends with its point.
    ends_with_point: bool,
    count: usize,
}

/// Changes that the texts of the proven programs suggest, over settings; each by itself.
pub(crate) fn readings(bench: &Bench<'_>, commons: &Commons) -> Vec<Changes> {
    let blocks: Vec<&Block> = bench.pairs.iter().flat_map(|pair| &pair.proven.blocks).collect();
    let mut found = marks(bench);
    found.extend(numbers(commons, &blocks, is_inch(bench)));
    found.extend(order(commons, &blocks));
    found.extend(numbering(commons, bench));
    found
}

/// The CL files count in inches.
fn is_inch(bench: &Bench<'_>) -> bool {
    let is_inch = |line: &str| {
        let line = line.trim().to_ascii_uppercase();
        line.starts_with("UNITS") && line.contains("IN")
    };
    bench.pairs.iter().any(|pair| String::from_utf8_lossy(&pair.cl).lines().any(is_inch))
}

fn set(name: &str, value: f64) -> Changes {
    change::key(name).map(|key| (key, Value::Number(value))).into_iter().collect()
}

/// Line ends, first and last characters, blanks, case, what ends a block.
fn marks(bench: &Bench<'_>) -> Vec<Changes> {
    let mut found = Vec::new();
    let Some(pair) = bench.pairs.first() else { return found };
    let blocks: Vec<&Block> = bench.pairs.iter().flat_map(|pair| &pair.proven.blocks).collect();
    let has_cr = pair.proven.bytes.contains(&b'\r');
    found.push(set("tape.line_end", if has_cr { 2.0 } else { 1.0 }));
    let character = |block: Option<&Block>| {
        let mark = block.filter(|block| block.number.is_empty() && block.text.len() == 1);
        mark.map_or(EMPTY, |block| f64::from(block.text.as_bytes()[0]))
    };
    found.push(set("tape.start_char", character(pair.proven.blocks.first())));
    found.push(set("tape.end_char", character(pair.proven.blocks.last())));
    let blank = blocks.iter().any(|block| block.has_blank);
    found.push(set("tape.blank", if blank { 2.0 } else { 1.0 }));
    let letters: Vec<u8> = blocks
        .iter()
        .flat_map(|block| &block.words)
        .filter(|word| word.letter != 0)
        .map(|word| word.text.as_bytes()[0])
        .collect();
    if letters.iter().all(u8::is_ascii_lowercase) {
        found.push(set("tape.letter_case", 2.0));
    }
    let begins = |mark: char| {
        let mut words = blocks.iter().flat_map(|block| &block.words);
        words.any(|word| word.letter == 0 && word.text.starts_with(mark))
    };
    for (mark, end) in [('(', 41.0), (';', EMPTY)] {
        if begins(mark) {
            let mut changes = set("message.out_char", f64::from(u32::from(mark)));
            changes.extend(set("message.in_char", end));
            found.push(changes);
        }
    }
    let ends: BTreeSet<Option<char>> = blocks
        .iter()
        .filter(|block| block.text.len() > 1)
        .map(|block| block.text.chars().last().filter(|c| "$;*&#".contains(*c)))
        .collect();
    if let (1, Some(Some(end))) = (ends.len(), ends.first()) {
        let mut changes = set("tape.end_of_block", 2.0);
        changes.extend(set("tape.end_of_block_char", f64::from(u32::from(*end))));
        found.push(changes);
    }
    found
}

/// The form of the numbers of each letter: of all letters at once, of groups, of each.
fn numbers(commons: &Commons, blocks: &[&Block], inch: bool) -> Vec<Changes> {
    let mut forms: BTreeMap<u8, Form> = BTreeMap::new();
    for word in blocks.iter().flat_map(|block| &block.words).filter(|word| word.letter != 0) {
        look_at(forms.entry(word.letter).or_default(), word.digits());
    }
    for block in blocks.iter().filter(|block| block.number.len() > 1) {
        look_at(forms.entry(b'N').or_default(), &block.number[1..]);
    }
    let mut found = Vec::new();
    let groups: [&[u8]; 6] = [b"", b"XYZIJKRQABCUVW", b"GM", b"THDSP", b"XYZIJKR", b"XYZ"];
    for with_digits in [true, false] {
        for group in groups {
            let taken =
                forms.iter().filter(|(letter, _)| group.is_empty() || group.contains(letter));
            let changes = taken
                .filter_map(|(letter, form)| address(commons, *letter, form, inch, with_digits));
            found.push(changes.collect());
        }
    }
    for (letter, form) in &forms {
        for with_digits in [true, false] {
            found.extend(address(commons, *letter, form, inch, with_digits).map(|c| vec![c]));
        }
        found.extend(other_forms(commons, *letter));
    }
    for rule in [0.0, 1.0, 2.0] {
        found.push(set("tape.decimal_rule", rule));
    }
    found
}

fn look_at(form: &mut Form, digits: &str) {
    form.plus |= digits.starts_with('+');
    let digits = digits.trim_start_matches(['+', '-']);
    let (whole, decimals) = match digits.split_once('.') {
        Some((whole, decimals)) => (whole, Some(decimals)),
        None => (digits, None),
    };
    if let Some(decimals) = decimals {
        form.point = true;
        form.zero_before_point |= whole == "0" && !decimals.is_empty();
        form.no_zero_before_point |= whole.is_empty();
        form.ends_with_zero |= decimals.ends_with('0');
        form.ends_with_point |= decimals.is_empty();
    } else {
        form.padded |= whole.len() > 1 && whole.starts_with('0');
    }
    let range = |range: (usize, usize), length: usize, count: usize| {
        if count == 0 { (length, length) } else { (range.0.min(length), range.1.max(length)) }
    };
    form.whole = range(form.whole, whole.len(), form.count);
    form.decimals = range(form.decimals, decimals.map_or(0, str::len), form.count);
    form.count += 1;
}

/// The address of a letter with the form that is seen; its digits only where they are asked for.
fn address(
    commons: &Commons,
    letter: u8,
    form: &Form,
    inch: bool,
    with_digits: bool,
) -> Option<(Key, Value)> {
    let now = change::address(commons, letter);
    if now.slot == UNUSED {
        return None;
    }
    let place = |value: i32, place: i32| (value / place) % 10;
    let mut spec = [1000, 100, 10, 1].map(|at| place(now.spec, at));
    spec[0] = i32::from(form.plus);
    spec[3] = i32::from(form.point || (spec[3] == 1 && form.decimals.1 == 0 && !form.padded));
    let mut whole = place(now.format, if inch { 1000 } else { 10 });
    let mut decimals = place(now.format, if inch { 100 } else { 1 });
    if form.point {
        if form.zero_before_point != form.no_zero_before_point {
            spec[1] = i32::from(form.zero_before_point);
        }
        spec[2] = i32::from(form.ends_with_zero && !form.ends_with_point);
        decimals = form.decimals.1.min(9) as i32;
        whole = whole.max(form.whole.1.min(9) as i32);
    } else {
        spec[1] = i32::from(form.padded);
        if form.padded {
            whole = form.whole.0.min(9) as i32;
        }
    }
    let digits = |whole: i32, decimals: i32| 10 * whole + decimals;
    let format = match (with_digits, inch) {
        (false, _) => now.format,
        // Leading zeros of a code or a number do not depend on the unit.
        (true, _) if form.padded && !form.point => both_whole(now.format, whole),
        (true, true) => 100 * digits(whole, decimals) + now.format % 100,
        (true, false) => now.format / 100 * 100 + digits(whole, decimals),
    };
    let spec = spec.iter().fold(0, |spec, digit| 10 * spec + digit);
    let to = Address { format, spec, ..now };
    (to != now).then_some((Key::Letter(letter), Value::Address(to)))
}

/// A format with other digits before the point, for inches and for mm.
fn both_whole(format: i32, whole: i32) -> i32 {
    let decimals = [format / 100 % 10, format % 10];
    1000 * whole + 100 * decimals[0] + 10 * whole + decimals[1]
}

/// Other forms of the numbers of a letter, one digit of the specification each.
pub(crate) fn other_forms(commons: &Commons, letter: u8) -> Vec<Changes> {
    let now = change::address(commons, letter);
    if now.slot == UNUSED {
        return Vec::new();
    }
    let place = |at: i32| (now.spec / at) % 10;
    let to = |at: i32, digit: i32| now.spec + (digit - place(at)) * at;
    let mut specs = vec![to(1000, 1 - place(1000).min(1)), to(100, 1 - place(100).min(1))];
    specs.extend([0, 1, 2].map(|digit| to(10, digit)));
    specs.push(to(1, 1 - place(1).min(1)));
    specs.retain(|spec| *spec != now.spec);
    let change = |to: Address| vec![(Key::Letter(letter), Value::Address(to))];
    let mut found: Vec<Changes> =
        specs.into_iter().map(|spec| change(Address { spec, ..now })).collect();
    for decimals in [-1, 1] {
        // The last digits after the point, for inches and for mm.
        let format = now.format + decimals * 101;
        let fits = [1, 100].iter().all(|at| (0..=9).contains(&((now.format / at) % 10 + decimals)));
        if fits {
            found.push(change(Address { format, ..now }));
        }
    }
    found
}

/// The letters in the order of the proven blocks, and letters that the base lacks.
fn order(commons: &Commons, blocks: &[&Block]) -> Vec<Changes> {
    let mut before: BTreeMap<(u8, u8), i32> = BTreeMap::new();
    let mut seen = BTreeSet::new();
    for block in blocks {
        let letters: Vec<u8> =
            block.words.iter().map(|word| word.letter).filter(|letter| *letter != 0).collect();
        for (at, first) in letters.iter().enumerate() {
            seen.insert(*first);
            for second in letters[at + 1..].iter().filter(|second| *second != first) {
                *before.entry((*first, *second)).or_default() += 1;
                *before.entry((*second, *first)).or_default() -= 1;
            }
        }
    }
    let mut now: Vec<(i32, u8)> = (b'A'..=b'Z')
        .map(|letter| (change::address(commons, letter).slot, letter))
        .filter(|(slot, _)| *slot != UNUSED)
        .collect();
    now.sort_unstable();
    let mut found = Vec::new();
    let slots: Vec<i32> = now.iter().map(|(slot, _)| *slot).collect();
    let sorted = sort(now.iter().map(|(_, letter)| *letter).collect(), &before);
    let moved = |order: &[u8]| -> Changes {
        let places = order.iter().zip(&slots).map(|(letter, slot)| {
            let address = Address { slot: *slot, ..change::address(commons, *letter) };
            (Key::Letter(*letter), Value::Address(address))
        });
        places.filter(|(key, value)| change::read(commons, *key) != *value).collect()
    };
    found.push(moved(&sorted));
    let free = (1..UNUSED).find(|slot| !slots.contains(slot));
    for letter in seen.iter().filter(|letter| !now.iter().any(|(_, known)| known == *letter)) {
        let slot = free.unwrap_or(UNUSED);
        for (format, spec) in [(4443, 101), (5050, 0)] {
            let to = Address { slot, format, spec };
            found.push(vec![(Key::Letter(*letter), Value::Address(to))]);
        }
    }
    found
}

/// Letters sorted by what precedes what; where nothing is seen, as they were.
fn sort(mut left: Vec<u8>, before: &BTreeMap<(u8, u8), i32>) -> Vec<u8> {
    let mut sorted = Vec::new();
    while !left.is_empty() {
        let must_wait = |letter: u8| {
            left.iter().any(|other| before.get(&(*other, letter)).is_some_and(|count| *count > 0))
        };
        let at = left.iter().position(|letter| !must_wait(*letter)).unwrap_or(0);
        sorted.push(left.remove(at));
    }
    sorted
}

/// Sequence numbers: whether there are any, step, begin, which blocks.
pub(crate) fn numbering(commons: &Commons, bench: &Bench<'_>) -> Vec<Changes> {
    let numbered = |pair: &crate::trial::Prepared| -> Vec<Option<f64>> {
        let number = |block: &Block| {
            let digits = block.number.trim_start_matches(['N', 'n']);
            digits.parse().ok().filter(|_| !block.number.is_empty())
        };
        pair.proven.blocks.iter().map(number).collect()
    };
    let all: Vec<Vec<Option<f64>>> = bench.pairs.iter().map(numbered).collect();
    if all.iter().flatten().all(Option::is_none) {
        return vec![set("seqno.off_at_start", 72.0)];
    }
    let mut found = Vec::new();
    let mut steps: BTreeMap<i64, usize> = BTreeMap::new();
    let mut gaps: BTreeMap<usize, usize> = BTreeMap::new();
    for numbers in &all {
        let seen: Vec<(usize, f64)> =
            numbers.iter().enumerate().filter_map(|(at, n)| Some((at, (*n)?))).collect();
        for pair in seen.windows(2) {
            *steps.entry((pair[1].1 - pair[0].1) as i64).or_default() += 1;
            *gaps.entry(pair[1].0 - pair[0].0).or_default() += 1;
        }
    }
    let most = |counts: Vec<(f64, usize)>| {
        counts.into_iter().max_by_key(|(_, count)| *count).map_or(1.0, |(value, _)| value)
    };
    let step = most(steps.into_iter().map(|(value, count)| (value as f64, count)).collect());
    let every = most(gaps.into_iter().map(|(value, count)| (value as f64, count)).collect());
    let first = all.iter().flatten().flatten().next().copied().unwrap_or(step);
    let mut form = Form::default();
    for block in bench.pairs.iter().flat_map(|pair| &pair.proven.blocks) {
        let digits = block.number.trim_start_matches(['N', 'n']);
        if !digits.is_empty() {
            look_at(&mut form, digits);
        }
    }
    let address = address(commons, b'N', &form, false, true);
    let forms = [None, Some(0.0), Some(1.0), Some(2.0), Some(3.0)];
    for start in [first - step, first, first - step / every, 0.0, first - 1.0] {
        for on_text in forms {
            for every in [every, 1.0] {
                let mut changes = set("seqno.off_at_start", 71.0);
                changes.extend(set("seqno.increment", step));
                changes.extend(set("seqno.start_offset", start));
                changes.extend(set("seqno.every", every));
                changes.extend(address.clone());
                changes.extend(on_text.map(|at| set("seqno.on_text", at)).into_iter().flatten());
                found.push(changes);
            }
        }
    }
    let largest = all.iter().flatten().flatten().copied().fold(0.0, f64::max);
    found.push(set("seqno.max", largest));
    // Numbers at tool changes alone.
    let mut aligned = set("seqno.align", 1.0);
    aligned.extend(set("seqno.off_at_start", 71.0));
    found.push(aligned);
    found
}
