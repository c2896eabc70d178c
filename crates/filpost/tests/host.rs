//! A program around filpost, as a user writes one: CL files from memory, a function of its own,
//! limits, a switch that stops, two threads, and of each block what made it.

use std::thread;

use filpost::{Argument, CancelToken, Error, Limits, Posted, Program};

const CL: &str = "UNITS / MM\nLOADTL / 3\nSPINDL / RPM, 900, CLW\nFEDRAT / 300, MMPM\n\
                  GOTO / 0, 0, 5\nGOTO / 40, 0, 5\nFINI\n";

/// Names each tool by the host's own list, and goes round forever for tool 99.
const FIL: &str = "CIMFIL/ON,LOADTL\nNAME=TNAMEF(POSTF(7,4))\nPPRINT/NAME\nDMY=POSTF(13)\n\
                   LA) IF(POSTF(7,4).EQ.99) JUMPTO/LA\nCIMFIL/OFF\nFINI\n";

fn tool_name(arguments: &[Argument<'_>]) -> Result<String, String> {
    match arguments[0].number() {
        Some(number) if number < 100.0 => Ok(format!("TOOL {number} OF DRAWER 7")),
        _ => Err("this tool is in no drawer".into()),
    }
}

fn program() -> Result<Program, Error> {
    Program::builder()
        .ready("fanuc-mill")
        .option("style", "plain")
        .set_int("seqno.increment", 5)
        .fil("tools.fil", FIL)
        .function("TNAMEF", 1, tool_name)
        .limits(Limits { fuel: 1_000_000_000, output_bytes: 1 << 20, ..Limits::default() })
        .build()
}

fn post(program: &Program, tool: u32, token: &CancelToken) -> Result<Posted, Error> {
    let cl = CL.replace("LOADTL / 3", &format!("LOADTL / {tool}"));
    program.start().cl_name("part.ncl").cancel(token).keep_blocks().post(cl)
}

#[test]
fn a_host_posts_from_memory() -> Result<(), Error> {
    let (program, token) = (program()?, CancelToken::new());
    let posted = thread::scope(|scope| {
        let runs = [3, 4].map(|tool| {
            let (program, token) = (&program, &token);
            scope.spawn(move || post(program, tool, token))
        });
        runs.map(|run| run.join().expect("no panic"))
    });
    for (tool, posted) in (3..).zip(posted) {
        let posted = posted?;
        assert!(posted.text().contains(&format!("(TOOL {tool} OF DRAWER 7)")));
        assert!(posted.report().all_warnings().next().is_none());
        let of = |text: &str| posted.blocks().iter().find(|block| block.text.contains(text));
        let named = of("DRAWER").expect("the name");
        assert_eq!((named.origin.line, named.origin.fil[0].line), (2, 3), "by the third FIL line");
        let moved = of("X40.").expect("the motion");
        let x = moved.words.iter().find(|word| word.letter == 'X').expect("an X");
        assert_eq!((x.text(&moved.text), x.origin.line), ("X40.", 6));
    }
    Ok(())
}

#[test]
fn a_host_learns_what_is_wrong_and_can_stop() -> Result<(), Error> {
    let (program, token) = (program()?, CancelToken::new());
    let refused = post(&program, 100, &token).expect_err("no such tool").to_string();
    assert!(refused.contains("this tool is in no drawer"), "{refused}");
    assert!(refused.contains("tools.fil:2") && refused.contains("CL line 2"), "{refused}");
    assert!(refused.contains("\n  hint: "), "{refused}");
    let stop = token.clone();
    let stopped = thread::scope(|scope| {
        let run = scope.spawn(|| post(&program, 99, &token));
        stop.cancel();
        run.join().expect("no panic")
    });
    assert!(stopped.expect_err("cancelled").is_cancelled());
    Ok(())
}
