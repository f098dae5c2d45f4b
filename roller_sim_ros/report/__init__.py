"""A trace as one page to look at."""
