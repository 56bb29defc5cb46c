//! Views of buffers that meshopt has packed (`EXT_meshopt_compression` and `KHR_meshopt_compression`, Kapoulkine 2021 and
//! 2025): the numbers of vertices, triangles or any other indices.
//!
//! The crate `meshoptimizer-rs` unpacks them: a port to Rust, without `unsafe` where its feature `simd` is off.

use meshoptimizer_rs::codec::{
    decode_filter_color, decode_filter_exp, decode_filter_oct, decode_filter_quat, decode_index_buffer,
    decode_index_sequence, decode_vertex_buffer,
};
use meshoptimizer_rs::{Error, Workspace};
use serde::Deserialize;

/// How a view is packed, and where.
#[derive(Clone, Default, Deserialize)]
#[serde(default, rename_all = "camelCase")]
pub(super) struct Packed {
    pub(super) buffer: usize,
    pub(super) byte_offset: usize,
    pub(super) byte_length: usize,
    byte_stride: usize,
    count: usize,
    mode: Mode,
    filter: Filter,
}

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Mode {
    Attributes,
    Triangles,
    Indices,
    #[default]
    #[serde(other)]
    Other,
}

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Filter {
    #[default]
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
    #[serde(other)]
    Other,
}

impl Packed {
    /// How many bytes it unpacks to; `None` beyond what there can be.
    pub(super) fn unpacked_length(&self) -> Option<usize> {
        self.count.checked_mul(self.byte_stride)
    }

    /// The bytes of the view; `None` where those packed are damaged, or packed in a way that is not known.
    pub(super) fn unpack(&self, bytes: &[u8]) -> Option<Vec<u8>> {
        let (count, stride) = (self.count, self.byte_stride);
        let decode = match self.mode {
            Mode::Attributes => decode_vertex_buffer,
            Mode::Triangles => decode_index_buffer,
            Mode::Indices => decode_index_sequence,
            Mode::Other => return None,
        };
        type Decode = fn(&mut [u8], usize, usize, &mut Workspace) -> Result<(), Error>;
        let filter: Option<Decode> = match self.filter {
            Filter::None => None,
            Filter::Octahedral => Some(decode_filter_oct),
            Filter::Quaternion => Some(decode_filter_quat),
            Filter::Exponential => Some(decode_filter_exp),
            Filter::Color => Some(decode_filter_color),
            Filter::Other => return None,
        };
        let workspace = &mut Workspace::default();
        let mut view = decode(count, stride, bytes, workspace).ok()?;
        if let Some(filter) = filter {
            filter(&mut view, count, stride, workspace).ok()?;
        }
        Some(view)
    }
}

#[cfg(test)]
mod tests {
    use base64::Engine as _;
    use base64::engine::general_purpose::STANDARD;

    use super::*;

