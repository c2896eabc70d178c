//! `fil-scripts/papers/deep-thread.fil`: what it writes is read back by an
//! expander of the control's thread cycles and cut in a section of the groove.

use std::cell::Cell;
use std::io::Cursor;

use filpost::{Error, Event, Program};
use filpost_simulation::thread::Thread;
use filpost_simulation::thread::random::{odd_threads, threads};
use filpost_simulation::thread::section::{self, Cut};
use filpost_simulation::thread::{cycles, drawing};
use filpost_tests::examples::{Block, blocks};
use filpost_tests::posting::with_script;
use filpost_tests::root;
use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

const SCRIPT: &str = "deep-thread.fil";

/// G76 in one block, as the printed script writes it.
const ONE_BLOCK: &[&str] = &["thread.cycle=3"];

/// Posts a CL file with scripts of the papers; the NC program, and the messages
/// of the listing.
fn post(scripts: &[&str], cl: &str) -> Result<(String, Vec<String>), Error> {
    post_with(ONE_BLOCK, scripts, cl)
}

/// The same on a lathe with these settings.
fn post_with(
    settings: &[&str],
    scripts: &[&str],
    cl: &str,
) -> Result<(String, Vec<String>), Error> {
    let mut builder = Program::builder().generic("fanuc-lathe");
    for setting in settings {
        builder = builder.set(setting);
    }
    for script in scripts {
        builder = with_script(builder, script, &text_of(script));
    }
    let mut nc = Vec::new();
    let mut messages = Vec::new();
    let run = builder.build()?.start().observe(|event| {
        if let Event::Message(text) = event {
            messages.push(text.to_string());
        }
    });
    run.stream_seekable(Cursor::new(cl.as_bytes()), &mut nc)?;
    Ok((String::from_utf8(nc).expect("an NC program is text"), messages))
}

/// A script of the papers.
fn text_of(script: &str) -> String {
    let path = root().join("fil-scripts/papers").join(script);
    std::fs::read_to_string(path).expect("a script")
}

fn written(thread: &Thread) -> String {
    post(&[SCRIPT], &thread.cl()).unwrap_or_else(|error| panic!("{error}\n{}", thread.cl())).0
}

fn judge(thread: &Thread, nc: &str) -> Result<Cut, String> {
    section::cut(thread, &cycles::read(nc)?)
}

/// The thread of the case deep-thread-worm.
fn worm() -> Thread {
    Thread {
        crest: 30.0,
        start: 20.0,
        end: -80.0,
        pitch: 12.0,
        starts: 1,
        first: 0.8,
        layers: vec![2.0, 2.0, 2.0],
        root: 3.0,
        angle: 40.0,
        end_flank: 20.0,
        nose: 2.4,
        tool_angle: 40.0,
        end_edge: 20.0,
        shift: 1.2,
        clearance: 2.0,
        finish: 0,
        internal: false,
        tolerance: 0.02,
    }
}

/// The thread of the case deep-thread-two-starts.
fn two_starts() -> Thread {
    Thread {
        crest: 25.0,
        start: 8.0,
        end: -40.0,
        pitch: 5.0,
        starts: 2,
        first: 0.5,
        layers: vec![1.0, 1.0],
        root: 1.6,
        angle: 30.0,
        end_flank: 15.0,
        nose: 1.2,
        tool_angle: 29.0,
        end_edge: 14.5,
        shift: 0.6,
        clearance: 1.5,
        finish: 2,
        internal: true,
        tolerance: 0.01,
    }
}

/// The thread of the case deep-thread-buttress.
fn buttress() -> Thread {
    Thread {
        angle: 33.0,
        end_flank: 3.0,
        tool_angle: 33.0,
        end_edge: 3.0,
        tolerance: 0.001,
        ..worm()
    }
}

/// The lines of a case.
fn case(name: &str, file: &str) -> String {
    let path = root().join("corpus/papers").join(name).join(file);
    std::fs::read_to_string(path).expect("a case of the corpus")
}

