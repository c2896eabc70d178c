//! Where a generator gets its choices from: bytes of a fuzzer or a seed.

/// A source of choices. It takes the given bytes first and then goes on with
/// numbers that depend on them alone, so one input always makes one program.
pub struct Dice<'a> {
    bytes: std::slice::Iter<'a, u8>,
    state: u64,
}

impl<'a> Dice<'a> {
    /// Choices of a seed.
    pub fn from_seed(seed: u64) -> Self {
        Dice { bytes: [].iter(), state: seed }
    }

    /// Choices of a fuzzer's bytes.
    pub fn from_bytes(bytes: &'a [u8]) -> Self {
        let mix = |state: u64, byte: &u8| (state ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3);
        Dice { bytes: bytes.iter(), state: bytes.iter().fold(0xcbf2_9ce4_8422_2325, mix) }
    }

    /// A number below `count`, which must not be 0.
    pub fn below(&mut self, count: usize) -> usize {
        match self.bytes.next() {
            Some(byte) => usize::from(*byte) % count,
            None => (self.random() % count as u64) as usize,
        }
    }

    /// True once in `times`.
    pub fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    /// A number from `low` up to `high`.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let share = (self.random() >> 11) as f64 / (1u64 << 53) as f64;
        low + (high - low) * share
    }

    /// One of a list.
    pub fn pick<'t>(&mut self, list: &[&'t str]) -> &'t str {
        list[self.below(list.len())]
    }

    /// SplitMix64: every state is a good one.
    fn random(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}
