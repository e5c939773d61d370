"""The road and the floor vibration that the package ships, made from seeds.

Run by `python -m contact_sim_pkg.excitation.make_shipped_data`; it writes

stone_road.crg        10 m of stone setts, 0.64 m wide, on a curved reference line; repeats without a seam
bus_like_floor.csv    20 s like the floor of a city bus at 476 Hz, with gravity, bias, tilt, and shocks clipped at 2 g
"""

from pathlib import Path

import numpy
from numpy.typing import NDArray

DATA = Path(__file__).resolve().parent / "data"
ROAD_FILE, VIBRATION_FILE = "stone_road.crg", "bus_like_floor.csv"

SEED = 20240601
LENGTH, INCREMENT, HALF_WIDTH = 10.0, 0.01, 0.32  # [m]
STONE_LENGTH, STONE_WIDTH = LENGTH / 70, 0.16  # [m] a sett and its joint
# [m] standard deviation of a sett's height, and of the rise to its edge
STONE_UNEVENNESS, STONE_TILT = 0.0045, 0.003
JOINT_DEPTH = 0.012  # [m]
SUBGRADE_RMS = 0.005  # [m] of the ground under the setts, harmonics 1 to 8 of the length
HEADING_CHANGE = 0.2  # [rad] from start to end: a bend of 50 m radius

RATE, DURATION = 476.0, 20.0  # [Hz], [s]
FULL_SCALE = 19.613  # [m/s^2] 2 g
TILT = 0.06  # [rad] of the sensor about the lateral axis
BIAS = (0.03, -0.02, 0.25)  # [m/s^2]
# resonances of the floor: frequency [Hz], relative width, rms [m/s^2] on x, y, z
MODES = (
    (1.6, 0.30, 0.10, 0.12, 0.45),  # body on its springs
    (10.5, 0.20, 0.12, 0.10, 0.50),  # wheels on their tires
    (26.0, 0.03, 0.20, 0.15, 0.30),  # engine, idling
    (55.0, 0.40, 0.15, 0.15, 0.25),  # floor panels
)
# Time [s], peak on z [m/s^2], half sines of 12 ms
SHOCKS = ((4.2, 11.0), (11.7, 13.0), (16.4, -12.0))


def stone_heights() -> NDArray[numpy.float64]:
    """Heights in [m] of the setts, [1001, 65]; the last row equals the first."""
    generator = numpy.random.Generator(numpy.random.PCG64(SEED))
    rows, half = round(LENGTH / INCREMENT), round(HALF_WIDTH / INCREMENT)
    u = INCREMENT * numpy.arange(rows)
    v = INCREMENT * numpy.arange(-half, half + 1)
    courses = round(LENGTH / STONE_LENGTH)
    course = numpy.floor(u / STONE_LENGTH + 1e-9).astype(int) % courses
    shift = STONE_WIDTH * (0.5 * (numpy.arange(courses) % 2) + generator.uniform(-0.15, 0.15, courses))
    across = (v[None, :] + shift[course][:, None]) / STONE_WIDTH + 8.0
    stone = numpy.floor(across).astype(int)
    along = (2.0 * numpy.mod(u / STONE_LENGTH, 1.0) - 1.0)[:, None]  # -1 to 1 over a stone
    beside = 2.0 * (across - stone) - 1.0
    level, tilt_u, tilt_v = generator.normal(0.0, 1.0, (3, courses, 16))
    index = (course[:, None], stone)
    height = STONE_UNEVENNESS * level[index] + STONE_TILT * (tilt_u[index] * along + tilt_v[index] * beside)
    height = height - JOINT_DEPTH * numpy.maximum(numpy.abs(along), numpy.abs(beside)) ** 10
    phase = generator.uniform(0.0, 2.0 * numpy.pi, 8)
    for harmonic in range(1, 9):
        wave = numpy.cos(2.0 * numpy.pi * harmonic * u / LENGTH + phase[harmonic - 1])
        height = height + SUBGRADE_RMS * numpy.sqrt(2.0 / 8.0) * wave[:, None]
    return numpy.vstack((height, height[:1]))


