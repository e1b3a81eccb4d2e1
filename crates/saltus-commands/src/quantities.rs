//! All quantities that answers have: name, unit and meaning of each, said here and nowhere else.
//!
//! A name is one thing wherever it is found. A quantity of the same kind at another place, as of a special point or a
//! loop, is the same under another name. Units are spelt as UDUNITS does: "1" for a ratio, "" for a text, a yes or no,
//! and for values of a parameter that changes, which have its unit.

use saltus_results::Quantity;

/// A quantity: its key, then its unit or its words and its meaning, or the one that it is like.
macro_rules! quantity {
    ($key:literal = $same:ident) => {
        $same.named($key)
    };
    ($key:literal [$($word:literal),+] $meaning:literal) => {
        Quantity::one_of($key, $meaning, &[$($word),+])
    };
    ($key:literal $unit:literal $meaning:literal) => {
        Quantity::new($key, $meaning, $unit)
    };
}

/// Quantities, and the list of them for the help if it has a name.
macro_rules! quantities {
    ({ $($name:ident: $key:literal $what:tt $meaning:tt;)+ }) => {
        $(pub(crate) const $name: Quantity = quantity!($key $what $meaning);)+
    };
    ($list:ident { $($name:ident: $key:literal $what:tt $meaning:tt;)+ }) => {
        $(pub(crate) const $name: Quantity = quantity!($key $what $meaning);)+
        pub(crate) const $list: &[Quantity] = &[$($name),+];
    };
}

// Shared by several answers

quantities! { {
    STATUS: "status" ["completed", "chattering", "not-finite", "too-many-steps", "no-model"] "How the run ended";
    STATUS_TEXT: "status_text" "" "How the run ended, in a sentence";
    STATES: "states" "1" "States of the model";
    PERIOD: "period" "1" "Period in forcing periods";
    CONFIDENCE: "confidence" "1" "Of the test behind the name of the motion";
    CONTACT_RATIO: "contact_ratio" "1" "Part of the time on the floor";
    PEAK_REACTION: "peak_reaction" "1" "Largest plate reaction force over body weight";
    PEAK_ACCELERATION: "peak_acceleration" "m s-2"
        "Largest absolute vertical acceleration of the floor under the first jumper";
    PERIODS_RUN: "periods_run" "1" "Forcing periods computed";
} }

// The base

quantities! { BASE_MOTION {
    BASE_FREQUENCY: "base_frequency" "Hz" "Frequency of the base motion";
    FORCING_PERIOD: "forcing_period" "s" "Period of the base motion";
} }

// People and plate at cos(Omega t) = 1

quantities! { SECTION {
    JUMPER: "jumper" "1" "Jumper, in the order of the study";
    TERM: "term" "1" "Transverse term of the plate";
    TERM_M: "m" "1" "Half-waves of the term along x";
    TERM_N: "n" "1" "Half-waves of the term along y";
    ETA: "eta" "m" "Unit of height, eta = g/omega_h^2: z times eta is the height";
    Z: "z" "1" "Height over eta = g/omega_h^2";
    V: "v" "1" "Velocity over eta omega_h";
    W: "w" "1" "Plate amplitude relative to the base over thickness h, by terms";
    PHASE: "phase" ["contact", "flight", "none"] "Contact or flight";
} }

// Time history and switches

quantities! { HISTORY {
    HISTORY_TIME: "history_time" "s" "Time since the start";
    HISTORY_Z: "history_z" = Z;
    HISTORY_V: "history_v" = V;
    HISTORY_PHASE: "history_phase" = PHASE;
    HISTORY_PRF: "history_prf" "1" "Plate reaction force over body weight";
    HISTORY_W: "history_w" = W;
    HISTORY_BASE: "history_base" "m" "Height of the base";
    HISTORY_FLOOR: "history_floor" "m" "Height of the plate under the feet, motion of the base included";
    HISTORY_FLOOR_ACCELERATION: "history_floor_acceleration" "m s-2"
        "Absolute vertical acceleration of the plate under the feet, motion of the base included";
    HISTORY_FLOOR_RELATIVE: "history_floor_acceleration_relative" "m s-2"
        "Vertical acceleration of the plate under the feet relative to the base";
    SWITCH_TIME: "switch_time" = HISTORY_TIME;
    SWITCH_JUMPER: "switch_jumper" "1" "Who switches";
    SWITCH_KIND: "switch_kind" ["take-off", "touch-down", "tangency"]
        "What happens; a tangency touches the threshold and does not cross it";
} }

