//! Where programs and messages go: streams, files, devices; what is left after an error.

use crate::support::{Folder, NC, Ran, SMALL, WRONG};

#[test]
fn nc_goes_to_standard_output_and_messages_to_standard_error() {
    let ran = Folder::new().with("part.ncl", SMALL).run(&["post", "part.ncl"]);
    assert_eq!((ran.status, ran.out.as_str()), (0, NC), "{ran:?}");
    assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    assert!(
        ran.err.starts_with(
            "fanuc-mill (the CL file has no MACHIN), style plain: 8 blocks, 0 warnings"
        )
    );
}

#[test]
fn nc_goes_to_the_named_file() {
    let place = Folder::new().with("part.ncl", SMALL);
    let ran = place.run(&["post", "part.ncl", "-o", "part.tap"]);
    assert_eq!((ran.status, ran.out.as_str()), (0, ""), "{ran:?}");
    assert_eq!(place.text("part.tap").as_deref(), Some(NC));
    assert_eq!(place.files(), ["part.ncl", "part.tap"]);
}

#[test]
fn streams_can_stand_for_files() {
    let place = Folder::new();
    for arguments in [
        &["post", "-"][..],
        &["post", "-", "-o", "-"],
        &["post", "-p", "fanuc-mill", "--option=style=plain", "-"],
    ] {
        let ran = place.run_with_input(arguments, SMALL.as_bytes());
        assert_eq!((ran.status, ran.out.as_str()), (0, NC), "{arguments:?} {ran:?}");
    }
    let ran = place.run_with_input(&["post", "-"], WRONG.as_bytes());
    assert!(ran.err.contains("standard input:4:"), "{}", ran.err);
}

#[test]
fn a_refused_part_leaves_nothing_behind() {
    let place = Folder::new().with("part.ncl", WRONG).with("old.tap", "old");
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
    let place = Folder::new().with("part.ncl", SMALL.replace("FINI\n", ""));
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
    let place = Folder::new()
        .with("with spaces.ncl", SMALL.replace('\n', "\r\n"))
        .with("деталь.ncl", format!("\u{feff}{SMALL}"));
    for name in ["with spaces.ncl", "деталь.ncl"] {
        let ran = place.run(&["post", name, "-o", "выход 1.tap"]);
        assert_eq!(ran.status, 0, "{name}: {ran:?}");
        assert_eq!(place.text("выход 1.tap").as_deref(), Some(NC), "{name}");
    }
}

#[test]
fn files_that_cannot_be_read_or_written_are_named() {
    let place = Folder::new().with("part.ncl", SMALL).with("file", "");
    let missing = place.run(&["post", "nowhere.ncl", "-o", "x.tap"]);
    assert!(missing.status == 1 && missing.err.contains("E0701"), "{missing:?}");
    assert!(missing.err.contains("nowhere.ncl"), "{missing:?}");
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
    let place = Folder::new().with("part.ncl", SMALL);
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
    let place = Folder::new().with("part.ncl", SMALL);
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

/// Runs a command into a pipe whose reader is gone.
#[cfg(unix)]
fn run_into_a_closed_pipe(arguments: &[&str]) -> Ran {
    let place = Folder::new().with("part.ncl", SMALL);
    let mut command = place.command(arguments);
    let (reader, writer) = std::io::pipe().expect("a pipe");
    drop(reader);
    Ran::of(command.stdout(writer).output().expect("the command starts"))
}

#[cfg(unix)]
#[test]
fn a_closed_pipe_ends_what_is_only_looked_at_quietly() {
    for arguments in [
        &["machine", "show", "-p", "fanuc-mill"][..],
        &["machine", "schema"],
        &["explain", "CYCLE"],
        &["cl", "part.ncl"],
        &["cl", "--dialects"],
        &["man"],
        &["completions", "bash"],
    ] {
        let ran = run_into_a_closed_pipe(arguments);
        assert_eq!((ran.status, ran.err.as_str()), (0, ""), "{arguments:?}");
    }
}

/// Nobody may take the half of a program for a whole one.
#[cfg(unix)]
#[test]
fn a_closed_pipe_is_an_error_for_a_result() {
    for arguments in [&["post", "part.ncl"][..], &["cl", "part.ncl", "--to", "ncl"]] {
        let ran = run_into_a_closed_pipe(arguments);
        assert!(ran.status == 1 && ran.err.contains("E0702"), "{arguments:?} {ran:?}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_device_stays_a_device() {
    let place = Folder::new().with("part.ncl", SMALL);
    let ran = place.run(&["post", "part.ncl", "-o", "/dev/null"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let null = std::fs::metadata("/dev/null").expect("the device");
    assert!(!null.is_file());
}

#[cfg(unix)]
#[test]
fn a_link_stays_a_link() {
    let place = Folder::new().with("part.ncl", SMALL).with("real.tap", "old");
    std::os::unix::fs::symlink("real.tap", place.0.path().join("link.tap")).expect("a link");
    let ran = place.run(&["post", "part.ncl", "-o", "link.tap"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    assert_eq!(place.text("real.tap").as_deref(), Some(NC));
    assert!(place.0.path().join("link.tap").is_symlink());
}

#[test]
fn an_output_never_replaces_an_input() {
    let place = Folder::new().with("part.ncl", SMALL).with("post.fil", "FINI\n");
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

/// The summary speaks of the points of the CL file, and leaves them out when POSTN or
/// REPEAT wrote words that they don't hold.
#[test]
fn the_summary_leaves_extents_out_beside_words_of_postn() {
    let script = "CIMFIL/ON,COOLNT\nISON = 1\nCIMFIL/OFF\nCIMFIL/ON,INSERT\n\
                  IF (ISON.EQ.1) POSTN/OUT,X,99\nCIMFIL/OFF\nISON = 0\nFINI\n";
    let cl = SMALL.replace("FINI", "COOLNT/ON\nINSERT/A\nFINI");
    let place = Folder::new().with("part.ncl", &cl).with("x.fil", script);
    let plain = Folder::new().with("part.ncl", SMALL).run(&["post", "part.ncl"]);
    assert!(plain.err.contains(", CL points X ") && !plain.err.contains("POSTN"), "{}", plain.err);
    let ran = place.run(&["post", "part.ncl", "-f", "x.fil"]);
    assert_eq!(ran.status, 0, "{}", ran.err);
    assert!(ran.err.contains("no extents: POSTN or REPEAT wrote axis words"), "{}", ran.err);
    assert!(!ran.err.contains("CL points"), "{}", ran.err);
    assert!(ran.err.contains("section COOLNT took 1 record and wrote nothing for it"));
}

#[test]
fn a_program_of_an_earlier_run_is_named_where_the_new_one_is_refused() {
    let place = Folder::new().with("part.ncl", SMALL.replace("FINI", "NOSUCH / 1\nFINI"));
    let first = place.run(&["post", "part.ncl", "-o", "part.nc"]);
    assert!(first.status == 1 && !first.err.contains("earlier run"), "{first:?}");
    let place = place.with("part.nc", "M30\n");
    for output in ["part.nc", "./part.nc"] {
        let ran = place.run(&["post", "-o", output, "part.ncl"]);
        assert!(ran.status == 1 && ran.err.contains("part.nc is of an earlier run"), "{ran:?}");
        assert_eq!(place.text("part.nc").as_deref(), Some("M30\n"));
    }
    let over = place.run(&["post", "-o", "./part.ncl", "part.ncl"]);
    assert!(over.status == 1 && !over.err.contains("earlier run"), "{over:?}");
}
