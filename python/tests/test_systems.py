"""Systems of one's own: what formulas mean, what comes back, and what is refused."""

from __future__ import annotations

import pickle
from typing import Any, ClassVar

import numpy as np
import pytest

from saltus import ComputationError, DefinitionError, _native
from saltus.systems import (
    Forcing,
    RungeKutta4,
    System,
    Taylor,
    Unit,
    find_orbit,
    integrate,
    lyapunov,
    parameter_array,
    parameters,
    state_array,
    states,
)
from saltus.systems._integrate import Options

#: The tolerance is 1e-10 a step; a few hundred steps add up.
CLOSE = 1e-8


def rest(system: System, start: Any, **values: Any) -> np.ndarray:
    return integrate(system, start, 5, parameters=values).samples


class TestFormulas:
    def test_arrays_mean_what_written_out_formulas_mean(self) -> None:
        rng = np.random.default_rng(1)
        stiffness, cubic = rng.normal(size=(3, 3)), 0.1 * rng.normal(size=(3, 3, 3, 3))
        q, u = state_array("q", 3), state_array("u", 3)
        forcing = Forcing(1.1)
        einsum: Any = np.einsum  # its types do not know objects
        push = np.array([1.0, 0.0, -1.0]) * forcing.cos
        as_arrays = push - stiffness @ stiffness.T @ q - u
        as_arrays = as_arrays - einsum("ijkl,j,k,l->i", cubic, q, q, q)
        product = stiffness @ stiffness.T
        written = []
        for i in range(3):
            rate = push[i] - u[i]
            for j in range(3):
                rate = rate - product[i, j] * q[j]
                for k in range(3):
                    for m in range(3):
                        rate = rate - cubic[i, j, k, m] * q[j] * q[k] * q[m]
            written.append(rate)
        start = [0.1, -0.2, 0.3, 0.0, 0.0, 0.0]
        one = System([q, u], [u, as_arrays], forcing=forcing)
        other = System([*q, *u], [*u, *written], forcing=forcing)
        assert np.abs(rest(one, start) - rest(other, start)).max() < CLOSE

    @pytest.mark.parametrize("power", range(8))
    def test_powers_are_products(self, power: int) -> None:
        (x,) = states("x")
        product: Any = 1.0
        for _ in range(power):
            product = product * x
        systems = [System([x], [-0.3 * rate], interval=1.0) for rate in (x**power, product)]
        one, other = (rest(system, [0.7]) for system in systems)
        assert np.abs(one - other).max() < CLOSE

    def test_functions_of_parameters_are_what_numpy_says(self) -> None:
        (x,) = states("x")
        p: Any = parameters("p")[0]  # numpy's types do not know that its functions take objects
        formula = np.sqrt(p) + np.exp(-p) * np.log(p) - np.sin(p) / np.cos(p)
        formula = formula + np.tan(p) ** 2 + np.arctan(p) + abs(-p) + 2.0**p - p**0.5
        system = System([x], [formula], interval=1.0)
        p0 = 1.7
        expected = np.sqrt(p0) + np.exp(-p0) * np.log(p0) - np.sin(p0) / np.cos(p0)
        expected += np.tan(p0) ** 2 + np.arctan(p0) + abs(-p0) + 2.0**p0 - p0**0.5
        assert integrate(system, [0.0], 1, parameters={"p": p0}).end[0] == pytest.approx(expected)

    def test_a_chosen_number_may_stand_anywhere(self) -> None:
        (x,) = states("x")
        unit = Unit("low", "high")
        number = unit.choose(low=2.0, high=3.0)
        # (2 + 1) / 2 - x / 2 in the first mode, which nothing ends
        system = System([x], [(number + 1.0) / number - x / number], interval=1.0)
        assert system.modes == (("low", "high"),)
        for mode, k in ((0, 2.0), (1, 3.0)):
            end = integrate(system, [0.0], 1, modes=[mode]).end[0]
            assert end == pytest.approx((k + 1.0) * (1.0 - np.exp(-1.0 / k)), abs=CLOSE)

    def test_a_chosen_formula_may_hold_states_and_arrays(self) -> None:
        q = state_array("q", 2)
        unit = Unit("off", "not so off")
        rates = unit.choose({"off": 1.0, "not so off": -2.0 * q})
        system = System(q, rates, interval=1.0)
        run = integrate(system, [1.0, 2.0], 1, modes=[[0], [1]])
        assert run.end[0] == pytest.approx([2.0, 3.0], abs=CLOSE)
        assert run.end[1] == pytest.approx(np.exp(-2.0) * np.array([1.0, 2.0]), abs=CLOSE)

    def test_what_is_shared_is_computed_once(self) -> None:
        x, v = states("x", "v")
        strain = x - 0.5 * v
        square = strain**2
        system = System([x, v], [square + strain**3, strain**2 - v], interval=1.0)
        # strain, its square, its cube, and two sums
        assert system.program.quantities == 5

    def test_a_number_that_is_none_is_refused_where_it_is_written(self) -> None:
        with pytest.raises(DefinitionError, match="nan cannot stand in a formula"):
            np.nan * states("x")[0]

    def test_what_cannot_be_calculated_with_is_a_type_error(self) -> None:
        x: Any = states("x")[0]
        for nonsense in ("1", None, 1j, object()):
            with pytest.raises(TypeError):
                x + nonsense


