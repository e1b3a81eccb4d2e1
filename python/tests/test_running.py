"""Long work beside an interpreter that stays awake."""

from __future__ import annotations

import multiprocessing
import os
import signal
import subprocess
import sys
import textwrap
import threading
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from saltus import InternalError, _native
from saltus.systems import System, integrate

#: A count that no machine ends while a test runs.
ENDLESS = 2**63


def run_program(text: str, **environment: str) -> subprocess.CompletedProcess[str]:
    program = [sys.executable, "-c", textwrap.dedent(text)]
    return subprocess.run(
        program,
        capture_output=True,
        text=True,
        timeout=60,
        check=False,
        env={**os.environ, **environment},
    )


def test_an_interrupt_ends_the_work_and_is_raised() -> None:
    def interrupt(what: str, done: int, total: int | None) -> None:
        signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        _native.count(ENDLESS, progress=interrupt)


def test_an_interrupt_from_outside_ends_the_work() -> None:
    main = threading.main_thread().ident
    assert main is not None
    begun = threading.Event()

    def report(what: str, done: int, total: int | None) -> None:
        begun.set()

    def interrupt() -> None:
        begun.wait()
        signal.pthread_kill(main, signal.SIGINT)

    other = threading.Thread(target=interrupt)
    other.start()
    with pytest.raises(KeyboardInterrupt):
        _native.count(ENDLESS, progress=report)
    other.join()


def test_what_the_progress_function_raises_is_raised() -> None:
    def refuse(what: str, done: int, total: int | None) -> None:
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        _native.count(ENDLESS, progress=refuse)


def test_progress_tells_what_how_much_and_of_how_much() -> None:
    told: list[tuple[str, int, int | None]] = []
    _native.count(1000, progress=lambda *told_now: told.append(told_now))
    assert told[-1] == ("counting", 1000, 1000)


def test_a_panic_is_an_exception_that_asks_to_be_reported() -> None:
    with pytest.raises(InternalError, match=r"the count was to panic.*please report"):
        _native.count(10, panics=True)


def test_work_that_looks_at_no_flag_is_left_behind() -> None:
    # a million seconds of counting, and a pipe that nobody writes to
    found = run_program("""
        import os, signal, sys, tempfile, threading
        import saltus
        from saltus import _native
        def interrupt(*told):
            signal.raise_signal(signal.SIGINT)
        try:
            _native.count(2**63, stops=False, progress=interrupt)
        except KeyboardInterrupt:
            print("interrupted")
        pipe = os.path.join(tempfile.mkdtemp(), "study.toml")
        os.mkfifo(pipe)
        main = threading.main_thread().ident
        threading.Timer(0.2, lambda: signal.pthread_kill(main, signal.SIGINT)).start()
        try:
            saltus.Study.load(pipe)
        except KeyboardInterrupt:
            print("interrupted")
        except saltus.SaltusError:
            # it may be refused as what is no file
            print("interrupted")
            import time
            try:
                time.sleep(10)
            except KeyboardInterrupt:
                pass
    """)
    assert (found.stdout.split(), found.stderr, found.returncode) == (["interrupted"] * 2, "", 0)


def test_a_daemon_thread_whose_work_looks_at_no_flag_does_not_hold_up_the_end() -> None:
    found = run_program("""
        import threading
        from saltus import _native
        counts = threading.Event()
        def count():
            _native.count(2**63, stops=False, progress=lambda *told: counts.set())
        threading.Thread(target=count, daemon=True).start()
        counts.wait()
        print("ends")
    """)
    assert (found.stdout, found.stderr, found.returncode) == ("ends\n", "", 0)


def test_a_thread_that_cannot_be_started_is_an_error_like_others() -> None:
    # no address space holds a stack of 100 TB
    found = run_program(
        """
        import saltus
        from saltus.systems import System, integrate, find_orbit, lyapunov, states
        study = saltus.Study.paper().set({"plate.inertia": "condensed"})
        (x,) = states("x")
        system = System([x], [-x], interval=1.0)
        for ask in (
            lambda: saltus.simulate(study),
            lambda: saltus.sweep(study, threads=4),
            lambda: integrate(system, [1.0], 1),
            lambda: find_orbit(system, [1.0]),
            lambda: lyapunov(system, [1.0], 1),
            lambda: str(study),
        ):
            try:
                ask()
            except saltus.ComputationError as error:
                print(str(error)[:25])
        """,
        RUST_MIN_STACK="99999999999999",
    )
    assert found.stdout.splitlines() == ["no thread can be started "] * 6, found.stderr


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() != 0, reason="needs another user")
def test_a_user_who_may_have_no_more_threads_gets_an_answer_or_an_error() -> None:
    found = run_program("""
        import os, resource
        import saltus
        study = saltus.Study.paper().set({"plate.inertia": "condensed", "simulate.periods": 3})
        os.setuid(54321)
        resource.setrlimit(resource.RLIMIT_NPROC, (1, 1))
        try:
            print(saltus.simulate(study)["z"].shape)
        except Exception as error:
            print(type(error).__name__)
    """)
    assert found.stdout in ("(3, 1)\n", "ComputationError\n"), found.stderr


