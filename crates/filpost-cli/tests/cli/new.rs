//! `filpost new`: the folder it makes is a post that works, and its page is right.

use filpost::ready::READY;

use crate::support::Folder;

#[test]
fn every_ready_post_begins_an_own_one_whose_case_passes() {
    let place = Folder::new();
    for post in READY {
        let made = place.run(&["new", &format!("my-{}", post.name), "--base", post.name]);
        assert_eq!(made.status, 0, "{made:?}");
    }
    let ran = place.run(&["test", "."]);
    assert_eq!(ran.status, 0, "{}", ran.out);
    assert!(ran.out.ends_with(&format!("{} passed, 0 failed\n", READY.len())), "{}", ran.out);
}

#[test]
fn each_setting_of_its_machine_can_be_set() {
    let place = Folder::new();
    for post in READY {
        assert_eq!(place.run(&["new", post.name, "--base", post.name]).status, 0);
        let machine = place.text(&format!("{}/machine.toml", post.name)).expect("its settings");
        let settings = machine.lines().filter_map(|line| line.strip_prefix("# "));
        let settings: Vec<&str> = settings.filter(|line| line.contains(" = ")).collect();
        assert!(settings.len() > 8, "{settings:?}");
        let case = format!("{}/cases/first/part.ncl", post.name);
        for setting in &settings {
            let (name, value) = setting.split_once(" = ").expect("a name and a value");
            let option = format!("{name}={}", value.replace('"', ""));
            let mut words = vec!["post", &case, "-p", post.name];
            // A setting has a group in its name, an option none.
            if name.contains('.') {
                words.extend(["--set", setting]);
            } else {
                words.extend(["--option", &option]);
            }
            // A limit of travel acts where limits are checked.
            if name.starts_with("limits.") {
                words.extend(["--set", "limits.check = 1"]);
            }
            let ran = place.run(&words);
            assert_eq!(ran.status, 0, "{setting}: {}", ran.err);
            assert!(!ran.err.contains("W06"), "{setting}: {}", ran.err);
        }
    }
}

/// The commands of the page, as words; the name of the program left out.
fn commands(readme: &str) -> Vec<Vec<String>> {
    let lines = readme.lines().filter_map(|line| line.trim_start().strip_prefix("filpost "));
    lines.map(|line| line.split(' ').map(str::to_string).collect()).collect()
}

/// A newcomer does what the page says, in its order.
#[test]
fn the_page_of_the_folder_can_be_followed() {
    let place = Folder::new();
    let made = place.run(&["new", "my-post", "--base", "haas-mill"]);
    assert_eq!(made.out, "Created my-post from haas-mill. Next: my-post/README.md\n");
    let readme = place.text("my-post/README.md").expect("a page");
    assert!(!readme.contains('{'), "{readme}");
    let steps = commands(&readme);
    let run = |step: usize| {
        let words: Vec<&str> = steps[step].iter().map(String::as_str).collect();
        place.run(&words)
    };
    let change = |file: &str, from: &str, to: &str| {
        let text = place.text(file).expect("a file");
        assert!(text.contains(from), "{file} has no {from}");
        std::fs::write(place.0.path().join(file), text.replacen(from, to, 1)).expect("written");
    };
    let posted = run(0);
    assert!(
        posted.out.contains("(PART 100 FIRST)") && posted.out.contains("(T1 D10)"),
        "{posted:?}"
    );
    change("my-post/machine.toml", "# seqno.increment = 5", "seqno.increment = 5");
    let failed = run(1);
    assert_eq!(failed.status, 1);
    assert!(failed.out.contains("N5"), "{}", failed.out);
    assert_eq!(run(2).status, 0);
    assert_eq!(place.run(&["test", "my-post"]).status, 0);
    change("my-post/post.fil", "'PART '", "'PROGRAM FOR '");
    assert_eq!(run(3).status, 0);
    assert!(run(4).out.contains("PROGRAM FOR"));
    let part = place.text("my-post/cases/first/part.ncl").expect("a part");
    let place = place.with("PART.ncl", part);
    place.run(&["post", "PART.ncl", "-p", "my-post", "-o", "PART.nc"]);
    for step in &steps[5..] {
        let words: Vec<&str> = step.iter().map(String::as_str).collect();
        let ran = place.run(&words);
        assert_eq!(ran.status, 0, "{step:?}: {ran:?}");
    }
    assert_eq!(steps.len(), 8, "{steps:?}");
    let tutorial = include_str!("../../../../docs/tutorial.md");
    let own = tutorial.split("## A post of your own").nth(1).expect("the step of the tutorial");
    let shown = commands(own);
    assert_eq!(shown[0], ["new", "my-post", "--base", "haas-mill"]);
    assert_eq!(shown[1..], steps[..2]);
}

/// A newcomer meets no warning: the commands of the tutorial before the post of one's own.
#[test]
fn the_tutorial_runs_without_warnings() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let own = include_str!("../../../../docs/tutorial.md");
    let own = own.split("## A post of your own").next().expect("the steps before");
    let shown = commands(own);
    assert!(shown.len() > 3, "{shown:?}");
    let place = Folder::new();
    for step in shown {
        let words: Vec<&str> = step.iter().map(String::as_str).collect();
        let ran = place.command(&words).current_dir(&root).output().expect("it runs");
        let said = String::from_utf8_lossy(&ran.stderr);
        assert!(ran.status.success(), "{step:?}: {said}");
        let warns = said.contains(" warning") && !said.contains(" 0 warnings");
        assert!(!warns && !said.contains("W0"), "{step:?}: {said}");
    }
    let scripts = ["check", "corpus/tutorial/mill.fil", "-m", "corpus/tutorial/machine.toml"];
    for words in [&scripts[..], &["check", "corpus/tutorial/first.fil"]] {
        let ran = place.command(words).arg("--deny-warnings").current_dir(&root).output();
        assert!(ran.expect("it runs").status.success(), "{words:?}");
    }
}

#[test]
fn nothing_is_written_over() {
    let place = Folder::new().folder("empty").with("file", "text");
    for name in ["empty", "file"] {
        let ran = place.run(&["new", name]);
        assert_eq!(ran.status, 1);
        assert!(ran.err.contains("E0808"), "{}", ran.err);
    }
    assert_eq!(place.text("file").as_deref(), Some("text"));
    assert!(std::fs::read_dir(place.0.path().join("empty")).expect("a folder").next().is_none());
}

#[test]
fn a_path_without_a_name_and_a_base_that_is_not_there_are_refused() {
    let place = Folder::new();
    for path in ["..", "/"] {
        let ran = place.run(&["new", path]);
        assert!(ran.status == 1 && ran.err.contains("E0809"), "{}", ran.err);
    }
    let ran = place.run(&["new", "my-post", "--base", "haas"]);
    assert!(ran.status == 1 && ran.err.contains("E0703"), "{}", ran.err);
    assert!(ran.err.contains("haas-mill"), "{}", ran.err);
    assert_eq!(place.files(), [""; 0]);
}

#[test]
fn names_with_odd_characters_are_names() {
    let place = Folder::new();
    let name = "a \"fräse\" {NAME} 'x'";
    assert_eq!(place.run(&["new", name]).status, 0);
    assert_eq!(place.run(&["test", name]).status, 0);
}
