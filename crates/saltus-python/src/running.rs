//! Long work on a thread of its own while Python stays awake: signals, progress, panics, the end of the program.
//!
//! All threads are scoped, so a forked child finds nothing missing. The list of what is running is only locked
//! by threads attached to Python; since a fork holds on to Python, the child never finds it locked.

use std::any::Any;
use std::process;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::{PyRuntimeError, PySystemExit};
use pyo3::prelude::*;
use saltus_commands::{Stage, Watch};

use crate::error::InternalError;

/// How often the calling thread looks for signals: a person does not notice.
const TICK: Duration = Duration::from_millis(50);
/// Ticks from one call of a progress function to the next: ten a second are enough for eyes.
const TICKS_PER_REPORT: u32 = 2;
/// How long the end of the program waits for work to stop. A step of any method takes far less.
const PATIENCE: Duration = Duration::from_secs(10);

/// Who wants to hear how far the work is: a callable taking what is done, how many, and of how many (or None).
pub(crate) type Listener = Option<Py<PyAny>>;

/// Where the work writes how far it has come, and what is worth knowing.
#[derive(Default)]
pub(crate) struct Board {
    stage: Mutex<Option<Stage>>,
    notes: Mutex<Vec<String>>,
}

impl Board {
    /// What was noted since the last call.
    pub(crate) fn notes(&self) -> Vec<String> {
        std::mem::take(&mut *lock(&self.notes))
    }

    fn report(&self, py: Python<'_>, listener: &Listener) -> PyResult<()> {
        // not held while Python runs
        let stage = lock(&self.stage).clone();
        match (listener, stage) {
            (Some(call), Some(stage)) => {
                let done = stage.done.load(Ordering::Relaxed);
                call.call1(py, (stage.what, done, stage.total)).map(drop)
            }
            _ => Ok(()),
        }
    }
}

impl Watch for Board {
    fn begin(&self, stage: Stage) {
        *lock(&self.stage) = Some(stage);
    }

    /// The last number stays to be seen.
    fn end(&self) {}

    fn note(&self, text: &str) {
        lock(&self.notes).push(text.to_owned());
    }
}

/// Long work of one kind.
pub(crate) struct Progress<'a> {
    pub(crate) call: Listener,
    pub(crate) what: &'a str,
    pub(crate) total: Option<u64>,
}

/// As [`attended`], for work of one kind, which gets a flag that says stop and a counter of what is done.
///
/// # Errors
/// As [`attended`].
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    progress: &Progress<'_>,
    work: impl FnOnce(&AtomicBool, &AtomicU64) -> T + Send,
) -> PyResult<T> {
    let board = Board::default();
    let done: Arc<AtomicU64> = Arc::default();
    board.begin(Stage {
        what: progress.what.to_owned(),
        total: progress.total,
        done: Arc::clone(&done),
    });
    attended(py, &progress.call, &board, |stop| work(stop, &done))
}

/// Runs `work` on another thread with Python released. It gets a flag that says stop, at which it must look now
/// and then.
///
/// # Errors
/// What a signal handler or the listener raises, such as KeyboardInterrupt, after the work has stopped;
/// `InternalError` if the work panics; SystemExit if the program ends meanwhile.
pub(crate) fn attended<T: Send>(
    py: Python<'_>,
    listener: &Listener,
    board: &Board,
    work: impl FnOnce(&Arc<AtomicBool>) -> T + Send,
) -> PyResult<T> {
    let running = Running::new()?;
    let stop = &running.stop;
    let (answer, raised) = py.detach(|| {
        thread::scope(|scope| {
            let (working, ended) = sync_channel::<()>(0);
            let worker = scope.spawn(|| {
                let _working = working;
                work(stop)
            });
            let raised = attend(&ended, listener, board).err();
            if raised.is_some() {
                stop.store(true, Ordering::SeqCst);
            }
            (worker.join(), raised)
        })
    });
    let answer = answer.map_err(|panic| broken(&*panic))?;
    raised.map_or(Ok(()), Err)?;
    if stop.load(Ordering::Relaxed) {
        // The program ends: the thread that called may end without a word.
        return Err(PySystemExit::new_err(()));
    }
    board.report(py, listener)?;
    Ok(answer)
}

