//! Random switching systems: a few damped states under a drive, and one or two units, each of some kind that
//! people write. All numbers have two decimals, so that a case reads well.

use crate::case::{Case, Mode, Poly, Rule};

/// Which kinds of trouble the systems may have.
#[derive(Clone, Copy)]
pub(crate) struct Kinds {
    /// Resets that move the guard that fired.
    pub(crate) moved_guards: bool,
    /// Switches at the very instants of samples.
    pub(crate) on_samples: bool,
    /// Modes entered with a guard on its wrong side: a switch at once, or a way back.
    pub(crate) wrong_sides: bool,
    /// Contact that lasts, sticking: guards that are zero to a multiplicity.
    pub(crate) lasting: bool,
    /// Guards with products of states.
    pub(crate) curved_guards: bool,
}

/// Steele, Lea & Flood's SplitMix64 (OOPSLA 2014).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    fn below(&mut self, n: usize) -> usize {
        (self.next() % n as u64) as usize
    }

    fn chance(&mut self, percent: u64) -> bool {
        self.next() % 100 < percent
    }

    /// A number from `lo` to `hi` with two decimals.
    fn number(&mut self, lo: f64, hi: f64) -> f64 {
        let unit = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        (100.0 * (lo + (hi - lo) * unit)).round() / 100.0
    }

    /// The same with a random sign, never 0.
    fn either(&mut self, lo: f64, hi: f64) -> f64 {
        let size = self.number(lo, hi);
        if self.chance(50) { size } else { -size }
    }
}

/// A case of these kinds.
pub(crate) fn case(random: &mut Random, kinds: Kinds) -> Case {
    let mut maker = Maker {
        random,
        kinds,
        case: Case::default(),
    };
    maker.background();
    for _ in 0..1 + maker.random.below(2) {
        maker.unit();
    }
    maker.case.name_the_drive();
    maker.case
}

/// Stand for cos and sin of the drive while the number of states is not known.
const COS: usize = 100;
const SIN: usize = 101;

struct Maker<'a> {
    random: &'a mut Random,
    kinds: Kinds,
    case: Case,
}

