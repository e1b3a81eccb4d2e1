//! All quantities that answers have: name, meaning and unit of each, said here and nowhere else.
//!
//! A name is one thing wherever it is found. Quantities of the same kind at another place, as of a special point or a
//! loop, are the same under another name ([`Quantity::named`]).

use saltus_results::Quantity;

const fn number(name: &'static str, meaning: &'static str) -> Quantity {
    Quantity::new(name, meaning, "1")
}

const fn joule(name: &'static str, meaning: &'static str) -> Quantity {
    Quantity::new(name, meaning, "J")
}

// The base, the run

pub(crate) const BASE_FREQUENCY: Quantity =
    Quantity::new("base_frequency", "Frequency of the base motion", "Hz");
pub(crate) const FORCING_PERIOD: Quantity =
    Quantity::new("forcing_period", "Period of the base motion", "s");
pub(crate) const STATUS: Quantity = Quantity::one_of(
    "status",
    "How the run ended",
    &[
        "completed",
        "chattering",
        "not-finite",
        "too-many-steps",
        "no-model",
    ],
);
pub(crate) const STATUS_TEXT: Quantity =
    Quantity::text("status_text", "How the run ended, in a sentence");
pub(crate) const STABILITY: Quantity = Quantity::one_of(
    "stability",
    "All multipliers inside the unit circle, some outside, or none outside and some so near to it \
     that rounding says on which side",
    &["stable", "unstable", "neutral"],
);
pub(crate) const SEQUENCE: Quantity = Quantity::text(
    "sequence",
    "Order of the switches: T take-off, L touch-down, with the number of the jumper from 1 if there \
     are several; | between forcing periods",
);
pub(crate) const STATES: Quantity = number("states", "States of the model");
pub(crate) const PERIOD: Quantity = number("period", "Period in forcing periods");

// People and plate at cos(Omega t) = 1

pub(crate) const JUMPER: Quantity = number("jumper", "Jumper, in the order of the study");
pub(crate) const TERM: Quantity = number("term", "Transverse term of the plate");
pub(crate) const TERM_M: Quantity = number("m", "Half-waves of the term along x");
pub(crate) const TERM_N: Quantity = number("n", "Half-waves of the term along y");
pub(crate) const Z: Quantity = number("z", "Height over eta = g/omega_h^2");
pub(crate) const V: Quantity = number("v", "Velocity over eta omega_h");
pub(crate) const W: Quantity = number("w", "Plate amplitude over thickness h, by terms");
pub(crate) const PHASE: Quantity =
    Quantity::one_of("phase", "Contact or flight", &["contact", "flight", "none"]);
pub(crate) const CONTACT_RATIO: Quantity = number("contact_ratio", "Part of the time on the floor");
pub(crate) const PEAK_REACTION: Quantity = number(
    "peak_reaction",
    "Largest plate reaction force over body weight",
);
pub(crate) const PEAK_ACCELERATION: Quantity = Quantity::new(
    "peak_acceleration",
    "Largest absolute vertical acceleration of the floor under the first jumper",
    "m s-2",
);

// Time history and switches

pub(crate) const HISTORY_TIME: Quantity =
    Quantity::new("history_time", "Time since the start", "s");
pub(crate) const HISTORY_Z: Quantity = Z.named("history_z");
pub(crate) const HISTORY_V: Quantity = V.named("history_v");
pub(crate) const HISTORY_PRF: Quantity =
    number("history_prf", "Plate reaction force over body weight");
pub(crate) const HISTORY_FLOOR: Quantity =
    Quantity::new("history_floor", "Height of the plate under the feet", "m");
pub(crate) const SWITCH_TIME: Quantity = HISTORY_TIME.named("switch_time");
pub(crate) const SWITCH_JUMPER: Quantity = number("switch_jumper", "Who switches");
pub(crate) const SWITCH_KIND: Quantity = Quantity::one_of(
    "switch_kind",
    "What happens; a tangency touches the threshold and does not cross it",
    &["take-off", "touch-down", "tangency"],
);

// A run

pub(crate) const PERIODS_RUN: Quantity = number("periods_run", "Forcing periods computed");
pub(crate) const STEPS: Quantity = number("steps", "Steps of the integrator");
pub(crate) const SECTION_PERIOD: Quantity =
    number("period", "Forcing period, at whose end cos(Omega t) = 1");
pub(crate) const SECTION_TIME: Quantity = Quantity::new("time", "Time of the section", "s");
pub(crate) const PERIOD_CONTACT_RATIO: Quantity =
    number("contact_ratio", "Part of the forcing period on the floor");
pub(crate) const MEAN_CONTACT_RATIO: Quantity = number(
    "mean_contact_ratio",
    "Part of the time on the floor behind the transient",
);
pub(crate) const ENERGY_BASE: Quantity =
    joule("energy_base", "Energy of the forcing period: from the base");
