//! What the lessons claim of the picture, held against the sample as a step sets it. A claim is a few words of a step in each
//! language, and what has to hold for them. Every number of a step is a setting of it or part of a claim, so none is said that
//! nothing computes; what a step only asks the reader to look at is no claim.

use std::cell::OnceCell;
use std::f64::consts::PI;
use std::ops::Range;
use std::sync::Arc;

use glam::Vec3;
use lumen::app::lesson::{LESSONS, Lesson, Step};
use lumen::language::{Key, Language, built_in, speak};
use lumen::mesh::{Topology, TriMesh, boundary_loops, roughness, self_intersections, volume};
use lumen::phantom::{Sample, generate, vessels};
use lumen::pipeline::classes::{Class, Classes};
use lumen::pipeline::filter::Filter;
use lumen::pipeline::laplacian::laplacian_response;
use lumen::pipeline::response::wavelength;
use lumen::pipeline::run::Pipeline;
use lumen::pipeline::settings::{Settings, Smoothing, Window};
use lumen::prelude::{Course, Setup, Trial};
use lumen::prepare::ends::Length;
use lumen::prepare::prepare::{Plan, prepare};
use lumen::task::{Yielder, at_once};
use lumen::trial::frame::Progress;
use lumen::trial::wire::Wire;
use lumen::vessel::certificate::{BranchCalibre, Certificate, Verdict};
use lumen_test_support::crossings::crossing_faces;
use lumen_test_support::shape::Shape;

/// Radii of the sample's vessels in mm, which tell them apart.
const RENAL: Range<f64> = 2.5..3.5;
const ILIAC: Range<f64> = 4.5..5.5;
const AORTA: Range<f64> = 8.0..11.0;

/// A claim.
struct Claim {
    /// The lesson, and its step from 0.
    at: (&'static str, usize),
    /// In English, German and French.
    says: [&'static str; 3],
    truth: Truth,
}

enum Truth {
    /// Something holds; else what is so instead.
    Holds(fn(&Seen) -> Result<(), String>),
    /// The number in the words, to within so much.
    Is(fn(&Seen) -> f64, f64),
}
use Truth::{Holds, Is};

/// The sample as a step sets it.
struct Seen<'a> {
    /// What settings change is computed from what is there.
    default: &'a Pipeline,
    /// The same of the sample that marching cubes have made.
    cubes: &'a Pipeline,
    settings: Settings,
    pipeline: OnceCell<Pipeline>,
}

impl Seen<'_> {
    fn pipeline(&self) -> &Pipeline {
        self.pipeline.get_or_init(|| {
            let mut pipeline = self.default.fork();
            pipeline.set(self.settings.clone()).unwrap();
            pipeline.finish().unwrap();
            pipeline
        })
    }

    fn kept(&self) -> &TriMesh {
        &self.pipeline().kept().unwrap().mesh
    }

    fn smoothed(&self) -> &TriMesh {
        &self.pipeline().smoothed().unwrap().mesh
    }

    fn level(&self) -> &TriMesh {
        &self.pipeline().reduced().unwrap().mesh
    }

    fn certificate(&self) -> &Certificate {
        &self.pipeline().certified().unwrap().as_ref().unwrap().certificate
    }

    /// The largest change of calibre in smoothing of each branch whose mean radius as opened lies within `radii` mm, in percent.
    fn changes(&self, radii: Range<f64>) -> Vec<f64> {
        let is_so = |branch: &&BranchCalibre| branch.opened.radius_mm.is_some_and(|of| radii.contains(&of.mean));
        let some = self.certificate().branches.iter().filter(is_so);
        some.filter_map(|branch| branch.smoothed.largest_change.map(|change| change.percent)).collect()
    }

    fn filter(&self) -> Filter {
        Filter::new(&self.settings.smoothing)
    }

    /// Distance between points and between slices of the grid that the surface was cut from, in mm: a vertex lies half way
    /// between two points.
    fn voxel(&self) -> [f64; 2] {
        let step = |axis: usize| {
            let mut places: Vec<f32> = self.default.opened().positions.iter().map(|p| p[axis]).collect();
            places.sort_by(f32::total_cmp);
            let gaps = places.windows(2).map(|pair| f64::from(pair[1] - pair[0])).filter(|&gap| gap > 1e-3);
            2.0 * gaps.fold(f64::INFINITY, f64::min)
        };
        [step(0), step(2)]
    }

    /// How far vertices have moved in smoothing, ascending, in mm.
    fn moves(&self) -> Vec<f32> {
        let pairs = self.kept().positions.iter().zip(&self.smoothed().positions);
        let mut moves: Vec<f32> = pairs.map(|(before, after)| before.distance(*after)).collect();
        moves.sort_by(f32::total_cmp);
        moves
    }
}

