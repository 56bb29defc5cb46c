//! Which connected pieces of the surface go on, and their row in the table of settings.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::table::{CommandOption, InLink, Kind, Messages, NoValue, Setting};

/// Which connected pieces of the surface are kept. Pieces are numbered by their first triangle, from 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Keep {
    /// The piece with the most triangles.
    #[default]
    Largest,
    /// The piece with this number.
    Component(u32),
    /// The pieces with these numbers.
    Pieces(PieceSet),
    /// Every piece.
    All,
}

impl Keep {
    /// The pieces with these numbers; `None` for none, or more than a set can have.
    pub fn pieces(numbers: &[u32]) -> Option<Self> {
        match numbers {
            [] => None,
            [number] => Some(Self::Component(*number)),
            _ => PieceSet::new(numbers).map(Self::Pieces),
        }
    }

    /// The numbers that it names, ascending; none where it names pieces in another way.
    pub fn numbers(&self) -> &[u32] {
        match self {
            Self::Component(number) => std::slice::from_ref(number),
            Self::Pieces(set) => set.numbers(),
            Self::Largest | Self::All => &[],
        }
    }

    /// Whether it names this piece of a surface whose largest is `largest`.
    pub fn names(&self, piece: u32, largest: Option<u32>) -> bool {
        match self {
            Self::All => true,
            Self::Largest => largest == Some(piece),
            Self::Component(_) | Self::Pieces(_) => self.numbers().contains(&piece),
        }
    }

    /// The same of a surface whose pieces may be numbered otherwise: the largest in place of numbers.
    #[must_use]
    pub fn without_numbers(self) -> Self {
        if self.numbers().is_empty() { self } else { Self::Largest }
    }
}

impl fmt::Display for Keep {
    /// As links and the command line have it.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Largest => f.write_str("largest"),
            Self::All => f.write_str("all"),
            Self::Component(_) | Self::Pieces(_) => {
                let numbers: Vec<String> = self.numbers().iter().map(u32::to_string).collect();
                f.write_str(&numbers.join(","))
            }
        }
    }
}

impl std::str::FromStr for Keep {
    type Err = NoValue;

    fn from_str(text: &str) -> Result<Self, NoValue> {
        match text {
            "largest" => Ok(Self::Largest),
            "all" => Ok(Self::All),
            numbers => {
                let numbers = numbers.split(',').map(|number| number.parse().map_err(|_| NoValue));
                Self::pieces(&numbers.collect::<Result<Vec<u32>, _>>()?).ok_or(NoValue)
            }
        }
    }
}

/// The numbers of two to sixteen pieces: few enough to be copied with the settings.
#[derive(Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(try_from = "Vec<u32>", into = "Vec<u32>")]
pub struct PieceSet {
    count: u8,
    /// Ascending, and 0 behind them.
    numbers: [u32; Self::MOST],
}

impl PieceSet {
    /// The most pieces that can be named one by one.
    pub const MOST: usize = 16;

    /// The set of these; `None` where they are fewer than two or more than [`Self::MOST`], or one of them comes twice.
    pub fn new(numbers: &[u32]) -> Option<Self> {
        let mut set = Self { count: numbers.len().try_into().ok()?, numbers: [0; Self::MOST] };
        let own = set.numbers.get_mut(..numbers.len())?;
        own.copy_from_slice(numbers);
        own.sort_unstable();
        let is_set = own.len() > 1 && own.windows(2).all(|pair| pair[0] < pair[1]);
        is_set.then_some(set)
    }

    /// The numbers, ascending.
    pub fn numbers(&self) -> &[u32] {
        &self.numbers[..usize::from(self.count)]
    }
}

impl fmt::Debug for PieceSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.numbers().fmt(f)
    }
}

impl TryFrom<Vec<u32>> for PieceSet {
    type Error = String;

    fn try_from(numbers: Vec<u32>) -> Result<Self, String> {
        Self::new(&numbers).ok_or_else(|| format!("from 2 to {} different numbers of pieces", Self::MOST))
    }
}

impl From<PieceSet> for Vec<u32> {
    fn from(set: PieceSet) -> Self {
        set.numbers().to_vec()
    }
}

/// The row of [`Settings::keep`](super::Settings::keep).
pub(super) static ROWS: [Setting; 1] = [Setting {
    key: "keep",
    field: "keep",
    kind: Kind::Pieces { at: |settings| &mut settings.keep },
    in_link: InLink::Always,
    matters: |_| true,
    option: CommandOption {
        value: "PIECES",
        help: "The connected pieces to keep: largest, all, or the numbers of 1 to 16, from 0 (0,3) [default: largest]",
    },
    messages: Messages { label: "", help: "", said: "", refused: None },
}];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_are_a_set_of_two_to_sixteen_numbers() {
        let set = PieceSet::new(&[7, 0, 3]).unwrap();
        assert_eq!((set.numbers(), set), (&[0, 3, 7][..], PieceSet::new(&[3, 7, 0]).unwrap()));
        let many: Vec<u32> = (0..17).collect();
        assert!(PieceSet::new(&many[..16]).is_some());
        assert!([&many[..], &[1], &[], &[2, 2]].iter().all(|numbers| PieceSet::new(numbers).is_none()));
    }

    #[test]
    fn what_is_kept_is_read_as_it_is_written() {
        for text in ["largest", "all", "3", "0,3,7"] {
            let keep: Keep = text.parse().unwrap();
            assert_eq!(keep.to_string(), text);
            let json = serde_json::to_string(&keep).unwrap();
            assert_eq!(serde_json::from_str::<Keep>(&json).unwrap(), keep, "{json}");
        }
        assert_eq!("7,0".parse(), "0,7".parse::<Keep>(), "in any order");
        assert!(["", ",", "1,", "1,1", "-1", "one"].iter().all(|text| text.parse::<Keep>().is_err()));
        assert!(serde_json::from_str::<Keep>(r#"{ "Pieces": [1] }"#).is_err());
    }
}