pub(crate) const ENERGY_GRAVITY: Quantity = joule(
    "energy_gravity",
    "Energy of the forcing period: from gravity",
);
pub(crate) const ENERGY_PLATE: Quantity = joule(
    "energy_plate",
    "Energy of the forcing period: lost in the plate",
);
pub(crate) const ENERGY_LEGS: Quantity = joule(
    "energy_legs",
    "Energy of the forcing period: lost in the legs",
);
pub(crate) const ENERGY_DAMPERS: Quantity = joule(
    "energy_dampers",
    "Energy of the forcing period: of that in their dampers",
);
pub(crate) const ENERGY_STORED: Quantity = joule(
    "energy_stored",
    "Energy of the forcing period: gain of what is stored",
);
pub(crate) const ENERGY_RESIDUAL: Quantity = joule(
    "energy_residual",
    "Energy of the forcing period: what is left over",
);
pub(crate) const ENERGY_MAX_RESIDUAL: Quantity = joule(
    "energy_max_residual",
    "Largest absolute residual of a forcing period",
);
pub(crate) const ENERGY_MAX_TURNOVER: Quantity = joule(
    "energy_max_turnover",
    "Largest sum of absolute energies of a forcing period",
);
pub(crate) const ENERGY_MAX_RELATIVE_RESIDUAL: Quantity = number(
    "energy_max_relative_residual",
    "energy_max_residual over energy_max_turnover",
);

// Periodic orbits

pub(crate) const PERIOD_ASKED: Quantity = number(
    "period_asked",
    "Period that was asked for, in forcing periods",
);
pub(crate) const POINT: Quantity = number("point", "Place of the orbit at cos(Omega t) = 1");
pub(crate) const OUTSIDE: Quantity =
    number("outside", "Floquet multipliers outside the unit circle");
pub(crate) const IN_FAMILY: Quantity = Quantity::text(
    "in_family",
    "Whether a multiplier is 1 to its error, so that other orbits lie beside this one",
);
pub(crate) const RESIDUAL: Quantity = number(
    "residual",
    "Largest gap left between the pieces of the orbit, in h and h Omega",
);
pub(crate) const ITERATIONS: Quantity = number("iterations", "Steps of Newton's method");
pub(crate) const SEGMENTS: Quantity = number("segments", "Pieces that Newton's method joined");
pub(crate) const MULTIPLIER: Quantity = number("multiplier", "By falling modulus");
pub(crate) const MULTIPLIER_REAL: Quantity = number("multiplier_real", "Floquet multiplier, real");
pub(crate) const MULTIPLIER_IMAGINARY: Quantity =
    number("multiplier_imaginary", "Floquet multiplier, imaginary");
pub(crate) const MULTIPLIER_MODULUS: Quantity =
    number("multiplier_modulus", "Floquet multiplier, modulus");
pub(crate) const MULTIPLIER_ERROR: Quantity = number(
    "multiplier_error",
    "How far a Floquet multiplier may be off",
);
pub(crate) const TOUCH_DOWN_PHASE: Quantity = Quantity::new(
    "touch_down_phase",
    "Omega t at each touch-down, in (0, 2 pi]",
    "rad",
);

// Lyapunov exponents

pub(crate) const NATURE: Quantity = Quantity::text(
    "nature",
    "What the motion is, by tests at a confidence of 0.999: periodic, quasi-periodic, chaotic or \
     undecided",
);
pub(crate) const NATURE_TEXT: Quantity = Quantity::text(
    "nature_text",
    "What the name means, or why there is none and what may help",
);
pub(crate) const EXPONENTS_FROM: Quantity = Quantity::text(
    "exponents_from",
    "orbit: the motion has come to a cycle, and the exponents are those of its multipliers; record: \
     means of the record",
);
pub(crate) const DIVERGENCE_TEXT: Quantity = Quantity::text(
    "divergence_text",
    "Why the divergence must be the sum of the exponents, or need not",
);
pub(crate) const EXPONENT_NUMBER: Quantity =
    number("exponent_number", "The largest exponent first");
pub(crate) const EXPONENT: Quantity = number(
    "exponent",
    "Lyapunov exponent: mean growth of a small deviation per forcing period",
);
pub(crate) const EXPONENT_ERROR: Quantity = number("exponent_error", "Standard error of exponent");
pub(crate) const EXPONENT_LOW: Quantity = number(
    "exponent_low",
    "Lower end of the interval that holds it with a probability of 0.95",
);
pub(crate) const EXPONENT_HIGH: Quantity = number(
    "exponent_high",
    "Upper end of the interval that holds it with a probability of 0.95",
);
pub(crate) const EXPONENT_PER_SECOND: Quantity = Quantity::new(
    "exponent_per_second",
    "Mean growth of a small deviation per second",
    "s-1",
);
pub(crate) const EXPONENT_PER_SECOND_ERROR: Quantity = Quantity::new(
    "exponent_per_second_error",
    "Standard error of exponent_per_second",
    "s-1",
);
pub(crate) const RECORD_PERIODS: Quantity =
    number("periods", "Forcing periods of each replica so far");
