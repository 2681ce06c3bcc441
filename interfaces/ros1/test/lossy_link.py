#!/usr/bin/python3
"""Joins two network namespaces by a link with delay and loss, for kernels without `tc netem`: each
has a tun device, and this process forwards their packets with delay, or drops them.

usage: lossy_link.py NAMESPACE_A ADDRESS_A NAMESPACE_B ADDRESS_B CONTROL_FILE
CONTROL_FILE has the one-way delay [ms] and the packet loss [%], and is read again after changes. A
loss of 100 interrupts the link."""
import ctypes
import fcntl
import heapq
import os
import random
import select
import struct
import subprocess
import sys
import time

TUNSETIFF = 0x400454CA
IFF_TUN_NO_PI = 0x1001
CLONE_NEWNET = 0x40000000
MTU = 1500


def open_tun(namespace, address, peer):
    """Opens a tun device in the namespace for this process, which then returns to its own."""
    libc = ctypes.CDLL(None, use_errno=True)
    own = os.open('/proc/self/ns/net', os.O_RDONLY)
    other = os.open('/var/run/netns/' + namespace, os.O_RDONLY)
    if libc.setns(other, CLONE_NEWNET) != 0:
        raise OSError(ctypes.get_errno(), 'cannot enter namespace ' + namespace)
    tun = os.open('/dev/net/tun', os.O_RDWR | os.O_NONBLOCK)
    fcntl.ioctl(tun, TUNSETIFF, struct.pack('16sH', b'wire', IFF_TUN_NO_PI))
    for command in (['addr', 'add', address, 'peer', peer, 'dev', 'wire'],
                    ['link', 'set', 'wire', 'mtu', str(MTU), 'up'], ['link', 'set', 'lo', 'up']):
        subprocess.check_call(['ip'] + command)
    libc.setns(own, CLONE_NEWNET)
    os.close(own)
    os.close(other)
    return tun


def main():
    name_a, address_a, name_b, address_b, control = sys.argv[1:6]
    tuns = (open_tun(name_a, address_a, address_b), open_tun(name_b, address_b, address_a))
    generator = random.Random(1)
    waiting = []  # (time, count, to, packet)
    count = 0
    changed, delay, loss = 0, 0.0, 0.0
    print('ready', flush=True)
    while True:
        if os.stat(control).st_mtime_ns != changed:
            text = open(control).read().split()
            if len(text) == 2:
                changed = os.stat(control).st_mtime_ns
                delay, loss = float(text[0]) / 1000, float(text[1]) / 100
        pause = max(0.0, min(0.02, waiting[0][0] - time.monotonic())) if waiting else 0.02
        readable, _, _ = select.select(tuns, [], [], pause)
        now = time.monotonic()
        for tun in readable:
            to = tuns[1 - tuns.index(tun)]
            for _ in range(64):
                try:
                    packet = os.read(tun, 2 * MTU)
                except BlockingIOError:
                    break
                if generator.random() >= loss:
                    count += 1
                    heapq.heappush(waiting, (now + delay, count, to, packet))
        while waiting and waiting[0][0] <= time.monotonic():
            _, _, to, packet = heapq.heappop(waiting)
            try:
                os.write(to, packet)
            except (BlockingIOError, OSError):
                pass  # a full device drops packets, as links do


main()
