//! `filpost post`: the choice of the post, its options, what scripts reach.

use std::path::Path;

use crate::support::{Folder, NC, Ran, SMALL};

#[test]
fn the_post_comes_from_machin() {
    let machin = |name: &str| format!("MACHIN / {name}\n{SMALL}");
    let place = Folder::new().with("part.ncl", machin("LINUXCNC-MILL, 1"));
    let ran = place.run(&["post", "part.ncl"]);
    assert!(ran.err.contains("linuxcnc-mill (for MACHIN/LINUXCNC-MILL,1)"), "{ran:?}");
    let ran = place.with("none.ncl", SMALL).run(&["post", "none.ncl"]);
    assert!(ran.err.contains("fanuc-mill (the CL file has no MACHIN)"), "{ran:?}");
    assert!(ran.err.contains(" mm (UNITS), "), "{ran:?}");
}

#[test]
fn a_machin_that_names_no_post_is_refused_unless_one_is_named() {
    let turned = SMALL.replace("1, 2, 3", "1, 0, 3");
    let place = Folder::new().with("lathe.ncl", format!("MACHIN / UNCL01, 3\n{turned}"));
    let post = ["post", "lathe.ncl", "-o", "out.nc"];
    let refused = place.run(&post);
    assert_eq!(refused.status, 1, "{refused:?}");
    for said in ["E0714", "MACHIN/UNCL01,3", "UNCL01.p03 in the current folder", "fanuc-lathe"] {
        assert!(refused.err.contains(said), "{said}: {}", refused.err);
    }
    assert_eq!(place.files(), ["lathe.ncl"]);
    for command in
        [&["verify", "lathe.ncl", "lathe.ncl"][..], &["post", "lathe.ncl", "-f", "x.fil"]]
    {
        let ran = place.run(command);
        assert!(ran.status == 1 && ran.err.contains("E0714"), "{ran:?}");
    }
    let named = place.run(&[&post[..], &["-p", "fanuc-lathe"]].concat());
    assert_eq!(named.status, 0, "{named:?}");
}

#[test]
fn a_file_without_machin_that_turns_takes_the_generic_lathe() {
    let cl = SMALL.replace("1, 2, 3", "1, 0, 3").replace("LOADTL / 1", "TURRET / 1");
    let place = Folder::new().with("turned.ncl", cl);
    let ran = place.run(&["post", "turned.ncl"]);
    let title = "fanuc-lathe (the CL file has no MACHIN; TURRET says turning)";
    assert!(ran.err.contains(title), "{ran:?}");
}

#[test]
fn a_file_without_units_needs_them_said() {
    let unitless = SMALL.replace("UNITS / MM\n", "");
    let place =
        Folder::new().with("part.ncl", &unitless).with("inch.ncl", SMALL.replace("MM", "INCHES"));
    let post = |more: &[&str]| place.run(&[&["post", "part.ncl", "-o", "out.nc"], more].concat());
    let refused = post(&[]);
    assert!(refused.status == 1 && refused.err.contains("E0514"), "{refused:?}");
    assert!(refused.err.contains("--units"), "{}", refused.err);
    assert_eq!(place.text("out.nc"), None);
    let mm = post(&["--units", "mm"]);
    assert!(mm.status == 0 && mm.err.contains(" mm (--units), "), "{mm:?}");
    assert_eq!(place.text("out.nc").as_deref(), Some(NC));
    let inch = post(&["--units", "inch"]);
    assert!(inch.status == 0 && inch.err.contains(" inch (--units), "), "{inch:?}");
    assert!(place.text("out.nc").is_some_and(|nc| nc.contains("G20")));
    let machine = post(&["--set", "units.mode=1"]);
    assert!(machine.status == 0 && machine.err.contains(" inch (units.mode), "), "{machine:?}");
    assert_eq!(post(&["--units", "furlong"]).status, 2);
    let both = place.run(&["post", "inch.ncl", "--units", "mm"]);
    assert!(both.status == 1 && both.err.contains("E0715"), "{both:?}");
    let machine = post(&["--set", "units.mode=1", "--units", "mm"]);
    assert!(machine.status == 1 && machine.err.contains("E0715"), "{machine:?}");
    assert_eq!(post(&["--units", "mm"]).status, 0);
    let verify = |more: &[&str]| place.run(&[&["verify", "part.ncl", "out.nc"], more].concat());
    let open = verify(&[]);
    assert!(open.status == 1 && open.err.contains("E0940"), "{open:?}");
    assert_eq!(verify(&["--units", "mm"]).status, 0);
    assert_eq!(verify(&["--units", "inch"]).status, 1);
    let plot = place.run(&["plot", "part.ncl"]);
    assert!(plot.status == 1 && plot.err.contains("E0940"), "{plot:?}");
    assert_eq!(place.run(&["plot", "part.ncl", "--units", "mm"]).status, 0);
    let unit = |more: &[&str]| place.run(&[&["cl", "part.ncl"], more].concat()).out;
    assert!(unit(&[]).contains("unit  not said"), "{}", unit(&[]));
    assert!(unit(&["--units", "inch"]).contains("unit  inch (--units)"));
    assert!(place.run(&["cl", "inch.ncl"]).out.contains("unit  inch (UNITS)"));
}

