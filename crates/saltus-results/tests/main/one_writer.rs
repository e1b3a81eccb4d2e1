//! A folder of pieces has one writer. In a program of its own: a process that another test is about to start would
//! hold the lock for a moment longer.

use saltus_results::{PieceStore, ResultsError};

const WORK: [(&str, &str); 2] = [("study", "5f3a9c"), ("version", "0.1.0")];

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