fn holds(is_so: bool, found: impl std::fmt::Debug) -> Result<(), String> {
    if is_so { Ok(()) } else { Err(format!("{found:?}")) }
}

/// Eigenvalues from 0 to 2.
fn eigenvalues() -> impl Iterator<Item = f64> {
    (0..=20_000).map(|i| f64::from(i) / 10_000.0)
}

/// How wide the fall of a filter from 90 % to 10 % is, in powers of ten of the eigenvalue as Response draws it.
fn fall(filter: &Filter) -> f64 {
    let below = |gain: f64| eigenvalues().find(|&k| filter.response(k) < gain).unwrap_or(2.0);
    libm::log10(below(0.1) / below(0.9))
}

/// The largest gain above the fall, where there should be none.
fn ripple(filter: &Filter) -> f64 {
    let above: Vec<f64> = eigenvalues().filter(|&k| k > filter.half_gain().unwrap()).collect();
    let gains: Vec<f64> = above.iter().map(|&k| filter.response(k)).collect();
    let end = gains.windows(2).position(|pair| pair[0] < pair[1]).unwrap();
    gains[end..].iter().map(|gain| gain.abs()).fold(0.0, f64::max)
}

/// The filters of a step with each window, in the order of [`Window::ALL`].
fn windows(seen: &Seen) -> [Filter; 4] {
    Window::ALL.map(|window| Filter::new(&Smoothing { window, ..seen.settings.smoothing }))
}

/// The mean circumference in mm of the vessels of the aorta's sample that have this in their names, past their origins.
fn around(name: &str) -> f64 {
    let all = vessels(Sample::Aorta);
    let some = all.iter().filter(|vessel| vessel.name.contains(name));
    let diameters: Vec<f64> = some.flat_map(|vessel| vessel.stations[1..].iter().map(|at| at.diameter)).collect();
    PI * diameters.iter().sum::<f64>() / diameters.len() as f64
}

/// The volume of what is kept, open ends closed.
fn enclosed(pipeline: &Pipeline) -> f64 {
    let mesh = &pipeline.kept().unwrap().mesh;
    volume(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles))
}

/// The mean radii of the arteries that leave the aorta, with the filter, in mm; the largest first.
fn arteries(pipeline: &Pipeline) -> Vec<f64> {
    let certificate = &pipeline.certified().unwrap().as_ref().unwrap().certificate;
    let mut radii: Vec<f64> =
        certificate.branches.iter().filter_map(|branch| branch.smoothed.radius_mm).map(|of| of.mean).collect();
    radii.retain(|&radius| radius < AORTA.start);
    radii.sort_by(|a, b| b.total_cmp(a));
    radii
}

