"""Sensors: what an accelerometer on the drum delivers of the true motion; a new one is one file, one line."""

from roller_sim_ros.sensors.ideal import IdealAccelerometer
from roller_sim_ros.sensors.sensor import Kind, Reading, Sensor, specific_force

SENSORS: dict[str, type[Sensor]] = {
    "ideal": IdealAccelerometer,
}

__all__ = ["SENSORS", "IdealAccelerometer", "Kind", "Reading", "Sensor", "specific_force"]