pub(crate) const RUNNING_EXPONENT: Quantity = EXPONENT.named("running_exponent");
pub(crate) const RUNNING_ERROR: Quantity = number(
    "running_error",
    "Standard error of running_exponent; inf while the record is too short for one",
);
pub(crate) const EXPONENT_SUM: Quantity = number("exponent_sum", "Sum of the exponents");
pub(crate) const EXPONENT_SUM_ERROR: Quantity =
    number("exponent_sum_error", "Standard error of exponent_sum");
pub(crate) const EXPONENT_SUM_LOW: Quantity = EXPONENT_LOW.named("exponent_sum_low");
pub(crate) const EXPONENT_SUM_HIGH: Quantity = EXPONENT_HIGH.named("exponent_sum_high");
pub(crate) const EXPONENT_SUM_PER_SECOND: Quantity = Quantity::new(
    "exponent_sum_per_second",
    "Sum of the exponents per second",
    "s-1",
);
pub(crate) const EXPONENT_SUM_PER_SECOND_ERROR: Quantity =
    EXPONENT_PER_SECOND_ERROR.named("exponent_sum_per_second_error");
pub(crate) const DIVERGENCE: Quantity = number(
    "divergence",
    "Mean divergence of the flow per forcing period",
);
pub(crate) const DIVERGENCE_MUST_AGREE: Quantity = Quantity::text(
    "divergence_must_agree",
    "Whether the divergence must be the sum of the exponents",
);
pub(crate) const DIVERGENCE_DIFFERENCE: Quantity = number(
    "divergence_difference",
    "Sum of the exponents less divergence, where they must agree",
);
pub(crate) const KAPLAN_YORKE: Quantity = number("kaplan_yorke", "Dimension of Kaplan and Yorke");
pub(crate) const KAPLAN_YORKE_ERROR: Quantity =
    number("kaplan_yorke_error", "Standard error of kaplan_yorke");
pub(crate) const CONFIDENCE: Quantity =
    number("confidence", "Of the test behind the name of the motion");
pub(crate) const TRANSIENT: Quantity = number("transient", "Forcing periods left out before");
pub(crate) const PERIODS_ASKED: Quantity =
    number("periods_asked", "Forcing periods measured in each replica");
pub(crate) const PERIODS_MEASURED: Quantity = number(
    "periods_measured",
    "Forcing periods measured in all replicas together",
);
pub(crate) const REPLICAS: Quantity = number("replicas", "Pieces of the motion, run side by side");

// Natural frequencies

const MODE: Quantity = number("mode", "Mode, the lowest frequency first");
pub(crate) const PLATE_MODE: Quantity = MODE.named("plate_mode");
pub(crate) const OCCUPIED_MODE: Quantity = MODE.named("occupied_mode");
pub(crate) const IN_PLANE_MODE: Quantity = MODE.named("in_plane_mode");
pub(crate) const PLATE_FREQUENCY: Quantity =
    Quantity::new("plate", "Transverse, empty plate", "Hz");
pub(crate) const OCCUPIED_FREQUENCY: Quantity =
    Quantity::new("occupied", "Transverse, people standing on the plate", "Hz");
pub(crate) const IN_PLANE_FREQUENCY: Quantity =
    Quantity::new("in_plane", "In the plane of the plate", "Hz");
pub(crate) const FREE_FREQUENCY: Quantity = Quantity::new("free", "Body on rigid ground", "Hz");
pub(crate) const BODY_FREQUENCY: Quantity = Quantity::new(
    "body",
    "Of those occupied, the one in which the first jumper moves most",
    "Hz",
);
pub(crate) const BASE: Quantity = Quantity::new("base", "Base motion", "Hz");

// Sweeps

pub(crate) const PASS: Quantity = number("pass", "Way through the values");
pub(crate) const DIRECTION: Quantity = Quantity::one_of(
    "direction",
    "Up and down carry the state on; start begins anew at each value",
    &["up", "down", "start"],
);
pub(crate) const START_Z: Quantity = number("start_z", "First height over eta");
pub(crate) const START_V: Quantity = number("start_v", "First velocity over eta omega_h");
pub(crate) const SAMPLE: Quantity = number(
    "sample",
    "Forcing period of the record, at whose end cos(Omega t) = 1",
);
pub(crate) const LABEL: Quantity = Quantity::one_of(
    "label",
    "Kind of the motion that goes on from the last state",
    &["none", "periodic", "quasi-periodic", "chaotic", "undecided"],
);

// Attractors

/// In the unit of the parameter.
const fn of_parameter(name: &'static str, meaning: &'static str) -> Quantity {
    Quantity::new(name, meaning, "")
}

pub(crate) const VALUE: Quantity = of_parameter("value", "Value of the parameter");
pub(crate) const ATTRACTOR: Quantity = number(
    "attractor",
    "Number of the attractor, which stays along the parameter",
);
pub(crate) const STARTS_ASKED: Quantity = number("starts_asked", "First states at each value");
pub(crate) const UNSEEN: Quantity = number(
    "unseen",
    "With 95 % confidence a basin that no first state met has a smaller part of the box",
);
pub(crate) const UNFINISHED: Quantity = number(
    "unfinished",
    "Motions still carried on when it took too long; if not 0, an attractor may have several numbers",
);
pub(crate) const STARTS: Quantity = number(
    "starts",
    "First states that lead to it; 0 if it was met from another value alone",
);
pub(crate) const SHARE: Quantity = number("share", "Share of the first states");
pub(crate) const SHARE_LOW: Quantity =
    number("share_low", "Lower end of its 95 % confidence interval");
