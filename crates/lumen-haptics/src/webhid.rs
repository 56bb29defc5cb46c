//! What a browser tells of a device (WICG, WebHID, `HIDCollectionInfo`) to a model.
//!
//! A browser parses the report descriptor itself and lists, for each collection, the reports in it with their items. An item
//! stands in its own collection and in all around it (Chromium does so), so the outermost ones have whole reports, in the
//! order of their bits; which inner collection an item is of is found by going down into the children. Reports have no order
//! among each other, and a range of one usage may be told as none.

use serde::{Deserialize, Serialize};

use super::descriptor::{Item, MANY, ModelError};
use super::field::{Range, Usages};
use super::model::{Collection, DeviceModel, Kind};
use super::usage::Usage;

const DEEPEST: usize = 64;

/// A collection, by the names that the browser gives its attributes.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct CollectionInfo {
    /// The page of its usage.
    pub usage_page: u16,
    /// The number of its usage.
    pub usage: u16,
    /// Physical 0, application 1, logical 2, and on.
    #[serde(rename = "type")]
    pub kind: u8,
    /// Those in it.
    pub children: Vec<CollectionInfo>,
    /// Reports from the device.
    pub input_reports: Vec<ReportInfo>,
    /// Reports to the device.
    pub output_reports: Vec<ReportInfo>,
    /// Reports that go either way.
    pub feature_reports: Vec<ReportInfo>,
}

/// A report's items in a collection.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct ReportInfo {
    /// Its id; 0 where the device has none.
    pub report_id: u8,
    /// In the order of their bits.
    pub items: Vec<ReportItem>,
}

/// An item.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub struct ReportItem {
    /// Tells states, not changes.
    pub is_absolute: bool,
    /// Says which usages are on.
    pub is_array: bool,
    /// Padding.
    pub is_constant: bool,
    /// Usages are from a least to a greatest.
    pub is_range: bool,
    /// Numbers outside of the range mean nothing.
    pub has_null: bool,
    /// Goes on at the other end.
    pub wrap: bool,
    /// Usages, page and number in one, where it is no range.
    pub usages: Vec<u32>,
    /// The first, where it is a range.
    pub usage_minimum: u32,
    /// The last.
    pub usage_maximum: u32,
    /// Bits of an element.
    pub report_size: u32,
    /// Number of elements.
    pub report_count: u32,
    /// The power of ten of the physical unit.
    pub unit_exponent: i8,
    /// The least that is in the report.
    pub logical_minimum: i32,
    /// The greatest.
    pub logical_maximum: i32,
    /// What the least means.
    pub physical_minimum: i32,
    /// What the greatest means.
    pub physical_maximum: i32,
}

/// The model that a browser's list of collections describes: that of the device's report descriptor.
///
/// # Errors
/// When they describe more than any device has.
pub fn model(collections: &[CollectionInfo]) -> Result<DeviceModel, ModelError> {
    let mut model = DeviceModel::default();
    for info in collections {
        let number = add(&mut model, info, None, 0)?;
        for (kind, reports) in info.reports() {
            for report in reports {
                let children = numbered(&model, info, number);
                let mut items = Vec::new();
                place(&model, kind, report.report_id, &report.items, number, &children, &mut items);
                for (item, collection) in items {
                    item.as_item(kind, report.report_id, collection).add_to(&mut model)?;
                }
            }
        }
    }
    model.sort();
    Ok(model)
}

impl CollectionInfo {
    fn reports(&self) -> [(Kind, &[ReportInfo]); 3] {
        [
            (Kind::Input, &self.input_reports),
            (Kind::Output, &self.output_reports),
            (Kind::Feature, &self.feature_reports),
        ]
    }

    /// Its items in a report.
    fn items(&self, kind: Kind, id: u8) -> &[ReportItem] {
        let of_kind = self.reports().into_iter().find(|(of, _)| *of == kind).map_or(&[][..], |(_, reports)| reports);
        of_kind.iter().find(|report| report.report_id == id).map_or(&[], |report| &report.items)
    }
}