#[test]
fn the_cases_cut_their_profiles() {
    for (name, thread) in [
        ("worm", worm()),
        ("two-starts", Thread { finish: 0, ..two_starts() }),
        ("buttress", buttress()),
    ] {
        let nc = case(&format!("deep-thread-{name}"), "expected.nc");
        let cut = judge(&thread, &nc).unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("{name}: {cut:?}");
        assert!(cut.cutting > 20 && cut.chip > 0.0, "{cut:?}");
    }
}

/// Runs a property on 400 threads, or as many as FILPOST_THREADS says; other ones in each run.
fn for_each(threads: impl Strategy<Value = Thread>, holds: impl Fn(Thread) -> Result<(), String>) {
    let cases = filpost_simulation::jobs("FILPOST_THREADS", 400) as u32;
    let config = Config { cases, failure_persistence: None, ..Config::default() };
    let result =
        TestRunner::new(config).run(&threads, |thread| holds(thread).map_err(TestCaseError::fail));
    result.unwrap_or_else(|error| panic!("{error}"));
}

/// The passes of a program cut its thread.
fn cuts_right(thread: &Thread, nc: &str) -> Result<(), String> {
    judge(thread, nc).map(drop).map_err(|error| format!("{error}\n{}{nc}", thread.cl()))
}

#[test]
fn every_sound_thread_is_cut_to_its_profile() {
    for_each(threads(), |thread| cuts_right(&thread, &written(&thread)));
}

/// On a control of the other form too; without a least depth, so that the law holds.
#[test]
fn every_sound_thread_is_cut_by_g76_in_two_blocks() {
    for_each(threads(), |thread| {
        let (nc, _) = post_with(&["thread.least_depth=0"], &[SCRIPT], &thread.cl())
            .map_err(|error| error.to_string())?;
        assert!(nc.contains("G76 P010000 Q0 R0"), "{nc}");
        cuts_right(&thread, &nc)
    });
}

/// TRANS, the setting that moves the tape and X as a radius: the same thread elsewhere.
#[test]
fn a_thread_follows_what_shifts_the_program() {
    let thread = worm();
    let shifted = thread.cl().replacen("THREAD", "TRANS / 0, 0, 100\nTHREAD", 1);
    let settings = [ONE_BLOCK[0], "output.translate_z=-7"];
    let (nc, _) = post_with(&settings, &[SCRIPT], &shifted).expect("the thread is posted");
    let moved = Thread { start: thread.start + 93.0, end: thread.end + 93.0, ..thread.clone() };
    judge(&moved, &nc).expect("the thread lies there");
    let settings = [ONE_BLOCK[0], "lathe.diameter=0"];
    let (nc, _) = post_with(&settings, &[SCRIPT], &thread.cl()).expect("the thread is posted");
    assert!(nc.contains("X28. Z-80."), "{nc}");
    for (setting, cl) in [
        ("scale.z=-1", thread.cl()),
        ("thread.cycle=1", thread.cl()),
        (
            "thread.cycle=3",
            thread.cl().replacen(
                "THREAD",
                "TRANS / -1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0\nTHREAD",
                1,
            ),
        ),
    ] {
        let error = post_with(&[ONE_BLOCK[0], setting], &[SCRIPT], &cl).expect_err(setting);
        assert!(error.to_string().contains("E0325"), "{setting}: {error}");
    }
}

#[test]
fn an_odd_thread_is_refused_or_cut_right() {
    let (right, refused) = (Cell::new(0), Cell::new(0));
    for_each(odd_threads(), |thread| match post(&[SCRIPT], &thread.cl()) {
        Ok((nc, _)) => {
            right.set(right.get() + 1);
            cuts_right(&thread, &nc)
        }
        Err(error) if error.to_string().contains("E0325") => {
            refused.set(refused.get() + 1);
            Ok(())
        }
        Err(error) => Err(error.to_string()),
    });
    println!("{} threads cut, {} refused", right.get(), refused.get());
    assert!(right.get() > 20 && refused.get() > 20);
}

