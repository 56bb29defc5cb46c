//! What a user has measured on a surface: places in its own coordinates, in mm, and what was found there. A measure says
//! which surface it was made on, and stays as it is when another level is shown.

use glam::{DVec3, Vec3};
use serde::{Deserialize, Serialize};

use crate::language::{decimal, tell};
use crate::say;
use crate::vessel::BranchName;
use crate::vessel::width::circle;

/// The most measures of a file that are read.
const MAX_MEASURES: usize = 500;
/// The most letters of a name.
pub const LONGEST_NAME: usize = 60;

/// What was measured, and what it is called.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Measure {
    /// Its name: "Ruler 1", in the language that it was made in, until the user chooses another.
    pub name: String,
    /// What it was made on.
    pub made_on: MadeOn,
    /// What was found.
    pub found: Found,
}

/// What a measure was made on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum MadeOn {
    /// The surface as it was opened.
    Opened,
    /// A level of so many triangles.
    Level(u32),
}

/// What was found; places in mm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum Found {
    /// The straight distance of two places.
    Ruler {
        /// The places.
        ends_mm: [[f32; 3]; 2],
    },
    /// The largest ball inside that touches the wall at a place.
    Diameter {
        /// The place.
        wall_mm: [f32; 3],
        /// The middle of the ball.
        centre_mm: [f32; 3],
        /// Its diameter in mm.
        diameter_mm: f32,
    },
    /// The cross-section of a vessel.
    Section {
        /// Its centroid.
        centre_mm: [f32; 3],
        /// What it is square to, of length 1.
        direction: [f32; 3],
        /// Area in mm2.
        area_mm2: f32,
        /// Least and largest distance in mm of two parallel lines that hold it.
        widths_mm: [f32; 2],
        /// Its outline, closed.
        outline_mm: Vec<[f32; 3]>,
        /// The vessel: "branch 1".
        vessel: String,
        /// Whether it lies at a fork, where the plane cuts more than one vessel.
        #[serde(default)]
        at_fork: bool,
    },
    /// The angle at the second of three places.
    Angle {
        /// The places.
        places_mm: [[f32; 3]; 3],
    },
}

/// A vessel, which is kept by its English name, in the language that is spoken.
fn called(vessel: &str) -> String {
    BranchName::read(vessel).map_or_else(|| vessel.to_owned(), |name| tell(&name))
}

impl Measure {
    /// What was found, with its unit: "12.3 mm".
    pub fn value(&self) -> String {
        match &self.found {
            Found::Ruler { ends_mm: [from, to] } => format!("{} mm", decimal(place(*from).distance(place(*to)), 2)),
            Found::Diameter { diameter_mm, .. } => say!("app-measure-diameter", mm = decimal(*diameter_mm, 2)),
            Found::Section { area_mm2, widths_mm: [least, largest], .. } => {
                let round = 2.0 * circle(f64::from(*area_mm2));
                let numbers = [f64::from(*area_mm2), f64::from(*least), f64::from(*largest), round];
                let [area, least, largest, round] = numbers.map(|number| decimal(number, 2));
                say!("app-measure-section", area = area, least = least, largest = largest, round = round)
            }
            Found::Angle { places_mm } => format!("{}°", decimal(degrees(places_mm.map(place)), 1)),
        }
    }

    /// The same in as few words as a label in a view has room for.
    pub fn in_short(&self) -> String {
        match &self.found {
            Found::Section { area_mm2, .. } => format!("{} mm²", decimal(*area_mm2, 1)),
            Found::Diameter { diameter_mm, .. } => format!("{} mm", decimal(*diameter_mm, 2)),
            Found::Ruler { .. } | Found::Angle { .. } => self.value(),
        }
    }

    /// What it was made on, and where on it, in a few words.
    pub fn made(&self) -> String {
        match (self.made_on, &self.found) {
            (MadeOn::Opened, Found::Section { vessel, at_fork: true, .. }) => {
                say!("app-measured-opened-fork", vessel = called(vessel))
            }
            (MadeOn::Opened, Found::Section { vessel, .. }) => {
                say!("app-measured-opened-vessel", vessel = called(vessel))
            }
            (MadeOn::Opened, _) => say!("app-measured-opened"),
            (MadeOn::Level(count), Found::Section { vessel, at_fork: true, .. }) => {
                say!("app-measured-level-fork", count = count, vessel = called(vessel))
            }
            (MadeOn::Level(count), Found::Section { vessel, .. }) => {
                say!("app-measured-level-vessel", count = count, vessel = called(vessel))
            }
            (MadeOn::Level(count), _) => say!("app-measured-level", count = count),
        }
    }

