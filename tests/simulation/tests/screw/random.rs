//! Random jobs: each program is right, or the job is refused with reason.

use std::collections::BTreeMap;

use filpost_simulation::screw::{Job, random};

use filpost_tests::root;

use super::{post, post_changed, prove, reached};

/// What rounding a CL file to three decimals may do to a section, mm: each point moves
/// by up to 0.7 of a µm, an arc by that of its center and of its end.
const CUT_OFF: f64 = 0.0015;

/// What comes of a job: its kind of end, or what is wrong.
fn judge(job: &Job, cl: &Job) -> Result<&'static str, String> {
    let error = match post(cl) {
        Ok((nc, warnings)) => {
            return prove(job, &nc, &warnings, 0.01)
                .map(|_| "made")
                .map_err(|fault| fault + "\n" + &nc);
        }
        Err(error) => error.to_string(),
    };
    if error.contains("leaves a corner uncut") {
        let fits = job.cutters.iter().find(|c| c.ball && reached(job, c.diameter, -0.015));
        return match fits {
            Some(ball) => Err(format!("ball {} fits: {error}", ball.diameter)),
            None => Ok("no ball"),
        };
    }
    for (text, name) in [
        ("no end mill of the list fits", "no end mill"),
        ("the allowance fills the groove", "filled by the allowance"),
    ] {
        if error.contains(text) {
            return Ok(name);
        }
    }
    Err(error)
}

#[test]
fn random_jobs_are_right_or_refused() {
    let count = filpost_simulation::jobs("FILPOST_SCREWS", 50);
    let mut dice = random::Dice::new(filpost_simulation::seed(1));
    let mut ends = BTreeMap::new();
    let mut faults = Vec::new();
    for index in 0..count {
        let mut job = random::job(&mut dice);
        let mut cl = job.clone();
        // As computed, and as CL files with six and three decimals have it.
        match index % 3 {
            0 => {}
            1 => cl.section = job.section.cut_off(6),
            _ => {
                cl.section = job.section.cut_off(3);
                job.tolerance += CUT_OFF;
            }
        }
        match judge(&job, &cl) {
            Ok(end) => *ends.entry(end).or_insert(0) += 1,
            Err(fault) => {
                let first = fault.lines().next().unwrap_or_default().to_string();
                faults.push((index, first, format!("{}\n{fault}", cl.cl())));
            }
        }
    }
    let row = ["made", "no ball", "no end mill", "filled by the allowance"]
        .map(|end| ends.get(end).map_or("0".to_string(), ToString::to_string));
    let row = format!("| {count} | {} |\n", row.join(" | "));
    println!("{row}");
    for (index, first, _) in &faults {
        println!("job {index}: {first}");
    }
    if let Some((index, _, fault)) = faults.first() {
        panic!("{} of {count} jobs are wrong, the first is {index}:\n{fault}", faults.len());
    }
    if [50, 500].contains(&count) && !filpost_simulation::is_seeded() {
        let page = std::fs::read_to_string(root().join("docs/papers/screw.md")).expect("the page");
        assert!(page.contains(&row), "{row}");
    }
}

/// A post that plans wrongly refuses its own program: each change puts cutters where the
/// section does not allow them.
#[test]
fn the_script_finds_its_own_faults() {
    let changes = [
        ("rough.fil", "LVL(NLV) = XLEFT", "LVL(NLV) = XLEFT - 0.01", "a fault of the script"),
        ("rough.fil", "LVR(NLV) = XRIGHT", "LVR(NLV) = XRIGHT + 0.01", "a fault of the script"),
        ("rough.fil", "LVZ(NLV) = ZL", "LVZ(NLV) = ZL - 0.01", "a fault of the script"),
        ("section.fil", "ISMET = ABSF(ZL-WZ).LE.SWNEAR", "ISMET = 0", "no step of"),
        ("finish.fil", "BPX(NBP) = CTX", "BPX(NBP) = CTX + 0.01", "no ball of the list does"),
        ("finish.fil", "BPZ(NBP) = CTZ", "BPZ(NBP) = CTZ + 0.3", "no ball of the list does"),
        ("path.fil", "ISFREE = DIST.GT.PBR - SWFREE", "ISFREE = 1", "more than 2000 passes"),
        ("finish.fil", "SCALL = DIST", "SCALL = DIST/2", "no ball of the list does"),
    ];
    for (file, from, to, said) in changes {
        let (_, section) = super::sections().swap_remove(2);
        let error = post_changed(&Job::new(section, 30.0), Some((file, from, to)));
        let error = error.expect_err(to).to_string();
        assert!(error.contains(said), "{to}: {error}");
    }
}
