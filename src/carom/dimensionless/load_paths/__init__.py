"""The memory of a contact under any history of loads."""
