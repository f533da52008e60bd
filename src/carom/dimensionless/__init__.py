"""The theory itself in plain numbers without units, compiled."""
