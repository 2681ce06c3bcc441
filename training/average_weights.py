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
    sys.exit(f"{Path(sys.argv[0]).name}: {text}")


def tensors_of(path):
    """Metadata, and the tensors by name, in the order of the header."""
    try:
        content = Path(path).read_bytes()
        (length,) = struct.unpack("<Q", content[:HEAD_LENGTH])
        header = json.loads(content[HEAD_LENGTH : HEAD_LENGTH + length])
        data = content[HEAD_LENGTH + length :]
        metadata = header.pop(METADATA, {})
        tensors = {}
        for name, entry in header.items():
            kind = entry["dtype"]
            if kind not in TYPES:
                fail(f"{path}: {name} is {kind}, expected F32 or F16; average before mms quantize")
            begin, end = entry["data_offsets"]
            tensors[name] = np.frombuffer(data[begin:end], TYPES[kind]).reshape(entry["shape"])
    except (OSError, ValueError, KeyError, TypeError, AttributeError, struct.error) as error:
        fail(f"{path}: cannot be read as safetensors: {error}")
    return metadata, tensors


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
    part = Path(f"{path}.part")
    try:
        part.write_bytes(struct.pack("<Q", len(text)) + text + data)
        part.replace(path)
    except OSError as error:
        part.unlink(missing_ok=True)
        fail(f"{path}: cannot be written: {error}")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("first")
    parser.add_argument("second")
    parser.add_argument("-o", "--output", required=True)
    parser.add_argument("--share", type=float, default=0.5, help="of the second file, 0 to 1")
    arguments = parser.parse_args()
    if not 0 <= arguments.share <= 1:
        fail(f"--share is {arguments.share}, allowed: 0 to 1")
    if Path(arguments.output).exists():
        fail(f"{arguments.output}: exists already")
    metadata, first = tensors_of(arguments.first)
    other_metadata, second = tensors_of(arguments.second)
    if metadata != other_metadata:
        fail("the files are of different networks, see mms info FILE")
    write_weights(arguments.output, metadata, average(first, second, arguments.share))


if __name__ == "__main__":
    main()
