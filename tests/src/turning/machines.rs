//! Lathes and mill-turn machines that a seed draws, and the programs for them.

use filpost::{Error, Program};

use super::mixed::program;
use crate::counts::settings::drawn;
use crate::five_axes::maker::Line;
use crate::five_axes::numbers::Random;

/// The ready posts whose settings are changed.
const POSTS: [&str; 7] = [
    "fanuc-lathe",
    "haas-lathe",
    "okuma-lathe",
    "linuxcnc-lathe",
    "sinumerik-lathe",
    "fanuc-mill-turn",
    "sinumerik-mill-turn",
];

/// Groups of settings that are changed.
const GROUPS: [&str; 18] = [
    "lathe",
    "thread",
    "mill_turn",
    "turret",
    "rapid",
    "linear",
    "circle",
    "feed",
    "home",
    "limits",
    "motion",
    "cycle",
    "dwell",
    "spindle",
    "tool",
    "fixture",
    "cutcom",
    "coolant",
];

/// What makes any program wrong, or leaves to the control what it means.
const LEFT_OUT: [&str; 10] = [
    "circle.plane",
    "motion.same_tolerance",
    "feed.mode",
    "dwell.code",
    "dwell.address",
    "dwell.upm_factor",
    "limits.c_min",
    "limits.c_max",
    "spindle.cw_code",
    "spindle.ccw_code",
];

/// Half of the settings begin so.
const FOCUS: [&str; 5] = ["lathe.", "thread.", "mill_turn.", "turret.", "spindle."];

/// A ready post with any of its settings changed, and a program for it that mixes everything.
/// Such settings may contradict each other.
pub struct Mixed {
    /// The ready post.
    pub ready: &'static str,
    /// Settings on top.
    pub settings: Vec<String>,
    /// The lines of the program.
    pub lines: Vec<Line>,
}

impl Mixed {
    /// The machine and the program of a seed.
    pub fn of_seed(seed: u64) -> Mixed {
        let mut random = Random::of_seed(seed);
        let ready = POSTS[random.below(POSTS.len())];
        let settings = drawn(&mut random, 3, (&GROUPS, &LEFT_OUT), &FOCUS);
        let lines = program(ready, seed, &mut random);
        Mixed { ready, settings, lines }
    }

    /// The post of the machine.
    ///
    /// # Errors
    /// Settings that contradict each other.
    pub fn post(&self) -> Result<Program, Error> {
        let start = Program::builder().generic(self.ready);
        self.settings.iter().fold(start, |builder, setting| builder.set(setting)).build()
    }
}
