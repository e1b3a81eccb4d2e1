//! The branches of periodic orbits behind the clouds of Fig. 2: they say why each transition is where it is.

use std::sync::Arc;

use saltus::hybrid::{Point as State, Segment, record};
use saltus::model::{Inertia, Model, ModelError, PreparedPlate};
use saltus::orbits::{
    BranchWithOrigin, BranchesOptions, ContinuationOptions, MapPoint, MotionKind, NewtonOptions,
    Orbit, ParameterRange, ParametricMap, Point, SpecialKind, branches, find_orbit,
};
use saltus::physics::{ContactLaw, FrequencyReference, Plate};
use saltus::study::{
    Bodies, ContinuedAttractors, Control, OrbitError, OrbitSearch, Search, Starts, StudyError,
    follow, linspace, orbit_of, place, recurrence, second_opinion, sequence, settle, stroboscopic,
};

use crate::diagrams::{Diagram, Met, REPEATS};
use crate::effort::Effort;
use crate::setting::setup;
use crate::stretches::{Stretch, collect};

/// The scanned range of zeta_h.
const ALONG: ParameterRange = ParameterRange {
    parameter: 0,
    from: 0.1,
    to: 0.5,
};

/// Damping ratio at which the main branch of each panel is met: the long-term motion at high damping.
const START: f64 = 0.45;

/// Points with unstable orbits that end a branch which is followed for its stable part.
const BEYOND: usize = 1;

/// Under the other laws and the other reading, where only long stretches are reported: longest period of a cycle whose
/// doubling is sought, and of a motion whose cycle is.
const OTHERS: [usize; 2] = [8, 16];

/// Doublings in a row: more than the longest period allows.
const DOUBLINGS: usize = 16;

/// Distance of two doublings at which a cascade is followed no further: by Feigenbaum's ratio, 4.669, the next one is
/// below 1e-6.
const CLOSEST: f64 = 4.67e-6;

/// Longest period looked for in a motion that does not seem to repeat.
const RECORD: u64 = 128;

/// A motion beside a period doubling is nearer to the doubling orbit than is seen as long as the multiplier of that is
/// above minus this.
const DOUBLED: f64 = 1.05;

/// A largest multiplier nearer to 1 than this is on the unit circle.
const EDGE: f64 = 1e-6;

/// Two orbits are one if their places differ by less.
const SAME: f64 = 1e-6;

/// Two special points of one kind and period are one, seen from two branches, if they differ by less in zeta_h and in
/// z/eta.
const TWICE: [f64; 2] = [1e-8, 1e-3];

/// Branches behind one panel of Fig. 2, under one contact law and one reading of omega_h.
#[derive(Clone, Debug)]
pub struct PanelBranches {
    /// The contact law.
    pub law: ContactLaw,
    /// Meaning of omega_h.
    pub reference: FrequencyReference,
    /// Omega/omega_h.
    pub ratio: f64,
    /// Stretches with a stable cycle, by falling damping ratio of the upper end.
    pub stretches: Vec<Stretch>,
    /// More of the paper's own law and the occupied reading.
    pub detail: Option<Detail>,
}

/// More of what is behind one of the paper's panels than the stable cycles.
#[derive(Clone, Debug)]
pub struct Detail {
    /// The branches, unstable parts too.
    pub limbs: Vec<Drawn>,
    /// All their special points, by falling damping ratio.
    pub transitions: Vec<Transition>,
    /// All attractors, matched along the damping ratio.
    pub attractors: ContinuedAttractors,
}

/// A branch as it is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Drawn {
    /// Forcing periods of its orbits.
    pub period: usize,
    /// Label of the special point it comes from.
    pub origin: Option<String>,
    /// zeta_h, point by point.
    pub damping_ratio: Vec<f64>,
    /// Whether each point is stable; special points count as such, so that they end the stable part.
    pub stable: Vec<bool>,
    /// z/eta of the body: `heights[place][point]`.
    pub heights: Vec<Vec<f64>>,
    /// Reason why it ends, at both ends.
    pub ends: [String; 2],
}

/// A special point.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// Label, such as PD1.
    pub label: String,
    /// Kind of the point.
    pub kind: SpecialKind,
    /// zeta_h by continuation.
    pub damping_ratio: f64,
    /// zeta_h by the second method (`second_opinion`), where it finds the point.
    pub second: Option<f64>,
    /// Forcing periods of the orbit.
    pub period: usize,
    /// Whether the branch is stable on one side at least: only then does a sweep see it.
    pub seen: bool,
    /// Order of the switches.
    pub sequence: String,
    /// z/eta of each place.
    pub heights: Vec<f64>,
}

