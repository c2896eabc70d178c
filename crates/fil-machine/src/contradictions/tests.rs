use super::*;
use crate::files::apply_setting;
use crate::locations::default_commons;

#[test]
fn the_default_machine_does_not_contradict_itself() {
    assert!(check(&default_commons()).is_ok());
}

#[test]
fn letters_that_a_control_reads_as_they_are_meant_are_taken() {
    for setting in [
        "dwell.address=X",
        "dwell.address=F",
        "program.number_address=P",
        "circle.radius_address=U",
        "fixture.form=2\nfixture.address=H\ntool.length_code=none",
        "fixture.form=2\nfixture.address=E",
        "tape.end_of_block=2\ntape.end_of_block_char=;",
        "tape.end_of_block=2",
        "seqno.align=1\ntape.align_char=:",
        "seqno.align=1\nprogram.number_address=none",
        "message.out_char=;",
        "message.out_char=;\nmessage.in_char=;",
        "address.E.slot=21\naddress.E.format=3443\naddress.E.spec=1\naddress.E.char=U",
        "address.A.char=W",
        "address.B.char=C",
        "address.Y.slot=53\naddress.X.char=Y",
        "address.P.format=4343\naddress.P.spec=120",
        "address.N.spec=20",
        "address.X.spec=121",
        "cycle.deep_code=83\ncycle.brkchp_code=83",
        "spindle.max_code=92",
        "units.metric_code=71\nunits.inch_code=70\nspindle.max_code=21",
        "cycle.return_codes=1\nfeed.mode=98\nfeed.upr_code=99\nfeed.upm_code=98",
        "program.end_code=99",
        "fixture.form=1\nfixture.address=X",
        "control.family=1\ndwell.address=Z",
        "control.family=2\nprogram.number_address=none\ndwell.address=F",
    ] {
        let mut commons = default_commons();
        for part in setting.lines() {
            apply_setting(&mut commons, part).unwrap();
        }
        assert!(check(&commons).is_ok(), "{setting}: {:?}", check(&commons));
    }
}

#[test]
fn positions_of_axes_that_the_machine_has_are_taken() {
    let axis = "rotary.primary_kind=1\nrotary.primary_letter=B\nrotary.primary_axis=2";
    for setting in [
        "limits.b_kind=1",
        "limits.check=1\nlimits.a_kind=1",
        "tool.change_block=2\ntool.change_b=10",
        "output.translate_b=5",
    ] {
        let mut commons = default_commons();
        for part in axis.lines().chain(setting.lines()) {
            apply_setting(&mut commons, part).unwrap();
        }
        assert!(check(&commons).is_ok(), "{setting}");
    }
}

