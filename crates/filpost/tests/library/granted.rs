//! What a script may reach outside of the post, and what it may not.

use std::io::Cursor;
use std::path::Path;

use filpost::{Builder, Clock, Error, Moment, Program, includes};

const PART: &str = "UNITS / MM\nRAPID\nGOTO / 1, 2, 3\nFINI\n";

fn with(fil: &str) -> Builder {
    Program::builder().fil("test.fil", &format!("{fil}\nFINI\n"))
}

fn post(builder: Builder) -> Result<String, Error> {
    let mut nc = Vec::new();
    builder.build()?.stream(PART.as_bytes(), &mut nc)?;
    Ok(String::from_utf8(nc).expect("the program is text"))
}

fn refused(builder: Builder) -> String {
    let error = post(builder).expect_err("refused");
    error.diags()[0].code.name()
}

/// Names of the files of a folder, sorted.
fn names(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).expect("the folder");
    let mut names: Vec<String> = entries
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    names
}

fn read(path: impl AsRef<Path>) -> String {
    std::fs::read_to_string(path).expect("a text")
}

#[test]
fn commands_run_only_through_the_embedding_program() {
    let fil = "VV=SPAWNF('measure 7')\nPPRINT/VV";
    assert_eq!(refused(with(fil)), "E0323");
    let allowed = with(fil).allow_spawn(|command| {
        assert_eq!(command, "measure 7");
        Ok(42.0)
    });
    assert!(post(allowed).expect("allowed").contains("(42)"));
    assert_eq!(refused(with(fil).allow_spawn(|_| Err("no probe".into()))), "E0317");
    assert_eq!(refused(with(fil).allow_spawn(|_| Ok(f64::NAN))), "E0317");
}

#[test]
fn the_clock_is_fixed_or_the_systems() {
    let fil = "T1=TEXT/DATEF(),'T',TIMEF()\nPPRINT/T1";
    assert_eq!(refused(with(fil)), "E0322");
    let moment = Moment::parse("2026-01-31T12:00:00").expect("a moment");
    let fixed = || post(with(fil).clock(Clock::Fixed(moment))).expect("fixed");
    assert!(fixed().contains("(2026-01-31T12:00:00)"));
    assert_eq!(fixed(), fixed());
    let mut system = with("YY=DATEF(1)\nIF(YY.GE.2024)PPRINT/'NOW'").clock(Clock::System);
    system = system.set("tape.start_char=none");
    assert!(post(system).expect("the system has a clock").contains("(NOW)"));
}

#[test]
fn a_folder_that_is_not_there_cannot_be_granted() {
    let folder = tempfile::tempdir().expect("a folder");
    assert_eq!(refused(with("").grant_read(folder.path().join("absent"))), "E0701");
    std::fs::write(folder.path().join("plain"), "").expect("a file");
    assert_eq!(refused(with("").grant_write(folder.path().join("plain"))), "E0701");
}

#[test]
fn a_pending_file_appears_when_it_is_committed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("log.txt");
    std::fs::write(&path, "old\n").expect("a file");
    let fil = "DMY=FILEF(1,WRITE,'log.txt')\nWRITE/1,'new'";
    let post = with(fil).grant_write(folder.path()).build().expect("a post");
    let (report, pending) = post.start().run_pending(Cursor::new(PART), Vec::new()).expect("a run");
    assert_eq!(report.script_files, [path.canonicalize().expect("the file")]);
    assert_eq!(read(&path), "old\n");
    drop(pending);
    assert_eq!((read(&path).as_str(), names(folder.path()).len()), ("old\n", 1));
    let (_, pending) = post.start().run_pending(Cursor::new(PART), Vec::new()).expect("a run");
    pending.commit().expect("written");
    assert_eq!((read(&path).as_str(), names(folder.path()).len()), ("new\n", 1));
}

