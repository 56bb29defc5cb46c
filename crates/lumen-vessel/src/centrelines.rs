//! The centrelines of one surface with its calibre along them, and as a file: CSV, or VTP as vmtk names its arrays.
//!
//! A line is a branch. Antiga et al., "An image-based modeling framework for patient-specific computational
//! hemodynamics" (2008), number the pieces of centrelines that are split at forks by three numbers, which other
//! programs read: `GroupIds`, here the branch; `CenterlineIds`, here the chain of branches of which each goes straight
//! on from the last; `TractIds`, the place in that chain. No branch is `Blanking`, for none stands for a fork itself.
//! What vmtk writes differs in that a line there goes from the root to an end, so that what two share is there twice.

use std::fmt::{Display, Write as _};

use serde::{Deserialize, Serialize};

use super::calibre::{Asked, Calibre, Subject, measure};
use super::certificate::{CalibreError, checked};
use super::recentring::recentre;
use super::stations::{Station, Stations};
use super::tree::{Branch, Tree};
use super::width::circle;
use super::zones::{Zone, zones};
use lumen_mesh::SurfaceIndex;
use lumen_mesh::task::{Yielder, at_once};

/// A format of centrelines.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub enum CentrelineFormat {
    /// VTK's XML format for polygonal data.
    Vtp,
    /// Comma-separated values, a row a station.
    Csv,
}

impl CentrelineFormat {
    /// All.
    pub const ALL: [Self; 2] = [Self::Vtp, Self::Csv];

    /// What its files end in.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Vtp => "vtp",
            Self::Csv => "csv",
        }
    }

    /// The format of a file of this ending; `None` for another.
    pub fn from_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
    }
}

/// The centrelines of a surface.
#[derive(Clone, Debug)]
pub struct Centrelines {
    /// The branches, a parent before its branches.
    pub branches: Vec<Branch>,
    /// Stations along them.
    pub stations: Stations,
    /// The calibre at each station.
    pub calibres: Vec<Calibre>,
    /// What each station lies at.
    pub zones: Vec<Zone>,
    /// How many bumps, corners and stumps were too short to be a branch ([`Tree::bumps`]).
    pub bumps: usize,
    /// How many open ends no branch leads to.
    pub openings_without_branch: usize,
}

impl Centrelines {
    /// Finds and measures them.
    ///
    /// # Errors
    /// [`CalibreError`], in one sentence, where there are no vessels in the surface.
    pub fn new(subject: &Subject) -> Result<Self, CalibreError> {
        at_once(Self::find(subject, &Yielder::never()))
    }

    /// [`Self::new`] in slices.
    ///
    /// # Errors
    /// As there.
    pub async fn find(subject: &Subject, yielder: &Yielder) -> Result<Self, CalibreError> {
        let Subject { mesh, topology, index } = subject;
        let index = SurfaceIndex::known_or_built(index.clone(), mesh, &yielder.part(0.0..0.1)).await;
        let part = yielder.part(0.1..0.6);
        let tree = checked(Tree::with_topology_in_slices(mesh, topology, index, &part).await)?;
        let (stations, zones, calibres) = settled(subject, &tree, &yielder.part(0.6..1.0)).await;
        let (bumps, openings_without_branch) = (tree.bumps, tree.openings_without_branch());
        Ok(Self { branches: tree.branches().to_vec(), stations, calibres, zones, bumps, openings_without_branch })
    }

    /// As the text of a file.
    pub fn written(&self, format: CentrelineFormat) -> String {
        match format {
            CentrelineFormat::Vtp => self.vtp(),
            CentrelineFormat::Csv => self.csv(),
        }
    }

    /// A row a station, in the order of the branches. A field is empty where the cross-section does not close.
    pub fn csv(&self) -> String {
        let mut text = "branch,parent,abscissa_mm,x_mm,y_mm,z_mm,direction_x,direction_y,direction_z,\
                        inscribed_radius_mm,area_mm2,radius_mm,zone\n"
            .to_owned();
        for (branch, range) in self.branches.iter().zip(&self.stations.of) {
            let parent = branch.parent.map_or(String::new(), |parent| (parent + 1).to_string());
            for i in range.clone() {
                let Station { at, direction, abscissa_mm, radius_mm } = self.stations.all[i];
                let field = |value: Option<f64>| value.map_or(String::new(), |value| format!("{value:.5}"));
                let area = self.calibres[i].area_mm2;
                let zone = match self.zones[i] {
                    Zone::Vessel => "vessel",
                    Zone::End => "end",
                    Zone::Fork => "fork",
                };
                let _ = writeln!(
                    text,
                    "{},{parent},{abscissa_mm:.4},{:.4},{:.4},{:.4},{:.5},{:.5},{:.5},{radius_mm:.5},{},{},{zone}",
                    branch.id + 1,
                    at.x,
                    at.y,
                    at.z,
                    direction.x,
                    direction.y,
                    direction.z,
                    field(area),
                    field(area.map(circle)),
                );
            }
        }
        text
    }