/// The program with one word changed, for each word of a motion and each change.
fn changed_words(nc: &str) -> Vec<(String, String)> {
    let change = |letter| match letter {
        'X' => [0.02, -0.02],
        'A' => [29.0, 60.0],
        _ => [0.01, -0.01],
    };
    let lines: Vec<&str> = nc.lines().collect();
    let mut found = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        if ![" G0 ", " G76 ", " G92 "].iter().any(|code| line.contains(code)) {
            continue;
        }
        for word in line.split(' ').filter(|word| !word.starts_with(['N', 'G'])) {
            let (letter, value) = (&word[..1], word[1..].parse::<f64>().expect("a number"));
            // Where X stands before the cycle does not change the thread.
            if letter == "X" && line.contains(" G0 ") {
                continue;
            }
            for delta in change(word.chars().next().expect("a letter")) {
                let block = line.replacen(word, &format!("{letter}{:.3}", value + delta), 1);
                let mut lines = lines.clone();
                lines[number] = &block;
                found.push((format!("{line} to {block}"), lines.join("\n")));
            }
        }
    }
    found
}

#[test]
fn a_changed_word_is_found() {
    for thread in [worm(), two_starts(), buttress()] {
        let nc = written(&thread);
        judge(&thread, &nc).expect("the program is right");
        let mutants = changed_words(&nc);
        println!("{} programs with one word changed", mutants.len());
        for (what, mutant) in mutants {
            assert!(judge(&thread, &mutant).is_err(), "{what} was not found");
        }
    }
}

#[test]
fn a_missing_block_is_found() {
    for thread in [worm(), two_starts()] {
        let nc = written(&thread);
        let whole = cycles::read(&nc).expect("the program is read");
        let cutting = judge(&thread, &nc).expect("the program is right").cutting;
        let lines: Vec<&str> = nc.lines().collect();
        let mut found = 0;
        for number in 0..lines.len() {
            let mut fewer = lines.clone();
            let block = fewer.remove(number);
            let fewer = fewer.join("\n");
            match judge(&thread, &fewer) {
                Err(_) => found += 1,
                // A block that says again where the tool is, or a pass that only cleans.
                Ok(cut) => {
                    let passes = cycles::read(&fewer).expect("it was judged").passes.len();
                    assert!(cut.cutting == cutting, "{block} was not missed");
                    assert!(whole.passes.len() - passes <= 1, "{block} was not missed");
                }
            }
        }
        println!("{found} of {} blocks are missed", lines.len());
        assert!(found > lines.len() / 2, "{found}");
    }
}

