"""The files of `examples/inputs`, one of each format that the bench reads, in closed form.

`python -m tests.docs.sample_files FOLDER` makes them anew; those of MDF4, TDMS, UFF58 and MATLAB 7.3 where their libraries are.
"""

import math
import sys
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import numpy as np
from rosbags.rosbag1 import Writer as Ros1Bag
from rosbags.typesys import Stores, get_typestore
from scipy.io import savemat, wavfile
from tests.bag import foreign
from tests.excitation import crg_file
from tests.excitation.profile import test_road as roads
from tests.identify import foreign_bag, motions
from tests.report.sitting import grid, mat_file
from tests.rigs.vehicle.tire.property_file import tir_file

FOLDER = Path(__file__).resolve().parents[2] / "examples" / "inputs"
G, RATE = 9.80665, 200.0
TIME = np.arange(800) / RATE
X, Z = 0.4 * np.sin(4.0 * math.pi * TIME), 1.5 * np.sin(8.0 * math.pi * TIME) + G
MAT = grid(0.0127, 40, 40, 0.05, (0.01, -0.02))
SAMPLES = 600
"""of the bags with an Imu"""
LIMITS = """\
# What you require of a run, by the key of a metric; * stands for any part of it
imu.*.a_w: {max: 2.0, unit: m/s²}
seat.factor: {max: 100, unit: "%", when: {seat.a_w: [0.2, 2.0]}}
"""
TOLERANCES = """\
# By how much a run may differ from its reference
seat.*: {relative: 0.05}
seat.load: {absolute: 2}    # N
"""
ROWS = [row for row in foreign.ROWS if row[1] < foreign.BEGIN + SAMPLES * 10**9 // foreign.RATE]


def table(path, names, *columns):
    rows = (",".join(f"{value:.6f}" for value in row) for row in zip(*columns, strict=True))
    path.write_text("\n".join([names, *rows]) + "\n")


def imu(path, change=lambda a: (a.x, a.y, a.z)):
    """A lone MCAP of an Imu, with other axes or units."""
    rows = []
    for topic, time, data in ROWS:
        if topic == "/imu":
            message = foreign.STORE.deserialize_cdr(data, foreign.IMU)
            message.linear_acceleration.x, message.linear_acceleration.y, message.linear_acceleration.z = change(
                message.linear_acceleration
            )
            data = bytes(foreign.STORE.serialize_cdr(message, foreign.IMU))
        rows.append((topic, time, data))
    path.write_bytes(foreign.mcap(rows))


def in_parts(path):
    """A bag in two files, their order in the metadata alone."""
    path.mkdir(exist_ok=True)
    for name, part in (("b", ROWS[: SAMPLES // 2]), ("a", ROWS[SAMPLES // 2 :])):
        (path / f"{name}.mcap").write_bytes(foreign.mcap(part))
    foreign.write_metadata(path, ["b.mcap", "a.mcap"])


def sqlite(path):
    path.unlink(missing_ok=True)
    foreign.fill_sqlite(path, [row for row in ROWS if row[0] == "/imu"][: SAMPLES // 2])


def ros1(path):
    path.unlink(missing_ok=True)
    store = get_typestore(Stores.ROS1_NOETIC)
    writer = Ros1Bag(path)
    writer.set_compression(Ros1Bag.CompressionFormat.BZ2)
    with writer:
        row = writer.add_connection("/imu", foreign.IMU, typestore=store)
        for number in range(SAMPLES):
            time = foreign.BEGIN + number * (10**9 // foreign.RATE)
            writer.write(row, time, store.serialize_ros1(foreign.imu(number, store, seq=number), foreign.IMU))


def cell(path):
    """The force of a load cell, 700 N and a wave."""
    types, kind = foreign.STORE.types, "geometry_msgs/msg/WrenchStamped"
    vector, rows = types["geometry_msgs/msg/Vector3"], []
    for k in range(400):
        stamp = types["builtin_interfaces/msg/Time"](k // 100, k % 100 * 10**7)
        header = types["std_msgs/msg/Header"](stamp, "cell")
        force = vector(0.0, 0.0, 700.0 + 10.0 * math.sin(0.1 * k))
        wrench = types["geometry_msgs/msg/Wrench"](force, vector(0.0, 0.0, 0.0))
        rows.append(("/cell", k * 10**7, bytes(foreign.STORE.serialize_cdr(types[kind](header, wrench), kind))))
    path.write_bytes(foreign.mcap(rows, {"/cell": kind}))


def thrown(path):
    """A square that falls and bounces, as Odometry."""
    rows = [*foreign_bag.odometry_rows(motions.states_of(motions.planar()))]
    path.write_bytes(foreign.mcap(rows, {"/odom": foreign_bag.ODOMETRY}))


def stones(path):
    heights = 0.01 * np.random.default_rng(2).standard_normal((80, 21))
    crg_file.write(
        path, "LRFI", table=heights.tolist(), rows=80, increment=0.25, phi=False, v=np.linspace(-0.5, 0.5, 21).tolist()
    )


def force(path):
    """A half sine of 0.060 N s within 1.8 ms: k = 0.5 of 0.02 kg at 2 m/s."""
    time = np.arange(-200, 600) * 1e-5
    table(path, "time [ms],force [N]", 1e3 * time, 52.36 * np.sin(np.pi * np.clip(time / 1.8e-3, 0.0, 1.0)))


def foam(path):
    """A specimen of 100 x 100 x 50 mm, pressed to 35 mm and released: the formula of a foam times 1.15 and 0.85."""
    way = np.arange(0.0, 36.0)
    left = 1.0 - way / 50.0
    force = 0.01 * (3e3 * (1.0 / left - left ** (4e4 / 3e3 - 1.0)) + 100.0 * (left**-4.0 - 1.0 / left))
    force = np.concatenate((1.15 * force, 0.85 * force[::-1]))
    table(path, "deflection [mm],force [N]", np.concatenate((way, way[::-1])), force)


SWEEP = """\
**HEADER
RELEASE   Release of TYDEX-Format                 1.3
**COMMENTS
! Steered to 6 degrees and back at 4 kN
**MEASURCHANNELS
RUNTIME   Running time                  s         1
FZW       Vertical force                kN        1
SLIPANGL  Slip angle                    deg       1
INCLANGL  Inclination angle             deg       1
TRAJVELW  Trajectory velocity           km/h      1
**MEASURDATA
"""


def sweep(path):
    time = np.linspace(0.0, 1.0, 31)
    rows = [f"{t:8.4f}  4.000 {6.0 * math.sin(math.pi * t) ** 2:8.4f}  0.00  60.00" for t in time.tolist()]
    path.write_text(SWEEP + "\n".join([*rows, "**END"]) + "\n")


def xsensor(path):
    rows = "\n".join(",".join(f"{value / 133.322:.2f}" for value in row) for row in MAT.pressure)
    path.write_text(f"FILE NAME:,drive\nROWS:,40\nCOLUMNS:,40\nFrame:,1\nTime:,10:00:00.000\n{rows}\n")


def corners(path):
    signs = (-0.5, 0.5)
    rows = [f"{0.1 * x}, {0.2 * y}, {0.3 * z}" for x in signs for y in signs for z in signs]
    path.write_text("\n".join(["# x, y, z [m] from the centre of mass", *rows]) + "\n")


def mdf4(path):
    import asammdf

    with asammdf.MDF(version="4.10") as file:
        file.append([asammdf.Signal(Z, TIME, "m/s^2", "z")])
        file.save(path, overwrite=True)


def tdms(path):
    import nptdms

    properties = {"wf_increment": 1.0 / RATE, "wf_start_offset": 0.0, "unit_string": "m/s^2"}
    with nptdms.TdmsWriter(path) as file:
        file.write_segment([nptdms.ChannelObject("ride", "z", Z, properties)])


def uff(path):
    import pyuff

    path.unlink(missing_ok=True)
    data = pyuff.prepare_58(
        binary=0, func_type=1, rsp_dir=3, ref_dir=3, data=Z, x=TIME, id1="z", rsp_node=1, ref_node=1,
        ordinate_axis_units_lab="m/s^2", ordinate_spec_data_type=12, abscissa_spec_data_type=17,
        abscissa_inc=1.0 / RATE, orddenom_spec_data_type=0, z_axis_spec_data_type=0,
    )  # fmt: skip
    pyuff.UFF(str(path)).write_sets(data)


def hdf5(path):
    import h5py

    with h5py.File(path, "w", userblock_size=512) as file:
        for name, values in (("time", TIME), ("x", X), ("z", Z)):
            file[name] = values[np.newaxis]
    with path.open("r+b") as file:
        file.write(b"MATLAB 7.3 MAT-file".ljust(124) + b"\0\2IM")


SAMPLES_OF: dict[str, Callable[[Path], object]] = {
    "ride.csv": lambda path: table(path, "time [s],x,z", TIME, X, Z),
    "floor_g.csv": lambda path: table(path, "time [s],z [g]", TIME, Z / G),
    "bare.csv": lambda path: table(path, "x,z", X, Z),
    "phone.csv": lambda path: table(path, "time,ahead,up,heart rate", TIME, X / G, Z / G, 70.0 + X),
    "ride.mat": lambda path: savemat(path, {"time": TIME, "x": X, "z": Z}, do_compression=True),
    "ride_73.mat": hdf5,
    "ride.wav": lambda path: wavfile.write(path, 200, np.int16(Z / 50.0 * 32768)),
    "ride.mf4": mdf4,
    "ride.tdms": tdms,
    "ride.uff": uff,
    "ride.mcap": imu,
    "lidar.mcap": lambda path: imu(path, lambda a: (a.x / G, a.y / G, a.z / G)),
    "camera.mcap": lambda path: imu(path, lambda a: (a.x, -a.z, a.y)),
    "split": in_parts,
    "ride.db3": sqlite,
    "ride.bag": ros1,
    "cut.mcap": lambda path: path.write_bytes(foreign.mcap(ROWS, chunk_size=20_000)[:20_000]),
    "cell.mcap": cell,
    "thrown.mcap": thrown,
    "corners.csv": corners,
    "road.crg": stones,
    "pairs.csv": lambda path: path.write_text(roads.table(["x,z"], roads.X, roads.Z)),
    "road.rdf": lambda path: path.write_text(roads.rdf()),
    "road.erd": lambda path: path.write_text(roads.erd()),
    "tire.tir": lambda path: path.write_text(tir_file.text()),
    "tire.csv": lambda path: path.write_text(tir_file.MEASURED),
    "tekscan.csv": lambda path: mat_file(path, MAT),
    "xsensor.csv": xsensor,
    "impacts.csv": lambda path: table(
        path, "m,R,V0,tau,k", *np.outer([0.02, 0.01, 1.0, 0.001, 0.5], [1.0, 1.001])
    ),
    "force.csv": force,
    "foam.csv": foam,
    "sweep.tdx": sweep,
    "limits.yaml": lambda path: path.write_text(LIMITS),
    "tolerances.yaml": lambda path: path.write_text(TOLERANCES),
}  # fmt: skip
"""Who makes each file."""


def write(folder):
    """Make the files in a folder that is there; those whose library is absent are left out."""
    for name, make in SAMPLES_OF.items():
        with suppress(ImportError):
            make(folder / name)


if __name__ == "__main__":
    write(Path(sys.argv[1]))
