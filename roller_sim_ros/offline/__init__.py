"""The roller without ROS, as fast as it goes: run, record, sum up, draw."""