pub(crate) const SHARE_HIGH: Quantity =
    number("share_high", "Upper end of its 95 % confidence interval");
pub(crate) const ATTRACTOR_KIND: Quantity = Quantity::one_of(
    "kind",
    "Kind of the motion",
    &[
        "not-met",
        "periodic",
        "quasi-periodic",
        "chaotic",
        "not-periodic",
    ],
);
pub(crate) const LARGEST_MULTIPLIER: Quantity = number(
    "multiplier",
    "Largest modulus of the Floquet multipliers of a cycle",
);
pub(crate) const LARGEST_EXPONENT: Quantity = number(
    "exponent",
    "Largest Lyapunov exponent per forcing period, where there is no cycle",
);
pub(crate) const WATCHED_MOTIONS: Quantity = number(
    "watched_motions",
    "Motions watched on chaos, none of which left it",
);
pub(crate) const WATCHED_PERIODS: Quantity = number(
    "watched_periods",
    "Forcing periods of chaos of all watched motions",
);
pub(crate) const LIFETIME_LOW: Quantity = number(
    "lifetime_low",
    "Forcing periods that the mean lifetime of chaos exceeds with 95 % confidence",
);
pub(crate) const MOTION: Quantity = number("motion", "Attractors of all values");
pub(crate) const MOTION_ATTRACTOR: Quantity = ATTRACTOR.named("motion_attractor");
pub(crate) const CONNECTED_SAMPLE: Quantity = number(
    "sample",
    "Samples at cos(Omega t) = 1; those of a cycle connect along the parameter",
);
pub(crate) const TRANSIENT_STARTS: Quantity = number(
    "transient_starts",
    "First states that were in it when their search was over",
);
pub(crate) const TRANSIENT_SHARE: Quantity = SHARE.named("transient_share");
pub(crate) const TRANSIENT_SHARE_LOW: Quantity = SHARE_LOW.named("transient_share_low");
pub(crate) const TRANSIENT_SHARE_HIGH: Quantity = SHARE_HIGH.named("transient_share_high");
pub(crate) const TRANSIENT_ATTRACTOR: Quantity = number(
    "transient_attractor",
    "Attractor that they count for: most watched motions ended on it",
);
pub(crate) const TRANSIENT_MOTIONS: Quantity =
    number("transient_motions", "Motions watched on chaos");
pub(crate) const TRANSIENT_ENDED: Quantity =
    number("transient_ended", "Watched motions that left it");
pub(crate) const TRANSIENT_PERIODS: Quantity = WATCHED_PERIODS.named("transient_periods");
pub(crate) const TRANSIENT_LIFETIME: Quantity =
    number("transient_lifetime", "Mean lifetime in forcing periods");
pub(crate) const TRANSIENT_LIFETIME_LOW: Quantity = SHARE_LOW.named("transient_lifetime_low");
pub(crate) const TRANSIENT_LIFETIME_HIGH: Quantity = SHARE_HIGH.named("transient_lifetime_high");
pub(crate) const FIRST: Quantity = of_parameter("first", "First value at which it was met");
pub(crate) const LAST: Quantity = of_parameter("last", "Last value at which it was met");
pub(crate) const BIRTH_LOW: Quantity = of_parameter(
    "birth_low",
    "Lower end of the values between which it begins; none at the first value",
);
pub(crate) const BIRTH_HIGH: Quantity = of_parameter(
    "birth_high",
    "Upper end of the values between which it begins",
);
pub(crate) const BIRTH_TO: Quantity = number(
    "birth_to",
    "Attractor that its motion jumps to when carried on below, 0 if that is not known",
);
pub(crate) const DEATH_LOW: Quantity = of_parameter(
    "death_low",
    "Lower end of the values between which it ends; none at the last value",
);
pub(crate) const DEATH_HIGH: Quantity = of_parameter(
    "death_high",
    "Upper end of the values between which it ends",
);
pub(crate) const DEATH_TO: Quantity = number(
    "death_to",
    "Attractor that its motion jumps to when carried on above, 0 if that is not known",
);
pub(crate) const LOOP_FROM: Quantity =
    of_parameter("loop_from", "First value at which the two ways differ");
pub(crate) const LOOP_TO: Quantity =
    of_parameter("loop_to", "Last value at which the two ways differ");
pub(crate) const LOOP_UP: Quantity = number("loop_up", "Attractor of a motion carried upwards");
pub(crate) const LOOP_DOWN: Quantity =
    number("loop_down", "Attractor of a motion carried downwards");
