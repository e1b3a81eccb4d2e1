//! Oscillators, billiards and a valve with known answers, from their equations to their bifurcations.

mod ball;
mod bilinear;
mod duffing;
mod family;
mod impact;
mod independent;
mod lorenz;
mod machine;
mod mathieu;
mod valve;
mod wall;
