//! The machine a random program is posted for: a ready post with settings that
//! change the form of its blocks but not what they mean.

use crate::path::Unit;
use crate::programs::Dice;

/// How arcs are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CenterForm {
    /// I J K from the start.
    FromStart,
    /// R.
    Radius,
    /// I J K absolute.
    Absolute,
}

/// With which motion a word stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Placement {
    /// A block of its own.
    Own,
    /// The next motion in X or Y.
    NextXy,
    /// The next motion.
    NextAny,
    /// The next motion in Z.
    NextZ,
}

/// A machine and what the comparison must know of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Setup {
    /// The ready post.
    pub ready: &'static str,
    /// Settings on top.
    pub settings: Vec<String>,
    /// Unit of the CL file at its start.
    pub unit: Unit,
    /// Form of arcs.
    pub center: CenterForm,
    /// Rapids are split into XY and Z.
    pub split: bool,
    /// Holes are written as single moves.
    pub expanded: bool,
    /// Where SPINDL stands.
    pub spindle: Placement,
    /// Where COOLNT stands.
    pub coolant: Placement,
    /// Where CUTCOM stands.
    pub cutcom: Placement,
    /// A tool that is in the spindle is not changed.
    pub tool_modal: bool,
    /// The number of a dwell for one second.
    pub dwell_factor: f64,
    /// The control stands at other modes before the program begins.
    pub hostile: bool,
}

/// Settings without which a cycle is written as single moves.
const NO_CYCLES: [&str; 9] =
    ["drill", "csink", "deep", "tap", "bore", "ream", "thru", "face", "brkchp"];

/// The setting of a machine that limits its spindle by itself.
const SURFACE_SPEED_ALONE: &str = "spindle.css_unlimited=1";

impl Setup {
    /// Draws a machine.
    pub fn random(dice: &mut Dice<'static>) -> Self {
        // The interpreter prints four decimals, which are all of these machines' digits.
        let unit = if dice.once_in(4) { Unit::Inch } else { Unit::Mm };
        let ready = match unit {
            Unit::Inch => "fanuc-mill",
            Unit::Mm => dice.pick(&["linuxcnc-mill", "fanuc-mill"]),
        };
        let mut setup = Setup {
            ready,
            settings: Vec::new(),
            unit,
            center: CenterForm::FromStart,
            split: true,
            expanded: false,
            spindle: Placement::Own,
            coolant: Placement::Own,
            cutcom: Placement::NextXy,
            tool_modal: false,
            dwell_factor: if ready == "fanuc-mill" { 1000.0 } else { 1.0 },
            hostile: dice.once_in(2),
        };
        if ready == "fanuc-mill" && dice.once_in(6) {
            // Seconds, of which the format holds whole ones only.
            setup.set("dwell.upm_factor=1");
            setup.dwell_factor = 1.0;
        }
        setup.set("rapid.repeat_feed=0");
        setup.arcs(dice);
        setup.placements(dice);
        setup.forms(dice);
        setup
    }

    /// Draws a lathe.
    pub fn lathe(dice: &mut Dice<'static>) -> Self {
        let unit = if dice.once_in(4) { Unit::Inch } else { Unit::Mm };
        let mut setup = Setup {
            ready: "fanuc-lathe",
            settings: Vec::new(),
            unit,
            center: CenterForm::FromStart,
            split: false,
            expanded: true,
            spindle: Placement::Own,
            coolant: Placement::Own,
            cutcom: Placement::NextAny,
            tool_modal: false,
            dwell_factor: 1000.0,
            hostile: dice.once_in(2),
        };
        if dice.once_in(3) {
            setup.center = CenterForm::Radius;
            setup.set("circle.center=3");
        }
        setup.choose(dice, 3, "circle.max_degrees=90");
        setup.choose(dice, 3, "circle.full_circle=0");
        setup.choose(dice, 3, "circle.axes_modal=0");
        if setup.choose(dice, 3, "cutcom.with_motion=0") {
            setup.cutcom = Placement::Own;
        }
        setup.choose(dice, 4, "linear.modal=1");
        setup.choose(dice, 4, "motion.modal=0");
        setup.choose(dice, 4, "rapid.repeat_feed=1");
        setup.tool_modal = setup.choose(dice, 5, "tool.modal=1");
        setup.choose(dice, 3, SURFACE_SPEED_ALONE);
        setup
    }