pub(crate) const LOOP_PERIOD_UP: Quantity = number(
    "loop_period_up",
    "Period where the motion carried upwards jumps, in forcing periods; 0 if it has none",
);
pub(crate) const LOOP_PERIOD_DOWN: Quantity = number(
    "loop_period_down",
    "Period where the motion carried downwards jumps, in forcing periods; 0 if it has none",
);
pub(crate) const LOOP_JUMP_UP_LOW: Quantity = of_parameter(
    "loop_jump_up_low",
    "Lower end of the values between which the motion carried upwards jumps; none if it does not",
);
pub(crate) const LOOP_JUMP_UP_HIGH: Quantity = of_parameter(
    "loop_jump_up_high",
    "Upper end of the values between which the motion carried upwards jumps",
);
pub(crate) const LOOP_JUMP_DOWN_LOW: Quantity = of_parameter(
    "loop_jump_down_low",
    "Lower end of the values between which the motion carried downwards jumps; none if it does not",
);
pub(crate) const LOOP_JUMP_DOWN_HIGH: Quantity = of_parameter(
    "loop_jump_down_high",
    "Upper end of the values between which the motion carried downwards jumps",
);
pub(crate) const UNDECIDED_STARTS: Quantity =
    number("undecided_starts", "First states left undecided");
pub(crate) const UNDECIDED: Quantity =
    number("undecided", "Share of the first states left undecided");
pub(crate) const UNDECIDED_LOW: Quantity = SHARE_LOW.named("undecided_low");
pub(crate) const UNDECIDED_HIGH: Quantity = SHARE_HIGH.named("undecided_high");
pub(crate) const LOST_STARTS: Quantity =
    number("lost_starts", "First states whose run ended early");
pub(crate) const LOST: Quantity = number("lost", "Share of the first states whose run ended early");
pub(crate) const LOST_LOW: Quantity = SHARE_LOW.named("lost_low");
pub(crate) const LOST_HIGH: Quantity = SHARE_HIGH.named("lost_high");
pub(crate) const FIRST_FAILURE_STATUS: Quantity = Quantity::text(
    "first_failure_status",
    "How the first of these runs ended, or that there is no model",
);
pub(crate) const FIRST_FAILURE_STATUS_TEXT: Quantity =
    Quantity::text("first_failure_status_text", "The same in a sentence");

// Branches of periodic orbits

pub(crate) const RANGE_FROM: Quantity =
    Quantity::new("from", "One end of the range of the parameter", "");
pub(crate) const RANGE_TO: Quantity = Quantity::new("to", "The other end of the range", "");
pub(crate) const SECOND_FROM: Quantity = RANGE_FROM.named("second_from");
pub(crate) const SECOND_TO: Quantity = RANGE_TO.named("second_to");
pub(crate) const COMPLETE: Quantity = Quantity::text(
    "complete",
    "Whether no branch was left out because there were too many",
);
pub(crate) const PLACE: Quantity = POINT.named("place");
pub(crate) const BRANCH: Quantity = number("branch", "Branch, the first one 0");
pub(crate) const BRANCH_NUMBER: Quantity = BRANCH.named("branch_number");
pub(crate) const BRANCH_POINT: Quantity = number("point", "Points of all branches");
pub(crate) const NUMBER_ON_BRANCH: Quantity =
    number("number", "Number of the point on its branch, from 0");
pub(crate) const STABLE: Quantity = Quantity::text("stable", "Whether the orbit is stable");
pub(crate) const NEUTRAL: Quantity = Quantity::text(
    "neutral",
    "Whether rounding alone says if the orbit is stable",
);
pub(crate) const STABLE_CELL: Quantity = Quantity::text(
    "stable_cell",
    "Whether the orbit is stable; neutral where rounding alone says it",
);
pub(crate) const LARGEST_REAL: Quantity =
    number("largest_real", "Largest Floquet multiplier, real");
pub(crate) const LARGEST_IMAGINARY: Quantity =
    number("largest_imaginary", "Largest Floquet multiplier, imaginary");
pub(crate) const BRANCH_ORIGIN: Quantity = Quantity::text(
    "branch_origin",
    "Label of the special point where the branch begins; empty if it begins at none",
);
pub(crate) const ORIGIN: Quantity = BRANCH_ORIGIN.named("origin");
pub(crate) const BRANCH_PERIOD: Quantity = PERIOD.named("branch_period");
pub(crate) const BRANCH_POINTS: Quantity = number("branch_points", "Points of the branch");
pub(crate) const BRANCH_FIRST: Quantity = Quantity::new(
    "branch_first",
    "Value of the parameter at its first point",
    "",
);
pub(crate) const BRANCH_LAST: Quantity = Quantity::new(
    "branch_last",
    "Value of the parameter at its last point",
    "",
);
pub(crate) const BRANCH_END_FIRST: Quantity =
    Quantity::text("branch_end_first", "Why it ends before the first point");
pub(crate) const BRANCH_END_LAST: Quantity =
    Quantity::text("branch_end_last", "Why it ends after the last point");
pub(crate) const SPECIAL_LABEL: Quantity =
    Quantity::text("special_label", "Label of the special point");
pub(crate) const SPECIAL_KIND: Quantity =
    Quantity::text("special_kind", "Kind of the special point, in short");
pub(crate) const SPECIAL_NAME: Quantity =
    Quantity::text("special_name", "Kind of the special point");
