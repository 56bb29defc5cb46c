//! A report descriptor's bytes to a model (HID 1.11, 6.2.2).
//!
//! What is wrong in descriptors that are out there is read as Linux and Chromium read it: unknown items are stepped over,
//! a pop without a push is ignored, a greatest below 0 beside a least of 0 or more is meant without a sign. The crate
//! `hidreport` reads the same, but panics on an item of three bytes and makes an element of each of 2^32 counted fields; it
//! is what the tests compare with.

use super::field::{Content, Field, Range, Usages};
use super::model::{Collection, DeviceModel, Kind, Report};
use super::usage::Usage;
use lumen_message::messages;

/// The longest descriptor in bytes: USB has two for its length.
pub const LONGEST: usize = 65_535;
/// The longest report in bits: no system takes a longer one than 65535 bytes.
pub const LONGEST_REPORT: u64 = 65_535 * 8;
const DEEPEST: usize = 64;
const MAX_FIELDS: usize = 4096;
const MAX_PUSHED: usize = 64;

messages! {
    /// What is wrong with a device's reports.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ModelError {
        /// An item does not end within the bytes.
        "devices-descriptor-cut" Cut {
            /// Where the item begins.
            at: usize,
        } => "the report descriptor ends within the item at byte {at}",
        /// Longer than any device's.
        "devices-descriptor-long" Long {
            /// Its length.
            bytes: usize,
            /// The longest that is read.
            most: usize,
        } => "the report descriptor has {bytes} bytes, more than {most}",
        /// A report is longer than any system takes.
        "devices-report-long" Report {
            /// Its id.
            id: u8,
            /// The longest that is taken, in bytes.
            most: usize,
        } => "report {id} of the device is longer than {most} bytes",
        /// More than any device has.
        "devices-descriptor-many" Many {
            /// The most fields that are read.
            fields: usize,
            /// The deepest collection that is read.
            depth: usize,
        } => "the device has more than {fields} fields, or collections more than {depth} deep",
        /// A report's id that is 0 or more than a byte.
        "devices-report-id" Id {
            /// That.
            id: u32,
        } => "a report of the device has the id {id}, which is not 1 to 255",
    }
}

/// More fields or deeper collections than are read.
pub(super) const MANY: ModelError = ModelError::Many { fields: MAX_FIELDS, depth: DEEPEST };

/// A number as an item has it: without a sign, and how many bits it has.
#[derive(Clone, Copy, Debug, Default)]
struct Number {
    bits: u32,
    size: u32,
}

impl Number {
    fn unsigned(self) -> i64 {
        i64::from(self.bits)
    }

    fn signed(self) -> i64 {
        if self.size == 0 {
            return 0;
        }
        let unused = 32 - self.size;
        i64::from((self.bits << unused) as i32 >> unused)
    }
}

/// Least and greatest as they are meant: without a sign where the least has none.
fn range(least: Number, greatest: Number) -> Range {
    let least = least.signed();
    Range { least, greatest: if least < 0 { greatest.signed() } else { greatest.unsigned() } }
}

/// What holds until it is said otherwise.
#[derive(Clone, Debug, Default)]
struct Globals {
    page: u16,
    logical: [Number; 2],
    physical: [Number; 2],
    unit_exponent: Number,
    size: u32,
    count: u32,
}

/// What holds for the next main item: usages, with their own page where they have one.
#[derive(Clone, Debug, Default)]
struct Locals {
    usages: Vec<(Number, Number)>,
    first: Option<Number>,
    last: Option<Number>,
}

impl Locals {
    /// One end of a range; with the other they are one.
    fn pair(&mut self) {
        if let (Some(first), Some(last)) = (self.first, self.last) {
            self.usages.push((first, last));
            (self.first, self.last) = (None, None);
        }
    }

    fn usages(&self, page: u16) -> Usages {
        let of = |number: Number| {
            if number.size == 32 { Usage::from_bits(number.bits) } else { Usage::new(page, number.bits as u16) }
        };
        let mut usages = Usages::default();
        self.usages.iter().for_each(|&(first, last)| usages.push(of(first), of(last)));
        usages
    }
}

/// The model that a report descriptor describes.
///
/// # Errors
/// When the bytes end within an item, or describe more than any device has.
pub fn parse(bytes: &[u8]) -> Result<DeviceModel, ModelError> {
    if bytes.len() > LONGEST {
        return Err(ModelError::Long { bytes: bytes.len(), most: LONGEST });
    }
    let mut parser = Parser::default();
    let mut at = 0;
    while let Some(&prefix) = bytes.get(at) {
        let cut = ModelError::Cut { at };
        if prefix == 0xFE {
            // A long item, of which the specification defines none: its length, its tag, its data.
            let length = *bytes.get(at + 1).ok_or(cut)?;
            at += 3 + usize::from(length);
            if at > bytes.len() {
                return Err(cut);
            }
            continue;
        }
        let length = [0, 1, 2, 4][usize::from(prefix & 3)];
        let data = bytes.get(at + 1..at + 1 + length).ok_or(cut)?;
        let bits = data.iter().rev().fold(0, |bits, &byte| bits << 8 | u32::from(byte));
        parser.item(prefix & 0xFC, Number { bits, size: 8 * length as u32 })?;
        at += 1 + length;
    }
    parser.model.sort();
    Ok(parser.model)
}

