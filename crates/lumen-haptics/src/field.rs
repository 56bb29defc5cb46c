//! A field of a report: where its bits are, what they are called, and numbers out of and into them (HID 1.11, 6.2.2.5 and
//! 5.8). Bits count from the least of the first byte; numbers are little-endian, signed by two's complement where the least
//! of the field is negative.

use super::usage::Usage;

/// The widest number that is read or written; wider elements are skipped over.
pub const WIDEST: u32 = 64;

/// Usages from the first to the last, both included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct UsageRange {
    /// The first.
    pub first: Usage,
    /// The last, not below the first.
    pub last: Usage,
}

impl UsageRange {
    fn len(self) -> u32 {
        (self.last.bits() - self.first.bits()).saturating_add(1)
    }
}

/// Usages in the order in which a descriptor has them. Neighbours are one range, so that a list and a range of the same
/// usages are equal.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Usages(Vec<UsageRange>);

impl Usages {
    /// Adds those from `first` to `last`; turned about where they are the wrong way round.
    pub fn push(&mut self, first: Usage, last: Usage) {
        let (first, last) = (first.min(last), first.max(last));
        match self.0.last_mut() {
            Some(range)
                if range.last.page() == first.page() && range.last.bits().checked_add(1) == Some(first.bits()) =>
            {
                range.last = last;
            }
            _ => self.0.push(UsageRange { first, last }),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// The one at a place, from 0.
    pub fn get(&self, mut place: u32) -> Option<Usage> {
        for range in &self.0 {
            if place < range.len() {
                return Some(Usage::from_bits(range.first.bits() + place));
            }
            place -= range.len();
        }
        None
    }

    /// The last.
    pub fn last(&self) -> Option<Usage> {
        self.0.last().map(|range| range.last)
    }

    /// The place of a usage, from 0.
    pub fn position(&self, usage: Usage) -> Option<u32> {
        let mut before = 0_u32;
        for range in &self.0 {
            if (range.first..=range.last).contains(&usage) {
                return before.checked_add(usage.bits() - range.first.bits());
            }
            before = before.checked_add(range.len())?;
        }
        None
    }
}

/// The least and the greatest of numbers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Range {
    /// The least.
    pub least: i64,
    /// The greatest, not below the least where a device makes sense.
    pub greatest: i64,
}

impl Range {
    /// From the least to the greatest.
    pub fn span(self) -> f64 {
        self.greatest as f64 - self.least as f64
    }
}

/// What stands in a field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Content {
    /// An element for each usage: its value.
    Variable,
    /// Elements that say which usages are on.
    Array,
}

/// A field: what one item of a descriptor adds to a report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Field {
    /// Its first bit in the report, without the id.
    pub offset: u32,
    /// Bits of an element.
    pub size: u32,
    /// Number of elements.
    pub count: u32,
    /// What they are called.
    pub usages: Usages,
    /// Of what is in the report.
    pub logical: Range,
    /// Of what that means; the logical one where the device says nothing.
    pub physical: Range,
    /// The power of ten of the physical unit.
    pub unit_exponent: i8,
    /// Variable or array.
    pub content: Content,
    /// Whether it tells changes, not states.
    pub is_relative: bool,
    /// Whether it goes on at the other end.
    pub wraps: bool,
    /// Whether numbers outside of the logical range mean nothing at all.
    pub has_null: bool,
    /// The innermost collection that it is in, by its number in the model.
    pub collection: Option<usize>,
}

impl Field {
    /// Whether numbers have a sign.
    pub fn is_signed(&self) -> bool {
        self.logical.least < 0
    }

    /// The usage of an element of a variable field: the last one holds for all that are left over (HID 1.11, 6.2.2.8).
    pub fn usage(&self, element: u32) -> Option<Usage> {
        (element < self.count).then(|| self.usages.get(element).or_else(|| self.usages.last()))?
    }

    /// The element of a variable field that has this usage.
    pub fn element(&self, usage: Usage) -> Option<u32> {
        let place = self.usages.position(usage).filter(|place| *place < self.count)?;
        (self.content == Content::Variable).then_some(place)
    }

    /// The number in an element; `None` where the report is too short, or the element wider than [`WIDEST`] or without a
    /// bit.
    pub fn read(&self, report: &[u8], element: u32) -> Option<i64> {
        let first = self.place(report.len(), element)?;
        let mut bits = 0_u64;
        for i in 0..self.size as usize {
            let at = first + i;
            bits |= u64::from(report[at / 8] >> (at % 8) & 1) << i;
        }
        let unused = WIDEST - self.size;
        Some(if self.is_signed() { (bits << unused) as i64 >> unused } else { bits as i64 })
    }

