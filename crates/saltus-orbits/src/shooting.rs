//! Newton's method for periodic orbits by multiple shooting, with any number of free parameters.
//!
//! Unknown are the first places of the segments of an orbit and the free parameters p; the equations are
//! P(x_i; p) = x_(i+1), cyclically, and one linear condition on (x_1, p) per free parameter. With
//! A_i = dP/dx, C_i = dP/dp and the gaps g_i = P(x_i) - x_(i+1), a step obeys
//!
//! ```text
//! d_(i+1) = A_i d_i + C_i dp + g_i,
//! ```
//!
//! so one pass around the orbit leaves n equations for d_1 and dp, for any number of segments. Inside
//! a segment the gaps are zero. Shots of all segments, and those for C by differences, are asked together.

use crate::differences::{DIFFERENCE, Free, moved, slope};
use crate::events::switches;
use crate::kept::Kept;
use crate::linear::{self, minus, plus, size, times, whole_norm};
use crate::map::{Image, MapPoint, MapRequest, NoImage, ParametricMap};
use crate::matrix::Matrix;
use crate::newton::{NewtonOptions, NotFound};

/// Halvings of a step at most.
const HALVINGS: usize = 6;

/// A residual that no longer falls counts as rounding below this multiple of the tolerance.
const STAGNATION: f64 = 100.0;

/// The equations of an orbit.
pub(crate) struct Shooting<'a, F: ?Sized> {
    pub(crate) family: &'a F,
    pub(crate) free: &'a [Free],
    pub(crate) newton: &'a NewtonOptions,
    /// Whether steps that change the switches are refused. With a square root in the map steps from the side
    /// with an impact end beyond it, on the other side, where there may be no orbit.
    pub(crate) keep_switches: bool,
    /// Quantities whose values an orbit is to have, one of a family of them: without a free parameter the equations for
    /// a step have many solutions there, and these say which.
    pub(crate) kept: &'a [Kept],
}

/// An orbit to begin with.
#[derive(Clone, Debug)]
pub(crate) struct Guess {
    pub(crate) parameters: Vec<f64>,
    /// One place per iterate; those inside segments are computed from the first one.
    pub(crate) places: Vec<MapPoint>,
}

impl Guess {
    /// Moved by `length` times a change of each place and of the free parameters in their units.
    pub(crate) fn moved(mut self, free: &[Free], length: f64, change: &Change) -> Self {
        for (place, change) in self.places.iter_mut().zip(&change.x) {
            place.x = plus(&place.x, length, change);
        }
        for (free, change) in free.iter().zip(&change.free) {
            self.parameters[free.index] += length * change * free.unit;
        }
        self
    }
}

/// A change of an orbit and of the free parameters.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Change {
    /// Change of each place.
    pub(crate) x: Vec<Vec<f64>>,
    /// Change of each free parameter, in its unit.
    pub(crate) free: Vec<f64>,
}

/// Derivatives of an image by the free parameters.
type Columns = Vec<Vec<f64>>;

/// One pass around a guess.
#[derive(Clone, Debug)]
pub(crate) struct Pass {
    pub(crate) parameters: Vec<f64>,
    pub(crate) places: Vec<MapPoint>,
    pub(crate) images: Vec<Image>,
    /// C_i.
    columns: Vec<Columns>,
    /// g_i.
    gaps: Vec<Vec<f64>>,
    /// Largest gap.
    pub(crate) residual: f64,
    /// Newton steps that led here.
    pub(crate) iterations: usize,
}

impl Pass {
    fn derivative(&self, i: usize) -> Option<&Matrix> {
        self.images[i].derivative.as_ref()
    }

    /// The derivative of the whole way round at the first place, M, and that by the free parameters.
    pub(crate) fn around(&self) -> Option<(Matrix, Columns)> {
        let n = self.places[0].x.len();
        let mut m = Matrix::identity(n);
        let mut columns = vec![vec![0.0; n]; self.columns[0].len()];
        for i in 0..self.places.len() {
            let a = self.derivative(i)?;
            m = linear::product(a, &m);
            for (column, by) in columns.iter_mut().zip(&self.columns[i]) {
                *column = plus(&times(a, column), 1.0, by);
            }
        }
        Some((m, columns))
    }