const CLAIMS: &[Claim] = &[
    Claim {
        at: ("nets", 0),
        says: ["half way between", "auf halbem Weg zwischen", "à mi-chemin entre"],
        // Along one axis half way, along the others on a voxel.
        truth: Holds(|seen| {
            let mesh = &**seen.default.opened();
            let [point, slice] = seen.voxel();
            let first = mesh.positions[0].as_dvec3();
            let halves = |p: &Vec3| (p.as_dvec3() - first).to_array().map(|along| 2.0 * along);
            let steps = mesh.positions.iter().map(|p| {
                let [x, y, z] = halves(p);
                [x / point, y / point, z / slice].map(|step| (step - step.round()).abs())
            });
            let off = steps.flatten().fold(0.0, f64::max);
            holds(off < 0.01, off)
        }),
    },
    Claim {
        at: ("nets", 1),
        says: [
            "less rough before any filter",
            "weniger rau, noch vor jedem Filter",
            "moins rugueuse avant tout filtre",
        ],
        truth: Holds(|seen| {
            let rough = |mesh: &TriMesh| {
                roughness(mesh, &Topology::new(mesh.positions.len(), &mesh.triangles)).unwrap().rms_deg
            };
            let [nets, cubes] = [seen.level(), &seen.cubes.kept().unwrap().mesh].map(rough);
            holds(nets < 0.8 * cubes, (nets, cubes))
        }),
    },
    Claim {
        at: ("nets", 1),
        says: ["by less than 1 %", "um weniger als 1 %", "de moins de 1 %"],
        truth: Holds(|seen| {
            let ratio = enclosed(seen.default) / enclosed(seen.cubes);
            holds((ratio - 1.0).abs() < 0.01, ratio)
        }),
    },
    Claim {
        at: ("nets", 2),
        says: ["to within 1 %", "auf 1 %", "à 1 % près"],
        truth: Holds(|seen| {
            let [nets, cubes] = [seen.default, seen.cubes].map(arteries);
            let off = nets.iter().zip(&cubes).map(|(nets, cubes)| (nets / cubes - 1.0).abs()).fold(0.0, f64::max);
            holds(nets.len() == 4 && cubes.len() == 4 && off < 0.01, (off, nets, cubes))
        }),
    },
    Claim {
        at: ("stair-steps", 0),
        says: [
            "as high as a slice is thick",
            "so hoch, wie eine Schicht dick ist",
            "aussi hautes qu'une coupe est épaisse",
        ],
        // Facets across z lie whole slices apart.
        truth: Holds(|seen| {
            let mesh = &**seen.default.opened();
            let is_flat = |[a, b, c]: &[Vec3; 3]| (a.z - b.z).abs() < 1e-4 && (a.z - c.z).abs() < 1e-4;
            let flat = (0..mesh.triangles.len()).map(|t| mesh.corners(t)).filter(is_flat);
            let mut heights: Vec<f32> = flat.map(|[a, ..]| a.z).collect();
            heights.sort_by(f32::total_cmp);
            heights.dedup_by(|a, b| *a - *b < 1e-3);
            let [_, slice] = seen.voxel();
            let steps = heights.windows(2).map(|pair| f64::from(pair[1] - pair[0]) / slice);
            let off = steps.map(|step| (step - step.round()).abs()).fold(0.0, f64::max);
            holds(heights.len() > 20 && off < 0.01, (heights.len(), off))
        }),
    },
    Claim {
        at: ("stair-steps", 1),
        says: ["No triangle goes", "Kein Dreieck geht verloren", "Aucun triangle ne disparaît"],
        truth: Holds(|seen| {
            let [before, after] = [seen.kept(), seen.smoothed()].map(|mesh| mesh.triangles.len());
            holds(before == after, (before, after))
        }),
    },
    Claim {
        at: ("stair-steps", 1),
        says: [
            "On most of the wall less than half a voxel",
            "Auf dem größten Teil der Wand weniger als ein halbes Voxel",
            "Sur la plus grande part de la paroi moins d'un demi-voxel",
        ],
        truth: Holds(|seen| {
            let (moves, [point, slice]) = (seen.moves(), seen.voxel());
            let [some, most] = [0.5, 0.7].map(|part| f64::from(moves[(moves.len() as f64 * part) as usize]));
            // Not much less, either.
            holds(most < point / 2.0 && some > slice / 5.0, (some, most, point, slice))
        }),
    },
    Claim {
        at: ("stair-steps", 2),
        says: ["one triangle in ten is left", "eines von zehn Dreiecken ist übrig", "il reste un triangle sur dix"],
        truth: Holds(|seen| {
            let [before, after] = [seen.smoothed(), seen.level()].map(|mesh| mesh.triangles.len());
            holds(before.abs_diff(10 * after) <= 20, (before, after))
        }),
    },
    Claim {
        at: ("stair-steps", 2),
        says: ["and the form is there", "und die Form ist da", "et la forme est là"],
        truth: Holds(|seen| holds(seen.certificate().verdict == Verdict::Kept, seen.certificate().verdict)),
    },
    Claim {
        at: ("pass-band", 0),
        says: ["up to 2 for the shortest", "bis 2 für die kürzeste", "jusqu'à 2 pour la plus courte"],
        truth: Is(|_| *Smoothing::PASS_BAND.end(), 0.0),
    },
    Claim {
        at: ("pass-band", 0),
        says: ["a straight line at 100 %", "eine gerade Linie bei 100 %", "une droite à 100 %"],
        truth: Holds(|seen| {
            let filter = seen.filter();
            let off = eigenvalues().map(|k| (filter.response(k) - 1.0).abs()).fold(0.0, f64::max);
            holds(off < 0.005, off)
        }),
    },
    Claim {
        at: ("pass-band", 1),
        says: [
            "At 0.1 the shortest waves go",
            "Bei 0,1 gehen die kürzesten Wellen verloren",
            "À 0,1 les ondes les plus courtes disparaissent",
        ],
        truth: Holds(|seen| holds(seen.filter().response(2.0).abs() < 0.01, seen.filter().response(2.0))),
    },
    Claim {
        at: ("pass-band", 1),
        says: [
            "What happens at 0.01: does less pass, or more? Less.",
            "Was geschieht bei 0,01: Geht weniger durch oder mehr? Weniger.",
            "Que se passe-t-il à 0,01 : en passe-t-il moins, ou plus ? Moins.",
        ],
        truth: Holds(|seen| {
            let less = Filter::new(&Smoothing { pass_band: 0.01, ..seen.settings.smoothing });
            let [here, there] =
                [seen.filter(), less].map(|filter| eigenvalues().map(|k| filter.response(k)).sum::<f64>());
            holds(there < here, (here, there))
        }),
    },
    Claim {
        at: ("pass-band", 2),
        says: [
            "terraces are gone on this surface",
            "sind die Terrassen auf dieser Oberfläche fort",
            "les terrasses ont disparu sur cette surface",
        ],
        // Terraces are what bends the surface most.
        truth: Holds(|seen| {
            let bends = |mesh: &TriMesh| {
                let topology = Topology::new(mesh.positions.len(), &mesh.triangles);
                roughness(mesh, &topology).unwrap().rms_deg
            };
            let [before, after] = [seen.kept(), seen.smoothed()].map(bends);
            holds(after < before / 4.0, (before, after))
        }),
    },
    Claim {
        at: ("pass-band", 2),
        says: [
            "calibres stay to about 3 %",
            "die Kaliber bleiben bis auf etwa 3 %",
            "les calibres restent à environ 3 % près",
        ],
        truth: Is(|seen| seen.changes(0.0..20.0).into_iter().map(f64::abs).fold(0.0, f64::max), 0.5),
    },
    Claim {
        at: ("pass-band", 2),
        says: [
            "on a finer mesh the same 0.01 means shorter waves",
            "Auf einem feineren Netz bedeutet dasselbe 0,01 kürzere Wellen",
            "sur un maillage plus fin le même 0,01 correspond à des ondes plus courtes",
        ],
        truth: Holds(|_| {
            let [fine, coarse] = [0.3, 0.6].map(|edge| wavelength(0.01, edge).unwrap());
            holds(fine < coarse, (fine, coarse))
        }),
    },
    Claim {
        at: ("pass-band", 3),
        says: [
            "the renal arteries are drawn shut",
            "Die Nierenarterien werden zugezogen",
            "les artères rénales se referment",
        ],
        truth: Holds(|seen| {
            let changes = seen.changes(RENAL);
            holds(changes.len() == 2 && changes.iter().all(|&change| change < -95.0), changes)
        }),
    },
    Claim {
        at: ("pass-band", 3),
        says: [
            "the iliac arteries lose half of their calibre",
            "die Beckenarterien verlieren die Hälfte ihres Kalibers",
            "les artères iliaques perdent la moitié de leur calibre",
        ],
        truth: Holds(|seen| {
            let changes = seen.changes(ILIAC);
            holds(changes.len() == 2 && changes.iter().all(|change| (-60.0..-40.0).contains(change)), changes)
        }),
    },
    Claim {
        at: ("pass-band", 3),
        says: [
            "branches 4 and 5, the renal arteries, and 1 and 7, the iliac arteries",
            "Äste 4 und 5, der Nierenarterien, und 1 und 7, der Beckenarterien",
            "branches 4 et 5, les artères rénales, et 1 et 7, les artères iliaques",
        ],
        truth: Holds(|seen| {
            let mean =
                |number: usize| seen.certificate().branches[number - 1].opened.radius_mm.map_or(0.0, |of| of.mean);
            let found = [4, 5, 1, 7].map(mean);
            let [renal, iliac] = [&found[..2], &found[2..]];
            let is_so = renal.iter().all(|of| RENAL.contains(of)) && iliac.iter().all(|of| ILIAC.contains(of));
            holds(is_so, found)
        }),
    },
    Claim {
        at: ("windows", 0),
        says: ["from 100 % to nothing", "von 100 % auf nichts", "de 100 % à rien"],
        truth: Holds(|seen| {
            let ends = [0.0, 2.0].map(|k| seen.filter().response(k));
            holds((ends[0] - 1.0).abs() < 1e-9 && ends[1].abs() < 0.01, ends)
        }),
    },
    Claim {
        at: ("windows", 0),
        says: [
            "with 10 the fall is wide, and waves far above the pass band stay",
            "Mit 10 ist der Abfall breit, und Wellen weit über dem Durchlassband bleiben",
            "avec 10 la chute est large, et des ondes bien au-dessus de la bande restent",
        ],
        truth: Holds(|seen| {
            let far = seen.filter().response(4.0 * seen.settings.smoothing.pass_band);
            holds(fall(&seen.filter()) > 0.4 && far > 0.5, (fall(&seen.filter()), far))
        }),
    },
    Claim {
        at: ("windows", 1),
        says: [
            "With 100 the fall is steep and lies close above the pass band",
            "Mit 100 ist der Abfall steil und liegt dicht über dem Durchlassband",
            "Avec 100 la chute est raide et tout près au-dessus de la bande passante",
        ],
        truth: Holds(|seen| {
            let half = seen.filter().half_gain().unwrap() / seen.settings.smoothing.pass_band;
            holds(fall(&seen.filter()) < 0.2 && (1.0..1.5).contains(&half), (fall(&seen.filter()), half))
        }),
    },
    Claim {
        at: ("windows", 1),
        says: [
            "has moved towards the dashed line",
            "sich zur gestrichelten Linie bewegt hat",
            "s'est rapproché de la ligne en tirets",
        ],
        truth: Holds(|seen| {
            let before = Filter::new(&Smoothing { iterations: 10, ..seen.settings.smoothing });
            let [before, after] = [before, seen.filter()].map(|filter| filter.half_gain().unwrap());
            holds(after < before && after > seen.settings.smoothing.pass_band, (before, after))
        }),
    },
    Claim {
        at: ("windows", 2),
        says: [
            "Hamming, the paper's, falls steeply and ripples by little; Nuttall ripples least and falls least steeply.",
            "Hamming, das der Veröffentlichung, fällt steil und ist wenig wellig; Nuttall ist am wenigsten wellig und fällt am wenigsten steil.",
            "Hamming, celle de l'article, tombe vite et ondule peu ; Nuttall ondule le moins et tombe le moins vite.",
        ],
        truth: Holds(|seen| {
            let all = windows(seen);
            let (falls, ripples) = (all.each_ref().map(fall), all.each_ref().map(ripple));
            let is_last = falls[..3].iter().all(|&other| falls[3] > other)
                && ripples[..3].iter().all(|&other| ripples[3] < other);
            let is_the_papers = Smoothing::PAPER.window == Window::Hamming && ripples[0] < 0.01;
            holds(is_last && is_the_papers, (falls, ripples))
        }),
    },
    Claim {
        at: ("windows", 2),
        says: [
            "Which of the four has the steepest fall at the same degree? Hamming, then Hanning. Blackman and Nuttall ripple less and fall less steeply.",
            "Welches der vier hat beim selben Grad den steilsten Abfall? Hamming, dann Hanning. Blackman und Nuttall sind weniger wellig und fallen weniger steil.",
            "Laquelle des quatre a la chute la plus raide au même degré ? Hamming, puis Hanning. Blackman et Nuttall ondulent moins et tombent moins vite.",
        ],
        truth: Holds(|seen| {
            let all = windows(seen);
            let (falls, ripples) = (all.each_ref().map(fall), all.each_ref().map(ripple));
            let ripple_less = ripples[2..].iter().all(|&less| ripples[..2].iter().all(|&more| less < more));
            holds(falls.is_sorted() && ripple_less, (falls, ripples))
        }),
    },
    Claim {
        at: ("shrinkage", 0),
        says: [
            "every pass takes a little off all waves, the longest as well",
            "jeder Durchgang nimmt von allen Wellen ein wenig weg, auch von den längsten",
            "chaque passe enlève un peu à toutes les ondes, aux plus longues également",
        ],
        truth: Holds(|_| {
            let most = eigenvalues().filter(|&k| k > 0.0).map(|k| laplacian_response(k, 1)).fold(0.0, f64::max);
            holds(most < 1.0, most)
        }),
    },
    Claim {
        at: ("shrinkage", 0),
        says: [
            "The windowed-sinc filter leaves the long waves whole",
            "Der Windowed-Sinc-Filter lässt die langen Wellen ganz",
            "Le filtre en sinus cardinal fenêtré laisse les ondes longues entières",
        ],
        truth: Holds(|seen| {
            let long = eigenvalues().filter(|&k| k <= seen.settings.smoothing.pass_band);
            let off = long.map(|k| (seen.filter().response(k) - 1.0).abs()).fold(0.0, f64::max);
            holds(off < 0.01, off)
        }),
    },
    Claim {
        at: ("shrinkage", 1),
        says: [
            "the waves around the renal arteries, 19 mm long",
            "die Wellen um die Nierenarterien, 19 mm lang",
            "les ondes autour des artères rénales, longues de 19 mm",
        ],
        truth: Is(|_| around("renal"), 0.5),
    },
    Claim {
        at: ("shrinkage", 1),
        says: [
            "whose waves are three times as long",
            "deren Wellen dreimal so lang sind",
            "dont les ondes sont trois fois plus longues",
        ],
        truth: Holds(|_| {
            let times = around("aorta") / around("renal");
            holds((2.5..3.5).contains(&times), times)
        }),
    },
    Claim {
        at: ("shrinkage", 1),
        says: [
            "These lose calibre; the aorta, whose waves",
            "Diese verlieren Kaliber; die Aorta, deren Wellen",
            "Celles-ci perdent du calibre ; l'aorte, dont les ondes",
        ],
        truth: Holds(|seen| {
            let [renal, wide] = [RENAL, AORTA].map(|radii| seen.changes(radii));
            let lose = renal.len() == 2 && renal.iter().all(|&change| change < -2.0);
            holds(lose && !wide.is_empty() && wide.iter().all(|change| change.abs() <= 2.0), (renal, wide))
        }),
    },
    Claim {
        at: ("shrinkage", 2),
        says: [
            "until the volume is what it was, to 0.01 %",
            "bis das Volumen ist, was es war, auf 0,01 %",
            "jusqu'à ce que le volume soit ce qu'il était, à 0,01 % près",
        ],
        truth: Holds(|seen| {
            let pipeline = seen.pipeline();
            let before = pipeline.kept().unwrap().measures.volume_mm3.unwrap();
            let after = pipeline.smoothed().unwrap().measures.volume_mm3.unwrap();
            holds((after / before - 1.0).abs() <= 1e-4, after / before)
        }),
    },
    Claim {
        at: ("shrinkage", 2),
        says: [
            "Does the right volume mean the right calibre everywhere? No.",
            "Bedeutet das richtige Volumen überall das richtige Kaliber? Nein.",
            "Le bon volume veut-il dire le bon calibre partout ? Non.",
        ],
        truth: Holds(|seen| {
            let verdicts: Vec<Verdict> =
                seen.certificate().branches.iter().map(|branch| branch.verdict_smoothed).collect();
            holds(verdicts.contains(&Verdict::Changed), verdicts)
        }),
    },
    Claim {
        at: ("shrinkage", 3),
        says: [
            "so wide that the waves around its vessel pass",
            "so breit, dass die Wellen um sein Gefäß durchgehen",
            "assez large pour que les ondes autour de son vaisseau passent",
        ],
        truth: Holds(|seen| {
            let verdicts: Vec<Verdict> =
                seen.certificate().branches.iter().map(|branch| branch.verdict_smoothed).collect();
            holds(!verdicts.contains(&Verdict::Changed), verdicts)
        }),
    },
    Claim {
        at: ("decimation", 1),
        says: ["Schroeder has five classes", "Schroeder hat fünf Klassen", "Schroeder a cinq classes"],
        truth: Holds(|_| holds(Class::ALL.len() == 5, Class::ALL)),
    },
    Claim {
        at: ("decimation", 1),
        says: [
            "Smooth vessels have hardly any feature edges. Where are the vertices that are not simple? At the open ends: they are boundary vertices.",
            "Glatte Gefäße haben kaum Formkanten. Wo sind die Eckpunkte, die nicht einfach sind? An den offenen Enden: Es sind Randpunkte.",
            "Des vaisseaux lisses n'ont presque pas d'arêtes vives. Où sont les sommets qui ne sont pas simples ? Aux extrémités ouvertes : ce sont des sommets de bord.",
        ],
        truth: Holds(|seen| {
            let (levels, level) = (seen.pipeline().progressive().unwrap(), &seen.pipeline().reduced().unwrap().level);
            let [simple, complex, boundary, edge, corner] = Classes::new(levels, level.steps, &level.triangles).counts;
            let others = complex + edge + corner;
            holds(boundary > 0 && others * 20 <= boundary, [simple, complex, boundary, edge, corner])
        }),
    },
    Claim {
        at: ("decimation", 2),
        says: [
            "From 50 % to 90 % four of five triangles go. Does the error grow fivefold? On smooth vessels about so",
            "Von 50 % bis 90 % gehen vier von fünf Dreiecken. Wächst der Fehler auf das Fünffache? Auf glatten Gefäßen etwa so",
            "De 50 % à 90 %, quatre triangles sur cinq disparaissent. L'erreur est-elle multipliée par cinq ? Sur des vaisseaux lisses à peu près",
        ],
        truth: Holds(|seen| {
            let levels = seen.pipeline().progressive().unwrap();
            let after = |per_mille: usize| levels.steps_to(levels.triangles.len() * (1000 - per_mille) / 1000);
            let [half, tenth] = [500, 900].map(|rate| f64::from(levels.error_after(after(rate))));
            holds((4.0..6.5).contains(&(tenth / half)), (half, tenth))
        }),
    },
    Claim {
        at: ("decimation", 3),
        says: [
            "No open end is closed, no two vessels are joined, and no triangle is made to cross another.",
            "Kein offenes Ende wird geschlossen, keine zwei Gefäße werden verbunden, und kein Dreieck schneidet danach ein anderes.",
            "Aucune extrémité ouverte n'est fermée, aucun vaisseau n'est joint à un autre, et aucun triangle n'est amené à en croiser un autre.",
        ],
        truth: Holds(|seen| {
            let [before, after] = [seen.smoothed(), seen.level()].map(Shape::of);
            let crossing = self_intersections(seen.level()).len() + crossing_faces(seen.level());
            holds(before == after && crossing == 0, (before, after, crossing))
        }),
    },
    Claim {
        at: ("decimation", 3),
        says: [
            "from 99.7 % on a vessel is pinched",
            "Ab 99,7 % ist ein Gefäß eingeschnürt",
            "à partir de 99,7 % un vaisseau est pincé",
        ],
        truth: Is(
            |seen| seen.pipeline().smoothed_measures().unwrap().pinch.map_or(0.0, |pinch| pinch.from_percent),
            0.05,
        ),
    },
    Claim {
        at: ("decimation", 3),
        says: ["the place that is pinched", "die Stelle, die eingeschnürt ist", "l'endroit qui est pincé"],
        truth: Holds(|seen| {
            let narrowing = seen.pipeline().level_measures().unwrap().narrowing;
            holds(narrowing.is_some_and(|found| found.pinched_places > 0), narrowing)
        }),
    },
    Claim {
        at: ("decimation", 3),
        says: [
            "every open end is still there, with three edges or more",
            "jedes offene Ende ist noch da, mit drei oder mehr Kanten",
            "chaque extrémité ouverte est encore là, avec trois arêtes ou plus",
        ],
        truth: Holds(|seen| {
            let rims = |mesh: &TriMesh| boundary_loops(&Topology::new(mesh.positions.len(), &mesh.triangles));
            let [before, after] = [seen.smoothed(), seen.level()].map(rims);
            let edges: Vec<usize> = after.iter().map(Vec::len).collect();
            holds(before.len() == after.len() && edges.iter().all(|&edges| edges >= 3), edges)
        }),
    },
    Claim {
        at: ("wire", 0),
        says: ["a wire of 0.89 mm", "ein Draht von 0,89 mm", "un guide de 0,89 mm"],
        truth: Is(|_| Wire::for_sample(Sample::Aorta).diameter_mm, 0.005),
    },
    Claim {
        at: ("wire", 0),
        says: [
            "Will the wire touch the wall all the way, or in a few places? In a few",
            "Wird der Draht die Wand auf dem ganzen Weg berühren oder an wenigen Stellen? An wenigen",
            "Le guide touchera-t-il la paroi tout du long, ou en quelques endroits ? En quelques-uns",
        ],
        truth: Holds(|seen| {
            let level = seen.pipeline().reduced().unwrap().mesh.clone();
            let mut setup = Setup { proposes_wire: true, ..Setup::default() };
            let course = Course::new(&level, Some(Sample::Aorta), &mut setup).unwrap();
            let mut trial = Trial::new(Arc::new(course), setup).unwrap();
            trial.set_autopilot(true);
            let (mut touching, mut steps) = (0.0, 0.0);
            while trial.progress() == Progress::Running {
                trial.step();
                touching += trial.meter().forces.contacts as f64 / trial.simulation().count() as f64;
                steps += 1.0;
            }
            holds(touching > 0.0 && touching / steps < 0.2, touching / steps)
        }),
    },
    Claim {
        at: ("wire", 2),
        says: [
            "The same with one triangle in a hundred",
            "Dasselbe mit einem von hundert Dreiecken",
            "La même chose avec un triangle sur cent",
        ],
        truth: Holds(|seen| {
            let [before, after] = [seen.smoothed(), seen.level()].map(|mesh| mesh.triangles.len());
            holds(before.abs_diff(100 * after) <= 200, (before, after))
        }),
    },
    Claim {
        at: ("solver", 1),
        says: ["extended by 5 radii", "um 5 Radien verlängert", "prolongée de 5 rayons"],
        truth: Is(
            |_| match Plan::flow().extend {
                Some(Length::Radii(radii)) => radii,
                _ => f64::NAN,
            },
            0.0,
        ),
    },
    Claim {
        at: ("solver", 2),
        says: ["has 12 edges around", "gehen 12 Kanten", "a 12 arêtes autour"],
        truth: Is(|_| Plan::flow().remesh.unwrap().around, 0.0),
    },
    Claim {
        at: ("solver", 2),
        says: [
            "None is far from equilateral",
            "Keines ist weit von gleichseitig entfernt",
            "Aucun n'est loin d'être équilatéral",
        ],
        truth: Holds(|seen| {
            let made = at_once(prepare(seen.level(), &Plan::flow(), &Yielder::never())).unwrap();
            let (quality, _) = made.remeshed.unwrap();
            holds(quality.least_angle_deg > 30.0, quality)
        }),
    },
    Claim {
        at: ("solver", 2),
        says: ["A polygon of 12 edges", "Ein Vieleck mit 12 Kanten", "Un polygone de 12 arêtes"],
        truth: Is(|_| Plan::flow().remesh.unwrap().around, 0.0),
    },
    Claim {
        at: ("solver", 2),
        says: ["4.5 %", "4,5 %", "4,5 %"],
        truth: Is(|_| 100.0 * (1.0 - 6.0 / PI * (PI / 6.0).sin()), 0.05),
    },
];

