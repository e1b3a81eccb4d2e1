//! Lorenz' attractor at sigma = 10, rho = 28, beta = 8/3.

use saltus_hybrid::SystemBuilder;

use super::machine::exponents;

#[test]
fn exponents_of_the_lorenz_attractor_are_the_published_ones() {
    const INTERVAL: f64 = 0.5;
    let mut b = SystemBuilder::new(3);
    let [x, y, z] = [0, 1, 2].map(|i| b.state(i));
    let products = b.products(&[(x, z), (x, y)]);
    let rates = [
        b.linear(0.0, &[(-10.0, x), (10.0, y)]),
        b.linear(0.0, &[(28.0, x), (-1.0, products[0]), (-1.0, y)]),
        b.linear(0.0, &[(1.0, products[1]), (-8.0 / 3.0, z)]),
    ];
    (0..3).for_each(|i| b.derivative(i, rates[i]));
    let system = b.build(INTERVAL).unwrap();
    let starts: Vec<_> = (0..8)
        .map(|i| vec![1.0 + f64::from(i), 1.0, 20.0])
        .collect();
    let record = exponents(&system, &starts, 100, 1500);
    let found = record.estimate();
    // 0.9056, 0, -14.5723 (Sprott, Chaos and Time-Series Analysis, 2003, appendix A).
    for (exponent, published) in found.iter().zip([0.9056, 0.0, -14.5723]) {
        let error = exponent.standard_error / INTERVAL;
        let off = exponent.per_iterate / INTERVAL - published;
        assert!(off.abs() < 4.0 * error && error < 0.01, "{off} {error}");
    }
    let divergence = -(10.0 + 1.0 + 8.0 / 3.0);
    assert!((record.sum().per_iterate / INTERVAL - divergence).abs() < 1e-9);
}
