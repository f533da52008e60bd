"""Tractions, displacements and stresses of a contact."""