// A run

quantities! { RUN {
    STEPS: "steps" "1" "Steps of the integrator";
    SECTION_PERIOD: "period" "1" "Forcing period, at whose end cos(Omega t) = 1";
    SECTION_TIME: "time" "s" "Time of the section";
    PERIOD_CONTACT_RATIO: "contact_ratio" "1" "Part of the forcing period on the floor";
    MEAN_CONTACT_RATIO: "mean_contact_ratio" "1" "Part of the time on the floor behind the transient";
    ENERGY_BASE: "energy_base" "J" "Energy of the forcing period: from the base";
    ENERGY_GRAVITY: "energy_gravity" "J" "Energy of the forcing period: from gravity";
    ENERGY_PLATE: "energy_plate" "J" "Energy of the forcing period: lost in the plate";
    ENERGY_LEGS: "energy_legs" "J" "Energy of the forcing period: lost in the legs";
    ENERGY_DAMPERS: "energy_dampers" "J" "Energy of the forcing period: of that in their dampers";
    ENERGY_STORED: "energy_stored" "J" "Energy of the forcing period: gain of what is stored";
    ENERGY_RESIDUAL: "energy_residual" "J" "Energy of the forcing period: what is left over";
    ENERGY_MAX_RESIDUAL: "energy_max_residual" "J" "Largest absolute residual of a forcing period";
    ENERGY_MAX_TURNOVER: "energy_max_turnover" "J" "Largest sum of absolute energies of a forcing period";
    ENERGY_MAX_RELATIVE_RESIDUAL: "energy_max_relative_residual" "1" "energy_max_residual over energy_max_turnover";
} }

// Orbits and branches of them

quantities! { ORBITS {
    STABILITY: "stability" ["stable", "unstable", "neutral"]
        "All multipliers inside the unit circle, some outside, or none outside and some so near to it that rounding \
         says on which side";
    SEQUENCE: "sequence" ""
        "Order of the switches: T take-off, L touch-down, with the number of the jumper from 1 if there are several; \
         | between forcing periods";
    OUTSIDE: "outside" "1" "Floquet multipliers outside the unit circle";
    MULTIPLIER: "multiplier" "1" "By falling modulus";
    MULTIPLIER_REAL: "multiplier_real" "1" "Floquet multiplier, real";
    MULTIPLIER_IMAGINARY: "multiplier_imaginary" "1" "Floquet multiplier, imaginary";
} }

// One periodic orbit

quantities! { ORBIT {
    PERIOD_ASKED: "period_asked" "1" "Period that was asked for, in forcing periods";
    POINT: "point" "1" "Place of the orbit at cos(Omega t) = 1";
    IN_FAMILY: "in_family" "" "Whether a multiplier is 1 to its error, so that other orbits lie beside this one";
    RESIDUAL: "residual" "1" "Largest gap left between the pieces of the orbit, in h and h Omega";
    ITERATIONS: "iterations" "1" "Steps of Newton's method";
    SEGMENTS: "segments" "1" "Pieces that Newton's method joined";
    MULTIPLIER_MODULUS: "multiplier_modulus" "1" "Floquet multiplier, modulus";
    MULTIPLIER_ERROR: "multiplier_error" "1" "How far a Floquet multiplier may be off";
    TOUCH_DOWN_PHASE: "touch_down_phase" "rad" "Omega t at each touch-down, in (0, 2 pi]";
} }

// Lyapunov exponents of several answers

