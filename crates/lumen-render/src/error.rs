//! Why something does not come to the GPU: found out before the device is asked. What a device says itself is a
//! [`Fault`](super::Fault).

use std::fmt;

use lumen_language::decimal;
use lumen_language::say;

/// Why a surface is not on the GPU.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SurfaceError {
    /// A buffer would be larger than the device allows.
    TooLarge {
        /// Which buffer.
        what: &'static str,
        /// Bytes needed.
        bytes: u64,
        /// The device's limit in bytes.
        limit: u64,
    },
    /// Normals or scalars are not one for each node.
    Count {
        /// Which values.
        what: &'static str,
        /// Number of nodes.
        expected: usize,
        /// Number of values.
        found: usize,
    },
    /// A triangle or an edge names a node that does not exist.
    IndexOutOfRange {
        /// The largest index found.
        index: u32,
        /// Number of nodes.
        nodes: usize,
    },
}

impl fmt::Display for SurfaceError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&match *self {
            // Positions, normals and scalars are those of all levels together: for them it is no help to reduce further.
            Self::TooLarge { what, bytes, limit } => {
                let [needed, limit] = [bytes, limit].map(|bytes| decimal(bytes as f64 / 1e6, 1));
                say!("views-too-large", what = what, needed = needed, limit = limit)
            }
            Self::Count { what, expected, found } => {
                say!("views-miscounted", found = found.to_string(), what = what, expected = expected.to_string())
            }
            Self::IndexOutOfRange { index, nodes } => {
                say!("views-no-node", index = index.to_string(), nodes = nodes.to_string())
            }
        })
    }
}

impl std::error::Error for SurfaceError {}
