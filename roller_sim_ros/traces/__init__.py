"""Traces in MCAP, as rosbag2 has them: writing, recording in a process of its own, reading, recovering.

The modules are imported one by one, so that the recording process loads only what it needs.
"""