#[test]
fn an_error_after_the_last_write_leaves_the_folder_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("old.txt"), "old\n").expect("a file");
    let fil = "DMY=FILEF(1,APPEND,'old.txt')\nWRITE/1,'new'\nDMY=FILEF(1,CLOSE)\n\
               DMY=FILEF(1,DELETE,'old.txt')\nDMY=FILEF(1,WRITE,'new.txt')\nZZ=0\nVV=1/ZZ";
    assert_eq!(refused(with(fil).grant_write(folder.path())), "E0301");
    assert_eq!(names(folder.path()), ["old.txt"]);
    assert_eq!(read(folder.path().join("old.txt")), "old\n");
}

#[test]
fn files_are_deleted_and_continued_when_the_run_went_well() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("gone.txt"), "old").expect("a file");
    std::fs::write(folder.path().join("kept.txt"), "old").expect("a file");
    let fil = "DMY=FILEF(1,DELETE,'gone.txt')\nDMY=FILEF(2,APPEND,'kept.txt')\nWRITE/2,'new'";
    post(with(fil).grant_write(folder.path())).expect("a run");
    assert_eq!(names(folder.path()), ["kept.txt"]);
    assert_eq!(read(folder.path().join("kept.txt")), "old\nnew\n");
}

#[test]
fn the_blocks_one_by_one_commit_files_at_their_end() {
    let folder = tempfile::tempdir().expect("a folder");
    let fil = "DMY=FILEF(1,WRITE,'a.txt')\nWRITE/1,'new'";
    let post = with(fil).grant_write(folder.path()).build().expect("a post");
    let blocks = post.blocks(PART.as_bytes());
    drop(blocks);
    assert!(names(folder.path()).is_empty(), "the run was given up");
    assert!(post.blocks(PART.as_bytes()).all(|block| block.is_ok()));
    assert_eq!(names(folder.path()), ["a.txt"]);
}

#[test]
fn no_name_leads_out_of_the_folder() {
    let outer = tempfile::tempdir().expect("a folder");
    let folder = outer.path().join("granted");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::create_dir(folder.join("sub")).expect("a folder");
    std::fs::write(outer.path().join("secret.txt"), "secret\n").expect("a file");
    for name in
        ["../secret.txt", "..\\secret.txt", "sub/../../secret.txt", "/etc/hostname", "", ".", ".."]
    {
        for op in ["READ", "WRITE", "APPEND", "DELETE"] {
            let fil = format!("DMY=FILEF(1,{op},'{name}')");
            let builder = with(&fil).grant_read(&folder).grant_write(&folder);
            assert_eq!(refused(builder), "E0706", "{op} {name}");
        }
    }
    let fil = "DMY=FILEF(1,WRITE,'sub\\a.txt')\nWRITE/1,'A'";
    post(with(fil).grant_write(&folder)).expect("below the folder");
    assert_eq!(names(&folder.join("sub")), ["a.txt"]);
    assert_eq!(read(outer.path().join("secret.txt")), "secret\n");
}

#[test]
fn no_file_has_a_name_that_windows_keeps_for_itself() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("sub")).expect("a folder");
    for name in ["NUL", "nul.txt", "COM1.NC", "sub/con.nc", "sub\\AUX", "a.", "a ", "a?b", "a|b"] {
        for op in ["READ", "WRITE", "APPEND", "DELETE"] {
            let fil = format!("DMY=FILEF(1,{op},'{name}')");
            let builder = with(&fil).grant_read(folder.path()).grant_write(folder.path());
            assert_eq!(refused(builder), "E0720", "{op} {name}");
        }
    }
    assert_eq!(names(folder.path()), ["sub"]);
}

