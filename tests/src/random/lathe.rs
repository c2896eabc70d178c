//! A Fanuc-style lathe that runs the programs of the ready post: X in diameters,
//! G98 and G99 for the feed, G96 and G97 for the spindle, G32 for threads, tool and
//! offset in one T word. What it does not know it refuses.

use crate::path::{Axis, Point, Unit};

use super::expected::{Compensation, Coolant, Rate, Turning};
use super::machine::{NcAct, NcStep, Tape, without_number};

/// Radii of the ends of an arc may differ by this, in units of the program.
const RADIUS_TOLERANCE: f64 = 0.005;

/// Runs a program.
///
/// # Errors
/// The block that the lathe does not understand, and why.
pub fn run(tape: &Tape<'_>) -> Result<Vec<NcStep>, String> {
    let mut lathe = Lathe::new(tape);
    for (index, line) in tape.nc.lines().enumerate() {
        let block = line.trim();
        let (skip, block) = match block.strip_prefix('/') {
            Some(rest) => (true, rest),
            None => (false, block),
        };
        if block.is_empty() || block.starts_with(['%', 'O', '(']) || (skip && tape.skipping) {
            continue;
        }
        lathe.line = index + 1;
        let block = without_number(block);
        if block.starts_with('(') {
            continue;
        }
        let words = words(block).ok_or(format!("no words: {line}"))?;
        lathe.block(&words).map_err(|reason| format!("{reason}; {line}"))?;
    }
    Ok(lathe.steps)
}

/// Letter and number of each word of a block.
fn words(block: &str) -> Option<Vec<(char, f64)>> {
    let mut words = Vec::new();
    let mut rest = block.trim();
    while let Some(letter) = rest.chars().next() {
        rest = &rest[letter.len_utf8()..];
        let number = |c: char| c.is_ascii_digit() || matches!(c, '.' | '-' | '+');
        let end = rest.find(|c| !number(c)).unwrap_or(rest.len());
        if !letter.is_ascii_uppercase() {
            return None;
        }
        words.push((letter, rest[..end].parse().ok()?));
        rest = rest[end..].trim_start();
    }
    Some(words)
}

/// The motion code in force.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Motion {
    Rapid,
    Feed,
    Clockwise,
    Counterclockwise,
    Thread,
}

/// What the control stands at. Lengths in units of the program.
struct Lathe {
    steps: Vec<NcStep>,
    line: usize,
    dwell_factor: f64,
    unit: f64,
    /// X as a radius, and Z.
    at: [f64; 2],
    motion: Option<Motion>,
    zx_plane: bool,
    feed: Option<f64>,
    per_revolution: bool,
    surface: bool,
    speed: f64,
    turns: Option<bool>,
    limit: f64,
    coolant: Coolant,
    compensation: Compensation,
    length: u32,
}

impl Lathe {
    fn new(tape: &Tape<'_>) -> Self {
        let setup = tape.setup;
        let metric = (setup.unit == Unit::Mm) != setup.hostile;
        Lathe {
            steps: Vec::new(),
            line: 0,
            dwell_factor: setup.dwell_factor,
            unit: if metric { 1.0 } else { Unit::Inch.in_mm() },
            at: [0.0; 2],
            motion: None,
            zx_plane: !setup.hostile,
            feed: None,
            per_revolution: !setup.hostile,
            surface: setup.hostile,
            speed: 0.0,
            turns: None,
            limit: 0.0,
            coolant: Coolant { flood: false, mist: false },
            compensation: Compensation::Off,
            length: 0,
        }
    }

