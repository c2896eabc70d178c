//! Times two loops of ten million passes and a short section:
//! `cargo run --release -p fil-vm --example loop`.

use std::sync::Arc;
use std::time::Instant;

use fil_cl::{Record, Vocabulary};
use fil_diag::Diag;
use fil_vm::{CommonKind, FilFile, Functions, Host, Limits, LoadOptions, Machine, Site, load};

/// A host that nothing is asked of.
struct NoHost;

impl Host for NoHost {
    fn common(&mut self, _: CommonKind, _: u32) -> Result<f64, Box<Diag>> {
        Ok(0.0)
    }
    fn set_common(&mut self, _: CommonKind, _: u32, _: f64) -> Result<(), Box<Diag>> {
        Ok(())
    }
    fn clear_common(&mut self, _: CommonKind, _: u32) -> Result<(), Box<Diag>> {
        Ok(())
    }
    fn command(&mut self, _: &Record, _: &mut Vocabulary, _: &Site) -> Result<(), Box<Diag>> {
        Ok(())
    }
    fn next_record(&mut self, _: &mut Record, _: &mut Vocabulary) -> Result<bool, Box<Diag>> {
        Ok(false)
    }
    fn seek_record(
        &mut self,
        _: u32,
        _: &mut Record,
        _: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        Ok(false)
    }
    fn warn(&mut self, diag: Diag) {
        eprintln!("{diag}");
    }
    fn trace(&mut self, _: bool) {}
}

const DO_LOOP: &str = "
XX=0
NN=0
DO/LA,II=1,10000000
XX=XX+II*2
IF(XX.GT.1000000)THEN
XX=XX-1000000
NN=NN+1
ENDIF
LA) CONTIN
FINI
";

const JUMP_LOOP: &str = "
XX=0
II=1
LA) XX=XX+II*2
IF(XX.GT.1000000)XX=XX-1000000
II=II+1
IF(II.LE.10000000)JUMPTO/LA
FINI
";

/// About twenty operations, as a section for motions has them.
const SECTION: &str = "
MAXX=0
CIMFIL/ON,GOTO
XX=POSTF(7,6)
YY=POSTF(7,7)
ZZ=POSTF(7,8)
RR=XX*XX+YY*YY
IF(RR.GT.MAXX)MAXX=RR
IF(ZZ.LT.0)THEN
DD=-ZZ*2+1
ELSE
DD=ZZ*2+1
ENDIF
CASE/DD
WHEN/1,2
EE=1
WHEN/3
EE=2
WHEN/OTHER
EE=XX+YY+ZZ
ENDCAS
CIMFIL/OFF
FINI
";

fn time_section() {
    const RUNS: u32 = 5_000_000;
    let mut vocab = Vocabulary::new();
    let files = [FilFile { name: "section", text: SECTION }];
    let Ok(loaded) = load(&files, &mut vocab, LoadOptions::default()) else {
        unreachable!("the section is right")
    };
    let mut machine = Machine::new(Arc::new(loaded.module), Limits::default(), Functions::new());
    if let Err(diag) = machine.run_globals(&mut vocab, &mut NoHost) {
        eprintln!("{diag}");
    }
    let mut record = Record::goto([1.0, 2.0, 3.0], None);
    let start = Instant::now();
    for _ in 0..RUNS {
        let found = machine.module().find(&record, &vocab);
        let run = found.map(|id| machine.run_section(id, &mut record, &mut vocab, &mut NoHost));
        if let Some(Err(diag)) = run {
            eprintln!("{diag}");
        }
    }
    let each = start.elapsed().as_secs_f64() / f64::from(RUNS);
    println!("section: {:.1} ns a record", each * 1e9);
}

fn main() {
    time_section();
    for (name, text) in [("DO", DO_LOOP), ("JUMPTO", JUMP_LOOP)] {
        let mut vocab = Vocabulary::new();
        let files = [FilFile { name, text }];
        let loaded = match load(&files, &mut vocab, LoadOptions::default()) {
            Ok(loaded) => loaded,
            Err(diags) => {
                diags.iter().for_each(|diag| eprintln!("{diag}"));
                std::process::exit(1);
            }
        };
        let module = Arc::new(loaded.module);
        let mut best = f64::INFINITY;
        for _ in 0..5 {
            let mut machine = Machine::new(module.clone(), Limits::default(), Functions::new());
            let start = Instant::now();
            if let Err(diag) = machine.run_globals(&mut vocab, &mut NoHost) {
                eprintln!("{diag}");
                std::process::exit(1);
            }
            best = best.min(start.elapsed().as_secs_f64());
            println!("{name}: XX = {:?}", machine.number("XX"));
        }
        println!("{name}: {best:.3} s");
    }
}
