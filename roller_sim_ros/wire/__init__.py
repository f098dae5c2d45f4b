"""Results of a session as ROS messages in CDR, without ROS: the same bytes are published and recorded."""
