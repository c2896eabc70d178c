//! Random programs, and a file of them, by which another revision posts the same ones.

use filpost_tests::five_axes::judge::text;
use filpost_tests::five_axes::machines::Machine;
use filpost_tests::random::make::Program;
use filpost_tests::random::verdict::cl_text;
use filpost_tests::random::{lathe_make, make};
use filpost_tests::turning::machines::Mixed;
use filpost_tests::turning::part::Part;
use serde::{Deserialize, Serialize};

/// A program that a generator drew.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Drawn {
    /// The generator.
    pub suite: String,
    /// Its seed.
    pub seed: u64,
    /// The ready post.
    pub ready: String,
    /// Settings on top.
    pub settings: Vec<String>,
    /// The CL text.
    pub cl: String,
}

/// The programs of the first seeds of each generator.
pub fn programs(seeds: u64) -> Vec<Drawn> {
    let generators: [fn(u64) -> Option<Drawn>; 7] = [
        |seed| Some(of_mill("random-mill", seed, &make::program(seed))),
        |seed| Some(of_mill("random-lathe", seed, &lathe_make::program(seed))),
        |seed| Some(of_mill("random-linuxcnc-lathe", seed, &lathe_make::linuxcnc_program(seed))),
        |seed| Some(mill_turn(seed)),
        |seed| five_axes("random-five-axes", seed, Machine::of_forms(seed)),
        |seed| five_axes("random-five-mixed", seed, Machine::mixed(seed)),
        |seed| Some(turn_mixed(seed)),
    ];
    generators.iter().flat_map(|generator| (0..seeds).filter_map(generator)).collect()
}

fn of_mill(suite: &str, seed: u64, program: &Program) -> Drawn {
    Drawn {
        suite: suite.into(),
        seed,
        ready: program.setup.ready.into(),
        settings: program.setup.settings.clone(),
        cl: cl_text(program),
    }
}

fn mill_turn(seed: u64) -> Drawn {
    // A SINUMERIK has no live taps there.
    let (ready, taps) = match seed % 2 {
        0 => ("fanuc-mill-turn", true),
        _ => ("sinumerik-mill-turn", false),
    };
    Drawn {
        suite: "random-mill-turn".into(),
        seed,
        ready: ready.into(),
        settings: Vec::new(),
        cl: Part::of_machine(seed, taps),
    }
}

/// `None` where the settings that were drawn make no machine.
fn five_axes(suite: &str, seed: u64, machine: Machine) -> Option<Drawn> {
    let post = machine.post().ok()?;
    let (ready, settings) = (machine.ready.into(), machine.settings.clone());
    let cl = text(&machine.lines(&post)?);
    Some(Drawn { suite: suite.into(), seed, ready, settings, cl })
}

fn turn_mixed(seed: u64) -> Drawn {
    let Mixed { ready, settings, lines } = Mixed::of_seed(seed);
    let (suite, ready) = ("random-turn-mixed".into(), ready.into());
    Drawn { suite, seed, ready, settings, cl: text(&lines) }
}

/// A file of programs, one a line.
///
/// # Errors
/// None that a program can cause.
pub fn write(programs: &[Drawn]) -> Result<String, String> {
    let line = |drawn| serde_json::to_string(drawn).map(|line| line + "\n");
    programs.iter().map(line).collect::<Result<_, _>>().map_err(|error| error.to_string())
}

/// Reads a file of programs.
///
/// # Errors
/// A line that is no program.
pub fn read(text: &str) -> Result<Vec<Drawn>, String> {
    let wrong = |error| format!("no file of programs: {error}");
    text.lines().map(|line| serde_json::from_str(line).map_err(wrong)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn programs_are_the_same_each_time_and_in_their_file() {
        let drawn = programs(3);
        assert_eq!(drawn, programs(3));
        assert_eq!(read(&write(&drawn).unwrap()).unwrap(), drawn);
        for suite in ["random-mill", "random-lathe", "random-mill-turn", "random-five-axes"] {
            let of_suite = drawn.iter().filter(|drawn| drawn.suite == suite);
            assert_eq!(of_suite.map(|drawn| drawn.seed).collect::<Vec<_>>(), [0, 1, 2], "{suite}");
        }
    }
}