#[test]
fn capital_letters_make_no_other_file() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::write(folder.path().join("Tools.txt"), "10\n").expect("a file");
    let granted = |fil: &str| with(fil).grant_read(folder.path()).grant_write(folder.path());
    let reads = "DMY=FILEF(1,READ,'TOOLS.TXT')\nT1=TEXT/READ,1\nPPRINT/T1";
    assert!(post(granted(reads)).expect("a run").contains("(10)"));
    post(granted("DMY=FILEF(1,WRITE,'tools.TXT')\nWRITE/1,'20'")).expect("a run");
    assert_eq!(names(folder.path()), ["Tools.txt"]);
    assert_eq!(read(folder.path().join("Tools.txt")), "20\n");
    // What the run itself has written, and what it has open.
    let back = "DMY=FILEF(1,WRITE,'New.txt')\nWRITE/1,'30'\nDMY=FILEF(1,CLOSE)\n\
                DMY=FILEF(2,READ,'NEW.TXT')\nT1=TEXT/READ,2\nPPRINT/T1";
    assert!(post(granted(back)).expect("a run").contains("(30)"));
    assert_eq!(names(folder.path()), ["New.txt", "Tools.txt"]);
    let twice = "DMY=FILEF(1,WRITE,'Log.txt')\nDMY=FILEF(2,WRITE,'LOG.TXT')";
    assert_eq!(refused(granted(twice)), "E0324");
    post(granted("DMY=FILEF(1,DELETE,'NEW.txt')")).expect("a run");
    assert_eq!(names(folder.path()), ["Tools.txt"]);
}

#[cfg(target_os = "linux")]
#[test]
fn two_files_that_differ_by_capital_letters_leave_the_choice_open() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in ["a.txt", "A.txt"] {
        std::fs::write(folder.path().join(name), format!("{name}\n")).expect("a file");
    }
    let read = |name: &str| {
        let fil = format!("DMY=FILEF(1,READ,'{name}')\nT1=TEXT/READ,1\nPPRINT/T1");
        with(&fil).grant_read(folder.path())
    };
    assert_eq!(refused(read("a.TXT")), "E0720");
    assert!(post(read("a.txt")).expect("a run").contains("(a.txt)"));
}

/// A folder that is changed for a link while the run is under way.
#[cfg(unix)]
#[test]
fn no_link_put_in_under_way_leads_out_of_the_folder() {
    let outer = tempfile::tempdir().expect("a folder");
    let (granted, elsewhere) = (outer.path().join("granted"), outer.path().join("elsewhere"));
    std::fs::create_dir_all(granted.join("sub")).expect("a folder");
    std::fs::create_dir(&elsewhere).expect("a folder");
    std::fs::write(elsewhere.join("kept.txt"), "kept\n").expect("a file");
    let swap = || {
        std::fs::rename(granted.join("sub"), granted.join("was")).expect("moved");
        std::os::unix::fs::symlink(&elsewhere, granted.join("sub")).expect("a link");
    };
    let back = || {
        std::fs::remove_file(granted.join("sub")).expect("the link");
        std::fs::rename(granted.join("was"), granted.join("sub")).expect("moved");
    };
    for op in
        ["DMY=FILEF(1,WRITE,'sub/kept.txt')\nWRITE/1,'new'", "DMY=FILEF(1,DELETE,'sub/kept.txt')"]
    {
        std::fs::write(granted.join("sub/kept.txt"), "inside\n").expect("a file");
        let post = with(op).grant_write(&granted).build().expect("a post");
        let run = post.start().run_pending(Cursor::new(PART), Vec::new());
        let (_, pending) = run.expect("a run");
        swap();
        let error = pending.commit().expect_err("the folder is a link now");
        assert_eq!(error.diags()[0].code.name(), "E0702");
        assert_eq!(read(elsewhere.join("kept.txt")), "kept\n");
        assert_eq!(names(&elsewhere), ["kept.txt"]);
        back();
    }
    // Before the run, but after the folder was granted.
    let reads = "DMY=FILEF(1,READ,'sub/kept.txt')\nT1=TEXT/READ,1\nPPRINT/T1";
    let post = with(reads).grant_read(&granted).build().expect("a post");
    swap();
    let error = post.stream(PART.as_bytes(), Vec::new()).expect_err("a link that leads out");
    assert_eq!(error.diags()[0].code.name(), "E0706");
}

