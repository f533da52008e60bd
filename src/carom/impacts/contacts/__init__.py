"""What happens in a contact at an instant, of an impact or of a load path."""
