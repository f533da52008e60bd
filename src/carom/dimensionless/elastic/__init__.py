"""Elastic impacts: the phase machine and its memory."""
