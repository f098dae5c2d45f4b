"""The verdict on a compaction meter under test: its values beside the truth of the same trace."""
