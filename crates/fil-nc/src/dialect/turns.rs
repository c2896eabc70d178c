//! Rotary axes whose words count within one turn.

use fil_machine::axis_chain::AxisChain;

use super::Settings;

/// The way that a control takes to a position within a turn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum WayRound {
    /// In plus; with a minus sign in minus. `minus_at_zero` is the way to a 0 without a sign.
    BySign {
        /// A 0 is reached in minus.
        minus_at_zero: bool,
    },
    /// The shorter one.
    Shortest,
    /// Always in plus.
    Plus,
    /// Always in minus.
    Minus,
}

/// The ways of the axes; `None` for one that counts on over any number of turns.
pub(super) fn ways(settings: &Settings, chain: &AxisChain) -> [Option<WayRound>; 5] {
    let way = match settings.code("rotary.output") {
        Some(1) => WayRound::BySign { minus_at_zero: settings.code("rotary.zero_sign") == Some(2) },
        Some(2) => WayRound::Shortest,
        Some(4) => WayRound::Plus,
        _ => return [None; 5],
    };
    let mut ways = [None; 5];
    for (axis, rotary) in chain.rotaries.iter().enumerate() {
        let endless = rotary.as_ref().is_some_and(|it| !it.is_limited());
        ways[axis + 3] = Some(way).filter(|_| endless);
    }
    ways
}
