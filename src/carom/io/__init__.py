"""Files, tables, labels, progress and citations."""
