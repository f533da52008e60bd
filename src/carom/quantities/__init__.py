"""Units, the glossary, arrays."""
