# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""What pip installs: the Python modules and the shared files, without generated messages.

A ROS 2 installation is built from CMakeLists.txt instead, which installs the same modules.
"""

import xml.etree.ElementTree
from pathlib import Path

from setuptools import find_packages, setup

ROOT = Path(__file__).resolve().parent
NAME = "roller_sim_ros"

package = xml.etree.ElementTree.parse(ROOT / "package.xml").getroot()
requirements = (ROOT / "requirements" / "python.txt").read_text(encoding="utf-8").splitlines()


def shared(folder: str, pattern: str) -> tuple[str, list[str]]:
    """Return a folder under share/ and the files that go there, relative to this file."""
    files = sorted(path.relative_to(ROOT).as_posix() for path in (ROOT / folder).glob(pattern))
    return (f"share/{NAME}/{folder}".rstrip("/"), files)


setup(
    name=NAME,
    version=package.findtext("version"),
    description="A vibratory soil-compaction roller for ROS 2: its sensors, emulated",
    long_description=(ROOT / "README.md").read_text(encoding="utf-8"),
    long_description_content_type="text/markdown",
    license=package.findtext("license"),
    python_requires=">=3.10",
    packages=find_packages(include=[NAME, f"{NAME}.*"]),
    package_data={NAME: ["py.typed", "panel/page/*"]},
    data_files=[
        shared("", "package.xml"),
        shared("msg", "*.msg"),
        shared("srv", "*.srv"),
        shared("config", "*.yaml"),
        shared("launch", "*.launch.py"),
        shared("layouts", "*.*"),
        shared("scenarios", "*.yaml"),
        shared("scenarios", "*.schema.json"),
        shared("security", "*.xml"),
    ],
    install_requires=[line for line in requirements if line and not line.startswith("#")],
    # Needed for one format of `roller-sim export` alone, which is large, and for `roller-sim fmu`.
    extras_require={"parquet": ["pyarrow>=10"], "fmu": ["pythonfmu>=0.6"]},
    entry_points={"console_scripts": ["roller-sim = roller_sim_ros.commands:main"]},
)
