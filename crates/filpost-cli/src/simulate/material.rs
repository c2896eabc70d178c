//! Stock, part and tools: the command line over a setup file.

use std::path::{Path, PathBuf};

use filpost::stock::errors::StockCode;
use filpost::stock::{Mesh, Offsets, Stock, Tool, Tools, length};
use filpost::{Error, files};
use toml::{Table, Value};

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
        let setup = args.setup.as_deref().map(Setup::read).transpose()?.unwrap_or_default();
        let mut inputs: Vec<PathBuf> = args.setup.iter().cloned().collect();
        let Some(stock) = args.stock.clone().or(setup.stock) else { return Ok(None) };
        let stock = match Stock::read(&stock).map_err(Error::Run)? {
            Some(stock) => stock,
            None => {
                let path =
                    if args.stock.is_some() { stock.into() } else { setup.folder.join(stock) };
                inputs.push(path);
                Stock::Mesh(mesh(&inputs[inputs.len() - 1])?)
            }
        };
        let part = args.part.clone().or(setup.part.map(|part| setup.folder.join(part)));
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

fn mesh(path: &Path) -> Result<Mesh, Error> {
    Mesh::read(&path.display().to_string(), &read(path)?).map_err(Error::Run)
}

/// A setup file.
#[derive(Default)]
struct Setup {
    folder: PathBuf,
    stock: Option<String>,
    part: Option<String>,
    part_tolerance: Option<f64>,
    grid: Option<f64>,
    tools: Tools,
}

impl Setup {
    fn read(path: &Path) -> Result<Setup, Error> {
        let text = files::read_text(path, None)?;
        let wrong = |what: String| {
            Error::Run(StockCode::BadDescription.diag(format!("{}: {what}", path.display())))
        };
        let table: Table =
            text.parse().map_err(|error: toml::de::Error| wrong(error.message().into()))?;
        let mut setup = Setup {
            folder: path.parent().map(Path::to_path_buf).unwrap_or_default(),
            ..Setup::default()
        };
        for (key, value) in &table {
            setup.take(key, value).map_err(&wrong)?;
        }
        Ok(setup)
    }

    fn take(&mut self, key: &str, value: &Value) -> Result<(), String> {
        let text = || value.as_str().map(String::from).ok_or(format!("{key} is a text"));
        let size = || {
            let given = value.as_str().map_or_else(|| value.to_string(), String::from);
            length(&given).ok_or(format!("{key} is a length above 0"))
        };
        match key {
            "stock" => self.stock = Some(text()?),
            "part" => self.part = Some(text()?),
            "part_tol" => self.part_tolerance = Some(size()?),
            "grid" => self.grid = Some(size()?),
            "tools" => {
                for (number, size) in value.as_table().ok_or("tools is a table")? {
                    let given = number.parse().ok().zip(size.as_str());
                    let (number, size) = given
                        .ok_or(format!("tools.{number} is a number with a text: 1 = \"D10\""))?;
                    self.tools.insert(number, Tool::read(size).map_err(|diag| diag.message)?);
                }
            }
            _ => return Err(format!("{key} is none of stock, part, part_tol, grid and tools")),
        }
        Ok(())
    }
}
