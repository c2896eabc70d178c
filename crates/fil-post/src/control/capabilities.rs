//! What the languages of the families of controls have, and what they lack.

/// What the language of a family has.
#[derive(Debug)]
pub struct Capabilities {
    /// A block is its words in tape order, and nothing else.
    pub plain_words: bool,
    /// Lines are edited by macros and REPLAC; else the language has lines of its own.
    pub edits_lines: bool,
    /// The control numbers the lines, and no word does.
    pub numbers_lines: bool,
    /// `(TEXT)` is a comment; else `; TEXT` is one.
    pub brackets_are_comments: bool,
    /// Lengths of tools count along the axes of the plane in force.
    pub lengths_by_plane: bool,
    /// Functions with a number take up the length of a tool, in tool center point control too, and
    /// others take it off (G43, G43.4, G49): the control counts without it then.
    pub length_functions: bool,
    /// D chooses a cutting edge with its length and radius.
    pub cutting_edges: bool,
    /// Only a line with a move can begin or end cutter compensation: R0 is output in the next such
    /// line, also in one that the CL file does not ask for.
    pub compensation_in_moves: bool,
    /// A statement calls a cycle at each position (MCALL), and another ends it.
    pub cycle_calls: bool,
    /// Each cycle says the level to which it returns.
    pub cycles_say_return: bool,
    /// The cycle that breaks chips says after how many pecks the tool leaves the hole.
    pub cycles_count_breaks: bool,
    /// Statements, and not functions, choose spindles and the modes of a mill-turn machine.
    pub mode_statements: bool,
    /// G96 (constant surface speed) and G97 (rpm) set the feed mode too.
    pub speed_modes_say_feed: bool,
    /// A statement says that X is a diameter.
    pub diameter_statement: bool,
    /// M140 goes away from the part.
    pub retract_function: bool,
    /// The word of a rotary axis spells the way to its position (`ACP`, `ACN`, `DC`).
    pub spells_way_round: bool,
    /// Rotary axes take angles beside the direction of the tool as a vector.
    pub angles_beside_vectors: bool,
    /// Rapid motions go on a straight line, unless the machine says otherwise.
    pub straight_rapids: bool,
    /// What a foreign block changes that can be skipped is unknown from its reading on.
    pub skipped_is_unknown: bool,
    /// An edited line is read anew as a whole.
    pub reads_edited_lines: bool,
    /// What makes positions count in the frame of the machine, for people.
    pub machine_frame: &'static str,
    /// A block of an author that brings the tool up, as the post can read it.
    pub way_up: &'static str,
}