    /// A bent strip of two by nine vertices as the encoder of the npm package `meshoptimizer` 1.3 packs it: mode, filter,
    /// items, bytes of each, what is packed, and what the decoder of that package makes of it.
    const PACKED: &[(&str, &str, usize, usize, &str, &str)] = &[
        (
            "ATTRIBUTES",
            "NONE",
            18,
            8,
            "oAUMzMzM+U8qgXCNnsAAAABVBQzMzMwHEx8nLS0rwAAAACMFDMzMzCwOLMM6TrbAAAAAqgUMzMzMLioiGAoDEcAAAAAdBwAgHyAf\
             IB8gHyAfIB8gHyDwAAAAHyAHAE5NTk1OTU5NTk1OTU5NTvAAAABNTgAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAUMMwdTB1AAA=",
            "UMMwdTB1AABQwzB1QJwAANO/RowwdQAA079GjECcAACrtU2hMHUAAKu1TaFAnAAAwKVjsjB1AADApWOyQJwAAH+RAb4wdQAAf5EB\
             vkCcAAC3eh7DMHUAALd6HsNAnAAAcGNFwTB1AABwY0XBQJwAAL9NoLgwdQAAv02guECcAACUO/WpMHUAAJQ79alAnAAA",
        ),
        (
            "ATTRIBUTES",
            "NONE",
            18,
            8,
            "oVWvAFRV+U8qgXCNngEAVQBUVQcTHyctLSsBACMAVFUsDizDOk62AQCqAFRVLioiGAoDEQEAHQAgHyAfIB8gHyAfIB8gHyAfIABO\
             TU5NTk1OTU5NTk1OTU5NTgAAAAAAAAAAAAAAAAAAUMMwdTB1AAAAAA==",
            "UMMwdTB1AABQwzB1QJwAANO/RowwdQAA079GjECcAACrtU2hMHUAAKu1TaFAnAAAwKVjsjB1AADApWOyQJwAAH+RAb4wdQAAf5EB\
             vkCcAAC3eh7DMHUAALd6HsNAnAAAcGNFwTB1AABwY0XBQJwAAL9NoLgwdQAAv02guECcAACUO/WpMHUAAJQ79alAnAAA",
        ),
        (
            "TRIANGLES",
            "NONE",
            48,
            2,
            "4f4eHg4eDh4OHg4eDh4OHg7wBAB2h1ZneKmGZYlomAFpAAA=",
            "AAACAAEAAQACAAMAAwACAAQAAwAEAAUABQAEAAYABQAGAAcABwAGAAgABwAIAAkACQAIAAoACQAKAAsACwAKAAwACwAMAA0ADQAM\
             AA4ADQAOAA8ADwAOABAADwAQABEA",
        ),
        (
            "TRIANGLES",
            "NONE",
            48,
            4,
            "4f4eHg4eDh4OHg4eDh4OHg7wBAB2h1ZneKmGZYlomAFpAAA=",
            "AAAAAAIAAAABAAAAAQAAAAIAAAADAAAAAwAAAAIAAAAEAAAAAwAAAAQAAAAFAAAABQAAAAQAAAAGAAAABQAAAAYAAAAHAAAABwAA\
             AAYAAAAIAAAABwAAAAgAAAAJAAAACQAAAAgAAAAKAAAACQAAAAoAAAALAAAACwAAAAoAAAAMAAAACwAAAAwAAAANAAAADQAAAAwA\
             AAAOAAAADQAAAA4AAAAPAAAADwAAAA4AAAAQAAAADwAAABAAAAARAAAA",
        ),
        (
            "INDICES",
            "NONE",
            18,
            2,
            "0QAcHCocHCocKhwcKhwqHBwqHAAAAAA=",
            "AAAHAA4AAwAKABEABgANAAIACQAQAAUADAABAAgADwAEAAsA",
        ),
        (
            "INDICES",
            "NONE",
            18,
            4,
            "0QAcHCocHCocKhwcKhwqHBwqHAAAAAA=",
            "AAAAAAcAAAAOAAAAAwAAAAoAAAARAAAABgAAAA0AAAACAAAACQAAABAAAAAFAAAADAAAAAEAAAAIAAAADwAAAAQAAAALAAAA",
        ),
        (
            "ATTRIBUTES",
            "EXPONENTIAL",
            18,
            12,
            "oAUMzMzMbmePd6oqNcAAAABoBQzMzMwDCSBFFxcVwAAAAEsBAAAAQAUABIAAQAAAAAUMzMzMW3cqxcMc2cAAAAD7BQzMzEwWFlAx\
             BAfAAAAAKAAFAASAAEAAAAAABwAoJygnKCdQTygnKCcoJyjwAAAAJ1AABQAEgABAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAKAD3\
             AAAA9wAAAPc=",
            "AACgQQAAAAAAAAAAAACgQQAAAAAAACBBANyYQQAgvUAAAAAAANyYQQAgvUAAACBBAAyEQQCwNEEAAAAAAAyEQQCwNEEAACBBAOxG\
             QQCsekEAAAAAAOxGQQCsekEAACBBAPDnQAAglUEAAAAAAPDnQAAglUEAACBBAAC1PwCYn0EAAAAAAAC1PwCYn0EAACBBAHCRwADQ\
             m0EAAAAAAHCRwADQm0EAACBBAJAhwQAcikEAAAAAAJAhwQAcikEAACBBAPhrwQAkWEEAAAAAAPhrwQAkWEEAACBB",
        ),
        (
            "ATTRIBUTES",
            "OCTAHEDRAL",
            18,
            4,
            "oAUMzMzMOyslJzc/LcAAAAAlBQzMzMw8LCYoOB8twAAAACUAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAAB/AH8A",
            "fwAAAH8AAAB5JgAAeSYAAGhIAABoSAAAT2QAAE9kAAAvdgAAL3YAAAl/AAAJfwAA43wAAON8AADAbgAAwG4AAKNWAACjVgAA",
        ),
        (
            "ATTRIBUTES",
            "QUATERNION",
            18,
            8,
            "oaCFAf4BQjwyHgoRM5ECKqrAAA0AAP/Cs9X1DyUzPQMAQz8FAADVqg+gAAAAAQABBQAAAAAAAAAAAAAAAAAAAAAAAAAA/wcAAQ==",
            "AAAAAAAA/3/HDAAAAABbf2wZAAAAAHJ92SUAAAAARnrUMQAAAADmdV89AAAAAFNwSkgAAAAAoWl2UgAAAADlYdBbAAAAAC5ZSGQA\
             AAAAi0+1awAAAAAnRRNyAAAAAA46THcAAAAAYi5WewAAAAA5IiJ+AAAAAMEVrX8AAAAAEAnxfwAAAAA+/O5+AAAAAILv",
        ),
        (
            "ATTRIBUTES",
            "COLOR",
            18,
            4,
            "ob8AgI2AjYCNgI2AjYCNgI2AjYAA/eX95f3l/eX94/3l/eX95f0Af1Z/Vn9Wf1Z/VH9Wf1Z/Vn8AAAAAAAAAAAAAAAAAAAAAAAAA\
             fwB//wA=",
            "AP4A/wH+//8c4gD/HeL//zjGAP85xv//VKoA/1Wq//9wjgD/cY7//45xAP+Pcf//qlUA/6tV///GOQD/xzn//+IdAP/jHf//",
        ),
    ];

    fn packed(&(mode, filter, count, stride, ..): &(&str, &str, usize, usize, &str, &str)) -> Packed {
        let json = format!("{{\"mode\":\"{mode}\",\"filter\":\"{filter}\",\"count\":{count},\"byteStride\":{stride}}}");
        serde_json::from_str(&json).unwrap()
    }

    #[test]
    fn what_another_program_packs_is_unpacked_as_it_does() {
        for row in PACKED {
            let unpacked = packed(row).unpack(&STANDARD.decode(row.4).unwrap());
            assert_eq!(unpacked.map(|bytes| STANDARD.encode(bytes)).as_deref(), Some(row.5), "{row:?}");
        }
    }

    #[test]
    fn what_is_cut_short_or_of_another_kind_is_not_unpacked() {
        for row in PACKED {
            let bytes = STANDARD.decode(row.4).unwrap();
            assert!((0..bytes.len()).all(|end| packed(row).unpack(&bytes[..end]).is_none()), "{row:?}");
            assert!(packed(&("MESHLETS", row.1, row.2, row.3, "", "")).unpack(&bytes).is_none());
            assert!(packed(&(row.0, "SINE", row.2, row.3, "", "")).unpack(&bytes).is_none());
        }
    }
}
