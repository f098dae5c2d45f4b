"""The roller on the ROS 2 network; the only part that imports rclpy."""
