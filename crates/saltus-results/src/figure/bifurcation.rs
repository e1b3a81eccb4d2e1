//! Kinds of bifurcations: one symbol, colour and name for each, the same in all figures.

use super::colour::Colour;
use super::ink::{Ink, Step};
use std::f64::consts::{FRAC_PI_2, TAU};

/// Kind of a special point of a branch, or of a curve in a plane of two parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Bifurcation {
    /// Two orbits meet and vanish: a multiplier is 1. A square.
    Fold,
    /// An orbit of twice the period branches off: a multiplier is −1. A disc.
    PeriodDoubling,
    /// A torus branches off: two conjugate multipliers lie on the unit circle. A triangle.
    NeimarkSacker,
    /// The orbit touches a switching surface. An open diamond.
    Grazing,
    /// Two branches of equal period cross. A star.
    BranchPoint,
    /// Two switches coincide and change places. An open triangle on its tip.
    SwitchOrder,
}

impl Bifurcation {
    /// All kinds, in the order of legends.
    pub const ALL: [Self; 6] = [
        Self::Fold,
        Self::PeriodDoubling,
        Self::NeimarkSacker,
        Self::Grazing,
        Self::BranchPoint,
        Self::SwitchOrder,
    ];

    /// Name in legends.
    pub fn label(self) -> &'static str {
        match self {
            Self::Fold => "Fold",
            Self::PeriodDoubling => "Period doubling",
            Self::NeimarkSacker => "Neimark\u{2013}Sacker",
            Self::Grazing => "Grazing",
            Self::BranchPoint => "Branch point",
            Self::SwitchOrder => "Order of switches",
        }
    }

    /// Colour of curves in a plane of two parameters.
    pub fn colour(self) -> Colour {
        match self {
            Self::Fold => Colour::BLACK,
            Self::PeriodDoubling => Colour::VERMILLION,
            Self::NeimarkSacker => Colour::BLUE,
            Self::Grazing => Colour::GREEN,
            Self::BranchPoint => Colour::PURPLE,
            Self::SwitchOrder => Colour::ORANGE,
        }
    }

    /// The symbol around `centre`: black or open, with a white rim that parts it from lines.
    pub(crate) fn symbol(self, centre: (f64, f64)) -> [Ink; 3] {
        let corners = self.corners(centre);
        let open = matches!(self, Self::Grazing | Self::SwitchOrder);
        let white = Colour(255, 255, 255);
        [
            outline(&corners, 3.6, white),
            Ink::area(
                corners.clone(),
                if open { white } else { Colour::BLACK },
                1.0,
            ),
            outline(&corners, 1.3, Colour::BLACK),
        ]
    }

    /// Corners (px); the sizes make the symbols look equally large.
    fn corners(self, centre: (f64, f64)) -> Vec<(f64, f64)> {
        let (count, turn, radii): (u32, f64, &[f64]) = match self {
            Self::Fold => (4, 0.5 * FRAC_PI_2, &[5.2]),
            Self::PeriodDoubling => (24, 0.0, &[4.3]),
            Self::NeimarkSacker => (3, -FRAC_PI_2, &[5.8]),
            Self::Grazing => (4, 0.0, &[5.6]),
            Self::BranchPoint => (10, -FRAC_PI_2, &[6.6, 2.9]),
            Self::SwitchOrder => (3, FRAC_PI_2, &[5.8]),
        };
        let corner = |(number, radius): (u32, &f64)| {
            let (sin, cos) = (turn + TAU * f64::from(number) / f64::from(count)).sin_cos();
            (centre.0 + radius * cos, centre.1 + radius * sin)
        };
        (0..count).zip(radii.iter().cycle()).map(corner).collect()
    }
}

fn outline(corners: &[(f64, f64)], width: f64, colour: Colour) -> Ink {
    let around = corners.iter().cycle().take(corners.len() + 1);
    let steps = around.enumerate().map(|(number, &(x, y))| match number {
        0 => Step::Move(x, y),
        _ => Step::Line(x, y),
    });
    Ink::trail(steps.collect(), width, colour)
}
