"""An operation that makes no formula is refused at once, and the message says what to write instead."""

from __future__ import annotations

import copy
import math
import operator
import pickle
from typing import Any

import numpy as np
import pytest

from saltus import DefinitionError, FormulaError, SaltusError
from saltus.systems import (
    Forcing,
    System,
    Unit,
    integrate,
    parameter_array,
    parameters,
    state_array,
    states,
)

x: Any = states("x")[0]
v: Any = states("v")[0]
p: Any = parameters("p")[0]
q: Any = state_array("q", 3)

#: What asks for a sign and has no switch.
SWITCHING = {
    "x == 0": lambda: x == 0,
    "x != 0.5": lambda: x != 0.5,
    "q == 0": lambda: q == 0,
    "[x, v] > 0": lambda: np.array([x, v]) > 0,
    "sorted": lambda: sorted([x, v]),
    "max": lambda: max(x, 0.0),
    "min": lambda: min(0.0, x),
    "np.max": lambda: np.max(q),
    "np.copysign": lambda: np.copysign(1.0, x),
    "np.interp": lambda: np.interp(x, [0.0, 1.0], [0.0, 2.0]),
    "if x > 0": lambda: 1.0 if x > 0 else 0.0,
    "0 < x < 1": lambda: np.where(0.0 < x < 1.0, x, 0.0),
    "not x > 0": lambda: not x > 0,
}
#: What asks for a sign and is a switch.
CONDITIONS = {
    "x > 0": lambda: x > 0,
    "x >= v": lambda: x >= v,
    "0.0 < x": lambda: 0.0 < x,  # noqa: SIM300
    "np.float64 > x": lambda: np.float64(1.0) > x,
    "array > x": lambda: (np.arange(3.0) > x)[0],
    "q > 0": lambda: (q > 0)[0],
    "joined": lambda: (x > 0) & ~(v > 0) | (x > v),
}
#: What asks how often something fits.
ROUNDING = {
    "x % 2": lambda: x % 2,
    "7 % x": lambda: 7 % x,
    "x // 2": lambda: x // 2,
    "2 // x": lambda: 2 // x,
    "q % 1.0": lambda: q % 1.0,
    "divmod": lambda: divmod(x, 2),
    "round": lambda: round(x),
    "round to": lambda: round(x, 2),
    "math.floor": lambda: math.floor(x),
    "math.ceil": lambda: math.ceil(x),
    "math.trunc": lambda: math.trunc(x),
    "np.floor": lambda: np.floor(x),
    "np.round": lambda: np.round(x),
    "np.round of an array": lambda: np.round(q, 1),
    "np.rint": lambda: np.rint(q),
    "np.fmod": lambda: np.fmod(x, 1.0),
    "np.mod of an array": lambda: np.mod(q, 1.0),
    "np.modf": lambda: np.modf(x),
}
#: Functions that formulas do not hold.
FUNCTIONS = {
    "np.arctan2": lambda: np.arctan2(x, v),
    "np.cbrt": lambda: np.cbrt(x),
    "np.log10": lambda: np.log10(x),
    "np.log1p of an array": lambda: np.log1p(q),
    "np.logaddexp": lambda: np.logaddexp(x, v),
    "np.float_power": lambda: np.float_power(x, 2.0),
    "np.isfinite": lambda: np.isfinite(x),
    "np.isnan of an array": lambda: np.isnan(q),
    "np.sinc": lambda: np.sinc(x),
    "np.spacing": lambda: np.spacing(x),
    "x @ v": lambda: x @ v,
    "x & v": lambda: x & v,
    "~x": lambda: ~x,
    "x << 1": lambda: x << 1,
}
#: Functions that they do.
FORMULAS = {
    "abs": lambda: abs(x),
    "np.abs": lambda: np.abs(q),
    "np.fabs": lambda: np.fabs(x),
    "np.sign": lambda: np.sign(v),
    "np.sign of an array": lambda: np.sign(q),
    "np.maximum": lambda: np.maximum(0.0, x),
    "np.minimum of arrays": lambda: np.minimum(q, 1.0),
    "np.fmax": lambda: np.fmax(x, v),
    "np.clip": lambda: np.clip(x, 0.0, 1.0),
    "np.clip of an array": lambda: np.clip(q, 0.0, 1.0),
    "q.clip": lambda: q.clip(0.0, 1.0),
    "np.heaviside": lambda: np.heaviside(x, 0.5),
    "np.heaviside of an array": lambda: np.heaviside(q, 0.5),
    "np.where": lambda: np.where(x > 0.0, x, 0.0),
    "np.where of an array": lambda: np.where(q > 0.0, q, 0.0),
    "np.tanh of an array": lambda: np.tanh(q),
    "np.tanh of [x, v]": lambda: np.tanh([x, v]),
    "np.sqrt": lambda: np.sqrt(x**2 + v**2),
    "np.linalg.norm": lambda: np.linalg.norm([x, v]),
    "np.hypot": lambda: np.hypot(x, v),
    "np.hypot of an array": lambda: np.hypot(q, v),
    "np.arcsin": lambda: np.arcsin(x),
    "np.arccos": lambda: np.arccos(x),
    "np.reciprocal": lambda: np.reciprocal(x),
    "1 / x": lambda: 1.0 / x,
    "p / q": lambda: p / q,
    "x ** -1": lambda: x**-1,
    "x ** 0.5": lambda: x**0.5,
    "x ** p": lambda: x**p,
    "2 ** x": lambda: 2**x,
}
#: What asks for the number that a formula is not.
VALUES = {
    "bool": lambda: bool(x),
    "if": lambda: 1 if x else 0,
    "not": lambda: not x,
    "and": lambda: x and v,
    "float": lambda: float(x),
    "int": lambda: int(x),
    "complex": lambda: complex(x),
    "math.sin": lambda: math.sin(x),
    "math.exp of a parameter": lambda: math.exp(p),
    "math.hypot": lambda: math.hypot(x, v),
    "range": lambda: range(x),
    "an index": lambda: [1, 2, 3][x],
    "operator.index": lambda: operator.index(x),
    "iteration": lambda: list(x),
    "unpacking": lambda: (lambda *of: of)(*x),
    "in": lambda: 0.5 in x,
    "list * x": lambda: [1.0] * x,
    "an array of floats": lambda: np.array([x, v], dtype=float),
    "np.float64": lambda: np.float64(x),
    "an entry": lambda: np.zeros(2).__setitem__(0, x),
    "entries": lambda: np.zeros(3).__setitem__(slice(None), q),
}
#: Formulas of parameters that there are not.
OF_PARAMETERS = {
    "p > 0": lambda: p > 0,
    "p % 2": lambda: p % 2,
    "np.maximum": lambda: np.maximum(p, 0.0),
    "np.floor": lambda: np.floor(parameter_array("k", 2)),
}