quantities! { EXPONENTS {
    EXPONENT_NUMBER: "exponent_number" "1" "The largest exponent first";
    EXPONENT: "exponent" "1" "Lyapunov exponent: mean growth of a small deviation per forcing period";
    EXPONENT_ERROR: "exponent_error" "1" "Standard error of exponent";
} }

// Lyapunov exponents, sum and convergence

quantities! { SPECTRUM {
    NATURE: "nature" ""
        "What the motion is, by tests at a confidence of 0.999: periodic, quasi-periodic, chaotic or undecided";
    NATURE_TEXT: "nature_text" "" "What the name means, or why there is none and what may help";
    EXPONENTS_FROM: "exponents_from" ""
        "orbit: the motion has come to a cycle, and the exponents are those of its multipliers; record: means of the \
         record";
    DIVERGENCE_TEXT: "divergence_text" "" "Why the divergence must be the sum of the exponents, or need not";
    EXPONENT_LOW: "exponent_low" "1" "Lower end of the interval that holds it with a probability of 0.95";
    EXPONENT_HIGH: "exponent_high" "1" "Upper end of the interval that holds it with a probability of 0.95";
    EXPONENT_PER_SECOND: "exponent_per_second" "s-1" "Mean growth of a small deviation per second";
    EXPONENT_PER_SECOND_ERROR: "exponent_per_second_error" "s-1" "Standard error of exponent_per_second";
    RECORD_PERIODS: "periods" "1" "Forcing periods of each replica so far";
    RUNNING_EXPONENT: "running_exponent" = EXPONENT;
    RUNNING_ERROR: "running_error" "1"
        "Standard error of running_exponent; inf while the record is too short for one";
    EXPONENT_SUM: "exponent_sum" "1" "Sum of the exponents";
    EXPONENT_SUM_ERROR: "exponent_sum_error" "1" "Standard error of exponent_sum";
    EXPONENT_SUM_LOW: "exponent_sum_low" = EXPONENT_LOW;
    EXPONENT_SUM_HIGH: "exponent_sum_high" = EXPONENT_HIGH;
    EXPONENT_SUM_PER_SECOND: "exponent_sum_per_second" "s-1" "Sum of the exponents per second";
    EXPONENT_SUM_PER_SECOND_ERROR: "exponent_sum_per_second_error" = EXPONENT_PER_SECOND_ERROR;
    DIVERGENCE: "divergence" "1" "Mean divergence of the flow per forcing period";
    DIVERGENCE_MUST_AGREE: "divergence_must_agree" "" "Whether the divergence must be the sum of the exponents";
    DIVERGENCE_DIFFERENCE: "divergence_difference" "1" "Sum of the exponents less divergence, where they must agree";
    KAPLAN_YORKE: "kaplan_yorke" "1" "Dimension of Kaplan and Yorke";
    KAPLAN_YORKE_ERROR: "kaplan_yorke_error" "1" "Standard error of kaplan_yorke";
    TRANSIENT: "transient" "1" "Forcing periods left out before";
    PERIODS_ASKED: "periods_asked" "1" "Forcing periods measured in each replica";
    PERIODS_MEASURED: "periods_measured" "1" "Forcing periods measured in all replicas together";
    REPLICAS: "replicas" "1" "Pieces of the motion, run side by side";
} }

// Natural frequencies

quantities! { FREQUENCIES {
    MODE: "mode" "1" "Mode, the lowest frequency first";
    PLATE_MODE: "plate_mode" = MODE;
    OCCUPIED_MODE: "occupied_mode" = MODE;
    IN_PLANE_MODE: "in_plane_mode" = MODE;
    PLATE_FREQUENCY: "plate" "Hz" "Transverse, empty plate";
    OCCUPIED_FREQUENCY: "occupied" "Hz" "Transverse, people standing on the plate";
    IN_PLANE_FREQUENCY: "in_plane" "Hz" "In the plane of the plate";
    FREE_FREQUENCY: "free" "Hz" "Body on rigid ground";
    BODY_FREQUENCY: "body" "Hz" "Of those occupied, the one in which the first jumper moves most";
    BASE: "base" "Hz" "Base motion";
} }

