#!/usr/bin/env python3
"""Shifts the scores of a class in a weights file: adds to the bias of its category.

usage: shift_scores.py WEIGHTS.safetensors CLASS SHIFT -o RESULT.safetensors
"""
import argparse
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from average_weights import fail, tensors_of, write_weights  # noqa: E402

BIAS = "mask_head.conv_cls.bias"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("weights")
    parser.add_argument("name", metavar="CLASS")
    parser.add_argument("shift", type=float, help="of the logit: -0.3 makes a score of 0.37 one of 0.3")
    parser.add_argument("-o", "--output", required=True)
    arguments = parser.parse_args()
    if Path(arguments.output).exists():
        fail(f"{arguments.output}: exists already")
    metadata, tensors = tensors_of(arguments.weights)
    classes = metadata.get("classes", "").split(",")
    if arguments.name not in classes or BIAS not in tensors:
        fail(f"{arguments.weights}: has no class {arguments.name}, only {', '.join(classes)}")
    bias = tensors[BIAS].copy()
    bias[classes.index(arguments.name)] += arguments.shift
    tensors[BIAS] = bias
    write_weights(arguments.output, metadata, tensors)


if __name__ == "__main__":
    main()
