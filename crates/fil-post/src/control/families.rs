//! The table of the families of controls: a row each.

use fil_machine::locations::ControlFamily;

use super::capabilities::Capabilities;
use super::family::Row;
use super::{klartext, sinumerik, word_address};

/// The row of a family.
pub fn row(family: ControlFamily) -> &'static Row {
    match family {
        ControlFamily::WordAddress => &WORD_ADDRESS,
        ControlFamily::Klartext => &KLARTEXT,
        ControlFamily::Sinumerik => &SINUMERIK,
    }
}

/// A language that has nothing of what others lack.
const NOTHING: Capabilities = Capabilities {
    plain_words: false,
    edits_lines: false,
    numbers_lines: false,
    brackets_are_comments: false,
    lengths_by_plane: false,
    length_functions: false,
    cutting_edges: false,
    compensation_in_moves: false,
    cycle_calls: false,
    cycles_say_return: false,
    cycles_count_breaks: false,
    mode_statements: false,
    speed_modes_say_feed: false,
    diameter_statement: false,
    retract_function: false,
    spells_way_round: false,
    angles_beside_vectors: false,
    straight_rapids: false,
    skipped_is_unknown: false,
    reads_edited_lines: false,
    machine_frame: "G53",
    way_up: "G91 G28 Z0.",
};

/// Words of letters and numbers (ISO 6983).
static WORD_ADDRESS: Row = Row {
    can: Capabilities {
        plain_words: true,
        edits_lines: true,
        brackets_are_comments: true,
        length_functions: true,
        ..NOTHING
    },
    writer: &word_address::family::WordAddress,
};

/// Heidenhain Klartext.
static KLARTEXT: Row = Row {
    can: Capabilities {
        numbers_lines: true,
        compensation_in_moves: true,
        cycles_say_return: true,
        cycles_count_breaks: true,
        retract_function: true,
        machine_frame: "M91",
        way_up: "L Z+0 R0 FMAX M91",
        angles_beside_vectors: true,
        straight_rapids: true,
        ..NOTHING
    },
    writer: &klartext::family::Klartext,
};

/// SINUMERIK 840D.
static SINUMERIK: Row = Row {
    can: Capabilities {
        edits_lines: true,
        lengths_by_plane: true,
        cutting_edges: true,
        cycle_calls: true,
        cycles_say_return: true,
        mode_statements: true,
        speed_modes_say_feed: true,
        diameter_statement: true,
        machine_frame: "SUPA",
        way_up: "SUPA G0 Z0 D0, then D1",
        spells_way_round: true,
        angles_beside_vectors: true,
        straight_rapids: true,
        skipped_is_unknown: true,
        reads_edited_lines: true,
        ..NOTHING
    },
    writer: &sinumerik::family::Sinumerik,
};
