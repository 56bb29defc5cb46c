//! Numbers that a seed decides: SplitMix64 (Steele, Lea and Flood, "Fast splittable pseudorandom number generators", 2014).
//! Each is a hash of its place in the stream, so that it is known from that alone as well.

/// By what the state grows from number to number.
const GAMMA: u64 = 0x9e37_79b9_7f4a_7c15;

/// A stream of numbers.
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// Begins the sequence of `seed`.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number.
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(GAMMA);
        mixed(self.0)
    }

    /// The next number, as one from 0 to less than 1.
    pub fn unit(&mut self) -> f64 {
        unit(self.bits())
    }
}

/// Number `n` of the stream of seed 0, from 0 to less than 1; the first is number 1.
pub fn unit_at(n: u64) -> f64 {
    unit(mixed(n.wrapping_mul(GAMMA)))
}

fn mixed(state: u64) -> u64 {
    let z = (state ^ (state >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// By the upper 53 bits: those that an `f64` holds.
fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1u64 << 53) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_are_those_of_splitmix64() {
        // Those that implementations are checked by: Rosetta Code, "Pseudo-random numbers/Splitmix64".
        let mut chance = SplitMix64::new(1_234_567);
        let expected = [
            6_457_827_717_110_365_317,
            3_203_168_211_198_807_973,
            9_817_491_932_198_370_423,
            4_593_380_528_125_082_431,
            16_408_922_859_458_223_821,
        ];
        assert_eq!([(); 5].map(|()| chance.bits()), expected);
    }

    #[test]
    fn a_number_is_known_from_its_place() {
        let mut chance = SplitMix64::new(0);
        for n in 1..1000 {
            let next = chance.unit();
            assert!((0.0..1.0).contains(&next) && next == unit_at(n), "{n}: {next}");
        }
    }
}