// Sweeps

quantities! { SWEEP {
    DIRECTION: "direction" ""
        "Way through the values: up and down carry the state on; start z v begins anew at each value from that state";
    START_Z: "start_z" "1" "Initial height over eta";
    START_V: "start_v" "1" "Initial velocity over eta omega_h";
    SAMPLE: "sample" "1" "Forcing period of the record, at whose end cos(Omega t) = 1";
    LABEL: "label" ["none", "periodic", "quasi-periodic", "chaotic", "undecided"]
        "Kind of the motion that goes on from the last state";
} }

// Attractors

quantities! { ATTRACTORS {
    ATTRACTOR: "attractor" "1" "Number of the attractor, which stays along the parameter";
    STARTS_ASKED: "starts_asked" "1" "Initial conditions at each value";
    UNSEEN: "unseen" "1" "With 95 % confidence a basin that no initial condition met has a smaller part of the box";
    UNFINISHED: "unfinished" "1"
        "Motions still carried on when it took too long; if not 0, an attractor may have several numbers";
    STARTS: "starts" "1" "Initial conditions that lead to it; 0 if it was met from another value alone";
    SHARE: "share" "1" "Share of the initial conditions";
    SHARE_LOW: "share_low" "1" "Lower end of its 95 % confidence interval";
    SHARE_HIGH: "share_high" "1" "Upper end of its 95 % confidence interval";
    ATTRACTOR_KIND: "kind" ["not-met", "periodic", "quasi-periodic", "chaotic", "not-periodic"] "Kind of the motion";
    LARGEST_MULTIPLIER: "multiplier" "1" "Largest modulus of the Floquet multipliers of a cycle";
    LARGEST_EXPONENT: "exponent" "1" "Largest Lyapunov exponent per forcing period, where there is no cycle";
    WATCHED_MOTIONS: "watched_motions" "1" "Motions watched on chaos, none of which left it";
    WATCHED_PERIODS: "watched_periods" "1" "Forcing periods of chaos of all watched motions";
    LIFETIME_LOW: "lifetime_low" "1" "Forcing periods that the mean lifetime of chaos exceeds with 95 % confidence";
    MOTION: "motion" "1" "Attractors of all values";
    MOTION_ATTRACTOR: "motion_attractor" = ATTRACTOR;
    CONNECTED_SAMPLE: "sample" "1" "Samples at cos(Omega t) = 1; those of a cycle connect along the parameter";
    TRANSIENT_STARTS: "transient_starts" "1" "Initial conditions that were in it when their search was over";
    TRANSIENT_SHARE: "transient_share" = SHARE;
    TRANSIENT_SHARE_LOW: "transient_share_low" = SHARE_LOW;
    TRANSIENT_SHARE_HIGH: "transient_share_high" = SHARE_HIGH;
    TRANSIENT_ATTRACTOR: "transient_attractor" "1" "Attractor that they count for: most watched motions ended on it";
    TRANSIENT_MOTIONS: "transient_motions" "1" "Motions watched on chaos";
    TRANSIENT_ENDED: "transient_ended" "1" "Watched motions that left it";
    TRANSIENT_PERIODS: "transient_periods" = WATCHED_PERIODS;
    TRANSIENT_LIFETIME: "transient_lifetime" "1" "Mean lifetime in forcing periods";
    TRANSIENT_LIFETIME_LOW: "transient_lifetime_low" = SHARE_LOW;
    TRANSIENT_LIFETIME_HIGH: "transient_lifetime_high" = SHARE_HIGH;
    FIRST: "first" "" "First value at which it was met";
    LAST: "last" "" "Last value at which it was met";
    BIRTH_LOW: "birth_low" "" "Lower end of the values between which it begins; none at the first value";
    BIRTH_HIGH: "birth_high" "" "Upper end of the values between which it begins";
    BIRTH_TO: "birth_to" "1" "Attractor that its motion jumps to when carried on below, 0 if that is not known";
    DEATH_LOW: "death_low" "" "Lower end of the values between which it ends; none at the last value";
    DEATH_HIGH: "death_high" "" "Upper end of the values between which it ends";
    DEATH_TO: "death_to" "1" "Attractor that its motion jumps to when carried on above, 0 if that is not known";
    LOOP_FROM: "loop_from" "" "First value at which the two ways differ";
    LOOP_TO: "loop_to" "" "Last value at which the two ways differ";
    LOOP_UP: "loop_up" "1" "Attractor of a motion carried upwards";
    LOOP_DOWN: "loop_down" "1" "Attractor of a motion carried downwards";
    LOOP_PERIOD_UP: "loop_period_up" "1"
        "Period where the motion carried upwards jumps, in forcing periods; 0 if it has none";
    LOOP_PERIOD_DOWN: "loop_period_down" "1"
        "Period where the motion carried downwards jumps, in forcing periods; 0 if it has none";
    LOOP_JUMP_UP_LOW: "loop_jump_up_low" ""
        "Lower end of the values between which the motion carried upwards jumps; none if it does not";
    LOOP_JUMP_UP_HIGH: "loop_jump_up_high" ""
        "Upper end of the values between which the motion carried upwards jumps";
    LOOP_JUMP_DOWN_LOW: "loop_jump_down_low" ""
        "Lower end of the values between which the motion carried downwards jumps; none if it does not";
    LOOP_JUMP_DOWN_HIGH: "loop_jump_down_high" ""
        "Upper end of the values between which the motion carried downwards jumps";
    UNDECIDED_STARTS: "undecided_starts" "1" "Initial conditions left undecided";
    UNDECIDED: "undecided" "1" "Share of the initial conditions left undecided";
    UNDECIDED_LOW: "undecided_low" = SHARE_LOW;
    UNDECIDED_HIGH: "undecided_high" = SHARE_HIGH;
    LOST_STARTS: "lost_starts" "1" "Initial conditions whose run ended early";
    LOST: "lost" "1" "Share of the initial conditions whose run ended early";
    LOST_LOW: "lost_low" = SHARE_LOW;
    LOST_HIGH: "lost_high" = SHARE_HIGH;
    FIRST_FAILURE_STATUS: "first_failure_status" "" "How the first of these runs ended, or that there is no model";
    FIRST_FAILURE_STATUS_TEXT: "first_failure_status_text" "" "The same in a sentence";
} }

