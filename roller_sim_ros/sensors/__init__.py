# Copyright 2026 The roller_sim_ros developers
# SPDX-License-Identifier: Apache-2.0

"""Sensors: what they deliver of the true motion; a new one is one file, one line in the registry."""

from roller_sim_ros.sensors.accelerometer import Accelerometer
from roller_sim_ros.sensors.gnss import Fix
from roller_sim_ros.sensors.ideal import IdealAccelerometer
from roller_sim_ros.sensors.odometry import Travelled
from roller_sim_ros.sensors.registry import SENSORS, SensorModel, Slot
from roller_sim_ros.sensors.sensor import Disturbance, Kind, Reading, Sensor, specific_force
from roller_sim_ros.sensors.sheet import AccelerometerSheet
from roller_sim_ros.sensors.suite import Choice, Suite
from roller_sim_ros.sensors.tacho import Pulse

__all__ = [
    "SENSORS",
    "Accelerometer",
    "AccelerometerSheet",
    "Choice",
    "Disturbance",
    "Fix",
    "IdealAccelerometer",
    "Kind",
    "Pulse",
    "Reading",
    "Sensor",
    "SensorModel",
    "Slot",
    "Suite",
    "Travelled",
    "specific_force",
]
