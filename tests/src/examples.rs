//! The fenced examples of a docs page, and what filpost says to them.

use std::io::Cursor;

use filpost::{Clock, Diag, Moment, Program};

/// The CL file an example of FIL or of machine.toml runs with.
pub const PART: &str = "\
PARTNO / EXAMPLE 1
MACHIN / FANUC-MILL, 1
UNITS / MM
LOADTL / 1
SPINDL / RPM, 1000, CLW
FEDRAT / 200, MMPM
RAPID
GOTO / 0, 0, 10
CYCLE / DRILL, DEPTH, 10, MMPM, 200, CLEAR, 2
GOTO / 10, 0, 0
CYCLE / OFF
GOTO / 0, 0, 10
FINI
";

/// A fenced block of a page.
#[derive(Clone, Debug)]
pub struct Block<'a> {
    /// Words after the fence: the language, then marks such as `strict`.
    pub words: Vec<&'a str>,
    /// What stands between the fences.
    pub text: String,
    /// The last heading above it, without its signs.
    pub heading: &'a str,
    /// Line of the opening fence, 1-based.
    pub line: usize,
}

/// The fenced blocks of a page, in order.
pub fn blocks(page: &str) -> Vec<Block<'_>> {
    let mut found: Vec<Block<'_>> = Vec::new();
    let mut heading = "";
    let mut open = false;
    for (index, line) in page.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(_) if open => open = false,
            Some(words) => {
                let words = words.split([' ', ',']).filter(|word| !word.is_empty()).collect();
                found.push(Block { words, text: String::new(), heading, line: index + 1 });
                open = true;
            }
            None if open => {
                let block = found.last_mut().expect("a block is open");
                block.text.push_str(line);
                block.text.push('\n');
            }
            None if line.starts_with('#') => heading = line.trim_start_matches('#').trim(),
            None => {}
        }
    }
    found
}

/// All diagnostics of an example, or `None` for a block that is no example.
///
/// `fil` runs with [`PART`] on the ready post fanuc-mill, `cl` on the same
/// post, `toml` is a machine.toml that [`PART`] is posted with. Marks:
/// `strict`, `check` (the warnings of `filpost check`), `fuel=N`, `post=NAME`,
/// `set=KEY=VALUE` (a setting on top, any number of them), `option-file`, `compat`, `read` (the folder `tests/language/with` is granted),
/// `clock` (a fixed one). `nc` is an NC program for fanuc-mill.
pub fn run(block: &Block<'_>) -> Option<Vec<Diag>> {
    let (language, marks) = block.words.split_first()?;
    if marks.contains(&"check") {
        return Some(check(&block.text));
    }
    if *language == "nc" {
        return Some(crate::motions::refusal(&block.text).into_iter().collect());
    }
    let value = |name: &str| marks.iter().find_map(|mark| mark.strip_prefix(name));
    let mut builder = Program::builder()
        .generic(value("post=").unwrap_or("fanuc-mill"))
        .strict(marks.contains(&"strict"));
    for setting in marks.iter().filter_map(|mark| mark.strip_prefix("set=")) {
        builder = builder.set(setting);
    }
    if let Some(fuel) = value("fuel=") {
        let fuel = fuel.parse().expect("fuel is a number");
        builder = builder.limits(filpost::Limits { fuel, ..filpost::Limits::default() });
    }
    if marks.contains(&"read") {
        builder = builder.grant_read(crate::root().join("tests/language/with"));
    }
    if marks.contains(&"clock") {
        let moment = Moment::parse("2026-01-31T12:00:00").expect("a moment");
        builder = builder.clock(Clock::Fixed(moment));
    }
    let on_the_axis = PART.replace("GOTO / 10, 0, 0", "GOTO / 0, 0, 0");
    // A lathe drills where its part turns.
    let mut cl = if marks.contains(&"lathe") { &on_the_axis } else { PART };
    match *language {
        "fil" => builder = builder.fil("macros.fil", &block.text),
        "cl" => cl = &block.text,
        "toml" if marks.contains(&"compat") => {
            match filpost::read_compat("compat.toml", &block.text) {
                Ok(compat) => builder = builder.compat(compat),
                Err(diag) => return Some(vec![*diag]),
            }
        }
        "toml" => builder = builder.machine("machine.toml", &block.text),
        "text" if marks.contains(&"option-file") => {
            builder = builder.option_file("uncx01.p01", &block.text);
        }
        _ => return None,
    }
    Some(post(builder, cl))
}

fn post(builder: filpost::Builder, cl: &str) -> Vec<Diag> {
    let post = match builder.build() {
        Ok(post) => post,
        Err(error) => return error.diags().to_vec(),
    };
    let mut diags = post.warnings().to_vec();
    let run = post.start().cl_name("part.ncl");
    match run.stream_seekable(Cursor::new(cl.as_bytes()), &mut Vec::new()) {
        Ok(report) => diags.extend(report.warnings),
        Err(error) => diags.extend(error.diags().iter().cloned()),
    }
    diags
}

/// What `filpost check` says of a FIL file for the ready post fanuc-mill.
pub fn check(fil: &str) -> Vec<Diag> {
    let post = Program::builder().generic("fanuc-mill").build().expect("the ready post");
    let options = filpost::check::Options { machine: Some(post.commons()), ..Default::default() };
    filpost::check::check(&[("macros.fil", fil)], options)
}
