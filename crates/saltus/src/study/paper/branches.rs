//! Why is each transition of Fig. 2 where it is? The branches of periodic orbits behind the clouds.

use std::collections::BTreeMap;
use std::sync::Arc;

use saltus_hybrid as hybrid;
use saltus_orbits::{
    Along, BranchesOptions, ContinuationOptions, Family, Limb, NewtonOptions, Orbit, Place, Point,
    Special, SpecialKind, branches, find_orbit,
};

use super::{Effort, RATIOS, setup};
use crate::model::{Inertia, Model, ModelError, PreparedPlate};
use crate::physics::{ContactLaw, FrequencyReference, Plate};
use crate::study::{
    Control, Kind, Lineages, OrbitError, OrbitSearch, Search, Starts, StudyError, Sweep, follow,
    orbit_of, place, second_opinion, sequence, stroboscopic,
};

/// The scanned range of zeta_h.
const ALONG: Along = Along {
    parameter: 0,
    from: 0.1,
    to: 0.5,
};

/// Where the main branch of each panel is met: its long-term motion at high damping.
const START: f64 = 0.45;

/// Longest period of an attractor whose branch is followed from it.
const LONGEST: u32 = 8;

/// A largest multiplier nearer to 1 than this is on the unit circle.
const EDGE: f64 = 1e-6;

/// Two orbits are one if their places differ by less.
const SAME: f64 = 1e-6;

/// What is behind one panel of Fig. 2.
#[derive(Clone, Debug)]
pub struct PanelBranches {
    /// Omega/omega_h.
    pub ratio: f64,
    /// The branches with what happens on them.
    pub limbs: Vec<Drawn>,
    /// All their special points, by falling damping ratio.
    pub transitions: Vec<Transition>,
    /// Period doublings of the main cascade, by falling damping ratio, each with the period it doubles.
    pub cascade: Vec<(usize, f64)>,
    /// All attractors, matched along the damping ratio.
    pub attractors: Lineages,
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
    /// Why it ends, at both ends.
    pub ends: [String; 2],
}

/// A special point.
#[derive(Clone, Debug, PartialEq)]
pub struct Transition {
    /// Such as PD1.
    pub label: String,
    /// What happens.
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

/// The branches of all panels under the paper's law and the occupied reading.
///
/// # Errors
/// [`StudyError`] if there is no model of the paper's plate, or when stopped.
pub fn panel_branches(
    effort: &Effort,
    control: &Control,
) -> Result<Vec<PanelBranches>, StudyError> {
    let plate = PreparedPlate::new(&Plate::dias_del_prado())?;
    RATIOS
        .iter()
        .map(|&ratio| Panel::new(&plate, ratio, effort, control).branches())
        .collect()
}

impl PanelBranches {
    /// By how much the distances of successive doublings fall: Feigenbaum's number in the limit.
    pub fn cascade_ratios(&self) -> Vec<f64> {
        let triples = self.cascade.windows(3);
        triples
            .map(|w| (w[0].1 - w[1].1) / (w[1].1 - w[2].1))
            .collect()
    }
}

/// One panel under way.
struct Panel<'a> {
    plate: &'a Arc<PreparedPlate>,
    ratio: f64,
    effort: &'a Effort,
    control: &'a Control,
}

impl<'a> Panel<'a> {
    fn new(
        plate: &'a Arc<PreparedPlate>,
        ratio: f64,
        effort: &'a Effort,
        control: &'a Control,
    ) -> Self {
        Self {
            plate,
            ratio,
            effort,
            control,
        }
    }

    fn model_at(&self, zeta: f64) -> Result<Model, ModelError> {
        let law = ContactLaw::ReactionForce;
        let reference = FrequencyReference::Occupied;
        setup(zeta, self.ratio, reference, law, Inertia::Condensed).model_on(self.plate)
    }

    fn branches(&self) -> Result<PanelBranches, StudyError> {
        let like = self.model_at(START)?;
        let family = stroboscopic(&like, |p: &[f64]| self.model_at(p[0]), self.control);
        let attractors = self.attractors()?;
        let mut limbs: Vec<Limb> = Vec::new();
        let search = OrbitSearch {
            transient: 400,
            ..OrbitSearch::default()
        };
        let start = like.start(3.0, 2.0);
        let found = orbit_of(&family, &like, &[START], &start, &search, self.control);
        let main = self.or_stop(found)?;
        for orbit in main.into_iter().chain(self.others(&family, &attractors)?) {
            if !self.is_known(&family, &limbs, &orbit) {
                // Islands are small, and their cascades too.
                let doublings = match limbs.is_empty() {
                    true => self.effort.doublings,
                    false => self.effort.doublings.min(1),
                };
                let more = self.follow(&family, &orbit, doublings)?;
                limbs.extend(renumbered(more, &limbs));
            }
        }
        let cascade = self.cascade(&family, &limbs)?;
        Ok(PanelBranches {
            ratio: self.ratio,
            transitions: self.transitions(&family, &limbs)?,
            limbs: limbs
                .iter()
                .map(|limb| self.drawn(limb))
                .collect::<Result<_, _>>()?,
            cascade,
            attractors,
        })
    }