    /// Modes first, then tool, spindle and coolant, then what moves or waits.
    fn block(&mut self, words: &[(char, f64)]) -> Result<(), String> {
        let of = |letter: char| words.iter().find(|word| word.0 == letter).map(|word| word.1);
        let (mut dwell, mut limits) = (false, false);
        for (_, code) in words.iter().filter(|word| word.0 == 'G') {
            match self.preparatory(*code, of('D'))? {
                Asks::Nothing => {}
                Asks::Dwell => dwell = true,
                Asks::Limit => limits = true,
            }
        }
        for (letter, _) in words {
            let used = match letter {
                'G' | 'M' | 'F' | 'S' | 'T' => true,
                'P' => dwell,
                'D' => self.compensation != Compensation::Off,
                'X' | 'Z' | 'I' | 'K' | 'R' => !dwell && !limits,
                _ => false,
            };
            if !used {
                return Err(format!("a {letter} that nothing takes"));
            }
        }
        if let Some(feed) = of('F') {
            self.feed = Some(feed);
        }
        if let Some(tool) = of('T') {
            self.length = (tool as u32) % 100;
            self.step(NcAct::Tool(tool as u32 / 100));
        }
        if let Some(speed) = of('S') {
            *(if limits { &mut self.limit } else { &mut self.speed }) = speed;
        }
        for (_, code) in words.iter().filter(|word| word.0 == 'M') {
            self.auxiliary(*code)?;
        }
        if dwell {
            let time = of('P').ok_or("a dwell without P")?;
            self.step(NcAct::Dwell(time / self.dwell_factor));
        }
        if ['X', 'Z', 'I', 'K'].into_iter().any(|letter| of(letter).is_some()) {
            self.moves(of('X'), of('Z'), [of('I'), of('K')], of('R'))?;
        }
        Ok(())
    }

    fn preparatory(&mut self, code: f64, offset: Option<f64>) -> Result<Asks, String> {
        let offset = offset.unwrap_or(0.0) as u32;
        match code as u32 {
            _ if code.fract() != 0.0 => return Err(format!("G{code}")),
            0 => self.motion = Some(Motion::Rapid),
            1 => self.motion = Some(Motion::Feed),
            2 => self.motion = Some(Motion::Clockwise),
            3 => self.motion = Some(Motion::Counterclockwise),
            32 => self.motion = Some(Motion::Thread),
            4 => return Ok(Asks::Dwell),
            50 => return Ok(Asks::Limit),
            17 | 19 => self.zx_plane = false,
            18 => self.zx_plane = true,
            20 => self.unit = Unit::Inch.in_mm(),
            21 => self.unit = Unit::Mm.in_mm(),
            40 => self.compensation = Compensation::Off,
            41 => self.compensation = Compensation::Left(offset),
            42 => self.compensation = Compensation::Right(offset),
            96 => self.surface = true,
            97 => self.surface = false,
            98 => self.per_revolution = false,
            99 => self.per_revolution = true,
            _ => return Err(format!("G{code} is not known")),
        }
        Ok(Asks::Nothing)
    }

    fn auxiliary(&mut self, code: f64) -> Result<(), String> {
        match code as u32 {
            _ if code.fract() != 0.0 => return Err(format!("M{code}")),
            0 => self.step(NcAct::Stop),
            1 => self.step(NcAct::OptionalStop),
            3 => self.turns = Some(false),
            4 => self.turns = Some(true),
            5 => self.turns = None,
            7 => self.coolant.mist = true,
            8 => self.coolant.flood = true,
            9 => self.coolant = Coolant { flood: false, mist: false },
            2 | 30 => {}
            _ => return Err(format!("M{code} is not known")),
        }
        Ok(())
    }

    fn moves(
        &mut self,
        x: Option<f64>,
        z: Option<f64>,
        center: [Option<f64>; 2],
        radius: Option<f64>,
    ) -> Result<(), String> {
        let to = [x.map_or(self.at[0], |x| x / 2.0), z.unwrap_or(self.at[1])];
        let motion = self.motion.ok_or("a motion without a code")?;
        let feeds = || self.feed.filter(|feed| *feed > 0.0).ok_or("a motion without a feed");
        let place = |[x, z]: [f64; 2]| [x * self.unit, 0.0, z * self.unit];
        let act = match motion {
            Motion::Rapid => NcAct::Rapid(place(to)),
            Motion::Feed => feeds().map(|_| NcAct::Feed(place(to)))?,
            Motion::Thread => NcAct::Thread { to: place(to), lead: feeds()? * self.unit },
            Motion::Clockwise | Motion::Counterclockwise => {
                feeds()?;
                if !self.zx_plane {
                    return Err("an arc in another plane".to_string());
                }
                let ccw = motion == Motion::Counterclockwise;
                let center = match radius {
                    Some(radius) => self.center_of(to, radius, ccw)?,
                    None => [0, 1].map(|axis| self.at[axis] + center[axis].unwrap_or(0.0)),
                };
                self.check_radii(to, center)?;
                let (to, center) = (place(to), place(center));
                NcAct::Arc { to, center, normal: Axis::Y, ccw, turns: 0 }
            }
        };
        let stays = to == self.at && !matches!(act, NcAct::Arc { .. });
        if !stays {
            self.step(act);
        }
        self.at = to;
        Ok(())
    }

