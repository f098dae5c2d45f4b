"""Hostile input: what a roller must survive, and what it must say then."""