    /// An orbit that is not found is no error, a stop is.
    fn or_stop<T>(&self, found: Result<T, OrbitError>) -> Result<Option<T>, StudyError> {
        match found {
            Ok(orbit) => Ok(Some(orbit)),
            Err(OrbitError::Study(error)) => Err(error),
            Err(error) if error.is_interrupt() => {
                Err(saltus_hybrid::IntegrateError::Interrupted.into())
            }
            Err(_) => Ok(None),
        }
    }

    fn stopped(&self) -> Result<(), StudyError> {
        match self.control.stop.load(std::sync::atomic::Ordering::Relaxed) {
            true => Err(saltus_hybrid::IntegrateError::Interrupted.into()),
            false => Ok(()),
        }
    }

    fn attractors(&self) -> Result<Lineages, StudyError> {
        let values = Sweep::linspace(ALONG.from, ALONG.to, self.effort.census_values);
        let starts = Starts {
            count: self.effort.census_starts,
            z: [-2.0, 6.0],
            v: [-4.0, 4.0],
            plate: 0.0,
        };
        let model_at = |zeta: f64| self.model_at(zeta);
        follow(&values, model_at, &starts, &Search::default(), self.control)
    }

    /// Orbits of all attractors, one for each period that each of them shows: cascades, windows and islands.
    fn others<F>(&self, family: &F, attractors: &Lineages) -> Result<Vec<Orbit>, StudyError>
    where
        F: Family,
    {
        let rows = attractors.rows.iter();
        let rows = rows.filter_map(|row| Some((row.value, row.census.as_ref().ok()?)));
        let all =
            rows.flat_map(|(zeta, census)| census.attractors.iter().map(move |one| (zeta, one)));
        let mut seen: BTreeMap<(usize, u32), (f64, &hybrid::Point)> = BTreeMap::new();
        for (zeta, one) in all {
            if let Kind::Periodic(n) = one.entry.attractor.kind
                && n <= LONGEST
            {
                seen.entry((one.identity, n))
                    .or_insert((zeta, &one.arrival.point));
            }
        }
        let mut out = Vec::new();
        for ((_, period), (zeta, point)) in seen {
            let model = self.model_at(zeta)?;
            let run = saltus_hybrid::record(
                &saltus_hybrid::Leg {
                    system: model.system().clone(),
                    start: point.clone(),
                    periods: period.into(),
                },
                &self.control.options,
            )?;
            let places: Vec<Place> = run
                .samples
                .iter()
                .map(|point| place(&model, point))
                .collect();
            out.extend(find_orbit(
                family,
                &[zeta],
                &places,
                &NewtonOptions::default(),
            ));
            self.stopped()?;
        }
        Ok(out)
    }

