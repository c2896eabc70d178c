//! What users allow by its code: in a comment of the FIL file,
//! `$$ filpost: allow W0231` at the end of a line or on the line before and
//! `$$ filpost: allow-file W0231` at the top, or for the whole load.

use std::cell::OnceCell;
use std::collections::HashMap;

use fil_diag::{Code, CodeKind, Diag, Level, Levels};

use crate::compile::files::Unit;

/// True for a code that can be allowed: every warning, and what may not be what is meant.
pub fn is_allowable(code: &Code) -> bool {
    code.kind != CodeKind::Error
}

/// The levels of a load: those of its caller for all files, and comments in each.
pub(crate) struct Allowed<'a> {
    levels: &'a Levels,
    files: Vec<File<'a>>,
}

/// A file whose comments are read once they are asked for.
struct File<'a> {
    name: &'a str,
    text: &'a str,
    comments: OnceCell<Comments>,
}

impl<'a> Allowed<'a> {
    /// The levels in these files.
    pub fn new(levels: &'a Levels, units: &'a [Unit]) -> Self {
        let files = units.iter().map(|unit| File::new(&unit.file.name, &unit.file.text));
        Allowed { levels, files: files.collect() }
    }

    /// What the comments allow: the number of the file, the line or 0 for the whole file, and
    /// the number of the code.
    pub fn comments(&self) -> Vec<(u16, u32, u16)> {
        let of_file = |(number, file): (u16, &File<'_>)| {
            let comments = file.comments();
            let everywhere = comments.everywhere.iter().map(|code| (0, code));
            let lines = comments.lines.iter();
            let lines = lines.flat_map(|(line, codes)| codes.iter().map(|code| (*line, code)));
            let all = everywhere.chain(lines);
            all.filter_map(|(line, code)| Some((number, line, code.get(1..)?.parse().ok()?)))
                .collect::<Vec<_>>()
        };
        (0..).zip(&self.files).flat_map(of_file).collect()
    }

    /// The diagnostic at its level; `None` where it is allowed.
    pub fn at_level(&self, diag: Diag) -> Option<Diag> {
        let level = self.level(&diag);
        diag.at_level(level)
    }

    /// The level of a diagnostic.
    pub fn level(&self, diag: &Diag) -> Level {
        let level = self.levels.of_code(diag.code);
        match self.is_allowed_by_comment(diag) {
            true => Level::Allow,
            false => level,
        }
    }

    fn is_allowed_by_comment(&self, diag: &Diag) -> bool {
        if !is_allowable(diag.code) {
            return false;
        }
        let name = diag.spans.first().map(|place| place.file.as_str());
        let mut files = self.files.iter().filter(|file| Some(file.name) == name);
        files.any(|file| file.comments().allow(diag))
    }
}

impl<'a> File<'a> {
    fn new(name: &'a str, text: &'a str) -> Self {
        File { name, text, comments: OnceCell::new() }
    }

    fn comments(&self) -> &Comments {
        self.comments.get_or_init(|| Comments::read(self.text))
    }
}

/// What the comments of a file allow, by the names of the codes.
#[derive(Default)]
struct Comments {
    everywhere: Vec<String>,
    lines: HashMap<u32, Vec<String>>,
}

impl Comments {
    /// Reads the comments of a text.
    fn read(text: &str) -> Self {
        let mut allowed = Comments::default();
        let mut waiting: Vec<String> = Vec::new();
        let mut at_top = true;
        for (number, line) in (1..).zip(text.lines()) {
            let (code, comment) = split(line);
            let is_code = !code.trim().is_empty();
            at_top &= !is_code;
            let (whole_file, mut codes) = comment.and_then(codes).unwrap_or_default();
            if whole_file && at_top {
                allowed.everywhere.append(&mut codes);
            } else if !whole_file {
                waiting.append(&mut codes);
            }
            if is_code && !waiting.is_empty() {
                allowed.lines.insert(number, std::mem::take(&mut waiting));
            }
        }
        allowed
    }

