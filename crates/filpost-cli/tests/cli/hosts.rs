//! What a run may do to the files of its host.

use crate::support::{Folder, Ran, SMALL, WRONG};

/// Names in the folder, sorted.
fn names(place: &Folder) -> Vec<String> {
    let entries = std::fs::read_dir(place.0.path()).expect("the folder");
    let name = |entry: std::io::Result<std::fs::DirEntry>| {
        entry.expect("an entry").file_name().to_string_lossy().into_owned()
    };
    let mut names: Vec<String> = entries.map(name).collect();
    names.sort();
    names
}

fn text(place: &Folder, name: &str) -> String {
    std::fs::read_to_string(place.0.path().join(name)).expect("a text")
}

#[test]
fn a_system_without_a_folder_for_temporary_files_does_not_matter() {
    let place = Folder::new().with("part.ncl", SMALL);
    let mut command = place.command(&["post", "part.ncl"]);
    let ran = Ran::of(command.env("TMPDIR", "/no/such/folder").output().expect("the command"));
    assert_eq!((ran.status, ran.out.as_str()), (0, place.run(&["post", "part.ncl"]).out.as_str()));
    assert_eq!(names(&place), ["part.ncl"]);
}

#[test]
fn a_failed_run_leaves_the_old_files() {
    let place = Folder::new().with("part.ncl", SMALL).with("wrong.ncl", WRONG);
    let run = |cl: &str| {
        place.run(&["post", cl, "-o", "o.nc", "--map", "o.map", "--listing", "o.lst"]).status
    };
    assert_eq!(run("part.ncl"), 0);
    let all = ["o.nc", "o.map", "o.lst"];
    let before = all.map(|name| text(&place, name));
    assert!(before.iter().all(|text| !text.is_empty()));
    assert_eq!(run("wrong.ncl"), 1);
    assert_eq!(all.map(|name| text(&place, name)), before);
    assert_eq!(names(&place), ["o.lst", "o.map", "o.nc", "part.ncl", "wrong.ncl"]);
}

#[cfg(target_os = "linux")]
#[test]
fn files_appear_with_a_stream_or_not_at_all() {
    let fil = "DMY=FILEF(1,WRITE,'log.txt')\nWRITE/1,'new'\nFINI\n";
    let place = Folder::new().with("part.ncl", SMALL).with("w.fil", fil);
    let run = |output: &str| {
        let grant = ["--grant", "write=.", "-f", "w.fil"];
        let results = ["-o", output, "--map", "o.map", "--listing", "o.lst"];
        place.run(&[&["post", "part.ncl"][..], &grant, &results].concat())
    };
    let full = run("/dev/full");
    assert!(full.status == 1 && full.err.contains("E0702"), "{full:?}");
    assert_eq!(names(&place), ["part.ncl", "w.fil"]);
    assert_eq!(run("/dev/null").status, 0);
    assert_eq!(names(&place), ["log.txt", "o.lst", "o.map", "part.ncl", "w.fil"]);
}

#[test]
fn no_script_writes_over_a_file_of_its_run() {
    let place = Folder::new()
        .with("part.ncl", SMALL)
        .with("machine.toml", "name = \"M\"\n")
        .with("o.nc", "old\n");
    for name in ["part.ncl", "machine.toml", "o.nc", "w.fil", "o.map"] {
        let fil = format!("DMY=FILEF(1,WRITE,'{name}')\nWRITE/1,'new'\nFINI\n");
        std::fs::write(place.0.path().join("w.fil"), &fil).expect("a file");
        let ran = place.run(&[
            "post",
            "part.ncl",
            "-m",
            "machine.toml",
            "-f",
            "w.fil",
            "-o",
            "o.nc",
            "--map",
            "o.map",
            "--grant",
            "write=.",
        ]);
        assert!(ran.status == 1 && ran.err.contains("E0802"), "{name}: {ran:?}");
        assert_eq!((text(&place, "part.ncl"), text(&place, "w.fil")), (SMALL.to_string(), fil));
        assert_eq!(text(&place, "o.nc"), "old\n");
        assert_eq!(names(&place), ["machine.toml", "o.nc", "part.ncl", "w.fil"]);
    }
}

