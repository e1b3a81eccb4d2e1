//! The rate at which the flow contracts volumes in state space.

use saltus_hybrid::Mode;

use super::Model;
use super::leg::Contact;
use crate::physics::ContactLaw;

impl Model {
    /// Time integral of the divergence of the field over one forcing period, from the time that each unit
    /// spent in each of its modes (`dwell[jumper][mode]`, radians of the drive; see
    /// [`saltus_hybrid::Sample::dwell`]).
    ///
    /// Each plate amplitude contributes -c/Omega, each leg on the floor -(c_h/Omega) (1/m_h + sum psi_j^2/M), a
    /// relaxing leg in the air -k_h/(c_h Omega). By Liouville's formula the sum of all Lyapunov exponents is
    /// the mean of this: switches change no volume under [`ContactLaw::ReactionForce`], where nothing jumps, and
    /// under [`ContactLaw::Gap`], where accelerations jump at a gap that depends on positions only
    /// (det S = 1 + grad g . (f+ - f-)/g' = 1). A relaxing leg forgets its length at touch-down, and all
    /// volume with it. What in-plane terms do under [`super::Inertia::SlowManifold`] beyond their static
    /// response is left out.
    pub fn divergence(&self, dwell: &[Vec<f64>]) -> f64 {
        let amplitudes = (self.layout.transverse + self.layout.in_plane) as f64;
        let plate = amplitudes * self.plate.elasticity.damping / self.scales.omega;
        let legs = dwell.iter().enumerate().map(|(jumper, times)| {
            let rates = times.iter().enumerate();
            rates
                .map(|(mode, time)| time * self.leg_contraction(jumper, mode))
                .sum::<f64>()
        });
        -(plate * self.system.period() + legs.sum::<f64>())
    }

    fn leg_contraction(&self, index: usize, mode: Mode) -> f64 {
        let setup = &self.setup;
        let jumper = &setup.jumpers[index];
        let rate = match Contact::of(mode) {
            Contact::Stance => {
                let psi = setup.plate.mode_shape(jumper.x, jumper.y);
                let shapes: f64 = psi.iter().map(|psi| psi * psi).sum();
                jumper.damping() * (1.0 / jumper.mass + shapes / setup.plate.modal_mass())
            }
            Contact::Flight if setup.contact == ContactLaw::RelaxingLeg => {
                jumper.stiffness / jumper.damping()
            }
            Contact::Flight => 0.0,
        };
        rate / self.scales.omega
    }
}
