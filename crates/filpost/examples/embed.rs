//! Posts a CL file with one FIL section and a function of this program, and
//! says of each block what made it.

use filpost::{Argument, Program};

const CL: &str =
    "UNITS / MM\nLOADTL / 3\nFEDRAT / 300, MMPM\nGOTO / 0, 0, 5\nGOTO / 40, 0, 5\nFINI\n";

const FIL: &str = "
CIMFIL/ON,LOADTL
LIFE=TLIFEF(POSTF(7,4))         $$ a function of the program around it
IF(LIFE.LT.10) STOP
DMY=POSTF(13)
CIMFIL/OFF
FINI
";

fn main() -> Result<(), filpost::Error> {
    let tool_life = |arguments: &[Argument<'_>]| match arguments[0].number() {
        Some(3.0) => Ok(8.0),
        Some(_) => Ok(60.0),
        None => Err("a tool number is needed".into()),
    };
    let program = Program::builder()
        .ready("fanuc-mill")
        .fil("life.fil", FIL)
        .function("TLIFEF", 1, tool_life)
        .build()?;
    for block in program.blocks(CL.as_bytes()) {
        let block = block?;
        println!("{:<36} CL line {}, FIL {:?}", block.text, block.origin.line, block.origin.fil);
    }
    Ok(())
}
