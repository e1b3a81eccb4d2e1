//! Pieces are whole or reported, belong to one work, and to one process at a time.
#![allow(clippy::unwrap_used)]

use saltus_results::pieces::{MANIFEST, pieces_beside};
use saltus_results::{PieceStore, ResultsError};
use std::fs;
use std::path::Path;

const WORK: [(&str, &str); 2] = [("study", "5f3a9c"), ("version", "0.1.0")];

fn names(dir: &Path) -> Vec<String> {
    let mut names: Vec<_> = fs::read_dir(dir)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

fn piece(dir: &Path, number: u32) -> std::path::PathBuf {
    dir.join(format!("piece-{number:06}.bin"))
}

/// A folder with pieces 0 to 3, closed again.
fn four(dir: &Path) {
    let store = PieceStore::open(dir, &WORK).unwrap();
    for number in 0..4 {
        store.write(number, &[number as u8; 100]).unwrap();
    }
}

#[test]
fn pieces_come_back_in_a_later_run_and_leave_without_trace() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path().join("a/pieces");
    four(&dir);
    let store = PieceStore::open(&dir, &WORK).unwrap();
    store.write(1_000_000, &[]).unwrap();
    store.write(2, b"anew").unwrap();
    let survey = store.survey().unwrap();
    assert_eq!(survey.whole, [0, 1, 2, 3, 1_000_000]);
    assert!(survey.damaged.is_empty());
    assert_eq!(store.read(2).unwrap().unwrap(), b"anew");
    assert_eq!(store.read(3).unwrap().unwrap(), [3; 100]);
    assert_eq!(store.read(1_000_000).unwrap().unwrap(), b"");
    assert_eq!(store.read(4).unwrap(), None);
    store.remove().unwrap();
    assert!(!dir.exists());
}

#[test]
fn damaged_pieces_are_reported_and_missing_until_written_again() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    four(dir);
    let bytes = fs::read(piece(dir, 0)).unwrap();
    fs::write(piece(dir, 0), &bytes[..bytes.len() - 1]).unwrap();
    fs::write(piece(dir, 1), &bytes[..7]).unwrap();
    fs::write(piece(dir, 2), &bytes).unwrap();
    let store = PieceStore::open(dir, &WORK).unwrap();
    let survey = store.survey().unwrap();
    assert_eq!(survey.whole, [3]);
    let said: Vec<_> = survey
        .damaged
        .iter()
        .map(|d| (d.piece, d.problem.as_str()))
        .collect();
    let expected = [
        (0, "99 bytes of content, not 100"),
        (1, "7 bytes, less than its header"),
        (2, "it is piece 0"),
    ];
    assert_eq!(said, expected);
    let error = store.read(2).unwrap_err().to_string();
    assert!(
        error.contains("piece-000002.bin") && error.contains("it is piece 0"),
        "{error}"
    );
    store.write(2, b"again").unwrap();
    assert_eq!(store.survey().unwrap().whole, [2, 3]);
}

#[test]
fn one_altered_bit_is_noticed_wherever_it_is() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    four(dir);
    let store = PieceStore::open(dir, &WORK).unwrap();
    let bytes = fs::read(piece(dir, 1)).unwrap();
    for bit in 0..8 * bytes.len() {
        let mut altered = bytes.clone();
        altered[bit / 8] ^= 1 << (bit % 8);
        fs::write(piece(dir, 1), altered).unwrap();
        let error = store.read(1).unwrap_err();
        assert!(
            matches!(error, ResultsError::DamagedPiece { .. }),
            "bit {bit}: {error}"
        );
    }
}

#[test]
fn a_piece_from_other_work_is_not_ours() {
    let home = tempfile::tempdir().unwrap();
    let (ours, theirs) = (home.path().join("ours"), home.path().join("theirs"));
    four(&ours);
    let other = PieceStore::open(&theirs, &[("study", "other")]).unwrap();
    other.write(1, &[1; 100]).unwrap();
    fs::copy(piece(&theirs, 1), piece(&ours, 1)).unwrap();
    let survey = PieceStore::open(&ours, &WORK).unwrap().survey().unwrap();
    assert_eq!(survey.whole, [0, 2, 3]);
    assert_eq!(survey.damaged[0].problem, "it belongs to other work");
}