    /// VTK's XML format for polygonal data, as text: a point a station, a line a branch. Written by hand: for one shape of
    /// file the crate `vtkio` would bring a parser of all of VTK's formats along.
    pub fn vtp(&self) -> String {
        let all = &self.stations.all;
        let numbers = self.chains();
        let closed = |i: usize| i32::from(self.calibres[i].area_mm2.is_some());
        let mut text = format!(
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" \
             header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" \
             NumberOfLines=\"{}\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
            all.len(),
            self.branches.len()
        );
        text += "<PointData Scalars=\"MaximumInscribedSphereRadius\">\n";
        array(&mut text, "Float64", "MaximumInscribedSphereRadius", 1, all.iter().map(|station| station.radius_mm));
        array(&mut text, "Float64", "Abscissas", 1, all.iter().map(|station| station.abscissa_mm));
        let areas = self.calibres.iter().map(|found| found.area_mm2.unwrap_or(0.0));
        array(&mut text, "Float64", "CenterlineSectionArea", 1, areas);
        array(&mut text, "Int32", "CenterlineSectionClosed", 1, (0..all.len()).map(closed));
        text += "</PointData>\n<CellData>\n";
        array(&mut text, "Int32", "CenterlineIds", 1, numbers.iter().map(|number| number.0));
        array(&mut text, "Int32", "GroupIds", 1, self.branches.iter().map(|branch| branch.id));
        array(&mut text, "Int32", "TractIds", 1, numbers.iter().map(|number| number.1));
        array(&mut text, "Int32", "Blanking", 1, self.branches.iter().map(|_| 0));
        text += "</CellData>\n<Points>\n";
        let points = all.iter().flat_map(|station| station.at.to_array());
        array(&mut text, "Float64", "Points", 3, points);
        text += "</Points>\n<Lines>\n";
        array(&mut text, "Int64", "connectivity", 1, 0..all.len());
        array(&mut text, "Int64", "offsets", 1, self.stations.of.iter().map(|range| range.end));
        text += "</Lines>\n</Piece>\n</PolyData>\n</VTKFile>\n";
        text
    }

    /// For each branch the number of its chain and its place in it.
    fn chains(&self) -> Vec<(u32, u32)> {
        let mut numbers: Vec<(u32, u32)> = Vec::new();
        let mut count = 0;
        for branch in &self.branches {
            let last = branch.parent.filter(|_| branch.goes_straight_on()).map(|parent| numbers[parent as usize]);
            numbers.push(match last {
                Some((chain, place)) => (chain, place + 1),
                None => {
                    count += 1;
                    (count - 1, 0)
                }
            });
        }
        numbers
    }
}

/// The stations along the tree of a surface, where they stay, what each lies at, and the calibre there.
pub(super) async fn settled(subject: &Subject, tree: &Tree, yielder: &Yielder) -> (Stations, Vec<Zone>, Vec<Calibre>) {
    let mut stations = Stations::new(tree);
    let calibres = measure(subject, &tree.space, &stations.all, (Asked::Section, None), &yielder.part(0.0..0.5)).await;
    let radii: Vec<Option<f64>> = calibres.iter().map(|found| found.area_mm2.map(circle)).collect();
    let zones = zones(tree.branches(), &stations, &radii);
    recentre(&mut stations, &calibres, &zones);
    // Once more, where the stations are moved to.
    let calibres =
        measure(subject, &tree.space, &stations.all, (Asked::SectionAndBall, None), &yielder.part(0.5..1.0)).await;
    (stations, zones, calibres)
}

/// A data array as text, twelve numbers a line.
fn array(text: &mut String, kind: &str, name: &str, components: usize, values: impl Iterator<Item = impl Display>) {
    let parts = if components > 1 { format!(" NumberOfComponents=\"{components}\"") } else { String::new() };
    let _ = write!(text, "<DataArray type=\"{kind}\" Name=\"{name}\"{parts} format=\"ascii\">");
    for (i, value) in values.enumerate() {
        let _ = write!(text, "{}{value}", if i % 12 == 0 { '\n' } else { ' ' });
    }
    text.push_str("\n</DataArray>\n");
}