/// What a step says, with a blank between its parts.
fn words(step: &Step) -> String {
    let Step { title, text, look, question, .. } = step;
    let (ask, answer) = question.clone().unwrap_or_default();
    // French has a space that does not break before its signs.
    [title, text, look, &ask, &answer].map(String::as_str).join(" ").replace('\u{a0}', " ")
}

/// The numbers in a text, with a decimal point or comma.
fn numbers(text: &str) -> Vec<f64> {
    let is_mark = |c: char| c == '.' || c == ',';
    let words = text.split(|c: char| !(c.is_ascii_digit() || is_mark(c))).map(|word| word.trim_matches(is_mark));
    words.filter(|word| !word.is_empty()).map(|word| word.replace(',', ".").parse().unwrap()).collect()
}

/// The lessons in each language.
fn lessons() -> [Vec<(&'static str, Lesson)>; 3] {
    let read = Language::ALL.map(|language| {
        speak(language, built_in(language).unwrap());
        let lesson = |(name, _, text): (&'static str, Key, Key)| (name, Lesson::read(text.say().as_bytes()).unwrap());
        LESSONS.into_iter().map(lesson).collect()
    });
    speak(Language::English, &[]);
    read
}

#[test]
fn each_claim_is_said_in_all_languages_and_each_number_is_a_setting_or_part_of_one() {
    for (language, lessons) in lessons().iter().enumerate() {
        for (name, lesson) in lessons {
            for (i, step) in lesson.steps.iter().enumerate() {
                let all = words(step);
                let mut text = all.clone();
                for claim in CLAIMS.iter().filter(|claim| claim.at == (*name, i)) {
                    let said = claim.says[language];
                    assert!(all.contains(said), "{name}, step {i} does not say: {said}\n{all}");
                    text = text.replace(said, " ");
                }
                for name in ["step ", "Schritt ", "l'étape "] {
                    (1..=5).for_each(|number| text = text.replace(&format!("{name}{number}"), name));
                }
                let Settings { smoothing, target, decimation, .. } = step.settings.as_ref().unwrap();
                let reduction = target.percent(1000);
                let set = [smoothing.pass_band, f64::from(smoothing.iterations), reduction, decimation.feature_angle];
                let left: Vec<f64> = numbers(&text).into_iter().filter(|number| !set.contains(number)).collect();
                assert!(left.is_empty(), "{name}, step {i}: nothing computes {left:?} of: {text}");
            }
        }
    }
}

#[test]
fn what_the_lessons_claim_is_so() {
    let defaults = [Sample::Aorta, Sample::AortaNets].map(|sample| {
        let opened = Arc::new(generate(sample, sample.default_triangles()).unwrap());
        let mut default = Pipeline::new(opened, Settings::default()).with_certificate();
        default.finish().unwrap();
        default
    });
    let [cubes, nets] = &defaults;
    let [english, ..] = lessons();
    let mut wrong = Vec::new();
    for (name, lesson) in english {
        let mut default = cubes;
        for (i, step) in lesson.steps.into_iter().enumerate() {
            match step.sample {
                Some(Sample::AortaNets) => default = nets,
                Some(_) => default = cubes,
                None => {}
            }
            let seen = Seen { default, cubes, settings: step.settings.unwrap(), pipeline: OnceCell::new() };
            for claim in CLAIMS.iter().filter(|claim| claim.at == (name, i)) {
                let found = match claim.truth {
                    Holds(holds) => holds(&seen),
                    Is(number, within) => {
                        let number = number(&seen);
                        let is_near = |said: &&str| (numbers(said)[0] - number).abs() <= within;
                        if claim.says.iter().all(is_near) { Ok(()) } else { Err(number.to_string()) }
                    }
                };
                wrong.extend(found.err().map(|found| format!("{name}, step {i}: {}: {found}", claim.says[0])));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
