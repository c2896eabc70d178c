//! The passes between post words and control: where the CL file stands, and how
//! its motions become motions of the machine's axes.
//!
//! [`carry_out`] takes each operation the moment a post word makes it: the target
//! is transformed and solved for the rotary axes, rapids are ordered, arcs and
//! holes are brought into the machine's planes or taken apart, and the control
//! writes the blocks. Nothing is held back.

pub mod arc;
mod arc_parts;
mod chords;
pub mod compensation_side;
mod counted_spindle;
pub mod cycle;
mod expand;
mod feed_rules;
pub mod frame;
mod frame_begin;
mod frame_end;
mod functions_of_others;
pub mod height;
pub mod hole;
pub(crate) mod index;
pub(crate) mod lead_in;
pub(crate) mod linear;
pub mod linearization;
pub(crate) mod long_arc;
mod machine_position;
pub mod mill_turn;
pub(crate) mod named_frames;
mod operations;
pub(crate) mod places;
mod plates;
mod pole;
mod position;
pub mod rapid;
mod rapid_lean;
mod rapid_turn;
mod reposition;
mod reposition_rapid;
pub mod rotary;
mod scaled_lead;
pub(crate) mod sense;
mod skip;
mod solution;
mod state;
mod straight;
pub mod taken_change;
pub mod thread;
pub mod thread_points;
mod tip;
pub mod tip_control;
mod tip_hole;
pub mod tool_change;
mod transformation;
mod travel;
#[cfg(test)]
mod trial;
mod turn_at_top;
mod turned_apart;
mod turning;
mod turning_feed;
mod way;
pub(crate) mod way_home;
mod whole_thread;

pub(crate) use named_frames::NamedFrames;
pub use operations::carry_out;
pub use solution::Coming;
pub use state::{Awaited, LookAhead, Path, Straightness, ToolAxis};
pub(crate) use state::{Choice, Cutter, Passes, Pitch, Shift, Since};
pub use transformation::{Statement, Transformation};
