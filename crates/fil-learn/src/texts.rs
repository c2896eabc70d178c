//! Texts of the machine: blocks that only the proven programs have, at the start, at the end and
//! around tool changes.

use std::collections::BTreeSet;
use std::io::Cursor;

use filpost::Program;

use crate::align;
use crate::change::{Changes, Key, Value};
use crate::trial::{Bench, State};
use crate::words::{self, Word, lines};

/// Indexes of the lists of texts.
const START: usize = 0;
const END: usize = 1;
const FIRST_BEFORE: usize = 2;
const FIRST_AFTER: usize = 3;
const BEFORE: usize = 4;
const AFTER: usize = 5;
const LAST_BEFORE: usize = 6;
const LAST_AFTER: usize = 7;

/// Most blocks of a run of which each part is tried.
const MOST_BLOCKS: usize = 10;

/// What the proven program has and ours lacks, by the place in ours.
#[derive(Debug, Default)]
struct Gaps {
    /// Before block n of ours, or after the last one.
    before: Vec<Vec<String>>,
    /// First and last block of ours that a tool change made.
    changes: Vec<(usize, usize)>,
}

/// Texts that would bring blocks of the proven programs.
pub(crate) fn proposals(bench: &Bench<'_>, state: &State) -> Vec<Changes> {
    let Some(commons) = state.machine.commons() else { return Vec::new() };
    let Ok(program) = state.machine.base.program.with_machine(commons) else { return Vec::new() };
    let mut runs: Vec<(usize, Vec<String>)> = Vec::new();
    for pair in 0..bench.pairs.len() {
        if let Some(gaps) = gaps(bench, state, &program, pair) {
            collect(&gaps, &mut runs);
        }
    }
    let mut seen = BTreeSet::new();
    let mut found = Vec::new();
    for (list, run) in &runs {
        let length = run.len().min(MOST_BLOCKS);
        for from in 0..length {
            for to in from + 1..=length {
                let texts = &run[from..to];
                let all_fit = texts.iter().all(|text| may_be_text(text));
                if all_fit && seen.insert((*list, texts.to_vec())) {
                    propose(state, *list, texts, &mut found);
                }
            }
        }
    }
    // Texts that are there and are not in the proven programs.
    for (key, value) in &state.machine.changes {
        if let (Key::Texts(_), Value::Texts(texts)) = (key, value) {
            found.extend(without_one(*key, texts));
        }
    }
    found.extend(base_texts(state));
    found
}

/// A text of the machine may move an axis by a G word of its own, `G0 Z100.` or `G28 Z0.`; a block
/// that cuts, or that goes on from another one, belongs to the part.
fn may_be_text(text: &str) -> bool {
    let words: Vec<Word> =
        words::blocks(text.as_bytes()).into_iter().flat_map(|block| block.words).collect();
    let moves = words.iter().any(|word| b"XYZABCUVW".contains(&word.letter));
    let codes: Vec<f64> =
        words.iter().filter(|word| word.letter == b'G').filter_map(Word::value).collect();
    let cuts = codes.iter().any(|code| (1.0..=3.0).contains(code));
    !cuts && (!moves || !codes.is_empty())
}

/// A list as it would be with further texts: alone, before and after those that it has.
fn propose(state: &State, list: usize, texts: &[String], found: &mut Vec<Changes>) {
    let key = Key::Texts(list);
    let now = match crate::change::read_changed(&state.machine, key) {
        Value::Texts(now) => now,
        Value::Number(_) | Value::Address(_) => Vec::new(),
    };
    let mut put = |texts: Vec<String>| found.push(vec![(key, Value::Texts(texts))]);
    put(texts.to_vec());
    if !now.is_empty() {
        put([texts, &now].concat());
        put([&now, texts].concat());
    }
}

