//! What a job is cut from and with: setup files, `[simulate]` of `case.toml` and of a machine.

use fil_diag::Diag;
use fil_diag::suggest::did_you_mean;
use fil_machine::commons::Commons;
use fil_nc::motion::work_offset;
use fil_stock::errors::StockCode;
use fil_stock::{Offsets, Stock, Tool, Tools, length, place};
use toml::{Table, Value};

use crate::error::Error;

/// Keys of a setup file.
const KEYS: [&str; 6] = ["stock", "part", "part_tol", "grid", "tools", "offsets"];

/// What a setup file, `[simulate]` of a `case.toml` or of a machine gives. Lengths are mm.
#[derive(Clone, Debug, Default)]
pub struct Setup {
    /// A stock, or the name of an STL file, from the file with the setup on.
    pub stock: Option<String>,
    /// The name of the STL file of the finished part, from the file with the setup on.
    pub part: Option<String>,
    /// Depth that a cut may be within the part, mm.
    pub part_tolerance: Option<f64>,
    /// The size of a cell, mm.
    pub grid: Option<f64>,
    /// By their numbers.
    pub tools: Tools,
    /// Zeros of further work offsets, mm in the first one.
    pub offsets: Offsets,
}

impl Setup {
    /// Reads the text of a setup file; `name` is for messages.
    ///
    /// # Errors
    /// E0965 for what is no setup file.
    pub fn read(name: &str, text: &str) -> Result<Setup, Error> {
        let wrong =
            |what: String| Error::Run(StockCode::BadDescription.diag(format!("{name}: {what}")));
        let table: Table =
            text.parse().map_err(|error: toml::de::Error| wrong(error.message().into()))?;
        Setup::of_table(&table).map_err(wrong)
    }

    /// Reads a table with the keys of a setup file, such as `[simulate]` of a `case.toml`.
    ///
    /// # Errors
    /// What is wrong with it.
    #[doc(hidden)]
    pub fn of_table(table: &Table) -> Result<Setup, String> {
        let mut setup = Setup::default();
        for (key, value) in table {
            match (key.as_str(), value) {
                ("tools" | "offsets", Value::Table(inner)) => {
                    for (name, value) in inner {
                        setup.take(&format!("{key}.{name}"), &shown(value, false)?)?;
                    }
                }
                ("part_tol" | "grid", value) => setup.take(key, &shown(value, true)?)?,
                _ => {
                    let value = shown(value, false).map_err(|what| format!("{key}: {what}"));
                    setup.take(key, &value?)?;
                }
            }
        }
        Ok(setup)
    }

    /// What `[simulate]` of a machine gives; `named` makes a path from the name of the machine file
    /// and that of an STL file in it.
    ///
    /// # Errors
    /// E0965 for each value that is no stock, length, tool or place.
    #[doc(hidden)]
    pub fn of_machine(
        commons: &Commons,
        named: &dyn Fn(&str, &str) -> String,
    ) -> Result<Setup, Vec<Diag>> {
        let mut setup = Setup::default();
        let mut wrong = Vec::new();
        for setting in commons.simulate().all() {
            let name = |value: &str| match setting.key.as_str() {
                "part" => named(&setting.place.file, value),
                "stock" if is_mesh(value) => named(&setting.place.file, value),
                _ => value.to_string(),
            };
            if let Err(what) = setup.take(&setting.key, &name(&setting.value)) {
                wrong.push(StockCode::BadDescription.diag(what).at(setting.place.clone()));
            }
        }
        if wrong.is_empty() { Ok(setup) } else { Err(wrong) }
    }

    /// The same with paths made of the names of its STL files.
    #[must_use]
    #[doc(hidden)]
    pub fn with_paths(mut self, path: &dyn Fn(&str) -> String) -> Setup {
        self.stock = self.stock.map(|stock| if is_mesh(&stock) { path(&stock) } else { stock });
        self.part = self.part.map(|part| path(&part));
        self
    }

    /// This setup where it gives something, else the other one.
    #[must_use]
    #[doc(hidden)]
    pub fn or(self, other: Setup) -> Setup {
        let Setup { mut tools, mut offsets, .. } = other;
        tools.extend(self.tools);
        offsets.extend(self.offsets);
        Setup {
            stock: self.stock.or(other.stock),
            part: self.part.or(other.part),
            part_tolerance: self.part_tolerance.or(other.part_tolerance),
            grid: self.grid.or(other.grid),
            tools,
            offsets,
        }
    }