def cases(group: dict[str, Any]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize("nonsense", group.values(), ids=group.keys())


def said(nonsense: Any) -> str:
    with pytest.raises(FormulaError) as refused:
        nonsense()
    assert isinstance(refused.value, SaltusError)
    assert isinstance(refused.value, DefinitionError)
    assert isinstance(refused.value, TypeError)
    return str(refused.value)


@cases(SWITCHING)
def test_what_asks_for_a_sign_is_pointed_to_where(nonsense: Any) -> None:
    assert "numpy.where(" in said(nonsense)


@cases(CONDITIONS)
def test_a_comparison_is_a_condition(nonsense: Any) -> None:
    condition = nonsense()
    assert type(np.where(condition, x, 1.0)) is type(x)
    assert ">" in repr(condition)


@cases(FORMULAS)
def test_functions_make_formulas(nonsense: Any) -> None:
    formula = nonsense()
    assert type(formula.flat[0] if isinstance(formula, np.ndarray) else formula) is type(x)


@cases(ROUNDING)
def test_what_rounds_is_pointed_to_resets(nonsense: Any) -> None:
    assert "reset={" in said(nonsense)


@cases(FUNCTIONS)
def test_what_is_another_function_is_told_what_there_is(nonsense: Any) -> None:
    message = said(nonsense)
    assert "sums, products, powers, quotients, sqrt" in message
    assert "further state" in message or "write " in message


@cases(VALUES)
def test_what_asks_for_a_number_is_told_that_there_is_none(nonsense: Any) -> None:
    assert "has no value before the system runs" in said(nonsense)


@cases(OF_PARAMETERS)
def test_what_formulas_of_parameters_do_not_hold_is_given_as_a_parameter(nonsense: Any) -> None:
    assert "give them as parameters of their own" in said(nonsense)


def test_messages_name_operation_and_operands() -> None:
    assert said(lambda: np.floor(v)).startswith("floor of v: formulas hold")
    assert said(lambda: np.copysign(0.0, x)).startswith("copysign of 0.0 and x: ")
    assert said(lambda: bool(x > 0)).startswith("bool((x > 0.0)): ")
    assert said(lambda: 7 % x).startswith("7 % x: ")
    assert said(lambda: math.sin(x)).startswith("float(x): ")
    assert said(lambda: 0.5 in x).startswith("0.5 in x: ")
    assert said(lambda: np.cbrt(q)).startswith("cbrt of q[0]: ")
    assert said(lambda: np.copysign(q, 0.5)).startswith("copysign of [q[0], ...] and 0.5: ")
    assert said(lambda: x * 1j).startswith("1j cannot stand in a formula")


def test_the_unit_that_stands_for_a_sign_is_that_sign() -> None:
    # |x| with x = cos t as the message says: its integral over a period is 4
    (a,) = states("a")
    side = Unit("below", "above")
    size = side.choose(below=-x, above=x)
    system = System(
        [x, v, a],
        [v, -x, size],
        interval=2 * np.pi,
        transitions=[
            side.transition("below", "above", rising=x),
            side.transition("above", "below", falling=x),
        ],
    )
    assert integrate(system, [1.0, 0.0, 0.0], 1, modes=[1]).end[2] == pytest.approx(4.0, abs=1e-9)


def test_what_is_a_formula_stays_one() -> None:
    stiffness = np.array([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 1.0]])
    for formulas in (
        stiffness @ q,
        np.dot(stiffness, q),
        np.einsum("ij,j->i", stiffness, q),
        np.float64(2.0) * q,
        q * np.array([1.0, 2.0, 3.0]),
        np.stack([q[0], q[1], q[2]]),
        np.concatenate([q[:2], [x]]),
        np.where([True, False, True], q, 0.0),
        np.sqrt(parameter_array("k", 3)),
        np.square(q),
        np.array([1.0, 2.0, 3.0]) * x,
    ):
        assert formulas.shape == (3,)
        assert formulas.dtype == object
        assert repr(formulas[0])
    for formula in (np.float64(2.0) * x, np.sum(q), np.mean(q), q.sum(), np.multiply(x, 2), np.exp(p)):
        assert type(formula) is type(x)
    total = np.array([x, v])
    total += 1.0
    assert repr(total[1]) == "(v + 1.0)"


