//! Descriptors of devices, and what Chromium makes of one, for tests.

use hidreport::Report as _;
use hidreport::hid::{Item, ReportDescriptorItems};
use proptest::prelude::*;

use super::field::{Content, Field};
use super::model::{DeviceModel, Kind, Report};
use super::webhid::{CollectionInfo, ReportInfo, ReportItem};

/// The bytes of a file of hexadecimal numbers, with comments behind `#`.
fn hex(text: &str) -> Vec<u8> {
    let lines = text.lines().filter(|line| !line.starts_with('#'));
    lines.flat_map(str::split_whitespace).map(|byte| u8::from_str_radix(byte, 16).unwrap()).collect()
}

/// Descriptors of devices, each with its name.
pub(super) fn descriptors() -> Vec<(&'static str, Vec<u8>)> {
    [
        ("openffboard-1", include_str!("../fixtures/openffboard-1.hex")),
        ("openffboard-2", include_str!("../fixtures/openffboard-2.hex")),
        ("openffboard-2-32", include_str!("../fixtures/openffboard-2-32.hex")),
        ("spacenavigator", include_str!("../fixtures/spacenavigator.hex")),
        ("logitech-g29", include_str!("../fixtures/logitech-g29.hex")),
    ]
    .into_iter()
    .map(|(name, text)| (name, hex(text)))
    .collect()
}

/// The descriptor of this name.
pub(super) fn descriptor(name: &str) -> Vec<u8> {
    descriptors().into_iter().find(|(of, _)| *of == name).unwrap().1
}

/// What Chromium's `HIDDevice.collections` has for a descriptor, after its `hid_collection.cc`: items go to their collection
/// and to all around it, reports have no order, a range of one usage is none. Split into items by `hidreport`.
pub(super) fn chromium(bytes: &[u8]) -> Vec<CollectionInfo> {
    #[derive(Clone, Default)]
    struct Globals {
        page: u32,
        limits: [i32; 4],
        exponent: u32,
        size: u32,
        count: u32,
    }
    let mut top: Vec<CollectionInfo> = Vec::new();
    let mut path: Vec<usize> = Vec::new();
    let (mut globals, mut stack, mut id) = (Globals::default(), Vec::new(), 0);
    let (mut usages, mut ends) = (Vec::new(), [0_u32; 2]);
    for item in ReportDescriptorItems::try_from(bytes).unwrap().iter() {
        let item = item.item();
        let (prefix, data) = (item.bytes()[0], &item.bytes()[1..]);
        let value = data.iter().rev().fold(0_u32, |value, &byte| value << 8 | u32::from(byte));
        let signed = match data.len() {
            1 => i32::from(value as i8),
            2 => i32::from(value as i16),
            _ => value as i32,
        };
        let usage = if data.len() == 4 { value } else { globals.page << 16 | value };
        let limit = usize::from(prefix >> 4).wrapping_sub(1);
        match prefix & 0xFC {
            0x04 => globals.page = value,
            0x14 | 0x24 | 0x34 | 0x44 => {
                let below = limit % 2 == 1 && globals.limits[limit - 1] < 0;
                globals.limits[limit] = if limit % 2 == 0 || below { signed } else { value as i32 };
            }
            0x54 => globals.exponent = value,
            0x74 => globals.size = value,
            0x84 => id = value as u8,
            0x94 => globals.count = value,
            0xA4 => stack.push(globals.clone()),
            0xB4 => globals = stack.pop().unwrap(),
            0x08 => usages.push(usage),
            0x18 => ends[0] = usage,
            0x28 => ends[1] = usage,
            0xA0 => {
                let usage = usages.first().copied().unwrap_or(globals.page << 16);
                let info = CollectionInfo {
                    usage_page: (usage >> 16) as u16,
                    usage: usage as u16,
                    kind: value as u8,
                    ..CollectionInfo::default()
                };
                let siblings = path.iter().fold(&mut top, |inner, &at| &mut inner[at].children);
                siblings.push(info);
                path.push(siblings.len() - 1);
            }
            0xC0 => _ = path.pop(),
            0x80 | 0x90 | 0xB0 => {
                let item = ReportItem {
                    is_absolute: value & 4 == 0,
                    is_array: value & 2 == 0,
                    is_constant: value & 1 == 1,
                    is_range: ends[0] != ends[1],
                    has_null: value & 0x40 != 0,
                    wrap: value & 8 != 0,
                    usages: usages.clone(),
                    usage_minimum: ends[0],
                    usage_maximum: ends[1],
                    report_size: globals.size,
                    report_count: globals.count,
                    unit_exponent: ((globals.exponent << 4) as u8 as i8) >> 4,
                    logical_minimum: globals.limits[0],
                    logical_maximum: globals.limits[1],
                    physical_minimum: globals.limits[2],
                    physical_maximum: globals.limits[3],
                };
                let mut inner = &mut top;
                for &at in &path {
                    let info = &mut inner[at];
                    let reports = match prefix & 0xFC {
                        0x80 => &mut info.input_reports,
                        0x90 => &mut info.output_reports,
                        _ => &mut info.feature_reports,
                    };
                    // The newest report first: they are in no order.
                    let known = reports.iter().position(|report| report.report_id == id);
                    let known = known.unwrap_or_else(|| {
                        reports.insert(0, ReportInfo { report_id: id, items: Vec::new() });
                        0
                    });
                    reports[known].items.push(item.clone());
                    inner = &mut info.children;
                }
            }
            _ => {}
        }
        if prefix & 0x0C == 0 {
            (usages, ends) = (Vec::new(), [0; 2]);
        }
    }
    top
}

