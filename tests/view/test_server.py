"""The server of the live page: for this machine alone, and the newest frame for whoever asks."""

import http.client

import pytest
from tests.view.frames import BLOCKS, Client, force_of, patch_of_block, written

pytest.importorskip("websockets")

from contact_sim_pkg.bag.reader import open_bag
from contact_sim_pkg.view.recorded import RecordedSource
from contact_sim_pkg.view.scope import Scope
from contact_sim_pkg.view.server import ServeError, ViewServer

MS = 1_000_000  # [ns]


@pytest.fixture
def scope():
    return Scope()


@pytest.fixture
def server(scope):
    with ViewServer(scope, "a run") as found:
        yield found


@pytest.fixture
def client(server):
    found = Client(server.port)
    yield found
    found.close()


def answer(port, path="/", **headers):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=30)
    connection.putrequest("GET", path, skip_host="Host" in headers)
    for name, value in headers.items():
        connection.putheader(name.replace("_", "-"), value)
    connection.endheaders()
    found = connection.getresponse()
    return found, found.read().decode()


def test_the_page_comes_with_a_policy_that_allows_its_own_scripts_alone(server):
    found, text = answer(server.port)
    assert found.status == 200
    policy = found.headers["Content-Security-Policy"]
    assert policy.startswith("default-src 'none'")
    assert "frame-ancestors 'none'" in policy
    assert "connect-src 'self'" in policy
    assert text.count("<script>") == policy.split("script-src")[1].split(";")[0].count("sha256") == 3
    assert "http://" not in text.replace("http://www.w3.org", "").split("<style>")[0]
    assert answer(server.port, "/anything")[0].status == 404
    assert answer(server.port, "/favicon.ico")[0].status == 204


FOREIGN = (
    "http://example.com",
    "https://127.0.0.1:{port}",
    "http://127.0.0.1:1",
    "null",
    "http://127.0.0.1:{port}.example.com",
)


@pytest.mark.parametrize("origin", FOREIGN)
@pytest.mark.parametrize("path", ["/", "/frames"])
def test_a_page_from_elsewhere_is_refused(server, origin, path):
    upgrade = {
        "Upgrade": "websocket", "Connection": "Upgrade", "Sec_WebSocket_Version": "13",
        "Sec_WebSocket_Key": "dGhlIHNhbXBsZSBub25jZQ==",
    }  # fmt: skip
    given = upgrade if path == "/frames" else {}
    found, text = answer(server.port, path, Origin=origin.format(port=server.port), **given)
    assert found.status == 403
    assert "script" not in text


@pytest.mark.parametrize("host", ["example.com", "example.com:{port}", "127.0.0.1", "127.0.0.1:1", ""])
def test_a_name_of_somebody_else_that_leads_here_is_refused(server, host):
    assert answer(server.port, Host=host.format(port=server.port))[0].status == 403
    assert answer(server.port, Host=f"localhost:{server.port}")[0].status == 200


def test_a_port_that_is_taken_is_named(server):
    with pytest.raises(ServeError, match=f"port {server.port} of 127.0.0.1 cannot be had: .*; --port 0 takes a free one"), \
         ViewServer(Scope(), "another", server.port):  # fmt: skip
        pass


def test_a_slow_client_gets_the_newest_frame_and_holds_nobody_up(scope, client):
    scope.take("seat/patch", 0, patch_of_block(0))
    assert client.frame()[0]["maps"][0]["load"] == 600.0
    for block in range(1, 301):
        scope.take("seat/force", 10 * block * MS, force_of(block))
        scope.take("seat/patch", 10 * block * MS, patch_of_block(block))
    about, series, _ = client.frame()
    assert [each["load"] for each in about["maps"]] == [900.0]
    assert set(series["seat/force"][1]) == {600.0 + block for block in range(1, 301)}


def test_what_no_page_says_is_left_out(server, client, scope):
    client._loop.run_until_complete(client._socket.send("[1"))
    client._loop.run_until_complete(client._socket.send("[]"))
    client.send("pause")
    scope.say(state=1)
    assert client.frame()[0]["state"] == 1
    assert server.wishes.get(timeout=30.0) == {"do": "pause"}


def test_a_bag_is_played_paused_stepped_and_sought(tmp_path, scope, server, client):
    source = RecordedSource(open_bag(written(tmp_path)), scope)
    source.go(100.0)
    source.advance(100.105)  # block 10 began at 0.1 s
    about, series, fields = client.until(lambda about, *_: about["maps"])
    assert about["maps"][0]["load"] == 610.0
    assert set(series["seat/force"][1]) == {600.0 + block for block in range(11)}
    assert set(fields) == {"seat/patch"}
    assert (about["rtf"], about["scene"], about["end"]) == (2.0, "seat_ride", pytest.approx(0.01 * (BLOCKS - 1)))

    source.steer({"do": "pause"}, 100.105)
    source.advance(170.0)
    source.steer({"do": "step"}, 170.0)
    source.advance(170.0)
    about, series, _ = client.until(lambda about, *_: about["maps"])
    assert (about["paused"], about["maps"][0]["load"]) == (True, 611.0)
    assert set(series["seat/force"][1]) == {611.0}

    source.steer({"do": "seek", "at": 0.055}, 171.0)
    source.advance(171.0)
    about, series, _ = client.until(lambda about, *_: about["maps"])
    assert (about["anew"], about["maps"][0]["load"]) == (True, 605.0)
    assert set(series["seat/force"][1]) == {600.0 + block for block in range(6)}

    source.steer({"do": "go"}, 172.0)
    source.advance(180.0)
    assert client.until(lambda about, *_: about["paused"] and about["at"] > 0.4)[0]["at"] == pytest.approx(0.49)
    for wish in ({"do": "seek", "at": "x"}, {"do": "seek", "at": float("nan")}, {"do": 1}, {}):
        source.steer(wish, 181.0)
    source.steer({"do": "go"}, 190.0)
    assert source.position(190.1) == pytest.approx(0.1)
