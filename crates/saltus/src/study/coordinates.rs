//! A state as a sample that is compared with others: people and plate in units of eta.

use crate::model::Model;

/// Numbers in a sample: z and v of each body, then r_j and r_j', then what a leg remembers.
pub(super) fn width(model: &Model) -> usize {
    let layout = model.layout;
    let legs = if layout.legs { layout.jumpers } else { 0 };
    2 * (layout.jumpers + layout.transverse) + legs
}

/// A state in units of eta and eta omega_h of its body, those of the plate of the first one. In-plane
/// amplitudes are left out: they follow the others.
pub(super) fn coordinates(model: &Model, x: &[f64], row: &mut [f64]) {
    let (layout, scales) = (model.layout, &model.scales);
    let first = scales.jumpers.first();
    let (length, speed) = first.map_or((1.0, 1.0), |unit| {
        let speed = scales.velocity() / unit.velocity;
        (scales.length / unit.position, speed)
    });
    let bodies = 0..layout.jumpers;
    let values = bodies
        .clone()
        .map(|i| model.z(i, x))
        .chain(bodies.clone().map(|i| model.v(i, x)))
        .chain((0..layout.transverse).map(|j| x[layout.r(j)] * length))
        .chain((0..layout.transverse).map(|j| x[layout.dr(j)] * speed))
        .chain(
            bodies
                .filter(|_| layout.legs)
                .map(|i| x[layout.leg(i)] * length),
        );
    for (out, value) in row.iter_mut().zip(values) {
        *out = value;
    }
}