/// A script with one error writes a program that is found to be wrong.
#[test]
fn a_changed_script_is_found() {
    let script = text_of(SCRIPT);
    for (old, new) in [
        ("HDONE = HDONE + KLAY", "HDONE = KLAY"),
        ("LEAD = PTCH*NSTART", "LEAD = PTCH"),
        ("SIGNF(1,ZSTART-ZFAR)", "SIGNF(1,ZFAR-ZSTART)"),
        ("XWIDE*(XCREST+OUTWRD*CLRCE)", "XWIDE*(XCREST-OUTWRD*CLRCE)"),
        ("XWIDE*(XCREST-OUTWRD*HDONE)", "XWIDE*(XCREST+OUTWRD*HDONE)"),
        ("(HEIGHT-HDONE)*FLTWO - NOSE", "(HEIGHT-HDONE)*2*FLTWO - NOSE"),
        ("(HEIGHT-HDONE)*FLTWO - NOSE", "HEIGHT*FLTWO - NOSE"),
        ("FLTWO - NOSE", "FLTWO - NOSE/2"),
        ("FLMID = (HEIGHT-HDONE)*(FLTAN2-FLTAN1)/2", "FLMID = 0"),
        ("FLMID = (HEIGHT-HDONE)*(FLTAN2-FLTAN1)/2", "FLMID = HEIGHT*(FLTAN2-FLTAN1)/2"),
        ("FLTAN2 = TANF(ANGLE-FLEND)", "FLTAN2 = FLTAN1"),
        ("INTF(SPAN/MOST+0.999999)", "INTF(SPAN/MOST)+2"),
        ("CUTOFF = SPAN/NCUT", "CUTOFF = MOST"),
        ("(ISTART-1)*PTCH-SPAN/2+FLMID)\n  POSTN", "(ISTART-1)*PTCH-SPAN+FLMID)\n  POSTN"),
        ("(ISTART-1)*PTCH-SPAN/2+FLMID)\n  POSTN", "ISTART*CUTOFF-SPAN/2)\n  POSTN"),
        ("K,KLAY(ILAY),D,D1", "K,HDONE,D,D1"),
        ("K,KLAY(ILAY),D,D1", "K,KLAY(ILAY),D,2*D1"),
        ("DO/WIDENL,ICUT=0,NCUT", "DO/WIDENL,ICUT=0,NCUT-1"),
        ("ZFIRST + ZAWAY*ICUT*CUTOFF", "ZFIRST - ZAWAY*ICUT*CUTOFF"),
        ("DO/LASTL,ILAST=1,NLAST", "DO/LASTL,ILAST=1,NLAST-1"),
    ] {
        let changed = script.replacen(old, new, 1);
        assert_ne!(changed, script, "{old} is not there");
        let found = [worm(), two_starts(), buttress()].iter().any(|thread| {
            let post = Program::builder().generic("fanuc-lathe").set(ONE_BLOCK[0]);
            let post = with_script(post, SCRIPT, &changed).build();
            let post = post.as_ref().expect("the script is sound");
            let mut nc = Vec::new();
            let ran = post.stream_seekable(Cursor::new(thread.cl().as_bytes()), &mut nc);
            ran.is_ok() && judge(thread, &String::from_utf8_lossy(&nc)).is_err()
        });
        assert!(found, "{new} for {old} was not found");
    }
}

#[test]
fn rapid_motion_in_the_stock_is_found() {
    let thread = worm();
    let nc = written(&thread).replacen("X64.", "X59.", 1);
    assert!(judge(&thread, &nc).unwrap_err().contains("rapid"));
}

/// Programs made by hand that break one rule each.
#[test]
fn each_rule_of_the_section_can_fail() {
    let thread = worm();
    let nc = written(&thread);
    for (old, new, reason) in [
        ("K2. D0.8", "K1.5 D0.8", "pass 1 of G76"),
        ("F12.", "F24.", "lead"),
        ("Z-80.", "Z-81.", "ends at"),
        ("G76 X56. Z-80. K2.", "G76 X52. Z-80. K4.", "deeper than its law"),
        ("G0 Z19.415", "G0 Z20.585", "chip"),
        ("G0 Z19.415", "G0 Z19.215", "shifts from G76"),
        ("G0 Z21.756", "G0 Z21.8", "below the profile"),
        ("G0 Z21.756", "G0 Z20.585", "deeper than its law"),
    ] {
        let mutant = nc.replacen(old, new, 1);
        let error = judge(&thread, &mutant).unwrap_err();
        assert!(error.contains(reason), "{old} to {new}: {error}");
    }
    let ground = Thread { tolerance: 0.0, tool_angle: 29.0, angle: 30.0, ..two_starts() };
    let nc = written(&Thread { tolerance: 0.01, ..ground.clone() });
    assert!(judge(&ground, &nc).unwrap_err().contains("left on the flank"));
}

/// The record is in the unit of the CL file, and says so.
#[test]
fn a_thread_in_inches_is_cut_too() {
    let inches = |cl: &str| cl.replace("UNITS / MM", "UNITS / INCHES");
    let cl = inches(&worm().cl());
    let (nc, _) = post(&[SCRIPT], &cl.replace("MMPR", "IPR")).expect("the thread is posted");
    assert!(nc.contains("G20"), "{nc}");
    judge(&worm(), &nc).expect("the program is right");
    assert!(post(&[SCRIPT], &cl).unwrap_err().to_string().contains("lacks IPR"));
}

