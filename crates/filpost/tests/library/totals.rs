//! PROGF, TLISTF, OPERF and TOOLF(NEXT): what a header tells of the motions behind it.

use std::io::{Cursor, sink};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use filpost::{Builder, Program};

const CL: &str = "PARTNO / BRACKET\nUNITS / MM\n$$-> FEATNO / 11\nTPRINT / END MILL\n\
    LOADTL / 7, LENGTH, 85\nCUTTER / 12\nPPRINT / ROUGH\nSPINDL / RPM, 1000, CLW\n\
    FEDRAT / 50, MMPM\nGOTO / 0, 0, 0\nGOTO / 100, 0, 0\nPPRINT / WITHIN\nDELAY / 30\n\
    $$-> FEATNO / 12\nLOADTL / 3\nGOTO / 100, 0, 0\nCIRCLE / 110, 0, 0, 0, 0, 1, 10\nGOTO / 120, 0, 0\n\
    $$-> FEATNO / 13\nLOADTL / 7\nPPRINT / HOLES\nCYCLE / DRILL, DEPTH, 7, CLEAR, 1, MMPM, 40\n\
    GOTO / 120, 50, 0\nCYCLE / OFF\nFINI\n";

fn mill(fil: &str) -> Builder {
    Program::builder().generic("fanuc-mill").fil("header.fil", fil)
}

/// The comments of the program behind its name.
fn told(builder: Builder, cl: &str) -> Result<Vec<String>, String> {
    let program = builder.build().map_err(|error| error.to_string())?;
    let mut nc = Vec::new();
    let run = program.start().cl_name("part.ncl").stream_seekable(Cursor::new(cl), &mut nc);
    run.map_err(|error| error.diags()[0].to_string())?;
    let nc = String::from_utf8(nc).expect("text");
    let comments = nc.lines().filter_map(|line| line.split_once(" (")).map(|(_, text)| text);
    Ok(comments.skip(1).map(|text| text.trim_end_matches(')').to_string()).collect())
}

/// What a section at the first tool change tells, before the comments of the CL file.
fn header(statements: &str, cl: &str) -> Vec<String> {
    let fil = format!(
        "DONE=0\nCIMFIL/ON,LOADTL\nIF(DONE.EQ.0)THEN\nDONE=1\n{statements}\nENDIF\n\
         DMY=POSTF(13)\nCIMFIL/OFF\nCIMFIL/ON,PPRINT\nCIMFIL/OFF\nFINI\n"
    );
    told(mill(&fil), cl).expect("posted")
}

#[test]
fn the_program_has_times_lengths_and_extents() {
    // 100 at 50 a minute, half a circle of radius 10, half a minute; the R level is 50 away and 1 up at
    // 5000 a minute, 8 down at 40 and 8 back at 5000.
    let cut = 100.0 + 10.0 * std::f64::consts::PI + 8.0;
    let time = (100.0 + 10.0 * std::f64::consts::PI) / 50.0 + 0.5 + 59.0 / 5000.0 + 8.0 / 40.0;
    let fil = "T1=TEXT/'LENGTH ',TEXTF(PROGF(CUTLEN),0,3),' TIME ',TEXTF(PROGF(TIME),0,4)\nPPRINT/T1\n\
        T1=TEXT/PROGF(XMIN),' ',PROGF(XMAX),' ',PROGF(YMIN),' ',PROGF(YMAX),' ',PROGF(ZMIN),' ',PROGF(ZMAX)\n\
        PPRINT/T1\nT1=TEXT/PROG\nT1=TEXT/T1,' ',PROGF(UNITS)\nPPRINT/T1";
    let expected =
        [format!("LENGTH {cut:.3} TIME {time:.4}"), "0 120 -10 50 -7 0".into(), "BRACKET 1".into()];
    assert_eq!(header(fil, CL), expected);
}

/// Lengths at feed and at rapid, seconds in all, for a drilling cycle of these words at X10 and
/// X20 from Z20.
fn drilled(cycle: &str) -> String {
    let cl = format!(
        "PARTNO / HOLES\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 600, CLW\nRAPID\nGOTO / 10, 0, 20\n{cycle}\n\
         GOTO / 10, 0, 0\nRAPID\nGOTO / 20, 0, 20\nGOTO / 20, 0, 0\nCYCLE / OFF\nFINI\n"
    );
    let fil = "T1=TEXT/TEXTF(PROGF(CUTLEN),0,2),' ',TEXTF(PROGF(TIME)*60,0,3)\nPPRINT/T1";
    header(fil, &cl).remove(0)
}