    fn take(&mut self, key: &str, value: &str) -> Result<(), String> {
        let size = || length(value).ok_or(format!("{key} = `{value}` is no length above 0"));
        match key.split_once('.') {
            Some(("tools", number)) => {
                let wrong = || {
                    format!("tools.{number}: the key of a tool is its number, as in 1 = \"D10\"")
                };
                let number = number.parse().map_err(|_| wrong())?;
                let tool = Tool::read(value).map_err(|diag| diag.message)?;
                self.tools.insert(number, tool);
                return Ok(());
            }
            Some(("offsets", name)) => {
                let wrong = || {
                    format!(
                        "offsets.{name}: write a work offset and its zero, as in G55 = \"60,0,0\""
                    )
                };
                let offset = work_offset(name).ok_or_else(wrong)?;
                self.offsets.insert(offset, place(value).ok_or_else(wrong)?);
                return Ok(());
            }
            _ => {}
        }
        match key {
            "stock" => {
                if !is_mesh(value) {
                    Stock::read(value)
                        .map_err(|diag| diag.message)?
                        .ok_or_else(|| no_stock(value))?;
                }
                self.stock = Some(value.to_string());
            }
            "part" if is_mesh(value) => self.part = Some(value.to_string()),
            "part" => return Err(format!("part = `{value}` is no name of an .stl file")),
            "part_tol" => self.part_tolerance = Some(size()?),
            "grid" => self.grid = Some(size()?),
            _ => {
                let meant =
                    did_you_mean(key, KEYS).map_or(String::new(), |hint| format!(" ({hint})"));
                return Err(format!("{key} is none of {}{meant}", KEYS.join(", ")));
            }
        }
        Ok(())
    }
}

/// A value of TOML as text; a number only where it may be one.
fn shown(value: &Value, takes_number: bool) -> Result<String, String> {
    match value {
        Value::String(text) => Ok(text.clone()),
        Value::Integer(_) | Value::Float(_) if takes_number => Ok(value.to_string()),
        other => Err(format!("`{other}` is no text; put quotes around it")),
    }
}

/// True for the name of an STL file.
pub(super) fn is_mesh(text: &str) -> bool {
    text.trim_end().to_ascii_lowercase().ends_with(".stl")
}

/// Why a text is no stock.
fn no_stock(text: &str) -> String {
    let kind = text.split([' ', ':']).next().unwrap_or_default();
    let meant = did_you_mean(kind, ["box", "cylinder", "tube", "auto"]);
    let meant = meant.map_or(String::new(), |hint| format!("; {hint}"));
    format!("stock `{text}` is no box, cylinder, tube, auto or .stl file{meant}")
}

/// The stock that a text describes; `None` for the name of an STL file.
///
/// # Errors
/// E0965
pub fn stock_of(text: &str) -> Result<Option<Stock>, Error> {
    if is_mesh(text) {
        return Ok(None);
    }
    let stock = Stock::read(text).map_err(Error::Run)?;
    stock.map(Some).ok_or_else(|| Error::Run(StockCode::BadDescription.diag(no_stock(text))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_and_values_are_checked() {
        let right = "stock = 'box:60x40x20'\npart = 'a.STL'\ngrid = 0.5\npart_tol = '0.01in'\n\
                     tools.1 = 'D10'\n[offsets]\nG55 = '60,0,0'\n\"G54.1P3\" = '0,1,0in'\n";
        let setup = Setup::read("job.toml", right).expect("a setup");
        assert_eq!((setup.grid, setup.part_tolerance), (Some(0.5), Some(0.254)));
        assert_eq!(setup.offsets[&541_003], [0.0, 25.4, 0.0]);
        for (text, what) in [
            ("stok = 'auto'", "did you mean stock?"),
            ("stock = 'cylindr 10x10'", "did you mean cylinder?"),
            ("stock = 5", "no text"),
            ("part = 'a.step'", "no name of an .stl file"),
            ("grid = true", "no text"),
            ("grid = -1", "no length"),
            ("tools.A = 'D5'", "is its number"),
            ("tools.1 = 5", "no text"),
            ("tools = 'D5'", "tools is none of"),
            ("offsets.55 = '0,0,0'", "a work offset and its zero"),
            ("offsets.G55 = '0,0'", "a work offset and its zero"),
        ] {
            let error = Setup::read("job.toml", text).expect_err(text);
            let message = error.to_string();
            assert!(message.contains(what), "{text}: {message}");
        }
    }

    #[test]
    fn a_setup_goes_before_another_key_by_key() {
        let one = Setup::read("a", "stock = 'auto'\ntools.1 = 'D10'\n").expect("a setup");
        let other =
            Setup::read("b", "stock = 'b.stl'\npart = 'b.stl'\ntools = { 1 = 'D8', 2 = 'D6' }\n")
                .expect("a setup");
        let both = one.or(other.with_paths(&|name| format!("top/{name}")));
        assert_eq!(
            (both.stock.as_deref(), both.part.as_deref()),
            (Some("auto"), Some("top/b.stl"))
        );
        assert_eq!(both.tools[&1], Tool::read("D10").expect("a tool"));
        assert_eq!(both.tools.len(), 2);
    }
}
