"""A live page on a roller that runs: an ordinary ROS 2 client with a web server; ROS in ``client`` alone."""
