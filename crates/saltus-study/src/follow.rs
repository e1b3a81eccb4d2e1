//! All attractors along a parameter, each with a number that stays.
//!
//! At each value, starts from a box find what they find. Then each attractor is carried to both neighbours: its
//! state is a start there. What is new there is carried on in its turn, until nothing new is met. So an
//! attractor that a start met at one value is looked for at all values up to where it ends, and those that are
//! the same are known by the dynamics and not by their looks: "seeded continuation" [DRW 2023].
//!
//! Each attractor needs evidence that it is one before it is carried. A cycle must be one that Newton's method finds,
//! with all Floquet multipliers inside the unit circle; one that is not is run on, and becomes what it leads to or
//! counts for nothing. Chaos is watched: eight motions on it for 12 000 periods each. If any of them ends on a cycle
//! it is a transient with a lifetime, and its starts count for what it ends on ([`Survival`]). A start or a carried
//! motion that is undecided, say at a period doubling, is run on likewise; a carried one that stays undecided goes to
//! the next value as it is.
//!
//! `matching` says when two attractors are the same, and `lineages` what follows.

use saltus_orbits::MotionKind;
use std::collections::BTreeMap;
use std::sync::atomic::Ordering;

use crate::census::{AttractorCensus, Row, Tally};
use crate::lineages::ContinuedAttractors;
use crate::matching::{Links, Node, Way};
use crate::subject::{Starts, Subject};
use crate::survival::Survival;
use crate::{Control, Found, Outcome, Search, StudyError, attractors};
use saltus_hybrid::{IntegrateError, Point};

/// The attractors of `model`, as the starts lead to them.
///
/// # Errors
/// [`StudyError::NoSection`] for a subject without channels, [`StudyError::Integrate`] for options out of range
/// or when stopped.
pub fn census<S: Subject>(
    model: &S,
    starts: &impl Starts<S>,
    search: &Search,
    control: &Control,
) -> Outcome<AttractorCensus<S::NoModel>, S> {
    let found = follow(&[0.0], |_| Ok(model.clone()), starts, search, control)?;
    let mut rows = found.rows.into_iter().map(|row| row.census);
    let census = rows
        .next()
        .unwrap_or_else(|| Ok(AttractorCensus::default()));
    census.map_err(StudyError::Model)
}

/// The attractors at each of `values` (ascending), matched from value to value.
///
/// A value without a model, or whose model the stepper cannot take, is a row that says so; motions are carried
/// across it. Results do not depend on the threads, to the bit.
///
/// # Errors
/// As [`census`].
pub fn follow<S, F>(
    values: &[f64],
    model_at: F,
    starts: &impl Starts<S>,
    search: &Search,
    control: &Control,
) -> Outcome<ContinuedAttractors<S::NoModel>, S>
where
    S: Subject,
    F: Fn(f64) -> Result<S, S::NoModel>,
{
    let mut places = Vec::with_capacity(values.len());
    for &value in values {
        // a large system takes a while to prepare
        if control.stop.load(Ordering::Relaxed) {
            return Err(IntegrateError::Interrupted.into());
        }
        let stable = |model: S| model.check(&control.options).map(|()| model);
        let model = model_at(value).and_then(stable);
        if model.as_ref().is_ok_and(|m| m.channels() == 0) {
            return Err(StudyError::NoSection);
        }
        let tally = Tally::default();
        places.push(Place {
            value,
            model,
            tally,
        });
    }
    let mut journey = Journey {
        places,
        became: BTreeMap::new(),
        links: Links::new(),
        unwatched: Vec::new(),
        search,
        control,
    };
    journey.count(starts)?;
    let unfinished = journey.carry_all()?;
    Ok(journey.lineages(unfinished))
}

/// Searches, one after the other, by which an attractor is confirmed and an undecided motion given up.
const PATIENCE: usize = 8;

/// Motions that are watched in chaos, as many as run at the cost of one, and forcing periods of each.
const WATCHED: usize = 8;
const WATCH: u64 = 12_000;

/// Distance at which they start in the initial condition, in the units of the model: nothing beside the chaos, and forgotten
/// after some hundred periods of it.
const APART: f64 = 1e-6;

/// One value.
struct Place<S: Subject> {
    value: f64,
    model: Result<S, S::NoModel>,
    tally: Tally<S::NoModel>,
}

struct Journey<'a, S: Subject> {
    places: Vec<Place<S>>,
    /// Ends of transients that looked like attractors; without cycles.
    became: BTreeMap<Node, Node>,
    links: Links,
    /// Chaos that is to be watched.
    unwatched: Vec<Node>,
    search: &'a Search,
    control: &'a Control,
}

/// A motion to be run at a value.
#[derive(Clone)]
struct Errand {
    /// The attractor it was on.
    from: Node,
    /// `None` for one that is to be confirmed in place.
    way: Option<Way>,
    /// Its last state, the value at which it was there, and the value at which to go on.
    point: Point,
    at: usize,
    to: usize,
    /// Searches at that value so far.
    tries: usize,
}