#[derive(Default)]
struct Parser {
    model: DeviceModel,
    globals: Globals,
    pushed: Vec<Globals>,
    locals: Locals,
    /// The report's id is not pushed: it is of the device.
    id: u8,
    open: Vec<usize>,
    fields: usize,
}

impl Parser {
    fn item(&mut self, tag: u8, number: Number) -> Result<(), ModelError> {
        let Number { bits, .. } = number;
        match tag {
            0x80 => self.main(Kind::Input, bits)?,
            0x90 => self.main(Kind::Output, bits)?,
            0xB0 => self.main(Kind::Feature, bits)?,
            0xA0 => self.begin(bits)?,
            0xC0 => _ = self.open.pop(),
            0x04 => self.globals.page = bits as u16,
            0x14 => self.globals.logical[0] = number,
            0x24 => self.globals.logical[1] = number,
            0x34 => self.globals.physical[0] = number,
            0x44 => self.globals.physical[1] = number,
            0x54 => self.globals.unit_exponent = number,
            0x74 => self.globals.size = bits,
            0x84 => self.id = u8::try_from(bits).ok().filter(|id| *id != 0).ok_or(ModelError::Id { id: bits })?,
            0x94 => self.globals.count = bits,
            0xA4 if self.pushed.len() < MAX_PUSHED => self.pushed.push(self.globals.clone()),
            0xA4 => return Err(MANY),
            0xB4 => {
                if let Some(globals) = self.pushed.pop() {
                    self.globals = globals;
                }
            }
            0x08 => self.locals.usages.push((number, number)),
            0x18 => {
                self.locals.first = Some(number);
                self.locals.pair();
            }
            0x28 => {
                self.locals.last = Some(number);
                self.locals.pair();
            }
            // Units, strings, designators, delimiters, and what is reserved.
            _ => {}
        }
        // Locals are over with a main item.
        if tag & 0x0C == 0 {
            self.locals = Locals::default();
        }
        Ok(())
    }

    fn begin(&mut self, kind: u32) -> Result<(), ModelError> {
        if self.open.len() >= DEEPEST || self.model.collections.len() >= MAX_FIELDS {
            return Err(MANY);
        }
        let usage = self.locals.usages(self.globals.page).get(0).unwrap_or(Usage::new(self.globals.page, 0));
        self.model.collections.push(Collection { usage, kind: kind as u8, parent: self.open.last().copied() });
        self.open.push(self.model.collections.len() - 1);
        Ok(())
    }

    fn main(&mut self, kind: Kind, flags: u32) -> Result<(), ModelError> {
        // What is outside of all collections is no application's.
        let Some(&collection) = self.open.last() else { return Ok(()) };
        let globals = &self.globals;
        let item = Item {
            kind,
            id: self.id,
            size: globals.size,
            count: globals.count,
            usages: self.locals.usages(globals.page),
            logical: range(globals.logical[0], globals.logical[1]),
            physical: range(globals.physical[0], globals.physical[1]),
            unit_exponent: exponent(globals.unit_exponent),
            is_constant: flags & 0x01 != 0,
            is_variable: flags & 0x02 != 0,
            is_relative: flags & 0x04 != 0,
            wraps: flags & 0x08 != 0,
            has_null: flags & 0x40 != 0,
            collection,
        };
        self.fields += 1;
        if self.fields > MAX_FIELDS {
            return Err(MANY);
        }
        item.add_to(&mut self.model)
    }
}

/// A power of ten: the low four bits as two's complement, or a whole byte as some devices have it, which says the same.
fn exponent(number: Number) -> i8 {
    (((number.bits & 0x0F) << 4) as u8 as i8) >> 4
}

/// What a main item says, by either way.
#[derive(Debug)]
pub(super) struct Item {
    pub(super) kind: Kind,
    pub(super) id: u8,
    pub(super) size: u32,
    pub(super) count: u32,
    pub(super) usages: Usages,
    pub(super) logical: Range,
    pub(super) physical: Range,
    pub(super) unit_exponent: i8,
    pub(super) is_constant: bool,
    pub(super) is_variable: bool,
    pub(super) is_relative: bool,
    pub(super) wraps: bool,
    pub(super) has_null: bool,
    pub(super) collection: usize,
}

