"""What goes wrong; each message is for the user as it stands."""


class SlagflowError(Exception):
    """All errors of this package."""


class RunError(SlagflowError):
    """A folder does not hold what a run leaves; the message says what is wrong."""


class ProgramError(SlagflowError):
    """The program is not there, or it ended with an error: the message is its own, `status` its exit status (None: it did not start)."""

    def __init__(self, message: str, status: int | None = None) -> None:
        super().__init__(message)
        self.status = status
