//! `filpost simulate CASE`: the program that the post of a case makes, cut from the stock of the case.

use std::io::Cursor;

use filpost::case::Case;
use filpost::map::{MapReader, Names};
use filpost::nc::plot::Notes;
use filpost::plot::{self, Text};
use filpost::{Error, simulate};

use super::{Material, Places, cut, refuse_over, tell, without_stock};
use crate::args::SimulateArgs;
use crate::{Status, output};

/// Posts a case, and simulates its program.
///
/// # Errors
/// A case that can't be posted, a program that can't be simulated.
pub fn run(args: &SimulateArgs) -> Result<Status, Error> {
    let chosen = &args.chosen;
    if args.cl.is_some() || args.map.is_some() || chosen.post.is_some() || chosen.machine.is_some()
    {
        output::say("error: a case has its own CL file and post: leave out --cl, --map, -p and -m");
        return Ok(Status::Usage);
    }
    let case = Case::load(&args.nc)?;
    let program = case.program()?;
    let path = case.folder.join(&case.file.cl);
    let post: Vec<_> = case.file.machine.iter().map(|name| case.folder.join(name)).collect();
    let places = Places { files: vec![&path], post: &post, root: &case.folder };
    let Some(material) = Material::read(&args.material, program.commons(), &places)? else {
        return Ok(without_stock());
    };
    refuse_over(args, &material, case.files())?;
    let cl = case.cl_text()?;
    let names = Names { cl: case.file.cl.clone(), fil: program.fil_files(), ..Names::default() };
    let (mut bytes, mut map) = (Vec::new(), Vec::new());
    case.start(&program).run_mapped(Cursor::new(&cl), &mut bytes, &names, &mut map)?;
    let nc = Text { name: "the program of the case", bytes: &bytes };
    let found = case.start(&program).cl_tools(&cl)?;
    let mut done = cut(&material, &found, nc, program.commons(), &args.levels.levels)?;
    let mut notes = Notes::default();
    let name = "the line map of the case";
    plot::note_origins(&mut notes, nc, MapReader::new(name, Cursor::new(map))?, &mut |name| {
        if name == case.file.cl { Some(cl.clone()) } else { std::fs::read(name).ok() }
    })?;
    done.report.name_sources(&|line| simulate::source(&notes, line));
    tell(args, nc, &program, &case.folder.display().to_string(), &done)
}