#[test]
fn no_command_writes_over_its_input() {
    let place = Folder::new()
        .with("u", "1 3 4\n")
        .with("part.ncl", SMALL)
        .with("part.svg", SMALL)
        .with("case/case.toml", "cl = \"part.ncl\"\nexpect = \"o.nc\"\norigin = \"a test\"\n")
        .with("case/part.ncl", SMALL);
    for arguments in [
        &["machine", "import", "u", "-o", "u"][..],
        &["plot", "part.svg", "-o", "part.svg"],
        &["plot", "part.svg", "-o", "./case/../part.svg"],
        &["cl", "part.ncl", "--to", "ncl", "-o", "part.ncl"],
        &["test", "case", "--html", "case/part.ncl"],
        &["test", "case", "--junit", "case/case.toml"],
    ] {
        let ran = place.run(arguments);
        assert!(ran.status == 1 && ran.err.contains("E0802"), "{arguments:?}: {ran:?}");
    }
    assert_eq!(text(&place, "u"), "1 3 4\n");
    assert_eq!(text(&place, "part.svg"), SMALL);
    assert_eq!(text(&place, "case/part.ncl"), SMALL);
}

/// A post with FIL that another file includes, and that reads a file.
fn reading() -> Folder {
    let case = "cl = \"part.ncl\"\nfil = [\"../post.fil\"]\nread = \"data\"\nexpect = \"o.nc\"\n\
                origin = \"a test\"\n";
    let fil = "INCLUD/lib.fil\nDMY=FILEF(1,READ,'tools.txt')\nT1=TEXT/READ,1\nPPRINT/T1\nFINI\n";
    Folder::new()
        .with("part.ncl", SMALL)
        .with("m.svg", "name = \"M\"\n")
        .with("n.nc", "G21 G90 G94\nG0 X1. Y2. Z3.\nM30\n")
        .with("post.fil", fil)
        .with("lib.fil", "XX=1\n")
        .with("tools.txt", "10\n")
        .with("case/case.toml", case)
        .with("case/part.ncl", SMALL)
        .with("case/data/tools.txt", "10\n")
}

/// Each file with its text.
fn texts(place: &Folder) -> Vec<(std::path::PathBuf, String)> {
    let mut folders = vec![place.0.path().to_path_buf()];
    let mut texts = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                // A link to a folder may lead back.
                folders.extend((!path.is_symlink()).then_some(path));
            } else {
                texts.push((path.clone(), std::fs::read_to_string(&path).expect("a text")));
            }
        }
    }
    texts.sort();
    texts
}

#[test]
fn what_fil_includes_and_reads_is_an_input() {
    let place = reading();
    let before = texts(&place);
    for name in ["lib.fil", "case/../lib.fil", "tools.txt"] {
        let profile = format!("--profile={name}");
        for option in [&["-o", name][..], &["--listing", name], &["--map", name], &[&profile]] {
            let post = ["post", "part.ncl", "-f", "post.fil", "--grant", "read=."];
            let ran = place.run(&[&post[..], option].concat());
            assert!(ran.status == 1 && ran.err.contains("E0802"), "{option:?}: {ran:?}");
        }
    }
    for name in ["lib.fil", "case/data/tools.txt"] {
        for report in ["--html", "--junit", "--lcov", "--coverage-html"] {
            let ran = place.run(&["test", "case", "--coverage", report, name]);
            assert!(ran.status == 1 && ran.err.contains("E0802"), "{report} {name}: {ran:?}");
        }
    }
    let ran = place.run(&["plot", "n.nc", "-m", "m.svg", "-o", "m.svg"]);
    assert!(ran.status == 1 && ran.err.contains("E0802"), "{ran:?}");
    assert_eq!(texts(&place), before);
}