def stone_road() -> bytes:
    """The OpenCRG file (KRBI) of the setts."""
    height = stone_heights()
    rows, sections = height.shape
    # Reference line.
    heading = HEADING_CHANGE * numpy.linspace(0.0, 1.0, rows - 1)
    end = INCREMENT * numpy.exp(1j * heading).sum()
    # Header.
    lines = [
        "$CT",
        "Stone setts, generated from a seed; no measured road.",
        "$",
        "$ROAD_CRG",
        "reference_line_start_u   = 0.0",
        f"reference_line_end_u     = {LENGTH}",
        f"reference_line_increment = {INCREMENT}",
        f"long_section_v_right     = {-HALF_WIDTH}",
        f"long_section_v_left      = {HALF_WIDTH}",
        f"long_section_v_increment = {INCREMENT}",
        "reference_line_start_x   = 0.0",
        "reference_line_start_y   = 0.0",
        f"reference_line_end_x     = {end.real:.9f}",
        f"reference_line_end_y     = {end.imag:.9f}",
        "reference_line_start_phi = 0.0",
        f"reference_line_end_phi   = {HEADING_CHANGE}",
        "$",
        "$KD_DEFINITION",
        "#:KRBI",
        f"U:reference line u,m,0.0,{INCREMENT}",
        "D:reference line phi,rad",
        *(f"D:long section {number},m" for number in range(1, sections + 1)),
        "$",
        "$" * 72,
    ]
    # Rows of heading and heights, filled up to whole records.
    payload = numpy.column_stack((numpy.concatenate(([numpy.nan], heading)), height)).astype(">f4").tobytes()
    fill = numpy.full(-len(payload) % 80 // 4, numpy.nan, dtype=">f4").tobytes()
    return "".join(f"{line}\n" for line in lines).encode("latin-1") + payload + fill


def floor_vibration() -> str:
    """The text of the recording: columns x, y, z in [m/s^2], to 0.001."""
    generator = numpy.random.Generator(numpy.random.PCG64(SEED + 1))
    samples = round(RATE * DURATION)
    frequency = numpy.fft.rfftfreq(samples, 1.0 / RATE)
    axes = numpy.zeros((3, samples))
    # Resonances of the vehicle: bands of random phase, each axis with its own rms
    for centre, width, *rms in MODES:
        shape = numpy.exp(-0.5 * ((frequency - centre) / (width * centre)) ** 2) * (frequency > 0.3)
        for axis in range(3):
            phase = numpy.exp(2j * numpy.pi * generator.random(len(frequency)))
            wave = numpy.fft.irfft(shape * phase, samples)
            axes[axis] += rms[axis] / numpy.sqrt(numpy.mean(wave**2)) * wave
    time = numpy.arange(samples) / RATE
    # Shocks: half sines
    for start, peak in SHOCKS:
        part = (time - start) / 0.012
        axes[2] += numpy.where((part > 0.0) & (part < 1.0), peak * numpy.sin(numpy.pi * part), 0.0)
    axes[2] += 9.80665
    # A sensor that is tilted, biased and of limited range
    forward, up = axes[0].copy(), axes[2].copy()
    axes[0] = numpy.cos(TILT) * forward + numpy.sin(TILT) * up
    axes[2] = numpy.cos(TILT) * up - numpy.sin(TILT) * forward
    axes = numpy.clip(axes + numpy.array(BIAS)[:, None], -FULL_SCALE, FULL_SCALE)
    return "x,y,z\n" + "".join(f"{x:.3f},{y:.3f},{z:.3f}\n" for x, y, z in axes.T)


def main() -> None:
    """Write both files into the package."""
    DATA.mkdir(parents=True, exist_ok=True)
    (DATA / ROAD_FILE).write_bytes(stone_road())
    (DATA / VIBRATION_FILE).write_text(floor_vibration(), encoding="utf-8", newline="\n")


if __name__ == "__main__":
    main()