    /// Draws a lathe of LinuxCNC, whose own interpreter runs its programs.
    pub fn linuxcnc_lathe(dice: &mut Dice<'static>) -> Self {
        let mut setup = Setup::lathe(dice);
        setup.ready = "linuxcnc-lathe";
        setup.unit = Unit::Mm;
        setup.dwell_factor = 1.0;
        setup
    }

    /// A surface speed needs no highest speed on this machine.
    pub fn takes_surface_speed_without_limit(&self) -> bool {
        self.settings.iter().any(|setting| setting == SURFACE_SPEED_ALONE)
    }

    /// It is a lathe.
    pub fn turns(&self) -> bool {
        self.ready == "fanuc-lathe" || self.ready == "linuxcnc-lathe"
    }

    /// Its programs are run by the lathe of these tests, and not by LinuxCNC's interpreter.
    pub fn runs_on_our_lathe(&self) -> bool {
        self.ready == "fanuc-lathe"
    }

    /// Decimals of the axis words and of F.
    pub fn decimals(&self, unit: Unit) -> (i32, i32) {
        match (self.ready, unit) {
            ("fanuc-mill", Unit::Mm) => (3, 2),
            ("fanuc-lathe", Unit::Mm) => (3, 3),
            ("fanuc-lathe", Unit::Inch) | ("linuxcnc-lathe", Unit::Mm) => (4, 4),
            (_, Unit::Mm) => (4, 2),
            (_, Unit::Inch) => (4, 3),
        }
    }

    /// A dwell that the format of its address can't hold.
    pub fn rounds_dwell(&self, seconds: f64) -> bool {
        !self.ready.starts_with("linuxcnc") && (seconds * self.dwell_factor).fract() != 0.0
    }

    fn set(&mut self, setting: impl Into<String>) {
        self.settings.push(setting.into());
    }

    fn arcs(&mut self, dice: &mut Dice<'static>) {
        self.center = match dice.below(4) {
            0 => CenterForm::Radius,
            1 => CenterForm::Absolute,
            _ => CenterForm::FromStart,
        };
        self.set(format!(
            "circle.center={}",
            match self.center {
                CenterForm::FromStart => 1,
                CenterForm::Radius => 3,
                CenterForm::Absolute => 4,
            }
        ));
        self.choose(dice, 3, "circle.max_degrees=90");
        self.choose(dice, 3, "circle.full_circle=0");
        self.choose(dice, 3, "circle.modal=1");
        self.choose(dice, 3, "circle.axes_modal=0");
    }

    fn placements(&mut self, dice: &mut Dice<'static>) {
        let mut place = |key: &str, setup: &mut Setup| {
            let number = if dice.once_in(3) { 2 + dice.below(2) } else { 1 };
            setup.set(format!("{key}={number}"));
            [Placement::Own, Placement::NextXy, Placement::NextZ][number - 1]
        };
        self.spindle = place("spindle.placement", self);
        self.coolant = place("coolant.placement", self);
        if self.choose(dice, 3, "cutcom.with_motion=0") {
            self.cutcom = Placement::Own;
        }
    }

    fn forms(&mut self, dice: &mut Dice<'static>) {
        self.split = !self.choose(dice, 3, "rapid.split=0");
        self.choose(dice, 4, "rapid.modal=72");
        self.choose(dice, 4, "rapid.repeat_feed=1");
        self.choose(dice, 4, "linear.modal=1");
        self.choose(dice, 4, "motion.modal=0");
        self.choose(dice, 4, "tool.separate_blocks=1");
        self.tool_modal = self.choose(dice, 5, "tool.modal=1");
        self.choose(dice, 5, "tool.length_cancel_code=49");
        self.choose(dice, 5, "cycle.return_modal=0");
        self.choose(dice, 5, "tape.blank=1");
        self.choose(dice, 5, "seqno.off_at_start=72");
        self.choose(dice, 6, "mode.position=90");
        if dice.once_in(4) {
            self.expanded = true;
            for kind in NO_CYCLES {
                self.set(format!("cycle.{kind}_code=none"));
            }
        }
    }

    /// Makes a setting once in so many machines, and says whether it did.
    fn choose(&mut self, dice: &mut Dice<'static>, times: usize, setting: &str) -> bool {
        let chosen = dice.once_in(times);
        if chosen {
            self.set(setting);
        }
        chosen
    }
}