#[test]
fn contradictions_are_found() {
    for setting in [
        "circle.cw_code=3",
        "linear.code=0",
        "mode.position=91",
        "int.5=3",
        "feed.upm_factor=-1",
        "limits.x_min=5\nlimits.x_max=1",
        "limits.a_min=5\nlimits.a_max=1",
        "rotary.primary_kind=1\nrotary.primary_axis=2\nlimits.check=1\nlimits.b_kind=1",
        "rotary.primary_kind=1\nrotary.primary_axis=3\nlimits.check=1\nlimits.c_zones=1",
        "cycle.dwell_address=Q",
        "rotary.primary_kind=1\nrotary.primary_letter=X",
        "rotary.primary_kind=1\nrotary.secondary_kind=2\nrotary.secondary_axis=1",
        "rotary.primary_kind=2\nrotary.secondary_kind=1\nrotary.secondary_axis=3",
        "spindle.stop_code=3",
        "spindle.orient_code=3",
        "coolant.mist_code=3",
        "cycle.off_code=81",
        "cycle.drill_code=17",
        "cycle.deep_code=81",
        "spindle.css_code=97\nspindle.rpm_code=97",
        "spindle.css_code=96",
        "spindle.max_code=91",
        "spindle.max_code=54",
        "spindle.max_code=28",
        "tool.length_cancel_code=54",
        "override.on_code=49",
        "coolant.default_code=9",
        "coolant.flood_high_code=9",
        "rotary.tip_code=540",
        "rotary.tip_code=682",
        "rotary.tip_code=531",
        "rotary.frame_cancel_code=80",
        "rotary.frame_cancel_code=0",
        "rotary.frame_cancel_code=54",
        "rotary.frame_cancel_code=91",
        "fixture.max_code=90",
        "fixture.default_code=30",
        "fixture.form=2\ntool.length_cancel_code=54",
        "cycle.rigid_tap_code=810",
        "spindle.default_code=5",
        "spindle.range1_code=98",
        "coolant.air_code=30\nprogram.rewind_code=none",
        "tool.change_code=none\ncoolant.air_code=6",
        "mode.preset_code=53",
        "thread.varying_code=1",
        "fixture.form=2",
        "fixture.form=2\nfixture.address=D",
        "thread.lead_address=X",
        "feed.inverse_min=16705",
        "control.family=1\ntool.format=2",
        "control.family=2\nprogram.number_address=none\ndwell.address=F\ntool.format=3",
        "thread.code=0",
        "lathe.diameter_code=7",
        "tool.length_code=40",
        "mode.position=89",
        "circle.plane=20",
        "circle.max_degrees=45",
        "circle.radius_address=H",
        "tool.change_block=2\ntool.change_b=10",
        "output.translate_c=5",
        "tool.preselect=1\ntool.change_code=none",
        "tool.preselect=1\ntool.format=2",
        "dwell.upm_format=3241",
        "cycle.tap_left_code=81",
        "program.opstop_code=99",
        "rapid.code_xy=99",
        "rapid.address=F\nrapid.value=3000\nrapid.repeat_feed=0",
        "dwell.cycle_drill=-0.001",
        "scale.x=0.000001",
        "cycle.dwell_address=R",
        "circle.radius_address=I",
        "circle.radius_address=D",
        "program.number_address=X",
        "dwell.address=Z",
        "spindle.orient_address=Y",
        "spindle.max_address=X",
        "fixture.form=2\nfixture.address=R",
        "fixture.extended_address=X",
        "control.family=2\nprogram.number_address=none",
        "control.family=2\ndwell.address=F",
        "control.family=2\nprogram.number_address=none\ndwell.address=F\ncutcom.address=H",
        "control.family=2\nprogram.number_address=none\ndwell.address=F\nrapid.address=Q\n\
         rapid.value=1",
        "tape.end_of_block=2\ntape.end_of_block_char=48",
        "tape.end_of_block=2\ntape.end_of_block_char=.",
        "tape.end_of_block=2\ntape.end_of_block_char=X",
        "tape.end_of_block=2\ntape.end_of_block_char=(",
        "tape.end_of_block=2\ntape.end_of_block_char=/",
        "tape.end_of_block=2\ntape.end_of_block_char=%",
        "tape.end_of_block=2\ntape.end_of_block_char=-",
        "tape.end_of_block_char=48",
        "seqno.align=1\ntape.align_char=X",
        "seqno.align=1\ntape.align_char=G",
        "seqno.align=1\ntape.align_char=M",
        "seqno.align=1\ntape.align_char=(",
        "seqno.align=1\ntape.align_char=%",
        "seqno.align=1\ntape.align_char=O",
        "home.frame=2\nhome.x=5",
        "home.frame=3\ntool.change_x=-1",
        "home.frame=4\nhome.retract_z=0",
        "home.frame=4\ntool.length_code=56\nhome.z=5",
        "control.family=1\nrotary.frame_form=1",
        "message.out_char=/",
        "message.out_char=G",
        "message.out_char=[\nmessage.in_char=)",
        "message.out_char=-",
        "message.out_char=:",
        "message.out_char=)",
        "message.in_char=X",
        "message.out_char=;\ntape.end_of_block=2\ntape.end_of_block_char=;",
        "tape.leader=5\ntape.leader_char=(",
        "tape.opskip_char=$\ntape.end_of_block=2",
        "tape.continuation_char=)",
        "address.F.char=S",
        "address.X.char=Y",
        "address.I.char=J",
        "address.H.char=D",
        "address.D.char=N",
        "address.S.char=N",
        "address.M.char=G",
        "address.F.char=(",
        "address.X.char=-",
        "address.A.char=X",
        "rotary.primary_kind=1\nrotary.primary_axis=2\naddress.B.char=R",
        "address.T.spec=120",
        "address.T.spec=20",
        "address.S.spec=20",
        "address.D.spec=120",
        "address.P.spec=120",
        "address.X.spec=20",
        "tape.opskip_char=%",
        "tape.start_char=(",
        "control.family=2\ntape.partno_text=1",
        "control.family=2\nprogram.number_address=none\ndwell.address=F\ncontrol.translation=1\n\
         rotary.primary_kind=1\nrotary.primary_axis=3",
        "control.family=2\nprogram.number_address=none\ndwell.address=F\ncontrol.translation=1\n\
         output.translate_x=5",
        "rotary.tip_output=1\nscale.z=0.5",
        "rotary.tip_form=1",
        "rotary.tip_output=1\nrotary.tip_form=1\nrotary.output=2",
        "rotary.tip_output=1\nrotary.tip_form=1\ncontrol.rotary_index=3",
        "input.along_tool_axis=5\nrotary.primary_kind=1\nrotary.primary_axis=3",
    ] {
        let mut commons = default_commons();
        for part in setting.lines() {
            apply_setting(&mut commons, part).unwrap();
        }
        let refused = check(&commons).expect_err(setting);
        assert_eq!(refused.code.name(), "E0607", "{setting}: {refused}");
    }
}
