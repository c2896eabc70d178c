//! What is in force: the modal words that a block need not repeat.

use crate::text::Block;

/// Preparatory functions of one modal group replace each other. Codes are in
/// tenths, as `G43.4` exists. Motion, plane, distance, feed mode, unit,
/// compensation, tool length, return level, work offset, surface speed, path.
const G_GROUPS: [&[i64]; 11] = [
    &[
        0, 10, 20, 30, 320, 330, 340, 730, 740, 760, 800, 810, 820, 830, 840, 850, 860, 870, 880,
        890,
    ],
    &[170, 180, 190],
    &[900, 910],
    &[930, 940, 950],
    &[200, 210, 700, 710],
    &[400, 410, 420],
    &[430, 431, 434, 435, 440, 490],
    &[980, 990],
    &[540, 550, 560, 570, 580, 590],
    &[960, 970],
    &[610, 640],
];

/// Auxiliary functions that replace each other: spindle, coolant, override.
const M_GROUPS: [&[i64]; 3] = [&[30, 40, 50], &[70, 80, 90], &[480, 490]];

/// Index of the motion group.
const MOTION: usize = 0;
/// Index of the plane group.
const PLANE: usize = 1;
/// Index of the group of absolute and incremental.
const DISTANCE: usize = 2;
/// Index of the group of tool lengths.
const LENGTH: usize = 6;
/// Index of the group of return levels.
const RETURN: usize = 7;

/// Functions after which the position named in the same block is not that of
/// the program's frame: `G28`, `G30`, `G53`.
const ELSEWHERE: [i64; 3] = [280, 300, 530];

/// Tool-tip control (`G43.4`, `G43.5`): coordinates are those of the tip in the part.
const TIP_CONTROL: [i64; 2] = [434, 435];

/// Absolute arc centers (`G90.1`) and those from the start (`G91.1`).
const ABSOLUTE_CENTERS: i64 = 901;
const CENTERS_FROM_START: i64 = 911;

/// What is in force at some place of a program.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Modal {
    g: [Option<i64>; G_GROUPS.len()],
    m: [Option<i64>; M_GROUPS.len()],
    values: [Option<f64>; 26],
    /// Bottom of the holes of the cycle in force.
    depth: Option<f64>,
    absolute_centers: bool,
}

/// Code of a function in tenths.
pub(super) fn tenths(code: f64) -> i64 {
    (code * 10.0).round() as i64
}

/// The modal group of a function: an index, `None` for one that acts in its
/// block alone or is not known.
pub(super) fn group(letter: u8, code: i64) -> Option<usize> {
    let groups: &[&[i64]] = if letter == b'G' { &G_GROUPS } else { &M_GROUPS };
    groups.iter().position(|group| group.contains(&code))
}

impl Modal {
    /// The function of a group that is in force, in tenths.
    pub fn function(&self, letter: u8, group: usize) -> Option<i64> {
        if letter == b'G' { self.g[group] } else { self.m[group] }
    }

    /// The value in force of a letter.
    pub fn value(&self, letter: u8) -> Option<f64> {
        self.values[usize::from(letter - b'A')]
    }

    /// What a block without this letter means by it: the value in force, on the
    /// drilling axis of a cycle its depth.
    pub fn in_force(&self, letter: u8) -> Option<f64> {
        if self.drills_along(letter) { self.depth } else { self.value(letter) }
    }

    /// The letter is the drilling axis of the cycle in force.
    pub fn drills_along(&self, letter: u8) -> bool {
        self.in_cycle() && letter == self.normal()
    }

    /// A canned cycle is in force.
    pub fn in_cycle(&self) -> bool {
        self.g[MOTION].is_some_and(|code| code > 700 && code != 800)
    }

    /// Tool-tip control is on.
    fn on_tip(&self) -> bool {
        self.g[LENGTH].is_some_and(|code| TIP_CONTROL.contains(&code))
    }

