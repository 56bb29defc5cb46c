//! What a trial takes place in: the wall, the vessel tree, the way through it, and where the wire stands.

use std::sync::Arc;

use glam::DVec3;
use web_time::Instant;

use super::placement::{PlacementError, rotation};
use super::proposal::{Choice, proposed, proposed_entry, reached, suiting, with_room};
use super::reach::{ReachFinding, finding, rank};
use super::route::{Fork, PlaceName, Proposals as _, Route, RouteError, Routes as _, phantom_task};
use super::setup::{Entry, Setup};
use super::simulation::Simulation;
use super::wall::Wall;
use super::wire::Wire;
use lumen_mesh::split_mix::SplitMix64;
use lumen_mesh::{TriMesh, Vec3};
use lumen_message::messages;
use lumen_pipeline::results::fingerprint;
use lumen_pipeline::task::milliseconds;
use lumen_vessel::phantom::Sample;
use lumen_vessel::{Tree, TreeError};

/// By how much a seed moves the entry, in mm, turns it, in radians, and changes friction, as a part.
const VARIED: (f64, f64, f64) = (0.5, 2.0 * std::f64::consts::PI / 180.0, 0.2);

/// So many wires may follow one that is proposed and fails.
const NEXT_WIRES: usize = 3;

messages! {
    /// Why a trial cannot begin.
    #[derive(Clone, Debug, PartialEq)]
    pub enum TrialError {
        /// No place is known where a wire could enter.
        "trial-no-entry" NoEntry =>
            "no vessel of this surface has an end where a wire could enter; give an entry",
        /// No place is known where it could go.
        "trial-no-target" NoTarget =>
            "no vessel of this surface is far enough from the entry to be a target; give a target",
    } or {
        /// There is no tree.
        Tree(TreeError),
        /// There is no way.
        Route(RouteError),
        /// The wire cannot be put there.
        Placement(PlacementError),
    }
}

impl TrialError {
    /// The place that is the reason, in mm, where there is one.
    pub fn place(&self) -> Option<[f32; 3]> {
        if let Self::Route(error) = self { error.place() } else { None }
    }
}

/// A vessel that is ready for trials, and the way through it.
#[derive(Debug)]
pub struct Course {
    /// The wall.
    pub wall: Arc<Wall>,
    /// The vessel tree.
    pub tree: Tree,
    /// The way.
    pub route: Route,
    /// Its forks.
    pub forks: Vec<Fork>,
    /// What the tip of the wire that goes in first does not reach.
    pub reach: Option<ReachFinding>,
    /// Places where a wire could enter, with their names.
    pub entries: Vec<(PlaceName, Entry)>,
    /// Places where it could go, with their names.
    pub targets: Vec<(PlaceName, [f32; 3])>,
    /// Milliseconds to build the hierarchy of boxes.
    pub wall_ms: f64,
    /// Milliseconds to find tree and route.
    pub route_ms: f64,
    /// A number that differs where surfaces do.
    pub fingerprint: u64,
}

