//! From places of a surface to a measure.

use glam::DVec3;

use super::Measuring;
use super::clip::branches;
use super::subject::Subject;
use super::tool::Tool;
use crate::app::document::Document;
use crate::app::state::State;
use crate::language::tell;
use crate::mesh::Vec3;
use crate::say;
use crate::sharing::measures::{Found, Measure};
use crate::vessel::beside::{beside, cross_section, fork};
use crate::vessel::certificate::StationStatus;

impl Measuring {
    /// What a tool finds at these places, as many as it takes; or in a sentence why nothing.
    pub(super) fn measured(
        &mut self,
        tool: Tool,
        places: &[Vec3],
        is_opened: bool,
        state: &State,
    ) -> Result<Measure, String> {
        let none = || say!("measure-no-surface");
        let document = state.document.as_ref().ok_or_else(none)?;
        let subject = Subject::new(document, is_opened, state.settings.keep).ok_or_else(none)?;
        let found = match (tool, places) {
            (Tool::Ruler, &[from, to]) => Found::Ruler { ends_mm: [from.into(), to.into()] },
            (Tool::Angle, &[one, vertex, other]) => {
                if one == vertex || other == vertex {
                    return Err(say!("measure-same-places"));
                }
                Found::Angle { places_mm: [one, vertex, other].map(|p| p.to_array()) }
            }
            (Tool::Diameter, &[at]) => {
                let index = self.indexing.advance(&subject, true).ok_or_else(none)?;
                let limit = document.opened.bounds().diagonal();
                let ball = index.inner_ball_beside(subject.positions, &subject.triangles, at, limit);
                let (wall, ball) = ball.ok_or_else(|| say!("measure-no-ball"))?;
                Found::Diameter { wall_mm: wall.into(), centre_mm: ball.centre.into(), diameter_mm: 2.0 * ball.radius }
            }
            (Tool::Section, &[at]) => section(&subject, document, at.as_dvec3())?,
            (Tool::Fork, &[at]) => angle(document, at.as_dvec3())?,
            _ => return Err(none()),
        };
        Ok(Measure { name: tool.name(&state.measures), made_on: subject.made_on, found })
    }
}

/// The cross-section of the vessel beside a place.
fn section(subject: &Subject<'_>, document: &Document, at: DVec3) -> Result<Found, String> {
    has_centrelines(document)?;
    let why = |error: crate::vessel::beside::NotMeasured| say!("measure-no-section", why = tell(&error));
    let place = beside(branches(document), at).map_err(why)?;
    let section = cross_section(subject.positions, &subject.triangles, &place).map_err(why)?;
    Ok(Found::Section {
        centre_mm: section.middle.as_vec3().into(),
        direction: place.direction.as_vec3().into(),
        area_mm2: section.area_mm2 as f32,
        widths_mm: section.widths_mm.map(|width| width as f32),
        outline_mm: section.outline.points.iter().map(|p| p.as_vec3().into()).collect(),
        vessel: place.branch.name.clone(),
        at_fork: place.standing == StationStatus::Fork,
    })
}

/// The angle of the fork next to a place, its sides as long as the branches are wide.
fn angle(document: &Document, at: DVec3) -> Result<Found, String> {
    has_centrelines(document)?;
    let found = fork(branches(document), at).map_err(|error| say!("measure-no-angle", why = tell(&error)))?;
    let reach = |i: usize| found.branches[i].opened.radius_mm.map_or(5.0, |radius| 4.0 * radius.mean);
    let end = |i: usize| (found.at + found.directions[i] * reach(i)).as_vec3().to_array();
    Ok(Found::Angle { places_mm: [end(0), found.at.as_vec3().to_array(), end(1)] })
}

/// In a sentence, why there are no centrelines, where there are none.
fn has_centrelines(document: &Document) -> Result<(), String> {
    match document.calibre.as_ref().map(|calibre| &calibre.found) {
        None => Err(say!("measure-not-yet")),
        Some(Err(why)) => Err(say!("measure-no-centreline", why = tell(why))),
        Some(Ok(_)) => Ok(()),
    }
}
