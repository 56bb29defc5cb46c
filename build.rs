//! Makes the font that the window writes with: Ubuntu Light without the instructions that fit it to a grid of pixels, and
//! without the tables that only these need. They are two thirds of the file and a sixtieth of a first visit; the window
//! library fits letters to the grid without them (autohinting). Outlines, widths, kerning and all letters stay.
//!
//! By its licence (Ubuntu Font Licence 1.0, 2c) what was changed is called "derivative" and what of. `write-fonts` could
//! do it too, for a minute of compiling in every profile.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    #[cfg(feature = "gui")]
    {
        let folder = std::env::var_os("OUT_DIR").expect("cargo sets it");
        let font = letters::without_instructions(epaint_default_fonts::UBUNTU_LIGHT).expect("it is a TrueType font");
        std::fs::write(std::path::Path::new(&folder).join("letters.ttf"), font).expect("the folder is cargo's own");
    }
}

#[cfg(feature = "gui")]
mod letters {
    /// Of the tables of a font (OpenType 1.9) those that outlines, widths, kerning and ligatures need.
    const KEPT: [&[u8; 4]; 13] = [
        b"GDEF", b"GPOS", b"GSUB", b"OS/2", b"cmap", b"glyf", b"head", b"hhea", b"hmtx", b"loca", b"maxp", b"name",
        b"post",
    ];

    const NAME: &str = "Ubuntu Light derivative Lumen";

    /// The font without instructions; `None` where it is no whole TrueType font.
    pub(super) fn without_instructions(font: &[u8]) -> Option<Vec<u8>> {
        let table = |tag: &[u8; 4]| {
            let records = font.get(12..12 + 16 * usize::from(u16_at(font, 4)?))?;
            let record = records.chunks_exact(16).find(|record| record.starts_with(tag))?;
            let [start, length] = [u32_at(record, 8)?, u32_at(record, 12)?].map(|x| x as usize);
            font.get(start..start + length)
        };
        let (glyf, loca, is_long) = (table(b"glyf")?, table(b"loca")?, u16_at(table(b"head")?, 50)? == 1);
        let place = |i: usize| {
            if is_long { u32_at(loca, 4 * i).map(|x| x as usize) } else { Some(2 * usize::from(u16_at(loca, 2 * i)?)) }
        };
        let count = usize::from(u16_at(table(b"maxp")?, 4)?);
        let (mut outlines, mut places) = (Vec::new(), vec![0u32]);
        for i in 0..count {
            outlines.extend(bare(glyf.get(place(i)?..place(i + 1)?)?)?);
            outlines.resize(outlines.len().next_multiple_of(4), 0);
            places.push(outlines.len() as u32);
        }
        let mut tables: Vec<(&[u8; 4], Vec<u8>)> = Vec::new();
        for tag in KEPT {
            let Some(bytes) = table(tag) else { continue };
            let mut bytes = bytes.to_vec();
            match tag {
                b"glyf" => bytes.clone_from(&outlines),
                b"loca" => bytes = places.iter().flat_map(|place| place.to_be_bytes()).collect(),
                b"head" => {
                    // Long places, widths that no instruction changes, no checksum of the whole.
                    bytes[50..52].copy_from_slice(&[0, 1]);
                    bytes[17] &= !0b1_0000;
                    bytes[8..12].fill(0);
                }
                // One zone; no storage, functions, stack or instructions.
                b"maxp" => bytes[14..28].copy_from_slice(&[0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0]),
                b"name" => bytes = names(&bytes)?,
                b"post" => {
                    // Without the names of the letters.
                    bytes.truncate(32);
                    bytes[..4].copy_from_slice(&[0, 3, 0, 0]);
                }
                _ => {}
            }
            tables.push((tag, bytes));
        }
        Some(file(&tables))
    }