pub(crate) const SPECIAL_BRANCH: Quantity = BRANCH.named("special_branch");
pub(crate) const SPECIAL_PERIOD: Quantity = PERIOD.named("special_period");
pub(crate) const SPECIAL_OUTSIDE_BEFORE: Quantity = number(
    "special_outside_before",
    "Floquet multipliers outside the unit circle before it, in the order of the branch",
);
pub(crate) const SPECIAL_OUTSIDE_AFTER: Quantity = number(
    "special_outside_after",
    "Floquet multipliers outside the unit circle behind it, in the order of the branch",
);
pub(crate) const SPECIAL_ANGLE: Quantity = Quantity::new(
    "special_angle",
    "Angle of the multiplier on the unit circle, of Neimark-Sacker points",
    "rad",
);
pub(crate) const SPECIAL_SEQUENCE: Quantity = SEQUENCE.named("special_sequence");
pub(crate) const SPECIAL_REMARK: Quantity =
    Quantity::text("special_remark", "Remark on the special point");
pub(crate) const SPECIAL_ORBIT_VALUE: Quantity = Quantity::new(
    "special_orbit_value",
    "Value of the parameter of the orbit at hand, the last one before a grazing",
    "",
);
pub(crate) const SPECIAL_MODES: Quantity = number(
    "special_modes",
    "Mode of each jumper in the model, to begin with this orbit again; -1 where it has no such place",
);
pub(crate) const SPECIAL_X: Quantity = number(
    "special_x",
    "State in the units of the model, to begin with this orbit again",
);
pub(crate) const CURVE: Quantity = number("curve", "Curve, the first one 0");
pub(crate) const CURVE_OF: Quantity = Quantity::text(
    "curve_of",
    "Label of the special point that the curve is of, or the word of the study that means none",
);
pub(crate) const CURVE_KIND: Quantity = SPECIAL_KIND.named("curve_kind");
pub(crate) const CURVE_POINTS: Quantity = number("curve_points", "Points of the curve");
pub(crate) const CURVE_END_FIRST: Quantity = BRANCH_END_FIRST.named("curve_end_first");
pub(crate) const CURVE_END_LAST: Quantity = BRANCH_END_LAST.named("curve_end_last");
pub(crate) const CURVE_ERROR: Quantity = Quantity::text("curve_error", "Why there is no curve");
pub(crate) const CURVE_LABEL: Quantity = Quantity::text(
    "curve_label",
    "Label of the special point that the curve is of",
);
pub(crate) const CURVE_POINT_KIND: Quantity = CURVE_KIND.named("curve_point_kind");
pub(crate) const CURVE_NUMBER: Quantity = CURVE.named("curve_number");
pub(crate) const NUMBER_ON_CURVE: Quantity = number(
    "number_on_curve",
    "Number of the point on its curve, from 0",
);
pub(crate) const CURVE_PERIOD: Quantity = PERIOD.named("curve_period");
pub(crate) const CURVE_ANGLE: Quantity = SPECIAL_ANGLE.named("curve_angle");

// Maps and basins: the plane

const fn axis(from: &'static str, to: &'static str, count: &'static str) -> [Quantity; 3] {
    [
        Quantity::new(from, "First value along the axis", ""),
        Quantity::new(to, "Last value along the axis", ""),
        number(count, "Values along the axis"),
    ]
}

pub(crate) const X_AXIS: [Quantity; 3] = axis("x_from", "x_to", "x_count");
pub(crate) const Y_AXIS: [Quantity; 3] = axis("y_from", "y_to", "y_count");
pub(crate) const PLANE_TRANSIENT: Quantity = number(
    "transient",
    "Forcing periods left out at each pixel, at most",
);
pub(crate) const PLANE_RECORD: Quantity = number(
    "record",
    "Forcing periods recorded where the motion has not settled",
);
pub(crate) const PIXELS: Quantity = number("pixels", "Pixels of the plane");
pub(crate) const PERIODS_RUN_TOTAL: Quantity =
    number("periods_run_total", "Forcing periods computed in all");

// Maps and basins: layers

pub(crate) const PIXEL_PERIOD: Quantity = number(
    "period",
    "Period of the attractor in forcing periods, 0 where it has none up to 32",
);
pub(crate) const PIXEL_STATUS: Quantity = Quantity::one_of(
    "status",
    "What became of the motion",
    &[
        "periodic",
        "quasi-periodic",
        "chaotic",
        "not-periodic",
        "undecided",
        "no-model",
        "chattering",
        "not-finite",
        "too-many-steps",
        "ended",
    ],
);
pub(crate) const PIXEL_EXPONENT: Quantity = number(
    "exponent",
    "Largest Lyapunov exponent per forcing period, where it says what the motion is",
);
pub(crate) const CHAOTIC_PERIODS: Quantity = number(
    "chaotic_periods",
    "Forcing periods over which a chaotic motion was seen not to settle, 0 where it is not chaotic",
);

// Maps and basins: what the layers add up to

