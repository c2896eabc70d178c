//! Machines of four and five axes that a seed draws, and the programs for them.

use fil_machine::axis_chain::AxisChain;
use fil_machine::chains::CHAINS;
use filpost::{Error, Program};

use super::maker::{Line, program};
use super::mixed::Family;
use super::numbers::Random;
use crate::counts::settings::drawn;

/// Ready posts and what makes them write one form.
const FORMS: [(&str, &[&str]); 12] = [
    ("fanuc-5x-tables", &["rotary.tip_output=0"]),
    ("fanuc-5x-tables", &["rotary.tip_output=0", "rotary.feed=2"]),
    (
        "fanuc-5x-tables",
        &["rotary.tip_output=0", "repos.feed_method=1", "repos.retract_distance=80"],
    ),
    ("fanuc-5x-tables", &["rotary.tip_output=0", "rotary.frame_output=1", "home.retract_z=300"]),
    ("fanuc-5x-tables", &[]),
    ("fanuc-5x-tables", &["rotary.tip_form=1", "rotary.tip_control=1"]),
    ("haas-trunnion-tcpc", &["repos.optimise=1"]),
    ("sinumerik-5x", &[]),
    ("sinumerik-5x", &["rotary.tip_form=1", "rotary.frame_output=0"]),
    ("sinumerik-5x", &["rotary.tip_output=0", "rotary.frame_output=0"]),
    ("heidenhain-5x", &[]),
    ("heidenhain-5x", &["rotary.tip_form=1", "rotary.frame_output=0", "rotary.tip_control=1"]),
];

/// The ready posts whose settings are changed.
const POSTS: [(&str, Family); 9] = [
    ("fanuc-mill-a", Family::WordAddress),
    ("fanuc-mill-b", Family::WordAddress),
    ("haas-trunnion", Family::WordAddress),
    ("haas-trunnion-tcpc", Family::WordAddress),
    ("fanuc-5x-tables", Family::WordAddress),
    ("fanuc-5x-head", Family::WordAddress),
    ("linuxcnc-5x", Family::WordAddress),
    ("heidenhain-5x", Family::Klartext),
    ("sinumerik-5x", Family::Sinumerik),
];

/// Groups of settings that are changed.
const GROUPS: [&str; 14] = [
    "rotary", "repos", "rapid", "linear", "circle", "feed", "home", "limits", "motion", "cycle",
    "dwell", "spindle", "tool", "fixture",
];

/// What makes any program wrong, or leaves to the control what it means.
const LEFT_OUT: [&str; 6] = [
    "motion.same_tolerance",
    "feed.mode",
    "dwell.code",
    "dwell.address",
    "dwell.upm_factor",
    "rotary.table_words",
];

/// Chains with one rotary axis.
const ONE_AXIS: [&str; 4] = ["table-a", "table-b", "table-c", "head-b"];

/// A ready post with settings, and the numbers that the program for it is drawn from.
pub struct Machine {
    /// The ready post.
    pub ready: &'static str,
    /// Settings on top.
    pub settings: Vec<String>,
    /// Anything that this control knows may stand between the motions.
    family: Option<Family>,
    random: Random,
}

/// Where the rotary axes lie, as settings.
fn places_of_axes(random: &mut Random) -> Vec<String> {
    let mut set = Vec::new();
    for axis in ["primary", "secondary"] {
        for part in ["x", "y", "z"] {
            set.push(format!("rotary.{axis}_{part}={:.3}", random.between(-80.0, 80.0)));
        }
    }
    set
}

impl Machine {
    /// A shipped chain in one of the forms of output.
    pub fn of_forms(seed: u64) -> Machine {
        let mut random = Random::of_seed(seed);
        let (ready, form) = FORMS[random.below(FORMS.len())];
        let chain = CHAINS[random.below(CHAINS.len())].name;
        let mut settings = vec![format!("chain=\"{chain}\""), "home.retract_z=400".to_string()];
        if ONE_AXIS.contains(&chain) {
            settings.push("rotary.secondary_kind=0".to_string());
        }
        settings.extend(form.iter().map(ToString::to_string));
        if chain == "table-c" {
            // Its tool lies along X, which no tilted frame of a control knows.
            settings.push("rotary.frame_output=0".to_string());
        }
        settings.extend(places_of_axes(&mut random));
        Machine { ready, settings, family: None, random }
    }

    /// A ready post with any of its settings changed, for a program that mixes everything. Such
    /// settings may contradict each other.
    pub fn mixed(seed: u64) -> Machine {
        let mut random = Random::of_seed(seed);
        let (ready, family) = POSTS[random.below(POSTS.len())];
        let mut settings = vec!["home.retract_z=400".to_string()];
        if random.happens(0.5) {
            let chain = CHAINS[random.below(CHAINS.len())].name;
            settings.push(format!("chain=\"{chain}\""));
            if ONE_AXIS.contains(&chain) {
                settings.push("rotary.secondary_kind=0".to_string());
            }
        }
        settings.extend(places_of_axes(&mut random));
        settings.extend(drawn(&mut random, 4, (&GROUPS, &LEFT_OUT), &["r"]));
        Machine { ready, settings, family: Some(family), random }
    }

    /// The post of the machine.
    ///
    /// # Errors
    /// Settings that contradict each other.
    pub fn post(&self) -> Result<Program, Error> {
        let start = Program::builder().generic(self.ready);
        self.settings.iter().fold(start, |builder, setting| builder.set(setting)).build()
    }

    /// What messages call the machine.
    pub fn told(&self) -> String {
        format!("{} {}", self.ready, self.settings.join(" "))
    }

    /// The lines of the program for this machine, whose post is given; `None` where its axes
    /// make no chain.
    pub fn lines(self, post: &Program) -> Option<Vec<Line>> {
        let chain = AxisChain::from_commons(post.commons()).ok()?;
        Some(program(&chain, self.random, self.family))
    }
}
