"""Commands in processes of their own that start at once: children of one that has loaded all."""

import json
import os
import socket
import subprocess
import sys
from contextlib import suppress
from threading import Thread

SERVER = """
import atexit, contextlib, ctypes, gc, io, json, os, resource, socket, sys, tempfile
import carom.cli.commands, carom.lab.fitting, carom.many.sweeps.stores, carom.plots.fits
import carom.verify
import emcee, h5netcdf, lmfit, matplotlib.backends.backend_agg, matplotlib.figure, pandas, xarray
from carom.cli import main, run
from carom.io.progress import PATIENCE, Place
PATIENCE[Place.TEXT] = 1e9  # on a slow machine a line of progress would come, which no test expects
asked = socket.socket(fileno=int(sys.argv[1]))
ball = ["--radius", "5 mm", "--material", "steel", "--friction", "0.2"]
with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as out:
    with contextlib.redirect_stderr(out):  # once, what first calls load
        files = ["--output", f"{folder}/x.nc", "--plot", f"{folder}/x.pdf"]
        main(["impact", *ball, "--speed", "2", "--angle", "30 deg", *files])
        main(["curve", "--chi", "1.44"])
gc.freeze()
while True:
    words, streams, _, _ = socket.recv_fds(asked, 1 << 16, 3)
    if not words:
        sys.exit()
    given = json.loads(words)
    child = os.fork()
    if child == 0:
        for number, stream in enumerate(streams):
            os.dup2(stream, number)
            os.close(stream)
        os.chdir(given["folder"])
        sys.argv[1:] = given["arguments"]
        limit = given["largest"] or resource.RLIM_INFINITY
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))
        exec(given["before"])
        try:
            run()
        except SystemExit as end:  # as Python ends, but for taking all modules apart
            atexit._run_exitfuncs()
            sys.stdout.flush()
            sys.stderr.flush()
            ctypes.PyDLL(None).exit(end.code)  # other threads wait for the GIL
    for stream in streams:
        os.close(stream)
    code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    asked.send(str(code).encode())
"""


class Commands:
    """Run commands as from a shell; each call returns the exit code, what is printed and told."""

    def __init__(self):
        self._socket, theirs = socket.socketpair()
        words = [sys.executable, "-c", SERVER, str(theirs.fileno())]
        self._server = subprocess.Popen(words, pass_fds=[theirs.fileno()])
        theirs.close()

    def __call__(self, folder, *arguments, before="", largest=0, stdout=None):
        """Run a command in a folder.

        Before it a program is run; files grow to so many bytes at most; stdout is another file.
        """
        caught = [os.pipe() if stdout is None else (None, stdout), os.pipe()]
        entries = {"folder": str(folder), "arguments": [*map(str, arguments)]}
        entries |= {"before": before, "largest": largest}
        with open(os.devnull, "rb") as nothing:
            streams = [nothing.fileno(), *(into for _, into in caught)]
            socket.send_fds(self._socket, [json.dumps(entries).encode()], streams)
        for _, into in caught:
            if into != stdout:
                os.close(into)
        words = [b"", b""]
        readers = [
            Thread(target=lambda row=row, out=out: words.__setitem__(row, _whole(out)))
            for row, (out, _) in enumerate(caught)
            if out is not None
        ]
        for reader in readers:
            reader.start()
        code = int(self._socket.recv(100))
        for reader in readers:
            reader.join()
        return code, *(text.decode() for text in words)

    def close(self):
        self._socket.close()
        with suppress(subprocess.TimeoutExpired):
            self._server.wait(10)


def _whole(descriptor):
    with open(descriptor, "rb") as stream:
        return stream.read()
