//! Thread passes of an NC program for a Fanuc lathe: G76 in one block or in two, and G92.
//!
//! Read from the text alone. X is a diameter. `G76 X Z K D I A F` cuts to the
//! diameter X in passes whose depths below the crest, K above X, are D*sqrt(i),
//! the last one K. In two blocks, `G76 P010000 Q R0` and `G76 X Z P Q F`, height and depth are
//! P and Q in thousandths, and a pass adds at least the first Q. `G92 X Z I F` is one pass. Both begin where the tool stands,
//! feed with F a turn to Z and come back to where they began.

use std::collections::BTreeMap;

/// Most passes of one G76 here; a program that asks for more is in error.
const MOST: u32 = 10_000;

/// Which cycle made a pass.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cycle {
    /// G76, and the number of the pass in it, from 1.
    G76(u32),
    /// G92.
    G92,
}

/// One way of the tool along the thread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pass {
    /// Line of the program, from 1.
    pub line: usize,
    /// What made it.
    pub cycle: Cycle,
    /// Radius of the tool's nose.
    pub radius: f64,
    /// Z where it begins.
    pub start: f64,
    /// Z where it ends.
    pub end: f64,
    /// Z per turn.
    pub lead: f64,
    /// The cycle's floor: the radius of its last pass.
    pub floor: f64,
}

/// What a program does.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Program {
    /// Thread passes in order.
    pub passes: Vec<Pass>,
    /// Points of rapid motion: line, radius, Z.
    pub rapids: Vec<(usize, f64, f64)>,
}

/// Reads a program.
///
/// # Errors
/// A block that this reading does not cover, with its line.
pub fn read(nc: &str) -> Result<Program, String> {
    let mut reader = Reader::default();
    for (index, block) in nc.lines().enumerate() {
        reader
            .block(index + 1, block)
            .map_err(|reason| format!("NC line {}: {reason}", index + 1))?;
    }
    Ok(reader.program)
}

#[derive(Default)]
struct Reader {
    program: Program,
    /// Diameter and Z of the tool, once both are known.
    x: Option<f64>,
    z: Option<f64>,
    /// Rapid motion is on.
    rapid: bool,
    /// What the first block of G76 has said: a pass adds at least this.
    least: Option<f64>,
}

impl Reader {
    fn block(&mut self, line: usize, block: &str) -> Result<(), String> {
        if block.starts_with('%') || block.starts_with('O') || block.starts_with('(') {
            return Ok(());
        }
        let block = words(block)?;
        match block.g.iter().find(|g| [0, 76, 92].contains(*g)) {
            Some(0) => self.rapid = true,
            Some(code) => {
                self.rapid = false;
                return if *code == 76 { self.g76(line, &block) } else { self.g92(line, &block) };
            }
            None => {}
        }
        let moves = block.value.contains_key(&'X') || block.value.contains_key(&'Z');
        if moves && !self.rapid {
            return Err("a motion that is neither rapid nor a thread cycle".to_string());
        }
        self.x = block.value.get(&'X').copied().or(self.x);
        self.z = block.value.get(&'Z').copied().or(self.z);
        if let (true, Some(x), Some(z)) = (moves, self.x, self.z) {
            self.program.rapids.push((line, x / 2.0, z));
        }
        Ok(())
    }

    fn g76(&mut self, line: usize, block: &Block) -> Result<(), String> {
        if !block.value.contains_key(&'X') {
            // One pass at full depth, no chamfer, straight in, no allowance.
            if block.get('P')? != 10_000.0 || block.get('R')? != 0.0 {
                return Err("the first block of G76 asks for more than plain passes".to_string());
            }
            self.least = Some(block.get('Q')? / 1000.0);
            return Ok(());
        }
        let in_two = self.least.take();
        if in_two.is_none() && block.get('A')? != 0.0 {
            return Err("G76 with an infeed along the flank: where its groove lies is not known"
                .to_string());
        }
        let (height, first) = match in_two {
            Some(_) => (block.get('P')? / 1000.0, block.get('Q')? / 1000.0),
            None => (block.get('K')?, block.get('D')?),
        };
        if height <= 0.0 || first <= 0.0 {
            return Err("G76 without K or D".to_string());
        }
        let last = self.pass(line, Cycle::G76(0), block)?;
        let side = (self.x.unwrap_or(0.0) / 2.0 - last.radius).signum();
        let mut before = 0.0;
        for number in 1..=MOST {
            let law = first * f64::from(number).sqrt();
            let depth = law.max(before + in_two.unwrap_or(0.0)).min(height);
            before = depth;
            let radius = last.radius + side * (height - depth);
            self.program.passes.push(Pass { cycle: Cycle::G76(number), radius, ..last });
            if depth > height - 1e-6 {
                return Ok(());
            }
        }
        Err(format!("G76 of more than {MOST} passes"))
    }

