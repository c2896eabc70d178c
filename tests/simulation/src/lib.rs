//! Simulations that judge NC programs by what they cut, and nothing of the post but
//! what it printed. A member of its own, so that these loops are optimized in test
//! builds and the test runners are not.

pub mod embos;
pub mod runout;
pub mod screw;
pub mod stock;
pub mod thread;
pub mod turning;

/// How many random jobs are run: what an environment variable asks for, or as many as always.
///
/// # Panics
/// A variable that holds no number.
pub fn jobs(variable: &str, always: usize) -> usize {
    number(variable).unwrap_or(always)
}

/// Where the random jobs begin: always alike, or with FILPOST_SEED at other ones.
///
/// # Panics
/// A variable that holds no number.
pub fn seed(always: u64) -> u64 {
    number::<u64>("FILPOST_SEED").map_or(always, |seed| seed.wrapping_add(always) | 1)
}

/// True where FILPOST_SEED asks for other jobs than those whose numbers the pages show.
pub fn is_seeded() -> bool {
    std::env::var_os("FILPOST_SEED").is_some()
}

fn number<N: std::str::FromStr>(variable: &str) -> Option<N> {
    let text = std::env::var(variable).ok()?;
    Some(text.parse().unwrap_or_else(|_| panic!("{variable} holds a number, not {text}")))
}