    /// Puts a number into an element, as it is; only the bits that fit. False where [`Field::read`] would find none.
    #[must_use]
    pub fn write(&self, report: &mut [u8], element: u32, value: i64) -> bool {
        let Some(first) = self.place(report.len(), element) else { return false };
        for i in 0..self.size as usize {
            let (byte, mask) = ((first + i) / 8, 1 << ((first + i) % 8));
            if value >> i & 1 == 1 { report[byte] |= mask } else { report[byte] &= !mask }
        }
        true
    }

    /// The first bit of an element that lies within so many bytes.
    fn place(&self, bytes: usize, element: u32) -> Option<usize> {
        if element >= self.count || !(1..=WIDEST).contains(&self.size) {
            return None;
        }
        let first = u64::from(self.offset) + u64::from(self.size) * u64::from(element);
        (first + u64::from(self.size) <= bytes as u64 * 8).then_some(first as usize)
    }

    /// Brings a number into the logical range and into the bits of an element.
    pub fn clamp(&self, value: i64) -> i64 {
        let Range { least, greatest } = self.logical;
        let value = if least <= greatest { value.clamp(least, greatest) } else { value };
        let bits = self.size.clamp(1, WIDEST - 1) - u32::from(self.is_signed());
        let most = if bits >= 63 { i64::MAX } else { (1_i64 << bits) - 1 };
        value.clamp(if self.is_signed() { -most - 1 } else { 0 }, most)
    }

    /// Whether a number says nothing: it is outside of the logical range, and the field has such numbers.
    pub fn is_null(&self, value: i64) -> bool {
        self.has_null && !(self.logical.least..=self.logical.greatest).contains(&value)
    }

    /// What stands for nothing: a number outside of the logical range that fits, where there is one.
    pub fn null(&self) -> Option<i64> {
        let Range { least, greatest } = self.logical;
        [0, greatest.checked_add(1)?, least.checked_sub(1)?]
            .into_iter()
            .find(|&value| !(least..=greatest).contains(&value) && self.fits(value))
    }

    fn fits(&self, value: i64) -> bool {
        let bits = self.size.clamp(1, WIDEST - 1) - u32::from(self.is_signed());
        let most = if bits >= 63 { i64::MAX } else { (1_i64 << bits) - 1 };
        ((if self.is_signed() { -most - 1 } else { 0 })..=most).contains(&value)
    }

    /// The physical number of a logical one (HID 1.11, 6.2.2.7), without its unit's exponent.
    pub fn to_physical(&self, logical: i64) -> f64 {
        let span = self.logical.span();
        if span == 0.0 {
            return logical as f64;
        }
        self.physical.least as f64 + (logical as f64 - self.logical.least as f64) * self.physical.span() / span
    }

    /// The logical number nearest to a physical one, within range; the least where that is no number.
    pub fn from_physical(&self, physical: f64) -> i64 {
        let span = self.physical.span();
        let part = if span == 0.0 { 0.0 } else { (physical - self.physical.least as f64) / span };
        self.from_part(part)
    }

    /// The number at a part of the logical range: 0 the least, 1 the greatest, and between.
    pub fn from_part(&self, part: f64) -> i64 {
        let part = if part.is_nan() { 0.0 } else { part.clamp(0.0, 1.0) };
        self.clamp((self.logical.least as f64 + part * self.logical.span()).round() as i64)
    }

