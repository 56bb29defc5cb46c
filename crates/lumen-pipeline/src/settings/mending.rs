//! The rows of mending in the table of settings.

use super::table::{CommandOption, InLink, Kind, Messages, Range, Setting};
use super::{Mending, OutOfRange};

/// The rows of [`Mending`].
pub(super) static ROWS: [Setting; 4] = [
    Setting {
        key: "weld",
        field: "mending.weld_mm",
        kind: Kind::Limit {
            at: |settings| &mut settings.mending.weld_mm,
            range: Range { bounds: Mending::WELD_MM, unit: "mm", decimals: 4, logarithmic: false },
            proposed: 0.01,
        },
        in_link: InLink::Changed,
        matters: |_| true,
        option: CommandOption {
            value: "MM",
            help: "Join open edges that are this near, in mm, 0.000001 to 100; nothing collapses",
        },
        messages: Messages {
            label: "panel-weld",
            help: "panel-weld-help",
            said: "report-welded",
            refused: Some(|value| OutOfRange::Weld { value }),
        },
    },
    Setting {
        key: "split",
        field: "mending.split",
        kind: Kind::Switch { at: |settings| &mut settings.mending.split },
        in_link: InLink::Changed,
        matters: |_| true,
        option: CommandOption { value: "", help: "Part the sheets that share an edge or a vertex" },
        messages: Messages { label: "panel-split", help: "panel-split-help", said: "report-split", refused: None },
    },
    Setting {
        key: "fill-holes",
        field: "mending.fill_mm",
        kind: Kind::Limit {
            at: |settings| &mut settings.mending.fill_mm,
            range: Range { bounds: Mending::FILL_MM, unit: "mm", decimals: 1, logarithmic: false },
            proposed: 5.0,
        },
        in_link: InLink::Changed,
        matters: |_| true,
        option: CommandOption {
            value: "MM",
            help: "Fill holes in walls up to this distance across, in mm, 0.001 to 1000; ends of vessels stay open",
        },
        messages: Messages {
            label: "panel-fill",
            help: "panel-fill-help",
            said: "report-filled",
            refused: Some(|value| OutOfRange::Fill { value }),
        },
    },
    Setting {
        key: "lumen",
        field: "mending.lumen",
        kind: Kind::Switch { at: |settings| &mut settings.mending.lumen },
        in_link: InLink::Changed,
        matters: |_| true,
        option: CommandOption { value: "", help: "Take the lumen where the surface is a wall with two sides" },
        messages: Messages {
            label: "panel-lumen",
            help: "panel-lumen-help",
            said: "report-lumen-taken",
            refused: None,
        },
    },
];