/// The branches of the panels of `diagrams`, all with their stable cycles. The motions of the sweeps are held against
/// those; one that is on none of them leads to the next branch.
///
/// # Errors
/// [`StudyError`] if there is no model of the paper's plate, or when stopped.
pub fn panel_branches(
    diagrams: &[Diagram],
    effort: &Effort,
    control: &Control,
) -> Result<Vec<PanelBranches>, StudyError> {
    let plate = PreparedPlate::new(&Plate::dias_del_prado())?;
    let panel = |diagram| Panel {
        plate: &plate,
        diagram,
        effort,
        control,
    };
    diagrams
        .iter()
        .map(|diagram| panel(diagram).branches())
        .collect()
}

/// One panel under way.
struct Panel<'a> {
    plate: &'a Arc<PreparedPlate>,
    diagram: &'a Diagram,
    effort: &'a Effort,
    control: &'a Control,
}

/// Knowledge of a panel.
#[derive(Default)]
struct Known {
    limbs: Vec<BranchWithOrigin>,
    stretches: Vec<Stretch>,
}

/// A motion that may be on a cycle.
struct Seed {
    zeta: f64,
    period: usize,
    state: State,
    /// Its section: z/eta and z'/(eta omega_h).
    z: Vec<f64>,
    v: Vec<f64>,
}

