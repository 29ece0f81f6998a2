#!/usr/bin/python3
"""Writes T and the judges V, Q, p and f of a weights file as one ONNX graph: what Engine::Expand computes.

export.py WEIGHTS OUT.onnx. Needs python3-onnx and python3-numpy. Knows the networks of stacking's bundled weights: soft
argmax, a skip, the heads of the paper; scale and shift, and the mask, as the weights have them.
"""
import json
import struct
import sys

import numpy
import onnx
from onnx import TensorProto, helper, numpy_helper


def read(path):
    """The tensors of a safetensors file by name, and the networks' configuration."""
    with open(path, "rb") as file:
        size = struct.unpack("<Q", file.read(8))[0]
        header = json.loads(file.read(size))
        data = file.read()
    config = json.loads(header.pop("__metadata__")["prospect"])["network"]
    kinds = {"F16": numpy.float16, "F32": numpy.float32}
    tensors = {}
    for name, entry in header.items():
        begin, end = entry["data_offsets"]
        values = numpy.frombuffer(data[begin:end], kinds[entry["dtype"]])
        tensors[name] = values.astype(numpy.float32).reshape(entry["shape"])
    return tensors, config


class Graph:
    """Nodes and constants; every method returns the name of what it makes."""

    def __init__(self, tensors):
        self.tensors, self.nodes, self.constants = tensors, [], {}

    def constant(self, name, values):
        self.constants[name] = numpy_helper.from_array(numpy.ascontiguousarray(values), name)
        return name

    def tensor(self, name):
        return self.constant(name, self.tensors[name])

    def numbers(self, *values):
        return self.constant("i_" + "_".join(map(str, values)), numpy.array(values, numpy.int64))

    def node(self, kind, inputs, **attributes):
        name = f"n{len(self.nodes)}"
        self.nodes.append(helper.make_node(kind, inputs, [name], **attributes))
        return name

    def dense(self, x, name):
        return self.node("Gemm", [x, self.tensor(name + ".weight"), self.tensor(name + ".bias")], transB=1)

    def convolution(self, x, name, stride=1):
        kernel = self.tensors[name + ".conv.weight"].shape[2]
        before = (kernel - 1) // 2
        after = kernel - 1 - before if stride == 1 else before
        weights = [self.tensor(name + ".conv.weight"), self.tensor(name + ".conv.bias")]
        return self.node("Conv", [x, *weights], strides=[stride] * 2, pads=[before, before, after, after])

    def normed(self, x, name, modulation=None, doubles=False):
        x = self.convolution(x, name)
        if doubles:
            x = self.node("DepthToSpace", [x], blocksize=2, mode="CRD")
        norm = [self.tensor(name + ".norm.scale"), self.tensor(name + ".norm.shift")]
        x = self.node("InstanceNormalization", [x, *norm], epsilon=1e-5)
        if modulation:
            x = self.node("Add", [self.node("Mul", [x, modulation[0]]), modulation[1]])
        return self.node("Relu", [x])

    def plain(self, x, name, stride=1):
        return self.node("Relu", [self.convolution(x, name, stride)])

    def tiled(self, vector, like):
        shape = self.node("Shape", [like])
        space = self.node("Slice", [shape, self.numbers(2), self.numbers(4)])
        ones = self.node("Concat", [self.numbers(1, 1), space], axis=0)
        return self.node("Expand", [self.node("Unsqueeze", [vector, self.numbers(2, 3)]), ones])


def modulations(g, action, layers):
    """(1 + scale, shift) of each layer of T; nothing where T is not told the action there."""
    if "transform.modulation.weight" not in g.tensors:
        return [None] * layers
    width = g.tensors["transform.modulation.weight"].shape[0] // (2 * layers)
    parts = g.node("Unsqueeze", [g.dense(action, "transform.modulation"), g.numbers(2, 3)])
    one = g.constant("one", numpy.ones(1, numpy.float32))

    def part(i):
        return g.node("Slice", [parts, g.numbers(i * width), g.numbers((i + 1) * width), g.numbers(1)])

    return [(g.node("Add", [part(2 * i), one]), part(2 * i + 1)) for i in range(layers)]


def soft_argmax(g, x, height, width, channels):
    flat = g.node("Softmax", [g.node("Reshape", [x, g.numbers(0, 0, -1)])], axis=2)
    rows, columns = numpy.meshgrid(numpy.linspace(-1, 1, height), numpy.linspace(-1, 1, width), indexing="ij")
    places = numpy.stack([rows.ravel(), columns.ravel()], 1).astype(numpy.float32)
    points = g.node("MatMul", [flat, g.constant("places", places)])
    return g.node("Reshape", [points, g.numbers(0, 2 * channels)])


