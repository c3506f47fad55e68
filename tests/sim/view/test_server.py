"""The server answers on this machine, is gone after it is stopped, and cannot be put on the internet."""

import socket
import urllib.error
import urllib.request
from typing import TYPE_CHECKING

import pytest

from planner.errors import SettingError

pytest.importorskip("viser", reason="the live view needs the extra viz")

from sim.view.server import address, serve

if TYPE_CHECKING:
    from sim.view.server import Server


def test_a_real_server_answers_until_it_is_stopped(capfd: pytest.CaptureFixture[str]) -> None:
    server = serve("127.0.0.1", 0)
    place = address(server)
    try:
        assert place == f"http://localhost:{server.get_port()}"
        with urllib.request.urlopen(place, timeout=10) as answer:
            assert answer.status == 200
            assert b"<html" in answer.read()
    finally:
        server.stop()
    with pytest.raises(urllib.error.URLError):
        urllib.request.urlopen(place, timeout=10)
    assert capfd.readouterr() == ("", "")


def test_no_port_but_this_machines_is_opened_and_no_tunnel(server: "Server") -> None:
    assert server.get_host() == "127.0.0.1"
    server.request_share_url()
    assert server._share_tunnel is None


def test_a_port_that_is_taken_is_refused_or_avoided(server: "Server", monkeypatch: pytest.MonkeyPatch) -> None:
    taken = server.get_port()
    with pytest.raises(SettingError, match=rf"port {taken}: .*choose a free --port"):
        serve("127.0.0.1", taken)
    monkeypatch.setattr("sim.view.server.USUAL_PORT", taken)
    other = serve("127.0.0.1", None)
    other.stop()
    assert other.get_port() != taken


@pytest.mark.parametrize(
    ("host", "port", "message"),
    [
        ("127.0.0.1", 70000, "port 70000 does not exist; allowed: 0"),
        ("127.0.0.1", -1, "port -1 does not exist"),
        ("192.0.2.1", 0, "cannot listen on 192.0.2.1, port 0"),  # an address that no machine has
    ],
)
def test_where_nothing_can_listen_is_said_at_once(host: str, port: int, message: str) -> None:
    with pytest.raises(SettingError, match=message):
        serve(host, port)


def test_the_usual_port_is_used_where_it_is_free(monkeypatch: pytest.MonkeyPatch) -> None:
    with socket.create_server(("127.0.0.1", 0)) as probe:
        free = probe.getsockname()[1]
    monkeypatch.setattr("sim.view.server.USUAL_PORT", free)
    server = serve("127.0.0.1", None)
    server.stop()
    assert server.get_port() == free
