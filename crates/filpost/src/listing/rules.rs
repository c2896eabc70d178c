//! Which lines a listing has, as the settings of the machine say.

use fil_machine::Commons;
use fil_machine::locations::{self as loc, FeedListUnits, ListTapeImage, ToolListTimes};

use super::Row;

/// Which lines a listing has. The default has all of them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ListingRules {
    /// Statements of the CL file.
    pub statements: bool,
    /// Where each motion ends.
    pub positions: bool,
    /// What the feeds there count.
    pub feeds: FeedListUnits,
    /// Warnings.
    pub warnings: bool,
    /// Blocks.
    pub blocks: bool,
    /// Blocks stand as on the tape, without what made them.
    pub bare_blocks: bool,
    /// Totals of each tool.
    pub tools: bool,
    /// Lines of a page with its heading; `None` for one page without.
    pub lines_per_page: Option<usize>,
    /// What `list.skip` leaves out: the sum of FIL, PPRINT, INSERT and PARTNO.
    skipped: i32,
}

impl Default for ListingRules {
    fn default() -> Self {
        ListingRules {
            statements: true,
            positions: true,
            feeds: FeedListUnits::default(),
            warnings: true,
            blocks: true,
            bare_blocks: false,
            tools: true,
            lines_per_page: None,
            skipped: 0,
        }
    }
}

impl ListingRules {
    /// The rules of a machine.
    pub fn of(commons: &Commons) -> Self {
        let image = commons.read(loc::LIST_TAPE_IMAGE);
        let pages = commons.read(loc::LIST_PAGES);
        let length = usize::try_from(commons.int(loc::LIST_LINES_PER_PAGE)).unwrap_or(0);
        ListingRules {
            statements: commons.read(loc::LIST_INPUT),
            positions: commons.read(loc::LIST_VERIFICATION),
            feeds: commons.read(loc::FEED_LIST_UNITS),
            warnings: !commons.read(loc::LIST_SUPPRESS_WARNINGS),
            blocks: image != ListTapeImage::None,
            bare_blocks: image == ListTapeImage::AsWritten,
            tools: commons.read(loc::TOOL_LIST_TIMES) == ToolListTimes::Yes,
            lines_per_page: pages.then_some(length).filter(|length| *length > 0),
            skipped: commons.int_opt(loc::LIST_SKIP).unwrap_or(0),
        }
    }

    /// True for a line that the listing has.
    pub(super) fn shows(self, row: Row) -> bool {
        const FIL: i32 = 1;
        const PPRINT: i32 = 2;
        const INSERT: i32 = 4;
        const PARTNO: i32 = 8;
        let keeps = |part: i32| self.skipped & part == 0;
        match row {
            Row::Statement => self.statements,
            Row::Pprint => self.statements && keeps(PPRINT),
            Row::Insert => self.statements && keeps(INSERT),
            Row::Partno => self.statements && keeps(PARTNO),
            Row::Section => keeps(FIL),
            Row::Block { .. } => self.blocks,
            Row::Position(_) => self.positions,
            Row::Message => keeps(PPRINT),
            Row::Warning => self.warnings,
            Row::Total => true,
            Row::Tool => self.tools,
        }
    }
}