class TestDefinition:
    def test_what_makes_no_system_is_refused_with_a_reason(self) -> None:
        x, v = states("x", "v")
        (p,) = parameters("p")
        forcing = Forcing(1.0)
        unit = Unit("only")

        def refused(message: str, *args: Any, **more: Any) -> None:
            with pytest.raises(DefinitionError, match=message):
                System(*args, **more)

        refused("2 states and 1 rates", [x, v], [v], forcing=forcing)
        refused("named twice", [x, x], [v, v], forcing=forcing)
        refused("needs a state", [], [], forcing=forcing)
        refused("p is no state", [p], [1.0], forcing=forcing)
        refused("not among the states", [x], [v], forcing=forcing)
        refused("by its forcing or at an interval", [x], [x])
        refused("by its forcing or at an interval", [x], [x], forcing=forcing, interval=1.0)
        refused("the interval must not change", [x], [x], interval=x)
        refused("not the forcing of the system", [x], [Forcing(1.0).cos], forcing=forcing)
        with pytest.raises(DefinitionError, match="must not change with time"):
            Forcing(x)
        with pytest.raises(DefinitionError, match="'other' is not one of the modes"):
            unit.transition("only", "other", falling=x)
        with pytest.raises(DefinitionError, match="one guard"):
            unit.transition("only", "only")
        with pytest.raises(DefinitionError, match="one is needed for each of"):
            unit.choose(other=1.0)
        with pytest.raises(DefinitionError, match="no modes"):
            Unit("a", "a")
        with pytest.raises(DefinitionError, match=r"\[x, x\]: each state is reset once"):
            unit.transition("only", "only", falling=x, reset=[(x, 1.0), (x, 2.0)])
        with pytest.raises(DefinitionError, match=r"shape \(2,\) for one of shape \(\)"):
            unit.transition("only", "only", falling=x, reset={v: [1.0, 2.0]})

    def test_a_system_survives_a_journey_to_another_process(self, ball: System) -> None:
        again = pickle.loads(pickle.dumps(ball))
        values = {"A": 1.2, "e": 0.8}
        assert repr(again) == repr(ball)
        assert (rest(again, [3.0, 0.0], **values) == rest(ball, [3.0, 0.0], **values)).all()

    def test_scales_are_positive_and_belong_to_states(self) -> None:
        (unit,) = parameters("unit")
        x, v = states("x", "v", scale=(1e-6, unit**2))
        q = state_array("q", 2, scale=3.0)
        (free,) = states("free")
        system = System([x, v, q, free], [v, -x, -q, 0.0], interval=1.0)
        assert system.parameters == {"unit": ()}
        again = pickle.loads(pickle.dumps(system))
        start = [1e-6, 0.0, 1.0, 2.0, 0.0]
        values = {"unit": 1e-3}
        assert (rest(again, start, **values) == rest(system, start, **values)).all()
        with pytest.raises(DefinitionError, match=r"the scale of a state is NaN|is -?0"):
            integrate(system, start, 1, parameters={"unit": 0.0})
        for scale, message in (
            (0.0, r"the scale of y is 0\.0: a positive number"),
            (-1, r"the scale of y is -1\.0: a positive number"),
            (np.inf, "inf cannot stand in a formula"),
            (x, "the scale of y is x: it must not change with time"),
            (
                [1.0, 2.0, 3.0],
                r"scale has the shape \(3,\): one number, or one for each of \['y', 'z'\]",
            ),
        ):
            with pytest.raises(DefinitionError, match=message):
                states("y", "z", scale=scale)

    def test_a_scale_says_how_small_a_state_matters(self) -> None:
        # an oscillation of 1e-9 is hardly worth a step where errors of 1e-10 are
        def steps(scale: float | None) -> tuple[int, float]:
            x, v = states("x", "v", scale=scale)
            run = integrate(System([x, v], [50.0 * v, -50.0 * x], interval=1.0), [1e-9, 0.0], 10)
            return int(run.steps), float(np.abs(run.end[0] - 1e-9 * np.cos(500.0)))

        (fine, small), (coarse, large) = steps(None), steps(1.0)
        assert small < 1e-6 * 1e-9  # 1e-10 a step, over some hundred steps
        assert large < CLOSE
        assert coarse < fine / 2

    def test_a_small_system_is_as_exact_as_a_large_one(self) -> None:
        # x' = y' = -k x y from x = y = s with k = 1/s: s/(1 + t), 0.3 s at t = 7/3
        x, y = states("x", "y")
        (k, s) = parameters("k", "s")
        gone = Unit("there", "gone")
        event = gone.transition("there", "gone", falling=x - 0.3 * s)
        system = System([x, y], [-k * x * y, -k * x * y], interval=4.0, transitions=[event])
        sizes = np.array([1e-12, 1.0, 1e6])
        starts = np.stack([sizes, sizes], axis=1)
        run = integrate(system, starts, 1, parameters={"k": 1 / sizes, "s": sizes})
        assert run.end / starts == pytest.approx(0.2, rel=CLOSE)
        assert run.switches.time == pytest.approx(7 / 3, rel=CLOSE)

    def test_a_system_sent_by_an_earlier_version_has_no_scales(self, ball: System) -> None:
        definition = ball._definition
        vars(definition).pop("scales")
        assert definition.scales == ()
        assert rest(pickle.loads(pickle.dumps(ball)), [3.0, 0.0], A=1.2, e=0.8).shape == (5, 2)

    def test_sums_may_be_long(self) -> None:
        # longer than Python's stack is deep
        (x,) = states("x")
        total = sum(1e-5 * x for _ in range(20_000))
        system = System([x], [total], interval=1.0)
        assert integrate(system, [1.0], 1).end[0] == pytest.approx(np.exp(0.2), rel=CLOSE)


