//! The paper's statements with our numbers, as text (`--full` for the resolution of `saltus reproduce`).

use std::time::Instant;

use saltus::physics::FrequencyReference::{Free, Occupied};
use saltus::study::Control;
use saltus::study::paper::{Effort, compare_inertia, diagrams, facts, misprints, run_cases};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let full = std::env::args().any(|arg| arg == "--full");
    let effort = if full {
        Effort::full()
    } else {
        Effort::quick()
    };
    let control = Control::default();
    let clock = Instant::now();
    let lap = |what: &str| eprintln!("{:6.1} s  {what}", clock.elapsed().as_secs_f64());
    let diagrams = diagrams(&effort, &control)?;
    lap("diagrams");
    let (occupied, free) = (
        run_cases(Occupied, &effort, &control)?,
        run_cases(Free, &effort, &control)?,
    );
    lap("cases");
    for fact in facts(&diagrams, &occupied, &free, &control)? {
        println!(
            "{}  {}\n    {} [{}]\n    {}",
            fact.id,
            fact.claim,
            fact.value,
            fact.verdict.words(),
            fact.reading
        );
    }
    for m in misprints(&control)? {
        println!("{}: {} -> {}\n    {}", m.place, m.printed, m.used, m.effect);
    }
    lap("misprints");
    let comparison = compare_inertia(&effort, &control)?;
    lap("full against condensed");
    println!(
        "full against condensed: {} of {} motions periodic in both, largest difference {:.1e} eta",
        comparison.periodic,
        comparison.rows.len(),
        comparison.largest
    );
    for row in &comparison.rows {
        println!(
            "  {:.1} {:.3} {:?} {:.4} {:.4}",
            row.ratio, row.damping_ratio, row.difference, row.contact_ratio.0, row.contact_ratio.1
        );
    }
    Ok(())
}
