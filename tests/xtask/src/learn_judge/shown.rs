//! What the programs that are learned from can show of a hidden post.

use super::{Part, groups, post, program};

/// Programs of parts: the number of the part, and its bytes.
type Programs = [(usize, Vec<u8>)];

/// The groups of a hidden post that change a program that is learned from, and whether they are
/// all.
pub fn shown(
    base: &str,
    options: &[String],
    groups: &[Vec<String>],
    learned: &Programs,
    parts: &[Part],
) -> (Vec<String>, bool) {
    let shows = |at: usize| {
        let rest = groups.iter().enumerate().filter(|(other, _)| *other != at);
        let rest: Vec<String> = rest.flat_map(|(_, group)| group.clone()).collect();
        let Some(without) = program(base, options, &rest) else { return true };
        changes_any(&without, learned, parts)
    };
    let shown: Vec<usize> = (0..groups.len()).filter(|at| shows(*at)).collect();
    let settings = shown.iter().flat_map(|at| groups[*at].clone()).collect();
    (settings, shown.len() == groups.len())
}

/// Variants of hidden groups that the learned programs leave open: over the hidden post they
/// change none of them.
pub fn open_variants(
    base: &str,
    options: &[String],
    settings: &[String],
    learned: &Programs,
    parts: &[Part],
) -> Vec<filpost::Program> {
    let over = |variant: Vec<String>| program(base, options, &[settings, &variant].concat());
    let variants = groups::all().filter_map(over);
    variants.filter(|other| !changes_any(other, learned, parts)).collect()
}

fn changes_any(program: &filpost::Program, programs: &Programs, parts: &[Part]) -> bool {
    programs.iter().any(|(part, nc)| changes(program, &parts[*part].cl, nc))
}

/// The program of a CL file is another one, or refused.
pub fn changes(program: &filpost::Program, cl: &str, nc: &[u8]) -> bool {
    post(program, cl).is_none_or(|(other, _)| other != nc)
}

/// A part at another place along X: the same work with other numbers.
pub fn moved(cl: &str) -> String {
    let moved = |line: &str| {
        let (word, items) = line.split_once('/')?;
        let (x, rest) = items.split_once(',')?;
        let x: f64 = x.trim().parse().ok()?;
        matches!(word.trim(), "GOTO" | "CIRCLE").then(|| format!("{word}/ {},{rest}", x + MOVE))
    };
    cl.lines().map(|line| moved(line).unwrap_or_else(|| line.into()) + "\n").collect()
}

/// How far, in the unit of the part.
const MOVE: f64 = 7.5;

/// The tools of some parts one after the other, from each of them on: work that is known, in
/// another order. Parts in another unit than the first one are left out.
pub fn recombined(cls: &[&str]) -> Vec<String> {
    let cut: Vec<(Vec<&str>, Vec<&str>)> = cls.iter().map(|cl| head_and_tools(cl)).collect();
    let orders = (1..cut.len()).map(|from| [&cut[from..], &cut[..from]].concat());
    let joined = orders.map(|parts| {
        let unit = unit(&parts[0].0);
        let tools = parts.iter().filter(|(head, _)| unit == self::unit(head));
        let lines = parts[0].0.iter().chain(tools.flat_map(|(_, tools)| tools)).chain(&["FINI"]);
        lines.map(|line| format!("{line}\n")).collect::<String>()
    });
    joined.collect()
}

/// The lines before the first tool, and those from it to FINI.
fn head_and_tools(cl: &str) -> (Vec<&str>, Vec<&str>) {
    let lines: Vec<&str> = cl.lines().filter(|line| line.trim() != "FINI").collect();
    let first = lines.iter().position(|line| line.starts_with("LOADTL")).unwrap_or(lines.len());
    (lines[..first].to_vec(), lines[first..].to_vec())
}

fn unit<'l>(head: &[&'l str]) -> Option<&'l str> {
    head.iter().find(|line| line.starts_with("UNITS")).copied()
}