class TestMembers:
    def test_each_member_has_its_own_parameters(self, duffing: System) -> None:
        forces, frequencies = np.linspace(0.1, 0.9, 5), np.linspace(0.5, 1.5, 3)[:, np.newaxis]
        both = {"f": forces, "omega": frequencies}
        run = integrate(duffing, [0.1, 0.0], 4, parameters=both)
        assert run.samples.shape == (3, 5, 4, 2)
        assert run.period[:, 0] == pytest.approx(2 * np.pi / frequencies[:, 0])
        alone = {"f": forces[2], "omega": frequencies[1, 0]}
        one = integrate(duffing, [0.1, 0.0], 4, parameters=alone)
        assert one.samples.shape == (4, 2)
        assert (one.samples == run.samples[1, 2]).all()
        assert (one.time == run.time[1, 2]).all()

    def test_parameters_may_be_arrays(self) -> None:
        q = state_array("q", 2)
        matrix = parameter_array("matrix", (2, 2))
        scale = parameters("scale")[0]
        system = System(q, scale * (matrix @ q), interval=1.0)
        values = np.array([[[-1.0, 0.0], [0.0, -2.0]], [[0.0, 1.0], [-1.0, 0.0]]])
        run = integrate(system, [1.0, 0.5], 1, parameters={"matrix": values, "scale": 0.5})
        turned = [np.cos(0.5) + 0.5 * np.sin(0.5), 0.5 * np.cos(0.5) - np.sin(0.5)]
        expected = [[np.exp(-0.5), 0.5 * np.exp(-1.0)], turned]
        assert run.end == pytest.approx(np.array(expected), abs=CLOSE)

    def test_threads_change_no_bit(self, ball: System) -> None:
        starts = np.stack([np.linspace(2.0, 4.0, 30), np.zeros(30)], axis=1)
        values = {"A": np.linspace(0.5, 1.5, 30), "e": 0.8}
        one, two = (integrate(ball, starts, 20, parameters=values, threads=n) for n in (1, 2))
        assert (one.samples.view(np.uint64) == two.samples.view(np.uint64)).all()
        assert (one.switches.time == two.switches.time).all()

    def test_no_members_give_empty_arrays(self, duffing: System) -> None:
        run = integrate(duffing, np.empty((0, 2)), 3, parameters={"f": 1.0, "omega": 1.0})
        assert run.samples.shape == (0, 3, 2)
        assert len(run.switches) == 0

    def test_what_does_not_fit_is_refused_by_name(self, duffing: System) -> None:
        values = {"f": 1.0, "omega": 1.0}

        def refused(kind: type[Exception], message: str, *args: Any, **more: Any) -> None:
            with pytest.raises(kind, match=message):
                integrate(duffing, *args, **{"parameters": values, **more})

        refused(ValueError, r"starts has the shape \(3,\): \(\.\.\., 2\)", [1.0, 2.0, 3.0], 1)
        refused(ValueError, r"\['f'\]: \['f', 'omega'\] are", [0, 0], 1, parameters={"f": 1.0})
        wrong = {"f": [1.0, 2.0], "omega": [1.0, 2.0, 3.0]}
        refused(ValueError, r"f \(2,\), omega \(3,\)", [0, 0], 1, parameters=wrong)
        refused(ValueError, r"modes has the shape", [0, 0], 1, modes=[0])
        refused(ValueError, "periods is -1", [0, 0], -1)
        refused(TypeError, r"periods is 1\.5", [0, 0], 1.5)
        refused(ValueError, "samples_per_period is 0", [0, 0], 1, samples_per_period=0)
        refused(ValueError, "tolerance = 1", [0, 0], 1, method=Taylor(tolerance=1.0))
        refused(TypeError, "tolerance holds strings", [0, 0], 1, method=Taylor(tolerance="x"))  # type: ignore[arg-type]
        refused(TypeError, "tolerance holds booleans", [0, 0], 1, method=Taylor(tolerance=True))
        refused(TypeError, "switches is 'yes': True or False", [0, 0], 1, switches="yes")
        refused(TypeError, r"parameters is \[1\]: a mapping", [0, 0], 1, parameters=[1])
        refused(TypeError, r"method is 'rk4'", [0, 0], 1, method="rk4")
        refused(ValueError, "instructions is 'fast'", [0, 0], 1, method=Taylor(instructions="fast"))  # type: ignore[arg-type]
        bad = {"f": 1.0, "omega": [1.0, -1.0]}
        refused(DefinitionError, r"member 1: the forcing frequency is -1", [0, 0], 1, parameters=bad)
        refused(MemoryError, "keep fewer", [0, 0], 2**50)

    def test_questions_about_what_is_no_system_are_refused(self, duffing: System) -> None:
        none: Any = "duffing"
        for ask in (
            lambda: integrate(none, [0.0, 0.0], 1),
            lambda: lyapunov(none, [0.0, 0.0], 1),
            lambda: find_orbit(none, [0.0, 0.0]),
        ):
            with pytest.raises(TypeError, match="system is 'duffing': a System is needed"):
                ask()
        values = {"f": 1.0, "omega": 1.0}
        for wrong, message in (
            ({"period": 2**70}, f"period is {2**70}: 1 to"),
            ({"iterations": 2**70}, f"iterations is {2**70}: 1 to"),
            ({"tolerance": -1.0}, r"tolerance is -1\.0: one positive number"),
            ({"tolerance": [1e-9, 1e-9]}, "tolerance is .*: one positive number"),
        ):
            with pytest.raises(ValueError, match=message):
                find_orbit(duffing, [0.0, 0.0], parameters=values, **wrong)

    def test_a_coefficient_that_is_not_finite_names_the_parameters(self) -> None:
        (x,), (p,) = states("x"), parameters("p")
        root: Any = p**0.5
        system = System([x], [root * x], interval=1.0)
        with pytest.raises(DefinitionError, match=r"a coefficient is NaN at the parameters \[-1"):
            integrate(system, [1.0], 1, parameters={"p": -1.0})