/// Rapid traverse is 5000 a minute, 0.012 s a mm.
#[test]
fn holes_count_pecks_dwells_and_the_way_out() {
    // Down 12 to Z-10 at 120 a minute, 6 s each; 18 to the R level and 12 out of each hole, and
    // from the R level of the first one 10 over and 18 up.
    let ways = 18.0 + libm::hypot(10.0, 18.0) + 18.0;
    let drill = drilled("CYCLE / DRILL, DEPTH, 10, MMPM, 120, CLEAR, 2");
    assert_eq!(drill, format!("24.00 {:.3}", 12.0 + 0.012 * (ways + 24.0)));
    // Back to Z20: 30 out, then 10 across.
    let to_start = drilled("CYCLE / DRILL, DEPTH, 10, MMPM, 120, CLEAR, 2, RETURN, 0");
    assert_eq!(to_start, format!("24.00 {:.3}", 12.0 + 0.012 * (18.0 + 30.0 + 10.0 + 18.0 + 30.0)));
    // Half a second at each bottom.
    let dwells = drilled("CYCLE / FACE, DEPTH, 10, MMPM, 120, CLEAR, 2, DWELL, 0.5");
    assert_eq!(dwells, format!("24.00 {:.3}", 13.0 + 0.012 * (ways + 24.0)));
    // A tap and a bored hole are left at feed; the tap by its lead of 1 at 600 turns a minute.
    let tap = drilled("CYCLE / TAP, DEPTH, 10, TPI, 25.4, CLEAR, 2");
    assert_eq!(tap, format!("48.00 {:.3}", 4.8 + 0.012 * ways));
    let ream = drilled("CYCLE / REAM, DEPTH, 10, MMPM, 120, CLEAR, 2");
    assert_eq!(ream, format!("48.00 {:.3}", 24.0 + 0.012 * ways));
    // Pecks of 5: from 5 and 10 out, and back to 0.2 above; 0.4 is cut twice in each hole.
    let deep = drilled("CYCLE / DEEP, DEPTH, 10, STEP, 5, MMPM, 120, CLEAR, 2");
    assert_eq!(deep, format!("24.80 {:.3}", 12.4 + 0.012 * (ways + 24.0 + 2.0 * 29.6)));
    let chips = drilled("CYCLE / BRKCHP, DEPTH, 10, STEP, 5, MMPM, 120, CLEAR, 2");
    assert_eq!(chips, format!("24.80 {:.3}", 12.4 + 0.012 * (ways + 24.0 + 0.8)));
}

#[test]
fn turns_of_a_dwell_take_the_speed_of_the_spindle() {
    let cl = "PARTNO / HOLES\nUNITS / MM\nLOADTL / 1\nSPINDL / RPM, 600, CLW\nFEDRAT / 0.1, MMPR\nGOTO / 0, 0, 0\n\
        DELAY / REV, 20\nFINI\n";
    assert_eq!(header("T1=TEXT/TEXTF(PROGF(TIME)*60,0,3)\nPPRINT/T1", cl), ["2.000"]);
}

#[test]
fn the_tool_list_has_each_tool_once() {
    let fil = "DO/LAST,II=1,PROGF(TOOLS)\nNAME=TEXT/TLIST,II\nDD=TLISTF(II,DIAMTR)\n\
        IF(DD.EQ.999999)DD=0\nLL=TLISTF(II,LENGTH)\nIF(LL.EQ.999999)LL=0\n\
        NAME=TEXT/'T',TLISTF(II,NUMBER),' D',DD,' L',LL,' ',TEXTF(TLISTF(II,CUTLEN),0,1),' ',NAME\n\
        PPRINT/NAME\nLAST)CONTIN";
    assert_eq!(header(fil, CL), ["T7 D12 L85 108.0 END MILL", "T3 D0 L0 31.4"]);
}

#[test]
fn an_operation_begins_where_the_cam_system_says_so() {
    let fil = "DO/LAST,II=1,PROGF(OPERS)\nNAME=TEXT/OPER,II\nFF=OPERF(II,FEATNO)\n\
        IF(FF.EQ.999999)FF=0\nNAME=TEXT/FF,' T',OPERF(II,TOOL),' ',TEXTF(OPERF(II,CUTLEN),0,1),' ',TEXTF(OPERF(II,ZMIN)),' ',NAME\n\
        PPRINT/NAME\nLAST)CONTIN";
    // FEATNO starts operations; the message within the first one does not.
    assert_eq!(header(fil, CL), ["11 T7 100.0 0 ROUGH", "12 T3 31.4 0", "13 T7 8.0 -7 HOLES"]);
    // Without FEATNO messages do, without messages tool changes.
    let without = CL.replace("$$-> FEATNO", "$$-> MFGNO");
    let named = header(fil, &without);
    assert_eq!(named, ["0 T7 100.0 0 ROUGH", "0 T3 31.4 0 WITHIN", "0 T7 8.0 -7 HOLES"]);
    let bare = without.replace("PPRINT / ", "REMARK / ");
    assert_eq!(header(fil, &bare).len(), 3);
    let catia = without.replace("PPRINT / ROUGH", "PPRINT OPERATION NAME : Rough.1");
    assert_eq!(header(fil, &catia), ["0 T7 139.4 -7 Rough.1"]);
}