impl<S: Subject> Journey<'_, S> {
    /// Runs all starts at all values, those that stay undecided with patience.
    fn count(&mut self, starts: &impl Starts<S>) -> Outcome<(), S> {
        let at: Vec<usize> = (0..self.places.len())
            .filter(|&at| self.places[at].model.is_ok())
            .collect();
        let model_of = |number: usize| self.places[at[number / starts.count()]].model.clone();
        let start_at = |number: usize| {
            let model = model_of(number)?;
            let point = starts.point(&model, number % starts.count());
            Ok((model, point))
        };
        let search = Search {
            watch: 0,
            ..*self.search
        };
        let mut found = self.run(&search, at.len() * starts.count(), start_at)?;
        for _ in 1..PATIENCE {
            let points = found.iter().enumerate();
            let open: Vec<(usize, Point)> = points
                .filter_map(|(number, found)| Some((number, found.undecided_at()?.clone())))
                .collect();
            let go_on = |i: usize| Ok((model_of(open[i].0)?, open[i].1.clone()));
            for (i, later) in self
                .run(&search, open.len(), go_on)?
                .into_iter()
                .enumerate()
            {
                found[open[i].0] = later;
            }
        }
        for (number, found) in found.into_iter().enumerate() {
            self.places[at[number / starts.count()]].tally.count(found);
        }
        Ok(())
    }

    /// Attractors that starts 0 to `count` - 1 lead to, in their order.
    fn run(
        &self,
        search: &Search,
        count: usize,
        start_at: impl Fn(usize) -> Result<(S, Point), S::NoModel> + Sync,
    ) -> Outcome<Vec<Found<S::NoModel>>, S> {
        let mut all: Vec<Option<Found<S::NoModel>>> = vec![None; count];
        let keep = |number: usize, found| {
            all[number] = Some(found);
            Ok::<(), StudyError<S::NoModel>>(())
        };
        attractors(0..count, start_at, search, self.control, keep)?;
        Ok(all.into_iter().flatten().collect())
    }

    /// Carries every attractor both ways and gives the number of motions that were still on their way after rounds
    /// enough for twice the length of the range; a model has few attractors, so it ends long before.
    fn carry_all(&mut self) -> Outcome<usize, S> {
        let known = |(at, place): (usize, &Place<S>)| {
            (0..place.tally.len()).map(move |number| (at, number))
        };
        let nodes: Vec<Node> = self.places.iter().enumerate().flat_map(known).collect();
        let mut errands: Vec<Errand> = Vec::new();
        for node in nodes {
            errands.extend(self.depart(node));
        }
        let search = Search {
            watch: 0,
            confirm: true,
            ..*self.search
        };
        for _ in 0..2 * PATIENCE * self.places.len() {
            errands.extend(self.watch()?);
            if errands.is_empty() {
                break;
            }
            let start_at = |number: usize| {
                let errand: &Errand = &errands[number];
                let there = self.places[errand.to].model.clone()?;
                let here = self.places[errand.at].model.clone()?;
                let point = there.carry(&here, &errand.point);
                Ok((there, point))
            };
            let found = self.run(&search, errands.len(), start_at)?;
            let ended = std::mem::take(&mut errands).into_iter().zip(found);
            for (errand, found) in ended {
                errands.extend(self.arrive(errand, found));
            }
        }
        Ok(errands.len() + self.unwatched.len())
    }

    /// Watches all chaos that was not watched yet, and gives what is to be done next.
    fn watch(&mut self) -> Outcome<Vec<Errand>, S> {
        let nodes = std::mem::take(&mut self.unwatched);
        let search = Search {
            transient: WATCH,
            record: 1,
            exponent: 0,
            confirm: true,
            ..*self.search
        };
        let start_at = |i: usize| {
            let (at, number) = nodes[i / WATCHED];
            let mut point = self.places[at].tally.point(number).clone();
            if let Some(x) = point.x.first_mut() {
                *x += APART * (i % WATCHED) as f64;
            }
            Ok((self.places[at].model.clone()?, point))
        };
        let found = self.run(&search, nodes.len() * WATCHED, start_at)?;
        let mut next = Vec::new();
        for (node, found) in nodes.into_iter().zip(found.chunks(WATCHED)) {
            next.extend(self.survive(node, found));
        }
        Ok(next)
    }

    /// Notes what became of the motions watched in the chaos at a node.
    fn survive(&mut self, node: Node, watched: &[Found<S::NoModel>]) -> Vec<Errand> {
        let (at, chaos) = node;
        let is_cycle = |found: &&Found<S::NoModel>| {
            let kind = found.attractor.as_ref().map(|motion| motion.kind);
            matches!(kind, Ok(MotionKind::Periodic(_)))
        };
        let ended: Vec<&Found<S::NoModel>> = watched.iter().filter(is_cycle).collect();
        let survival = Survival {
            motions: watched.len() as u32,
            ended: ended.len() as u32,
            periods: watched.iter().map(|found| found.periods).sum(),
        };
        self.places[at].tally.watched(chaos, survival);
        let mut next = Vec::new();
        let mut ends: BTreeMap<usize, usize> = BTreeMap::new();
        for found in ended {
            let known = self.places[at].tally.len();
            let Some(number) = self.places[at].tally.meet(found.clone()) else {
                continue;
            };
            *ends.entry(number).or_default() += 1;
            if number == known {
                next.extend(self.depart((at, number)));
            }
        }
        let most = ends
            .iter()
            .max_by_key(|(number, count)| (**count, usize::MAX - **number));
        match most {
            Some((&number, _)) => {
                self.became.insert(node, (at, number));
            }
            None => next.extend(self.both_ways(&self.errand(node))),
        }
        next
    }

    /// Errands for a new attractor: both ways, or first to see whether it is one.
    fn depart(&mut self, node: Node) -> Vec<Errand> {
        let tally = &self.places[node.0].tally;
        let errand = self.errand(node);
        match tally.kind(node.1) {
            _ if tally.is_proved(node.1) => self.both_ways(&errand),
            MotionKind::Chaotic | MotionKind::NotPeriodic => {
                self.unwatched.push(node);
                Vec::new()
            }
            _ => vec![errand],
        }
    }

    /// In place, from an attractor.
    fn errand(&self, node: Node) -> Errand {
        let (at, number) = node;
        Errand {
            from: node,
            way: None,
            point: self.places[at].tally.point(number).clone(),
            at,
            to: at,
            tries: 0,
        }
    }

    fn both_ways(&self, errand: &Errand) -> Vec<Errand> {
        let ways = [Way::Up, Way::Down].map(|way| Errand {
            way: Some(way),
            ..errand.clone()
        });
        ways.into_iter()
            .filter_map(|errand| self.further(errand))
            .collect()
    }

    /// To the next value with a model of the same make, if there is one.
    fn further(&self, errand: Errand) -> Option<Errand> {
        let at = errand.to;
        let here = self.places[at].model.as_ref().ok()?;
        let mut beyond = errand.way?.beyond(at, self.places.len());
        let to = beyond.find(|&to| {
            let there = self.places[to].model.as_ref();
            there.is_ok_and(|there| there.is_like(here))
        })?;
        Some(Errand {
            at,
            to,
            tries: 0,
            ..errand
        })
    }

    /// Notes where an errand has led, and what is to be done next.
    fn arrive(&mut self, mut errand: Errand, found: Found<S::NoModel>) -> Vec<Errand> {
        let tally = &mut self.places[errand.to].tally;
        let known = tally.len();
        let ended_early = found.arrival.is_none();
        if let Some(arrival) = &found.arrival {
            errand.point.clone_from(&arrival.point);
        }
        let number = tally.meet(found);
        errand.at = errand.to;
        errand.tries += 1;
        let node = number.map(|number| (errand.to, number));
        let mut next = match node {
            Some(node) if node.1 == known => self.depart(node),
            _ => Vec::new(),
        };
        let again = errand.tries < PATIENCE && !ended_early;
        match (errand.way, node) {
            (Some(way), Some(node)) => {
                self.links.insert((errand.from, way), node);
            }
            (Some(_), None) if again => next.push(errand),
            (Some(_), None) if ended_early => {}
            (Some(_), None) => next.extend(self.further(errand)),
            (None, Some(node)) if self.root(node) != errand.from => {
                self.became.insert(errand.from, node);
            }
            (None, _) if self.places[errand.at].tally.is_proved(errand.from.1) => {
                next.extend(self.both_ways(&errand));
            }
            (None, _) if again => next.push(errand),
            (None, _) => self.places[errand.at].tally.refute(errand.from.1),
        }
        next
    }

    /// The attractor behind one that may be a transient.
    fn root(&self, mut node: Node) -> Node {
        while let Some(&next) = self.became.get(&node) {
            node = next;
        }
        node
    }

    /// Everything in the order of the shares.
    fn lineages(mut self, unfinished: usize) -> ContinuedAttractors<S::NoModel> {
        let (mut rows, mut ranks) = (Vec::new(), Vec::new());
        let places = std::mem::take(&mut self.places);
        for (at, place) in places.into_iter().enumerate() {
            let roots = (0..place.tally.len()).map(|number| self.root((at, number)).1);
            let roots: Vec<usize> = roots.collect();
            let (census, rank) = place.tally.ranked(&roots);
            ranks.push(rank);
            rows.push(Row {
                value: place.value,
                census: place.model.map(|_| census),
            });
        }
        let place = |&(at, number): &Node| Some((at, ranks[at][number]?));
        let link =
            |((from, way), to): (&(Node, Way), &Node)| Some(((place(from)?, *way), place(to)?));
        let links = self.links.iter().filter_map(link);
        ContinuedAttractors::new(rows, &links.collect(), unfinished)
    }
}