// Branches of periodic orbits

quantities! { BRANCHES {
    RANGE_FROM: "from" "" "One end of the range of the parameter";
    RANGE_TO: "to" "" "The other end of the range";
    SECOND_FROM: "second_from" = RANGE_FROM;
    SECOND_TO: "second_to" = RANGE_TO;
    COMPLETE: "complete" "" "Whether no branch was left out because there were too many";
    PLACE: "place" = POINT;
    BRANCH: "branch" "1" "Branch, the first one 0";
    BRANCH_NUMBER: "branch_number" = BRANCH;
    BRANCH_POINT: "point" "1" "Points of all branches";
    NUMBER_ON_BRANCH: "number" "1" "Number of the point on its branch, from 0";
    STABLE: "stable" "" "Whether the orbit is stable";
    NEUTRAL: "neutral" "" "Whether rounding alone says if the orbit is stable";
    BRANCH_ORIGIN: "branch_origin" ""
        "Label of the special point where the branch begins; empty if it begins at none";
    BRANCH_PERIOD: "branch_period" = PERIOD;
    BRANCH_POINTS: "branch_points" "1" "Points of the branch";
    BRANCH_FIRST: "branch_first" "" "Value of the parameter at its first point";
    BRANCH_LAST: "branch_last" "" "Value of the parameter at its last point";
    BRANCH_END_FIRST: "branch_end_first" "" "Why it ends before the first point";
    BRANCH_END_LAST: "branch_end_last" "" "Why it ends after the last point";
    SPECIAL_LABEL: "special_label" "" "Label of the special point";
    SPECIAL_KIND: "special_kind" "" "Kind of the special point, in short";
    SPECIAL_NAME: "special_name" "" "Kind of the special point";
    SPECIAL_BRANCH: "special_branch" = BRANCH;
    SPECIAL_PERIOD: "special_period" = PERIOD;
    SPECIAL_OUTSIDE_BEFORE: "special_outside_before" "1"
        "Floquet multipliers outside the unit circle before it, in the order of the branch";
    SPECIAL_OUTSIDE_AFTER: "special_outside_after" "1"
        "Floquet multipliers outside the unit circle behind it, in the order of the branch";
    SPECIAL_ANGLE: "special_angle" "rad" "Angle of the multiplier on the unit circle, of Neimark-Sacker points";
    SPECIAL_SEQUENCE: "special_sequence" = SEQUENCE;
    SPECIAL_REMARK: "special_remark" "" "Remark on the special point";
    SPECIAL_Z: "special_z" = Z;
    SPECIAL_V: "special_v" = V;
    SPECIAL_PHASE: "special_phase" = PHASE;
    SPECIAL_W: "special_w" = W;
    SPECIAL_ORBIT_VALUE: "special_orbit_value" ""
        "Value of the parameter of the orbit at hand, the last one before a grazing";
    SPECIAL_MODES: "special_modes" "1"
        "Mode of each jumper in the model, to begin with this orbit again; -1 where it has no such place";
    SPECIAL_X: "special_x" "1" "State in the units of the model, to begin with this orbit again";
    CURVE: "curve" "1" "Curve, the first one 0";
    CURVE_OF: "curve_of" ""
        "Label of the special point that the curve is of, or the word of the study that means none";
    CURVE_KIND: "curve_kind" = SPECIAL_KIND;
    CURVE_POINTS: "curve_points" "1" "Points of the curve";
    CURVE_END_FIRST: "curve_end_first" = BRANCH_END_FIRST;
    CURVE_END_LAST: "curve_end_last" = BRANCH_END_LAST;
    CURVE_ERROR: "curve_error" "" "Why there is no curve";
    CURVE_LABEL: "curve_label" "" "Label of the special point that the curve is of";
    CURVE_NUMBER: "curve_number" = CURVE;
    NUMBER_ON_CURVE: "number_on_curve" "1" "Number of the point on its curve, from 0";
    CURVE_PERIOD: "curve_period" = PERIOD;
    CURVE_ANGLE: "curve_angle" = SPECIAL_ANGLE;
} }