    /// Whether an orbit lies on one of the branches: the orbit of that branch at its damping ratio is the same.
    fn is_known<F: Family>(&self, family: &F, limbs: &[Limb], orbit: &Orbit) -> bool {
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

    fn follow<F: Family>(
        &self,
        family: &F,
        orbit: &Orbit,
        doublings: usize,
    ) -> Result<Vec<Limb>, StudyError> {
        let options = BranchesOptions {
            doublings,
            continuation: ContinuationOptions {
                points: 600,
                ..ContinuationOptions::default()
            },
            ..BranchesOptions::default()
        };
        let mut go_on = |_: &Point| self.stopped().is_ok();
        let limbs = branches(family, orbit, &ALONG, &options, &mut go_on);
        self.stopped()?;
        Ok(limbs.unwrap_or_default())
    }

    /// Period doublings in a row from the one at the highest damping on: each is sought from a stable orbit of the
    /// branch that the one before has given birth to, over a range that gets shorter as the cascade does.
    fn cascade<F: Family>(
        &self,
        family: &F,
        limbs: &[Limb],
    ) -> Result<Vec<(usize, f64)>, StudyError> {
        let doubles = |special: &&Special| {
            special.kind == SpecialKind::PeriodDoubling && special.outside.contains(&0)
        };
        let specials = limbs.iter().flat_map(|limb| limb.branch.specials.iter());
        let mut chain: Vec<(usize, f64)> = Vec::new();
        let mut doublings: Vec<&Special> = specials.filter(doubles).collect();
        doublings.sort_by(|a, b| b.parameter.total_cmp(&a.parameter));
        for special in doublings {
            let period = special.orbit.period();
            if chain.last().is_none_or(|(last, _)| 2 * last == period) {
                chain.push((period, special.parameter));
            }
        }
        while let [.., (_, before), (period, last)] = chain[..]
            && period < self.effort.cascade_period
        {
            self.stopped()?;
            let gap = before - last;
            let Some(next) = self.next_doubling(family, limbs, period, last, gap) else {
                break;
            };
            chain.push((2 * period, next));
        }
        Ok(chain)
    }

    /// The doubling after the one of `period` at `last`, which came `gap` after the one before.
    fn next_doubling<F: Family>(
        &self,
        family: &F,
        limbs: &[Limb],
        period: usize,
        last: f64,
        gap: f64,
    ) -> Option<f64> {
        let specials = limbs.iter().flat_map(|limb| limb.branch.specials.iter());
        let near = |s: &&Special| (s.parameter - last).abs() < 1e-9 && s.orbit.period() == period;
        let at = specials
            .clone()
            .find(near)
            .map(|special| special.orbit.clone());
        let above = last + 0.02 * gap;
        let seed = match at {
            Some(orbit) => orbit,
            None => self.stable_cycle(family, 2 * period, last - 0.05 * gap)?,
        };
        // The mother of the next doubling, followed from just above its birth or from within its stable stretch.
        let along = Along {
            parameter: 0,
            from: last - 0.5 * gap,
            to: above,
        };
        let options = BranchesOptions {
            doublings: 1,
            crossings: false,
            branches: 2,
            continuation: ContinuationOptions {
                points: 60,
                ..ContinuationOptions::default()
            },
        };
        let start = find_orbit(
            family,
            &[seed.parameters[0]],
            &seed.places,
            &NewtonOptions::default(),
        );
        // No further than past the doubling of the doubled branch.
        let (mut settled, mut past) = (false, false);
        let mut go_on = |point: &Point| {
            let doubled = point.orbit.period() == 2 * period;
            past |= doubled && settled && !point.stable;
            settled |= doubled && point.stable;
            !past && self.stopped().is_ok()
        };
        let limbs = branches(family, &start.ok()?, &along, &options, &mut go_on);
        let limbs = limbs.ok()?;
        let found = limbs.iter().flat_map(|limb| limb.branch.specials.iter());
        let mut next: Vec<f64> = found
            .filter(|s| s.kind == SpecialKind::PeriodDoubling && s.orbit.period() == 2 * period)
            .map(|s| s.parameter)
            .collect();
        next.sort_by(|a, b| b.total_cmp(a));
        next.first().copied()
    }

    /// The stable cycle of this period that the long-term motion at a damping ratio settles on.
    fn stable_cycle<F: Family>(&self, family: &F, period: usize, zeta: f64) -> Option<Orbit> {
        let model = self.model_at(zeta).ok()?;
        let run = saltus_hybrid::record(
            &saltus_hybrid::Leg {
                system: model.system().clone(),
                start: model.start(3.0, 2.0),
                periods: 3000 + period as u64,
            },
            &self.control.options,
        );
        let samples = run.ok()?.samples;
        let last = &samples[samples.len() - period..];
        let places: Vec<Place> = last.iter().map(|point| place(&model, point)).collect();
        let orbit = find_orbit(family, &[zeta], &places, &NewtonOptions::default()).ok()?;
        (orbit.period() == period).then_some(orbit)
    }

    fn transitions<F: Family>(
        &self,
        family: &F,
        limbs: &[Limb],
    ) -> Result<Vec<Transition>, StudyError> {
        let mut out = Vec::new();
        let all = limbs.iter().map(|limb| &limb.branch);
        let all =
            all.flat_map(|branch| branch.specials.iter().map(move |special| (branch, special)));
        for (branch, special) in all {
            self.stopped()?;
            let model = self.model_at(special.parameter)?;
            out.push(Transition {
                label: special.label.clone(),
                kind: special.kind.clone(),
                damping_ratio: special.parameter,
                second: second_opinion(family, branch, special, 0, ALONG.to - ALONG.from),
                period: special.orbit.period(),
                seen: special.outside.contains(&0),
                sequence: sequence(&model, &special.orbit),
                heights: heights(&model, &special.orbit),
            });
        }
        out.sort_by(|a, b| b.damping_ratio.total_cmp(&a.damping_ratio));
        Ok(out)
    }

    fn drawn(&self, limb: &Limb) -> Result<Drawn, StudyError> {
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

/// New branches with labels that go on from those of the known ones.
fn renumbered(mut limbs: Vec<Limb>, known: &[Limb]) -> Vec<Limb> {
    let specials = |limbs: &[Limb], short: &str| {
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

/// Whether two orbits are one, begun at any place.
fn same(a: &Orbit, b: &Orbit) -> bool {
    let n = a.period();
    let apart = |a: &Place, b: &Place| {
        let pairs = a.x.iter().zip(&b.x);
        pairs.fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()))
    };
    let shifted =
        |shift: usize| (0..n).all(|i| apart(&a.places[i], &b.places[(i + shift) % n]) < SAME);
    n == b.period() && (0..n).any(shifted)
}