#[test]
fn an_option_file_is_found_with_its_fil() {
    let option_file =
        "OPTION FILE\nMINE\n INTCOM:(LOCATION,VALUE)\n   0      0\n RELCOM:\n 0\n DBLCOM:\n 0\n";
    let fil = "CIMFIL/ON,SPINDL\nDMY=POSTF(13)\nPOSTN/OUT,M,8\nCIMFIL/OFF\nFINI\n";
    let cl = format!("MACHIN / MYPOST, 2\n{SMALL}");
    let place = Folder::new().with("part.ncl", cl);
    let folder = place.0.path().join("posts");
    std::fs::create_dir(&folder).expect("a folder");
    std::fs::write(folder.join("mypost.p02"), option_file).expect("a file");
    std::fs::write(folder.join("MYPOST.F02"), fil).expect("a file");
    let ran = place.run(&["post", "part.ncl", "--post-path", "posts"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    assert!(ran.err.contains("mypost.p02 with "), "{}", ran.err);
    let flood = |ran: &Ran| ran.out.contains("M8") || ran.out.contains("M08");
    assert!(flood(&ran), "{}", ran.out);
    let named = place.run(&["post", "part.ncl", "-m", "posts/mypost.p02"]);
    assert!(named.err.contains("posts/mypost.p02 with posts/MYPOST.F02:"), "{named:?}");
    assert_eq!(named.out, ran.out);
    let other = "CIMFIL/ON,SPINDL\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let place = place.with("other.fil", other);
    for chosen in [["-m", "posts/mypost.p02"], ["--post-path", "posts"]] {
        let ran = place.run(&[&["post", "part.ncl", "-f", "other.fil"], &chosen[..]].concat());
        assert!(!flood(&ran), "{}", ran.out);
        let note = "MYPOST.F02 is not used: -f names the FIL files";
        assert!(ran.status == 0 && ran.err.contains(note), "{ran:?}");
    }
    let same = ["post", "part.ncl", "-m", "posts/mypost.p02", "-f", "posts/MYPOST.F02"];
    let same = place.run(&same);
    assert!(flood(&same) && !same.err.contains("is not used"), "{same:?}");
}

#[test]
fn a_post_folder_and_settings_on_top() {
    let place = Folder::new().with("part.ncl", SMALL);
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
    let place = Folder::new().with("part.ncl", SMALL);
    let ran = place.run(&["post", "part.ncl", "--listing", "part.lst"]);
    assert_eq!(ran.out, NC);
    let listing = place.text("part.lst").expect("a listing");
    assert!(listing.contains("SPINDL / RPM") && listing.contains("N30 S900 M3"), "{listing}");
}

#[test]
fn the_time_stamp_is_the_moment_that_is_granted() {
    let place = Folder::new().with("part.ncl", SMALL);
    let stamped = ["post", "part.ncl", "--set", "program.time_stamp=1"];
    let refused = place.run(&stamped);
    assert!(refused.status == 1 && refused.err.contains("E0322"), "{refused:?}");
    let ran = place.run(&[&stamped[..], &["--set-clock", "2026-01-31T12:05:09"]].concat());
    assert_eq!(ran.out, NC.replace("(7)\n", "(7)\n(2026-01-31 12:05:09)\n"));
}

#[test]
fn a_message_goes_to_the_tape_or_to_the_listing() {
    let fil = "CIMFIL/ON,SPINDL\nPPRINT/'ON TAPE'\nDMY=POSTF(2,1,484,0)\nPPRINT/'  IN LISTING'\n\
               DMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let place = Folder::new().with("part.ncl", SMALL).with("post.fil", fil);
    let ran = place.run(&["post", "part.ncl", "-f", "post.fil", "--listing", "part.lst"]);
    assert!(ran.out.contains("(ON TAPE)") && !ran.out.contains("IN LISTING"), "{}", ran.out);
    let listing = place.text("part.lst").expect("a listing");
    let lines: Vec<&str> = listing.lines().filter(|line| line.contains("IN LISTING")).collect();
    assert_eq!(lines, ["                   IN LISTING"]);
}

#[test]
fn the_same_warning_is_shown_once() {
    let fil = "CIMFIL/ON,SPINDL\nAA=ZZ\nBB=ZZ\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let place = Folder::new().with("part.ncl", SMALL).with("post.fil", fil);
    let ran = place.run(&["post", "part.ncl", "-f", "post.fil"]);
    assert_eq!(ran.err.matches("ZZ was never set").count(), 1, "{}", ran.err);
    assert!(ran.err.contains("this warning came 2 times"), "{}", ran.err);
    assert!(ran.err.contains("2 warnings"), "{}", ran.err);
}

#[test]
fn a_script_reaches_files_and_a_clock_only_when_granted() {
    let fil = "DMY=FILEF(1,READ,'tools.txt')\nT1=TEXT/READ,1\nDMY=FILEF(1,CLOSE)\n\
               DMY=FILEF(1,WRITE,'log.txt')\nWRITE/1,T1,' ',DATEF()\nFINI\n";
    let place = Folder::new().with("part.ncl", SMALL).with("log.fil", fil);
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
    let place = Folder::new().with("part.ncl", SMALL.replace("FINI\n", "")).with("log.fil", fil);
    let post = ["post", "part.ncl", "-f", "log.fil", "-o", "part.tap", "--grant", "write=."];
    let denied = place.run(&[&post[..], &["--deny-warnings"]].concat());
    assert!(denied.status == 1 && denied.err.contains("E0801"), "{denied:?}");
    assert_eq!(place.files(), ["log.fil", "part.ncl"]);
    assert_eq!(place.run(&post).status, 0);
    assert_eq!(place.files(), ["log.fil", "log.txt", "part.ncl", "part.tap"]);
}

#[test]
fn includ_counts_from_the_including_file() {
    let place = Folder::new().with("part.ncl", SMALL);
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
    let place = Folder::new();
    let ran =
        place.run(&["post", &cl.display().to_string(), "-p", "fanuc-mill", "-o", "op010.tap"]);
    assert_eq!(ran.status, 0, "{ran:?}");
    let nc = place.text("op010.tap").expect("the program");
    assert!(nc.contains("G20") && nc.contains("S1000 M3"), "{nc}");
}

/// The post is chosen before the run, from the first records.
#[test]
fn a_late_or_second_machin_is_refused() {
    let motions = "GOTO / 1, 2, 3\nGOTO / 4, 5, 6\n".repeat(200);
    let head = "UNITS / MM\nFEDRAT / 100, MMPM\n";
    let late = format!("{head}{motions}MACHIN / GRBL, 1\nFINI\n");
    let second = format!("MACHIN / FANUC-MILL, 1\n{head}GOTO / 1, 2, 3\nMACHIN / GRBL, 1\nFINI\n");
    let twice = second.replace("GRBL", "FANUC-MILL");
    let place = Folder::new().with("late.ncl", &late).with("second.ncl", &second);
    let place = place.with("twice.ncl", &twice);
    for (cl, at) in [("late.ncl", "late.ncl:403"), ("second.ncl", "second.ncl:5")] {
        let ran = place.run(&["post", cl, "-o", "out.nc"]);
        assert!(ran.status == 1 && ran.err.contains("E0714") && ran.err.contains(at), "{ran:?}");
        assert!(place.text("out.nc").is_none());
        let all = ["post", cl, "-o", "out.nc", "--map", "out.map", "--listing", "out.lst"];
        assert!(place.run(&all).err.contains("E0714"));
        assert!(["out.nc", "out.map", "out.lst"].iter().all(|file| place.text(file).is_none()));
        assert_eq!(place.run(&["post", cl, "-p", "fanuc-mill", "-o", "chosen.nc"]).status, 0);
        for other in [["verify", cl, "chosen.nc"], ["plot", "chosen.nc", &format!("--cl={cl}")]] {
            let ran = place.run(&other);
            assert!(
                ran.status == 1 && ran.err.contains("E0714") && ran.err.contains(at),
                "{ran:?}"
            );
            let chosen = place.run(&[&other[..], &["-p", "fanuc-mill"]].concat());
            assert_eq!(chosen.status, 0, "{chosen:?}");
        }
    }
    assert_eq!(place.run(&["post", "twice.ncl", "-o", "out.nc"]).status, 0);
}