    /// The center of an arc by its radius, which turns at most half a turn where the
    /// radius is positive.
    fn center_of(&self, to: [f64; 2], radius: f64, ccw: bool) -> Result<[f64; 2], String> {
        // In the plane of Z and X, counterclockwise from Z to X.
        let [dz, dx] = [to[1] - self.at[1], to[0] - self.at[0]];
        let chord = dz.hypot(dx);
        if chord == 0.0 {
            return Err("an arc by its radius that ends where it begins".to_string());
        }
        let half = chord / 2.0;
        if half > radius.abs() + RADIUS_TOLERANCE {
            return Err("the radius is too small to reach the end".to_string());
        }
        let away = (radius * radius - half * half).max(0.0).sqrt();
        let side = if ccw == (radius > 0.0) { away } else { -away };
        let (mid_z, mid_x) = ((self.at[1] + to[1]) / 2.0, (self.at[0] + to[0]) / 2.0);
        Ok([mid_x + side * dz / chord, mid_z - side * dx / chord])
    }

    fn check_radii(&self, to: [f64; 2], center: [f64; 2]) -> Result<(), String> {
        let radius = |point: [f64; 2]| (point[0] - center[0]).hypot(point[1] - center[1]);
        let (at_start, at_end) = (radius(self.at), radius(to));
        if at_start == 0.0 {
            return Err("an arc of radius zero".to_string());
        }
        if (at_start - at_end).abs() > RADIUS_TOLERANCE {
            return Err(format!("radius {at_start} at the start, {at_end} at the end"));
        }
        Ok(())
    }

    fn step(&mut self, act: NcAct) {
        let (speed, surface) = (self.speed, self.surface);
        let spindle = match self.turns {
            None => Turning::Stopped,
            Some(ccw) if surface => Turning::Surface { speed, ccw },
            Some(ccw) => Turning::At { speed, ccw },
        };
        let [x, z] = self.at.map(|value| value * self.unit);
        let from: Point = [x, 0.0, z];
        let feed = Rate {
            value: self.feed.unwrap_or(0.0) * self.unit,
            per_revolution: self.per_revolution,
        };
        self.steps.push(NcStep {
            act,
            from,
            line: self.line,
            feed,
            spindle,
            coolant: self.coolant,
            compensation: self.compensation,
            length: self.length,
            limit: self.limit,
        });
    }
}

/// What a preparatory code asks of the rest of its block.
enum Asks {
    Nothing,
    Dwell,
    Limit,
}

#[cfg(test)]
mod tests {
    use super::super::setup::Setup;
    use super::*;
    use crate::programs::Dice;

    fn steps(nc: &str) -> Result<Vec<NcStep>, String> {
        let setup =
            Setup { hostile: false, unit: Unit::Mm, ..Setup::lathe(&mut Dice::from_seed(1)) };
        run(&Tape { nc, setup: &setup, skipping: false })
    }

    #[test]
    fn x_is_a_diameter_and_i_a_radius() {
        let found = steps("G99 G1 X20. Z0. F0.2\nG18 G3 X30. Z-5. I0. K-5.\n").unwrap();
        assert_eq!(found[0].act, NcAct::Feed([10.0, 0.0, 0.0]));
        let NcAct::Arc { to, center, ccw, .. } = found[1].act else { panic!("no arc") };
        assert_eq!((to, center, ccw), ([15.0, 0.0, -5.0], [10.0, 0.0, -5.0], true));
    }

    #[test]
    fn a_radius_finds_the_center_of_the_same_arc() {
        for (code, end) in [("G3", "R5."), ("G2", "R-5.")] {
            let nc = format!("G1 X20. Z0. F0.2\n{code} X30. Z-5. {end}\n");
            let NcAct::Arc { center, .. } = steps(&nc).unwrap()[1].act else { panic!("no arc") };
            assert!((center[0] - 10.0).abs() < 1e-9 && (center[2] + 5.0).abs() < 1e-9, "{nc}");
        }
    }

    #[test]
    fn what_is_not_known_is_refused() {
        for nc in ["G91", "G1 X5.", "X5. Z5.", "G1 Y5. F1.", "M77", "G2 X10. Z5. F1. I1. K0."] {
            assert!(steps(&format!("{nc}\n")).is_err(), "{nc}");
        }
    }
}
