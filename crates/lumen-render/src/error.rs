//! Why something does not come to the GPU: found out before the device is asked. What a device says itself is a
//! [`Fault`](super::Fault).

/// Why a surface is not on the GPU.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SurfaceError {
    /// A buffer would be larger than the device allows.
    #[error("the {what} need {:.1} MB of graphics memory in one piece, and the device gives {:.1} MB",
        *bytes as f64 / 1e6, *limit as f64 / 1e6)]
    TooLarge {
        /// Which buffer.
        what: &'static str,
        /// Bytes needed.
        bytes: u64,
        /// The device's limit in bytes.
        limit: u64,
    },
    /// Normals or scalars are not one for each node.
    #[error("{found} {what} for {expected} nodes")]
    Count {
        /// Which values.
        what: &'static str,
        /// Number of nodes.
        expected: usize,
        /// Number of values.
        found: usize,
    },
    /// A triangle or an edge names a node that does not exist.
    #[error("node {index} of {nodes}")]
    IndexOutOfRange {
        /// The largest index found.
        index: u32,
        /// Number of nodes.
        nodes: usize,
    },
}