// Maps and basins: layers, and what they add up to

quantities! { PLANE {
    X_FROM: "x_from" "" "First value along the axis";
    X_TO: "x_to" "" "Last value along the axis";
    X_COUNT: "x_count" "1" "Values along the axis";
    Y_FROM: "y_from" "" "First value along the axis";
    Y_TO: "y_to" "" "Last value along the axis";
    Y_COUNT: "y_count" "1" "Values along the axis";
    PLANE_TRANSIENT: "transient" "1" "Forcing periods left out at each pixel, at most";
    PLANE_RECORD: "record" "1" "Forcing periods recorded where the motion has not settled";
    PIXELS: "pixels" "1" "Pixels of the plane";
    PERIODS_RUN_TOTAL: "periods_run_total" "1" "Forcing periods computed in all";
    PIXEL_PERIOD: "period" "1" "Period of the attractor in forcing periods, 0 where it has none up to 32";
    PIXEL_STATUS: "status" [
        "periodic", "quasi-periodic", "chaotic", "not-periodic", "undecided", "no-model", "chattering", "not-finite",
        "too-many-steps", "ended"
    ]
        "What became of the motion";
    PIXEL_EXPONENT: "exponent" "1" "Largest Lyapunov exponent per forcing period, where it says what the motion is";
    CHAOTIC_PERIODS: "chaotic_periods" "1"
        "Forcing periods over which a chaotic motion was seen not to settle, 0 where it is not chaotic";
    OUTCOME: "outcome" = PIXEL_STATUS;
    OUTCOME_PIXELS: "outcome_pixels" "1" "Pixels of which this became";
    CYCLE_PERIOD: "cycle_period" "1" "Period of cycles that occur, in forcing periods";
    CYCLE_PIXELS: "cycle_pixels" "1" "Pixels with this period";
    CYCLE_SHARE: "cycle_share" "1" "Their part of all pixels";
    CHAOTIC_OVER_MIN: "chaotic_over_min" "1" "Fewest chaotic_periods of a chaotic pixel";
    CHAOTIC_OVER_MAX: "chaotic_over_max" "1" "Most chaotic_periods of a chaotic pixel";
    CONTACT_RATIO_MIN: "contact_ratio_min" "1" "Smallest contact_ratio of all pixels";
    CONTACT_RATIO_MAX: "contact_ratio_max" "1" "Largest contact_ratio of all pixels";
    PEAK_REACTION_MIN: "peak_reaction_min" "1" "Smallest peak_reaction of all pixels";
    PEAK_REACTION_MAX: "peak_reaction_max" "1" "Largest peak_reaction of all pixels";
    PEAK_ACCELERATION_MIN: "peak_acceleration_min" "m s-2" "Smallest peak_acceleration of all pixels";
    PEAK_ACCELERATION_MAX: "peak_acceleration_max" "m s-2" "Largest peak_acceleration of all pixels";
    PLANE_FAILURE_X: "first_failure_x" "" "Place along x of the first pixel without a motion";
    PLANE_FAILURE_Y: "first_failure_y" "" "Place along y of the first pixel without a motion";
    PLANE_FAILURE_STATUS: "first_failure_status" ""
        "What became of the first pixel without a motion; empty if there is none";
    PLANE_FAILURE_TEXT: "first_failure_status_text" "" "The same in a sentence";
} }

