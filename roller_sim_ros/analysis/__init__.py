"""What a bag says: gaps, meter values computed anew and compared, plot and CSV; without ROS."""
