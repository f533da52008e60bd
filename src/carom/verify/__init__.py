"""The bench: contact laws of DEM codes, and the codes themselves, against the exact impact."""
