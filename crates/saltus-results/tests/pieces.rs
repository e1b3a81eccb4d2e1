//! Pieces are whole or reported, belong to one work, and to one process at a time or to all that share.
//!
//! A program of its own: a process that another test starts would hold the locks of these for an instant.
#![allow(clippy::unwrap_used)]

use saltus_results::pieces::{MANIFEST, pieces_beside, work_in};
use saltus_results::{PieceStore, ResultsError};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::sync::{Barrier, PoisonError, RwLock, RwLockReadGuard};

const WORK: [(&str, &str); 2] = [("study", "5f3a9c"), ("version", "0.1.0")];

/// A process has the open locks of all tests between its fork and its program. Those that begin one write here, those whose
/// locks must not outlive them read.
static FORKS: RwLock<()> = RwLock::new(());

/// Keeps processes from beginning while it lives.
fn still() -> RwLockReadGuard<'static, ()> {
    FORKS.read().unwrap_or_else(PoisonError::into_inner)
}

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
    let _still = still();
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
    let _still = still();
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
    let _still = still();
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
    let _still = still();
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
        manifest.replace("version\": 2", "version\": 3"),
    )
    .unwrap();
    assert!(refusal(&WORK).contains("their format is 3, not 2"));
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
    let _still = still();
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
fn threads_share_a_store() {
    let _still = still();
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
    let _still = still();
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
    let _still = still();
    let beside = |path: &str| pieces_beside(Path::new(path)).to_str().unwrap().to_owned();
    assert_eq!(beside("runs/map"), "runs/.map.saltus-pieces");
    assert_eq!(beside("map/"), ".map.saltus-pieces");
    // Not inside the folder, where it would be a foreign file.
    let here = std::env::current_dir().unwrap();
    assert_eq!(pieces_beside(Path::new(".")), pieces_beside(&here));
}

/// The folder and the work of a process that [`shard`] is; without them the test has nothing to do.
const DIR: &str = "SALTUS_TEST_PIECES";
const STUDY: &str = "SALTUS_TEST_STUDY";

/// A process that opens the folder as shared once its input is closed, and writes 40 pieces.
fn start(dir: &Path, study: &str) -> Child {
    let _forking = FORKS.write().unwrap_or_else(PoisonError::into_inner);
    Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "shard", "--ignored"])
        .env(DIR, dir)
        .env(STUDY, study)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

#[test]
#[ignore = "is a process that other tests start"]
fn shard() {
    let (Ok(dir), Ok(study)) = (std::env::var(DIR), std::env::var(STUDY)) else {
        return;
    };
    std::io::copy(&mut std::io::stdin(), &mut std::io::sink()).unwrap();
    let store = PieceStore::open_shared(Path::new(&dir), &[("study", &study)]).unwrap();
    for number in 0..40 {
        store.write(number, &content(number)).unwrap();
    }
}

/// Long enough that writing takes a while.
fn content(number: u32) -> Vec<u8> {
    number.to_le_bytes().repeat(20_000)
}

/// Whether each process did its work, all having begun at once.
fn race(dir: &Path, studies: &[&str]) -> Vec<bool> {
    let mut processes: Vec<Child> = studies.iter().map(|study| start(dir, study)).collect();
    // All have begun before the first may go on.
    processes
        .iter_mut()
        .for_each(|process| drop(process.stdin.take()));
    let done = |process: &mut Child| process.wait().unwrap().success();
    processes.iter_mut().map(done).collect()
}

#[test]
fn processes_that_share_a_folder_write_the_same_pieces_without_harm() {
    let home = tempfile::tempdir().unwrap();
    let dir = home.path().join("deep/pieces");
    assert_eq!(race(&dir, &["a"; 6]), [true; 6]);
    let work = [("study".to_owned(), "a".to_owned())];
    assert_eq!(work_in(&dir).unwrap(), work);
    let store = PieceStore::open_to_merge(&dir, &[("study", "a")]).unwrap();
    let survey = store.survey().unwrap();
    assert_eq!(survey.whole, (0..40).collect::<Vec<_>>());
    assert!(survey.damaged.is_empty());
    for number in 0..40 {
        assert_eq!(store.read(number).unwrap().unwrap(), content(number));
    }
    assert!(!names(&dir).iter().any(|name| name.ends_with(".part")));
    store.remove().unwrap();
    assert!(!dir.exists());
}

#[test]
fn of_processes_with_different_work_one_kind_wins_whole() {
    for _ in 0..5 {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("pieces");
        let studies = ["a", "b", "a", "b"];
        let done = race(&dir, &studies);
        let winner = work_in(&dir).unwrap()[0].1.clone();
        let expected: Vec<bool> = studies.iter().map(|study| *study == winner).collect();
        assert_eq!(done, expected);
        let store = PieceStore::open_to_merge(&dir, &[("study", &winner)]).unwrap();
        let survey = store.survey().unwrap();
        assert_eq!((survey.whole.len(), survey.damaged.len()), (40, 0));
    }
}

