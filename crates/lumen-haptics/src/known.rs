//! Mappings that were chosen or learnt, by device: its vendor's number, its own, and a hash of its report descriptor (FNV-1a
//! of Fowler, Noll and Vo, 64 bits), so that another firmware's axes are not taken for the same. Two devices of one kind are
//! one: serial numbers are not asked for.

use serde::{Deserialize, Serialize};

use super::identity::Identity;
use super::mapping::{Mapping, Mode};

/// Devices that are remembered; the one that was chosen for the longest ago goes first.
const MAX_DEVICES: usize = 32;

/// FNV-1a.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3))
}

/// By what a device is known, whose reports `descriptor` says: hexadecimal numbers.
pub fn key(identity: &Identity, descriptor: &[u8]) -> String {
    format!("{:04x}:{:04x}:{:016x}", identity.vendor, identity.product, hash(descriptor))
}

/// What is remembered, the newest last.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct KnownMappings(Vec<(String, Mapping)>);

/// Whether a mapping is one of a device with so many axes.
fn fits(mapping: &Mapping, axes: usize) -> bool {
    [mapping.feed, mapping.roll].into_iter().flatten().all(|of| {
        let far = match of.mode {
            Mode::Absolute { travel } => travel,
            Mode::Relative { per_count } => per_count,
            Mode::Rate { full } => full,
        };
        of.axis < axes && far.is_finite() && far > 0.0 && of.dead_zone.is_finite()
    })
}

impl KnownMappings {
    /// What was chosen for the device of this key; `None` if nothing was, or nothing that fits its axes.
    pub fn get(&self, key: &str, axes: usize) -> Option<Mapping> {
        let (_, mapping) = self.0.iter().find(|(known, _)| known == key)?;
        fits(mapping, axes).then_some(*mapping)
    }

    /// Whether there is something to forget of it.
    pub fn has(&self, key: &str) -> bool {
        self.0.iter().any(|(known, _)| known == key)
    }

    /// Remembers what was chosen for a device with so many axes, in place of what was before; not what does not fit them.
    pub fn remember(&mut self, key: &str, axes: usize, mapping: Mapping) {
        if !key.is_empty() && fits(&mapping, axes) {
            self.forget(key);
            self.0.push((key.to_owned(), mapping));
            self.0.drain(..self.0.len().saturating_sub(MAX_DEVICES));
        }
    }

    /// Forgets what was chosen for a device.
    pub fn forget(&mut self, key: &str) {
        self.0.retain(|(known, _)| known != key);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::controls::Motion;
    use crate::mapping::AxisMapping;

    #[test]
    fn the_hash_is_that_of_its_authors() {
        // From the test vectors of their own program, test_fnv.c.
        assert_eq!(hash(b""), 0xcbf2_9ce4_8422_2325);
        assert_eq!(hash(b"a"), 0xaf63_dc4c_8601_ec8c);
        assert_eq!(hash(b"foobar"), 0x8594_4171_f739_67e8);
    }

    #[test]
    fn a_device_is_known_by_numbers_and_descriptor_and_by_nothing_else() {
        let identity = |product, name: &str| Identity { vendor: 0x1209, product, name: name.to_owned() };
        let feeder = key(&identity(1, "one"), b"foobar");
        assert_eq!(feeder, "1209:0001:85944171f73967e8");
        assert_eq!(key(&identity(1, "another name"), b"foobar"), feeder);
        assert_ne!(key(&identity(2, "one"), b"foobar"), feeder);
        assert_ne!(key(&identity(1, "one"), b"foobaz"), feeder);
    }

    #[test]
    fn what_was_chosen_last_comes_back_where_it_fits_and_can_be_forgotten() {
        let by =
            |axis, travel| Mapping { feed: Some(AxisMapping::new(axis, Motion::Place, travel)), ..Mapping::default() };
        let mut known = KnownMappings::default();
        known.remember("a", 2, by(0, 50.0));
        known.remember("b", 2, by(1, 20.0));
        known.remember("a", 2, by(1, 80.0));
        assert_eq!(known.get("a", 2), Some(by(1, 80.0)));
        assert_eq!(known.get("a", 1), None, "there is no such axis");
        let text = serde_json::to_string(&known).unwrap();
        assert_eq!(serde_json::from_str::<KnownMappings>(&text).unwrap(), known);
        known.forget("a");
        assert_eq!((known.get("a", 2), known.has("a"), known.get("b", 2)), (None, false, Some(by(1, 20.0))));
        // Neither what no number says nor what belongs to no device; and not without end.
        known.remember("c", 2, by(0, f64::NAN));
        known.remember("", 2, by(0, 1.0));
        assert!(!known.has("c") && !known.has(""));
        (0..100).for_each(|i| known.remember(&i.to_string(), 2, by(0, 1.0)));
        assert!(known.0.len() == MAX_DEVICES && known.has("99") && !known.has("b"));
    }
}