/// The table of the listing against the law D1*sqrt(i).
#[test]
fn the_listing_has_the_depths_of_g76() {
    let thread = worm();
    let (_, messages) = post(&[SCRIPT], &thread.cl()).expect("the thread is posted");
    let mut wanted = Vec::new();
    for (index, height) in thread.layers.iter().enumerate() {
        let depth = thread.floors()[index + 1];
        let (span, offset) = (thread.span(depth), thread.cut_offset(depth));
        wanted.push(format!(
            "LAYER {:>2}  K {height:.3}  X {:.3}  SHIFTS {}  CUT_OFFSET {offset:.3}",
            index + 1,
            2.0 * (thread.crest - depth),
            (span / offset).round(),
        ));
        wanted.push("  G76 PASS   DEPTH   ADDED".to_string());
        let mut before = 0.0;
        for pass in 1.. {
            let depth = (thread.first * f64::from(pass).sqrt()).min(*height);
            wanted.push(format!("  {pass:>8}{depth:>8.3}{:>8.3}", depth - before));
            before = depth;
            if depth >= *height {
                break;
            }
        }
    }
    assert_eq!(messages.join("\n"), wanted.join("\n"));
}

/// The blocks of the thread without their numbers.
fn thread_blocks(nc: &str) -> Vec<String> {
    let blocks = nc.lines().filter_map(|line| line.split_once(' ').map(|(_, block)| block));
    let of_thread =
        |block: &&str| ["G0 ", "G76 ", "G92 "].iter().any(|code| block.starts_with(code));
    blocks.filter(of_thread).map(str::to_string).collect()
}

/// Each layer said by the two records of the paper, to its two scripts as
/// published: one record to ours makes the same blocks.
#[test]
fn one_record_writes_what_the_published_scripts_write_layer_by_layer() {
    for starts in [1, 3] {
        let thread = Thread { starts, ..worm() };
        let mut cl = "PARTNO / 90\nUNITS / MM\nLOADTL / 3\nSPINDL / RPM, 200, CLW\n".to_string();
        for (index, height) in thread.layers.iter().enumerate() {
            let depth = thread.floors()[index + 1];
            let radius = thread.crest - depth;
            let (span, offset, end) = (thread.span(depth), thread.cut_offset(depth), thread.end);
            let shifts = (span / offset).round();
            for start in 0..starts {
                let z = thread.start + f64::from(start) * thread.pitch - span / 2.0;
                cl += &format!(
                    "THREAD / AUTO, {radius}, 0, {z}, TO, {radius}, 0, {end}, TPI, {lead}, $\n \
                     DEEP, {first}, LAST, 0, TYPE, 0, {height}, 0, IPM, 100, FEDTO, {clear}, OUT\n\
                     OP / THREAD, TURN, DEPTH, {offset}, TPI, {lead}, MULTRD, {shifts}, $\n \
                     CUTS, 1, FINCUT, 0, CUTANG, 0\n\
                     GOTO / {radius}, 0, {z}\nGOTO / {radius}, 0, {end}\n",
                    lead = thread.lead(),
                    first = thread.first,
                    clear = thread.clearance + depth,
                );
            }
        }
        cl += "FINI\n";
        let (published, _) = post(&["thread-g76.fil", "thread-g92.fil"], &cl).expect("posted");
        assert_eq!(thread_blocks(&written(&thread)), thread_blocks(&published));
    }
}

