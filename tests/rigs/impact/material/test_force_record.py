"""Impulse, duration and restitution from a force over time: closed forms, what is wrong said or refused, mutants."""

import json
import random

import numpy
import pytest
from scipy.special import beta

from contact_sim_pkg.cli.main import main
from contact_sim_pkg.rigs.impact.material.errors import MaterialError
from contact_sim_pkg.rigs.impact.material.force_record import read_force
from contact_sim_pkg.rigs.impact.theory.bodies import Material, Sphere
from contact_sim_pkg.rigs.impact.theory.motion import course, solve_impact

MASS, SPEED, TAU = 0.02, 2.0, 1.8e-3
IMPULSE = 0.06
"""[N s]: m V0 (1 + k) with k = 0.5"""
PEAK = IMPULSE * numpy.pi / (2.0 * TAU)
"""[N] of a half sine"""


def times(step=1e-5, before=2e-3, after=4e-3):
    return numpy.arange(round(before / step) + round((TAU + after) / step) + 1) * step - before


def pulse(time, power=1.0, start=0.0):
    """sin^p of an impulse of 0.060 N s from a start on."""
    phase = numpy.clip((time - start) / TAU, 0.0, 1.0)
    return PEAK * numpy.sin(numpy.pi * phase) ** power * (2.0 / beta(0.5, 0.5 * (power + 1.0)))


def record(path, time, force, header="time [s],force [N]", scale=(1.0, 1.0)):
    rows = zip(scale[0] * time, scale[1] * force, strict=True)
    path.write_text("\n".join([header, *(f"{t:.9g},{f:.9g}" for t, f in rows)]) + "\n")
    return path


def read(path, **options):
    return read_force(path, MASS, SPEED, **options)


@pytest.mark.parametrize("power", [1.0, 1.5, 2.0])
def test_a_pulse_of_known_impulse_gives_duration_and_restitution(tmp_path, power):
    """sin^p reaches 1/1000 of its peak at phase 0.001^(1/p): a line from there misses 0.3 % of the duration at p = 1.5 and 0.7 % at
    p = 2 on either side, with the step of the samples.
    """
    found = read(record(tmp_path / "f.csv", times(), pulse(times(), power)))
    assert found.impulse == pytest.approx(IMPULSE, rel=1e-4)
    assert found.restitution == pytest.approx(0.5, abs=2e-4)
    assert found.duration == pytest.approx(TAU, rel={1.0: 1e-4, 1.5: 6e-3, 2.0: 0.014}[power])
    assert found.notes == ()


def test_units_signs_names_and_offsets_are_taken_and_said(tmp_path):
    time, force = times(), pulse(times())
    cases = {
        "ms": (("Time (ms),Load (kN)",), {"scale": (1e3, 1e-3)}, {}, ""),
        "turned": (("time [s],f [N]",), {"scale": (1.0, -1.0)}, {}, "its sign is turned"),
        "bare": (("t,force",), {}, {}, "The column force has no unit: N is assumed"),
        "stated": (("t,channel_1",), {"scale": (1e3, 1.0)}, {"column": "channel_1", "time_unit": "ms"}, "N is assumed"),
    }
    for name, (header, written, options, said) in cases.items():
        found = read(record(tmp_path / f"{name}.csv", time, force, *header, **written), **options)
        assert found.restitution == pytest.approx(0.5, abs=1e-4), name
        assert found.duration == pytest.approx(TAU, rel=1e-4), name
        assert said in " ".join(found.notes), name
    found = read(record(tmp_path / "offset.csv", time, force + 7.0))
    assert found.restitution == pytest.approx(0.5, abs=1e-4)
    assert "An offset of 7 N, the zero before the contact, is taken off." in found.notes
    assert found.peak == pytest.approx(PEAK, rel=1e-4)
    twice = read(record(tmp_path / "twice.csv", time, force + 0.3 * pulse(time, start=3e-3)))
    assert twice.impulse == pytest.approx(IMPULSE, rel=1e-4)
    assert "another contact" in " ".join(twice.notes)
    drift = read(record(tmp_path / "drift.csv", time, force + numpy.where(time > TAU, 0.01 * PEAK, 0.0)))
    assert "The zero drifts by 0.524 N" in " ".join(drift.notes)


def test_noise_and_few_samples_cost_what_they_must(tmp_path):
    """Noise of 1 %: the impulse errs by sigma sqrt(n) dt, 0.0013; twelve samples hold a half sine to some percent."""
    chance, errors = numpy.random.default_rng(5), []
    for _ in range(20):
        noisy = pulse(times()) + 0.01 * PEAK * chance.standard_normal(len(times()))
        found = read(record(tmp_path / "f.csv", times(), noisy))
        errors.append((found.impulse / IMPULSE - 1.0, found.duration / TAU - 1.0))
    assert numpy.abs(errors).max(axis=0) == pytest.approx((0.0, 0.0), abs=0.03)
    assert numpy.std(errors, axis=0)[0] < 0.003
    coarse = times(step=TAU / 12.6)
    found = read(record(tmp_path / "f.csv", coarse, pulse(coarse)))
    assert 10 <= found.samples <= 13
    assert found.impulse == pytest.approx(IMPULSE, rel=5e-3)
    assert found.duration == pytest.approx(TAU, rel=0.03)


def test_a_drop_under_weight_has_the_momentum_of_its_weight_taken_off(tmp_path):
    """J = m V0 (1 + k) + m g tau, here with k = 0.5 and g tau/V0 = 0.2."""
    force = pulse(times()) * 1.7 / 1.5
    found = read(record(tmp_path / "f.csv", times(), force), gravity=0.2 * SPEED / TAU)
    assert found.restitution == pytest.approx(0.5, abs=2e-4)


