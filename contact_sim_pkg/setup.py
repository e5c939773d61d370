"""Package description for colcon (ament_python) and for plain pip."""

import re
from glob import glob
from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "contact_sim_pkg"
HERE = Path(__file__).resolve().parent
NODES = ("road_profile", "vibration", "contact_simulator", "bag_logger", "bag_replay", "bench_view")


def version() -> str:
    """The version written in the package, read without importing it."""
    text = (HERE / PACKAGE / "__init__.py").read_text(encoding="utf-8")
    return re.search(r'^__version__ = "(.+)"$', text, re.MULTILINE).group(1)


setup(
    name=PACKAGE,
    version=version(),
    description="Contact forces and pressure fields of simulated rigs, as ROS 2 topics and bags",
    long_description=(HERE / "README.md").read_text(encoding="utf-8"),
    long_description_content_type="text/markdown",
    keywords=["contact mechanics", "tire", "seat", "pressure field", "vibro-impact", "friction", "ROS 2"],
    classifiers=[
        "Development Status :: 4 - Beta",
        "Environment :: Console",
        "Intended Audience :: Science/Research",
        "License :: OSI Approved :: Apache Software License",
        "Operating System :: POSIX :: Linux",
        *(f"Programming Language :: Python :: 3.{minor}" for minor in range(11, 15)),
        "Topic :: Scientific/Engineering :: Physics",
        "Typing :: Typed",
    ],
    author="Contact Bench maintainers",
    maintainer="Contact Bench maintainers",
    license="Apache-2.0",
    license_files=["LICENSE", "THIRD_PARTY.md"],
    python_requires=">=3.11,<3.15",
    packages=find_packages(include=[PACKAGE, f"{PACKAGE}.*"]),
    package_data={
        PACKAGE: [
            "msg/*.msg",
            "excitation/data/*",
            "rigs/*/scenes/*.yaml",
            "steering/fmu/*.[ch]",
            "sweep/plans/*.yaml",
            "rigs/**/README.md",
            "rigs/**/published/*.csv",
            "py.typed",
            "**/*.pyi",
        ],
        f"{PACKAGE}.report": ["templates/*", "templates/**/*", "metrics/*.yaml"],
    },
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
        (f"share/{PACKAGE}/launch", sorted(glob("launch/*.launch.py"))),
        (f"share/{PACKAGE}/config", sorted(glob("config/*.*"))),
    ],
    install_requires=[
        "click>=8.1,<9",
        "jinja2>=3.1,<4",
        "matplotlib>=3.6,<4",
        "mcap>=1.5,<2",
        "numba>=0.66,<0.69",
        "numpy>=1.26,<3",
        "pydantic>=2.6,<3",
        "rich>=13,<16",
        "rosbags>=0.11,<0.12",
        "ruamel.yaml>=0.17,<0.20",
        "scipy>=1.11,<2",
        "zstandard>=0.22,<1",
    ],
    extras_require={
        "cluster": ["distributed>=2024.1"],
        "daq": ["asammdf>=8", "h5py>=3.10", "npTDMS>=1.9", "pyuff>=2.4"],
        "fatigue": ["rainflow>=3"],
        "parquet": ["pyarrow>=15"],
        "view": ["websockets>=13,<18"],
        "test": ["hypothesis>=6.150", "mcap-ros2-support>=0.5", "packaging>=24", "pytest>=9", "pytest-xdist>=3.6"],
    },
    entry_points={
        "console_scripts": [
            f"bench = {PACKAGE}.cli.start:main",
            *(f"{node} = {PACKAGE}.nodes.start:{node}" for node in NODES),
        ],
    },
    zip_safe=False,
)
