use super::*;
use crate::Pair;

const CL: &str = "UNITS / MM\nLOADTL / 1\nPPRINT / SIDE A\nSPINDL / RPM, 900, CLW\nRAPID\nGOTO / 1, 2, 30\n\
                  FEDRAT / 200, MMPM\nGOTO / 1, 2, -0.5\nGOTO / 20.5, 2, -0.5\nFINI\n";

/// What is learned from the program of a post that begins from a ready post.
fn learned_of(builder: filpost::Builder, base: &str) -> Learned {
    let mut nc = Vec::new();
    builder.build().unwrap().stream_seekable(std::io::Cursor::new(CL), &mut nc).unwrap();
    let pair = Pair::new("part.ncl", CL.as_bytes(), "part.nc", &nc);
    let task = Task::new(vec![pair], Bases::Ready(vec![base.into()]));
    let learned = learn(&task).unwrap();
    assert!(learned.is_equal(), "{}", learned.report());
    let toml = learned.machine_toml();
    filpost::Program::builder().machine("machine.toml", &toml).build().expect("settings");
    learned
}

#[test]
fn a_start_text_is_found_where_the_change_is_the_first_record() {
    let builder = filpost::Program::builder().ready("brother-mill").option("style", "plain");
    let learned = learned_of(builder.set("blocks.start=[\"G40 G80\"]"), "brother-mill");
    assert!(learned.machine_toml().contains("blocks.start = [\"G40 G80\"]"));
}

#[test]
fn the_style_of_a_ready_post_is_found() {
    let learned = learned_of(filpost::Program::builder().ready("haas-mill"), "haas-mill");
    assert_eq!(learned.options(), [("style".to_string(), "production".to_string())]);
}

#[test]
fn a_code_left_out_at_the_start_is_in_force_there() {
    let builder = filpost::Program::builder().ready("fanuc-mill").option("style", "plain");
    let learned = learned_of(builder.set("units.in_force=21"), "fanuc-mill");
    assert!(learned.machine_toml().contains("\nunits.in_force = 21\n"), "{}", learned.report());
}

#[test]
fn a_text_before_the_only_change_may_be_of_the_first_or_of_each() {
    let builder = filpost::Program::builder().ready("fanuc-mill");
    let learned = learned_of(builder.set("blocks.change_before=[\"M1\"]"), "fanuc-mill");
    let toml = learned.machine_toml();
    assert!(toml.contains("\nblocks.change_before = [\"M1\"]\n"), "{toml}");
    let other = "blocks.first_change_before=[\"M1\"]\nblocks.change_before=[]";
    assert!(learned.undecided().iter().any(|it| it == other), "{:?}", learned.undecided());
}

#[test]
fn the_marks_of_messages_are_read_off() {
    let builder = filpost::Program::builder().ready("fanuc-mill");
    let marks = builder.set("message.out_char=59").set("message.in_char=none");
    let learned = learned_of(marks.set("program.name_comment=true"), "fanuc-mill");
    assert!(learned.machine_toml().contains("message.out_char = 59"), "{}", learned.report());
}