    fn g92(&mut self, line: usize, block: &Block) -> Result<(), String> {
        let pass = self.pass(line, Cycle::G92, block)?;
        self.program.passes.push(pass);
        Ok(())
    }

    /// The pass along the floor of a cycle.
    fn pass(&self, line: usize, cycle: Cycle, block: &Block) -> Result<Pass, String> {
        if block.value.get(&'I').is_some_and(|cone| *cone != 0.0) {
            return Err("a cone".to_string());
        }
        let (Some(_), Some(start)) = (self.x, self.z) else {
            return Err("a cycle before the first point".to_string());
        };
        let radius = block.get('X')? / 2.0;
        let (end, lead) = (block.get('Z')?, block.get('F')?);
        Ok(Pass { line, cycle, radius, start, end, lead, floor: radius })
    }
}

/// The words of a block.
#[derive(Default)]
struct Block {
    g: Vec<u32>,
    value: BTreeMap<char, f64>,
}

impl Block {
    fn get(&self, letter: char) -> Result<f64, String> {
        self.value.get(&letter).copied().ok_or_else(|| format!("{letter} is missing"))
    }
}

fn words(text: &str) -> Result<Block, String> {
    let mut block = Block::default();
    for word in text.split_whitespace() {
        let letter = word.chars().next().unwrap_or(' ');
        let number = &word[letter.len_utf8()..];
        let value: f64 = number.parse().map_err(|_| format!("`{word}` is no word"))?;
        if letter == 'G' {
            block.g.push(value as u32);
        } else if block.value.insert(letter, value).is_some() {
            return Err(format!("{letter} stands twice"));
        }
    }
    Ok(block)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Depths 0.3*sqrt(i) below the crest of 40: 0.3, 0.424264, 0.519615, then
    /// 0.6, which is K.
    #[test]
    fn the_depths_of_g76_follow_the_root_of_the_number() {
        let nc = "%\nO1\nG0 X44. Z5.\nG76 X38.8 Z-30. K.6 D.3 I0. A0. F2.\nG92 X38. Z-30. I0. F2.";
        let program = read(nc).unwrap();
        let radii: Vec<f64> = program.passes.iter().map(|pass| pass.radius).collect();
        let wanted = [19.7, 19.575736, 19.480385, 19.4, 19.0];
        assert_eq!(radii.len(), wanted.len());
        for (radius, wanted) in radii.iter().zip(wanted) {
            assert!((radius - wanted).abs() < 1e-6, "{radii:?}");
        }
        assert!(program.passes.iter().all(|pass| (pass.start, pass.lead) == (5.0, 2.0)));
        assert_eq!(program.rapids, [(3, 22.0, 5.0)]);
    }

    /// The law asks for 0.3, 0.424 and 0.52, the least of 0.2 for 0.3, 0.5 and 0.7.
    #[test]
    fn g76_in_two_blocks_adds_at_least_its_first_q() {
        let nc = "G0 X44. Z5.\nG76 P010000 Q200 R0\nG76 X38.6 Z-30. P700 Q300 F2.";
        let radii: Vec<f64> = read(nc).unwrap().passes.iter().map(|pass| pass.radius).collect();
        let wanted = [19.7, 19.5, 19.3];
        assert_eq!(radii.len(), wanted.len(), "{radii:?}");
        assert!(radii.iter().zip(wanted).all(|(radius, wanted)| (radius - wanted).abs() < 1e-9));
    }

    #[test]
    fn what_is_not_covered_is_refused() {
        for (nc, reason) in [
            ("G0 X44. Z5.\nG76 X38. Z-30. K1. D.3 I0. A60. F2.", "along the flank"),
            ("G0 X44. Z5.\nG92 X38. Z-30. I1. F2.", "a cone"),
            ("G0 X44.\nG92 X38. Z-30. I0. F2.", "before the first point"),
            ("G0 X44. Z5.\nG92 X38. Z-30. I0.", "F is missing"),
            ("G1 X44. Z5.", "neither rapid"),
            ("G0 X44. Z5.\nG92 X38. Z-30. I0. F2.\nX37.", "neither rapid"),
        ] {
            let error = read(nc).unwrap_err();
            assert!(error.contains(reason), "{error}");
        }
    }
}
