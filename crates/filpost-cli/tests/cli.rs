//! The command as its users meet it: outputs, exit statuses, files left behind.

use std::io::Write as _;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use tempfile::TempDir;

const SMALL: &str = "PARTNO / 7\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 900, CLW\n\
                     FEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";

/// A CL file whose fourth line is refused after some output is due.
const WRONG: &str = "UNITS / MM\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nCYCLE / SIDEWAYS, 3\nFINI\n";

const NC: &str = "%\nO0007 (7)\nN10 G21 G90 G94 G17\nN20 T1 M6\nN30 S900 M3\n\
                  N40 G1 G43 X1. Y2. Z3. F200. H1\nN50 M30\n%\n";

struct Place(TempDir);

impl Place {
    fn new() -> Place {
        Place(TempDir::new().expect("a folder for the test"))
    }

    fn with(self, name: &str, text: impl AsRef<[u8]>) -> Place {
        std::fs::write(self.0.path().join(name), text).expect("a file for the test");
        self
    }

    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_filpost"));
        command.args(arguments).current_dir(self.0.path());
        command
    }

    fn run(&self, arguments: &[&str]) -> Ran {
        let output = self.command(arguments).stdin(Stdio::null()).output();
        Ran::of(output.expect("the command starts"))
    }

    fn run_with_input(&self, arguments: &[&str], input: &[u8]) -> Ran {
        let mut command = self.command(arguments);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
        let mut child = command.spawn().expect("the command starts");
        let mut stdin = child.stdin.take().expect("a pipe");
        stdin.write_all(input).expect("the command reads its input");
        drop(stdin);
        Ran::of(child.wait_with_output().expect("the command ends"))
    }

    fn text(&self, name: &str) -> Option<String> {
        std::fs::read_to_string(self.0.path().join(name)).ok()
    }

    /// Names of all files, so that nothing forgotten stays unseen.
    fn files(&self) -> Vec<String> {
        let mut names: Vec<String> = std::fs::read_dir(self.0.path())
            .expect("the folder is there")
            .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }
}

#[derive(Debug)]
struct Ran {
    status: i32,
    out: String,
    err: String,
}

impl Ran {
    fn of(output: Output) -> Ran {
        Ran {
            status: output.status.code().expect("an exit status"),
            out: String::from_utf8(output.stdout).expect("UTF-8"),
            err: String::from_utf8(output.stderr).expect("UTF-8"),
        }
    }
}

#[test]
fn nc_goes_to_standard_output_and_messages_to_standard_error() {
    let ran = Place::new().with("part.ncl", SMALL).run(&["post", "part.ncl"]);
    assert_eq!((ran.status, ran.out.as_str()), (0, NC), "{ran:?}");
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    assert!(ran.err.starts_with("fanuc-mill (the CL file has no MACHIN): 8 blocks, 0 warnings"));
}

#[test]
fn nc_goes_to_the_named_file() {
    let place = Place::new().with("part.ncl", SMALL);
    let ran = place.run(&["post", "part.ncl", "-o", "part.tap"]);
    assert_eq!((ran.status, ran.out.as_str()), (0, ""), "{ran:?}");
    assert_eq!(place.text("part.tap").as_deref(), Some(NC));
    assert_eq!(place.files(), ["part.ncl", "part.tap"]);
}

#[test]
fn streams_can_stand_for_files() {
    let place = Place::new();
    for arguments in
        [&["post", "-"][..], &["post", "-", "-o", "-"], &["post", "-p", "fanuc-mill", "-"]]
    {
        let ran = place.run_with_input(arguments, SMALL.as_bytes());
        assert_eq!((ran.status, ran.out.as_str()), (0, NC), "{arguments:?} {ran:?}");
    }
    let ran = place.run_with_input(&["post", "-"], WRONG.as_bytes());
    assert!(ran.err.contains("standard input:4:"), "{}", ran.err);
}

#[test]
fn a_refused_part_leaves_nothing_behind() {
    let place = Place::new().with("part.ncl", WRONG).with("old.tap", "old");
    for target in ["new.tap", "old.tap"] {
        let ran = place.run(&["post", "part.ncl", "-o", target]);
        assert_eq!((ran.status, ran.out.as_str()), (1, ""), "{ran:?}");
    }
    assert_eq!(place.text("old.tap").as_deref(), Some("old"));
    assert_eq!(place.files(), ["old.tap", "part.ncl"]);
    let ran = place.run(&["post", "part.ncl"]);
    assert_eq!((ran.status, ran.out.as_str()), (1, ""), "{ran:?}");
}

