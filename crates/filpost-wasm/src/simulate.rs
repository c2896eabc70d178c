//! Material removal by a program.

use filpost::cl::reader::Options;
use filpost::plot::{ClText, Text};
use filpost::simulate::{as_json, cl_tools};
use filpost::stock::errors::StockCode;
use filpost::stock::{Job, Mesh, Offsets, Stock, Tool, Tools, length};
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
    stock: String,
    part: Option<Named>,
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
            stock: fields.needed("stock")?,
            part: fields.file("part")?,
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
        let stock = Stock::read(&self.stock).map_err(Error::Run)?;
        let stock = stock.ok_or_else(|| wrong(format!("`{}` is no stock", self.stock)))?;
        let grid = self.grid.as_deref().map(|grid| {
            length(grid).ok_or_else(|| wrong(format!("grid `{grid}` is no length above 0")))
        });
        let part = self.part.as_ref().map(|part| Mesh::read(&part.name, part.text.as_bytes()));
        let part = part.transpose().map_err(Error::Run)?;
        let mut tools = match &self.cl {
            None => Tools::new(),
            Some(Named { name, text }) => {
                let text = Text { name, bytes: text.as_bytes() };
                cl_tools(&ClText { text, options: Options::default(), unit: None }, &commons)?.tools
            }
        };
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
            part_tolerance: PART_TOLERANCE,
            grid: grid.transpose()?,
            offsets: &Offsets::new(),
            levels: commons.levels(),
        };
        let nc = filpost::tape_style::page(&commons).encode(&self.nc);
        let bytes = nc.as_deref().unwrap_or(self.nc.as_bytes());
        let done = simulate::program(Text { name: "the program", bytes }, &commons, &job)?;
        let mut answer = as_json(&done.report);
        if self.heights {
            let grid = done.left.grid();
            answer["grid"] = json!({
                "origin": grid.origin, "step": grid.step, "columns": grid.columns, "rows": grid.rows,
            });
            answer["heights"] = json!(done.left.tops());
        }
        Ok(answer)
    }
}
