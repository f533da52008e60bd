"""What users see of an object: its text in a notebook."""

from html import escape


class Printed:
    """An object that a notebook shows as `print` does."""

    def _repr_html_(self) -> str:
        return f"<pre>{escape(str(self))}</pre>"