/// Waits for the end of the work; what Python raises meanwhile ends the wait.
fn attend(ended: &Receiver<()>, listener: &Listener, board: &Board) -> PyResult<()> {
    let mut ticks = 0;
    while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
        ticks += 1;
        let look = |py: Python<'_>| {
            py.check_signals()?;
            if ticks % TICKS_PER_REPORT == 0 {
                board.report(py, listener)?;
            }
            Ok::<(), PyErr>(())
        };
        // There is nobody to ask while the interpreter ends.
        Python::try_attach(look).unwrap_or(Ok(()))?;
    }
    Ok(())
}

fn lock<T>(what: &Mutex<T>) -> MutexGuard<'_, T> {
    what.lock().unwrap_or_else(PoisonError::into_inner)
}

fn broken(panic: &(dyn Any + Send)) -> PyErr {
    let text = panic.downcast_ref::<String>().map(String::as_str);
    let said = text.or(panic.downcast_ref::<&str>().copied());
    let text = format!(
        "saltus broke down ({}). This is an error of the program, not of your input: please report it with what \
         you called",
        said.unwrap_or("no message")
    );
    InternalError::new_err((text,))
}

/// Work under way, in this process or in the one it was forked from.
struct Entry {
    process: u32,
    stop: Arc<AtomicBool>,
}

#[derive(Default)]
struct List {
    entries: Vec<Entry>,
    /// The program ends: nothing more is begun.
    closed: bool,
}

static LIST: Mutex<List> = Mutex::new(List {
    entries: Vec::new(),
    closed: false,
});

fn list() -> MutexGuard<'static, List> {
    lock(&LIST)
}

/// A place on the list, left when dropped.
struct Running {
    stop: Arc<AtomicBool>,
}

impl Running {
    fn new() -> PyResult<Self> {
        let mut list = list();
        if list.closed {
            return Err(PyRuntimeError::new_err(
                "the program is ending: saltus begins nothing more",
            ));
        }
        let stop = Arc::new(AtomicBool::new(false));
        list.entries.push(Entry {
            process: process::id(),
            stop: Arc::clone(&stop),
        });
        Ok(Self { stop })
    }
}

impl Drop for Running {
    fn drop(&mut self) {
        list()
            .entries
            .retain(|entry| !Arc::ptr_eq(&entry.stop, &self.stop));
    }
}

/// Stops all work of this process and waits until it has stopped. Called at the end of the program.
#[pyfunction]
pub(crate) fn shut_down(py: Python<'_>) {
    let still_running = || {
        let mut list = list();
        list.closed = true;
        let own = list
            .entries
            .iter()
            .filter(|entry| entry.process == process::id());
        own.inspect(|entry| entry.stop.store(true, Ordering::Relaxed))
            .count()
            > 0
    };
    let tick = TICK / 10;
    let mut left = PATIENCE.as_millis() / tick.as_millis();
    while still_running() && left > 0 {
        py.detach(|| thread::sleep(tick));
        left -= 1;
    }
}

/// Counts to `total` as long work does, and panics at the end if asked: what the tests of this file run.
#[pyfunction]
#[pyo3(signature = (total, *, panics=false, progress=None))]
pub(crate) fn count(
    py: Python<'_>,
    total: u64,
    panics: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<u64> {
    let progress = Progress {
        call: progress,
        what: "counting",
        total: Some(total),
    };
    run(py, &progress, |stop, done| {
        while done.load(Ordering::Relaxed) < total && !stop.load(Ordering::Relaxed) {
            done.fetch_add(1, Ordering::Relaxed);
        }
        assert!(!panics, "the count was to panic");
        done.load(Ordering::Relaxed)
    })
}
