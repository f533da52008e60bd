"""Panels of time: the normal motion on them, and what all impacts with losses share."""
