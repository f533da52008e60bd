"""From measured rebounds to numbers: fits, tracks of videos, measured data with sources."""