    /// The n equations for (d_1, dp): (M - I | C).
    pub(crate) fn equations(&self) -> Option<Matrix> {
        let (m, columns) = self.around()?;
        let (n, m) = (m.nrows(), linear::shifted(&m, 1.0));
        Some(Matrix::from_fn(n, n + columns.len(), |row, col| {
            if col < n {
                m[(row, col)]
            } else {
                columns[col - n][row]
            }
        }))
    }

    /// Change of all places by that of the first one and of the free parameters, side by side;
    /// `gaps` times the gaps are added on the way. The last change is that of the place after the last.
    fn carried(&self, first: &[f64], gaps: f64) -> Option<(Change, Vec<f64>)> {
        let (start, free) = first.split_at(self.places[0].x.len());
        let (mut x, mut d) = (Vec::new(), start.to_vec());
        for i in 0..self.places.len() {
            let mut next = plus(&times(self.derivative(i)?, &d), gaps, &self.gaps[i]);
            for (column, free) in self.columns[i].iter().zip(free) {
                next = plus(&next, *free, column);
            }
            x.push(std::mem::replace(&mut d, next));
        }
        let free = free.to_vec();
        Some((Change { x, free }, d))
    }

    /// A tangent (first place, free parameters) carried to all places.
    pub(crate) fn spread(&self, tangent: &[f64]) -> Option<Change> {
        Some(self.carried(tangent, 0.0)?.0)
    }

    /// Factor by which errors of single derivatives, relative to their sizes, may change that of the whole way round.
    pub(crate) fn growth(&self) -> f64 {
        let n = self.places[0].x.len();
        let (mut growth, mut before) = (0.0, Matrix::identity(n));
        let derivatives: Vec<&Matrix> = self
            .images
            .iter()
            .filter_map(|i| i.derivative.as_ref())
            .collect();
        // products of all that come after each
        let mut after = vec![1.0];
        let mut product = Matrix::identity(n);
        for a in derivatives.iter().skip(1).rev() {
            product = linear::product(&product, a);
            after.push(whole_norm(&product));
        }
        for (a, after) in derivatives.iter().zip(after.into_iter().rev()) {
            growth += after * whole_norm(a) * whole_norm(&before);
            before = linear::product(a, &before);
        }
        growth
    }

    /// Gradient of the quantity that one way round keeps best: v with v (M - I) nearest to zero.
    pub(crate) fn best_kept(&self) -> Option<Vec<f64>> {
        let (m, _) = self.around()?;
        let equations = linear::shifted(&m, 1.0);
        linear::null_space(&equations.transposed(), 1)?.pop()
    }

    /// Newton's step to where some quantities have their values.
    fn step_to(&self, kept: &[Kept]) -> Option<Change> {
        let equations = self.equations()?;
        let (n, all) = (equations.nrows(), equations.ncols());
        let x = &self.places[0].x;
        let slopes: Vec<Vec<f64>> = kept.iter().map(|kept| kept.slope(x)).collect();
        let system = Matrix::from_fn(n + kept.len(), all, |row, col| {
            if row < n {
                equations[(row, col)]
            } else {
                slopes[row - n][col]
            }
        });
        let (_, gap) = self.carried(&vec![0.0; all], 1.0)?;
        let right = gap.iter().map(|gap| -gap);
        let right: Vec<f64> = right
            .chain(kept.iter().map(|kept| kept.missing(x)))
            .collect();
        Some(
            self.carried(&linear::least_squares(&system, &right)?, 1.0)?
                .0,
        )
    }

    /// Newton's step with `rows` (d_1, dp) = 0.
    fn step(&self, rows: &[Vec<f64>]) -> Option<Change> {
        let equations = self.equations()?;
        let (n, all) = (equations.nrows(), equations.ncols());
        let system = Matrix::from_fn(all, all, |row, col| {
            if row < n {
                equations[(row, col)]
            } else {
                rows[row - n][col]
            }
        });
        let (_, gap) = self.carried(&vec![0.0; all], 1.0)?;
        let mut right = vec![0.0; all];
        for (right, gap) in right.iter_mut().zip(&gap) {
            *right = -gap;
        }
        Some(self.carried(&linear::solve(&system, &right)?, 1.0)?.0)
    }

