//! x
use saltus::model::{PreparedPlate, Setup};
use saltus::physics::*;
use saltus::study::{Control, Pass, Sweep, sweep, recurrence};
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let n: usize = std::env::args().nth(1).map_or(41, |a| a.parse().unwrap());
    for law in ContactLaw::ALL { for reference in [FrequencyReference::Occupied, FrequencyReference::Free] { 
        if law != ContactLaw::ReactionForce && reference == FrequencyReference::Free { continue; }
        for ratio in [0.9, 1.0, 1.1] {
        let mut setup = Setup::dias_del_prado(0.3, ratio);
        setup.contact = law;
        setup.base.frequency = BaseFrequency::Ratio { ratio, reference };
        let plate = PreparedPlate::new(&setup.plate)?;
        let at = |zeta: f64| { let mut s = setup.clone(); s.jumpers[0].damping_ratio = zeta; s.model_on(&plate) };
        let d = Sweep { values: Sweep::linspace(0.1, 0.5, n), passes: vec![Pass::Up, Pass::Down, Pass::Start{z:3.0,v:2.0}, Pass::Start { z: 0.0, v: 0.0 }, Pass::Start{z:-2.0,v:1.0}], start: (3.0, 2.0), transient: 1000, record: 100 };
        let rows = sweep(&d, at, &Control::default())?;
        println!("== {} {} {ratio}", law.name(), reference.name());
        for p in 0..5 { let s: String = rows.iter().filter(|r| r.pass==p).map(|r| match recurrence(&r.z[0], &r.v[0], 1e-4) { Some(k) if k<10 => format!("{k}"), Some(k) => format!("[{k}]"), None => "*".into() }).collect(); println!("{p} {s}"); }
    } } }
    Ok(())
}
