//! Every NC program the suites expect, with the CL file and the machine it is for.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use filpost::{Program, case};

use crate::words::Header;
use crate::{root, tip_program};

/// A program and what it comes from.
pub struct NcCase {
    /// Name for reports.
    pub name: String,
    /// The CL file.
    pub cl: Vec<u8>,
    /// The program.
    pub nc: String,
    /// The post that makes it.
    pub post: Program,
    /// FIL has a part in it, so that the CL file alone does not say what it does.
    pub fil: bool,
}

/// All programs of the suites, sorted by name.
pub fn all() -> Vec<NcCase> {
    let mut cases = corpus();
    cases.extend(words());
    cases.extend(ready());
    cases.extend(foreign());
    cases.extend(tip_program::cases());
    cases.sort_by(|a, b| a.name.cmp(&b.name));
    cases
}

/// Cases of the corpus that expect a program.
fn corpus() -> Vec<NcCase> {
    let folder = root().join("corpus");
    let cases = case::find(&folder).expect("the corpus");
    // The judges read a CL file without being told its dialect or its unit.
    let recognized =
        cases.into_iter().filter(|case| case.file.dialect.is_none() && case.file.units.is_none());
    let with_program = recognized.filter_map(|case| {
        let nc = fs::read_to_string(case.folder.join(case.file.expect.as_ref()?)).ok()?;
        let name = case.folder.strip_prefix(&folder).ok()?.display().to_string();
        Some(NcCase {
            name: format!("corpus/{name}"),
            cl: fs::read(case.folder.join(&case.file.cl)).expect("a CL file"),
            nc,
            post: case.program().expect("a post"),
            fil: !case.file.fil.is_empty(),
        })
    });
    with_program.collect()
}

/// Files of `tests/words` whose texts move the machine otherwise than the CL file asks, change the
/// tool where the control would not, call what lies elsewhere, name functions that no machine of the suite has, or dwell in turns,
/// which the interpreter reads as seconds.
const NOT_FROM_CL: &[&str] = &[
    "auxfun-6-leaves-the-axes-open",
    "circle-smaller-than-the-last-digit",
    "circle-whose-ends-round-together",
    "cycle-bottom-changed-by-a-text",
    "cycle-kind-changed-by-prefun",
    "delay-in-revolutions",
    "goto-along-an-axis-off-the-tape-warns",
    "insert-of-a-call-may-have-done-anything",
    "insert-of-a-parameter-changes-nothing",
    "insert-of-a-statement-may-have-done-anything",
    "levels-a-tool-change-of-an-author-in-compensation-warns-in-legacy",
    "levels-a-tool-change-of-an-author-within-opskip-warns-in-legacy",
    "postn-of-g91-is-undone",
    "postn-work-offset-with-a-decimal",
    "prefun-of-the-other-unit-is-undone",
    "program-start-blocks-that-leave-the-other-unit",
    "repeat-off-leaves-no-axis-elsewhere",
    "repeat-off-leaves-no-feed-in-force",
    "repeat-off-warns-of-what-stays",
];

/// Files of `tests/words` that are posted.
fn words() -> Vec<NcCase> {
    let files = files_in(&root().join("tests/words"));
    let posted = files.into_iter().filter_map(|path| {
        let text = fs::read_to_string(&path).ok()?;
        let header = Header::read(&text).ok()?;
        if !header.whole && text.contains("INCHES") {
            // Nothing in a program without its start says the unit.
            return None;
        }
        let post = header.post().ok()?;
        let nc = run(&post, text.as_bytes())?;
        let name = path.file_stem()?.to_string_lossy().into_owned();
        if NOT_FROM_CL.contains(&&name[..]) {
            return None;
        }
        Some(NcCase {
            name: format!("words/{name}"),
            cl: text.into_bytes(),
            nc,
            post,
            fil: !header.fil.is_empty(),
        })
    });
    posted.collect()
}

/// Our own CL files through every ready post that takes them.
fn ready() -> Vec<NcCase> {
    let files = files_in(&root().join("tests/cl"));
    let mut cases = Vec::new();
    for path in &files {
        cases.extend(posted(path));
    }
    cases
}

/// Programs of other posts in `tests/verify`, beside the CL files they were made from.
fn foreign() -> Vec<NcCase> {
    let files = files_in(&root().join("tests/verify")).into_iter();
    let programs = files.filter(|path| path.extension().is_some_and(|ending| ending == "nc"));
    let case = |path: PathBuf| {
        let text = fs::read_to_string(path.with_extension("ncl")).expect("its CL file");
        let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        NcCase {
            name: format!("verify/{name}"),
            nc: fs::read_to_string(&path).expect("a program"),
            post: Header::read(&text).expect("a header").post().expect("a post"),
            cl: text.into_bytes(),
            fil: false,
        }
    };
    programs.map(case).collect()
}

/// A CL file through every ready post that takes it.
pub fn posted(path: &Path) -> Vec<NcCase> {
    filpost::ready::READY.iter().filter_map(|ready| posted_by(ready.name, path)).collect()
}

/// A CL file through one ready post; `None` when it does not take the file.
pub fn posted_by(ready: &str, path: &Path) -> Option<NcCase> {
    let cl = fs::read(path).expect("a CL file");
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let post = Program::builder().generic(ready).build().ok()?;
    Some(NcCase { name: format!("{ready}/{name}"), nc: run(&post, &cl)?, cl, post, fil: false })
}

/// The program; `None` for an input that is to be refused.
fn run(post: &Program, cl: &[u8]) -> Option<String> {
    let mut nc = Vec::new();
    post.stream_seekable(Cursor::new(cl), &mut nc).ok()?;
    String::from_utf8(nc).ok()
}

/// The files of a folder, sorted.
pub fn files_in(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.retain(|path| path.is_file());
    files.sort();
    files
}