pub(crate) const OUTCOME: Quantity = PIXEL_STATUS.named("outcome");
pub(crate) const OUTCOME_PIXELS: Quantity = number("outcome_pixels", "Pixels of which this became");
pub(crate) const CYCLE_PERIOD: Quantity = number(
    "cycle_period",
    "Period of cycles that occur, in forcing periods",
);
pub(crate) const CYCLE_PIXELS: Quantity = number("cycle_pixels", "Pixels with this period");
pub(crate) const CYCLE_SHARE: Quantity = number("cycle_share", "Their part of all pixels");
pub(crate) const CHAOTIC_OVER_MIN: Quantity = number(
    "chaotic_over_min",
    "Fewest chaotic_periods of a chaotic pixel",
);
pub(crate) const CHAOTIC_OVER_MAX: Quantity = number(
    "chaotic_over_max",
    "Most chaotic_periods of a chaotic pixel",
);
pub(crate) const CONTACT_RATIO_RANGE: [Quantity; 2] = [
    number("contact_ratio_min", "Smallest contact_ratio of all pixels"),
    number("contact_ratio_max", "Largest contact_ratio of all pixels"),
];
pub(crate) const PEAK_REACTION_RANGE: [Quantity; 2] = [
    number("peak_reaction_min", "Smallest peak_reaction of all pixels"),
    number("peak_reaction_max", "Largest peak_reaction of all pixels"),
];
pub(crate) const PEAK_ACCELERATION_RANGE: [Quantity; 2] = [
    Quantity::new(
        "peak_acceleration_min",
        "Smallest peak_acceleration of all pixels",
        "m s-2",
    ),
    Quantity::new(
        "peak_acceleration_max",
        "Largest peak_acceleration of all pixels",
        "m s-2",
    ),
];
pub(crate) const PLANE_FAILURE_X: Quantity = Quantity::new(
    "first_failure_x",
    "Place along x of the first pixel without a motion",
    "",
);
pub(crate) const PLANE_FAILURE_Y: Quantity = Quantity::new(
    "first_failure_y",
    "Place along y of the first pixel without a motion",
    "",
);
pub(crate) const PLANE_FAILURE_STATUS: Quantity = Quantity::text(
    "first_failure_status",
    "What became of the first pixel without a motion; empty if there is none",
);
pub(crate) const PLANE_FAILURE_TEXT: Quantity =
    Quantity::text("first_failure_status_text", "The same in a sentence");

// Basins

pub(crate) const BASIN: Quantity = number(
    "attractor",
    "Number of the attractor in the table attractors, 0 for none",
);
pub(crate) const BASIN_NUMBER: Quantity = number(
    "attractor_number",
    "Number of the attractor, by its share of the pixels",
);
pub(crate) const BASIN_MATCHED: Quantity = number(
    "attractor_matched",
    "Its number along the sweep of [attractors]; 0 if it was not met there or nobody asked",
);
pub(crate) const BASIN_PERIOD: Quantity = number(
    "attractor_period",
    "Period in forcing periods; 0 if not periodic",
);
pub(crate) const BASIN_KIND: Quantity = Quantity::one_of(
    "attractor_kind",
    "What kind of motion it is",
    &[
        "periodic",
        "quasi-periodic",
        "chaotic",
        "not-periodic",
        "undecided",
    ],
);
pub(crate) const BASIN_PIXELS: Quantity = number("attractor_pixels", "Pixels that lead to it");
pub(crate) const BASIN_SHARE: Quantity = number("attractor_share", "Their part of all pixels");
pub(crate) const BASIN_CONTACT_RATIO: Quantity = CONTACT_RATIO.named("attractor_contact_ratio");
pub(crate) const BASIN_PEAK_REACTION: Quantity = PEAK_REACTION.named("attractor_peak_reaction");
pub(crate) const BASIN_PEAK_ACCELERATION: Quantity =
    PEAK_ACCELERATION.named("attractor_peak_acceleration");
pub(crate) const BASIN_SAMPLE: Quantity = number(
    "sample",
    "Sample of a cycle at cos(Omega t) = 1, the lowest first",
);
pub(crate) const BASIN_SAMPLE_CELL: Quantity = BASIN_SAMPLE.named("sample_cell");
pub(crate) const BASIN_Z: Quantity = Z.named("attractor_z");
pub(crate) const BASIN_V: Quantity = V.named("attractor_v");
pub(crate) const BASIN_Z_RANGE: [Quantity; 2] = [
    number("attractor_z_min", "Smallest z of its samples"),
    number("attractor_z_max", "Largest z of its samples"),
];
pub(crate) const BASIN_V_RANGE: [Quantity; 2] = [
    number("attractor_v_min", "Smallest v of its samples"),
    number("attractor_v_max", "Largest v of its samples"),
];

// The figures of the paper

pub(crate) const PANEL: Quantity = Quantity::text("panel", "Panel of the figure");
pub(crate) const PASS_TEXT: Quantity = Quantity::text(
    "pass_text",
    "Way through the values: up, down, or its first state",
);
const RATIO: Quantity = number("frequency_ratio", "Frequency of the base over omega_h");
const DAMPING: Quantity = number("damping_ratio", "Damping ratio zeta_h of the person");
const STRETCH: &str = "between these damping ratios all multipliers of the cycle lie inside the \
                       unit circle";
