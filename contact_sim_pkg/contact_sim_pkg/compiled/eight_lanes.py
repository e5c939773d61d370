"""Eight numbers at a time in compiled code: vectors of the processor, as a type that kernels
compute with.

A loop over eight neighbours is vectorised by the compiler only where it can show that nothing it
writes is read later. In a transform, which goes back and forth between two buffers, it cannot. A
value of this type is loaded, computed with `+`, `-` and `*`, and stored; where a processor's
vectors are shorter, the compiler takes several. The order of operations is that of the source, so
results are the same bits on every processor.
"""

# numba has no types.
# mypy: disallow-any-expr=False, disallow-untyped-calls=False, disallow-any-unimported=False

from __future__ import annotations

import operator
from collections.abc import Callable
from typing import Any

import numpy
from llvmlite import ir
from numba.core import config, types
from numba.core.errors import TypingError
from numba.core.typing.templates import ConcreteTemplate, infer_global, signature
from numba.extending import intrinsic, lower_builtin, models, register_model
from numba.np.arrayobj import make_array
from numpy.typing import NDArray

__all__ = ["WIDTH", "load", "store", "transpose"]

WIDTH = 8

_VECTOR = ir.VectorType(ir.DoubleType(), WIDTH)
_INDEX = ir.IntType(64)


class Lanes(types.Type):
    """Type of eight float64 in one vector."""

    def __init__(self) -> None:
        """One type, by its name."""
        super().__init__(name="Lanes")


lanes = Lanes()


@register_model(Lanes)
class _LanesModel(models.PrimitiveModel):
    def __init__(self, manager: Any, numba_type: Any) -> None:
        super().__init__(manager, numba_type, _VECTOR)


def _place(context: Any, builder: Any, array_type: Any, array: Any, index: Any) -> Any:
    """Pointer to a vector from element ``index`` of a contiguous array on."""
    data = make_array(array_type)(context, builder, array).data
    return builder.bitcast(builder.gep(data, [index]), _VECTOR.as_pointer())


def _load(builder: Any, place: Any) -> Any:
    value = builder.load(place)
    value.align = 8
    return value


def _store(builder: Any, value: Any, place: Any) -> None:
    builder.store(value, place).align = 8


def _require_rows(*arrays: Any) -> None:
    """Refuse, as it is compiled, what does not lie in memory row after row."""
    for array in arrays:
        if array.layout != "C" or array.dtype != types.float64:
            raise TypingError(f"lanes: an array is {array}; it must be float64 and contiguous by rows")


def _load_lanes(typing_context: Any, array: Any, index: Any) -> Any:
    """Lanes from element ``index`` of a contiguous array on, in its order of memory. The index is not
    checked.
    """
    _require_rows(array)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return _load(builder, _place(context, builder, signature.args[0], *arguments))

    return lanes(array, types.intp), generate


def _store_lanes(typing_context: Any, array: Any, index: Any, value: Any) -> Any:
    """Write lanes from element ``index`` of a contiguous array on. The index is not checked."""
    _require_rows(array)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        array, index, value = arguments
        _store(builder, value, _place(context, builder, signature.args[0], array, index))
        return context.get_dummy_value()

    return types.void(array, types.intp, lanes), generate


def _transpose_lanes(
    typing_context: Any, source: Any, first: Any, stride: Any, target: Any, first_there: Any, stride_there: Any
) -> Any:
    """Transpose a tile of eight by eight numbers: lane j of the lanes at ``first + i stride`` of
    ``source`` becomes lane i of those at ``first_there + j stride_there`` of ``target``. Places are
    not checked.
    """
    _require_rows(source, target)

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        source, first, stride, target, first_there, stride_there = arguments
        of_source, of_target = signature.args[0], signature.args[3]

        def nth(first: Any, stride: Any, number: int) -> Any:
            return builder.add(first, builder.mul(stride, ir.Constant(_INDEX, number)))

        rows = [
            _load(builder, _place(context, builder, of_source, source, nth(first, stride, i))) for i in range(WIDTH)
        ]
        # Exchange halves, quarters and eighths between rows that lie as far apart.
        distance = WIDTH // 2
        while distance:
            for i in range(WIDTH):
                if i & distance == 0:
                    upper, lower = rows[i], rows[i + distance]
                    near = [k if k & distance == 0 else k - distance + WIDTH for k in range(WIDTH)]
                    far = [k + distance if k & distance == 0 else k + WIDTH for k in range(WIDTH)]
                    rows[i], rows[i + distance] = (
                        _picked(builder, upper, lower, near),
                        _picked(builder, upper, lower, far),
                    )
            distance //= 2
        for j, row in enumerate(rows):
            _store(builder, row, _place(context, builder, of_target, target, nth(first_there, stride_there, j)))
        return context.get_dummy_value()

    return types.void(source, types.intp, types.intp, target, types.intp, types.intp), generate


def _picked(builder: Any, first: Any, second: Any, lanes_of_both: list[int]) -> Any:
    mask = ir.Constant(ir.VectorType(ir.IntType(32), WIDTH), lanes_of_both)
    return builder.shuffle_vector(first, second, mask)


def _spread(builder: Any, number: Any) -> Any:
    """The same number in all lanes."""
    none = ir.Constant(_VECTOR, ir.Undefined)
    alone = builder.insert_element(none, number, ir.Constant(ir.IntType(32), 0))
    return _picked(builder, alone, none, [0] * WIDTH)


def _register(operation: Any, instruction: str) -> None:
    """Lanes with lanes, and a number times lanes."""
    cases = [signature(lanes, lanes, lanes), signature(lanes, types.float64, lanes)]
    infer_global(operation)(type(f"Lanes_{instruction}", (ConcreteTemplate,), {"cases": cases}))

    @lower_builtin(operation, Lanes, Lanes)
    def of_lanes(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return getattr(builder, instruction)(*arguments)

    @lower_builtin(operation, types.Float, Lanes)
    def of_number(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        return getattr(builder, instruction)(_spread(builder, arguments[0]), arguments[1])


for _operation, _instruction in ((operator.add, "fadd"), (operator.sub, "fsub"), (operator.mul, "fmul")):
    _register(_operation, _instruction)


Values = NDArray[numpy.float64]
ACROSS = numpy.arange(WIDTH)


def _load_plain(array: Values, index: int) -> Any:
    return array.reshape(-1)[index + ACROSS]


def _store_plain(array: Values, index: int, value: Any) -> None:
    array.reshape(-1)[index + ACROSS] = value


def _transpose_plain(
    source: Values, first: int, stride: int, target: Values, first_there: int, stride_there: int
) -> None:
    tile = source.reshape(-1)[first + stride * ACROSS[:, None] + ACROSS]
    target.reshape(-1)[first_there + stride_there * ACROSS[:, None] + ACROSS] = tile.T


def _intrinsic(generator: Any, plain: Any) -> Any:
    """With NUMBA_DISABLE_JIT=1 the same in Python, on arrays of eight."""
    return plain if config.DISABLE_JIT else intrinsic(generator)  # type: ignore[attr-defined]


load: Callable[[Values, int], float] = _intrinsic(_load_lanes, _load_plain)
store: Callable[[Values, int, float], None] = _intrinsic(_store_lanes, _store_plain)
transpose: Callable[[Values, int, int, Values, int, int], None] = _intrinsic(_transpose_lanes, _transpose_plain)
"""To a type checker lanes are a number: what is done with them is done with each."""