/// Another process changes the folder for a link and back all the time.
#[cfg(unix)]
#[test]
fn no_race_for_a_link_leads_out_of_the_folder() {
    use std::sync::atomic::{AtomicBool, Ordering};
    let outer = tempfile::tempdir().expect("a folder");
    let (granted, elsewhere) = (outer.path().join("granted"), outer.path().join("elsewhere"));
    let (sub, was) = (granted.join("sub"), granted.join("was"));
    std::fs::create_dir_all(&sub).expect("a folder");
    std::fs::create_dir(&elsewhere).expect("a folder");
    for folder in [&sub, &elsewhere] {
        for name in ["read.txt", "kept.txt", "gone.txt"] {
            let secret = if folder == &sub { "inside\n" } else { "secret\n" };
            std::fs::write(folder.join(name), secret).expect("a file");
        }
    }
    let fil = "DMY=FILEF(1,READ,'sub/read.txt')\nT1=TEXT/READ,1\nPPRINT/T1\nDMY=FILEF(1,CLOSE)\n\
               DMY=FILEF(1,WRITE,'sub/kept.txt')\nWRITE/1,'inside'\nDMY=FILEF(1,CLOSE)\n\
               DMY=FILEF(1,DELETE,'sub/gone.txt')\nDMY=FILEF(1,WRITE,'sub/new.txt')\nWRITE/1,'new'";
    let post = with(fil).grant_read(&granted).grant_write(&granted).build().expect("a post");
    let over = AtomicBool::new(false);
    let mut ends = [0, 0];
    std::thread::scope(|scope| {
        scope.spawn(|| {
            // Now at once, now after a run may have gone well.
            for pause in (0..8).map(|pause| std::time::Duration::from_micros(pause * 200)).cycle() {
                if over.load(Ordering::Relaxed) {
                    return;
                }
                std::thread::sleep(pause);
                let swapped = std::fs::rename(&sub, &was).is_ok()
                    && std::os::unix::fs::symlink(&elsewhere, &sub).is_ok();
                std::thread::yield_now();
                if swapped && std::fs::remove_file(&sub).is_ok() {
                    let _ = std::fs::rename(&was, &sub);
                }
            }
        });
        for _ in 0..2000 {
            let mut nc = Vec::new();
            let ended = post.stream(PART.as_bytes(), &mut nc);
            assert!(!String::from_utf8_lossy(&nc).contains("secret"), "a file from outside");
            ends[usize::from(ended.is_err())] += 1;
        }
        over.store(true, Ordering::Relaxed);
    });
    assert_eq!(names(&elsewhere), ["gone.txt", "kept.txt", "read.txt"]);
    for name in names(&elsewhere) {
        assert_eq!(read(elsewhere.join(name)), "secret\n");
    }
    assert!(ends.iter().all(|count| *count > 0), "the race was none: {ends:?}");
}

/// A program never takes the place of what its run reads.
#[test]
fn a_run_of_files_does_not_write_over_its_input() {
    let folder = tempfile::tempdir().expect("a folder");
    let part = folder.path().join("part.ncl");
    std::fs::write(&part, PART).expect("a file");
    std::fs::write(folder.path().join("tools.txt"), "10\n").expect("a file");
    let fil = "DMY=FILEF(1,READ,'tools.txt')";
    let post = with(fil).grant_read(folder.path()).build().expect("a post");
    for output in ["part.ncl", "./part.ncl", "tools.txt"] {
        let error = post.post_files(&part, &folder.path().join(output)).expect_err("refused");
        assert_eq!(error.diags()[0].code.name(), "E0702", "{output}");
    }
    assert_eq!(names(folder.path()), ["part.ncl", "tools.txt"]);
    assert_eq!(
        (read(&part).as_str(), read(folder.path().join("tools.txt")).as_str()),
        (PART, "10\n")
    );
}

