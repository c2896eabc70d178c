//! Setup files: stock, part, grid and tools of a job.

use fil_stock::errors::StockCode;
use fil_stock::{Tool, Tools, length};
use toml::{Table, Value};

use crate::error::Error;

/// What a setup file says. Lengths are mm.
#[derive(Clone, Debug, Default)]
pub struct Setup {
    /// A stock, or the name of an STL file beside the setup file.
    pub stock: Option<String>,
    /// The name of the STL file of the finished part, from the setup file on.
    pub part: Option<String>,
    /// How far a cut may be within the part, mm.
    pub part_tolerance: Option<f64>,
    /// The size of a cell, mm.
    pub grid: Option<f64>,
    /// By their numbers.
    pub tools: Tools,
}

impl Setup {
    /// Reads the text of a setup file; `name` is for messages.
    ///
    /// # Errors
    /// E0964 for what is no setup file.
    pub fn read(name: &str, text: &str) -> Result<Setup, Error> {
        let wrong =
            |what: String| Error::Run(StockCode::BadDescription.diag(format!("{name}: {what}")));
        let table: Table =
            text.parse().map_err(|error: toml::de::Error| wrong(error.message().into()))?;
        let mut setup = Setup::default();
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
