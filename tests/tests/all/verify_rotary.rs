//! What the back-check says of programs with rotary axes: what no such program may do is found,
//! whoever wrote it, and what is right is not.

use fil_nc::verify::Allowed;
use filpost::Program;
use filpost_tests::back_check;

/// A CL file and a program for it on a ready post with settings.
struct Case<'a> {
    ready: &'a str,
    settings: &'a [&'a str],
    cl: &'a str,
    nc: &'a str,
}

impl Case<'_> {
    /// What is found, one line each.
    fn found(&self) -> String {
        let start = Program::builder().ready(self.ready);
        let post = self.settings.iter().fold(start, |builder, setting| builder.set(setting));
        let post = post.build().expect("a machine");
        let cl = format!(
            "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 3000, CLW\n{}\nFINI\n",
            self.cl.replace("; ", "\n")
        );
        let report = back_check::check(post.commons(), &cl, self.nc, Allowed::default());
        match report {
            Ok(report) => report.findings.iter().map(|finding| format!("{finding}\n")).collect(),
            Err(refused) => refused.to_string(),
        }
    }

    fn asks_for(&self, message: &str) {
        let found = self.found();
        assert!(found.contains(message), "no `{message}` in\n{found}\n{}", self.nc);
    }

    fn agrees(&self) {
        let found = self.found();
        assert!(found.is_empty(), "{found}\n{}", self.nc);
    }
}

/// A program of a machine that says its modes at the start, with these blocks.
fn milled(blocks: &str) -> String {
    let start = "%\nO0001 (T)\nG21 G90 G94 G17\nT1 M6\nS3000 M3\n";
    format!("{start}{}\nM30\n%\n", blocks.replace("; ", "\n"))
}

const OVER: &str = "RAPID; GOTO / 10, 0, 50; FEDRAT / 300, MMPM; GOTO / 10, 0, 30";

#[test]
fn a_turn_under_cutter_compensation_is_found() {
    let ready = "fanuc-mill-a";
    let message = "a rotary axis turns under cutter compensation";
    let cl = format!(
        "{OVER}; CUTCOM / LEFT; GOTO / 20, 0, 30; GOTO / 20, 5, 30, 0, 0.0871557427, 0.9961946981; \
         CUTCOM / OFF; GOTO / 20, 15, 30, 0, 0.0871557427, 0.9961946981"
    );
    let start = "G0 X10. Y0.; A0.; G43 Z50. H1; G1 Z30. F300.; G1 G41 X20. D1";
    let nc = milled(&format!(
        "{start}; G93 Y0.793 Z30.036 A-1.667 F180.026; Y1.583 Z30.143 A-3.333 F180.031; \
         Y2.366 Z30.322 A-5. F179.972; G94; G40 Y12.328 Z31.193 F300."
    ));
    Case { ready, settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    // At rapid, too: the side of what follows is that of another face.
    let cl = format!(
        "{OVER}; CUTCOM / LEFT; GOTO / 20, 0, 30; RAPID; \
         GOTO / 20, 5, 80, 0, 0.0871557427, 0.9961946981; \
         GOTO / 20, 6, 80, 0, 0.0871557427, 0.9961946981; CUTCOM / OFF; \
         GOTO / 20, 15, 80, 0, 0.0871557427, 0.9961946981"
    );
    let turned = "G0 Z80.131; Y-1.991; A-5.; G1 Y-0.995 Z80.219; G40 Y7.97 Z81.003";
    let nc = milled(&format!("{start}; {turned}"));
    Case { ready, settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    let cl = cl.replace("RAPID; GOTO / 20, 5", "CUTCOM / OFF; GOTO / 20, 0, 80; RAPID; GOTO / 20, 5");
    let cl = cl.replace("CUTCOM / OFF; GOTO / 20, 15", "GOTO / 20, 15");
    let nc = milled(&format!("{start}; G40 Z80.; {}", turned.replace("G40 ", "")));
    let nc = nc.replace("G40 Z80.", "G1 G40 X20. Z80.");
    Case { ready, settings: &[], cl: &cl, nc: &nc }.agrees();
}

#[test]
fn a_turn_at_feed_from_a_point_of_the_machine_is_found() {
    let ready = "fanuc-mill-a";
    let cl = format!(
        "{OVER}; INSERT / G91 G28 A0.; INSERT / G90; GOTO / 20, 0, 5, 0, 0.5, 0.8660254038"
    );
    let start = "G0 X10. Y0.; A0.; G43 Z50. H1; G1 Z30. F300.; G91 G28 A0.; G90";
    let nc = milled(&format!("{start}; X20. Y-2.5 Z4.33 A-30."));
    let message = "a rotary axis turns at feed from a point of the machine";
    Case { ready, settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    let cl = cl.replace("GOTO / 20", "RAPID; GOTO / 20, 0, 50, 0, 0.5, 0.8660254038; GOTO / 20");
    let nc = milled(&format!("{start}; G0 Z43.301; X20. Y-25.; A-30.; G1 Y-2.5 Z4.33"));
    Case { ready, settings: &[], cl: &cl, nc: &nc }.agrees();
}

#[test]
fn a_time_for_a_way_from_an_unknown_place_is_found() {
    let lean = "0.3418118035, 0.0119363453, 0.9396926208";
    let cl = format!("{OVER}; SET / OFSETL, 2; GOTO / 10, 0, 5, {lean}");
    let start = "G0 X10. Y0.; A0. C0.; G43 Z50. H1; G1 Z30. F300.";
    let nc = milled(&format!("{start}; G55; G93 X-0.65 Y-9.387 Z5.113 A-20. C-88. F300.118"));
    let message = "the feed is a time for a way that begins where nobody knows";
    Case { ready: "haas-trunnion", settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    let nc = milled(&format!(
        "{start}; T2 M6; S3000 M3; G93 X-0.65 Y-9.387 Z5.113 A-20. C-88. F300.118"
    ));
    Case { ready: "haas-trunnion", settings: &[], cl: &cl, nc: &nc }.asks_for(message);
    let nc = milled(&format!("{start}; G55; G94 X-0.65 Y-9.387 Z5.113 A-20. C-88. F300."));
    let found = Case { ready: "haas-trunnion", settings: &[], cl: &cl, nc: &nc }.found();
    assert!(!found.contains(message), "{found}");
}

#[test]
fn a_turn_that_may_be_skipped_must_not_come_at_feed_in_its_place() {
    let ready = "haas-trunnion";
    let settings = &["rotary.table_words=1"];
    let cl = format!("{OVER}; OPSKIP / ON; ROTABL / 90, CAXIS; OPSKIP / OFF; GOTO / 20, 0, 30");
    let start = "G0 X10. Y0.; A0. C0.; G43 Z50. H1; G1 Z30. F300.; /G0 C90.";
    let nc = milled(&format!("{start}; G1 X20. C90."));
    Case { ready, settings, cl: &cl, nc: &nc }.asks_for(
        "the tip leaves its line by 5.3312 on the way, 0.01 is allowed, with the blocks behind / \
         left out",
    );
    // At rapid it may.
    let cl = cl.replace("GOTO / 20, 0, 30", "RAPID; GOTO / 20, 0, 80");
    let nc = milled(&format!("{start}; G0 Z80.; X20.; C90."));
    Case { ready, settings, cl: &cl, nc: &nc }.agrees();
}
