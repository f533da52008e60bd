"""Measured rebounds and published parameters that come with Carom, with definitions and sources."""
