//! How much of a long proof the normal run takes.

/// Of so many random cases, a fourth; all of them with `FILPOST_WHOLE=1`, as `.ci/run` has it.
pub fn of(whole: usize) -> usize {
    if is_whole() { whole } else { whole / 4 }
}

/// True when all cases are asked for.
pub fn is_whole() -> bool {
    std::env::var_os("FILPOST_WHOLE").is_some_and(|value| value == "1")
}
