"""Long runs: whether a sample is lost, memory grows, or time drifts."""
