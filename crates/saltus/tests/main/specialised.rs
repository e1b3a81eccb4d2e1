//! Straight-line code against the interpreter, instruction sets against each other, lanes against
//! single runs: all to the bit, on the production equations.

#![allow(clippy::unwrap_used)] // a test may panic

use std::sync::atomic::AtomicBool;

use saltus::hybrid::{
    End, Instructions, Method, Options, Point, Recording, Sample, Segment, Status, System, Task,
    integrate, record,
};
use saltus::model::{Inertia, Model, Setup};
use saltus::physics::ContactLaw;

/// The programs that are written out.
fn setups() -> Vec<Setup> {
    let paper = |inertia, contact| Setup {
        inertia,
        contact,
        ..Setup::dias_del_prado(0.2, 1.1)
    };
    vec![
        paper(Inertia::Condensed, ContactLaw::ReactionForce),
        paper(Inertia::Condensed, ContactLaw::Gap),
        paper(Inertia::Condensed, ContactLaw::RelaxingLeg),
        paper(Inertia::SlowManifold, ContactLaw::ReactionForce),
    ]
}

fn run(model: &Model, instructions: Instructions, order: usize) -> Recording {
    let segment = Segment {
        system: model.system().clone(),
        start: model.start(3.0, 2.0),
        periods: 12,
    };
    let options = Options {
        method: Method::Taylor {
            tolerance: 1e-9,
            order,
        },
        instructions,
        ..Options::default()
    };
    record(&segment, &options).unwrap()
}

fn bits(recording: &Recording, states: usize) -> Vec<u64> {
    let samples = recording.samples.iter();
    samples
        .flat_map(|point| point.x[..states].iter().map(|x| x.to_bits()))
        .collect()
}

#[test]
fn the_straight_line_code_is_that_of_the_equations() {
    let plain = setups()
        .into_iter()
        .map(|setup| setup.model().unwrap().system().clone());
    let tangent = setups()[0]
        .model()
        .unwrap()
        .system()
        .with_tangents(1)
        .unwrap();
    for system in plain.chain([tangent]) {
        let (source, written) = (system.source(), system.written_source());
        assert_eq!(
            source.as_deref(),
            written,
            "run `cargo run --release -p saltus --example specialise` and commit what it writes"
        );
    }
    // Two people are interpreted.
    let mut two = setups().remove(0);
    two.jumpers.push(two.jumpers[0]);
    assert!(!two.model().unwrap().system().is_specialised());
}

#[test]
fn straight_line_code_and_interpreter_agree_to_the_bit() {
    for setup in setups() {
        let plain = setup.model().unwrap();
        // The energy integrals make another program, which is interpreted, of the same motion.
        let with_energy = setup.model_with_energy().unwrap();
        assert!(plain.system().is_specialised() && !with_energy.system().is_specialised());
        for order in [8, 13, 16, 21] {
            let (a, b) = (
                run(&plain, Instructions::Best, order),
                run(&with_energy, Instructions::Best, order),
            );
            let states = plain.free_states();
            assert_eq!(bits(&a, states), bits(&b, states), "{:?}", setup.contact);
        }
    }
}

#[test]
fn a_tangent_has_the_same_bits_interpreted_and_written_out() {
    let setup = &setups()[0];
    let run = |model: &Model| {
        let system = model.system().with_tangents(1).unwrap();
        let mut start = system.point(&[0], &model.start(-0.5, 1.0).x[..model.free_states()]);
        system.columns_mut(&mut start.x)[9] = 1.0;
        let segment = Segment {
            system: system.clone(),
            start,
            periods: 5,
        };
        let options = Options {
            method: Method::taylor(1e-9),
            ..Options::default()
        };
        let end = record(&segment, &options).unwrap().end.point.x;
        let column = system.columns(&end).iter();
        (
            system.is_specialised(),
            column.map(|x| x.to_bits()).collect::<Vec<_>>(),
        )
    };
    let (written, a) = run(&setup.model().unwrap());
    let (other, b) = run(&setup.model_with_energy().unwrap());
    assert!(written && !other);
    assert_eq!(a, b);
}