    /// The sense of the arc that is in force: counterclockwise or not.
    pub fn arc(&self) -> Option<bool> {
        match self.g[MOTION] {
            Some(20) => Some(false),
            Some(30) => Some(true),
            _ => None,
        }
    }

    /// Coordinates are steps from the last position.
    pub fn incremental(&self) -> bool {
        self.g[DISTANCE] == Some(910)
    }

    /// Arc centers are coordinates of the program.
    pub fn absolute_centers(&self) -> bool {
        self.absolute_centers
    }

    /// The two axes of the plane and its normal, as indices of X, Y, Z.
    pub fn plane(&self) -> [usize; 3] {
        match self.g[PLANE] {
            Some(180) => [2, 0, 1],
            Some(190) => [1, 2, 0],
            _ => [0, 1, 2],
        }
    }

    /// Letter of the axis that stands on the plane.
    fn normal(&self) -> u8 {
        b"XYZ"[self.plane()[2]]
    }

    /// A word of this letter that repeats the value in force changes nothing.
    /// `U`, `V`, `W` are steps on a lathe, so that they always count.
    pub fn keeps(&self, letter: u8) -> bool {
        match letter {
            b'X' | b'Y' | b'Z' | b'A' | b'B' | b'C' => !self.incremental(),
            b'R' | b'Q' | b'P' => self.in_cycle(),
            b'F' | b'S' | b'T' | b'H' | b'D' => true,
            _ => false,
        }
    }

    /// Takes a block up.
    pub fn take(&mut self, block: &Block) {
        let was_in_cycle = self.in_cycle();
        let was_on_tip = self.on_tip();
        let mut elsewhere = false;
        for word in block.words.iter().filter(|word| matches!(word.letter, b'G' | b'M')) {
            let code = tenths(word.number.value());
            elsewhere |= word.letter == b'G' && ELSEWHERE.contains(&code);
            self.function_of_block(word.letter, code);
        }
        if self.in_cycle() && !was_in_cycle {
            self.depth = None;
            b"RQP".iter().for_each(|letter| *self.slot(*letter) = None);
        }
        if self.on_tip() != was_on_tip {
            b"XYZ".iter().for_each(|letter| *self.slot(*letter) = None);
        }
        let level = self.value(self.normal());
        for word in block.words.iter().filter(|word| word.index.is_none()) {
            self.set(word.letter, word.number.value(), elsewhere);
        }
        if self.in_cycle() {
            self.after_cycle(block, level);
        }
    }

    fn function_of_block(&mut self, letter: u8, code: i64) {
        match (letter, group(letter, code), code) {
            (b'G', Some(group), _) => self.g[group] = Some(code),
            (b'M', Some(group), _) => self.m[group] = Some(code),
            (b'G', None, ABSOLUTE_CENTERS) => self.absolute_centers = true,
            (b'G', None, CENTERS_FROM_START) => self.absolute_centers = false,
            _ => {}
        }
    }

    fn slot(&mut self, letter: u8) -> &mut Option<f64> {
        &mut self.values[usize::from(letter - b'A')]
    }

    fn set(&mut self, letter: u8, value: f64, elsewhere: bool) {
        let coordinate = matches!(letter, b'X' | b'Y' | b'Z' | b'A' | b'B' | b'C');
        let incremental = self.incremental();
        let held = self.slot(letter);
        *held = match (coordinate, elsewhere) {
            (true, true) => None,
            (true, false) if incremental => held.map(|last| last + value),
            _ => Some(value),
        };
    }

    /// The drilling axis is not at the bottom after a cycle: it goes back to the
    /// level before it (`G98`) or to its R (`G99`).
    fn after_cycle(&mut self, block: &Block, level: Option<f64>) {
        let normal = self.normal();
        if let Some(word) = block.word(normal) {
            self.depth = Some(word.number.value());
        }
        *self.slot(normal) = match self.g[RETURN] {
            Some(980) => level,
            Some(990) if !self.incremental() => self.value(b'R'),
            _ => None,
        };
    }
}
