//! Tests over several crates, one file a concern. They are one program, so that the crates
//! are linked once: `cargo test -p filpost-tests --test all verify::` runs those of a file.

mod chains;
mod convert;
mod counts;
mod cycles;
mod debug_builds;
mod dialects;
mod errors;
mod families;
mod format;
mod grbl;
mod interop;
mod letters;
mod linearization;
mod mill_turn;
mod mutations;
mod nc_events;
mod one_form;
mod option_file;
mod oracle;
mod plot;
mod random;
mod random_five_axes;
mod real_cl;
mod reference;
mod robust;
mod threads;
mod tilted_frames;
mod tip_control;
mod trace;
mod verify;
mod verify_five_axes;
mod verify_modes;
mod verify_ways;
mod wasm;
mod windows;