    /// Largest state, or 1.
    fn scale(&self) -> f64 {
        let sizes = self.places.iter().map(|place| size(&place.x));
        sizes.fold(1.0, f64::max)
    }

    /// Whether every place has the modes of the image that leads to it.
    fn modes_agree(&self) -> bool {
        let n = self.places.len();
        (0..n).all(|i| self.images[i].place.modes == self.places[(i + 1) % n].modes)
    }

    fn same_switches(&self, other: &Self) -> bool {
        let mut both = self.images.iter().zip(&other.images);
        both.all(|(a, b)| switches(&a.crossings) == switches(&b.crossings))
    }

    /// This orbit as a guess, with modes from the images: modes at the section follow from the motion.
    fn guess(&self) -> Guess {
        let n = self.places.len();
        let place = |i: usize| MapPoint {
            modes: self.images[(i + n - 1) % n].place.modes.clone(),
            x: self.places[i].x.clone(),
        };
        Guess {
            parameters: self.parameters.clone(),
            places: (0..n).map(place).collect(),
        }
    }
}

impl<F: ParametricMap + ?Sized> Shooting<'_, F> {
    /// Newton's method from a guess, with `rows` (d_1, dp) = 0 in each step: the conditions hold in the end
    /// as far as they hold for the guess.
    pub(crate) fn correct(&self, guess: &Guess, rows: &[Vec<f64>]) -> Result<Pass, NotFound> {
        let mut pass = self.pass(guess).map_err(|reason| NotFound::NoImage {
            reason,
            residual: f64::INFINITY,
            places: guess.places.clone(),
        })?;
        for iteration in 0..=self.newton.iterations {
            pass.iterations = iteration;
            let tolerance = self.newton.tolerance * pass.scale();
            let agree = pass.modes_agree();
            if agree && pass.residual <= tolerance {
                return Ok(pass);
            }
            if iteration == self.newton.iterations {
                break;
            }
            pass = if agree {
                match self.better(&pass, rows)? {
                    Some(next) => next,
                    None if pass.residual <= STAGNATION * tolerance => return Ok(pass),
                    None => break,
                }
            } else {
                // Gaps with wrong modes say nothing about the state.
                self.pass(&pass.guess()).map_err(lost(&pass))?
            };
        }
        Err(NotFound::NotConverged {
            iterations: pass.iterations,
            residual: pass.residual,
            places: pass.places,
        })
    }

    /// The end of the longest part of a Newton step that makes the gaps smaller, if there is one.
    fn better(&self, pass: &Pass, rows: &[Vec<f64>]) -> Result<Option<Pass>, NotFound> {
        let step = if self.kept.is_empty() {
            pass.step(rows)
        } else {
            pass.step_to(self.kept)
        };
        let step = step.ok_or_else(|| NotFound::Singular {
            residual: pass.residual,
            places: pass.places.clone(),
        })?;
        let length = step.x.iter().map(|x| size(x)).fold(0.0, f64::max);
        let mut part = (pass.scale() / length).min(1.0);
        let mut reason = None;
        for _ in 0..=HALVINGS {
            match self.pass(&pass.guess().moved(self.free, part, &step)) {
                Ok(next) if self.keep_switches && !next.same_switches(pass) => reason = None,
                // New modes are another set of equations: their gaps need not be smaller at once.
                Ok(next) if next.residual < pass.residual || !next.modes_agree() => {
                    return Ok(Some(next));
                }
                Ok(_) => reason = None,
                Err(stop @ NoImage::Interrupted) => return Err(lost(pass)(stop)),
                Err(other) => reason = Some(other),
            }
            part /= 2.0;
        }
        reason.map_or(Ok(None), |reason| Err(lost(pass)(reason)))
    }

    /// One way round: all segments side by side, one call per place within a segment.
    pub(crate) fn pass(&self, guess: &Guess) -> Result<Pass, NoImage> {
        let n = guess.places.len();
        let segments = self.newton.segments.unwrap_or(n).clamp(1, n);
        let first = |segment: usize| segment * n / segments;
        let mut places = guess.places.clone();
        let mut images = vec![None; n];
        let mut columns = vec![Vec::new(); n];
        for depth in 0..n.div_ceil(segments) {
            let under_way: Vec<usize> = (0..segments)
                .filter(|&segment| first(segment) + depth < first(segment + 1))
                .map(|segment| first(segment) + depth)
                .collect();
            let answers = self.shoot(&guess.parameters, &places, &under_way)?;
            for (i, (image, by)) in under_way.into_iter().zip(answers) {
                if (0..segments).all(|segment| first(segment) != i + 1) && i + 1 < n {
                    places[i + 1] = image.place.clone();
                }
                images[i] = Some(image);
                columns[i] = by;
            }
        }
        let images: Vec<Image> = images.into_iter().flatten().collect();
        let gaps: Vec<Vec<f64>> = (0..n)
            .map(|i| minus(&images[i].place.x, &places[(i + 1) % n].x))
            .collect();
        Ok(Pass {
            parameters: guess.parameters.clone(),
            places,
            images,
            columns,
            residual: gaps.iter().map(|gap| size(gap)).fold(0.0, f64::max),
            gaps,
            iterations: 0,
        })
    }

    /// Image of the places that `which` names, with the derivatives by state and free parameters.
    fn shoot(
        &self,
        parameters: &[f64],
        places: &[MapPoint],
        which: &[usize],
    ) -> Result<Vec<(Image, Columns)>, NoImage> {
        let beside = |free| [-DIFFERENCE, DIFFERENCE].map(|part| moved(parameters, free, part));
        let sides: Vec<Vec<f64>> = self.free.iter().flat_map(beside).collect();
        let shots: Vec<MapRequest<'_>> = which
            .iter()
            .flat_map(|&i| {
                let start = &places[i];
                let shot = move |parameters, derivative| MapRequest {
                    parameters,
                    start,
                    derivative,
                };
                std::iter::once(shot(parameters, true))
                    .chain(sides.iter().map(move |side| shot(side, false)))
            })
            .collect();
        let mut answers = self.family.images(&shots).into_iter();
        let mut all = Vec::with_capacity(which.len());
        for &i in which {
            let image = checked(answers.next(), places[i].x.len())?;
            let mut columns = Vec::with_capacity(self.free.len());
            let shot = MapRequest {
                parameters,
                start: &places[i],
                derivative: true,
            };
            for free in self.free {
                let both =
                    [answers.next(), answers.next()].map(|answer| answer.unwrap_or_else(missing));
                columns.push(slope(self.family, &shot, &image, free, &both)?);
            }
            all.push((image, columns));
        }
        Ok(all)
    }
}

/// The failure of a step from a pass, which leads out of the map.
fn lost(pass: &Pass) -> impl Fn(NoImage) -> NotFound {
    |reason| NotFound::NoImage {
        reason,
        residual: pass.residual,
        places: pass.places.clone(),
    }
}

fn missing() -> Result<Image, NoImage> {
    Err(NoImage::Ended("no answer for a shot".into()))
}

/// An image that Newton can use: a finite state and a derivative of the right shape.
fn checked(answer: Option<Result<Image, NoImage>>, n: usize) -> Result<Image, NoImage> {
    let image = answer.unwrap_or_else(missing)?;
    let finite = image.place.x.iter().all(|x| x.is_finite());
    match &image.derivative {
        _ if image.place.x.len() != n || !finite => {
            Err(NoImage::Ended("the image is not finite".into()))
        }
        Some(d) if d.nrows() == n && d.ncols() == n && linear::is_finite(d) => Ok(image),
        Some(_) => Err(NoImage::Ended("the derivative is not finite".into())),
        None => Err(NoImage::Ended(
            "no derivative, although it was asked for".into(),
        )),
    }
}
