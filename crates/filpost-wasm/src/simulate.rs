//! Material removal by a program.

use filpost::cl::reader::Options;
use filpost::plot::{ClText, Text};
use filpost::simulate::{Setup, as_json, cl_tools, stock_of};
use filpost::stock::errors::StockCode;
use filpost::stock::{Job, Left, Mesh, Stock, Tool, Tools, length};
use filpost::{Commons, Error, simulate};
use serde_json::{Value, json};

use crate::fields::{Fields, Named};
use crate::machine::MachineOf;
use crate::{Fault, Misuse, refused};

/// How far a cut may be within the part, mm.
const PART_TOLERANCE: f64 = 0.05;

/// A request to simulate: the machine, the program, the stock and the tools.
pub(crate) struct Simulate {
    machine: MachineOf,
    nc: String,
    cl: Option<Named>,
    setup: Option<Named>,
    case: Option<Named>,
    stock: Option<String>,
    part: Option<Named>,
    /// The meshes that the setup file names.
    meshes: Vec<Named>,
    tools: Vec<String>,
    grid: Option<String>,
    heights: bool,
}

impl Simulate {
    pub fn read(mut fields: Fields) -> Result<Self, Misuse> {
        let simulate = Simulate {
            machine: MachineOf::read(&mut fields)?,
            nc: fields.needed("nc")?,
            cl: fields.file("cl")?,
            setup: fields.file("setup")?,
            case: fields.file("case")?,
            stock: fields.text("stock")?,
            part: fields.file("part")?,
            meshes: fields.files("meshes")?,
            tools: fields.texts("tools")?,
            grid: fields.text("grid")?,
            heights: fields.flag("heights")?,
        };
        fields.end()?;
        Ok(simulate)
    }

    /// The answer: the report, with `heights` if they are asked for; or `errors`.
    pub fn run(&self) -> Value {
        match self.cut() {
            Ok(report) => report,
            Err(error) => refused(&Fault::Setup(error), &[]),
        }
    }

    fn cut(&self) -> Result<Value, Error> {
        let commons = self.machine.builder().build_machine()?;
        let wrong = |what: String| Error::Run(StockCode::BadDescription.diag(what));
        let setup = self.setup(&commons)?;
        let given = self.stock.as_ref().or(setup.stock.as_ref());
        let given = given.ok_or_else(|| wrong("there is no stock".into()))?;
        let stock = match stock_of(given)? {
            Some(stock) => stock,
            None => Stock::Mesh(self.mesh(given)?),
        };
        let grid = self.grid.as_deref().map(|grid| {
            length(grid).ok_or_else(|| wrong(format!("grid `{grid}` is no length above 0")))
        });
        let part = match (&self.part, &setup.part) {
            (Some(part), _) => Some(read_mesh(part)?),
            (None, Some(name)) => Some(self.mesh(name)?),
            (None, None) => None,
        };
        let mut tools = match &self.cl {
            None => Tools::new(),
            Some(Named { name, text }) => {
                let text = Text { name, bytes: text.as_bytes() };
                cl_tools(&ClText { text, options: Options::default(), unit: None }, &commons)?.tools
            }
        };
        tools.extend(setup.tools);
        for tool in &self.tools {
            let given = tool
                .split_once('=')
                .and_then(|(number, size)| Some((number.trim().parse().ok()?, size)));
            let (number, size) =
                given.ok_or_else(|| wrong(format!("tool `{tool}` is none as 1=D10R0.5")))?;
            tools.insert(number, Tool::read(size).map_err(Error::Run)?);
        }
        let job = Job {
            stock: &stock,
            tools: &tools,
            part: part.as_ref(),
            part_tolerance: setup.part_tolerance.unwrap_or(PART_TOLERANCE),
            grid: grid.transpose()?.or(setup.grid),
            offsets: &setup.offsets,
            levels: commons.levels(),
        };
        let nc = filpost::tape_style::page(&commons).encode(&self.nc);
        let bytes = nc.as_deref().unwrap_or(self.nc.as_bytes());
        let done = simulate::program(Text { name: "the program", bytes }, &commons, &job)?;
        let mut answer = as_json(&done.report);
        if self.heights {
            match &done.left {
                Left::Field(field) => {
                    let grid = field.grid();
                    answer["grid"] = json!({
                        "origin": grid.origin, "step": grid.step, "columns": grid.columns, "rows": grid.rows,
                    });
                    answer["heights"] = json!(field.tops());
                    answer["lowest"] = json!(field.lowest());
                }
                Left::Profile(profile) => {
                    answer["disks"] = json!(profile.disks());
                    answer["from"] = json!(profile.middle(0) - profile.step() / 2.0);
                    answer["step"] = json!(profile.step());
                }
            }
        }
        Ok(answer)
    }

    /// The setup file, else `[simulate]` of the case, over that of the machine. Names of meshes are
    /// paths from the folder that the names of the files count from.
    fn setup(&self, commons: &Commons) -> Result<Setup, Error> {
        let of_machine =
            Setup::of_machine(commons, &|file, name| joined(file, name)).map_err(Error::Setup)?;
        let (file, setup) = match (&self.setup, &self.case) {
            (Some(file), _) => (file, Setup::read(&file.name, &file.text)?),
            (None, Some(file)) => (file, of_case(file)?),
            (None, None) => return Ok(of_machine),
        };
        Ok(setup.with_paths(&|name| joined(&file.name, name)).or(of_machine))
    }

    /// A mesh by its path, or by its name in the setup file.
    fn mesh(&self, name: &str) -> Result<Mesh, Error> {
        let beside = |mesh: &Named| self.setup.as_ref().map(|file| joined(&file.name, &mesh.name));
        let is = |mesh: &&Named| mesh.name == name || beside(mesh).is_some_and(|path| path == name);
        match self.meshes.iter().find(is) {
            Some(mesh) => read_mesh(mesh),
            None => {
                let what = format!("`{name}` is no stock, and no STL file that is there");
                Err(Error::Run(StockCode::BadDescription.diag(what)))
            }
        }
    }
}

/// `[simulate]` of a `case.toml`.
fn of_case(file: &Named) -> Result<Setup, Error> {
    let wrong =
        |what: String| Error::Run(StockCode::BadDescription.diag(format!("{}: {what}", file.name)));
    let table: toml::Table =
        file.text.parse().map_err(|error: toml::de::Error| wrong(error.message().into()))?;
    match table.get("simulate") {
        None => Ok(Setup::default()),
        Some(toml::Value::Table(table)) => Setup::of_table(table).map_err(wrong),
        Some(_) => Err(wrong("simulate is a table: [simulate]".into())),
    }
}

/// The path of a file that another one names.
fn joined(file: &str, name: &str) -> String {
    let mut parts: Vec<&str> = file.split('/').collect();
    parts.pop();
    for part in name.split(['/', '\\']) {
        match part {
            "." | "" => {}
            ".." if parts.last().is_some_and(|last| *last != "..") => drop(parts.pop()),
            part => parts.push(part),
        }
    }
    parts.join("/")
}

/// Reads a mesh, whose bytes are characters of the same number; a text that has others is one in UTF-8.
fn read_mesh(file: &Named) -> Result<Mesh, Error> {
    let bytes: Result<Vec<u8>, _> = file.text.chars().map(u8::try_from).collect();
    let bytes = bytes.unwrap_or_else(|_| file.text.clone().into_bytes());
    Mesh::read(&file.name, &bytes).map_err(Error::Run)
}
