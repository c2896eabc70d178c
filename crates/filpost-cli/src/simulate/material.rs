//! Stock, part and tools: the command line over a setup file, over `[simulate]` of a case or of the
//! machine.

use std::path::{Path, PathBuf};

use filpost::case::Case;
use filpost::simulate::{Setup, stock_of};
use filpost::stock::{Mesh, Offsets, Stock, Tools};
use filpost::{Commons, Error, files};

use super::read;
use crate::args::MaterialArgs;
use crate::output;

/// How far a cut may be within the part where nothing else is given, mm.
const PART_TOLERANCE: f64 = 0.05;

/// The setup file that is looked for next to a part, and next to a machine.
const SETUP: &str = "stock.toml";

/// What a program is simulated with.
pub struct Material {
    /// The stock.
    pub stock: Stock,
    /// The finished part.
    pub part: Option<Mesh>,
    /// mm
    pub part_tolerance: f64,
    /// mm
    pub grid: Option<f64>,
    /// By their numbers.
    pub tools: Tools,
    /// Where further work offsets lie.
    pub offsets: Offsets,
    /// All files it was read from.
    pub inputs: Vec<PathBuf>,
}

/// Where a setup is looked for that the command line does not name.
pub struct Places<'a> {
    /// The CL file and the NC program, as far as there are any: a setup is next to one of them.
    pub files: Vec<&'a Path>,
    /// The files of the post: a setup may be next to its machine.
    pub post: &'a [PathBuf],
    /// The folder that the name of the machine file counts from.
    pub root: &'a Path,
}

impl Material {
    /// The stock of the options, else of the setup file, else of the machine; `None` when none of
    /// them gives one.
    ///
    /// # Errors
    /// Files that can't be read, E0705, E0964, E0965.
    pub fn read(
        args: &MaterialArgs,
        commons: &Commons,
        places: &Places<'_>,
    ) -> Result<Option<Material>, Error> {
        let named = |file: &str, name: &str| {
            let folder = Path::new(file).parent().unwrap_or(Path::new(""));
            places.root.join(folder).join(name).display().to_string()
        };
        let of_machine = Setup::of_machine(commons, &named).map_err(Error::Setup)?;
        let found = match &args.setup {
            Some(path) => Some((path.clone(), setup(path)?)),
            None => places.find()?,
        };
        let (file, setup) = found.unzip();
        let folder = file.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
        let setup = setup.flatten().unwrap_or_default();
        let setup = setup.with_paths(&|name| folder.join(name).display().to_string());
        let setup = setup.or(of_machine);
        let mut inputs: Vec<PathBuf> = file.into_iter().collect();
        let given = args.stock.clone().flatten();
        let Some(stock) = given.or(setup.stock) else { return Ok(None) };
        let stock = match stock_of(&stock)? {
            Some(stock) => stock,
            None => {
                inputs.push(stock.into());
                Stock::Mesh(mesh(&inputs[inputs.len() - 1])?)
            }
        };
        let part = args.part.clone().or(setup.part.map(PathBuf::from));
        inputs.extend(part.clone());
        let (mut tools, mut offsets) = (setup.tools, setup.offsets);
        tools.extend(args.tool.iter().cloned());
        offsets.extend(args.offset.iter().copied());
        Ok(Some(Material {
            stock,
            part: part.as_deref().map(mesh).transpose()?,
            part_tolerance: args.part_tol.or(setup.part_tolerance).unwrap_or(PART_TOLERANCE),
            grid: args.grid.or(setup.grid),
            tools,
            offsets,
            inputs,
        }))
    }
}

impl Places<'_> {
    /// The setup next to the CL file or the program: stock.toml, or `[simulate]` of the case.toml
    /// that names it; else stock.toml next to the machine.
    fn find(&self) -> Result<Option<(PathBuf, Option<Setup>)>, Error> {
        let found = self.look()?;
        if let Some((path, _)) = &found {
            output::say(&format!("setup: {}", path.display()));
        }
        Ok(found)
    }

    fn look(&self) -> Result<Option<(PathBuf, Option<Setup>)>, Error> {
        for file in &self.files {
            let folder = file.parent().unwrap_or(Path::new(""));
            let path = folder.join(SETUP);
            if path.is_file() {
                let found = setup(&path)?;
                return Ok(Some((path, found)));
            }
            let path = folder.join("case.toml");
            if !path.is_file() {
                continue;
            }
            let case = Case::load(folder)?.file;
            let name = file.file_name().and_then(|name| name.to_str());
            let names = [Some(case.cl.as_str()), case.expect.as_deref()];
            if case.simulate.is_some() && name.is_some() && names.contains(&name) {
                return Ok(Some((path, case.simulate)));
            }
        }
        let machine = self.post.first().and_then(|machine| machine.parent());
        let Some(path) = machine.map(|folder| folder.join(SETUP)).filter(|path| path.is_file())
        else {
            return Ok(None);
        };
        let found = setup(&path)?;
        Ok(Some((path, found)))
    }
}

fn setup(path: &Path) -> Result<Option<Setup>, Error> {
    Setup::read(&path.display().to_string(), &files::read_text(path, None)?).map(Some)
}

fn mesh(path: &Path) -> Result<Mesh, Error> {
    Mesh::read(&path.display().to_string(), &read(path)?).map_err(Error::Run)
}