    fn allow(&self, diag: &Diag) -> bool {
        let Some(place) = diag.spans.first() else { return false };
        let name = diag.code.name();
        self.everywhere.contains(&name)
            || self.lines.get(&place.line).is_some_and(|codes| codes.contains(&name))
    }
}

/// A line before and behind the `$$` that opens its comment.
fn split(line: &str) -> (&str, Option<&str>) {
    let mut in_text = false;
    for (at, byte) in line.bytes().enumerate() {
        match byte {
            b'\'' => in_text = !in_text,
            b'$' if !in_text && line[at..].starts_with("$$") => {
                return (&line[..at], Some(&line[at + 2..]));
            }
            _ => {}
        }
    }
    (line, None)
}

/// The codes a comment allows, and whether it is for the whole file.
fn codes(comment: &str) -> Option<(bool, Vec<String>)> {
    let mut words = comment.split([' ', '\t', ',']).filter(|word| !word.is_empty());
    let is_ours = words.next()?.eq_ignore_ascii_case("filpost:");
    let verb = words.next().filter(|_| is_ours)?;
    let whole_file = verb.eq_ignore_ascii_case("allow-file");
    if !whole_file && !verb.eq_ignore_ascii_case("allow") {
        return None;
    }
    let is_code = |word: &String| {
        let digits = word.strip_prefix(['W', 'E']).unwrap_or_default();
        !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit())
    };
    let names = words.map(str::to_ascii_uppercase).take_while(is_code);
    Some((whole_file, names.collect()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::errors::{CompileCode, LintCode};
    use fil_diag::TextSpan;

    fn diag(code: impl Into<&'static Code>, line: u32) -> Diag {
        Diag::new(code, "").at(TextSpan::line("a.fil", line, ""))
    }

    fn allows(text: &str, line: u32) -> bool {
        Comments::read(text).allow(&diag(LintCode::UnusedLabel, line))
    }

    fn level(levels: &Levels, text: &str, diag: &Diag) -> Level {
        Allowed { levels, files: vec![File::new("a.fil", text)] }.level(diag)
    }

    #[test]
    fn at_the_end_of_the_line_or_before_it() {
        assert!(allows("XX=1\nLA) XX=2 $$ filpost: allow W0234\n", 2));
        assert!(allows("$$ filpost: allow W0220, W0234 because\n\n$$ next\nLA) XX=2\n", 4));
        assert!(!allows("LA) XX=1 $$ filpost: allow W0234\nLB) XX=2\n", 2));
        assert!(!allows("LA) XX=1 $$ filpost: allow W0235\n", 1));
        assert!(!allows("LA) XX='$$ filpost: allow W0234'\n", 1));
    }

    #[test]
    fn for_the_file_only_at_its_top() {
        assert!(allows("$$ a post\n$$ FILPOST: ALLOW-FILE W0234\nXX=1\nLA) XX=2\n", 4));
        assert!(!allows("XX=1\n$$ filpost: allow-file W0234\nLA) XX=2\n", 3));
    }

    #[test]
    fn only_errors_of_scripts_that_can_run_are_allowed() {
        let none = Levels::default();
        let mut allowed = Levels::default();
        allowed.set_all(Level::Allow);
        let open = diag(CompileCode::OpenAroundRecord, 1);
        let comment = "IF(A)THEN $$ filpost: allow E0223\n";
        assert_eq!(level(&none, comment, &open), Level::Allow);
        assert_eq!(level(&none, "IF(A)THEN $$ filpost: allow W0223\n", &open), Level::Deny);
        assert_eq!(level(&allowed, "", &open), Level::Allow);
        let own = diag(CompileCode::OwnReading, 1);
        let comment = "X=POSTF(5) $$ filpost: allow W0218\n";
        assert_eq!(level(&none, comment, &own), Level::Allow);
        assert_eq!(level(&none, "", &own), Level::Warn);
        let label = diag(CompileCode::UnknownLabel, 1);
        let comment = "JUMPTO/LA $$ filpost: allow E0201\n";
        assert_eq!(level(&allowed, comment, &label), Level::Deny);
    }
}
