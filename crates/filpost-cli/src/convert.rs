//! `filpost cl --to ncl`

use std::io::{self, Seek};
use std::path::Path;

use filpost::cl::{to_ncl, words};
use filpost::{Error, Unit, files};

use crate::args::ClArgs;
use crate::output::{self, Target};
use crate::{Status, setup, summary};

/// Writes a CL file as one of Creo.
///
/// # Errors
/// A CL file that can't be read, or that Creo's text can't say; an output that can't be
/// written, or that is the input.
pub fn run(args: &ClArgs, cl: &Path) -> Result<Status, Error> {
    let input = output::open(cl)?;
    output::refuse_over([output::named(args.output.as_deref())], [cl])?;
    let options = setup::cl_options(args.encoding.as_deref(), &args.cl_reading, args.raw)?;
    let name = output::input_name(cl);
    let unit =
        args.units.units.map(|unit| if unit == Unit::Inch { words::INCHES } else { words::MM });
    let converted = Target::new(args.output.as_deref()).write(|out| {
        let named = args.output.as_deref().unwrap_or(Path::new(output::STANDARD_OUTPUT));
        let cant = |error: io::Error| files::cant_write(named, &error);
        let mut spool = output::temporary_file().map_err(cant)?;
        let converted = to_ncl(input, &name, options, unit, &mut spool).map_err(Error::Run)?;
        spool.rewind().and_then(|()| io::copy(&mut spool, out)).map_err(cant)?;
        Ok(converted)
    })?;
    let statements = summary::counted(converted.statements, "statement");
    output::say(&format!("{name}: {statements} written for Creo, dialect {}", converted.dialect));
    Ok(Status::Done)
}
