"""The web server behind the page: quiet, on an address of its own, and closed to the outside."""

import logging
import socket

import rich
import viser

from planner.errors import SettingError

USUAL_PORT = 8080
"""Tried first where none is asked for."""
LAST_PORT = 65535


class Server(viser.ViserServer):
    """A viser server that cannot be put on the internet.

    Any page that a browser shows may speak to servers on the same machine, and viser opens a tunnel to a public address
    for whoever asks.
    """

    def request_share_url(self, verbose: bool = True) -> None:
        """Refuse the tunnel."""


def serve(host: str, port: int | None) -> Server:
    """Start a server; stop it by its `stop`.

    Args:
        host: Address to listen on.
        port: Port to listen on; by default the usual one, or any free one where that is taken.

    Raises:
        SettingError: When nothing can listen there.
    """
    rich.get_console().quiet = True  # viser greets on standard output, which is not its own
    logging.getLogger("websockets").setLevel(logging.CRITICAL)  # browsers open connections that they never use
    return Server(host=host, port=_usable(host, port), verbose=False)


def address(server: viser.ViserServer) -> str:
    """What a browser on this machine is told."""
    host = server.get_host()
    return f"http://{'localhost' if host in ('0.0.0.0', '127.0.0.1') else host}:{server.get_port()}"


def _usable(host: str, port: int | None) -> int:
    """A port where one can listen; viser itself would wait for ever where there is none."""
    wanted = (USUAL_PORT, 0) if port is None else (port,)
    if not 0 <= wanted[0] <= LAST_PORT:
        raise SettingError(f"port {port} does not exist; allowed: 0 (any free one) to {LAST_PORT}")
    for number in wanted:
        try:
            with socket.create_server((host, number)) as probe:
                return int(probe.getsockname()[1])
        except OSError as error:
            refused = error
    raise SettingError(
        f"cannot listen on {host}, port {wanted[-1]}: {refused}; choose a free --port, or leave it out, and an address "
        "of this machine as --host"
    ) from refused