    /// Its places in mm, those that are marked.
    pub fn places(&self) -> Vec<Vec3> {
        let places: &[[f32; 3]] = match &self.found {
            Found::Ruler { ends_mm } => ends_mm,
            Found::Diameter { wall_mm, centre_mm, .. } => &[*wall_mm, *centre_mm],
            Found::Section { centre_mm, .. } => std::slice::from_ref(centre_mm),
            Found::Angle { places_mm } => places_mm,
        };
        places.iter().map(|&place| place.into()).collect()
    }

    /// Its middle, and how far around that it reaches, in mm.
    pub fn extent(&self) -> (Vec3, f32) {
        let places = self.places();
        let middle = places.iter().sum::<Vec3>() / places.len().max(1) as f32;
        let reach = places.iter().map(|place| place.distance(middle)).fold(0.0, f32::max);
        match &self.found {
            Found::Section { widths_mm, .. } => (middle, widths_mm[1]),
            _ => (middle, reach),
        }
    }

    /// Whether every number is one, and the name is short enough.
    fn is_sound(&self) -> bool {
        let mut all: Vec<f32> = self.places().into_iter().flat_map(|p| p.to_array()).collect();
        match &self.found {
            Found::Diameter { diameter_mm, .. } => all.push(*diameter_mm),
            Found::Section { direction, area_mm2, widths_mm, outline_mm, .. } => {
                all.extend(direction.iter().chain(widths_mm).chain(outline_mm.as_flattened()).chain([area_mm2]));
            }
            Found::Ruler { .. } | Found::Angle { .. } => {}
        }
        all.iter().all(|number| number.is_finite()) && self.name.chars().count() <= LONGEST_NAME
    }
}

/// Whether these measures of a file can be shown.
pub(super) fn are_sound(measures: &[Measure]) -> bool {
    measures.len() <= MAX_MEASURES && measures.iter().all(Measure::is_sound)
}

fn place(at: [f32; 3]) -> DVec3 {
    Vec3::from(at).as_dvec3()
}

/// The angle at the second of three places, in degrees.
fn degrees([one, at, other]: [DVec3; 3]) -> f64 {
    let (a, b) = (one - at, other - at);
    libm::atan2(a.cross(b).length(), a.dot(b)).to_degrees()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measure(found: Found) -> Measure {
        Measure { name: "a".to_owned(), made_on: MadeOn::Level(12_345), found }
    }

    #[test]
    fn a_value_has_its_unit_and_is_that_of_the_places() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 3.0, 6.0]];
        assert_eq!(measure(Found::Ruler { ends_mm: corners }).value(), "7.00 mm");
        let right = [[5.0, 0.0, 1.0], [0.0, 0.0, 1.0], [0.0, 9.0, 1.0]];
        assert_eq!(measure(Found::Angle { places_mm: right }).value(), "90.0°");
        let straight = [[5.0, 0.0, 0.0], [0.0, 0.0, 0.0], [-1.0, 0.0, 0.0]];
        assert_eq!(measure(Found::Angle { places_mm: straight }).value(), "180.0°");
        let section = measure(Found::Section {
            centre_mm: [0.0; 3],
            direction: [0.0, 0.0, 1.0],
            area_mm2: 28.274_334,
            widths_mm: [6.0, 6.0],
            outline_mm: Vec::new(),
            vessel: "branch 2".to_owned(),
            at_fork: false,
        });
        assert_eq!(section.value(), "28.27 mm², 6.00 to 6.00 mm wide, as a circle 6.00 mm");
        assert_eq!(section.made(), "On 12,345 triangles, branch 2");
    }

    #[test]
    fn what_is_no_number_is_not_sound() {
        let of = |x| measure(Found::Ruler { ends_mm: [[0.0, 0.0, x], [1.0; 3]] });
        assert!(are_sound(&[of(2.0)]) && !are_sound(&[of(2.0), of(f32::NAN)]));
        assert!(!are_sound(&[Measure { name: "x".repeat(61), ..of(1.0) }]));
    }
}
