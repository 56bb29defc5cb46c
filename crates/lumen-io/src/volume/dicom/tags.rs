//! The elements of DICOM that are looked at (PS3.6), and where they may stand. Nothing else of a file is kept: no name, no date.

use dicom_core::Tag;

/// Which letters texts are written in (the specific character set).
pub(super) const LETTERS: Tag = Tag(0x0008, 0x0005);
pub(super) const SOP_INSTANCE: Tag = Tag(0x0008, 0x0018);
pub(super) const MODALITY: Tag = Tag(0x0008, 0x0060);
pub(super) const THICKNESS: Tag = Tag(0x0018, 0x0050);
pub(super) const BETWEEN: Tag = Tag(0x0018, 0x0088);
pub(super) const SERIES: Tag = Tag(0x0020, 0x000E);
pub(super) const POSITION: Tag = Tag(0x0020, 0x0032);
pub(super) const ORIENTATION: Tag = Tag(0x0020, 0x0037);
pub(super) const SAMPLES: Tag = Tag(0x0028, 0x0002);
pub(super) const PHOTOMETRIC: Tag = Tag(0x0028, 0x0004);
pub(super) const FRAMES: Tag = Tag(0x0028, 0x0008);
pub(super) const ROWS: Tag = Tag(0x0028, 0x0010);
pub(super) const COLUMNS: Tag = Tag(0x0028, 0x0011);
pub(super) const SPACING: Tag = Tag(0x0028, 0x0030);
pub(super) const ALLOCATED: Tag = Tag(0x0028, 0x0100);
pub(super) const STORED: Tag = Tag(0x0028, 0x0101);
pub(super) const SIGNED: Tag = Tag(0x0028, 0x0103);
pub(super) const INTERCEPT: Tag = Tag(0x0028, 0x1052);
pub(super) const SLOPE: Tag = Tag(0x0028, 0x1053);
/// A sequence with a table of what stored numbers stand for.
pub(super) const VALUE_TABLE: Tag = Tag(0x0028, 0x3000);
pub(super) const SEGMENTATION_TYPE: Tag = Tag(0x0062, 0x0001);
pub(super) const LARGEST_FRACTION: Tag = Tag(0x0062, 0x000E);
pub(super) const FLOAT_PIXELS: Tag = Tag(0x7FE0, 0x0008);
pub(super) const DOUBLE_PIXELS: Tag = Tag(0x7FE0, 0x0009);
pub(super) const PIXELS: Tag = Tag(0x7FE0, 0x0010);

// What tells the volumes of a series apart.
pub(super) const IMAGE_TYPE: Tag = Tag(0x0008, 0x0008);
pub(super) const ACQUISITION_MOMENT: Tag = Tag(0x0008, 0x002A);
pub(super) const ACQUISITION_TIME: Tag = Tag(0x0008, 0x0032);
pub(super) const CONTENT_TIME: Tag = Tag(0x0008, 0x0033);
pub(super) const FRAME_TYPE: Tag = Tag(0x0008, 0x9007);
pub(super) const VOLTAGE: Tag = Tag(0x0018, 0x0060);
pub(super) const ECHO_TIME: Tag = Tag(0x0018, 0x0081);
pub(super) const ECHO: Tag = Tag(0x0018, 0x0086);
pub(super) const TRIGGER: Tag = Tag(0x0018, 0x1060);
pub(super) const KERNEL: Tag = Tag(0x0018, 0x1210);
pub(super) const FRAME_MOMENT: Tag = Tag(0x0018, 0x9074);
pub(super) const FRAME_ECHO_TIME: Tag = Tag(0x0018, 0x9082);
pub(super) const B_VALUE: Tag = Tag(0x0018, 0x9087);
pub(super) const ACQUISITION: Tag = Tag(0x0020, 0x0012);
pub(super) const INSTANCE: Tag = Tag(0x0020, 0x0013);
pub(super) const REFERENCE_FRAME: Tag = Tag(0x0020, 0x0052);
pub(super) const TEMPORAL: Tag = Tag(0x0020, 0x0100);
pub(super) const STACK: Tag = Tag(0x0020, 0x9056);
pub(super) const TEMPORAL_INDEX: Tag = Tag(0x0020, 0x9128);
pub(super) const TRIGGER_DELAY: Tag = Tag(0x0020, 0x9153);
pub(super) const FRAME_ACQUISITION: Tag = Tag(0x0020, 0x9156);
pub(super) const HEART_PHASE: Tag = Tag(0x0020, 0x9241);
pub(super) const TEMPORAL_OFFSET: Tag = Tag(0x0020, 0x930D);