impl Panel<'_> {
    fn model_at(&self, zeta: f64) -> Result<Model, ModelError> {
        let Diagram {
            law,
            reference,
            ratio,
            ..
        } = *self.diagram;
        setup(zeta, ratio, reference, law, Inertia::Condensed).model_on(self.plate)
    }

    /// Whether it is one of the paper's own, which are looked at more closely.
    fn is_papers(&self) -> bool {
        self.diagram.law == ContactLaw::ReactionForce
            && self.diagram.reference == FrequencyReference::Occupied
    }

    fn branches(&self) -> Result<PanelBranches, StudyError> {
        let like = self.model_at(START)?;
        let family = stroboscopic(&like, |p: &[f64]| self.model_at(p[0]), self.control);
        let mut known = Known::default();
        let search = OrbitSearch {
            transient: 400,
            ..OrbitSearch::default()
        };
        let start = like.start(3.0, 2.0);
        let main = orbit_of(&family, &like, &[START], &start, &search, self.control);
        if let Some(orbit) = self.or_stop(main)? {
            self.grow(&family, &orbit, &mut known)?;
        }
        self.explain(&family, self.repeating(), &mut known)?;
        let mut detail = None;
        if self.is_papers() {
            self.explain(&family, self.patient(&known.stretches)?, &mut known)?;
            let attractors = self.attractors()?;
            self.explain(&family, of_census(&attractors), &mut known)?;
            let drawn = known.limbs.iter().map(|limb| self.drawn(limb));
            detail = Some(Detail {
                limbs: drawn.collect::<Result<_, _>>()?,
                transitions: self.transitions(&family, &known.limbs)?,
                attractors,
            });
        }
        let top = |stretch: &Stretch| stretch.to.damping_ratio;
        known.stretches.sort_by(|a, b| top(b).total_cmp(&top(a)));
        Ok(PanelBranches {
            law: self.diagram.law,
            reference: self.diagram.reference,
            ratio: self.diagram.ratio,
            stretches: known.stretches,
            detail,
        })
    }

    /// Motions of the sweeps that repeat, short periods first: their cycles give birth to the others.
    fn repeating(&self) -> Vec<Seed> {
        let rows = self.diagram.rows.iter();
        let seeds = rows.filter_map(|row| match Diagram::met(row, &[]) {
            Met::Slow(period) => Some(Seed {
                zeta: row.value,
                period,
                state: row.end.clone()?,
                z: row.z().first()?.clone(),
                v: row.v().first()?.clone(),
            }),
            _ => None,
        });
        let mut seeds: Vec<Seed> = seeds.collect();
        seeds.sort_by_key(|seed| seed.period);
        seeds
    }

    /// Motions of the rising and the falling sweep that do not repeat, but do after many more periods: chaos that
    /// was a transient hides narrow windows.
    fn patient(&self, stretches: &[Stretch]) -> Result<Vec<Seed>, StudyError> {
        let rows = self.diagram.rows.iter().filter(|row| row.pass < 2);
        let other = rows.filter(|row| Diagram::met(row, stretches) == Met::Other);
        let ended = other.filter_map(|row| Some((row.value, row.end.clone()?)));
        let (zetas, ends): (Vec<f64>, Vec<State>) = ended.unzip();
        let starts = zetas.iter().zip(ends);
        let starts = starts.map(|(&zeta, end)| Ok((self.model_at(zeta)?, end)));
        let starts: Vec<_> = starts.collect::<Result<_, ModelError>>()?;
        let settled = settle(&starts, self.effort.patience, RECORD, self.control)?;
        let seeds = zetas.into_iter().zip(settled).filter_map(|(zeta, motion)| {
            let period = recurrence(&motion.z()[0], &motion.v()[0], REPEATS)? as usize;
            Some(Seed {
                zeta,
                period,
                z: motion.z()[0].clone(),
                v: motion.v()[0].clone(),
                state: motion.end,
            })
        });
        let mut seeds: Vec<Seed> = seeds.collect();
        seeds.sort_by_key(|seed| seed.period);
        Ok(seeds)
    }

    /// Follows the cycles of motions that are on none of the known ones.
    fn explain<F: ParametricMap>(
        &self,
        family: &F,
        seeds: Vec<Seed>,
        known: &mut Known,
    ) -> Result<(), StudyError> {
        let mut failed: Option<(usize, f64)> = None;
        for seed in seeds {
            self.stopped()?;
            let on = |one: &Stretch| one.holds(seed.zeta, &seed.z, &seed.v);
            // Slow motions beside a bifurcation come in rows, and the first says what there is to say.
            let beside = |(period, zeta): (usize, f64)| {
                period == seed.period && (zeta - seed.zeta).abs() <= 1.5 * self.step()
            };
            let too_long = !self.is_papers() && seed.period > OTHERS[1];
            if too_long || known.stretches.iter().any(on) || failed.is_some_and(beside) {
                continue;
            }
            match self.cycle(family, &seed)? {
                Some(orbit) if !self.is_known(family, &known.limbs, &orbit) => {
                    self.grow(family, &orbit, known)?;
                }
                _ => failed = Some((seed.period, seed.zeta)),
            }
        }
        Ok(())
    }

    /// Distance of two damping ratios of the diagram.
    fn step(&self) -> f64 {
        let mut values = self.diagram.pass(0).map(|row| row.value);
        match (values.next(), values.next()) {
            (Some(a), Some(b)) => b - a,
            _ => ALONG.to - ALONG.from,
        }
    }

    /// The stable cycle near a motion, or the one that has just doubled into it. Beside a fold a motion that is nearly there
    /// may still be too far for Newton's method.
    fn cycle<F: ParametricMap>(
        &self,
        family: &F,
        seed: &Seed,
    ) -> Result<Option<Orbit>, StudyError> {
        let model = self.model_at(seed.zeta)?;
        let (period, patience) = (seed.period as u64, self.effort.patience);
        let mut start = seed.state.clone();
        for wait in [0, patience] {
            let run = |start, periods| {
                let system = model.system().clone();
                let segment = Segment {
                    system,
                    start,
                    periods,
                };
                record(&segment, &self.control.options)
            };
            if wait > 0 {
                start = run(start, wait.next_multiple_of(period))?.end.point;
            }
            let samples = run(start.clone(), period)?.samples;
            let places: Vec<MapPoint> = samples.iter().map(|at| place(&model, at)).collect();
            let orbit = find_orbit(family, &[seed.zeta], &places, &NewtonOptions::default());
            let met = |orbit: &Orbit| orbit.stable() || doubles_beside(orbit);
            if let Some(orbit) = orbit.ok().filter(met) {
                return Ok(Some(orbit));
            }
        }
        Ok(None)
    }

    /// Adds the branch of an orbit, with those that grow from it.
    fn grow<F: ParametricMap>(
        &self,
        family: &F,
        orbit: &Orbit,
        known: &mut Known,
    ) -> Result<(), StudyError> {
        let (papers, main) = (self.is_papers(), known.limbs.is_empty());
        // Islands are small, and their cascades too.
        let entire = match (papers, main) {
            (true, true) => Some(self.effort.doublings),
            (true, false) if orbit.period() <= self.effort.islands => {
                Some(self.effort.doublings.min(1))
            }
            _ => None,
        };
        let longest = self.effort.cascade_period;
        let options = BranchesOptions {
            doublings: DOUBLINGS,
            entire: entire.unwrap_or(0),
            longest: if papers {
                longest
            } else {
                longest.min(OTHERS[0])
            },
            closest: CLOSEST,
            branches: 100,
            continuation: ContinuationOptions {
                points: 600,
                unstable: entire.map_or(BEYOND, |_| usize::MAX),
                ..ContinuationOptions::default()
            },
            ..BranchesOptions::default()
        };
        let mut go_on = |_: &Point| self.stopped().is_ok();
        let limbs = branches(family, orbit, &ALONG, &options, &mut go_on);
        self.stopped()?;
        let first = known.limbs.len();
        for limb in renumbered(limbs.unwrap_or_default(), &known.limbs) {
            if self.leads_further(family, &known.limbs[..first], &limb) {
                known.limbs.push(limb);
            }
        }
        let section = |orbit: &Orbit| {
            let model = self.model_at(orbit.parameters[0])?;
            let place = |place: &MapPoint| [model.z(0, &place.x), model.v(0, &place.x)];
            Ok::<_, StudyError>(orbit.places.iter().map(place).collect())
        };
        collect(&known.limbs, first, section, &mut known.stretches)
    }

    /// An orbit that is not found is no error, a stop is.
    fn or_stop<T>(&self, found: Result<T, OrbitError>) -> Result<Option<T>, StudyError> {
        match found {
            Ok(orbit) => Ok(Some(orbit)),
            Err(OrbitError::Study(error)) => Err(error),
            Err(error) if error.is_interrupt() => {
                Err(saltus::hybrid::IntegrateError::Interrupted.into())
            }
            Err(_) => Ok(None),
        }
    }

    fn stopped(&self) -> Result<(), StudyError> {
        match self.control.stop.load(std::sync::atomic::Ordering::Relaxed) {
            true => Err(saltus::hybrid::IntegrateError::Interrupted.into()),
            false => Ok(()),
        }
    }

    fn attractors(&self) -> Result<ContinuedAttractors, StudyError> {
        let values = linspace(ALONG.from, ALONG.to, self.effort.census_values);
        let starts = Starts {
            count: self.effort.census_starts,
            z: [-2.0, 6.0],
            v: [-4.0, 4.0],
            plate: 0.0,
        };
        let model_at = |zeta: f64| self.model_at(zeta);
        follow(&values, model_at, &starts, &Search::default(), self.control)
    }

    /// Whether a branch is not, or not as far, among those known: one from a period halving on may be that of an earlier
    /// motion.
    fn leads_further<F: ParametricMap>(
        &self,
        family: &F,
        known: &[BranchWithOrigin],
        limb: &BranchWithOrigin,
    ) -> bool {
        let points = &limb.branch.points;
        let stable = || points.iter().filter(|point| point.stable);
        let middle = points.get(points.len() / 2);
        let some = middle.into_iter().chain(stable().next());
        let mut some = some.chain(stable().next_back());
        some.any(|point| !self.is_known(family, known, &point.orbit))
    }

    /// Whether an orbit lies on one of the branches: the orbit of that branch at its damping ratio is the same.
    fn is_known<F: ParametricMap>(
        &self,
        family: &F,
        limbs: &[BranchWithOrigin],
        orbit: &Orbit,
    ) -> bool {
        let zeta = orbit.parameters[0];
        let near = |pair: &&[Point]| {
            let [a, b] = [&pair[0], &pair[1]].map(|point| point.parameter);
            (a.min(b)..=a.max(b)).contains(&zeta) && pair[0].orbit.period() == orbit.period()
        };
        let points = limbs.iter().flat_map(|limb| limb.branch.points.windows(2));
        points.filter(near).any(|pair| {
            let places = &pair[0].orbit.places;
            let there = find_orbit(family, &[zeta], places, &NewtonOptions::default());
            there.is_ok_and(|there| same(&there, orbit))
        })
    }

    fn transitions<F: ParametricMap>(
        &self,
        family: &F,
        limbs: &[BranchWithOrigin],
    ) -> Result<Vec<Transition>, StudyError> {
        let mut out: Vec<Transition> = Vec::new();
        let all = limbs.iter().map(|limb| &limb.branch);
        let all =
            all.flat_map(|branch| branch.specials.iter().map(move |special| (branch, special)));
        for (branch, special) in all {
            self.stopped()?;
            let model = self.model_at(special.parameter)?;
            let heights = heights(&model, &special.orbit);
            let again = |other: &Transition| {
                let apart = |a: &f64| {
                    heights
                        .iter()
                        .map(|b| (a - b).abs())
                        .fold(f64::INFINITY, f64::min)
                };
                other.kind.short() == special.kind.short()
                    && other.period == special.orbit.period()
                    && (other.damping_ratio - special.parameter).abs() < TWICE[0]
                    && other.heights.iter().all(|z| apart(z) < TWICE[1])
            };
            if out.iter().any(again) {
                continue;
            }
            out.push(Transition {
                label: special.label.clone(),
                kind: special.kind.clone(),
                damping_ratio: special.parameter,
                second: second_opinion(family, branch, special, 0, ALONG.to - ALONG.from),
                period: special.orbit.period(),
                seen: special.outside.contains(&0),
                sequence: sequence(&model, &special.orbit),
                heights,
            });
        }
        out.sort_by(|a, b| b.damping_ratio.total_cmp(&a.damping_ratio));
        Ok(out)
    }

    fn drawn(&self, limb: &BranchWithOrigin) -> Result<Drawn, StudyError> {
        let points = &limb.branch.points;
        let period = points.first().map_or(0, |point| point.orbit.period());
        let mut out = Drawn {
            period,
            origin: limb.origin.clone(),
            damping_ratio: Vec::new(),
            stable: Vec::new(),
            heights: vec![Vec::new(); period],
            ends: limb.branch.ends.clone().map(|end| end.to_string()),
        };
        let mut put = |zeta: f64, stable: bool, orbit: &Orbit| {
            let model = self.model_at(zeta)?;
            out.damping_ratio.push(zeta);
            out.stable.push(stable);
            let here = heights(&model, orbit);
            out.heights
                .iter_mut()
                .zip(here)
                .for_each(|(line, z)| line.push(z));
            Ok::<(), StudyError>(())
        };
        let mut specials = limb.branch.specials.iter().peekable();
        for (index, point) in points.iter().enumerate() {
            // At the birth of a branch a multiplier is 1, and which side of the circle it is on is chance.
            let largest = point.orbit.multipliers.first().map_or(0.0, |m| m.modulus());
            put(point.parameter, largest < 1.0 + EDGE, &point.orbit)?;
            while let Some(special) = specials.next_if(|special| special.near == index) {
                put(special.parameter, true, &special.orbit)?;
            }
        }
        Ok(out)
    }
}

