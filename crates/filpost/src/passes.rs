//! Which pass over the CL file a run is in, and what scripts are told of the program in it.

use fil_cl::errors::ClCode;
use fil_diag::Diag;
use fil_vm::errors::RunCode as VmCode;
use fil_vm::{TotalsOf, TotalsText, TotalsWord};

use crate::error::RunCode;
use crate::overview::Overview;

/// What a first pass has found.
pub(crate) struct FirstPass {
    /// What was counted, to the end or to the error.
    pub overview: Overview,
    /// Why it did not come to the end.
    pub failure: Option<String>,
}

/// The pass that a run is in.
pub(crate) enum Pass {
    /// There is one only: the FIL asks for no totals, or the input can't go back.
    Only,
    /// What the script asks for is counted.
    First {
        /// As far as it was counted.
        counted: Box<Overview>,
        /// The script was told a number that is not the right one.
        guessed: bool,
    },
    /// The program is written, of which only its list of tools was asked, and no script changes it.
    Listed(Vec<String>),
    /// The program is written.
    Second {
        /// What the first pass has found.
        first: Box<FirstPass>,
        /// What this pass counts.
        counted: Box<Overview>,
        /// The script was told what the first pass has found.
        told: bool,
    },
}

/// What every question is answered with in the first pass. A DO from 1 to it runs once, and
/// nothing is divided by 0.
const GUESS: f64 = 1.0;

impl Pass {
    /// The pass that writes the program.
    pub fn writing(first: Option<FirstPass>, has_script: bool) -> Pass {
        match first {
            None => Pass::Only,
            // Both passes do the same: there is nothing to count again.
            Some(first) if !has_script => Pass::Listed(first.overview.tool_list()),
            Some(first) => {
                Pass::Second { first: Box::new(first), counted: Box::default(), told: false }
            }
        }
    }

    /// True for a pass that counts what the program does.
    pub fn counts(&self) -> bool {
        matches!(self, Pass::First { .. } | Pass::Second { .. })
    }

    /// The tools that the first pass has found, a line each; `None` where there was none.
    pub fn tool_list(&mut self) -> Option<Vec<String>> {
        match self {
            Pass::Only => None,
            Pass::First { .. } => Some(Vec::new()),
            Pass::Listed(tools) => Some(std::mem::take(tools)),
            Pass::Second { first, told, .. } => {
                *told = true;
                Some(first.overview.tool_list())
            }
        }
    }

    /// What this pass counts.
    #[inline]
    pub fn counted(&mut self) -> Option<&mut Overview> {
        match self {
            Pass::Only | Pass::Listed(_) => None,
            Pass::First { counted, .. } | Pass::Second { counted, .. } => Some(counted),
        }
    }

    /// True in a first pass.
    pub fn is_first(&self) -> bool {
        matches!(self, Pass::First { .. })
    }

    /// True when an error may come from a number that the script was told wrongly.
    pub fn has_guessed(&self) -> bool {
        matches!(self, Pass::First { guessed: true, .. })
    }

    /// Notes that the script was told something of its own accord.
    pub fn guess(&mut self) {
        if let Pass::First { guessed, .. } = self {
            *guessed = true;
        }
    }

    /// Answers a script.
    fn ask<T>(
        &mut self,
        guess: T,
        find: impl FnOnce(&Overview) -> Result<T, String>,
    ) -> Result<T, Box<Diag>> {
        match self {
            Pass::Only | Pass::Listed(_) => {
                let message = "the script asks for numbers of the whole program, which need a \
                               first pass over the CL file";
                ClCode::NotSeekable.err(message)
            }
            Pass::First { guessed, .. } => {
                *guessed = true;
                Ok(guess)
            }
            Pass::Second { first, told, .. } => {
                *told = true;
                find(&first.overview).map_err(|message| VmCode::Missing.diag(message))
            }
        }
    }

    /// A number of the program, of a tool or of an operation.
    pub fn number(&mut self, of: TotalsOf, word: TotalsWord) -> Result<Option<f64>, Box<Diag>> {
        self.ask(Some(GUESS), |overview| overview.number(of, word))
    }

    /// A text of the program, of a tool or of an operation.
    pub fn text(&mut self, of: TotalsText) -> Result<String, Box<Diag>> {
        self.ask(GUESS.to_string(), |overview| overview.text(of))
    }

    /// Number of the tool that is changed to behind a CL record.
    pub fn tool_after(&mut self, cl_record: u32) -> Result<Option<f64>, Box<Diag>> {
        self.ask(Some(GUESS), |overview| overview.tool_after(cl_record))
    }

    /// Refuses a program that is another one than the script was told.
    ///
    /// # Errors
    /// E0719.
    pub fn check(&self) -> Result<(), Box<Diag>> {
        let Pass::Second { first, counted, told: true } = self else { return Ok(()) };
        let Some(difference) = first.overview.difference(counted) else { return Ok(()) };
        Err(RunCode::OwnTotals.diag(match &first.failure {
            Some(failure) => format!("{difference}; the first pass ended early: {failure}"),
            None => difference,
        }))
    }
}