#[test]
fn other_work_is_refused_and_told_what_differs() {
    let home = tempfile::tempdir().unwrap();
    four(home.path());
    let refusal = |work: &[(&str, &str)]| {
        let error = PieceStore::open(home.path(), work).unwrap_err();
        assert!(
            matches!(error, ResultsError::ForeignPieces { .. }),
            "{error}"
        );
        error.to_string()
    };
    let error = refusal(&[("study", "77"), ("version", "0.1.0"), ("pieces", "8")]);
    let words = "study is `5f3a9c` there and `77` here, pieces is absent there and `8` here.";
    assert!(error.contains(words), "{error}");
    let error = refusal(&[("study", "5f3a9c")]);
    assert!(
        error.contains("version is `0.1.0` there and absent here"),
        "{error}"
    );
    let error = refusal(&[WORK[1], WORK[0]]);
    assert!(error.contains("another order"), "{error}");
    let manifest = fs::read_to_string(home.path().join(MANIFEST)).unwrap();
    fs::write(
        home.path().join(MANIFEST),
        manifest.replace("version\": 1", "version\": 2"),
    )
    .unwrap();
    assert!(refusal(&WORK).contains("their format is 2, not 1"));
    fs::write(home.path().join(MANIFEST), "{").unwrap();
    assert!(refusal(&WORK).contains("cannot be read"));
    fs::write(home.path().join(MANIFEST), manifest).unwrap();
    assert_eq!(
        PieceStore::open(home.path(), &WORK)
            .unwrap()
            .survey()
            .unwrap()
            .whole,
        [0, 1, 2, 3]
    );
}

#[test]
fn a_killed_run_leaves_nothing_that_counts() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    four(dir);
    // A process killed while it wrote: files aside, an old lock nobody holds.
    fs::write(dir.join(".tmpAbc123.part"), "half").unwrap();
    fs::write(dir.join("lock"), "999999\n").unwrap();
    let store = PieceStore::open(dir, &WORK).unwrap();
    assert_eq!(store.survey().unwrap().whole, [0, 1, 2, 3]);
    assert!(!dir.join(".tmpAbc123.part").exists());
    // One killed before there was a manifest.
    drop(store);
    let young = dir.join("young");
    fs::create_dir(&young).unwrap();
    fs::write(young.join("lock"), "").unwrap();
    fs::write(young.join(".tmpAbc123.part"), "half").unwrap();
    let store = PieceStore::open(&young, &WORK).unwrap();
    assert_eq!(names(&young), ["lock", MANIFEST]);
    store.remove().unwrap();
}

#[test]
fn a_second_opener_is_refused_until_the_first_is_gone() {
    let home = tempfile::tempdir().unwrap();
    let store = PieceStore::open(home.path(), &WORK).unwrap();
    let error = PieceStore::open(home.path(), &WORK).unwrap_err();
    assert!(matches!(error, ResultsError::PiecesInUse { .. }), "{error}");
    #[cfg(unix)]
    assert!(
        error
            .to_string()
            .contains(&format!("(process {})", std::process::id())),
        "{error}"
    );
    drop(store);
    PieceStore::open(home.path(), &WORK).unwrap();
}

#[test]
fn threads_share_a_store() {
    let home = tempfile::tempdir().unwrap();
    let store = PieceStore::open(home.path(), &WORK).unwrap();
    std::thread::scope(|scope| {
        for first in 0..4 {
            let store = &store;
            scope.spawn(move || {
                for number in (first..40).step_by(4) {
                    store.write(number, &number.to_le_bytes()).unwrap();
                }
            });
        }
    });
    assert_eq!(store.survey().unwrap().whole, (0..40).collect::<Vec<_>>());
}

#[test]
fn a_folder_of_others_is_refused_and_their_files_stay() {
    let home = tempfile::tempdir().unwrap();
    let thesis = home.path().join("thesis.tex");
    fs::write(&thesis, "years").unwrap();
    let error = PieceStore::open(home.path(), &WORK).unwrap_err();
    assert!(matches!(error, ResultsError::NoPieces { .. }), "{error}");
    assert_eq!(names(home.path()), ["thesis.tex"]);
    let error = PieceStore::open(&thesis, &WORK).unwrap_err();
    assert!(error.to_string().contains("thesis.tex"), "{error}");
    let pieces = home.path().join("pieces");
    four(&pieces);
    fs::write(pieces.join("notes.txt"), "mine").unwrap();
    PieceStore::open(&pieces, &WORK).unwrap().remove().unwrap();
    assert_eq!(names(&pieces), ["notes.txt"]);
}

#[test]
fn the_pieces_of_a_result_lie_beside_it() {
    let beside = |path: &str| pieces_beside(Path::new(path)).to_str().unwrap().to_owned();
    assert_eq!(beside("runs/map"), "runs/.map.saltus-pieces");
    assert_eq!(beside("map/"), ".map.saltus-pieces");
    // Not inside the folder, where it would be a foreign file.
    let here = std::env::current_dir().unwrap();
    assert_eq!(pieces_beside(Path::new(".")), pieces_beside(&here));
}