/// A sequence with an item for each segment, and what is looked at in it.
pub(super) const SEGMENTS: Tag = Tag(0x0062, 0x0002);
pub(super) const SEGMENT_NUMBER: Tag = Tag(0x0062, 0x0004);
pub(super) const SEGMENT_LABEL: Tag = Tag(0x0062, 0x0005);
pub(super) const SEGMENT_COLOUR: Tag = Tag(0x0062, 0x000D);
pub(super) const OF_SEGMENT: [Tag; 3] = [SEGMENT_NUMBER, SEGMENT_LABEL, SEGMENT_COLOUR];

/// What is said of all frames, and of each of them.
pub(super) const SHARED_GROUPS: Tag = Tag(0x5200, 0x9229);
pub(super) const FRAME_GROUPS: Tag = Tag(0x5200, 0x9230);
/// The segment that a frame is of.
pub(super) const OF_FRAME: Tag = Tag(0x0062, 0x000B);

const CONTENT: Tag = Tag(0x0020, 0x9111);
const MEASURES: Tag = Tag(0x0028, 0x9110);
const HEART: Tag = Tag(0x0018, 0x9118);
const VALUES: Tag = Tag(0x0028, 0x9145);

/// What may be said of frames, each in the group that the standard has for it: what makers repeat in groups of their own, in
/// coordinates of their own, is none of it.
pub(super) const GROUPED: [(Tag, Tag); 19] = [
    (Tag(0x0018, 0x9114), FRAME_ECHO_TIME),
    (Tag(0x0018, 0x9117), B_VALUE),
    (HEART, TRIGGER_DELAY),
    (HEART, HEART_PHASE),
    (Tag(0x0018, 0x9226), FRAME_TYPE),
    (Tag(0x0018, 0x9329), FRAME_TYPE),
    (CONTENT, FRAME_ACQUISITION),
    (CONTENT, FRAME_MOMENT),
    (CONTENT, STACK),
    (CONTENT, TEMPORAL_INDEX),
    (Tag(0x0020, 0x9113), POSITION),
    (Tag(0x0020, 0x9116), ORIENTATION),
    (Tag(0x0020, 0x9310), TEMPORAL_OFFSET),
    (MEASURES, BETWEEN),
    (MEASURES, SPACING),
    (MEASURES, THICKNESS),
    (VALUES, INTERCEPT),
    (VALUES, SLOPE),
    (Tag(0x0062, 0x000A), OF_FRAME),
];

/// What is looked at outside of any sequence.
pub(super) const OWN: [Tag; 38] = [
    ACQUISITION,
    ACQUISITION_MOMENT,
    ACQUISITION_TIME,
    ALLOCATED,
    BETWEEN,
    B_VALUE,
    COLUMNS,
    CONTENT_TIME,
    ECHO,
    ECHO_TIME,
    FRAMES,
    IMAGE_TYPE,
    INSTANCE,
    INTERCEPT,
    KERNEL,
    LARGEST_FRACTION,
    LETTERS,
    MODALITY,
    ORIENTATION,
    PHOTOMETRIC,
    POSITION,
    REFERENCE_FRAME,
    ROWS,
    SAMPLES,
    SEGMENTATION_TYPE,
    SERIES,
    SIGNED,
    SLOPE,
    SOP_INSTANCE,
    SPACING,
    STACK,
    STORED,
    TEMPORAL,
    TEMPORAL_INDEX,
    THICKNESS,
    TRIGGER,
    TRIGGER_DELAY,
    VOLTAGE,
];
