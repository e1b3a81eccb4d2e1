//! Lyapunov exponents of people on a plate.

use saltus::model::Setup;
use saltus::physics::ContactLaw;
use saltus::study::{Control, LyapunovRun, Measurement, lyapunov};

fn measured(setup: &Setup, exponents: usize, periods: u64) -> LyapunovRun {
    let model = setup.model().expect("the paper's case");
    let how = Measurement {
        exponents,
        transient: 300,
        periods,
        replicas: 8,
    };
    lyapunov(&model, &model.start(3.0, 2.0), &how, &Control::default()).expect("runs")
}

#[test]
fn a_periodic_orbit_has_a_negative_exponent_and_chaos_a_positive_one() {
    // zeta_h 0.35 at 0.9 is 1T (DP Fig. 3b), 0.12 at 1.0 is chaotic (DP Fig. 2b).
    let periodic = measured(&Setup::dias_del_prado(0.35, 0.9), 1, 100);
    let chaotic = measured(&Setup::dias_del_prado(0.12, 1.0), 1, 400);
    let (periodic, chaotic) = (periodic.largest(), chaotic.largest());
    assert!(periodic.expect("recorded").per_iterate < -0.05);
    let chaotic = chaotic.expect("recorded");
    assert!(
        chaotic.per_iterate > 5.0 * chaotic.standard_error,
        "{chaotic:?}"
    );
}

#[test]
fn the_sum_of_all_exponents_is_the_mean_divergence() {
    // By Liouville's formula, period by period: no statistics are involved.
    for contact in [ContactLaw::ReactionForce, ContactLaw::Gap] {
        let setup = Setup {
            contact,
            ..Setup::dias_del_prado(0.12, 1.0)
        };
        let all = measured(&setup, 10, 60);
        let sum = all.spectrum.sum().per_iterate;
        assert!(
            (sum - all.divergence()).abs() < 1e-7,
            "{sum} {}",
            all.divergence()
        );
    }
}
