//! Long work on a thread of its own while Python stays awake: signals, progress, panics, the end of the program.
//!
//! A thread owns all that it works on and never calls Python. So it can be left behind when it does not stop in
//! time, and a fork loses nothing but the work. The list of running work is locked only by threads attached to
//! Python; since a fork holds on to Python, the child never finds it locked.

use std::io;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use pyo3::exceptions::{PyRuntimeError, PySystemExit};
use pyo3::prelude::*;
use saltus_commands::{Progress, Stage};

use crate::error::{broken, of_computation};

/// Time between two looks for signals by the calling thread: short enough that nobody notices.
const TICK: Duration = Duration::from_millis(50);
/// Ticks from one call of a progress function to the next: ten a second are enough for eyes.
const TICKS_PER_REPORT: u32 = 2;
/// Ticks that work has to stop in, two seconds: a step of any method takes far less. Work that looks at no flag, such
/// as the eigenvalues of a large matrix or a pipe that nobody writes to, is left behind then.
const TICKS_TO_STOP: u32 = 40;
/// Time for which the end of the program waits for work to stop.
const PATIENCE: Duration = Duration::from_secs(10);

/// A progress function: it takes the name of the work, the number of its parts that are done, and their total (or
/// None).
pub(crate) type Listener = Option<Py<PyAny>>;

/// Board on which the work notes its progress and its remarks.
#[derive(Default)]
pub(crate) struct Board {
    stage: Mutex<Option<Stage>>,
    notes: Mutex<Vec<String>>,
}

impl Board {
    /// Remarks since the last call.
    pub(crate) fn notes(&self) -> Vec<String> {
        std::mem::take(&mut *lock(&self.notes))
    }

    fn report(&self, py: Python<'_>, listener: &Listener) -> PyResult<()> {
        // not held while Python runs
        let stage = lock(&self.stage).clone();
        match (listener, stage) {
            (Some(call), Some(stage)) => {
                let done = stage.done.load(Ordering::Relaxed);
                // a total may be an estimate, and nothing is more than whole
                let done = stage.total.map_or(done, |total| done.min(total));
                call.call1(py, (stage.what, done, stage.total)).map(drop)
            }
            _ => Ok(()),
        }
    }
}

impl Progress for Board {
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
pub(crate) struct Counting<'a> {
    pub(crate) call: Listener,
    pub(crate) what: &'a str,
    pub(crate) total: Option<u64>,
}

/// As [`attended`], for work of one kind, which gets a flag that says stop and a counter of what is done.
///
/// # Errors
/// As [`attended`].
pub(crate) fn run<T: Send + 'static>(
    py: Python<'_>,
    progress: &Counting<'_>,
    work: impl FnOnce(&AtomicBool, &AtomicU64) -> PyResult<T> + Send + 'static,
) -> PyResult<T> {
    let board: Arc<Board> = Arc::default();
    let done: Arc<AtomicU64> = Arc::default();
    board.begin(Stage {
        what: progress.what.to_owned(),
        total: progress.total,
        done: Arc::clone(&done),
    });
    attended(py, &progress.call, &board, move |stop| work(stop, &done))
}

/// Runs `work` on another thread with Python released. It gets a flag that says stop, at which it must look now
/// and then.
///
/// # Errors
/// The exception of the work itself; that of a signal handler or the listener, such as KeyboardInterrupt;
/// `InternalError` if the work panics; `ComputationError` if there is no thread to be had; SystemExit if the
/// program ends meanwhile.
pub(crate) fn attended<T: Send + 'static>(
    py: Python<'_>,
    listener: &Listener,
    board: &Arc<Board>,
    work: impl FnOnce(&Arc<AtomicBool>) -> PyResult<T> + Send + 'static,
) -> PyResult<T> {
    let running = Running::new()?;
    let answer = beside(py, &running.stop, listener, board, work)?;
    if running.stop.load(Ordering::Relaxed) {
        return Err(ending());
    }
    board.report(py, listener)?;
    answer
}