def action_features(g, action):
    x = g.dense(action, "transform.action")
    mean = g.node("ReduceMean", [x], axes=[1])
    away = g.node("Sub", [x, mean])
    variance = g.node("ReduceMean", [g.node("Mul", [away, away])], axes=[1])
    deviation = g.node("Sqrt", [g.node("Add", [variance, g.constant("epsilon", numpy.full(1, 1e-5, numpy.float32))])])
    x = g.node("Mul", [g.node("Div", [away, deviation]), g.tensor("transform.action_norm.scale")])
    return g.node("Relu", [g.node("Add", [x, g.tensor("transform.action_norm.shift")])])


def transform(g, config, h0, h, action):
    height, width = config["image_height"] // 8, config["image_width"] // 8
    y = action_features(g, action)
    merged, up, join = modulations(g, action, 3)
    both = g.node("Concat", [g.normed(h, "transform.from_h"), g.normed(h0, "transform.from_h0")], axis=1)
    skip = g.normed(both, "transform.merge", merged)
    features = g.normed(g.node("Concat", [skip, g.tiled(y, skip)], axis=1), "transform.with_action")
    points = soft_argmax(g, features, height, width, 64)
    z = g.node("Relu", [g.dense(g.node("Concat", [points, y], axis=1), "transform.dense")])
    z = g.node("Reshape", [z, g.numbers(0, 64, height // 2, width // 2)])
    z = g.normed(z, "transform.up.0", up, doubles=True)
    z = g.normed(g.node("Concat", [z, skip], axis=1), "transform.join.0", join)
    fresh = g.node("Sigmoid", [g.convolution(z, "transform.out")])
    if "transform.mask.conv.weight" not in g.tensors:
        return fresh
    mask = g.node("Sigmoid", [g.convolution(z, "transform.mask")])
    return g.node("Add", [h, g.node("Mul", [mask, g.node("Sub", [fresh, h])])])


def value(g, h):
    x = g.plain(g.plain(g.plain(h, "value.conv.0"), "value.conv.1", 2), "value.conv.2", 2)
    x = g.node("Relu", [g.dense(g.node("Flatten", [x]), "value.dense")])
    return g.node("Sigmoid", [g.dense(x, "value.out")])


def judge(g, name, h0, h, action):
    x = g.node("Concat", [g.plain(h, name + ".from_h"), g.plain(h0, name + ".from_h0"), g.tiled(action, h)], axis=1)
    x = g.node("Flatten", [g.plain(g.plain(x, name + ".conv1", 2), name + ".conv2", 2)])
    for layer in (".dense1", ".dense2"):
        x = g.node("Relu", [g.dense(x, name + layer)])
    return g.node("Sigmoid", [g.dense(x, name + ".out")])


def main(weights, out):
    tensors, config = read(weights)
    known = {"bottleneck": "soft_argmax", "skip": True, "heads": "paper", "activation": "relu", "transform_extra_stages": 0}
    for key, wanted in known.items():
        if config[key] != wanted:
            sys.exit(f"{weights}: {key} is {config[key]}; only {wanted} is written")
    g = Graph(tensors)
    state = ["batch", config["hidden_channels"], config["image_height"] // 8, config["image_width"] // 8]
    inputs = [helper.make_tensor_value_info(name, TensorProto.FLOAT, shape)
              for name, shape in (("h0", state), ("h", state), ("action", ["batch", config["num_actions"]]))]
    after = transform(g, config, "h0", "h", "action")
    results = {"next": after, "value": value(g, after)}
    results.update({name: judge(g, name, "h0", after, "action") for name in "qpf"})
    for name, node in results.items():
        g.nodes.append(helper.make_node("Identity", [node], [name]))
    shapes = {"next": state, "value": ["batch", 1], "f": ["batch", 1]}
    outputs = [helper.make_tensor_value_info(name, TensorProto.FLOAT, shapes.get(name, ["batch", config["num_actions"]]))
               for name in results]
    graph = helper.make_graph(g.nodes, "expand", inputs, outputs, list(g.constants.values()))
    model = helper.make_model(graph, opset_imports=[helper.make_opsetid("", 13)], ir_version=8)
    onnx.checker.check_model(model)
    onnx.save(model, out)


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