/// The lists of the base without one of their texts, and without any.
fn base_texts(state: &State) -> Vec<Changes> {
    let mut found = Vec::new();
    for list in START..=LAST_AFTER {
        let key = Key::Texts(list);
        let Value::Texts(texts) = crate::change::read(state.machine.base.commons(), key) else {
            continue;
        };
        if !texts.is_empty() {
            found.push(vec![(key, Value::Texts(Vec::new()))]);
        }
        found.extend(without_one(key, &texts));
    }
    found
}

/// A list without each of its texts.
fn without_one(key: Key, texts: &[String]) -> impl Iterator<Item = Changes> + '_ {
    (0..texts.len()).map(move |at| {
        let mut fewer = texts.to_vec();
        fewer.remove(at);
        vec![(key, Value::Texts(fewer))]
    })
}

fn gaps(bench: &Bench<'_>, state: &State, program: &Program, pair: usize) -> Option<Gaps> {
    let own = state.programs[pair].as_ref()?;
    let proven = &bench.pairs[pair].proven;
    let mut gaps = Gaps { before: vec![Vec::new(); own.blocks.len() + 1], ..Gaps::default() };
    for (ours, missing) in align::gaps(&lines(&own.blocks), &lines(&proven.blocks)) {
        let missing = &proven.blocks[missing];
        let texts: Vec<String> = missing.iter().map(|block| block.text.clone()).collect();
        // Where ours has other blocks, either end of them may be the place.
        if !ours.is_empty() {
            gaps.before[ours.start].extend(texts.iter().cloned());
        }
        gaps.before[ours.end].extend(texts);
    }
    gaps.changes = changes(bench, program, pair, own.blocks.len());
    Some(gaps)
}

/// The blocks that each tool change made, by the line map.
fn changes(bench: &Bench<'_>, program: &Program, pair: usize, count: usize) -> Vec<(usize, usize)> {
    let cl = String::from_utf8_lossy(&bench.pairs[pair].cl).into_owned();
    let lines: Vec<&str> = cl.lines().collect();
    let blocks = program.start().blocks(Cursor::new(bench.pairs[pair].cl.clone()));
    let mut found: Vec<(u32, usize, usize)> = Vec::new();
    let mut at = 0;
    for block in blocks {
        let Ok(block) = block else { break };
        if block.text.trim().is_empty() {
            continue;
        }
        let line = block.origin.line;
        let text = lines.get((line as usize).saturating_sub(1)).copied().unwrap_or_default();
        let word = text.trim_start().to_ascii_uppercase();
        let is_change = ["LOADTL", "TOOLNO", "TURRET", "TOOL PATH", "TPRINT"];
        if is_change.iter().any(|begin| word.starts_with(begin)) && at < count {
            match found.last_mut() {
                Some((of, _, last)) if *of == line => *last = at,
                _ => found.push((line, at, at)),
            }
        }
        at += 1;
    }
    found.into_iter().map(|(_, first, last)| (first, last)).collect()
}

/// The runs of missing blocks by the list that would bring them.
fn collect(gaps: &Gaps, runs: &mut Vec<(usize, Vec<String>)>) {
    let mut put = |list: usize, run: &[String]| {
        if !run.is_empty() {
            runs.push((list, run.to_vec()));
        }
    };
    let last = gaps.before.len() - 1;
    // The head of the program is written at its first record, which may be that of the change.
    let first_change = gaps.changes.first().map_or(last, |(_, done)| *done);
    for run in &gaps.before[..=first_change.min(last)] {
        put(START, run);
    }
    let end = last.saturating_sub(4);
    for run in &gaps.before[end..] {
        put(END, run);
    }
    let count = gaps.changes.len();
    for (at, (first, done)) in gaps.changes.iter().enumerate() {
        let mut lists = vec![BEFORE, AFTER];
        if at == 0 {
            lists.extend([FIRST_BEFORE, FIRST_AFTER]);
        }
        if at + 1 == count && count > 1 {
            lists.extend([LAST_BEFORE, LAST_AFTER]);
        }
        // A change whose own block differs, or that writes the head, has its gaps within.
        for run in &gaps.before[*first..=(*done + 1).min(last)] {
            lists.iter().for_each(|list| put(*list, run));
        }
    }
}