def test_the_force_of_a_known_sphere_gives_its_material_back(tmp_path, capsys):
    impact = solve_impact(Sphere(MASS, 0.01), Material(8e6, 0.2), SPEED)
    time = numpy.arange(-200, 1200) * impact.duration / 400
    force = numpy.zeros(len(time))
    touching = (time >= 0.0) & (time <= impact.duration)
    force[touching] = course(impact, time[touching]).force
    path = record(tmp_path / "f.csv", time, force)
    assert main(["material", str(path), "--mass", "0.02", "--speed", "2", "--radius", "0.01", "--json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["force"]["k"] == pytest.approx(impact.restitution, abs=2e-3)
    assert found["force"]["tau"] == pytest.approx(impact.duration, rel=5e-3)
    assert found["groups"][0]["E'"] == pytest.approx(8e6, rel=0.01)
    assert found["groups"][0]["tan_beta"] == pytest.approx(0.2, rel=0.02)


TIME, FORCE = times(), pulse(times())
REFUSED = {
    "k above 1": (TIME, 2.0 * FORCE, r"restitution 2 from an impulse of 0.12 N s .* check mass, speed, the unit"),
    "k below 0": (TIME, 0.3 * FORCE, r"restitution -0.55"),
    "begins in contact": (TIME[240:], FORCE[240:], r"scatters by 2.42 N, .*: the record begins in contact"),
    "no return": (TIME[:330], FORCE[:330], r"does not return to its zero: 0 N before, 42.09 N after"),
    "other zero": (TIME, FORCE + numpy.where(TIME > TAU, 5.0, 0.0), r"does not return to its zero"),
    "offset of a drift": (TIME, FORCE + 2000.0 * (TIME + 2e-3) + numpy.where(TIME > TAU, 1.0, 0.0), r"to its zero"),
    "ends too soon": (TIME[:382], FORCE[:382], r"to its zero: 0 N before, 1.827 N after"),
    "coarse": (TIME[::30], FORCE[::30], r"6 samples in the contact, at least 10 are needed; record at 1.3e\+04 Hz"),
    "clipped": (TIME, numpy.minimum(FORCE, 40.0), r"clipped: \d+ of 179 samples in the contact are 40 N"),
    "gap": (numpy.delete(TIME, numpy.s_[250:280]), numpy.delete(FORCE, numpy.s_[250:280]), r"samples are missing within"),
    "time goes back": (TIME[::-1], FORCE, r"line 3: the time does not go on"),
    "nothing": (TIME, 0.0 * FORCE, r"no force rises above the first 15 samples"),
    "noise alone": (TIME, numpy.random.default_rng(1).standard_normal(len(TIME)), r"scatters by .* hides it in noise"),
}  # fmt: skip


@pytest.mark.parametrize("name", REFUSED)
def test_what_gives_no_right_number_is_refused_with_its_cure(tmp_path, name):
    time, force, words = REFUSED[name]
    with pytest.raises(MaterialError, match=words) as found:
        read(record(tmp_path / "f.csv", time, force))
    assert "f.csv" in str(found.value)


def test_what_is_not_stated_is_asked_for(tmp_path, capsys):
    path = str(record(tmp_path / "f.csv", TIME, FORCE))
    by_unit = str(record(tmp_path / "n.csv", TIME, FORCE, "time [s],a [N]"))
    for arguments, words in (
        ([path], "a force over time needs --mass KG and --speed M/S"),
        ([path, "--mass", "0.02"], "needs --mass KG and --speed M/S"),
        ([path, "--mass", "0.02", "--speed", "2", "--plot", str(tmp_path / "a.png")], "needs --radius M"),
        ([path, "--mass", "0.02", "--speed", "2", "--force", "g"], "there is no column 'g'"),
    ):
        assert main(["material", *arguments]) == 2
        assert words in capsys.readouterr().err
    assert main(["material", by_unit, "--mass", "0.02", "--speed", "2"]) == 0
    printed = capsys.readouterr()
    assert "--radius M of the nose gives" in printed.err
    assert printed.out.split()[:5] == ["impulse", "tau", "k", "peak_force", "samples"]


def test_a_damaged_record_gives_a_number_within_its_bounds_or_a_refusal(tmp_path):
    text = record(tmp_path / "f.csv", times(2e-5), pulse(times(2e-5))).read_text()
    read_ones, refused = 0, []
    for seed in range(200):
        chance = random.Random(seed)
        lines = text.split("\n")
        place = chance.randrange(len(lines))
        kind = chance.randrange(5)
        if kind == 0:
            lines = lines[: chance.randrange(len(lines))]
        elif kind == 1:
            del lines[place]
        elif kind == 2:
            lines.insert(place, lines[chance.randrange(len(lines))])
        elif kind == 3:
            lines[place] = "".join(chance.sample(lines[place], len(lines[place])))
        else:
            lines[place] += chance.choice([",", ",9", "é", "\0", '"', "nan", "e999"])
        (tmp_path / "f.csv").write_text("\n".join(lines))
        try:
            found = read(tmp_path / "f.csv")
        except MaterialError as error:
            refused.append(str(error))
            continue
        read_ones += 1
        assert 0.0 < found.restitution <= 1.05
        assert 0.0 < found.duration < 8e-3
    assert all("f.csv" in text and "\n" not in text for text in refused)
    assert min(read_ones, len(refused)) > 20