    /// An outline without instructions (OpenType, `glyf`).
    fn bare(glyph: &[u8]) -> Option<Vec<u8>> {
        const HAS_INSTRUCTIONS: u16 = 0x100;
        let Some(contours) = u16_at(glyph, 0) else { return Some(Vec::new()) };
        if contours < 0x8000 {
            let at = 10 + 2 * usize::from(contours);
            let points = at + 2 + usize::from(u16_at(glyph, at)?);
            return Some([glyph.get(..at)?, &[0, 0], glyph.get(points..)?].concat());
        }
        let (mut bare, mut at) = (glyph.to_vec(), 10);
        loop {
            let flags = u16_at(glyph, at)?;
            bare[at..at + 2].copy_from_slice(&(flags & !HAS_INSTRUCTIONS).to_be_bytes());
            at += 4 + if flags & 1 != 0 { 4 } else { 2 };
            at += [(0x8, 2), (0x40, 4), (0x80, 8)]
                .iter()
                .map(|(bit, length)| if flags & bit != 0 { *length } else { 0 })
                .sum::<usize>();
            if flags & 0x20 == 0 {
                bare.truncate(at);
                return Some(bare);
            }
        }
    }

    /// The table of names with the copyright of the one that is there (Windows, Unicode) and the name of what was changed.
    fn names(table: &[u8]) -> Option<Vec<u8>> {
        const WINDOWS: u16 = 3;
        const UNICODE: u16 = 1;
        const ENGLISH: u16 = 0x409;
        const COPYRIGHT: u16 = 0;
        let texts_at = usize::from(u16_at(table, 4)?);
        let mut records = table.get(6..6 + 12 * usize::from(u16_at(table, 2)?))?.chunks_exact(12);
        let old = records.find(|record| u16_at(record, 0) == Some(WINDOWS) && u16_at(record, 6) == Some(COPYRIGHT))?;
        let start = texts_at + usize::from(u16_at(old, 10)?);
        let copyright = table.get(start..start + usize::from(u16_at(old, 8)?))?.to_vec();
        let utf16 = |text: &str| text.encode_utf16().flat_map(u16::to_be_bytes).collect::<Vec<u8>>();
        // Family, style, full name, PostScript's name.
        let others = [(1, NAME), (2, "Regular"), (4, NAME), (6, "Ubuntu-Light-derivative-Lumen")];
        let texts: Vec<(u16, Vec<u8>)> =
            [(COPYRIGHT, copyright)].into_iter().chain(others.map(|(id, text)| (id, utf16(text)))).collect();
        let count = texts.len() as u16;
        let (mut bytes, mut behind) = ([0, count, 6 + 12 * count].map(u16::to_be_bytes).concat(), Vec::new());
        for (id, text) in texts {
            let record = [WINDOWS, UNICODE, ENGLISH, id, text.len() as u16, behind.len() as u16];
            bytes.extend(record.map(u16::to_be_bytes).concat());
            behind.extend(text);
        }
        bytes.extend(behind);
        Some(bytes)
    }

    /// Tables as a file (OpenType, "Organization of an OpenType font").
    fn file(tables: &[(&[u8; 4], Vec<u8>)]) -> Vec<u8> {
        let count = tables.len() as u16;
        let power = count.ilog2() as u16;
        let mut bytes = vec![0, 1, 0, 0];
        for x in [count, 16 << power, power, 16 * (count - (1 << power))] {
            bytes.extend(x.to_be_bytes());
        }
        let mut at = bytes.len() + 16 * tables.len();
        for (tag, table) in tables {
            let words = table.chunks(4).map(|word| {
                let mut whole = [0; 4];
                whole[..word.len()].copy_from_slice(word);
                u32::from_be_bytes(whole)
            });
            bytes.extend_from_slice(*tag);
            for x in [words.fold(0, u32::wrapping_add), at as u32, table.len() as u32] {
                bytes.extend(x.to_be_bytes());
            }
            at += table.len().next_multiple_of(4);
        }
        for (_, table) in tables {
            bytes.extend_from_slice(table);
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        }
        bytes
    }

    fn u16_at(bytes: &[u8], at: usize) -> Option<u16> {
        bytes.get(at..at + 2)?.try_into().ok().map(u16::from_be_bytes)
    }

    fn u32_at(bytes: &[u8], at: usize) -> Option<u32> {
        bytes.get(at..at + 4)?.try_into().ok().map(u32::from_be_bytes)
    }
}