impl Course {
    /// Finds the way, and fills in what `setup` leaves open: samples bring their own entry, target and wire, and an entry
    /// without a direction points along the way.
    ///
    /// # Errors
    /// When there is no way for this wire.
    pub fn new(mesh: &Arc<TriMesh>, sample: Option<Sample>, setup: &mut Setup) -> Result<Self, TrialError> {
        setup.wire.check().map_err(PlacementError::from)?;
        let start = Instant::now();
        let wall = Arc::new(Wall::new(mesh.clone()));
        let wall_ms = milliseconds(start);
        let start = Instant::now();
        let tree = if wall.is_closed() { Tree::with_index(mesh, wall.index().clone())? } else { Tree::new(mesh)? };
        let task = sample.map(phantom_task);
        // Where walls cross each other, the end of one vessel may be outside of another.
        let is_inside = |entry: &Entry| tree.is_inside(Vec3::from(entry.at));
        let found = tree.entries().into_iter().filter(|(_, entry)| is_inside(entry));
        let own = task.iter().map(|(entry, _)| (PlaceName::Own, *entry));
        let ostia = tree.ostia();
        let entries: Vec<_> = own.chain(found).chain(ostia.iter().cloned()).collect();
        let is_open = setup.entry.is_none() && setup.target.is_none() && task.is_none();
        // A coronary artery is not reached by a wire alone: a guide catheter leads it into the ostium.
        let ostia: &[_] = if is_open { &ostia } else { &[] };
        let choice = Choice::Open { is_only: !setup.proposes_wire, ostia };
        let entry = match (setup.entry, &task) {
            (Some(entry), _) => Some(entry),
            (None, Some((entry, _))) => Some(*entry),
            (None, None) if setup.target.is_some() => entries.first().map(|(_, entry)| *entry),
            (None, None) => {
                let fits = |entry: &Entry, wire: &Wire| {
                    Simulation::new(wire, wire.friction, entry, 0.0, Some(wall.clone())).is_ok()
                };
                proposed_entry(&tree, &entries, (!setup.proposes_wire).then_some(&setup.wire), fits)
            }
        };
        let mut entry = entry.ok_or(TrialError::NoEntry)?;
        let mut from = Vec3::from(entry.at);
        let mut best = None;
        let proposes_wire = std::mem::take(&mut setup.proposes_wire);
        if proposes_wire {
            (setup.wire, best) = match sample {
                Some(sample) => (Wire::for_sample(sample), None),
                None => proposed(&tree, from, setup.target.map(Vec3::from), choice),
            };
        }
        let found = tree.targets(from, 0.0).into_iter().map(|target| (target.name(), target.at.to_array()));
        let own = task.iter().map(|(_, target)| (PlaceName::Own, target.to_array()));
        let targets: Vec<_> = own.chain(found).collect();
        let target = match (setup.target, &task) {
            (Some(target), _) => target,
            (None, Some((_, target))) => target.to_array(),
            (None, None) => {
                let best = best.or_else(|| reached(&tree, from, &setup.wire, choice));
                best.map(|target| target.at.to_array())
                    .or_else(|| Some(targets.first()?.1))
                    .ok_or(TrialError::NoTarget)?
            }
        };
        if is_open && let Some((_, guided)) = tree.ostium_on_way(from, Vec3::from(target)) {
            (entry, from) = (guided, Vec3::from(guided.at));
            if proposes_wire {
                setup.wire = proposed(&tree, from, Some(Vec3::from(target)), Choice::First).0;
            }
        }
        (setup.entry, setup.target) = (Some(entry), Some(target));
        let route = tree.route(from, Vec3::from(target))?;
        route.clearance(setup.wire.diameter_mm)?;
        let forks = route.forks(&tree);
        let mut wires = suiting(&route, &setup.wire);
        rank(&mut wires, &forks);
        if proposes_wire {
            if sample.is_none() && !wires.is_empty() {
                setup.wire = wires.remove(0);
            }
            wires.retain(|wire| *wire != setup.wire);
            wires.truncate(NEXT_WIRES);
            setup.next_wires.clone_from(&wires);
        }
        let reach = finding(&forks, &setup.wire, &with_room(&route, Wire::names()));
        if entry.direction == [0.0; 3] {
            let direction = route.at(0.0).direction.as_vec3().to_array();
            setup.entry = Some(Entry { direction, ..entry });
        }
        let route_ms = milliseconds(start);
        let fingerprint = fingerprint(mesh);
        Ok(Self { wall, tree, route, forks, reach, entries, targets, wall_ms, route_ms, fingerprint })
    }

    /// A wire at the entry, varied by the seed; also its coefficients of friction.
    ///
    /// # Errors
    /// When it does not fit there.
    pub fn place(&self, setup: &Setup, wire: &Wire) -> Result<(Simulation, [f64; 2]), TrialError> {
        setup.check_loads()?;
        let (mut simulation, friction) = self.enter(setup, wire)?;
        simulation.set_load(DVec3::from(setup.load.map(f64::from)))?;
        Ok((simulation, friction))
    }

    /// The same without its load.
    fn enter(&self, setup: &Setup, wire: &Wire) -> Result<(Simulation, [f64; 2]), TrialError> {
        let entry = setup.entry.ok_or(TrialError::NoEntry)?;
        let is_inside = |entry: &Entry| self.tree.is_inside(Vec3::from(entry.at));
        if !is_inside(&entry) {
            return Err(PlacementError::Outside.into());
        }
        let mut random = SplitMix64::new(setup.seed);
        let is_varied = setup.seed != 0;
        let part = |x: f64| if is_varied { x } else { 0.0 };
        let (angle, out, tilt, tilted) = (random.unit(), random.unit(), random.unit(), random.unit());
        let roll = part(std::f64::consts::TAU * random.unit());
        let friction = wire.friction.map(|mu| mu * (1.0 + part(VARIED.2 * (2.0 * random.unit() - 1.0))));
        let way = DVec3::from(entry.direction.map(f64::from)).try_normalize().ok_or(PlacementError::Direction)?;
        let across = way.any_orthonormal_vector();
        let turned = |angle: f64| rotation(way, std::f64::consts::TAU * angle) * across;
        let mut shift = turned(angle) * part(VARIED.0 * out.sqrt());
        let mut lean = part(VARIED.1 * tilted.sqrt());
        // In a narrow vessel there is less room than the seed asks for.
        for _ in 0..4 {
            let direction = rotation(turned(tilt), lean) * way;
            let at = DVec3::from(entry.at.map(f64::from)) + shift;
            let varied = Entry { at: at.as_vec3().to_array(), direction: direction.as_vec3().to_array() };
            match Simulation::new(wire, friction, &varied, roll, Some(self.wall.clone())) {
                Ok(simulation) if is_inside(&varied) => return Ok((simulation, friction)),
                Ok(_) | Err(PlacementError::Tight { .. } | PlacementError::Outside) => {
                    shift /= 2.0;
                    lean /= 2.0;
                }
                Err(error) => return Err(error.into()),
            }
        }
        Ok((Simulation::new(wire, friction, &entry, roll, Some(self.wall.clone()))?, friction))
    }
}