class TestSamples:
    def test_samples_within_a_period_lie_on_the_solution(self) -> None:
        x, v = states("x", "v")
        system = System([x, v], [v, -x], interval=2.5)
        for method, close in ((Taylor(), CLOSE), (RungeKutta4(steps_per_period=200), 1e-5)):
            run = integrate(system, [1.0, 0.0], 4, samples_per_period=7, method=method, transient=2)
            assert run.time.shape == (28,)
            assert run.time[6] == pytest.approx(7.5)
            assert np.abs(run.samples[:, 0] - np.cos(run.time)).max() < close
            assert np.abs(run.samples[:, 1] + np.sin(run.time)).max() < close

    def test_a_transient_is_what_is_left_out(self, duffing: System) -> None:
        values = {"f": 0.3, "omega": 1.0}
        run = integrate(duffing, [0.1, 0.0], 10, parameters=values)
        late = integrate(duffing, [0.1, 0.0], 4, parameters=values, transient=6)
        assert (late.samples == run.samples[6:]).all()
        assert (late.time == run.time[6:]).all()
        assert late.periods == 10

    def test_a_run_goes_on_where_another_ended(self, ball: System) -> None:
        values = {"A": 1.2, "e": 0.8}
        run = integrate(ball, [3.0, 0.0], 10, parameters=values)
        half = integrate(ball, [3.0, 0.0], 5, parameters=values)
        more = integrate(ball, half.end, 5, parameters=values, modes=half.end_modes)
        assert (more.samples == run.samples[5:]).all()

    def test_a_dropped_ball_hits_the_floor_when_and_as_fast_as_newton_says(self) -> None:
        y, v = states("y", "v")
        unit = Unit("flight")
        bounce = unit.transition("flight", "flight", falling=y, reset={v: -0.5 * v})
        system = System([y, v], [v, -9.81], interval=1.0, transitions=[bounce])
        heights = np.array([1.0, 2.0, 8.0])
        run = integrate(system, np.stack([heights, 0 * heights], axis=1), 1)
        first = [run.switches.of(member) for member in range(3)]
        times = np.sqrt(2 * heights[:2] / 9.81)
        assert [one.time[0] for one in first[:2]] == pytest.approx(times, abs=1e-12)
        speeds = [one.state[0, 1] for one in first[:2]]
        assert speeds == pytest.approx(-np.sqrt(2 * 9.81 * heights[:2]), abs=1e-11)
        assert len(first[2]) == 0

    def test_a_ball_that_comes_to_rest_ends_with_a_word(self) -> None:
        y, v = states("y", "v")
        unit = Unit("flight")
        bounce = unit.transition("flight", "flight", falling=y, reset={v: -0.5 * v})
        system = System([y, v], [v, -1.0], interval=1.0, transitions=[bounce])
        # at rest after 3 sqrt(2) = 4.24, so in the fifth period
        run = integrate(system, [1.0, 0.0], 6)
        assert run.status == "chattering"
        assert "max_switches" in str(run.reason)
        assert run.periods == 4
        assert np.isfinite(run.samples[:4]).all()
        assert np.isnan(run.samples[4:]).all()
        assert not run.completed
        assert "0 of 1 completed" in repr(run)

    def test_a_mode_that_kicks_itself_for_ever_is_told_what_is_wrong_with_its_guard(self) -> None:
        # the guard depends on the forcing alone, so no reset of states moves it back
        x, v = states("x", "v")
        forcing, unit = Forcing(1.0), Unit("only")
        kick = unit.transition("only", "only", rising=forcing.sin, reset={v: v + 0.1})
        system = System([x, v], [v, -x], forcing=forcing, transitions=[kick])
        run = integrate(system, [1.0, 0.0], 3)
        assert run.status == "chattering"
        assert "switches at one instant" in str(run.reason)
        assert "let the switch move it back, or enter a mode with another guard" in str(run.reason)
        # as the message says: two modes, which the sine enters by turns, and a kick at each rise
        unit = Unit("before", "after")
        kick = unit.transition("before", "after", rising=forcing.sin, reset={v: v + 0.1})
        back = unit.transition("after", "before", falling=forcing.sin)
        system = System([x, v], [v, -x], forcing=forcing, transitions=[kick, back])
        run = integrate(system, [1.0, 0.0], 3, modes=[1])
        assert run.completed
        assert (run.switches.target == 1).sum() == 3

    def test_a_reset_may_move_its_own_guard(self) -> None:
        (x,) = states("x")
        unit = Unit("ramp")
        wrap = unit.transition("ramp", "ramp", rising=x - 1.0, reset={x: 0.0})
        system = System([x], [1.0], interval=0.7, transitions=[wrap])
        run = integrate(system, [0.0], 20)
        # x = t mod 1, the 10th and 20th sample at a reset: the state after it
        times = np.arange(1, 21) * 0.7
        assert run.samples[:, 0] == pytest.approx((times + 1e-9) % 1.0 - 1e-9, abs=CLOSE)

    def test_a_wall_changes_modes_at_its_surface(self) -> None:
        x, v = states("x", "v")
        forcing, wall = Forcing(1.0), Unit("free", "contact")
        gap = 0.5 - x
        push = wall.choose(free=0.0, contact=20.0 * gap)
        system = System(
            [x, v],
            [v, forcing.cos - 0.1 * v - x + push],
            forcing=forcing,
            transitions=[
                wall.transition("free", "contact", falling=gap),
                wall.transition("contact", "free", rising=gap),
            ],
        )
        run = integrate(system, [0.0, 0.0], 20, samples_per_period=50)
        assert len(run.switches) > 20
        assert run.switches.state[:, 0] == pytest.approx(0.5, abs=1e-12)
        entered = run.switches.target == 1
        assert (run.switches.state[entered, 1] > 0).all()
        assert ((run.samples[:, 0] > 0.5) == (run.modes[:, 0] == 1)).all()
        # The same with a guard of its own for leaving, which vanishes where the other one does.
        force = 7.0 * gap
        again = System(
            [x, v],
            [v, forcing.cos - 0.1 * v - x + push],
            forcing=forcing,
            transitions=[
                wall.transition("free", "contact", falling=gap, vanishing={force: 1}),
                wall.transition("contact", "free", rising=force, vanishing={gap: 1}),
            ],
        )
        other = integrate(again, [0.0, 0.0], 20)
        assert other.switches.time == pytest.approx(run.switches.time, abs=CLOSE)
        assert (other.switches.target == run.switches.target).all()


