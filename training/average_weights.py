#!/usr/bin/env python3
"""Averages two weights files of one network, of which one was trained from the other.

The average of such weights is often better than both (Wortsman et al., "Model soups", ICML 2022).

usage: average_weights.py FIRST.safetensors SECOND.safetensors -o RESULT.safetensors [--share S]
"""
import argparse
import json
import struct
import sys
from pathlib import Path

import numpy as np

HEAD_LENGTH = 8  # bytes of the length of a file's header
METADATA = "__metadata__"
TYPES = {"F32": np.float32, "F16": np.float16}


def fail(text):
    sys.exit(f"average_weights.py: {text}")


def read_weights(path):
    """The header of a safetensors file, and its data."""
    try:
        content = Path(path).read_bytes()
        (length,) = struct.unpack("<Q", content[:HEAD_LENGTH])
        return json.loads(content[HEAD_LENGTH : HEAD_LENGTH + length]), content[HEAD_LENGTH + length :]
    except (OSError, ValueError, struct.error) as error:
        fail(f"{path}: cannot be read as safetensors: {error}")


def tensors_of(path):
    """Metadata, and the tensors by name, in the order of the header."""
    header, data = read_weights(path)
    tensors = {}
    for name, entry in header.items():
        if name == METADATA:
            continue
        if entry["dtype"] not in TYPES:
            fail(f"{path}: {name} is {entry['dtype']}, expected F32 or F16; average before mms quantize")
        begin, end = entry["data_offsets"]
        values = np.frombuffer(data[begin:end], TYPES[entry["dtype"]])
        tensors[name] = values.reshape(entry["shape"])
    return header.get(METADATA, {}), tensors


def average(first, second, share):
    """(1 - share) * first + share * second of all tensors, computed in float32."""
    result = {}
    for name, a in first.items():
        b = second.get(name)
        if b is None or b.shape != a.shape:
            fail(f"{name}: {a.shape} in one file, {None if b is None else b.shape} in the other")
        mixed = (1 - share) * a.astype(np.float32) + share * b.astype(np.float32)
        result[name] = mixed.astype(a.dtype)
    unknown = sorted(set(second) - set(first))
    if unknown:
        fail(f"{unknown[0]}: is only in the second file")
    return result


def write_weights(path, metadata, tensors):
    names = {np.dtype(numpy_type): name for name, numpy_type in TYPES.items()}
    header, data = {METADATA: metadata}, bytearray()
    for name, values in tensors.items():
        content = values.tobytes()
        header[name] = {
            "dtype": names[values.dtype],
            "shape": list(values.shape),
            "data_offsets": [len(data), len(data) + len(content)],
        }
        data += content
    text = json.dumps(header, separators=(",", ":")).encode()
    text += b" " * (-len(text) % HEAD_LENGTH)
    Path(path).write_bytes(struct.pack("<Q", len(text)) + text + data)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("first")
    parser.add_argument("second")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--share", type=float, default=0.5, help="of the second file, 0 to 1")
    arguments = parser.parse_args()
    if not 0 <= arguments.share <= 1:
        fail(f"--share is {arguments.share}, allowed: 0 to 1")
    metadata, first = tensors_of(arguments.first)
    other_metadata, second = tensors_of(arguments.second)
    if metadata != other_metadata:
        fail("the files are of different networks, see mms info FILE")
    write_weights(arguments.output, metadata, average(first, second, arguments.share))


if __name__ == "__main__":
    main()
