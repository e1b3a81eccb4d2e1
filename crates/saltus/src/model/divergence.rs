//! How fast the flow contracts volumes in state space.

use saltus_hybrid::Mode;

use super::Model;
use super::equations::Contact;
use crate::physics::ContactLaw;

impl Model {
    /// Divergence of the field in these modes (per radian of the drive), the same at every state: each
    /// plate amplitude contributes -c/Omega, each leg on the floor -(c_h/Omega) (1/m_h + sum psi_j^2/M), a
    /// relaxing leg in the air -k_h/(c_h Omega). By Liouville's formula the mean sum of all Lyapunov
    /// exponents is its time average, plus what resets and jumps of the force do at switches: nothing
    /// under [`ContactLaw::ReactionForce`]. What in-plane terms do under
    /// [`super::Inertia::SlowManifold`] beyond their static response is left out.
    pub fn divergence(&self, modes: &[Mode]) -> f64 {
        let setup = &self.setup;
        let omega = self.scales.omega;
        let amplitudes = (self.layout.transverse + self.layout.in_plane) as f64;
        let plate = amplitudes * self.plate.elasticity.damping;
        let leg = |(jumper, &mode): (&crate::physics::Jumper, &Mode)| match Contact::of(mode) {
            Contact::Stance => {
                let psi = setup.plate.mode_shape(jumper.x, jumper.y);
                let shapes: f64 = psi.iter().map(|psi| psi * psi).sum();
                let inverse_mass = 1.0 / jumper.mass + shapes / setup.plate.modal_mass();
                jumper.damping() * inverse_mass
            }
            Contact::Flight if setup.contact == ContactLaw::RelaxingLeg => {
                jumper.stiffness / jumper.damping()
            }
            Contact::Flight => 0.0,
        };
        let legs: f64 = setup.jumpers.iter().zip(modes).map(leg).sum();
        -(plate + legs) / omega
    }
}