    /// The number for -1 to 1 around the middle of a range with a sign, or for 0 to 1 of one without, which has 0 below.
    pub fn from_signed(&self, value: f64) -> i64 {
        let value = if value.is_nan() { 0.0 } else { value.clamp(-1.0, 1.0) };
        if self.logical.least < 0 {
            let most = (self.logical.greatest as f64).min(-(self.logical.least as f64));
            self.clamp((value * most).round() as i64)
        } else {
            self.from_part(0.5 + 0.5 * value)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn field(offset: u32, size: u32, count: u32, logical: Range) -> Field {
        Field {
            offset,
            size,
            count,
            usages: Usages::default(),
            logical,
            physical: logical,
            unit_exponent: 0,
            content: Content::Variable,
            is_relative: false,
            wraps: false,
            has_null: false,
            collection: None,
        }
    }

    #[test]
    fn bits_are_where_the_specification_has_them() {
        // HID 1.11, 8.4: the least bit first, over the bytes' edges.
        let report = [0b1010_0101, 0b0000_1111];
        let of = |offset, size, least| field(offset, size, 1, Range { least, greatest: 127 }).read(&report, 0);
        assert_eq!(of(0, 4, 0), Some(0b0101));
        assert_eq!(of(4, 8, 0), Some(0b1111_1010));
        assert_eq!(of(4, 8, -1), Some(-6));
        assert_eq!(of(5, 11, 0), Some(0b000_0111_1101));
        assert_eq!(of(6, 11, 0), None);
        assert_eq!(field(0, 65, 1, Range::default()).read(&[0; 20], 0), None);
        assert_eq!(field(0, 0, 3, Range::default()).read(&[0; 20], 0), None);
    }

    #[test]
    fn a_list_and_a_range_of_the_same_usages_are_equal() {
        let (mut list, mut range) = (Usages::default(), Usages::default());
        (1..=4).for_each(|id| list.push(Usage::new(9, id), Usage::new(9, id)));
        range.push(Usage::new(9, 4), Usage::new(9, 1));
        assert_eq!(list, range);
        assert_eq!((list.get(3), list.get(4)), (Some(Usage::new(9, 4)), None));
        assert_eq!(list.position(Usage::new(9, 3)), Some(2));
        let mut whole = Usages::default();
        whole.push(Usage::from_bits(0), Usage::from_bits(u32::MAX));
        assert_eq!(whole.position(Usage::from_bits(u32::MAX)), Some(u32::MAX));
    }

    #[test]
    fn numbers_are_scaled_as_the_specification_says() {
        // HID 1.11, 6.2.2.7: -127 to 127 that mean -3175 to 3175 of ten-thousandths of an inch are 400 a unit... of 10000.
        let mut counts = field(0, 8, 1, Range { least: -127, greatest: 127 });
        counts.physical = Range { least: -3175, greatest: 3175 };
        assert!((counts.to_physical(4) - 100.0).abs() < 1e-9);
        assert_eq!(counts.from_physical(100.0), 4);
        assert_eq!((counts.from_signed(-1.0), counts.from_signed(f64::NAN), counts.from_signed(9.0)), (-127, 0, 127));
        let half = field(0, 8, 1, Range { least: 0, greatest: 255 });
        assert_eq!((half.from_part(1.0), half.from_part(0.5), half.null()), (255, 128, None));
        // A trigger button of 1 to 8 in eight bits has 0 for none.
        assert_eq!(field(0, 8, 1, Range { least: 1, greatest: 8 }).null(), Some(0));
        assert_eq!(field(0, 4, 1, Range { least: 0, greatest: 7 }).null(), Some(8));
    }

    proptest! {
        #[test]
        fn what_is_written_is_read(
            offset in 0_u32..40, size in 1_u32..=64, element in 0_u32..3, value: i64, signed: bool, fill: u8,
        ) {
            let logical = if signed { Range { least: i64::MIN, greatest: i64::MAX } } else { Range { least: 0, greatest: i64::MAX } };
            let field = field(offset, size, 3, logical);
            let mut report = [fill; 40];
            prop_assert!(field.write(&mut report, element, value));
            let back = field.read(&report, element).unwrap();
            let mask = if size == 64 { u64::MAX } else { (1 << size) - 1 };
            prop_assert_eq!(back as u64 & mask, value as u64 & mask);
            if size < 64 {
                let clamped = field.clamp(value);
                prop_assert!(field.write(&mut report, element, clamped));
                prop_assert_eq!(field.read(&report, element), Some(clamped));
            }
            // Nothing beside it has changed.
            let first = (offset + size * element) as usize;
            for bit in (0..320).filter(|bit| !(first..first + size as usize).contains(bit)) {
                prop_assert_eq!(report[bit / 8] >> (bit % 8) & 1, fill >> (bit % 8) & 1);
            }
        }

        #[test]
        fn nothing_panics(offset: u32, size: u32, count: u32, element: u32, value: i64, least: i64, greatest: i64, part: f64) {
            let field = field(offset, size, count, Range { least, greatest });
            let mut report = [0; 9];
            _ = (field.read(&report, element), field.write(&mut report, element, value), field.clamp(value), field.null());
            _ = (field.from_part(part), field.from_signed(part), field.from_physical(part), field.to_physical(value));
        }
    }
}