def test_expressions_are_themselves() -> None:
    # a state may be looked for among others, and be a key
    assert [v, x].index(x) == 1
    assert x in (v, x)
    assert x != v
    assert x is not None
    assert x != "x"
    assert {x: 1, v: 2}[v] == 2
    assert not hasattr(x, "shape")
    again = pickle.loads(pickle.dumps([x, x * v]))
    assert again[1].of[0] is again[0]
    assert copy.deepcopy(q).shape == (3,)


def test_one_name_is_one_thing() -> None:
    def refused(message: str, *args: Any) -> None:
        with pytest.raises(DefinitionError, match=message):
            System(*args, interval=1.0)

    (twin,) = states("x")
    refused("two states have the name 'x'", [x, twin], [v, v])
    refused(r"two states have the name 'q\[1\]'", [q, states("q[1]")], [q, x])
    (like_x,) = parameters("x")
    refused("a state and a parameter have the name 'x'", [x], [like_x])
    refused("a state and a parameter have the name 'q'", q, parameter_array("q", 3))
    # one parameter may be asked for twice
    (one,), (other,) = parameters("k"), parameters("k")
    assert System([x], [one * x + other], interval=1.0).parameters == {"k": ()}


def test_a_second_forcing_is_told_apart_from_none() -> None:
    forcing, second = Forcing(1.0), Forcing(2.5)
    with pytest.raises(DefinitionError) as refused:
        System([x], [forcing.cos + second.sin], forcing=forcing)
    message = str(refused.value)
    assert (
        "the forcing sin of Forcing(2.5), which is not the forcing of the system, Forcing(1.0)"
        in message
    )
    assert "two further states c and s" in message
    with pytest.raises(DefinitionError, match=r"the system has no forcing: give it as forcing="):
        System([x], [forcing.cos], interval=1.0)
    for wrong in (1.0, [forcing, second]):
        with pytest.raises(DefinitionError, match="one Forcing is needed"):
            System([x], [forcing.cos], forcing=wrong)  # type: ignore[arg-type]
    with pytest.raises(DefinitionError, match=r"x is no transition: Unit\.transition makes them"):
        System([x], [v], forcing=forcing, transitions=[x])
    # a second frequency as the message says: c' = -w s, s' = w c, from (1, 0)
    c, s = states("c", "s")
    run = integrate(System([c, s], [-2.5 * s, 2.5 * c], forcing=forcing), [1.0, 0.0], 3)
    assert run.samples[:, 0] == pytest.approx(np.cos(2.5 * run.time), abs=1e-8)