#[test]
fn an_expected_file_is_never_what_a_case_reads() {
    let case = |expect: &str| {
        let toml = format!(
            "cl = \"part.ncl\"\nfil = [\"post.fil\"]\nread = \"data\"\nexpect = \"{expect}\"\n\
             origin = \"a test\"\n"
        );
        let place = reading().with("case/case.toml", toml).with("case/lib.fil", "XX=1\n");
        let fil = text(&place, "post.fil");
        let inner = "cl = \"part.ncl\"\nexpect = \"o.nc\"\norigin = \"a test\"\n";
        let place = place.with("case/post.fil", fil).with("case/b/part.ncl", SMALL);
        #[cfg(unix)]
        {
            let link = |to, name| std::os::unix::fs::symlink(to, place.0.path().join(name));
            link("part.ncl", "case/link.nc").expect("a link");
            link(".", "case/sub").expect("a link");
        }
        place.with("case/b/case.toml", inner).with("case/b/o.nc", "old\n")
    };
    let own = ["lib.fil", "data/tools.txt", "PART.ncl", "Case.TOML", "link.nc", "sub/part.ncl"];
    for (name, code) in own
        .map(|name| (name, "E0705"))
        .into_iter()
        .chain([("b/part.ncl", "E0802"), ("b/case.toml", "E0802")])
        .filter(|(name, _)| cfg!(unix) || !name.starts_with(['l', 's']))
    {
        let place = case(name);
        let before = texts(&place);
        let ran = place.run(&["test", "case", "--update"]);
        let told = format!("{}{}", ran.out, ran.err);
        assert!(ran.status == 1 && told.contains(code), "{name}: {ran:?}");
        let kept = texts(&place);
        let changed = before.iter().zip(&kept).filter(|(one, other)| one != other);
        let changed: Vec<_> = changed.map(|(one, _)| &one.0).collect();
        assert!(changed.iter().all(|path| path.ends_with("case/b/o.nc")), "{name}: {changed:?}");
    }
}

#[cfg(unix)]
#[test]
fn a_file_in_place_of_a_standard_stream_is_an_input_too() {
    let place = Folder::new().with("part.ncl", SMALL).with("u.p01", "INTCOM:\n1 3 4\n");
    let filpost = env!("CARGO_BIN_EXE_filpost");
    for line in [
        "post - -o part.ncl < part.ncl",
        "post - -o /dev/stdin < part.ncl",
        "post part.ncl >> part.ncl",
        "post - < part.ncl >> part.ncl",
        "cl - --to ncl -o part.ncl < part.ncl",
        "cl part.ncl --to ncl >> part.ncl",
        "plot part.ncl >> part.ncl",
    ] {
        let mut shell = std::process::Command::new("sh");
        shell.args(["-c", &format!("'{filpost}' {line}")]).current_dir(place.0.path());
        let ran = crate::support::Ran::of(shell.output().expect("sh"));
        assert!(ran.status == 1 && ran.err.contains("E0802"), "{line}: {ran:?}");
        assert_eq!(text(&place, "part.ncl"), SMALL, "{line}");
    }
}

#[test]
fn no_script_writes_over_a_file_of_another_run() {
    let place = Folder::new().with("a.ncl", SMALL).with("b.ncl", SMALL);
    for name in ["b.ncl", "b.nc", "out/a.nc"] {
        let fil = format!("DMY=FILEF(1,WRITE,'{name}')\nWRITE/1,'new'\nFINI\n");
        std::fs::create_dir_all(place.0.path().join("out")).expect("a folder");
        std::fs::write(place.0.path().join("w.fil"), fil).expect("a file");
        let output = if name.starts_with("out") { "out" } else { "." };
        let posted = ["post", "a.ncl", "b.ncl", "-f", "w.fil", "-o", output];
        let ran = place.run(&[&posted[..], &["--grant", "write=."]].concat());
        assert!(ran.status == 1 && ran.err.contains("E0802"), "{name}: {ran:?}");
        assert_eq!(names(&place), ["a.ncl", "b.ncl", "out", "w.fil"]);
        assert_eq!(text(&place, "b.ncl"), SMALL);
    }
}

