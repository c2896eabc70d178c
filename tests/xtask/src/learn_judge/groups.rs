//! Groups of settings that hidden posts change.

use super::Random;

/// A kind, which one post has once, and its settings.
pub fn group(random: &mut Random) -> (usize, Vec<String>) {
    let kind = random.below(KINDS.len());
    (kind, settings(random.one::<&str>(KINDS[kind])))
}

/// All variants of all kinds.
pub fn all() -> impl Iterator<Item = Vec<String>> {
    KINDS.iter().flat_map(|variants| variants.iter()).map(|variant| settings(variant))
}

fn settings(variant: &str) -> Vec<String> {
    variant.split(';').map(|setting| setting.trim().to_string()).collect()
}

/// Kinds of changes, each with its variants; settings are divided by semicolons.
const KINDS: &[&[&str]] = &[
    &[
        "seqno.increment=5",
        "seqno.increment=10",
        "seqno.increment=2;seqno.start_offset=100",
        "seqno.off_at_start=72",
        "seqno.increment=10;address.N.format=4040;address.N.spec=100",
    ],
    &["tape.blank=1", "tape.blank=2"],
    &["tape.line_end=2"],
    &["tape.start_char=none;tape.end_char=none", "tape.start_char=none"],
    &["tape.letter_case=2"],
    &[
        "address.X.spec=1;address.Y.spec=1;address.Z.spec=1",
        "address.X.spec=111;address.Y.spec=111;address.Z.spec=111",
        "address.X.spec=1;address.Y.spec=1;address.Z.spec=1;address.I.spec=1;address.J.spec=1;address.R.spec=1",
        "tape.decimal_rule=2",
        "tape.decimal_rule=1",
    ],
    &[
        "address.G.format=2020;address.G.spec=100",
        "address.M.format=2020;address.M.spec=100",
        "address.G.format=2020;address.G.spec=100;address.M.format=2020;address.M.spec=100",
        "address.T.format=2020;address.T.spec=100",
        "address.H.format=2020;address.H.spec=100;address.D.format=2020;address.D.spec=100",
    ],
    &["address.F.spec=0;address.F.format=5050", "address.F.format=4141"],
    &["address.F.slot=40", "address.M.slot=40", "address.S.slot=40;address.M.slot=41"],
    &[
        "program.rewind_code=2",
        "program.rewind_code=30",
        "program.rewind_code=none;program.end_code=2",
    ],
    &["program.number=1234", "program.number_address=none"],
    &["program.name_comment=false", "program.name_comment=true"],
    &["units.metric_code=71;units.inch_code=70", "units.in_force=21"],
    &["mode.position_in_force=90", "circle.plane_in_force=17"],
    &["feed.mode_in_force=94"],
    &["rapid.split=0", "rapid.split=1"],
    &["rapid.modal=72", "linear.modal=1", "motion.modal=false"],
    &["circle.modal=true", "circle.modal=false"],
    &[
        "circle.center=3",
        "circle.center=2",
        "circle.center=4",
        "circle.center=5;circle.max_degrees=90",
    ],
    &["circle.max_degrees=90"],
    &["circle.full_circle=0"],
    &["cycle.depth_output=2", "cycle.depth_output=3"],
    &["cycle.data_modal=1", "cycle.axes_modal=-1"],
    &["cycle.return_codes=1", "cycle.return_modal=true"],
    &["cycle.drill_code=181", "cycle.deep_code=183", "cycle.tap_code=184", "cycle.csink_code=182"],
    &["cycle.off_code=180"],
    &["cycle.dwell_address=24", "cycle.step_address=23"],
    &["cycle.approach_block=true", "cycle.retract_block=true"],
    &["cutcom.address=16", "cutcom.left_code=141;cutcom.right_code=142;cutcom.off_code=140"],
    &["cutcom.with_motion=false"],
    &["dwell.code=104", "dwell.address=24;dwell.upm_factor=1", "dwell.upm_factor=1"],
    &["tool.change_code=66", "tool.separate_blocks=true", "tool.modal=true"],
    &["tool.preselect=true"],
    &["tool.length_at_change=true", "tool.length_const=true"],
    &["tool.length_code=143", "tool.length_cancel_code=49", "tool.length_z=100"],
    &["tool.restate=false"],
    &[
        "tool.change_block=1;tool.change_z=250",
        "tool.change_block=1;tool.change_x=0;tool.change_y=0;tool.change_z=100",
    ],
    &["fixture.placement=2", "fixture.placement=3", "fixture.default_code=55"],
    &["fixture.form=2;fixture.address=5"],
    &["spindle.placement=2", "spindle.placement=3"],
    &["spindle.cw_code=13;spindle.ccw_code=14", "spindle.stop_code=15", "spindle.orient_code=20"],
    &["coolant.placement=2", "coolant.placement=3"],
    &[
        "coolant.flood_code=50",
        "coolant.mist_code=51",
        "coolant.off_code=52",
        "coolant.print_off=true",
    ],
    &["override.on_code=148;override.off_code=149"],
    &["message.out_char=59;message.in_char=none", "message.to_tape=false"],
    &[
        "blocks.start=[\"G40 G80\"]",
        "blocks.start=[\"G90 G40\", \"G80\"]",
        "blocks.start=[\"G49\"]",
    ],
    &["blocks.end=[\"M5\", \"M9\"]", "blocks.end=[\"G28 G91 Z0.\", \"G90\"]"],
    &["blocks.change_before=[\"M5\", \"M9\"]", "blocks.change_before=[\"M1\"]"],
    &["blocks.change_after=[\"G90\"]", "blocks.first_change_before=[\"(FIRST)\"]"],
    &["output.translate_z=50", "output.translate_x=-100;output.translate_y=20"],
    &["feed.print_with_code=true", "rapid.repeat_feed=false"],
    &["program.opstop_code=101", "program.stop_code=100"],
];