#[test]
fn a_script_does_not_write_over_the_files_of_its_run() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("part.ncl"), PART).expect("a file");
    for name in ["part.ncl", "part.nc"] {
        let fil = format!("DMY=FILEF(1,WRITE,'{name}')\nWRITE/1,'new'");
        let post = with(&fil).grant_write(folder.path()).build().expect("a post");
        let error = post.post_files(&at("part.ncl"), &at("part.nc")).expect_err("refused");
        assert_eq!(error.diags()[0].code.name(), "E0702");
        assert_eq!(names(folder.path()), ["part.ncl"]);
        assert_eq!(read(at("part.ncl")), PART);
    }
}

#[cfg(unix)]
#[test]
fn no_link_leads_out_of_the_folder() {
    use std::os::unix::fs::symlink;
    let outer = tempfile::tempdir().expect("a folder");
    let folder = outer.path().join("granted");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::write(outer.path().join("secret.txt"), "secret\n").expect("a file");
    std::fs::write(folder.join("real.txt"), "real\n").expect("a file");
    symlink("../secret.txt", folder.join("out.txt")).expect("a link");
    symlink("../absent.txt", folder.join("dangling.txt")).expect("a link");
    symlink("..", folder.join("up")).expect("a link");
    symlink("real.txt", folder.join("in.txt")).expect("a link");
    for name in ["out.txt", "dangling.txt", "up/secret.txt", "up/new.txt"] {
        for op in ["READ", "WRITE", "APPEND", "DELETE"] {
            let fil = format!("DMY=FILEF(1,{op},'{name}')");
            let builder = with(&fil).grant_read(&folder).grant_write(&folder);
            assert_eq!(refused(builder), "E0706", "{op} {name}");
        }
    }
    let fil = "DMY=FILEF(1,WRITE,'in.txt')\nWRITE/1,'A'";
    post(with(fil).grant_write(&folder)).expect("a link that stays inside");
    assert_eq!(read(folder.join("real.txt")), "A\n");
    assert!(folder.join("in.txt").is_symlink());
    assert_eq!(names(outer.path()), ["granted", "secret.txt"]);
}

#[cfg(unix)]
#[test]
fn only_plain_files_are_read() {
    let folder = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(folder.path().join("sub")).expect("a folder");
    let fil = "DMY=FILEF(1,READ,'sub')";
    assert_eq!(refused(with(fil).grant_read(folder.path())), "E0701");
    let fil = "DMY=FILEF(1,WRITE,'sub')";
    assert_eq!(refused(with(fil).grant_write(folder.path())), "E0702");
}

#[cfg(unix)]
#[test]
fn a_link_does_not_lead_includ_out_of_the_folder() {
    use std::os::unix::fs::symlink;
    let outer = tempfile::tempdir().expect("a folder");
    let folder = outer.path().join("post");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::write(outer.path().join("secret.fil"), "PPRINT/'SECRET'\n").expect("a file");
    std::fs::write(folder.join("lib.fil"), "PPRINT/'LIB'\n").expect("a file");
    symlink("../secret.fil", folder.join("out.fil")).expect("a link");
    let main = folder.join("main.fil");
    let built = |text: &str| {
        std::fs::write(&main, text).expect("a file");
        Program::builder()
            .fil(&main.display().to_string(), text)
            .includes(includes::beside(std::slice::from_ref(&main), None))
    };
    assert!(post(built("INCLUD/lib.fil\nFINI\n")).expect("beside").contains("(LIB)"));
    for name in ["out.fil", "../secret.fil", "/etc/hostname", "none.fil", "C:\\a.fil"] {
        assert_eq!(refused(built(&format!("INCLUD/'{name}'\nFINI\n"))), "E0214", "{name}");
    }
}
