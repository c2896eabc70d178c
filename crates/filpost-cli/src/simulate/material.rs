//! Stock, part and tools: the command line over a setup file.

use std::path::{Path, PathBuf};

use filpost::simulate::Setup;
use filpost::stock::{Mesh, Offsets, Stock, Tools};
use filpost::{Error, files};

use super::read;
use crate::args::MaterialArgs;

/// How far a cut may be within the part where nothing else is given, mm.
const PART_TOLERANCE: f64 = 0.05;

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

impl Material {
    /// The stock of the options and the setup file; `None` when neither gives one.
    ///
    /// # Errors
    /// Files that can't be read, E0964, E0965.
    pub fn read(args: &MaterialArgs) -> Result<Option<Material>, Error> {
        let folder = args.setup.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
        let setup = args.setup.as_deref().map(setup).transpose()?.unwrap_or_default();
        let mut inputs: Vec<PathBuf> = args.setup.iter().cloned().collect();
        let Some(stock) = args.stock.clone().or(setup.stock) else { return Ok(None) };
        let stock = match Stock::read(&stock).map_err(Error::Run)? {
            Some(stock) => stock,
            None => {
                let path = if args.stock.is_some() { stock.into() } else { folder.join(stock) };
                inputs.push(path);
                Stock::Mesh(mesh(&inputs[inputs.len() - 1])?)
            }
        };
        let part = args.part.clone().or(setup.part.map(|part| folder.join(part)));
        inputs.extend(part.clone());
        let mut tools = setup.tools;
        tools.extend(args.tool.iter().cloned());
        Ok(Some(Material {
            stock,
            part: part.as_deref().map(mesh).transpose()?,
            part_tolerance: args.part_tol.or(setup.part_tolerance).unwrap_or(PART_TOLERANCE),
            grid: args.grid.or(setup.grid),
            tools,
            offsets: args.offset.iter().copied().collect(),
            inputs,
        }))
    }
}

fn setup(path: &Path) -> Result<Setup, Error> {
    Setup::read(&path.display().to_string(), &files::read_text(path, None)?)
}

fn mesh(path: &Path) -> Result<Mesh, Error> {
    Mesh::read(&path.display().to_string(), &read(path)?).map_err(Error::Run)
}
