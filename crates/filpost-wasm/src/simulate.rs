//! Material removal by a program.

use filpost::cl::reader::Options;
use filpost::plot::{ClText, Text};
use filpost::simulate::{Setup, as_json, cl_tools};
use filpost::stock::errors::StockCode;
use filpost::stock::{Job, Left, Mesh, Offsets, Stock, Tool, Tools, length};
use filpost::{Error, simulate};
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
        let setup = self.setup.as_ref().map(|file| Setup::read(&file.name, &file.text));
        let setup = setup.transpose()?.unwrap_or_default();
        let given = self.stock.as_ref().or(setup.stock.as_ref());
        let given = given.ok_or_else(|| wrong("there is no stock".into()))?;
        let stock = match Stock::read(given).map_err(Error::Run)? {
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
            offsets: &Offsets::new(),
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
    /// A mesh that the setup file names.
    fn mesh(&self, name: &str) -> Result<Mesh, Error> {
        match self.meshes.iter().find(|mesh| mesh.name == name) {
            Some(mesh) => read_mesh(mesh),
            None => {
                let what = format!("`{name}` is no stock, and no STL file that is there");
                Err(Error::Run(StockCode::BadDescription.diag(what)))
            }
        }
    }
}

/// Reads a mesh, whose bytes are characters of the same number; a text that has others is one in UTF-8.
fn read_mesh(file: &Named) -> Result<Mesh, Error> {
    let bytes: Result<Vec<u8>, _> = file.text.chars().map(u8::try_from).collect();
    let bytes = bytes.unwrap_or_else(|_| file.text.clone().into_bytes());
    Mesh::read(&file.name, &bytes).map_err(Error::Run)
}