impl Item {
    /// Adds what it says at the end of its report; padding and what has no usage only makes it longer.
    pub(super) fn add_to(self, model: &mut DeviceModel) -> Result<(), ModelError> {
        let Self { kind, id, size, count, .. } = self;
        let place = model.reports.iter().position(|report| report.kind == kind && report.id == id);
        let place = place.unwrap_or_else(|| {
            model.reports.push(Report { kind, id, bits: 0, fields: Vec::new() });
            model.reports.len() - 1
        });
        let report = &mut model.reports[place];
        let bits = u64::from(report.bits) + u64::from(size) * u64::from(count);
        if bits > LONGEST_REPORT {
            return Err(ModelError::Report { id, most: LONGEST });
        }
        if !self.is_constant && !self.usages.is_empty() && size > 0 && count > 0 {
            // Both 0 means that nothing was said (HID 1.11, 6.2.2.7).
            let is_said = self.physical != Range::default();
            report.fields.push(Field {
                offset: report.bits,
                size,
                count,
                usages: self.usages,
                logical: self.logical,
                physical: if is_said { self.physical } else { self.logical },
                unit_exponent: self.unit_exponent,
                content: if self.is_variable { Content::Variable } else { Content::Array },
                is_relative: self.is_relative,
                wraps: self.wraps,
                has_null: self.has_null,
                collection: Some(self.collection),
            });
        }
        report.bits = bits as u32;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::fixtures::{descriptor, descriptors, elements, hostile, peer};
    use crate::usage::{desktop, pid};

    #[test]
    fn devices_are_read_as_another_parser_reads_them() {
        for (name, bytes) in descriptors() {
            assert_eq!(elements(&parse(&bytes).unwrap()), peer(&bytes), "{name}");
        }
    }

    #[test]
    fn reports_of_openffboard_are_as_long_as_its_firmware_has_them() {
        // The structures of its `ffb_defs.h`, without the id.
        let model = parse(&descriptor("openffboard-2")).unwrap();
        let bytes = |kind, id| model.report(kind, id).map(Report::bytes);
        assert_eq!((bytes(Kind::Input, 1), bytes(Kind::Input, 2)), (Some(24), Some(1)));
        let out = [(1, 21), (2, 13), (3, 14), (4, 11), (5, 3), (6, 5), (10, 3), (11, 1), (12, 1), (13, 1), (0xA1, 24)];
        for (id, length) in out {
            assert_eq!(bytes(Kind::Output, id), Some(length), "{id:#x}");
        }
        assert_eq!([0x11, 0x12, 0x13].map(|id| bytes(Kind::Feature, id)), [Some(3), Some(4), Some(4)]);
        assert!(model.is_a(desktop::JOYSTICK) && model.has_ids());
        let effect = model.report_in(Kind::Output, pid::SET_EFFECT_REPORT).unwrap();
        assert_eq!((effect.id, effect.find(pid::DURATION).unwrap().field.offset), (1, 16));
        let one = parse(&descriptor("openffboard-1")).unwrap();
        let enable = one.report(Kind::Output, 1).unwrap().find(pid::DIRECTION_ENABLE).unwrap();
        assert_eq!(enable.field.offset % 8, 1, "the bit behind the one axis");
    }

    #[test]
    fn what_is_wrong_is_said_or_stepped_over() {
        assert_eq!(parse(&[]), Ok(DeviceModel::default()));
        assert_eq!(parse(&[0x05]), Err(ModelError::Cut { at: 0 }));
        assert_eq!(parse(&[0xC0, 0xB4, 0x07, 1, 2, 3, 4]), Ok(DeviceModel::default()));
        assert_eq!(parse(&[0x85, 0]), Err(ModelError::Id { id: 0 }));
        assert_eq!(parse(&[0xFE, 2, 0xF0, 1]), Err(ModelError::Cut { at: 0 }));
        assert_eq!(parse(&[0xA1, 1].repeat(DEEPEST + 1)), Err(MANY));
        assert_eq!(parse(&vec![0; LONGEST + 1]), Err(ModelError::Long { bytes: LONGEST + 1, most: LONGEST }));
        // Two thousand million elements, which another parser makes room for.
        let endless = [0xA1, 1, 0x09, 1, 0x75, 8, 0x97, 0xFF, 0xFF, 0xFF, 0x7F, 0x81, 2];
        assert_eq!(parse(&endless), Err(ModelError::Report { id: 0, most: LONGEST }));
    }

    proptest! {
        #[test]
        fn no_bytes_make_it_panic_or_leave_a_field_outside_of_its_report(bytes in hostile(), report: [u8; 70]) {
            if let Ok(model) = parse(&bytes) {
                for of in &model.reports {
                    for field in &of.fields {
                        prop_assert!(u64::from(field.offset) + u64::from(field.size) * u64::from(field.count) <= u64::from(of.bits));
                        for element in [0, 1, field.count - 1] {
                            _ = (field.usage(element), field.read(&report, element), field.null());
                            let mut blank = [0; 70];
                            _ = field.write(&mut blank, element, field.clamp(i64::MIN));
                        }
                        prop_assert!(model.is_in(field, model.collections[field.collection.unwrap()].usage));
                    }
                }
            }
        }
    }
}