/// Numbers a collection and all in it, from outside in.
fn add(
    model: &mut DeviceModel,
    info: &CollectionInfo,
    parent: Option<usize>,
    depth: usize,
) -> Result<usize, ModelError> {
    if depth >= DEEPEST || model.collections.len() >= 4096 {
        return Err(MANY);
    }
    let number = model.collections.len();
    model.collections.push(Collection { usage: Usage::new(info.usage_page, info.usage), kind: info.kind, parent });
    for child in &info.children {
        add(model, child, Some(number), depth + 1)?;
    }
    Ok(number)
}

/// The children of a collection with the numbers that [`add`] has given them.
fn numbered<'a>(model: &DeviceModel, info: &'a CollectionInfo, number: usize) -> Vec<(usize, &'a CollectionInfo)> {
    let numbers =
        (number + 1..model.collections.len()).filter(|&child| model.collections[child].parent == Some(number));
    numbers.zip(&info.children).collect()
}

/// Says of each item of a report which collection it is of: a child's items are a run of its parent's, and the children
/// follow each other.
fn place<'a>(
    model: &DeviceModel,
    kind: Kind,
    id: u8,
    items: &'a [ReportItem],
    number: usize,
    children: &[(usize, &'a CollectionInfo)],
    placed: &mut Vec<(&'a ReportItem, usize)>,
) {
    let mut at = 0;
    for &(child, info) in children {
        let run = info.items(kind, id);
        if run.is_empty() {
            continue;
        }
        let begin = (at..items.len()).find(|&begin| items[begin..].starts_with(run));
        // A browser that lists an item only where it is has it after those of the parent.
        let end = begin.unwrap_or(items.len()).max(at);
        placed.extend(items[at..end].iter().map(|item| (item, number)));
        place(model, kind, id, run, child, &numbered(model, info, child), placed);
        at = if begin.is_some() { end + run.len() } else { end };
    }
    placed.extend(items[at..].iter().map(|item| (item, number)));
}

impl ReportItem {
    fn as_item(&self, kind: Kind, id: u8, collection: usize) -> Item {
        let mut usages = Usages::default();
        let (first, last) = (Usage::from_bits(self.usage_minimum), Usage::from_bits(self.usage_maximum));
        if self.is_range || self.usages.is_empty() && last.bits() != 0 {
            usages.push(first, last);
        } else {
            self.usages.iter().for_each(|&usage| usages.push(Usage::from_bits(usage), Usage::from_bits(usage)));
        }
        Item {
            kind,
            id,
            size: self.report_size,
            count: self.report_count,
            usages,
            logical: range(self.logical_minimum, self.logical_maximum),
            physical: range(self.physical_minimum, self.physical_maximum),
            unit_exponent: self.unit_exponent,
            is_constant: self.is_constant,
            is_variable: !self.is_array,
            is_relative: !self.is_absolute,
            wraps: self.wrap,
            has_null: self.has_null,
            collection,
        }
    }
}

/// The browser's numbers have signs: a greatest below a least that has none is meant without.
fn range(least: i32, greatest: i32) -> Range {
    let without = least >= 0 && greatest < 0;
    Range { least: least.into(), greatest: if without { i64::from(greatest as u32) } else { greatest.into() } }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::descriptor::parse;
    use crate::fixtures::{chromium, descriptors};
    use crate::usage::pid;

    #[test]
    fn a_device_is_the_same_by_its_bytes_and_by_what_the_browser_tells() {
        for (name, bytes) in descriptors() {
            assert_eq!(model(&chromium(&bytes)).unwrap(), parse(&bytes).unwrap(), "{name}");
        }
    }

    #[test]
    fn what_a_browser_has_as_an_object_is_read() {
        // As the WebHID Explorer printed it for a G29 (github.com/nightmode/logitech-g29, issue 8), its names as in the
        // specification; what is not said is as if it were none.
        let text = r#"[{"usagePage":1,"usage":4,"type":1,"children":[],"inputReports":[{"reportId":1,"items":[
            {"isAbsolute":true,"isArray":false,"isConstant":false,"isRange":false,"usages":[65584,65585,65586,65589],
             "reportSize":8,"reportCount":4,"logicalMinimum":0,"logicalMaximum":255},
            {"isAbsolute":true,"hasNull":true,"usages":[65593],"reportSize":4,"reportCount":1,
             "logicalMinimum":0,"logicalMaximum":7,"physicalMinimum":0,"physicalMaximum":315,"unitSystem":"english-rotation"},
            {"isAbsolute":true,"isRange":true,"usageMinimum":589825,"usageMaximum":589838,"reportSize":1,"reportCount":14,
             "logicalMinimum":0,"logicalMaximum":1}]}]}]"#;
        let browser = model(&serde_json::from_str::<Vec<CollectionInfo>>(text).unwrap()).unwrap();
        let bytes = parse(&crate::fixtures::descriptor("logitech-g29")).unwrap();
        let (ours, theirs) = (browser.report(Kind::Input, 1).unwrap(), bytes.report(Kind::Input, 1).unwrap());
        assert_eq!(ours.fields[..2], theirs.fields[..2]);
        assert_eq!(ours.fields[2].usages, theirs.fields[2].usages);
    }

    #[test]
    fn one_item_in_the_child_alone_is_placed_too() {
        let item = ReportItem { usages: vec![0x000F_0022], report_size: 8, report_count: 1, ..ReportItem::default() };
        let report = |items: &[ReportItem]| vec![ReportInfo { report_id: 3, items: items.to_vec() }];
        let child = CollectionInfo {
            usage_page: 0x0F,
            usage: 0x90,
            kind: 2,
            output_reports: report(std::slice::from_ref(&item)),
            ..CollectionInfo::default()
        };
        let whole = CollectionInfo {
            kind: 1,
            children: vec![child],
            output_reports: report(std::slice::from_ref(&item)),
            ..CollectionInfo::default()
        };
        let known = model(&[whole]).unwrap();
        assert_eq!(known.report_in(Kind::Output, pid::BLOCK_FREE_REPORT).unwrap().bits, 8);
    }

    fn item() -> impl Strategy<Value = ReportItem> {
        (any::<[bool; 6]>(), any::<[u32; 5]>(), any::<[i32; 4]>(), 0_u32..3).prop_map(
            |(flags, numbers, limits, usages)| ReportItem {
                is_absolute: flags[0],
                is_array: flags[1],
                is_constant: flags[2],
                is_range: flags[3],
                has_null: flags[4],
                wrap: flags[5],
                usages: (0..usages).collect(),
                usage_minimum: numbers[0],
                usage_maximum: numbers[1],
                report_size: if numbers[2] % 2 == 0 { numbers[3] } else { numbers[3] % 40 },
                report_count: if numbers[2] % 3 == 0 { numbers[4] } else { numbers[4] % 40 },
                unit_exponent: 0,
                logical_minimum: limits[0],
                logical_maximum: limits[1],
                physical_minimum: limits[2],
                physical_maximum: limits[3],
            },
        )
    }

    fn collection() -> impl Strategy<Value = CollectionInfo> {
        let reports = || {
            let report = (0_u8..4, proptest::collection::vec(item(), 0..3));
            proptest::collection::vec(report.prop_map(|(report_id, items)| ReportInfo { report_id, items }), 0..2)
        };
        let leaf = move || {
            let all = (any::<u16>(), any::<u16>(), reports(), reports(), reports());
            all.prop_map(|(usage_page, usage, input_reports, output_reports, feature_reports)| {
                let kind = 1;
                let children = Vec::new();
                CollectionInfo { usage_page, usage, kind, children, input_reports, output_reports, feature_reports }
            })
        };
        leaf().prop_recursive(4, 16, 3, move |inner| {
            let children = proptest::collection::vec(inner, 0..3);
            (leaf(), children).prop_map(|(outer, children)| CollectionInfo { children, ..outer })
        })
    }

    proptest! {
        #[test]
        fn no_collections_make_it_panic(collections in proptest::collection::vec(collection(), 0..3)) {
            if let Ok(model) = model(&collections) {
                for report in &model.reports {
                    for field in &report.fields {
                        let bits = u64::from(field.offset) + u64::from(field.size) * u64::from(field.count);
                        prop_assert!(bits <= u64::from(report.bits) && field.collection.unwrap() < model.collections.len());
                    }
                }
            }
        }
    }
}
