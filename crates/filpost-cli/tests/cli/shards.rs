//! `filpost test --shard`, and the scripts of docs/testing.md that use it.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;

use crate::support::{Folder, NC, SMALL, WRONG};

const CASE: &str = "cl = 'part.ncl'\nready = 'fanuc-mill'\noptions.style = 'plain'\nexpect = 'part.nc'\norigin = 'ours'\n";

/// Ten cases below `corpus`, of which the eighth fails.
fn ten_cases() -> Folder {
    (0..10).fold(Folder::new(), |place, number| {
        let nc = if number == 7 { NC.replace("Z3.", "Z3.5") } else { NC.to_string() };
        let file = |name: &str| format!("corpus/case-{number}/{name}");
        place
            .with(&file("part.ncl"), SMALL)
            .with(&file("case.toml"), CASE)
            .with(&file("part.nc"), nc)
    })
}

#[test]
fn parts_are_together_all_cases() {
    let place = ten_cases();
    let said: Vec<(i32, String)> = (1..=3)
        .map(|part| {
            let ran = place.run(&["test", "--shard", &format!("{part}/3")]);
            let last = ran.out.lines().last().unwrap_or_default().to_string();
            (ran.status, format!("{}, {last}", ran.err.trim()))
        })
        .collect();
    let expected = [
        (0, "part 1 of 3: 4 of 10 cases, 4 passed, 0 failed"),
        (1, "part 2 of 3: 3 of 10 cases, 2 passed, 1 failed"),
        (0, "part 3 of 3: 3 of 10 cases, 3 passed, 0 failed"),
    ];
    assert_eq!(said, expected.map(|(status, text)| (status, text.to_string())));
    let beyond = place.run(&["test", "--shard", "11/12"]);
    assert_eq!((beyond.status, &*beyond.out), (0, "0 passed, 0 failed\n"));
}

#[test]
fn parts_that_there_are_not_are_wrong_usage() {
    let place = ten_cases();
    for wrong in ["0/0", "5/3", "0/3", "1", "1/x", "-1/3"] {
        let ran = place.run(&["test", &format!("--shard={wrong}")]);
        assert!(ran.status == 2 && ran.err.contains("write I/N"), "{wrong}: {}", ran.err);
    }
    let none = Folder::new().run(&["test", "--shard", "1/2"]);
    assert!(none.status == 1 && none.err.contains("E0803"), "{}", none.err);
}

#[test]
fn parts_of_a_folder_are_posted_each_file_once() {
    let place = (0..7).fold(Folder::new(), |place, n| place.with(&format!("cl/{n}.ncl"), SMALL));
    let place = place.with("cl/3.ncl", WRONG);
    let said: Vec<(i32, String)> = (1..=3)
        .map(|part| {
            let output = format!("nc-{part}");
            let shard = format!("{part}/3");
            let ran =
                place.run(&["post", "cl", "-p", "fanuc-mill", "-o", &output, "--shard", &shard]);
            (ran.status, ran.err.lines().next().unwrap_or_default().to_string())
        })
        .collect();
    let expected = [
        (1, "part 1 of 3: 3 of 7 CL files"),
        (0, "part 2 of 3: 2 of 7 CL files"),
        (0, "part 3 of 3: 2 of 7 CL files"),
    ];
    assert_eq!(said, expected.map(|(status, text)| (status, text.to_string())));
    for n in 0..7 {
        let of = (1..=3).filter(|part| place.text(&format!("nc-{part}/{n}.nc")).is_some());
        let of: Vec<usize> = of.collect();
        assert_eq!(of, if n == 3 { vec![] } else { vec![n % 3 + 1] }, "{n}");
    }
    let beyond = place.run(&["post", "cl/0.ncl", "-o", "nc", "--shard", "2/2"]);
    assert!(beyond.status == 0 && beyond.err.contains("0 files posted"), "{}", beyond.err);
    let writes = place.run(&["post", "cl", "--grant", "write=nc", "--shard", "1/2"]);
    assert!(writes.status == 2 && writes.err.contains("two parts"), "{}", writes.err);
}