// Basins

quantities! { BASINS {
    BASIN: "attractor" "1" "Number of the attractor in the table attractors, 0 for none";
    BASIN_NUMBER: "attractor_number" "1" "Number of the attractor, by its share of the pixels";
    BASIN_MATCHED: "attractor_matched" "1"
        "Its number along the sweep of [attractors]; 0 if it was not met there or nobody asked";
    BASIN_PERIOD: "attractor_period" "1" "Period in forcing periods; 0 if not periodic";
    BASIN_KIND: "attractor_kind" ["periodic", "quasi-periodic", "chaotic", "not-periodic", "undecided"]
        "What kind of motion it is";
    BASIN_PIXELS: "attractor_pixels" "1" "Pixels that lead to it";
    BASIN_SHARE: "attractor_share" "1" "Their part of all pixels";
    BASIN_CONTACT_RATIO: "attractor_contact_ratio" = CONTACT_RATIO;
    BASIN_PEAK_REACTION: "attractor_peak_reaction" = PEAK_REACTION;
    BASIN_PEAK_ACCELERATION: "attractor_peak_acceleration" = PEAK_ACCELERATION;
    BASIN_SAMPLE: "sample" "1" "Sample of a cycle at cos(Omega t) = 1, the lowest first";
    BASIN_Z: "attractor_z" = Z;
    BASIN_V: "attractor_v" = V;
    BASIN_Z_MIN: "attractor_z_min" "1" "Smallest z of its samples";
    BASIN_Z_MAX: "attractor_z_max" "1" "Largest z of its samples";
    BASIN_V_MIN: "attractor_v_min" "1" "Smallest v of its samples";
    BASIN_V_MAX: "attractor_v_max" "1" "Largest v of its samples";
} }

// The figures of the paper

