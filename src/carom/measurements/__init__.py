"""What people measure of rebounds, and what they have published."""