#[test]
fn a_part_knows_the_programs_of_the_others() {
    let place = Folder::new().with("cl/a.ncl", SMALL).with("cl/a.apt", SMALL);
    for shard in ["1/2", "2/2"] {
        let ran = place.run(&["post", "cl", "-o", "nc", "--shard", shard]);
        assert!(ran.status == 1 && ran.err.contains("E0802"), "{}", ran.err);
    }
}

/// The scripts of a page.
fn scripts(page: &str) -> Vec<String> {
    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs").join(page);
    let page = std::fs::read_to_string(docs).expect("the page");
    let blocks = page.split("\n```bash\n").skip(1);
    blocks.map(|block| block.split("\n```").next().unwrap_or_default().to_string()).collect()
}

/// Runs a script where `filpost` is the command; its exit status.
fn bash(place: &Folder, script: &str, variables: &[(&str, String)]) -> Option<i32> {
    let command = Path::new(env!("CARGO_BIN_EXE_filpost"));
    let search = std::env::var_os("PATH").unwrap_or_default();
    let folders = command.parent().map(Path::to_path_buf).into_iter();
    let search = std::env::join_paths(folders.chain(std::env::split_paths(&search)));
    let ran = Command::new("bash")
        .args(["-c", script])
        .current_dir(place.0.path())
        .env("PATH", search.expect("a search path"))
        .envs(variables.iter().map(|(name, value)| (name, value.as_str())))
        .output();
    match ran {
        Ok(output) => output.status.code(),
        Err(error) => {
            println!("skipped: bash: {error}");
            None
        }
    }
}

/// How often each case was run, by the JUnit files of four parts.
fn counted(place: &Folder) -> BTreeMap<String, usize> {
    let mut counts = BTreeMap::new();
    for part in 1..=4 {
        let xml = place.text(&format!("part-{part}.xml")).expect("a report of each part");
        for case in xml.split("<testcase name=\"").skip(1) {
            let name = case.split('"').next().unwrap_or_default();
            *counts.entry(name.to_string()).or_default() += 1;
        }
    }
    counts
}

#[test]
fn the_scripts_of_the_docs_run_each_case_once() {
    let scripts = scripts("testing.md");
    let [job, plain] = &scripts[..] else { panic!("{} scripts", scripts.len()) };
    let each_once = (0..10).map(|number| (format!("case-{number}"), 1)).collect();
    let place = ten_cases();
    let of_part = |part: u32| {
        let variables =
            [("SLURM_ARRAY_TASK_ID", part.to_string()), ("SLURM_ARRAY_TASK_COUNT", "1".into())];
        bash(&place, job, &variables)
    };
    // Each submitted alone, as after a failure.
    let statuses: Vec<Option<i32>> = (1..=4).map(of_part).collect();
    if statuses.contains(&None) {
        return;
    }
    assert_eq!(statuses, [Some(0), Some(0), Some(0), Some(1)]);
    assert_eq!(counted(&place), each_once);
    let place = ten_cases();
    assert_eq!(bash(&place, plain, &[]), Some(1));
    assert_eq!(counted(&place), each_once);
}

#[test]
fn the_array_that_posts_has_each_program() {
    let scripts = scripts("howto/many-files.md");
    let [job] = &scripts[..] else { panic!("{} scripts", scripts.len()) };
    let place = (0..50).fold(Folder::new(), |place, n| place.with(&format!("cl/{n}.ncl"), SMALL));
    let place = place.with("machine.toml", "name = 'M'\n").with("macros.fil", "FINI\n");
    for part in 1..=40 {
        match bash(&place, job, &[("SLURM_ARRAY_TASK_ID", part.to_string())]) {
            None => return,
            status => assert_eq!(status, Some(0)),
        }
    }
    assert!((0..50).all(|n| place.text(&format!("nc/{n}.nc")).is_some()));
}