pub(crate) const REGIME_LAW: Quantity = Quantity::text("regime_law", "Contact law");
pub(crate) const REGIME_REFERENCE: Quantity =
    Quantity::text("regime_reference", "Which frequency of the body omega_h is");
pub(crate) const REGIME_RATIO: Quantity = RATIO.named("regime_frequency_ratio");
pub(crate) const REGIME_BASE: Quantity = BASE_FREQUENCY.named("regime_base_frequency");
pub(crate) const REGIME_PERIOD: Quantity = PERIOD.named("regime_period");
pub(crate) const REGIME_FROM: Quantity = number("regime_from", STRETCH);
pub(crate) const REGIME_FROM_IS: Quantity =
    Quantity::text("regime_from_is", "What happens at regime_from");
pub(crate) const REGIME_TO: Quantity = number("regime_to", STRETCH);
pub(crate) const REGIME_TO_IS: Quantity =
    Quantity::text("regime_to_is", "What happens at regime_to");
pub(crate) const SWEEP_RATIO: Quantity = RATIO.named("sweep_frequency_ratio");
pub(crate) const SWEEP_PASS: Quantity = PASS_TEXT.named("sweep_pass");
pub(crate) const SWEEP_DAMPING: Quantity = DAMPING.named("sweep_damping_ratio");
pub(crate) const SWEEP_CYCLE: Quantity = number(
    "sweep_cycle",
    "Period of the stable cycle that the motion is on, to 0.05 eta; none if on none",
);
pub(crate) const SWEEP_SLOW: Quantity = number(
    "sweep_slow",
    "Periods after which a motion on no stable cycle repeats to 1e-3 eta: one still on its way",
);
pub(crate) const TRANSITION_RATIO: Quantity = RATIO.named("transition_frequency_ratio");
pub(crate) const TRANSITION_LABEL: Quantity =
    Quantity::text("transition_label", "Label of the special point");
pub(crate) const TRANSITION_KIND: Quantity =
    Quantity::text("transition_kind", "Kind of the special point");
pub(crate) const TRANSITION_PERIOD: Quantity = PERIOD.named("transition_period");
pub(crate) const TRANSITION_DAMPING: Quantity = number(
    "transition_damping_ratio",
    "Damping ratio of the special point, by continuation with the tangent flow",
);
pub(crate) const TRANSITION_SECOND: Quantity = number(
    "transition_second",
    "The same from orbits at given damping ratios, derivatives by differences; none if not found so",
);
const YES: &[&str] = &["no", "yes"];
pub(crate) const TRANSITION_SEEN: Quantity = Quantity::one_of(
    "transition_seen",
    "Whether the orbit is stable on one side at least",
    YES,
);
pub(crate) const TRANSITION_SWITCHES: Quantity =
    Quantity::text("transition_switches", "Order of the switches");
pub(crate) const BRANCH_RATIO: Quantity = RATIO.named("branch_frequency_ratio");
pub(crate) const PAPER_BRANCH_POINT: Quantity = number(
    "branch_point_number",
    "Number of the point on its branch, from 0",
);
pub(crate) const BRANCH_DAMPING: Quantity = DAMPING.named("branch_damping_ratio");
pub(crate) const BRANCH_STABLE: Quantity =
    Quantity::one_of("branch_stable", "Whether the orbit is stable", YES);
pub(crate) const BRANCH_PLACE: Quantity = POINT.named("branch_place");
pub(crate) const BRANCH_Z: Quantity = Z.named("branch_z");
pub(crate) const EXPONENT_PERIODS: Quantity = number(
    "exponent_periods",
    "Forcing periods over which each exponent was measured",
);
pub(crate) const EXPONENT_RATIO: Quantity = RATIO.named("exponent_frequency_ratio");
pub(crate) const EXPONENT_DAMPING: Quantity = DAMPING.named("exponent_damping_ratio");
pub(crate) const FIG3_PANEL: Quantity = PANEL.named("fig3_panel");
pub(crate) const FIG3_RATIO: Quantity = RATIO.named("fig3_frequency_ratio");
pub(crate) const FIG3_DAMPING: Quantity = DAMPING.named("fig3_damping_ratio");
pub(crate) const FIG3_Z: Quantity = Z.named("fig3_z");
pub(crate) const FIG3_V: Quantity = V.named("fig3_v");
pub(crate) const INERTIA_RATIO: Quantity = RATIO.named("inertia_frequency_ratio");
pub(crate) const INERTIA_DAMPING: Quantity = DAMPING.named("inertia_damping_ratio");
pub(crate) const INERTIA_DIFFERENCE: Quantity = number(
    "inertia_difference",
    "Largest difference of the sections over eta; none where they are not both periodic",
);
pub(crate) const INERTIA_FULL: Quantity = CONTACT_RATIO.named("inertia_contact_ratio_full");
pub(crate) const INERTIA_CONDENSED: Quantity =
    CONTACT_RATIO.named("inertia_contact_ratio_condensed");
