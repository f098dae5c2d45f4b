"""Scenario, meter under test and verdict in one go: node and meter as processes in a ROS domain of their own."""