/// A motion on each cycle of a census.
fn of_census(attractors: &ContinuedAttractors) -> Vec<Seed> {
    let rows = attractors.rows.iter();
    let rows = rows.filter_map(|row| Some((row.value, row.census.as_ref().ok()?)));
    let all = rows.flat_map(|(zeta, census)| census.attractors.iter().map(move |one| (zeta, one)));
    let seeds = all.filter_map(|(zeta, one)| {
        let MotionKind::Periodic(period) = one.entry.attractor.kind else {
            return None;
        };
        Some(Seed {
            zeta,
            period: period as usize,
            state: one.arrival.point.clone(),
            z: one.arrival.z().first()?.clone(),
            v: one.arrival.v().first()?.clone(),
        })
    });
    let mut seeds: Vec<Seed> = seeds.collect();
    seeds.sort_by_key(|seed| seed.period);
    seeds
}

/// New branches with labels that go on from those of the known ones.
fn renumbered(
    mut limbs: Vec<BranchWithOrigin>,
    known: &[BranchWithOrigin],
) -> Vec<BranchWithOrigin> {
    let specials = |limbs: &[BranchWithOrigin], short: &str| {
        let all = limbs.iter().flat_map(|limb| &limb.branch.specials);
        all.filter(|special| special.kind.short() == short).count()
    };
    let later = |label: &str| {
        let digits = label.trim_start_matches(char::is_alphabetic);
        let short = &label[..label.len() - digits.len()];
        let number: usize = digits.parse().unwrap_or(0);
        format!("{short}{}", number + specials(known, short))
    };
    for limb in &mut limbs {
        limb.origin = limb.origin.as_deref().map(later);
        for special in &mut limb.branch.specials {
            special.label = later(&special.label);
        }
    }
    limbs
}

/// z/eta of the body at each place.
fn heights(model: &Model, orbit: &Orbit) -> Vec<f64> {
    orbit
        .places
        .iter()
        .map(|place| model.z(0, &place.x))
        .collect()
}

/// Whether an orbit is a little beyond its period doubling, where the doubled one is hard to tell from it.
fn doubles_beside(orbit: &Orbit) -> bool {
    let first = orbit.multipliers.first();
    let beyond = first.is_some_and(|m| m.im == 0.0 && (-DOUBLED..=-1.0).contains(&m.re));
    beyond && orbit.outside() <= 1
}

/// Whether two orbits are one, begun at any place.
fn same(a: &Orbit, b: &Orbit) -> bool {
    let n = a.period();
    let apart = |a: &MapPoint, b: &MapPoint| {
        let pairs = a.x.iter().zip(&b.x);
        pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    };
    let shifted =
        |shift: usize| (0..n).all(|i| apart(&a.places[i], &b.places[(i + shift) % n]) < SAME);
    n == b.period() && (0..n).any(shifted)
}