#[test]
fn bad_input_is_refused_in_clear_words() {
    let cl = worm().cl();
    for (old, new, message) in [
        ("MMPR, 12,", "", "THREAD lacks MMPR,pitch"),
        ("MMPR, 12", "TPI, 12", "TPI can mean two things here"),
        ("MMPR, 12", "MMPR, 0", "the pitch of 0 is not above zero"),
        ("MMPR, 12", "MMPR, 7", "the groove is 7.368 wide at the crest, the pitch is 7"),
        ("DEEP, 0.8, ", "", "THREAD lacks DEEP,first depth"),
        ("DEEP, 0.8", "DEEP, 0.1", "layer 1: more than 99 passes of G76"),
        ("TYPE, 0, 6, 40,", "TYPE, 0, 6,", "a number is missing in TYPE,0,height,angle"),
        ("TYPE, 0, 6", "TYPE, 0, 5", "the layers add up to 6, the height is 5"),
        ("TYPE, 0, 6, 40", "TYPE, 0, 6, 140", "profile angle 140: it must be from 0 to 120"),
        ("OUT,", "", "THREAD lacks OUT or IN"),
        ("OUT,", "FACE,", "after the / is misspelt"),
        ("TIMES, 1", "TIMES, 1.5", "TIMES 1.5 is no whole number 1 to 99"),
        ("OFSETL, 0, 1.2", "OFSETL, 0, 2.5", "a shift of 2.5 leaves a ridge behind a nose of 2.4"),
        ("OFSETL, 0, 1.2", "OFSETL, 3, 1.2", "OFSETL 3: the number must be 0"),
        ("LAYER, 2,2,2,", "", "THREAD lacks LAYER,k1,k2,"),
        ("LAYER, 2,2,2", "LAYER, 6,0", "a layer of 0 is not above zero"),
        ("WIDTH, 3", "WIDHT, 3", "THREAD lacks WIDTH,root"),
        ("WIDTH, 3", "WIDTH, 3, WIDTH, 2", "WIDTH,root is there twice"),
        ("TIMES, 1", "TIME, 1", "after the / is misspelt"),
        ("CUTTER, 2.4", "CUTTER, 3.1", "no pass fits: the tool nose is 3.1 wide, the root 3"),
        (
            "CUTTER, 2.4, 40",
            "CUTTER, 2.4, 60",
            "no pass fits: the tool has 60 degrees, the profile 40",
        ),
        ("CUTTER, 2.4, 40", "CUTTER, 2.4, 30", "layer 1 leaves 0.180 on the flank, TOLER is 0.02"),
        (
            "TO, 30, 0, -80",
            "TO, 28, 0, -80",
            "x1 30 and x2 28 make a cone, layers are for a cylinder",
        ),
        ("AUTO, 30, 0, 20, TO, 30", "AUTO, 5, 0, 20, TO, 5", "radius 5: no room to the axis"),
        ("TO, 30, 0, -80", "TO, 30, 0, 20", "z1 and z2 are both 20: the thread has no length"),
    ] {
        let bad = cl.replacen(old, new, 1);
        assert_ne!(bad, cl, "{old} is not there");
        let Err(error) = post(&[SCRIPT], &bad) else { panic!("{new} for {old} is not refused") };
        let text = error.to_string();
        assert!(text.contains("E0325") && text.contains(message), "{new} for {old}: {text}");
    }
}

/// The page shows the case, its program and its table.
#[test]
fn the_page_shows_what_is_written() {
    let page = std::fs::read_to_string(root().join("docs/papers/deep-thread.md")).expect("a page");
    let shown = |word: &str, heading: &str| {
        let fits = |block: &Block<'_>| block.words == [word] && block.heading == heading;
        blocks(&page).into_iter().find(fits).unwrap_or_else(|| panic!("no `{word}` block")).text
    };
    let cl = case("deep-thread-worm", "part.ncl");
    let (nc, messages) = post(&[SCRIPT], &cl).expect("the case is posted");
    assert_eq!(shown("text", "The CL file"), cl);
    assert_eq!(shown("nc", "The program"), nc);
    assert_eq!(shown("text", "The program"), messages.join("\n") + "\n");
}

#[test]
fn the_picture_of_the_docs_shows_these_passes() {
    let program = cycles::read(&written(&worm())).expect("the program is read");
    drawing::section(&worm(), &program).check(&root().join("docs/papers/deep-thread.svg"));
}