#[test]
fn reports_and_pictures_appear_with_the_rest() {
    let place = reading();
    for arguments in [
        &["post", "part.ncl", "-o", "x.nc", "--map", "--profile=none/p.svg"][..],
        &["test", "case", "--junit", "j.xml", "--html", "none/h.html"],
        &["test", "case", "--html", "h.html", "--junit", "none/j.xml"],
    ] {
        let before = texts(&place);
        let ran = place.run(arguments);
        assert!(ran.status == 1 && ran.err.contains("E0702"), "{arguments:?}: {ran:?}");
        assert_eq!(texts(&place), before, "{arguments:?}");
    }
}

#[test]
fn expected_files_stay_in_the_folder_of_their_case() {
    let place = Folder::new().with("case/part.ncl", SMALL).with("kept", "kept\n");
    let update = |names: &str| {
        let toml = format!("cl = \"part.ncl\"\n{names}origin = \"a test\"\n");
        std::fs::write(place.0.path().join("case/case.toml"), toml).expect("a file");
        place.run(&["test", "case", "--update"])
    };
    let outside = place.0.path().join("kept").display().to_string().replace('\\', "/");
    for names in [
        "expect = \"../kept\"\n",
        &format!("expect = \"{outside}\"\n"),
        "expect = \"o.nc\"\nlisting = \"./../kept\"\n",
        "expect = \"part.ncl\"\n",
        "expect = \"./case.toml\"\n",
        "expect = \"o\"\nlisting = \"./o\"\n",
    ] {
        let ran = update(names);
        assert!(ran.status == 1 && ran.err.contains("E0705"), "{names}: {ran:?}");
    }
    assert_eq!(text(&place, "kept"), "kept\n");
    assert_eq!(update("expect = \"./o.nc\"\n").status, 0);
    assert!(text(&place, "case/o.nc").contains('G'));
}

#[cfg(unix)]
#[test]
fn no_link_leads_an_expected_file_out_of_its_case() {
    let toml = "cl = \"part.ncl\"\nexpect = \"o.nc\"\norigin = \"a test\"\n";
    let place = Folder::new()
        .with("case/part.ncl", SMALL)
        .with("case/case.toml", toml)
        .with("kept", "kept\n");
    std::os::unix::fs::symlink("../kept", place.0.path().join("case/o.nc")).expect("a link");
    let ran = place.run(&["test", "case", "--update"]);
    assert!(ran.status == 1 && ran.err.contains("E0702"), "{ran:?}");
    assert_eq!(text(&place, "kept"), "kept\n");
}

#[cfg(unix)]
#[test]
fn new_files_have_the_rights_of_the_umask() {
    use std::os::unix::fs::PermissionsExt;
    for (umask, rights) in [("077", 0o600), ("027", 0o640), ("002", 0o664)] {
        let place = Folder::new().with("part.ncl", SMALL);
        let filpost = env!("CARGO_BIN_EXE_filpost");
        let script =
            format!("umask {umask}; '{filpost}' post part.ncl -o o.nc --map --listing o.l");
        let mut shell = std::process::Command::new("sh");
        let ran = shell.args(["-c", &script]).current_dir(place.0.path()).output().expect("sh");
        assert!(ran.status.success(), "{ran:?}");
        for name in ["o.nc", "o.nc.map", "o.l"] {
            let found = std::fs::metadata(place.0.path().join(name)).expect("a file");
            assert_eq!(found.permissions().mode() & 0o777, rights, "{name} under {umask}");
        }
    }
}