#[test]
fn denied_warnings_leave_nothing_behind() {
    let place = Place::new().with("part.ncl", SMALL.replace("FINI\n", ""));
    let allowed = place.run(&["post", "part.ncl"]);
    assert_eq!(allowed.status, 0, "{allowed:?}");
    assert!(allowed.err.contains("W0752") && allowed.err.contains("1 warning"), "{}", allowed.err);
    let denied = place.run(&["post", "part.ncl", "--deny-warnings", "-o", "part.tap"]);
    assert_eq!(denied.status, 1, "{denied:?}");
    assert!(denied.err.contains("W0752") && denied.err.contains("E0801"), "{}", denied.err);
    assert_eq!(place.files(), ["part.ncl"]);
}

#[test]
fn line_ends_marks_and_names_of_all_kinds() {
    let place = Place::new()
        .with("with spaces.ncl", SMALL.replace('\n', "\r\n"))
        .with("деталь.ncl", format!("\u{feff}{SMALL}"));
    for name in ["with spaces.ncl", "деталь.ncl"] {
        let ran = place.run(&["post", name, "-o", "выход 1.tap"]);
        assert_eq!(ran.status, 0, "{name}: {ran:?}");
        assert_eq!(place.text("выход 1.tap").as_deref(), Some(NC), "{name}");
    }
}

#[test]
fn code_pages_are_told_apart_or_named() {
    // ДЕТАЛЬ in windows-1251 and in KOI8-R.
    let cp1251: &[u8] = b"\xC4\xC5\xD2\xC0\xCB\xDC";
    let koi8: &[u8] = b"\xE4\xE5\xF4\xE1\xEC\xF8";
    let cl =
        |name: &[u8]| [b"PARTNO / ".as_slice(), name, b"\nPPRINT / ", name, b"\nFINI\n"].concat();
    for (bytes, label) in
        [(cp1251, None), (koi8, None), (cp1251, Some("cp1251")), (koi8, Some("koi8-r"))]
    {
        let place = Place::new().with("part.ncl", cl(bytes));
        let mut arguments = vec!["cl", "part.ncl"];
        arguments.extend(label.iter().flat_map(|label| ["--encoding", label]));
        let ran = place.run(&arguments);
        assert!(ran.out.contains("PARTNO / ДЕТАЛЬ"), "{label:?} {ran:?}");
    }
    let ran =
        Place::new().with("part.ncl", SMALL).run(&["post", "part.ncl", "--encoding", "klingon"]);
    assert_eq!(ran.status, 1);
    assert!(ran.err.contains("E0120"), "{}", ran.err);
}

#[test]
fn files_that_cannot_be_read_or_written_are_named() {
    let place = Place::new().with("part.ncl", SMALL).with("file", "");
    let missing = place.run(&["post", "nowhere.ncl", "-o", "x.tap"]);
    assert!(missing.status == 1 && missing.err.contains("E0701"), "{missing:?}");
    assert!(missing.err.contains("nowhere.ncl"), "{missing:?}");
    let folder = place.run(&["post", "."]);
    assert!(folder.status == 1 && folder.err.contains("E0701"), "{folder:?}");
    for target in ["no-such-folder/x.tap", "file/x.tap", "."] {
        let ran = place.run(&["post", "part.ncl", "-o", target]);
        assert!(ran.status == 1 && ran.err.contains("E0702"), "{target}: {ran:?}");
    }
    assert_eq!(place.files(), ["file", "part.ncl"]);
}

