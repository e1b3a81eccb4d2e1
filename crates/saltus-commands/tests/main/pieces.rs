//! Pieces in memory: handed out as bytes, verified, put together to the bits of one run.

use saltus_commands::{
    Answer, CommandError, Existing, Folder, Pieces, PiecesAt, Request, RunContext, Shard, about,
};
use saltus_config::Study;
use saltus_results::pieces::pieces_beside;
use std::collections::BTreeMap;
use std::fs;

type Bytes = Vec<(u32, Vec<u8>)>;

fn study(sets: &[&str]) -> Study {
    let text = saltus_config::paper_template();
    let small = [
        "plate.inertia=condensed",
        "map.x.count=10",
        "map.y.count=7",
        "map.transient=40",
        "map.record=8",
        "map.exponent=100",
        "basins.x.count=9",
        "basins.y.count=9",
        "basins.transient=40",
        "sweep.direction=restarts",
        "sweep.starts=[[3.0, 2.0], [1.0, 0.0]]",
        "sweep.count=11",
        "sweep.transient=20",
        "sweep.record=4",
        "sweep.exponents=1",
        "sweep.exponent_periods=60",
    ];
    let sets: Vec<String> = small
        .iter()
        .chain(sets)
        .map(|&set| set.to_owned())
        .collect();
    saltus_config::read("a study", text.as_bytes(), &sets).unwrap()
}

const REQUESTS: [Request; 3] = [
    Request::Map,
    Request::Basins { matched: false },
    Request::Sweep,
];

fn context(pieces: &Bytes, found: Existing) -> RunContext<'static> {
    RunContext {
        threads: 2,
        keep: Some(Pieces {
            place: PiecesAt::Memory(pieces.clone()),
            found,
        }),
        ..RunContext::default()
    }
}

/// The folder that this answer makes.
fn files(request: &Request, study: &Study, answer: &dyn Answer) -> BTreeMap<String, Vec<u8>> {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    let mut folder = Folder::stage(
        &out,
        Some(about(request, study)),
        study,
        &RunContext::default(),
    )
    .unwrap();
    answer.store(request, &mut folder).unwrap();
    folder.commit().unwrap();
    let entries = fs::read_dir(out).unwrap().map(|entry| {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        (name, fs::read(path).unwrap())
    });
    entries.collect()
}

fn plain(request: &Request, study: &Study) -> BTreeMap<String, Vec<u8>> {
    let answer = request.ask(study, &RunContext::default()).unwrap();
    files(request, study, answer.as_ref())
}

/// All pieces, the last first, some together.
fn pieces(request: &Request, study: &Study) -> Bytes {
    let numbers: Vec<u32> = (0..request.pieces(study).unwrap()).rev().collect();
    let some = |numbers: &[u32]| {
        request
            .compute(study, numbers, &RunContext::default())
            .unwrap()
    };
    numbers.chunks(2).flat_map(some).collect()
}

#[test]
fn pieces_from_anywhere_come_together_to_the_bits_of_one_run() {
    let study = study(&[]);
    for request in REQUESTS {
        let pieces = pieces(&request, &study);
        let answer = request
            .ask(&study, &context(&pieces, Existing::Merge))
            .unwrap();
        assert!(answer.pieces().is_none());
        assert!(files(&request, &study, answer.as_ref()) == plain(&request, &study));
    }
}

#[test]
fn their_bytes_are_those_of_the_files_of_shards() {
    let study = study(&[]);
    let home = tempfile::tempdir().unwrap();
    for request in REQUESTS {
        let out = home.path().join(request.name());
        let context = RunContext {
            keep: Some(Pieces {
                place: PiecesAt::Beside(out.clone()),
                found: Existing::Refuse,
            }),
            ..RunContext::default()
        };
        let share = request
            .share(&study, Shard::new(2, 2).unwrap(), &context)
            .unwrap();
        assert!(
            share
                .made
                .iter()
                .eq(&Vec::from_iter((1..share.pieces).step_by(2)))
        );
        let made = request
            .compute(&study, &share.made, &RunContext::default())
            .unwrap();
        for (number, bytes) in made {
            let file = pieces_beside(&out).join(format!("piece-{number:06}.bin"));
            assert!(
                fs::read(file).unwrap() == bytes,
                "{} {number}",
                request.name()
            );
        }
    }
}