/// A run that is stopped leaves the folder as it was.
#[cfg(unix)]
#[test]
fn a_run_that_is_stopped_leaves_no_file() {
    let fil = "CIMFIL/ON,GOTO\nDO/LAB1,II=1,400000\nBB=II+1\nLAB1)CONTIN\nDMY=POSTF(13)\nCIMFIL/OFF\n\
               FINI\n";
    let points: String = (0..3000).map(|at| format!("GOTO / {at}, 2, 3\n")).collect();
    let cl = format!("UNITS / MM\nRAPID\nGOTO / 1, 2, 3\nFEDRAT / 200, MMPM\n{points}FINI\n");
    let place = Folder::new().with("part.ncl", cl).with("slow.fil", fil).with("o.nc", "old\n");
    for signal in ["-INT", "-TERM"] {
        let arguments = ["post", "part.ncl", "-f", "slow.fil", "-o", "o.nc", "--map"];
        let mut run = place.command(&arguments).spawn().expect("filpost");
        let start = std::time::Instant::now();
        while names(&place).len() < 5 {
            assert!(run.try_wait().expect("a status").is_none(), "it must run for a while");
            assert!(start.elapsed().as_secs() < 60, "no file in the making was seen");
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        let kill =
            std::process::Command::new("kill").args([signal, &run.id().to_string()]).status();
        assert!(kill.expect("kill").success());
        assert_eq!(run.wait().expect("a status").code(), Some(130), "{signal}");
        assert_eq!(names(&place), ["o.nc", "part.ncl", "slow.fil"], "{signal}");
        assert_eq!(text(&place, "o.nc"), "old\n");
    }
}

/// However far a command has come when it is stopped: what was there is there, whole, or what
/// it wrote is, whole, and nothing else.
#[cfg(unix)]
#[test]
fn a_command_that_is_stopped_at_any_moment_leaves_no_file() {
    let points: String = (0..40_000).map(|at| format!("GOTO / {at}, 2, 3\n")).collect();
    let cl = format!("UNITS / MM\nRAPID\nGOTO / 1, 2, 3\nFEDRAT / 200, MMPM\n{points}FINI\n");
    let toml = "cl = \"part.ncl\"\nexpect = \"o.nc\"\norigin = \"a test\"\n";
    let place = Folder::new()
        .with("part.ncl", &cl)
        .with("case/part.ncl", cl)
        .with("case/case.toml", toml)
        .with("case/o.nc", "old\n");
    for arguments in [
        &["post", "part.ncl", "-o", "o.out", "--map=o.map", "--listing", "o.lst"][..],
        &["cl", "part.ncl", "--to", "ncl", "-o", "o.out"],
        &["plot", "part.ncl", "-o", "o.html"],
        &["test", "case", "--update", "--html", "o.html", "--junit", "o.xml"],
        &["new", "own"],
    ] {
        for wait in [0, 1, 2, 5, 10, 20, 40, 80, 160] {
            let mut run = place.command(arguments);
            run.stdout(std::process::Stdio::null()).stderr(std::process::Stdio::null());
            let mut run = run.spawn().expect("filpost");
            std::thread::sleep(std::time::Duration::from_millis(wait));
            let signal = if wait % 2 == 0 { "-TERM" } else { "-INT" };
            let mut kill = std::process::Command::new("kill");
            let _ = kill.args([signal, &run.id().to_string()]).output();
            run.wait().expect("a status");
            for (path, text) in texts(&place) {
                let name = path.file_name().expect("a name").to_string_lossy().into_owned();
                assert!(!name.ends_with(".tmp"), "{arguments:?} after {wait} ms left {name}");
                assert!(!text.is_empty(), "{arguments:?} after {wait} ms left {name} empty");
            }
            let _ = std::fs::remove_dir_all(place.0.path().join("own"));
        }
    }
}