impl Maker<'_> {
    /// One or two damped parts, loosely coupled: each a state that relaxes or an oscillator.
    fn background(&mut self) {
        self.case.omega = self.random.number(1.2, 3.0);
        self.case.periods = 2 + self.random.below(2) as u64;
        for _ in 0..1 + self.random.below(2) {
            if self.random.chance(40) {
                let rate = self.relaxing();
                self.state(rate);
            } else {
                let at = self.case.rates.len();
                let pull = self.pull(at);
                self.state(Poly(vec![(1.0, vec![at + 1])]));
                self.state(pull);
            }
        }
        let n = self.case.rates.len();
        if n > 1 && self.random.chance(60) {
            let (to, i, j) = (n - 1, self.random.below(n), self.random.below(n));
            let c = self.random.either(0.05, 0.2);
            self.case.rates[to].0.push((c, vec![i, j]));
        }
    }

    fn state(&mut self, rate: Poly) -> usize {
        self.case.rates.push(rate);
        let start = self.random.number(-1.0, 1.0);
        self.case.start.push(start);
        self.case.rates.len() - 1
    }

    /// -a x + b + c cos(omega t).
    fn relaxing(&mut self) -> Poly {
        let x = self.case.rates.len();
        let decay = -self.random.number(0.2, 1.5);
        let mut terms = vec![(decay, vec![x]), (self.random.number(-1.0, 1.0), vec![])];
        if self.random.chance(60) {
            terms.push((self.random.either(0.2, 1.5), vec![COS]));
        }
        Poly(terms)
    }

    /// -k x - d v + a cos(omega t) + b - e x^3 for the oscillator of the states x and x + 1.
    fn pull(&mut self, x: usize) -> Poly {
        let r = &mut self.random;
        let mut terms = vec![
            (-r.number(0.5, 4.0), vec![x]),
            (-r.number(0.1, 0.6), vec![x + 1]),
            (
                r.either(0.3, 2.0),
                vec![if r.chance(50) { COS } else { SIN }],
            ),
        ];
        if r.chance(40) {
            terms.push((r.number(-1.0, 1.0), vec![]));
        }
        if r.chance(30) {
            terms.push((-r.number(0.1, 1.0), vec![x, x, x]));
        }
        Poly(terms)
    }

    fn unit(&mut self) {
        let modes = match self.random.below(8) {
            0 => self.two_sides(),
            1 => self.with_kicks(),
            2 => self.impacts(),
            3 if self.kinds.moved_guards => self.clock(),
            4 if self.kinds.on_samples => self.doses(),
            5 if self.kinds.lasting => self.friction(),
            6 if self.kinds.lasting => self.soft_landing(),
            7 if self.kinds.wrong_sides => self.ring(),
            _ => self.two_sides(),
        };
        let start = self.random.below(modes.len());
        self.case.units.push((start, modes));
    }

    fn some_state(&mut self) -> usize {
        self.random.below(self.case.rates.len())
    }

    /// x_i - threshold, perhaps with some of the drive or another state.
    fn guard(&mut self) -> Poly {
        let x = self.some_state();
        let mut terms = vec![(1.0, vec![x]), (self.random.number(-0.8, 0.8), vec![])];
        if self.random.chance(25) {
            terms.push((self.random.either(0.1, 0.5), vec![SIN]));
        }
        if self.kinds.curved_guards && self.random.chance(25) {
            let (i, j) = (self.some_state(), self.some_state());
            terms.push((self.random.either(0.1, 0.5), vec![i, j]));
        }
        Poly(terms)
    }

    /// A small change of a rate.
    fn add(&mut self) -> (usize, Poly) {
        let to = self.some_state();
        let from = self.some_state();
        let constant = (self.random.number(-0.6, 0.6), vec![]);
        let slope = (self.random.number(-0.3, 0.3), vec![from]);
        (to, Poly(vec![constant, slope]))
    }

    fn mode(&mut self, rules: Vec<Rule>) -> Mode {
        let adds = if self.random.chance(70) {
            vec![self.add()]
        } else {
            Vec::new()
        };
        Mode { adds, rules }
    }

    /// Two modes for the two sides of a guard, or with hysteresis between two.
    fn two_sides(&mut self) -> Vec<Mode> {
        let up = self.guard();
        let mut down = up.clone();
        if self.random.chance(50) && self.kinds.wrong_sides {
            down.0[1].0 += self.random.number(0.05, 0.4);
        }
        vec![
            self.mode(vec![rising(up, 1)]),
            self.mode(vec![falling(down, 0)]),
        ]
    }

    /// The same, with a state that jumps.
    fn with_kicks(&mut self) -> Vec<Mode> {
        let mut modes = self.two_sides();
        for mode in &mut modes {
            let rule = &mut mode.rules[0];
            let to = self.some_state();
            let in_guard = rule
                .guard
                .0
                .iter()
                .any(|(_, factors)| factors.contains(&to));
            if self.kinds.wrong_sides && (self.kinds.moved_guards || !in_guard) {
                let c = self.random.number(-0.9, 0.9);
                let kick = self.random.number(-0.5, 0.5);
                rule.resets
                    .push((to, Poly(vec![(c, vec![to]), (kick, vec![])])));
            }
        }
        modes
    }

    /// A new oscillator that bounces off a wall; "pushed out by epsilon" if guards may be moved.
    fn impacts(&mut self) -> Vec<Mode> {
        let x = self.case.rates.len();
        let pull = self.pull(x);
        self.state(Poly(vec![(1.0, vec![x + 1])]));
        self.state(pull);
        let wall = self.random.number(0.1, 1.0);
        self.case.start[x] = self.random.number(-wall + 0.02, 1.0);
        let e = self.random.number(0.3, 0.95);
        let mut rule = falling(Poly(vec![(1.0, vec![x]), (wall, vec![])]), 0);
        rule.resets.push((x + 1, Poly(vec![(-e, vec![x + 1])])));
        if self.kinds.moved_guards && self.random.chance(40) {
            rule.resets.push((x, Poly(vec![(0.01 - wall, vec![])])));
        }
        vec![self.mode(vec![rule])]
    }

    /// A clock that is set back, and kicks: sawtooth, integrate-and-fire. It may strike with the samples.
    fn clock(&mut self) -> Vec<Mode> {
        let kicked = self.some_state();
        let x = self.state(Poly(vec![(1.0, vec![])]));
        self.case.start[x] = 0.0;
        let period = self.case.period();
        let at = if self.kinds.on_samples && self.random.chance(50) {
            period * [0.25, 0.5, 1.0, 1.5][self.random.below(4)]
        } else {
            period * self.random.number(0.31, 0.97)
        };
        let mut rule = rising(Poly(vec![(1.0, vec![x]), (-at, vec![])]), 0);
        let back = if self.random.chance(50) {
            vec![]
        } else {
            vec![(1.0, vec![x]), (-at, vec![])]
        };
        rule.resets.push((x, Poly(back)));
        let (c, kick) = (self.random.number(-0.9, 0.9), self.random.number(-0.8, 0.8));
        rule.resets
            .push((kicked, Poly(vec![(c, vec![kicked]), (kick, vec![])])));
        vec![Mode {
            adds: Vec::new(),
            rules: vec![rule],
        }]
    }

    /// A dose whenever sin or cos of the drive rises through zero: at samples, or a quarter off.
    fn doses(&mut self) -> Vec<Mode> {
        let sway = if self.random.chance(70) { SIN } else { COS };
        let guard = Poly(vec![(self.random.either(1.0, 1.0), vec![sway])]);
        let to = self.some_state();
        let mut given = rising(guard.clone(), 1);
        let dose = (self.random.number(-0.8, 0.8), vec![]);
        given.resets.push((to, Poly(vec![(1.0, vec![to]), dose])));
        vec![self.mode(vec![given]), self.mode(vec![falling(guard, 0)])]
    }

    /// A new block on a moving spring with dry friction: sticks, slides to the right, slides to the left.
    fn friction(&mut self) -> Vec<Mode> {
        let x = self.case.rates.len();
        let pull = self.pull(x);
        self.state(Poly(vec![(1.0, vec![x + 1])]));
        self.state(Poly::default());
        let v = Poly(vec![(1.0, vec![x + 1])]);
        let friction = self.random.number(0.1, 1.2);
        let pulled = |by: f64| {
            let mut pull = pull.clone();
            pull.0.push((by, vec![]));
            pull
        };
        let stop = |rule: Rule| Rule {
            resets: vec![(x + 1, Poly::default())],
            ..rule
        };
        let sliding = |by: f64, rule| Mode {
            adds: vec![(x + 1, pulled(by))],
            rules: vec![stop(rule)],
        };
        let stick = Mode {
            adds: Vec::new(),
            rules: vec![rising(pulled(-friction), 1), falling(pulled(friction), 2)],
        };
        self.case.start[x + 1] = 0.0;
        vec![
            stick,
            sliding(-friction, falling(v.clone(), 0)),
            sliding(friction, rising(v, 0)),
        ]
    }

    /// A new oscillator that lands on a wall without bouncing, and leaves it when it is pulled off.
    fn soft_landing(&mut self) -> Vec<Mode> {
        let x = self.case.rates.len();
        let pull = self.pull(x);
        self.state(Poly::default());
        self.state(Poly::default());
        let wall = self.random.number(-0.2, 0.8);
        self.case.start[x] = self.random.number(-wall + 0.02, 1.0);
        let mut land = falling(Poly(vec![(1.0, vec![x]), (wall, vec![])]), 1);
        land.resets.push((x, Poly(vec![(-wall, vec![])])));
        land.resets.push((x + 1, Poly::default()));
        let leave = rising(pull.clone(), 0);
        let apart = Mode {
            adds: vec![(x, Poly(vec![(1.0, vec![x + 1])])), (x + 1, pull)],
            rules: vec![land],
        };
        let together = Mode {
            adds: Vec::new(),
            rules: vec![leave],
        };
        vec![apart, together]
    }

    /// Three modes in a ring with unrelated guards: often on their wrong side when a mode is entered.
    fn ring(&mut self) -> Vec<Mode> {
        let way = |random: &mut Random, guard, to| {
            if random.chance(50) {
                rising(guard, to)
            } else {
                falling(guard, to)
            }
        };
        let mut modes = Vec::new();
        for at in 0..3 {
            let guard = self.guard();
            let rule = way(self.random, guard, (at + 1) % 3);
            modes.push(self.mode(vec![rule]));
        }
        modes
    }
}

fn rising(guard: Poly, to: usize) -> Rule {
    Rule {
        guard,
        sign: -1.0,
        to,
        resets: Vec::new(),
    }
}

fn falling(guard: Poly, to: usize) -> Rule {
    Rule {
        sign: 1.0,
        ..rising(guard, to)
    }
}

impl Case {
    /// Numbers the drive's variables after the states.
    fn name_the_drive(&mut self) {
        let n = self.rates.len();
        for poly in self.polys() {
            for i in poly.0.iter_mut().flat_map(|(_, factors)| factors) {
                if *i >= COS {
                    *i = n + *i - COS;
                }
            }
        }
    }
}
