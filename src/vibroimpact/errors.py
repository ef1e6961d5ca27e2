"""The one exception that a user's mistake raises."""


class InputError(ValueError):
    """A value that the caller gave cannot be used.

    The message is one line that names the field, the value and what is accepted.
    """
