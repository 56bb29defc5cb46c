//! The volumes that some files hold, what tells them apart, and what their labels are called.

use lumen_message::messages;
use serde::{Deserialize, Serialize};

messages! {
    /// What tells the volumes of a series, or of a file, apart.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
    #[allow(missing_docs, reason = "its words say what each is")]
    pub enum VolumeField {
        "scan-by-time" Time => "temporal position",
        "scan-by-heart-phase" HeartPhase => "heart phase",
        "scan-by-trigger" Trigger => "trigger time",
        "scan-by-echo" Echo => "echo",
        "scan-by-b-value" BValue => "b-value",
        "scan-by-image-type" ImageType => "image type",
        "scan-by-stack" Stack => "stack",
        "scan-by-acquisition" Acquisition => "acquisition number",
        "scan-by-thickness" Thickness => "slice thickness",
        "scan-by-kernel" Kernel => "kernel",
        "scan-by-voltage" Voltage => "tube voltage",
        "scan-by-reference-frame" ReferenceFrame => "frame of reference",
        "scan-by-moment" Moment => "time",
        "scan-by-order" Order => "numbers of the slices",
        "scan-by-place" Place => "places of the slices",
        "scan-by-several" Several => "several fields",
        "scan-by-segment" Segment => "segment",
        "scan-by-layer" Layer => "layer",
    }
}

/// One of the volumes that some files hold.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Offer {
    /// The number of its series, from 0.
    pub series: usize,
    /// How many slices it has.
    pub slices: usize,
    /// What tells it from the others of its series.
    pub by: Option<VolumeField>,
    /// What it has there.
    pub value: String,
}

/// What a segmentation says of a label.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct LabelName {
    /// Its number.
    pub value: i64,
    /// Its name.
    pub name: String,
    /// The colour that it is to be shown in: red, green and blue of sRGB.
    pub colour: Option<[u8; 3]>,
}