quantities! { PAPER {
    PANEL: "panel" "" "Panel of the figure";
    RATIO: "frequency_ratio" "1" "Frequency of the base over omega_h";
    DAMPING: "damping_ratio" "1" "Damping ratio zeta_h of the person";
    REGIME_LAW: "regime_law" "" "Contact law";
    REGIME_REFERENCE: "regime_reference" "" "Which frequency of the body omega_h is";
    REGIME_RATIO: "regime_frequency_ratio" = RATIO;
    REGIME_BASE: "regime_base_frequency" = BASE_FREQUENCY;
    REGIME_PERIOD: "regime_period" = PERIOD;
    REGIME_FROM: "regime_from" "1"
        "between these damping ratios all multipliers of the cycle lie inside the unit circle";
    REGIME_FROM_IS: "regime_from_is" "" "What happens at regime_from";
    REGIME_TO: "regime_to" "1" "between these damping ratios all multipliers of the cycle lie inside the unit circle";
    REGIME_TO_IS: "regime_to_is" "" "What happens at regime_to";
    SWEEP_RATIO: "sweep_frequency_ratio" = RATIO;
    SWEEP_DIRECTION: "sweep_direction" = DIRECTION;
    SWEEP_DAMPING: "sweep_damping_ratio" = DAMPING;
    SWEEP_CYCLE: "sweep_cycle" "1" "Period of the stable cycle that the motion is on, to 0.05 eta; none if on none";
    SWEEP_SLOW: "sweep_slow" "1"
        "Periods after which a motion on no stable cycle repeats to 1e-3 eta: one still on its way";
    TRANSITION_RATIO: "transition_frequency_ratio" = RATIO;
    TRANSITION_LABEL: "transition_label" "" "Label of the special point";
    TRANSITION_KIND: "transition_kind" "" "Kind of the special point";
    TRANSITION_PERIOD: "transition_period" = PERIOD;
    TRANSITION_DAMPING: "transition_damping_ratio" "1"
        "Damping ratio of the special point, by continuation with the tangent flow";
    TRANSITION_SECOND: "transition_second" "1"
        "The same from orbits at given damping ratios, derivatives by differences; none if not found so";
    TRANSITION_SEEN: "transition_seen" ["no", "yes"] "Whether the orbit is stable on one side at least";
    TRANSITION_SWITCHES: "transition_switches" "" "Order of the switches";
    BRANCH_RATIO: "branch_frequency_ratio" = RATIO;
    PAPER_BRANCH_POINT: "branch_point_number" "1" "Number of the point on its branch, from 0";
    BRANCH_DAMPING: "branch_damping_ratio" = DAMPING;
    BRANCH_STABLE: "branch_stable" ["no", "yes"] "Whether the orbit is stable";
    BRANCH_PLACE: "branch_place" = POINT;
    BRANCH_Z: "branch_z" = Z;
    EXPONENT_PERIODS: "exponent_periods" "1" "Forcing periods over which each exponent was measured";
    EXPONENT_RATIO: "exponent_frequency_ratio" = RATIO;
    EXPONENT_DAMPING: "exponent_damping_ratio" = DAMPING;
    FIG3_PANEL: "fig3_panel" = PANEL;
    FIG3_RATIO: "fig3_frequency_ratio" = RATIO;
    FIG3_DAMPING: "fig3_damping_ratio" = DAMPING;
    FIG3_Z: "fig3_z" = Z;
    FIG3_V: "fig3_v" = V;
    INERTIA_RATIO: "inertia_frequency_ratio" = RATIO;
    INERTIA_DAMPING: "inertia_damping_ratio" = DAMPING;
    INERTIA_DIFFERENCE: "inertia_difference" "1"
        "Largest difference of the sections over eta; none where they are not both periodic";
    INERTIA_FULL: "inertia_contact_ratio_full" = CONTACT_RATIO;
    INERTIA_CONDENSED: "inertia_contact_ratio_condensed" = CONTACT_RATIO;
} }

// Told by tables alone

quantities! { {
    VALUE: "value" "" "Value of the parameter";
    STABLE_CELL: "stable_cell" "" "Whether the orbit is stable; neutral where rounding alone says it";
    BASIN_SAMPLE_CELL: "sample_cell" = BASIN_SAMPLE;
    CURVE_POINT_KIND: "curve_point_kind" = CURVE_KIND;
    LARGEST_REAL: "largest_real" "1" "Largest Floquet multiplier, real";
    LARGEST_IMAGINARY: "largest_imaginary" "1" "Largest Floquet multiplier, imaginary";
    ORIGIN: "origin" = BRANCH_ORIGIN;
} }