#[test]
fn avx2_and_avx512_agree_to_the_bit_and_plain_code_to_rounding() {
    for setup in setups() {
        let model = setup.model().unwrap();
        let states = model.free_states();
        let best = run(&model, Instructions::Best, 14);
        let avx2 = run(&model, Instructions::Avx2, 14);
        assert_eq!(bits(&best, states), bits(&avx2, states));
        let baseline = run(&model, Instructions::Baseline, 14);
        let pairs = best.samples[0].x.iter().zip(&baseline.samples[0].x);
        for (a, b) in pairs {
            assert!((a - b).abs() < 1e-12, "{a} {b}");
        }
    }
}

#[test]
fn every_written_program_runs_in_512_kib_of_stack() {
    // As `saltus-hybrid/tests/stack.rs` for those that are interpreted.
    let run = |system: System, point: Point| {
        let segment = Segment {
            system,
            start: point,
            periods: 3,
        };
        let run = move || {
            for instructions in [
                Instructions::Best,
                Instructions::Avx2,
                Instructions::Baseline,
            ] {
                let options = Options {
                    instructions,
                    ..Options::default()
                };
                let end = record(&segment, &options).unwrap().end;
                assert_eq!(end.status, Status::Completed);
            }
        };
        let thread = std::thread::Builder::new().stack_size(512 << 10);
        thread.spawn(run).unwrap().join().unwrap();
    };
    for setup in setups() {
        let model = setup.model().unwrap();
        let start = model.start(3.0, 2.0);
        let tangent = model.system().with_tangents(1).unwrap();
        run(tangent.clone(), tangent.point(&start.modes, &start.x));
        run(model.system().clone(), start);
    }
}

struct Kept {
    segment: Option<Segment>,
    id: usize,
    bits: Vec<u64>,
    status: Option<Status>,
}

impl Task for Kept {
    fn begin(&mut self) -> Option<Segment> {
        self.segment.take()
    }
    fn sample(&mut self, sample: &Sample<'_>) -> bool {
        self.bits.extend(sample.x.iter().map(|x| x.to_bits()));
        true
    }
    fn end(&mut self, end: End) -> Option<Segment> {
        self.status = Some(end.status);
        None
    }
}

/// Runs of different damping and length, drawn from the queue in this order.
fn crowd(order: &[usize], z: impl Fn(usize) -> f64) -> Vec<Kept> {
    let task = |&id: &usize| {
        let setup = Setup::dias_del_prado(0.1 + 0.02 * id as f64, 1.0);
        let model = setup.model().unwrap();
        Kept {
            segment: Some(Segment {
                start: model.start(z(id), 2.0),
                system: model.system().clone(),
                periods: 6 + id as u64 % 5,
            }),
            id,
            bits: Vec::new(),
            status: None,
        }
    };
    let mut out = Vec::new();
    let tasks: Vec<Kept> = order.iter().map(task).collect();
    let stop = AtomicBool::new(false);
    integrate(&Options::default(), tasks, &stop, |task| out.push(task)).unwrap();
    out.sort_by_key(|task| task.id);
    out
}

#[test]
fn a_run_has_the_same_bits_alone_and_anywhere_in_a_crowd() {
    let straight: Vec<usize> = (0..21).collect();
    let shuffled: Vec<usize> = (0..21).map(|i| (i * 8 + 5) % 21).collect();
    let (a, b) = (crowd(&straight, |_| 3.0), crowd(&shuffled, |_| 3.0));
    for (a, b) in a.iter().zip(&b) {
        assert_eq!(a.bits, b.bits, "{}", a.id);
    }
    for id in [0, 8, 13] {
        assert_eq!(crowd(&[id], |_| 3.0)[0].bits, a[id].bits);
    }
}

#[test]
fn a_nan_an_endless_flight_and_an_infinite_start_leave_the_others_alone() {
    let order: Vec<usize> = (0..16).collect();
    let good = crowd(&order, |_| 3.0);
    let odd = |id| match id {
        2 => f64::NAN,
        5 => 1e7, // some 170 km up
        11 => f64::INFINITY,
        _ => 3.0,
    };
    let mixed = crowd(&order, odd);
    for id in [2, 11] {
        assert!(matches!(mixed[id].status, Some(Status::NotFinite { .. })));
    }
    assert_eq!(mixed[5].status, Some(Status::Completed));
    for id in order.into_iter().filter(|id| ![2, 5, 11].contains(id)) {
        assert_eq!(good[id].bits, mixed[id].bits, "{id}");
    }
}
