//! What a device's reports are, however that was learnt: from the bytes of its report descriptor or from what a browser
//! tells. The same device gives the same model by both ways.

use super::field::Field;
use super::usage::Usage;

/// Which way a report goes.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// From the device, when it likes.
    Input,
    /// To the device.
    Output,
    /// Either way, when the host asks.
    Feature,
}

/// Fields that belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Collection {
    /// What it is.
    pub usage: Usage,
    /// Physical 0, application 1, logical 2, and on (HID 1.11, 6.2.2.6).
    pub kind: u8,
    /// The one around it, by its number.
    pub parent: Option<usize>,
}

/// A report.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Report {
    /// Which way it goes.
    pub kind: Kind,
    /// Its id; 0 where the device has none.
    pub id: u8,
    /// Its length in bits, without the id, padding included.
    pub bits: u32,
    /// What is in it, without padding.
    pub fields: Vec<Field>,
}

/// An element of a field.
#[derive(Clone, Copy, Debug)]
pub struct Slot<'a> {
    /// The field.
    pub field: &'a Field,
    /// Which element.
    pub element: u32,
}

impl Slot<'_> {
    /// [`Field::read`].
    pub fn read(self, report: &[u8]) -> Option<i64> {
        self.field.read(report, self.element)
    }

    /// [`Field::write`].
    #[must_use]
    pub fn write(self, report: &mut [u8], value: i64) -> bool {
        self.field.write(report, self.element, value)
    }
}

impl Report {
    /// Its length in bytes, without the id.
    pub fn bytes(&self) -> usize {
        self.bits.div_ceil(8) as usize
    }

    /// A report with nothing in it.
    pub fn blank(&self) -> Vec<u8> {
        vec![0; self.bytes()]
    }

    /// The first element of a variable field with this usage.
    pub fn find(&self, usage: Usage) -> Option<Slot<'_>> {
        self.fields.iter().find_map(|field| Some(Slot { field, element: field.element(usage)? }))
    }
}

/// All reports of a device, or of one of its interfaces.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceModel {
    /// From outside in, in the order of the descriptor.
    pub collections: Vec<Collection>,
    /// By kind and id.
    pub reports: Vec<Report>,
}

impl DeviceModel {
    /// The report of this kind and id.
    pub fn report(&self, kind: Kind, id: u8) -> Option<&Report> {
        self.reports.iter().find(|report| report.kind == kind && report.id == id)
    }

    /// Whether reports have ids: then a transport that wants raw bytes has one before each.
    pub fn has_ids(&self) -> bool {
        self.reports.iter().any(|report| report.id != 0)
    }

    /// Whether a field is in a collection of this usage, however deep.
    pub fn is_in(&self, field: &Field, usage: Usage) -> bool {
        self.around(field.collection).any(|collection| collection.usage == usage)
    }

    /// Whether there is a collection of this usage at the top.
    pub fn is_a(&self, usage: Usage) -> bool {
        self.collections.iter().any(|collection| collection.parent.is_none() && collection.usage == usage)
    }

    /// A collection and those around it. A parent has a smaller number, so that this ends.
    fn around(&self, innermost: Option<usize>) -> impl Iterator<Item = &Collection> {
        let get = |number: Option<usize>| number.and_then(|number| Some((number, self.collections.get(number)?)));
        std::iter::successors(get(innermost), move |&(number, collection)| {
            get(collection.parent.filter(|parent| *parent < number))
        })
        .map(|(_, collection)| collection)
    }

    /// The first report of a kind that has a field in a collection of this usage.
    pub fn report_in(&self, kind: Kind, usage: Usage) -> Option<&Report> {
        let has = |report: &&Report| report.kind == kind && report.fields.iter().any(|field| self.is_in(field, usage));
        self.reports.iter().find(has)
    }

    /// Puts reports into their order.
    pub(super) fn sort(&mut self) {
        self.reports.sort_by_key(|report| (report.kind, report.id));
    }
}