class TestQuestions:
    def test_a_ball_bounces_once_a_period_where_the_formula_says(self, ball: System) -> None:
        # A sin t = pi (1 - e)/(1 + e) at the bounce, up at the speed pi. The table is at -A cos t, and
        # the stable motion bounces while it slows down.
        a, e = 0.6, 0.8
        bounce = np.pi - np.arcsin(np.pi * (1 - e) / (1 + e) / a)
        before = 2 * np.pi - bounce
        start = [-a * np.cos(bounce) + np.pi * before - before**2 / 2, np.pi - before]
        orbit = find_orbit(ball, start, parameters={"A": a, "e": e})
        assert (orbit.period, orbit.stable, len(orbit.switch_time)) == (1, True, 1)
        assert orbit.switch_time[0] * 2 * np.pi == pytest.approx(bounce, abs=1e-10)
        # each bounce multiplies areas by e^2
        assert np.prod(orbit.multipliers).real == pytest.approx(e**2, abs=1e-10)
        assert np.linalg.det(orbit.monodromy) == pytest.approx(e**2, abs=1e-10)
        twice = find_orbit(ball, start, period=2, parameters={"A": a, "e": e})
        assert twice.period == 1

    def test_a_linear_oscillator_has_the_multipliers_of_its_eigenvalues(self) -> None:
        x, v = states("x", "v")
        forcing = Forcing(0.9)
        system = System([x, v], [v, forcing.sin - 0.2 * v - x], forcing=forcing)
        orbit = find_orbit(system, [0.0, 0.0])
        expected = np.exp(np.roots([1.0, 0.2, 1.0]) * 2 * np.pi / 0.9)
        found = np.sort_complex(orbit.multipliers)
        assert found == pytest.approx(np.sort_complex(expected), abs=1e-11)

    def test_an_orbit_that_is_not_there_is_told(self, duffing: System) -> None:
        values = {"f": 0.3, "omega": 1.0}
        with pytest.raises(ComputationError, match="Newton's method"):
            find_orbit(duffing, [0.5, 0.5], parameters=values, iterations=1)
        with pytest.raises(ValueError, match="start has 2 places and period is 3"):
            find_orbit(duffing, [[0.5, 0.5]] * 2, period=3, parameters=values)
        with pytest.raises(ValueError, match="one value of each parameter"):
            find_orbit(duffing, [[0.5, 0.5]] * 2, parameters={"f": [0.3, 0.4], "omega": 1.0})

    def test_uedas_attractor_has_its_published_exponents(self) -> None:
        # 0.1034 and -0.1534: Sprott, Chaos and Time-Series Analysis (2003), appendix A
        x, v = states("x", "v")
        forcing = Forcing(1.0)
        system = System([x, v], [v, 7.5 * forcing.cos - 0.05 * v - x**3], forcing=forcing)
        starts = [[2.5 + 0.01 * i, 0.0] for i in range(8)]
        found = lyapunov(system, starts, 1000)
        assert found.exponents.shape == (8, 2)
        assert (found.status == "completed").all()
        mean = found.exponents.mean(axis=0)
        error = np.sqrt((found.standard_errors**2).sum(axis=0)) / 8
        assert (np.abs(mean - [0.1034, -0.1534]) < 4 * error).all()
        assert (error < 2e-3).all()
        assert found.exponents.sum(axis=1) == pytest.approx(-0.05, abs=1e-9)
        assert (np.abs(found.dimension - 1.674) < 5 * found.dimension_error).all()

    def test_stiff_directions_have_their_exponents(self) -> None:
        x, y = states("x", "y")
        system = System([x, y], [-50.0 * x, -y], interval=1.0)
        found = lyapunov(system, [1.0, 1.0], 100)
        exact = np.array([-1.0, -50.0])
        # tolerance 1e-10 per step
        assert found.exponents == pytest.approx(exact, abs=1e-6)
        assert (found.intervals[:, 0] <= exact).all()
        assert (found.intervals[:, 1] >= exact).all()
        assert (found.standard_errors < 1e-5).all()

    def test_exponents_of_a_cycle_are_those_of_its_multipliers(self) -> None:
        x, v = states("x", "v")
        forcing = Forcing(0.9)
        system = System([x, v], [v, forcing.sin - 0.2 * v - x], forcing=forcing)
        found = lyapunov(system, [0.3, 0.0], 77, transient=100)
        assert found.on_cycle
        # both of the complex pair decay by half of the damping
        assert found.exponents == pytest.approx(np.array([-0.1, -0.1]), abs=1e-10)

    def test_an_orbit_has_what_is_kept_from_the_start(self) -> None:
        # the pendulum with sine and cosine as states keeps s^2 + c^2; the multipliers beside 1 are those
        # of the pendulum in its angle
        s, c, w = states("s", "c", "w")
        forcing = Forcing(2 / 3)
        rates = [c * w, -s * w, -s - 0.5 * w + 1.07 * forcing.cos]
        system = System([s, c, w], rates, forcing=forcing)
        with pytest.warns(UserWarning, match="one of a family"):
            orbit = find_orbit(system, [0.0, 1.0, 1.9])
        assert np.hypot(*orbit.states[0, :2]) == pytest.approx(1.0, abs=1e-9)
        assert orbit.states[0, 2] == pytest.approx(1.95620844, abs=1e-8)
        assert (orbit.stability, orbit.stable, orbit.in_family) == ("unstable", False, True)
        expected = [-1.12962897, 1.0, -0.00795243]
        assert orbit.multipliers.real == pytest.approx(expected, abs=1e-8)

    def test_fewer_exponents_are_the_largest(self, duffing: System) -> None:
        values = {"f": 0.3, "omega": 1.0}
        both = lyapunov(duffing, [0.1, 0.0], 50, parameters=values)
        largest = lyapunov(duffing, [0.1, 0.0], 50, parameters=values, count=1)
        assert largest.exponents == pytest.approx(both.exponents[:1], abs=1e-6)
        with pytest.raises(ValueError, match="count is 3: 1 to 2"):
            lyapunov(duffing, [0.1, 0.0], 50, parameters=values, count=3)

    def test_progress_counts_periods(self, duffing: System) -> None:
        told: list[tuple[str, int, int | None]] = []
        values = {"f": [0.3, 0.4], "omega": 1.0}
        integrate(
            duffing,
            [0.0, 0.0],
            10,
            parameters=values,
            transient=5,
            progress=lambda *now: told.append(now),
        )
        assert told[-1] == ("integrating", 30, 30)