/// A report: kind, id, bits, and of each element its first bit, usage, least and greatest; of an array its first usage.
pub(super) type Elements = (Kind, u8, u32, Vec<(u32, u32, i64, i64)>);

/// What `hidreport` finds: of each report its id, and of each element its first bit, usage, least and greatest.
pub(super) fn peer(bytes: &[u8]) -> Vec<Elements> {
    use hidreport::Field::{Array, Constant, Variable};
    let model = hidreport::ReportDescriptor::try_from(bytes).unwrap();
    let of = |kind: Kind, report: &dyn Fn() -> (u8, u32, Vec<hidreport::Field>)| {
        let (id, bits, fields) = report();
        let before = if id == 0 { 0 } else { 8 };
        let elements = fields.iter().filter_map(|field| match field {
            Variable(field) => Some((
                field.bits.start as u32 - before,
                u32::from(field.usage),
                i64::from(i32::from(field.logical_minimum)),
                i64::from(i32::from(field.logical_maximum)),
            )),
            Array(field) => Some((
                field.bits.start as u32 - before,
                u32::from(*field.usages().first().unwrap()),
                i64::from(i32::from(field.logical_minimum)),
                i64::from(i32::from(field.logical_maximum)),
            )),
            Constant(_) => None,
        });
        (kind, id, bits - before, elements.collect())
    };
    let mut all = Vec::new();
    macro_rules! each {
        ($kind:expr, $reports:expr) => {
            for report in $reports {
                let id = report.report_id().map_or(0, |id| u8::from(id));
                all.push(of($kind, &|| (id, report.size_in_bits() as u32, report.fields().to_vec())));
            }
        };
    }
    each!(Kind::Input, model.input_reports());
    each!(Kind::Output, model.output_reports());
    each!(Kind::Feature, model.feature_reports());
    all.sort_by_key(|(kind, id, ..)| (*kind, *id));
    all
}

/// The same of a model.
pub(super) fn elements(model: &DeviceModel) -> Vec<Elements> {
    let of = |field: &Field| {
        let count = if field.content == Content::Array { 1 } else { field.count };
        let element = |element| {
            let usage = field.usage(element).unwrap().bits();
            (field.offset + element * field.size, usage, field.logical.least, field.logical.greatest)
        };
        (0..count).map(element).collect::<Vec<_>>()
    };
    let of = |report: &Report| (report.kind, report.id, report.bits, report.fields.iter().flat_map(of).collect());
    model.reports.iter().map(of).collect()
}

/// Bytes that look like a descriptor.
pub(super) fn hostile() -> impl Strategy<Value = Vec<u8>> {
    let tags = [
        0x05, 0x09, 0x0B, 0x15, 0x17, 0x19, 0x25, 0x27, 0x29, 0x75, 0x77, 0x81, 0x85, 0x91, 0x95, 0x97, 0xA1, 0xA4,
        0xB1, 0xB4, 0xC0,
    ];
    let bytes = prop_oneof![any::<u8>(), proptest::sample::select(tags.to_vec())];
    prop_oneof![
        proptest::collection::vec(bytes, 0..200),
        // A device's own with a few bytes changed.
        (0..descriptors().len(), proptest::collection::vec((any::<proptest::sample::Index>(), any::<u8>()), 0..6))
            .prop_map(|(device, changes)| {
                let mut bytes = descriptors().swap_remove(device).1;
                for (at, byte) in changes {
                    let at = at.index(bytes.len());
                    bytes[at] = byte;
                }
                bytes
            }),
    ]
}