#[test]
fn the_next_tool_is_that_of_the_next_change() {
    let fil = "CIMFIL/ON,LOADTL\nNEXT=TOOLF(NEXT)\nIF(NEXT.EQ.999999)THEN\nPPRINT/'LAST'\nELSE\n\
        T1=TEXT/'NEXT T',NEXT\nPPRINT/T1\nENDIF\nDMY=POSTF(13)\nCIMFIL/OFF\n\
        CIMFIL/ON,PPRINT\nCIMFIL/OFF\nFINI\n";
    assert_eq!(told(mill(fil), CL).expect("posted"), ["NEXT T3", "NEXT T7", "LAST"]);
}

#[test]
fn inches_stay_inches_and_say_so() {
    let cl = CL.replace("UNITS / MM", "UNITS / INCHES").replace("MMPM", "IPM");
    let fil = "T1=TEXT/PROGF(UNITS),' ',PROGF(XMAX)*PROGF(UNITS)\nPPRINT/T1";
    assert_eq!(header(fil, &cl), ["25.4 3048"]);
}

#[test]
fn a_time_that_is_not_known_is_empty() {
    // Nobody reads the speed of a text.
    let spindle = "INSERT M3\n";
    let cl = CL.replace("SPINDL / RPM, 1000, CLW\n", spindle).replace("50, MMPM", "0.1, MMPR");
    let cl = cl.replace("LOADTL / 3\n", "LOADTL / 3\nINSERT M3\n");
    let fil = "IF(PROGF(TIME).EQ.999999)PPRINT/'NOT KNOWN'";
    assert_eq!(header(fil, &cl), ["NOT KNOWN"]);
}

#[test]
fn a_first_pass_takes_no_offence_at_its_own_answers() {
    // The first pass answers 1 to everything; a script that refuses such a tool must not end it.
    let fil = "IF(TLISTF(1,DIAMTR).LT.2)ERROR/'TOO SMALL'\nVV=1/(PROGF(TOOLS)-1)\nPPRINT/'GOOD'";
    assert_eq!(header(fil, CL), ["GOOD"]);
    let small = CL.replace("CUTTER / 12", "CUTTER / 1.5");
    let fil = "CIMFIL/ON,LOADTL\nIF(TLISTF(1,DIAMTR).LT.2)ERROR/'TOO SMALL'\nDMY=POSTF(13)\n\
        CIMFIL/OFF\nFINI\n";
    assert!(told(mill(fil), &small).expect_err("refused").contains("TOO SMALL"));
}

#[test]
fn a_program_that_changes_what_it_tells_is_refused() {
    let fil = "CIMFIL/ON,LOADTL\nDMY=POSTF(13)\nDELAY/PROGF(TIME)\nCIMFIL/OFF\nFINI\n";
    let said = told(mill(fil), CL).expect_err("refused");
    assert!(said.contains("E0719") && said.contains("seconds"), "{said}");
    // What does not change the motions may be anything.
    let fil = "CIMFIL/ON,LOADTL\nDMY=POSTF(13)\nIF(PROGF(TOOLS).EQ.2)OPSTOP\nCIMFIL/OFF\nFINI\n";
    assert!(told(mill(fil), CL).is_ok());
}

#[test]
fn an_error_of_the_cl_file_is_told_as_ever() {
    let fil = "CIMFIL/ON,LOADTL\nT1=TEXT/PROGF(TIME)\nPPRINT/T1\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let wrong = CL.replace("DELAY / 30", "FLY / 3");
    assert!(told(mill(fil), &wrong).expect_err("refused").contains("E0513 part.ncl:13"));
}

#[test]
fn a_stream_is_refused_where_a_script_asks() {
    let asks = "CIMFIL/ON,FINI\nVV=PROGF(TIME)\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    let run = |fil| mill(fil).build().expect("a post").stream(CL.as_bytes(), sink());
    assert!(run(asks).expect_err("a stream").diags()[0].to_string().starts_with("E0409"));
    let idle = "IF(1.EQ.2)VV=PROGF(TIME)\nFINI\n";
    assert!(run(idle).is_ok());
}

#[test]
fn commands_run_once_and_files_are_written_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let calls = Arc::new(AtomicUsize::new(0));
    let count = Arc::clone(&calls);
    let fil = "VV=SPAWNF('count')\nDMY=FILEF(1,APPEND,'log.txt')\nLL=PROGF(TOOLS)\nWRITE/1,LL\n\
        DMY=FILEF(1,CLOSE)\nFINI\n";
    let builder = mill(fil).grant_write(folder.path()).allow_spawn(move |_: &str| {
        count.fetch_add(1, Ordering::Relaxed);
        Ok(0.0)
    });
    told(builder, CL).expect("posted");
    assert_eq!(calls.load(Ordering::Relaxed), 1);
    let log = std::fs::read_to_string(folder.path().join("log.txt")).expect("the file");
    assert_eq!(log, "2\n");
}
