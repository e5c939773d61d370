"""Transforms of eight lanes against NumPy's, and the lanes themselves."""

from __future__ import annotations

import numpy
import pytest

from contact_sim_pkg.compiled.fourier import FURTHER, good_size, make_axis, transform
from contact_sim_pkg.compiled.jit import entry
from contact_sim_pkg.compiled.lanes import WIDTH, load, store, transpose

LENGTHS = [1, 2, 3, 4, 5, 6, 7 + 1, 9, 10, 25, 27, 60, 90, 96, 125, 128, 360]


@entry
def transformed(axis, signal, other):
    return transform(axis, signal, other)


@entry
def weighed(number, numbers, out):
    store(out, 1, number * load(numbers, 2) + load(numbers, 0) - load(numbers, 0) * load(numbers, 1))


@entry
def transposed(source, first, stride, target, first_there, stride_there):
    transpose(source, first, stride, target, first_there, stride_there)


def lanes_of(numbers):
    return numpy.stack([numbers.real, numbers.imag], axis=1).ravel()


def exchanged(numbers):
    return numbers.imag + 1j * numbers.real


def numbers_of(buffer, length):
    parts = buffer.reshape(-1, 2, WIDTH)[:length]
    return parts[:, 0] + 1j * parts[:, 1]


@pytest.mark.parametrize("length", LENGTHS)
def test_transform_equals_numpy_s(length):
    random = numpy.random.default_rng(length)
    numbers = random.standard_normal((length, WIDTH)) + 1j * random.standard_normal((length, WIDTH))
    signal, other, axis = lanes_of(numbers), numpy.full(length * FURTHER, numpy.nan), make_axis(length)
    found = other if transformed(axis, signal, other) else signal
    assert numbers_of(found, length) == pytest.approx(numpy.fft.fft(numbers, axis=0), abs=1e-14 * length)


@pytest.mark.parametrize("length", LENGTHS)
def test_exchanged_parts_give_the_inverse_times_the_length(length):
    random = numpy.random.default_rng(length)
    numbers = random.standard_normal((length, WIDTH)) + 1j * random.standard_normal((length, WIDTH))
    signal, other, axis = lanes_of(exchanged(numbers)), numpy.full(length * FURTHER, numpy.nan), make_axis(length)
    found = other if transformed(axis, signal, other) else signal
    assert exchanged(numbers_of(found, length)) == pytest.approx(
        length * numpy.fft.ifft(numbers, axis=0), abs=1e-14 * length
    )


@pytest.mark.parametrize(("count", "size"), [(0, 1), (1, 1), (7, 8), (11, 12), (13, 15), (61, 64), (97, 100)])
def test_good_size_is_the_next_product_of_two_three_and_five(count, size):
    assert good_size(count) == size


@pytest.mark.parametrize("length", [0, -4, 7, 22])
def test_a_length_without_a_fast_transform_is_refused(length):
    with pytest.raises(ValueError, match=f"length is {length}, it must be a product of 2, 3 and 5"):
        make_axis(length)


def test_lanes_are_computed_one_by_one():
    numbers, out = numpy.arange(1.0, 12.0), numpy.zeros(10)
    weighed(3.0, numbers, out)
    first, next_, third = (numbers[start : start + WIDTH] for start in range(3))
    assert out.tolist() == [0.0, *(3.0 * third + first - first * next_), *numpy.zeros(9 - WIDTH)]


def test_a_tile_is_transposed_between_any_strides():
    source, target = numpy.arange(200.0), numpy.full(100, -1.0)
    transposed(source, 5, 20, target, 3, 10)
    tile = source[5 : 5 + 20 * WIDTH].reshape(WIDTH, 20)[:, :WIDTH]
    assert target[3 : 3 + 10 * WIDTH].reshape(WIDTH, 10)[:, :WIDTH].tolist() == tile.T.tolist()
    assert (target == -1.0).sum() == 100 - WIDTH**2