def test_other_threads_go_on_while_one_computes() -> None:
    ticks = 0
    begun = threading.Event()
    stop = threading.Event()

    def tick() -> None:
        nonlocal ticks
        begun.wait()
        while not stop.is_set():
            ticks += 1

    def report(what: str, done: int, total: int | None) -> None:
        begun.set()
        if ticks > 1000:
            raise StopIteration

    other = threading.Thread(target=tick)
    other.start()
    with pytest.raises(StopIteration):
        _native.count(ENDLESS, progress=report)
    stop.set()
    other.join()


def test_several_threads_compute_at_once(duffing: System) -> None:
    def end(f: float) -> np.ndarray:
        return integrate(duffing, [0.0, 0.0], 20, parameters={"f": f, "omega": 1.0}).end

    forces = np.linspace(0.1, 1.0, 8)
    with ThreadPoolExecutor(4) as pool:
        found = np.array(list(pool.map(end, forces)))
    at_once = integrate(duffing, [0.0, 0.0], 20, parameters={"f": forces, "omega": 1.0}).end
    assert (found == at_once).all()


def in_child(system: System) -> float:
    run = integrate(system, [0.0, 0.0], 5, parameters={"f": 0.3, "omega": 1.0}, threads=2)
    return float(run.end[0])


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
@pytest.mark.filterwarnings("ignore:This process:DeprecationWarning")
def test_a_forked_child_computes(duffing: System) -> None:
    expected = in_child(duffing)
    with multiprocessing.get_context("fork").Pool(2) as pool:
        assert pool.map(in_child, [duffing] * 4) == [expected] * 4


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there is no fork")
def test_a_child_forked_beside_running_work_computes_and_ends() -> None:
    found = run_program("""
        import os, sys, threading, warnings
        from saltus import _native
        warnings.simplefilter("ignore")
        begun = threading.Event()
        def report(*told):
            begun.set()
        work = threading.Thread(target=_native.count, args=(2**63,), kwargs=dict(progress=report))
        work.daemon = True
        work.start()
        begun.wait()
        child = os.fork()
        if child == 0:
            print(_native.count(1000), flush=True)
            sys.exit(7)
        print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
    """)
    assert (found.stdout.split(), found.stderr, found.returncode) == (["1000", "7"], "", 0)


def test_a_daemon_thread_that_computes_does_not_hold_up_the_end() -> None:
    found = run_program("""
        import threading
        from saltus import _native
        from saltus.systems import System, integrate, states
        counts, runs = threading.Event(), threading.Event()
        def count():
            _native.count(2**63, progress=lambda *told: counts.set())
        def run():
            x, = states("x")
            system = System([x], [-x], interval=1.0)
            integrate(system, [1.0], 0, transient=2**50, progress=lambda *told: runs.set())
        for work in (count, count, run):
            threading.Thread(target=work, daemon=True).start()
        counts.wait()
        runs.wait()
        print("ends")
    """)
    assert (found.stdout, found.stderr, found.returncode) == ("ends\n", "", 0)


def test_nothing_is_begun_when_the_program_has_ended() -> None:
    found = run_program("""
        import atexit
        def late():
            try:
                _native.count(10)
            except RuntimeError as error:
                print(error)
        atexit.register(late)
        from saltus import _native
    """)
    assert "begins nothing more" in found.stdout


SUBINTERPRETER = """
    import importlib, warnings
    warnings.simplefilter("ignore")
    try:
        import _interpreters as interpreters
        run = lambda text: interpreters.run_string(other, text)
    except ImportError:
        import _xxsubinterpreters as interpreters
        run = lambda text: interpreters.run_string(other, text)
    {first}
    other = interpreters.create()
    run({inside!r})
    interpreters.destroy(other)
    import saltus
    study = saltus.Study.paper().set({{"plate.inertia": "condensed", "simulate.periods": 3}})
    print(saltus.simulate(study)["z"].shape)
"""


@pytest.mark.parametrize("first", ["import saltus", ""], ids=["main first", "subinterpreter first"])
def test_a_subinterpreter_that_ends_does_not_end_the_work_of_the_main_one(first: str) -> None:
    inside = """
try:
    import saltus
except ImportError as error:
    print(error)
"""
    found = run_program(SUBINTERPRETER.format(first=first, inside=inside))
    told = "saltus works in the main interpreter of a process, not in a subinterpreter"
    assert found.stdout.splitlines() == [told, "(3, 1)"], found.stderr