class TestProgram:
    """The native side is reached by altered pickles, too."""

    RIGHT: ClassVar[dict[str, Any]] = {
        "operations": [("state", [], 0.0), ("number", [], 1.0), ("add", [0, 1], 0.0)],
        "parameters": 0,
        "rates": [2],
        "forced": False,
        "clock": 1,
        "units": [[[(0, 1.0, 0, [(0, 1)], [(0, 1)])]]],
        "scales": [1],
    }

    @pytest.mark.parametrize(
        "altered",
        [
            {"operations": [("add", [0, 0], 0.0)], "rates": [0], "clock": 0, "units": (), "scales": ()},
            {"operations": [("state", [], 1.0), ("number", [], 1.0), ("add", [0, 1], 0.0)]},
            {"operations": [("state", [], 0.5), ("number", [], 1.0), ("add", [0, 1], 0.0)]},
            {"operations": [("state", [], -1.0), ("number", [], 1.0), ("add", [0, 1], 0.0)]},
            {"operations": [("parameter", [], 0.0), ("number", [], 1.0), ("add", [0, 1], 0.0)]},
            {"operations": [("forcing cos", [], 0.0), ("number", [], 1.0), ("add", [0, 1], 0.0)]},
            {"operations": [("state", [], 0.0), ("number", [], 1.0), ("add", [0, 5], 0.0)]},
            {"operations": [("state", [], 0.0), ("number", [], 1.0), ("add", [0, 2], 0.0)]},
            {"operations": [("state", [], 0.0), ("number", [], 1.0), ("choice", [1, 1], 0.0)]},
            {"operations": [("state", [], 0.0), ("number", [], 1.0), ("choice", [1], 1.0)]},
            {"operations": [("state", [], 0.0), ("number", [], 1.0), ("erf", [0], 0.0)]},
            {"rates": []},
            {"rates": [3]},
            {"clock": 3},
            {"scales": [3]},
            {"scales": [1, 1]},
            {"units": [[]]},
            {"units": [[[]] * 257]},
            {"units": [[[]]] * 257},
            {"units": [[[(3, 1.0, 0, [], [])]]]},
            {"units": [[[(0, 0.0, 0, [], [])]]]},
            {"units": [[[(0, np.nan, 0, [], [])]]]},
            {"units": [[[(0, 1.0, 1, [], [])]]]},
            {"units": [[[(0, 1.0, 0, [(1, 0)], [])]]]},
            {"units": [[[(0, 1.0, 0, [(0, 3)], [])]]]},
            {"units": [[[(0, 1.0, 0, [], [(3, 1)])]]]},
        ],
        ids=str,
    )
    def test_what_names_something_that_is_not_there_is_no_program(self, altered: Any) -> None:
        with pytest.raises(DefinitionError):
            _native.Program(**{**self.RIGHT, **altered})

    def test_rows_must_fit(self) -> None:
        program = _native.Program(**self.RIGHT)
        assert program.periods(np.empty((1, 0))) == [1.0]
        with pytest.raises(DefinitionError):
            program.periods(np.empty((1, 2)))
        asked = {"parameters": np.empty((1, 0)), "starts": np.ones((1, 1))}
        with pytest.raises(DefinitionError, match="member 0: a mode that its unit does not have"):
            program.find_orbit(
                **asked,
                modes=np.ones((1, 1), np.uint8),
                period=1,
                tolerance=1e-9,
                iterations=5,
                settings=Options(Taylor(), 100, 1),
            )
