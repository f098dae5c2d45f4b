"""Scenario files: what the roller drives over, what its exciter does, how it is measured and what fails."""
