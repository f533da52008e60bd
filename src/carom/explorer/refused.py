"""What a view cannot be: the field of the page that is wrong, and why in the page's own words."""

from carom.quantities.refusals import InputError


class Refused(InputError):
    """A field of the page cannot be what it is; an empty field is the link as a whole.

    Its text begins with the label of the field, for those who have no field to look at.
    """

    def __init__(self, field: str, message: str, label: str = "") -> None:
        super().__init__(f"{label}: {message}" if label else message)
        self.field = field
        self.message = " ".join(message.splitlines())
