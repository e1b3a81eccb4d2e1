//! Check of the system: values in their ranges, and keys that agree with each other.

use crate::fault::{Fault, key, wrong};
use crate::schema::Node;
use crate::study::{Basis, Law, Modes, Reference, Study};
use garde::Validate;
use toml::Value;

/// All faults of plate, people, base and run; questions are checked elsewhere.
pub(crate) fn faults_of_system(study: &Study) -> Vec<Fault> {
    let mut faults = ranges(study);
    thickness(study, &mut faults);
    modes(study, &mut faults);
    jumpers(study, &mut faults);
    base(study, &mut faults);
    if study.simulate.transient >= study.simulate.periods {
        let what = format!(
            "fewer than simulate.periods = {} are needed",
            study.simulate.periods
        );
        faults.push(wrong("simulate.transient", study.simulate.transient, &what));
    }
    faults
}

fn ranges(study: &Study) -> Vec<Fault> {
    let Err(report) = Validate::validate(study) else {
        return Vec::new();
    };
    let tree = Value::try_from(study).unwrap_or(Value::Boolean(false));
    let fault = |(path, error): &(garde::Path, garde::Error)| {
        // no field of a record can be called `continue`
        let path = path.to_string().replace("continuation", "continue");
        let key = key(&path.replace('[', ".").replace(']', ""));
        let given = key.segments().iter().try_fold(&tree, |at, name| match at {
            Value::Array(items) => items.get(name.parse::<usize>().ok()?),
            other => other.get(name.as_str()),
        });
        let wanted = Node::root()
            .find(key.segments())
            .map_or_else(|| error.to_string(), Node::wanted);
        Fault::value(&key, given.unwrap_or(&tree), &format!("{wanted} is needed"))
    };
    let mut faults: Vec<Fault> = report.iter().map(fault).collect();
    faults.dedup();
    faults
}

fn thickness(study: &Study, faults: &mut Vec<Fault>) {
    let plate = &study.plate;
    let side = plate.length.min(plate.width);
    if plate.thickness >= side {
        let what = format!("a plate is thinner than its shorter side, {side} m");
        faults.push(wrong("plate.thickness", plate.thickness, &what));
    }
}

fn modes(study: &Study, faults: &mut Vec<Fault>) {
    let Modes::Lists(lists) = &study.plate.modes else {
        return;
    };
    if lists.w.is_empty() {
        let empty = Value::Array(Vec::new());
        faults.push(Fault::value(
            &key("plate.modes.w"),
            &empty,
            "at least one transverse term is needed",
        ));
    }
    // a cosine may have no half-wave
    let zero = u32::from(study.plate.basis == Basis::Fixed);
    term_list(
        "plate.modes.u",
        &lists.u,
        [1, zero],
        Modes::MAX_IN_PLANE,
        faults,
    );
    term_list(
        "plate.modes.v",
        &lists.v,
        [zero, 1],
        Modes::MAX_IN_PLANE,
        faults,
    );
    term_list(
        "plate.modes.w",
        &lists.w,
        [1, 1],
        Modes::MAX_TRANSVERSE,
        faults,
    );
}

fn term_list(
    name: &str,
    terms: &[[u32; 2]],
    least: [u32; 2],
    most_terms: usize,
    faults: &mut Vec<Fault>,
) {
    if terms.len() > most_terms {
        let what = format!(
            "{} terms were given, at most {most_terms} are allowed",
            terms.len()
        );
        faults.push(wrong(name, "[...]", &what));
        return;
    }
    for (i, term) in terms.iter().enumerate() {
        let at = key(name).child(i);
        let given = Value::Array(term.iter().map(|&n| Value::from(n)).collect());
        let most = Modes::MAX_HALF_WAVES;
        if (0..2).any(|k| !(least[k]..=most).contains(&term[k])) {
            let what = format!(
                "half-wave numbers from {} and {} up to {most} are needed",
                least[0], least[1]
            );
            faults.push(Fault::value(&at, &given, &what));
        } else if terms[..i].contains(term) {
            faults.push(Fault::value(
                &at,
                &given,
                "this term is already in the list",
            ));
        }
    }
}

fn jumpers(study: &Study, faults: &mut Vec<Fault>) {
    for (i, jumper) in study.jumper.iter().enumerate() {
        let at = |name: &str| format!("jumper.{i}.{name}");
        let sides = [
            ("x", jumper.x, "length", study.plate.length),
            ("y", jumper.y, "width", study.plate.width),
        ];
        for (name, position, side, extent) in sides {
            if position <= 0.0 || position >= extent {
                let what =
                    format!("outside the plate, 0 < {name} < plate.{side} = {extent} m is needed");
                faults.push(wrong(&at(name), position, &what));
            }
        }
        if study.contact.law != Law::ReactionForce && jumper.damping_ratio == 0.0 {
            let what = "contact.law = \"gap\" or \"relaxing-leg\" needs a number above 0; without damping \
                        the law is \"reaction-force\"";
            faults.push(wrong(&at("damping_ratio"), jumper.damping_ratio, what));
        }
    }
}

fn base(study: &Study, faults: &mut Vec<Fault>) {
    let help = "give one of base.frequency_ratio (-) and base.frequency (Hz), and not both";
    match (study.base.frequency, study.base.frequency_ratio) {
        (None, None) => faults.push(Fault::missing(
            &key("base.frequency_ratio"),
            Some(help.to_owned()),
        )),
        (Some(hertz), Some(ratio)) => {
            let what = format!("base.frequency_ratio = {ratio} is given too");
            let mut fault = wrong("base.frequency", hertz, &what);
            fault.help = Some(help.to_owned());
            faults.push(fault);
        }
        (None, Some(ratio))
            if study.jumper.is_empty() && study.base.reference != Reference::Plate =>
        {
            let what = "an empty plate has no body frequency to multiply";
            let mut fault = wrong("base.frequency_ratio", ratio, what);
            fault.help = Some(
                "set base.reference = \"plate\", give base.frequency in Hz, or add a [[jumper]]"
                    .to_owned(),
            );
            faults.push(fault);
        }
        _ => {}
    }
}