#[cfg(unix)]
#[test]
fn a_read_only_folder_is_refused() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::new().with("part.ncl", SMALL);
    let folder = place.0.path().join("locked");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::set_permissions(&folder, std::fs::Permissions::from_mode(0o555)).expect("rights");
    if std::fs::write(folder.join("probe"), "").is_ok() {
        println!("skipped: this user may write into read-only folders");
        return;
    }
    let ran = place.run(&["post", "part.ncl", "-o", "locked/x.tap"]);
    assert!(ran.status == 1 && ran.err.contains("E0702"), "{ran:?}");
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_an_error() {
    let place = Place::new().with("part.ncl", SMALL);
    let named = place.run(&["post", "part.ncl", "-o", "/dev/full"]);
    assert!(named.status == 1 && named.err.contains("E0702"), "{named:?}");
    let full = std::fs::File::options().write(true).open("/dev/full").expect("the device");
    for arguments in [&["post", "part.ncl"][..], &["cl", "part.ncl"], &["explain", "POSTF"]] {
        let mut command = place.command(arguments);
        let output = command.stdout(full.try_clone().expect("a handle")).output();
        let ran = Ran::of(output.expect("the command starts"));
        assert!(ran.status == 1 && ran.err.contains("E0702"), "{arguments:?} {ran:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_stays_a_device() {
    let place = Place::new().with("part.ncl", SMALL);
    let ran = place.run(&["post", "part.ncl", "-o", "/dev/null"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let null = std::fs::metadata("/dev/null").expect("the device");
    assert!(!null.is_file());
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_is_an_error() {
    let place = Place::new().with("part.ncl", SMALL);
    for arguments in [&["post", "part.ncl"][..], &["cl", "part.ncl"], &["machine", "show"]] {
        let mut command = place.command(arguments);
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        let output = command.stdout(writer).output().expect("the command starts");
        let ran = Ran::of(output);
        assert!(ran.status == 1 && ran.err.contains("E0702"), "{arguments:?} {ran:?}");
    }
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link() {
    let place = Place::new().with("part.ncl", SMALL).with("real.tap", "old");
    std::os::unix::fs::symlink("real.tap", place.0.path().join("link.tap")).expect("a link");
    let ran = place.run(&["post", "part.ncl", "-o", "link.tap"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    assert_eq!(place.text("real.tap").as_deref(), Some(NC));
    assert!(place.0.path().join("link.tap").is_symlink());
}

#[test]
fn an_output_never_replaces_an_input() {
    let place = Place::new().with("part.ncl", SMALL).with("post.fil", "FINI\n");
    for arguments in [
        &["-o", "part.ncl"][..],
        &["-o", "./part.ncl"],
        &["--listing", "part.ncl"],
        &["-f", "post.fil", "-o", "post.fil"],
        &["-o", "x.tap", "--listing", "x.tap"],
    ] {
        let ran = place.run(&[&["post", "part.ncl"], arguments].concat());
        assert!(ran.status == 1 && ran.err.contains("E0802"), "{arguments:?} {ran:?}");
    }
    assert_eq!(place.text("part.ncl").as_deref(), Some(SMALL));
    assert_eq!(place.text("post.fil").as_deref(), Some("FINI\n"));
    assert_eq!(place.files(), ["part.ncl", "post.fil"]);
}

#[test]
fn colours_only_where_they_are_wanted() {
    let place = Place::new().with("part.ncl", WRONG);
    for (name, value) in [("NO_COLOR", "1"), ("TERM", "xterm-256color")] {
        let output = place.command(&["post", "part.ncl"]).env(name, value).output();
        let ran = Ran::of(output.expect("the command starts"));
        assert!(!ran.err.contains('\u{1b}'), "{name}: {}", ran.err);
    }
}

#[test]
fn messages_cannot_steer_the_terminal() {
    let cl = "UNITS / MM\nCYCLE / SIDE\u{1b}[2JWAYS, 3\nFINI\n";
    let ran = Place::new().with("part.ncl", cl).run(&["post", "part.ncl"]);
    assert_eq!(ran.status, 1, "{ran:?}");
    assert!(!ran.err.contains('\u{1b}'), "{:?}", ran.err);
}

#[test]
fn the_post_comes_from_machin() {
    let machin = |name: &str| format!("MACHIN / {name}\n{SMALL}");
    let place = Place::new().with("part.ncl", machin("LINUXCNC-MILL, 1"));
    let ran = place.run(&["post", "part.ncl"]);
    assert!(ran.err.contains("linuxcnc-mill (for MACHIN/LINUXCNC-MILL,1)"), "{ran:?}");
    let turned = machin("UNCL01, 3").replace("1, 2, 3", "1, 0, 3");
    let lathe = place.with("lathe.ncl", turned).run(&["post", "lathe.ncl"]);
    assert!(lathe.err.contains("fanuc-lathe (no post found for MACHIN/UNCL01,3)"), "{lathe:?}");
}

#[test]
fn an_option_file_is_found_with_its_fil() {
    let option_file = "OPTION FILE\nMINE\n INTCOM:(LOCATION,VALUE)\n   0      0\n";
    let fil = "CIMFIL/ON,SPINDL\nDMY=POSTF(13)\nPOSTN/OUT,M,8\nCIMFIL/OFF\nFINI\n";
    let cl = format!("MACHIN / MYPOST, 2\n{SMALL}");
    let place = Place::new().with("part.ncl", cl);
    let folder = place.0.path().join("posts");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::write(folder.join("mypost.p02"), option_file).expect("a file");
    std::fs::write(folder.join("MYPOST.F02"), fil).expect("a file");
    let ran = place.run(&["post", "part.ncl", "--post-path", "posts"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    assert!(ran.err.contains("mypost.p02 with "), "{}", ran.err);
    assert!(ran.out.contains("M8") || ran.out.contains("M08"), "{}", ran.out);
    let alone = place.run(&["post", "part.ncl", "-m", "posts/mypost.p02"]);
    assert!(alone.err.contains("MYPOST.F02 beside the option file is not used"), "{alone:?}");
}

#[test]
fn a_post_folder_and_settings_on_top() {
    let place = Place::new().with("part.ncl", SMALL);
    let folder = place.0.path().join("mine");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::write(folder.join("machine.toml"), "seqno.increment = 5\n").expect("a file");
    let fil = "INCLUD/'part.inc'\nFINI\n";
    std::fs::write(folder.join("post.fil"), fil).expect("a file");
    let section = "CIMFIL/ON,SPINDL\nDMY=POSTF(13)\nPOSTN/OUT,M,8\nCIMFIL/OFF\nFINI\n";
    std::fs::write(folder.join("part.inc"), section).expect("a file");
    let ran = place.run(&["post", "part.ncl", "-p", "mine"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    assert!(
        ran.out.contains("N5 ") && ran.out.contains("N15 ") && ran.out.contains("M8"),
        "{ran:?}"
    );
    let set = place.run(&["post", "part.ncl", "-p", "mine", "--set", "seqno.increment=3"]);
    assert!(set.out.contains("N3 ") && set.out.contains("N6 "), "{set:?}");
    let none = place.run(&["post", "part.ncl", "-p", "yours"]);
    assert!(none.status == 1 && none.err.contains("E0703"), "{none:?}");
}

#[test]
fn the_listing_shows_records_and_blocks() {
    let place = Place::new().with("part.ncl", SMALL);
    let ran = place.run(&["post", "part.ncl", "--listing", "part.lst"]);
    assert_eq!(ran.out, NC);
    let listing = place.text("part.lst").expect("a listing");
    assert!(listing.contains("SPINDL / RPM") && listing.contains("N30 S900 M3"), "{listing}");
}

#[test]
fn a_message_goes_to_the_tape_or_to_the_listing() {
    let fil = "CIMFIL/ON,SPINDL\nPPRINT/'ON TAPE'\nDMY=POSTF(2,1,484,0)\nPPRINT/'  IN LISTING'\n\
               DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let place = Place::new().with("part.ncl", SMALL).with("post.fil", fil);
    let ran = place.run(&["post", "part.ncl", "-f", "post.fil", "--listing", "part.lst"]);
    assert!(ran.out.contains("(ON TAPE)") && !ran.out.contains("IN LISTING"), "{}", ran.out);
    let listing = place.text("part.lst").expect("a listing");
    let lines: Vec<&str> = listing.lines().filter(|line| line.contains("IN LISTING")).collect();
    assert_eq!(lines, ["                   IN LISTING"]);
}

#[test]
fn the_same_warning_is_shown_once() {
    let fil = "CIMFIL/ON,SPINDL\nAA=ZZ+0\nAA=ZZ+1\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let place = Place::new().with("part.ncl", SMALL).with("post.fil", fil);
    let ran = place.run(&["post", "part.ncl", "-f", "post.fil"]);
    assert_eq!(ran.err.matches("ZZ was never set").count(), 1, "{}", ran.err);
    assert!(ran.err.contains("this warning came 2 times"), "{}", ran.err);
    assert!(ran.err.contains("2 warnings"), "{}", ran.err);
}

#[test]
fn fil_is_checked_without_cl() {
    let place = Place::new()
        .with("good.fil", "CIMFIL/ON,COOLNT\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n")
        .with("swallow.fil", "CIMFIL/ON,COOLNT\nAA=1\nCIMFIL/OFF\nFINI\n")
        .with("bad.fil", "AA=(1\nJUMPTO/ZZ\nFINI\n");
    assert_eq!(place.run(&["check", "good.fil"]).status, 0);
    let swallow = place.run(&["check", "swallow.fil"]);
    assert!(swallow.status == 0 && swallow.err.contains("W0220"), "{swallow:?}");
    assert_eq!(place.run(&["check", "swallow.fil", "--deny-warnings"]).status, 1);
    assert_eq!(place.run(&["check", "good.fil", "bad.fil"]).status, 1);
    let json = place.run(&["check", "--format", "json", "good.fil", "bad.fil"]);
    assert_eq!(json.status, 1);
    let found: serde_json::Value = serde_json::from_str(&json.out).expect("JSON");
    let first = &found[0];
    assert_eq!((&first["code"], &first["line"]), (&"E0101".into(), &1.into()), "{first}");
    assert_eq!(first["file"], "bad.fil");
    assert_eq!(first["severity"], "error");
}

#[test]
fn records_are_shown_with_numbered_words() {
    let place = Place::new().with("part.ncl", SMALL);
    let text = place.run(&["cl", "part.ncl", "--words"]);
    assert!(text.out.contains("GOTO / 1.0, 2.0, 3.0\n"), "{}", text.out);
    assert!(text.out.contains(&format!("{:>20}  2\n", 7)), "word 7 of the GOTO is y: {}", text.out);
    let json = place.run(&["cl", "part.ncl", "--words", "--json"]);
    let found: serde_json::Value = serde_json::from_str(&json.out).expect("JSON");
    assert_eq!(found["records"].as_array().map(Vec::len), Some(7));
    assert_eq!(found["records"][5]["words"][5], 1.0);
    assert_eq!(found["extents"]["max"], serde_json::json!([1.0, 2.0, 3.0]));
}

#[test]
fn a_script_reaches_files_and_a_clock_only_when_granted() {
    let fil = "DMY=FILEF(1,READ,'tools.txt')\nT1=TEXT/READ,1\nDMY=FILEF(1,CLOSE)\n\
               DMY=FILEF(1,WRITE,'log.txt')\nWRITE/1,T1,' ',DATEF()\nFINI\n";
    let place = Place::new().with("part.ncl", SMALL).with("log.fil", fil);
    for folder in ["in", "out"] {
        std::fs::create_dir(place.0.path().join(folder)).expect("a folder");
    }
    let place = place.with("in/tools.txt", "T1;8.5\n");
    let post = ["post", "part.ncl", "-f", "log.fil", "-o", "part.tap"];
    let grants = ["--grant", "read=in,write=out"];
    let clock = ["--set-clock", "2026-01-31T12:00:00"];
    for (more, code) in [
        (&[][..], "E0321"),
        (&["--grant", "read=in"], "E0321"),
        (&grants, "E0322"),
        (&["--grant", "read=nowhere"], "E0701"),
    ] {
        let ran = place.run(&[&post[..], more].concat());
        assert!(ran.status == 1 && ran.err.contains(code), "{more:?} {ran:?}");
        assert_eq!(place.files(), ["in", "log.fil", "out", "part.ncl"], "{more:?}");
        assert_eq!(place.text("out/log.txt"), None);
    }
    let ran = place.run(&[&post[..], &grants, &clock].concat());
    assert_eq!(ran.status, 0, "{ran:?}");
    assert_eq!(place.text("out/log.txt").as_deref(), Some("T1;8.5 2026-01-31\n"));
    assert!(ran.err.contains("FIL has changed"), "{}", ran.err);
    let ran = place.run(&[&post[..], &grants, &["--clock", "system"]].concat());
    assert_eq!(ran.status, 0, "{ran:?}");
    for wrong in [
        &["--grant", "in"][..],
        &["--grant", "read="],
        &["--set-clock", "noon"],
        &["--clock", "system", "--set-clock", "2026-01-31T12:00:00"],
    ] {
        assert_eq!(place.run(&[&post[..], wrong].concat()).status, 2, "{wrong:?}");
    }
}

#[test]
fn denied_warnings_keep_the_files_of_scripts_back() {
    let fil = "DMY=FILEF(1,WRITE,'log.txt')\nWRITE/1,'DONE'\nFINI\n";
    let place = Place::new().with("part.ncl", SMALL.replace("FINI\n", "")).with("log.fil", fil);
    let post = ["post", "part.ncl", "-f", "log.fil", "-o", "part.tap", "--grant", "write=."];
    let denied = place.run(&[&post[..], &["--deny-warnings"]].concat());
    assert!(denied.status == 1 && denied.err.contains("E0801"), "{denied:?}");
    assert_eq!(place.files(), ["log.fil", "part.ncl"]);
    assert_eq!(place.run(&post).status, 0);
    assert_eq!(place.files(), ["log.fil", "log.txt", "part.ncl", "part.tap"]);
}

#[test]
fn includ_counts_from_the_including_file() {
    let place = Place::new().with("part.ncl", SMALL);
    std::fs::create_dir_all(place.0.path().join("post/lib")).expect("folders");
    let place = place
        .with("secret.fil", "PPRINT/'SECRET'\n")
        .with("post/main.fil", "INCLUD/lib/outer.fil\nFINI\n")
        .with("post/lib/outer.fil", "INCLUD/inner.fil\nINCLUD/'../side.fil'\n")
        .with("post/lib/inner.fil", "PPRINT/'INNER'\n")
        .with("post/side.fil", "PPRINT/'SIDE'\n")
        .with("post/out.fil", "INCLUD/'../secret.fil'\nFINI\n");
    let ran = place.run(&["post", "part.ncl", "-f", "post/main.fil"]);
    assert!(ran.out.contains("(INNER)") && ran.out.contains("(SIDE)"), "{ran:?}");
    assert_eq!(place.run(&["check", "post/main.fil"]).status, 0);
    for command in [&["post", "part.ncl", "-f", "post/out.fil"][..], &["check", "post/out.fil"]] {
        let ran = place.run(command);
        assert!(ran.status == 1 && ran.err.contains("E0214"), "{ran:?}");
    }
}

#[test]
fn cases_are_run_and_brought_up_to_date() {
    let case = "cl = 'part.ncl'\nready = 'fanuc-mill'\nexpect = 'part.tap'\norigin = 'own'\n";
    let place = Place::new().with("part.ncl", SMALL).with("case.toml", case).with("part.tap", NC);
    let last = |ran: &Ran| ran.out.lines().last().unwrap_or("").to_string();
    let good = place.run(&["test"]);
    assert_eq!((good.status, last(&good).as_str()), (0, "1 passed, 0 failed"));
    let place = place.with("part.tap", NC.replace("S900", "S800"));
    let bad = place.run(&["test", "."]);
    assert_eq!((bad.status, last(&bad).as_str()), (1, "0 passed, 1 failed"));
    assert!(bad.out.contains("-N30 S800 M3\n+N30 S900 M3"), "{}", bad.out);
    let update = place.run(&["test", ".", "--update"]);
    assert_eq!((update.status, last(&update).as_str()), (0, "1 passed, 0 failed"));
    assert!(update.out.contains("+N30 S900 M3"), "{}", update.out);
    assert_eq!(place.text("part.tap").as_deref(), Some(NC));
}

#[test]
fn a_test_run_without_cases_fails() {
    let ran = Place::new().run(&["test"]);
    assert!(ran.status == 1 && ran.err.contains("E0803"), "{ran:?}");
}

#[test]
fn subjects_are_explained() {
    let place = Place::new();
    for (subject, expected) in [
        ("E0501", "value does not fit its address"),
        ("W0753", "CL file without records"),
        ("E0801", "--deny-warnings"),
        ("POSTF 13", "processes the current record"),
        ("POSTF(7,n)", "Word n of the current record"),
        ("POSTF 99", "not published"),
        ("DBLCOM 486", "scale.x"),
        ("INTCOM 24", "letter X"),
        ("rapid.split", "INTCOM 1870"),
        ("CYCLE", "major word"),
        ("SQRTF", "quare root"),
        ("grbl", "GRBL"),
    ] {
        let ran = place.run(&["explain", subject]);
        assert_eq!(ran.status, 0, "{subject}: {ran:?}");
        assert!(ran.out.contains(expected), "{subject}: {}", ran.out);
    }
    let unknown = place.run(&["explain", "CYCEL"]);
    assert_eq!((unknown.status, unknown.out.as_str()), (2, ""));
    assert!(unknown.err.contains("did you mean `CYCLE`?"), "{}", unknown.err);
}

#[test]
fn every_code_is_explained() {
    let place = Place::new();
    for code in filpost::all_codes() {
        let ran = place.run(&["explain", &code.name()]);
        assert!(ran.status == 0 && ran.out.contains(code.reason), "{}: {ran:?}", code.name());
    }
}

#[test]
fn an_option_file_becomes_a_machine() {
    let option_file =
        "OPTION FILE\nMY \"MILL\"\n INTCOM:(LOCATION,VALUE)\n 1870      0\n   0      0\n";
    let place = Place::new().with("uncx01.p07", option_file).with("part.ncl", SMALL);
    let ran = place.run(&["machine", "import", "uncx01.p07", "-o", "machine.toml"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let text = place.text("machine.toml").expect("the machine");
    assert!(text.starts_with("name = \"MY \\\"MILL\\\"\"\n"), "{text}");
    assert!(text.contains("rapid.split = 0"), "{text}");
    let direct = place.run(&["post", "part.ncl", "-m", "uncx01.p07"]);
    let imported = place.run(&["post", "part.ncl", "-m", "machine.toml"]);
    assert_eq!((direct.status, &direct.out), (0, &imported.out), "{direct:?}");
    let show = place.run(&["machine", "show", "-m", "machine.toml", "rapid."]);
    assert!(show.out.contains("rapid.split                  0 (one block)"), "{}", show.out);
    assert!(!show.out.contains("cycle."), "{}", show.out);
}

#[test]
fn the_schema_knows_every_setting() {
    let ran = Place::new().run(&["machine", "schema"]);
    let schema: serde_json::Value = serde_json::from_str(&ran.out).expect("JSON");
    for row in filpost::locations::TABLE {
        let path: String = row.name.split('.').map(|part| format!("/properties/{part}")).collect();
        assert!(schema.pointer(&path).is_some(), "{}", row.name);
    }
}

#[test]
fn wrong_usage_has_its_own_status() {
    let place = Place::new();
    for arguments in [
        &[][..],
        &["fly"],
        &["post"],
        &["post", "a", "--fast"],
        &["post", "a", "-p", "b", "-m", "c"],
    ] {
        assert_eq!(place.run(arguments).status, 2, "{arguments:?}");
    }
    let version = place.run(&["--version"]);
    assert_eq!((version.status, version.out.starts_with("filpost ")), (0, true));
    let completions = place.run(&["completions", "bash"]);
    assert!(completions.status == 0 && completions.out.contains("--deny-warnings"));
}

#[test]
fn messages_look_as_they_should() {
    let place = Place::new()
        .with("form.ncl", WRONG)
        .with("open.fil", "CIMFIL/ON,COOLNT\nIF(AA.EQ.1) THEN\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n")
        .with("stack.fil", "CIMFIL/ON,SPINDL\nBB=SQRTF(0-1)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n")
        .with("part.ncl", SMALL);
    insta::assert_snapshot!("refused_record", place.run(&["post", "form.ncl"]).err);
    insta::assert_snapshot!("open_block", place.run(&["check", "open.fil"]).err);
    insta::assert_snapshot!(
        "fil_run_time",
        place.run(&["post", "part.ncl", "-f", "stack.fil"]).err
    );
}

/// Uses files of others where they are at hand.
#[test]
fn real_files_are_posted() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let data = std::env::var_os("FILPOST_DATA")
        .map_or_else(|| root.join("../shared/data"), |data| root.join(data));
    let cl = data.join("cl/creo/op010.ncl.1");
    if !cl.is_file() {
        println!("skipped: {} is not there", cl.display());
        return;
    }
    let place = Place::new();
    let ran = place.run(&["post", &cl.display().to_string(), "-o", "op010.tap"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let nc = place.text("op010.tap").expect("the program");
    assert!(nc.contains("G20") && nc.contains("S1000 M3"), "{nc}");
}