/// Pieces of the map of which 0 is missing, 1 truncated, 2 altered, 3 called 4 and of other work, and 9 too many.
fn spoiled(study: &Study) -> Bytes {
    let mut pieces = pieces(&Request::Map, study);
    pieces.sort_unstable();
    assert_eq!(pieces.len(), 5);
    let other = self::study(&["jumper.mass=80"]);
    let foreign = Request::Map
        .compute(&other, &[3], &RunContext::default())
        .unwrap();
    let truncated = pieces[1].1.len() / 2;
    pieces[1].1.truncate(truncated);
    pieces[2].1[100] ^= 4;
    let third = std::mem::replace(&mut pieces[3], foreign[0].clone());
    pieces.remove(0);
    // beside the right one, a wrong one does not count
    pieces.push((4, third.1.clone()));
    pieces.push((9, third.1));
    pieces
}

#[test]
fn every_piece_that_is_not_right_is_named_and_none_of_them_used() {
    let study = study(&[]);
    let pieces = spoiled(&study);
    let Err(CommandError::Incomplete { lacks, pieces: 5 }) =
        Request::Map.ask(&study, &context(&pieces, Existing::Merge))
    else {
        panic!("it shall not merge");
    };
    let said: Vec<(u32, &str)> = lacks
        .iter()
        .map(|l| (l.piece, l.problem.as_str()))
        .collect();
    assert_eq!(said[0], (0, "missing"));
    assert!(
        said[1].0 == 1 && said[1].1.contains("bytes of content"),
        "{said:?}"
    );
    assert_eq!(said[2], (2, "its checksum does not match"));
    assert_eq!(said[3], (3, "it belongs to other work"));
    assert_eq!(said[4], (9, "it is piece 3"));
    assert_eq!(said.len(), 5);

    let answer = Request::Map
        .ask(&study, &context(&pieces, Existing::Resume))
        .unwrap();
    assert!(files(&Request::Map, &study, answer.as_ref()) == plain(&Request::Map, &study));
}

#[test]
fn what_has_no_pieces_says_so() {
    let study = study(&["sweep.direction=up"]);
    for request in [Request::Frequencies, Request::Sweep] {
        assert!(matches!(
            request.pieces(&study),
            Err(CommandError::Refused { .. })
        ));
    }
    let beyond = Request::Map.compute(&study, &[4, 5], &RunContext::default());
    let said = beyond.unwrap_err();
    assert!(said.to_string().contains("no piece 5"), "{said}");
    assert!(said.help().unwrap().contains("0 to 4"));
}

#[test]
fn values_without_a_model_and_runs_that_fail_come_through_pieces() {
    // steps that a thick plate, which is stiff, cannot take
    let sets = [
        "sweep.parameter=plate.thickness",
        "sweep.from=0.05",
        "sweep.to=0.6",
        "solver.method=rk4",
        "solver.steps_per_period=40",
        "solver.max_switches=2",
    ];
    let study = study(&sets);
    let pieces = pieces(&Request::Sweep, &study);
    let answer = Request::Sweep
        .ask(&study, &context(&pieces, Existing::Merge))
        .unwrap();
    let merged = files(&Request::Sweep, &study, answer.as_ref());
    let report = String::from_utf8(merged["sweep.json"].clone()).unwrap();
    assert!(
        report.contains("no-model") && report.contains("chattering"),
        "{report}"
    );
    assert!(merged == plain(&Request::Sweep, &study));
}