/// Runs short work that may have to wait for something, such as a file, so that signals end the wait.
///
/// # Errors
/// As [`attended`].
pub(crate) fn aside<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce() -> PyResult<T> + Send + 'static,
) -> PyResult<T> {
    beside(py, &Arc::default(), &None, &Arc::default(), |_| work())?
}

/// The answer of `work` on another thread, its own exception included. Fails if something is raised here meanwhile,
/// or the work panics.
fn beside<T: Send + 'static>(
    py: Python<'_>,
    stop: &Arc<AtomicBool>,
    listener: &Listener,
    board: &Arc<Board>,
    work: impl FnOnce(&Arc<AtomicBool>) -> T + Send + 'static,
) -> PyResult<T> {
    let (give, answer) = sync_channel(1);
    let flag = Arc::clone(stop);
    let worker = thread::Builder::new()
        .spawn(move || {
            // an answer that comes too late has no receiver
            let _ = give.send(work(&flag));
        })
        .map_err(|reason| no_thread(&reason))?;
    py.detach(move || {
        let (answer, raised) = attend(&answer, stop, listener, board);
        match answer {
            Ok(answer) => {
                let _ = worker.join();
                raised.map(|()| answer)
            }
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => Err(broken(&*panic)),
                Ok(()) => Err(broken(&"no answer")),
            },
            Err(RecvTimeoutError::Timeout) => Err(raised.err().unwrap_or_else(ending)),
        }
    })
}

/// Waits for the answer. An exception in Python meanwhile, or the end of the program, gives the work a little time to
/// stop.
fn attend<T>(
    answer: &Receiver<T>,
    stop: &AtomicBool,
    listener: &Listener,
    board: &Board,
) -> (Result<T, RecvTimeoutError>, PyResult<()>) {
    let (mut ticks, mut left, mut raised) = (0, TICKS_TO_STOP, Ok(()));
    loop {
        let answer = answer.recv_timeout(TICK);
        if left == 0 || !matches!(answer, Err(RecvTimeoutError::Timeout)) {
            return (answer, raised);
        }
        if stop.load(Ordering::Relaxed) {
            left -= 1;
            continue;
        }
        ticks += 1;
        let look = |py: Python<'_>| {
            py.check_signals()?;
            if ticks % TICKS_PER_REPORT == 0 {
                board.report(py, listener)?;
            }
            Ok::<(), PyErr>(())
        };
        // There is nobody to ask while the interpreter ends.
        raised = Python::try_attach(look).unwrap_or(Ok(()));
        if raised.is_err() {
            stop.store(true, Ordering::SeqCst);
        }
    }
}

/// The program ends: the thread that called may end without a word.
fn ending() -> PyErr {
    PySystemExit::new_err(())
}

fn no_thread(reason: &io::Error) -> PyErr {
    of_computation(format!(
        "no thread can be started to compute beside Python ({reason}): the limit on processes and threads \
         (`ulimit -u`), the memory, or RUST_MIN_STACK does not allow one"
    ))
}

/// The answer of `work` on this thread; a panic in it is an `InternalError`.
pub(crate) fn sound<T>(work: impl FnOnce() -> PyResult<T>) -> PyResult<T> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|panic| Err(broken(&*panic)))
}

fn lock<T>(what: &Mutex<T>) -> MutexGuard<'_, T> {
    what.lock().unwrap_or_else(PoisonError::into_inner)
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

/// Counts to `total` as long work does, or as work that looks at no flag, and panics at the end if asked; for the
/// tests of this file.
#[pyfunction]
#[pyo3(signature = (total, *, panics=false, stops=true, progress=None))]
pub(crate) fn count(
    py: Python<'_>,
    total: u64,
    panics: bool,
    stops: bool,
    progress: Option<Py<PyAny>>,
) -> PyResult<u64> {
    let progress = Counting {
        call: progress,
        what: "counting",
        total: Some(total),
    };
    run(py, &progress, move |stop, done| {
        while done.load(Ordering::Relaxed) < total && !(stop.load(Ordering::Relaxed) && stops) {
            done.fetch_add(1, Ordering::Relaxed);
        }
        assert!(!panics, "the count was to panic");
        Ok(done.load(Ordering::Relaxed))
    })
}
