use saltus::hybrid::{Method, Options, record, Leg};
use saltus::model::{PreparedPlate, Setup};
use saltus::study::{Control, Pass, Sweep, sweep};
fn main() -> Result<(), Box<dyn std::error::Error>> {
    let a: Vec<String> = std::env::args().collect();
    let tolerance: f64 = a[1].parse()?; let order: usize = a[2].parse()?; let n: usize = a[3].parse()?;
    let setup = Setup::dias_del_prado(0.3, 1.1);
    let plate = PreparedPlate::new(&setup.plate)?;
    let at = |zeta: f64| { let mut s = setup.clone(); s.jumpers[0].damping_ratio = zeta; s.model_on(&plate) };
    let diagram = Sweep { values: Sweep::linspace(0.1, 0.5, n), passes: vec![Pass::Start { z: 3.0, v: 2.0 }], start: (3.0, 2.0), transient: 300, record: 100 };
    let method = Method::Taylor { tolerance, order };
    let m = Setup::dias_del_prado(0.45, 0.9).model()?;
    let r = record(&Leg { system: m.system().clone(), start: m.start(3.0, 2.0), periods: 100 }, &Options { method, ..Options::default() })?;
    eprintln!("steps/period {} switches/period {}", r.end.steps as f64 / 100.0, r.end.switches as f64/100.0);
    let control = Control { options: Options { method, ..Options::default() }, threads: 1, ..Control::default() };
    let c = std::time::Instant::now();
    let rows = sweep(&diagram, at, &control)?;
    eprintln!("{} rows, {:.1} k/s", rows.len(), diagram.periods() as f64 / c.elapsed().as_secs_f64()/1e3);
    Ok(())
}
