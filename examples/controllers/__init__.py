"""Controllers in the loop: each a law that needs no ROS, and the same law as a ROS 2 node of its own."""
