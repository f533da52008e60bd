"""What a request may take of the page: every limit."""

LONGEST_LINK = 4000  # characters
LARGEST_UPLOAD = 1_000_000  # bytes
MOST_UPLOADED_ROWS = 2000
LARGEST_HEAD = 1 << 16  # bytes of a request, besides what it carries
LARGEST_REQUEST = 2 * LARGEST_UPLOAD  # a file travels in more characters than it has

FIT_SECONDS = 20.0  # that an upload may be read and fitted; 2000 rows take two
FILE_SECONDS = 30.0  # that a file of a view may take, contact laws in it among them
WORK_MEMORY = 1 << 30  # bytes, besides what a process that fits or writes has before
START_SECONDS = 300.0  # until such a process is ready; it may have to compile

LAW_SECONDS = 20.0  # that contact laws are waited for; the slowest takes five, at chi = 10
MOST_FOLLOWERS = 16  # requests that wait for contact laws; the latest count

MOST_WAITING = 4  # requests that wait until another's upload is fitted, or its file written
WAITING_SECONDS = 20.0  # that they do

MOST_CONNECTIONS = 200  # at once
MOST_QUEUED = 128  # connections that are not accepted yet: a burst of so many drives nobody out
IDLE_SECONDS = 60.0  # that a connection may be silent
THREADS = 2 * (MOST_FOLLOWERS + 2 * (1 + MOST_WAITING))  # twice as many as ever wait for something


class Busy(RuntimeError):
    """Others keep the page busy with what is asked for."""

    said = "the page is busy; try again"

    def __str__(self) -> str:
        return self.said
