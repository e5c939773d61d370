"""Package description for colcon (ament_python) and for plain pip."""

import re
from pathlib import Path

from setuptools import find_packages, setup

PACKAGE = "contact_sim_lab"
HERE = Path(__file__).resolve().parent


def version() -> str:
    """The version written in the package, read without importing it."""
    text = (HERE / PACKAGE / "__init__.py").read_text(encoding="utf-8")
    return re.search(r'^__version__ = "(.+)"$', text, re.MULTILINE).group(1)


setup(
    name=PACKAGE,
    version=version(),
    description="Laboratory of the Contact Bench: hard cases, accuracy beside time, goals, validation, papers",
    author="Contact Bench maintainers",
    maintainer="Contact Bench maintainers",
    license="Apache-2.0",
    license_files=["LICENSE"],
    python_requires=">=3.11,<3.15",
    packages=find_packages(include=[PACKAGE, f"{PACKAGE}.*"]),
    package_data={PACKAGE: ["py.typed", "rigs/**/published/*"]},
    data_files=[
        ("share/ament_index/resource_index/packages", [f"resource/{PACKAGE}"]),
        (f"share/{PACKAGE}", ["package.xml"]),
    ],
    install_requires=[f"contact_sim_pkg=={version()}", "mpmath>=1.3,<2"],
    extras_require={"test": ["hypothesis>=6.150", "pytest>=9"]},
    zip_safe=False,
)
