#!/usr/bin/env python3
"""Time to the viewer's page while many clients send their requests slowly, send garbage, or read
nothing of their answers.

usage: benchmarks/slow_clients.py MMS [CLIENTS=1000] [SECONDS=20]

Shows a simulated run by `mms view`, and prints the number of clients of each kind, the number of
pages, and the longest time to a page. Exits with 1 if one takes longer than a second.
"""
import multiprocessing
import os
import random
import re
import resource
import socket
import subprocess
import sys
import tempfile
import threading
import time

LIMIT = 1.0  # [s]


def start_viewer(program, folder):
    run = [program, "run", "sim:crowd?frames=6&width=320", "--segmenter", "masks", "-o", folder]
    subprocess.run(run, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    assert os.path.getsize(folder + "/static_map.ply") > 500_000, "the map is too small to fill buffers"
    server = subprocess.Popen([program, "view", folder, "--port", "8479"], stderr=subprocess.PIPE,
                              stdout=subprocess.PIPE, text=True)
    for _ in range(200):
        try:
            socket.create_connection(("127.0.0.1", 8479), 1).close()
            return server, 8479
        except OSError:
            time.sleep(0.05)
    server.kill()
    sys.exit("mms view does not listen")


def page_time(port):
    begin = time.monotonic()
    answer = b""
    try:
        with socket.create_connection(("127.0.0.1", port), 10) as page:
            page.sendall(b"GET / HTTP/1.1\r\nHost: localhost\r\nConnection: close\r\n\r\n")
            while part := page.recv(65536):
                answer += part
    except OSError:
        return float("inf")
    if not re.match(rb"HTTP/1.1 (200|404)", answer):
        return float("inf")  # closed without an answer
    return time.monotonic() - begin


def trouble(port, kind, end, counts):
    """Clients of one kind, one after the other, each open for up to three seconds."""
    rng = random.Random(kind)
    while time.monotonic() < end:
        try:
            client = socket.create_connection(("127.0.0.1", port), 5)
        except OSError:
            time.sleep(0.05)
            continue
        counts[kind % 3] += 1
        try:
            if kind % 3 == 0:  # a byte now and then
                for byte in b"GET / HTTP/1.1\r\n":
                    client.sendall(bytes([byte]))
                    time.sleep(0.2)
            elif kind % 3 == 1:
                client.sendall(rng.randbytes(rng.randrange(1, 20000)))
                time.sleep(0.1)
            else:  # asks for much and reads nothing
                client.sendall(b"GET /files/static_map.ply HTTP/1.1\r\nHost: localhost\r\n\r\n" * 50)
                time.sleep(3)
        except OSError:
            pass
        client.close()


def send_trouble(port, clients, end, counts):
    os.nice(5)
    threading.stack_size(256 * 1024)
    crowd = [threading.Thread(target=trouble, args=(port, kind, end, counts), daemon=True)
             for kind in range(clients)]
    for client in crowd:
        client.start()
    time.sleep(max(0.0, end - time.monotonic()))


def main():
    program = os.path.abspath(sys.argv[1])
    clients = int(sys.argv[2]) if len(sys.argv) > 2 else 1000
    seconds = float(sys.argv[3]) if len(sys.argv) > 3 else 20.0
    hard = resource.getrlimit(resource.RLIMIT_NOFILE)[1]
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(hard, clients + 200), hard))
    with tempfile.TemporaryDirectory() as folder:
        server, port = start_viewer(program, folder + "/run")
        end = time.monotonic() + seconds
        counts = multiprocessing.Array("l", 3)
        # Of another process, so that its threads do not delay the measurement.
        crowd = multiprocessing.Process(target=send_trouble, args=(port, clients, end, counts))
        crowd.start()
        times = []
        try:
            while time.monotonic() < end:
                times.append(page_time(port))
                time.sleep(0.05)
            alive = server.poll() is None
        finally:
            crowd.kill()
            crowd.join()
            server.kill()
            server.wait()
    times.sort()
    print("| slow | garbage | reading nothing | pages | median [ms] | longest [ms] | server |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    print(f"| {counts[0]} | {counts[1]} | {counts[2]} | {len(times)} | "
          f"{1000 * times[len(times) // 2]:.0f} | {1000 * times[-1]:.0f} | "
          f"{'alive' if alive else 'ended'} |")
    return 0 if alive and times[-1] <= LIMIT else 1


if __name__ == "__main__":
    sys.exit(main())