#[test]
fn threads_that_open_an_absent_folder_at_once_agree_on_its_work() {
    let _still = still();
    for _ in 0..50 {
        let home = tempfile::tempdir().unwrap();
        let dir = home.path().join("pieces");
        let barrier = Barrier::new(8);
        let opened: Vec<Option<usize>> = std::thread::scope(|scope| {
            let open = |thread: usize| {
                let (barrier, dir) = (&barrier, &dir);
                scope.spawn(move || {
                    let study = (thread % 2).to_string();
                    barrier.wait();
                    match PieceStore::open_shared(dir, &[("study", &study)]) {
                        Ok(_) => Some(thread % 2),
                        Err(ResultsError::ForeignPieces { .. }) => None,
                        Err(error) => panic!("{error}"),
                    }
                })
            };
            let threads: Vec<_> = (0..8).map(open).collect();
            threads
                .into_iter()
                .map(|thread| thread.join().unwrap())
                .collect()
        });
        let winner: usize = work_in(&dir).unwrap()[0].1.parse().unwrap();
        let expected: Vec<_> = (0..8)
            .map(|thread| Some(thread % 2).filter(|&t| t == winner))
            .collect();
        assert_eq!(opened, expected);
    }
}

#[test]
fn who_shares_keeps_out_who_wants_it_alone_and_the_other_way_round() {
    let _still = still();
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let one = PieceStore::open_shared(dir, &WORK).unwrap();
    let two = PieceStore::open_shared(dir, &WORK).unwrap();
    two.write(0, b"x").unwrap();
    for refused in [
        PieceStore::open(dir, &WORK),
        PieceStore::open_to_merge(dir, &WORK),
    ] {
        let error = refused.unwrap_err();
        // Nobody in particular.
        assert!(
            matches!(error, ResultsError::PiecesInUse { process: None, .. }),
            "{error}"
        );
    }
    drop((one, two));
    let alone = PieceStore::open_to_merge(dir, &WORK).unwrap();
    let error = PieceStore::open_shared(dir, &WORK).unwrap_err();
    assert!(matches!(error, ResultsError::PiecesInUse { .. }), "{error}");
    assert_eq!(alone.survey().unwrap().whole, [0]);
}

/// As on a file system that keeps locks to one machine: each is there and the others do not see it.
#[test]
fn without_locks_nobody_tidies_away_what_others_are_writing() {
    let _still = still();
    let home = tempfile::tempdir().unwrap();
    let dir = home.path();
    let shared = PieceStore::open_shared(dir, &WORK).unwrap();
    std::thread::scope(|scope| {
        let writer = scope.spawn(|| {
            for number in 0..20 {
                shared.write(number, &content(number)).unwrap();
            }
        });
        while !writer.is_finished() {
            fs::remove_file(dir.join("lock")).unwrap();
            drop(PieceStore::open(dir, &WORK).unwrap());
        }
    });
    let survey = shared.survey().unwrap();
    assert_eq!((survey.whole.len(), survey.damaged.len()), (20, 0));
    fs::write(dir.join(".tmpAbc123.shared.part"), "of a killed process").unwrap();
    shared.remove().unwrap();
    assert!(!dir.exists());
}

#[test]
fn there_is_nothing_to_merge_where_there_are_no_pieces() {
    let _still = still();
    let home = tempfile::tempdir().unwrap();
    for dir in [home.path().join("nowhere"), home.path().to_path_buf()] {
        let error = PieceStore::open_to_merge(&dir, &WORK).unwrap_err();
        assert!(
            matches!(error, ResultsError::AbsentPieces { .. }),
            "{error}"
        );
        assert!(
            work_in(&dir)
                .unwrap_err()
                .to_string()
                .contains("there are no pieces in")
        );
    }
    assert_eq!(names(home.path()), Vec::<String>::new());
    four(home.path());
    let error = PieceStore::open_to_merge(home.path(), &[("study", "other")]).unwrap_err();
    assert!(
        matches!(error, ResultsError::ForeignPieces { .. }),
        "{error}"
    );
}

#[test]
fn a_file_of_somebody_that_ends_as_ours_do_stays() {
    let _still = still();
    let home = tempfile::tempdir().unwrap();
    let foreign = home.path().join("foreign");
    fs::create_dir(&foreign).unwrap();
    fs::write(foreign.join("thesis.part"), "years").unwrap();
    let error = PieceStore::open(&foreign, &WORK).unwrap_err();
    assert!(matches!(error, ResultsError::NoPieces { .. }), "{error}");
    let ours = home.path().join("ours");
    let store = PieceStore::open(&ours, &WORK).unwrap();
    store.write(0, b"content").unwrap();
    drop(store);
    let theirs = [
        "thesis.part",
        ".tmp.part",
        ".tmpthesis1.part",
        ".tmpthe is.shared.part",
    ];
    for name in theirs {
        fs::write(ours.join(name), "years").unwrap();
    }
    fs::write(ours.join(".tmpAbc123.part"), "half").unwrap();
    PieceStore::open(&ours, &WORK).unwrap().remove().unwrap();
    let mut expected = theirs.map(str::to_owned).to_vec();
    expected.sort();
    assert_eq!(names(&ours), expected);
}

#[cfg(unix)]
#[test]
fn a_pipe_in_place_of_a_piece_or_of_the_manifest_is_not_waited_for() {
    let home = tempfile::tempdir().unwrap();
    four(home.path());
    let pipe = |path: &Path| {
        fs::remove_file(path).unwrap();
        let _forking = FORKS.write().unwrap_or_else(PoisonError::into_inner);
        let made = std::process::Command::new("mkfifo").arg(path).status();
        assert!(made.unwrap().success());
    };
    pipe(&piece(home.path(), 1));
    let error = PieceStore::open(home.path(), &WORK)
        .unwrap()
        .survey()
        .unwrap_err();
    assert!(
        error.to_string().contains("it is a pipe or a device"),
        "{error}"
    );
    pipe(&home.path().join(saltus_results::pieces::MANIFEST));
    let error = PieceStore::open(home.path(), &WORK).unwrap_err();
    assert!(
        error.to_string().contains("it is a pipe or a device"),
        "{error}"
    );
}
