#include "mms/segmentation/onnx/model_header.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "mms/segmentation/onnx/class_names.hpp"
#include "mms/segmentation/onnx/graph_check.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/segmentation/protobuf_writer.hpp"
#include "tests/segmentation/tiny_onnx.hpp"

namespace mms::onnx {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::ProtobufWriter;
using testing::tiny_onnx;
using testing::TinyOnnx;
using Names = std::vector<std::string>;

std::string error_of(const std::string& bytes) {
  const std::string message = message_of<DataError>([&] { read_model_header(bytes, "net.onnx"); });
  EXPECT_TRUE(message.starts_with("net.onnx: ")) << message;
  return message;
}

TEST(ModelHeader, ReadsInputAndClasses) {
  const ModelHeader header = read_model_header(tiny_onnx({}), "net");
  EXPECT_EQ(header.width, 64);
  EXPECT_EQ(header.height, 64);
  EXPECT_EQ(header.classes, (Names{"r", "b"}));
}

TEST(ModelHeader, AcceptsOpenSides) {
  const ModelHeader header = read_model_header(tiny_onnx({.batch = 0, .side = 0}), "net");
  EXPECT_EQ(header.width, 0);
  EXPECT_EQ(header.height, 0);
}

TEST(ModelHeader, IgnoresMissingAndInvalidNames) {
  EXPECT_TRUE(read_model_header(tiny_onnx({.names = "person"}), "net").classes.empty());
  const std::string graph_only = tiny_onnx({}).substr(0, tiny_onnx({}).find("task") - 4);
  EXPECT_TRUE(read_model_header(graph_only, "net").classes.empty());
}

TEST(ModelHeader, RejectsOtherInputs) {
  expect_in("has an input of shape (1, 1, 64, 64), expected (1, 3, height, width)",
            error_of(tiny_onnx({.channels = 1})));
  expect_in("shape (2, 3, any, any), expected", error_of(tiny_onnx({.batch = 2, .side = 0})));
  expect_in("(1, 3, 5000, 5000), expected (1, 3, height, width) with sides of at most 4096",
            error_of(tiny_onnx({.side = 5000})));
  expect_in("(18446744073709551615, 3, 64, 64), expected", error_of(tiny_onnx({.batch = -1})));
  expect_in("has an input of shape (), expected",
            error_of(ProtobufWriter().bytes(7, "").message()));
}

TEST(ModelHeader, RejectsOtherFiles) {
  expect_in("is not an ONNX model: it has no graph", error_of(""));
  expect_in("is not an ONNX model: it has no graph",
            error_of(ProtobufWriter().number(1, 7).message()));
  expect_in(
      "is not a complete ONNX model: it has a field without a number (is it an .onnx file, and was "
      "it",
      error_of("PK\x03\x04 a zip file, as of TorchScript"));
  expect_in("it has a field of 111 bytes, but only 2 are left", error_of("\x3aoop"));
  expect_in("it has a field of the unknown type", error_of("<html><body>404</body></html>"));
  expect_in("it has a field without a number", error_of(std::string(100, '\0')));
  expect_in("it has a number of more than 64 bits", error_of("\x08" + std::string(11, '\xff')));
  expect_in("it has a field of 18446744073709551615 bytes, but only 0 are left",
            error_of("\x3a" + std::string(9, '\xff') + "\x01"));
  expect_in("it has a field of 8 bytes, but only 3 are left", error_of("\x09"
                                                                       "abc"));
  expect_in("it has a field of 1 bytes, but only 0 are left", error_of("\x08"));
  expect_in("it has a field of 4 bytes, but only 0 are left", error_of("\x0d"));
}

TEST(ModelHeader, DamagedFilesCauseAtMostDataErrors) {
  const std::string whole = tiny_onnx({});
  const auto survives = [](const std::string& bytes) {
    try {
      const ModelHeader header = read_model_header(bytes, "net");
      EXPECT_TRUE(header.width >= 0 && header.width <= 4096);
    } catch (const DataError&) {
    }
  };
  for (std::size_t size = 0; size < whole.size(); size += 7) survives(whole.substr(0, size));
  for (std::size_t i = 0; i < whole.size(); i += 5) {
    std::string wrong = whole;
    wrong[i] = static_cast<char>(wrong[i] ^ (1 << i % 8));
    survives(wrong);
  }
}

/// A graph with the inputs "image" and "weights" and layers with their inputs and output.
std::string graph_of(const std::vector<std::pair<Names, std::string>>& layers) {
  ProtobufWriter graph;
  for (const auto& [inputs, output] : layers) {
    ProtobufWriter layer;
    for (const std::string& input : inputs) layer.bytes(1, input);
    graph.bytes(1, layer.bytes(2, output).bytes(4, "Conv").message());
  }
  graph.bytes(5, ProtobufWriter().bytes(8, "weights").message());
  return graph.bytes(11, ProtobufWriter().bytes(1, "image").message()).message();
}

TEST(GraphCheck, RejectsUnknownLayerInputs) {
  check_graph(graph_of({}), "net");
  check_graph(graph_of({{{"image", "weights", ""}, "a"}, {{"a", "a"}, "b"}, {{}, "c"}}), "net");
  const auto error = [](const std::vector<std::pair<Names, std::string>>& layers) {
    return message_of<DataError>([&] { check_graph(graph_of(layers), "net"); });
  };
  EXPECT_EQ(error({{{"image", "b"}, "a"}, {{"a"}, "b"}}),
            "net: has a layer Conv with the input 'b', which no earlier layer computes (export it "
            "again)");
  expect_in("with the input 'a', which no earlier layer", error({{{"a"}, "a"}}));
  expect_in("with the input 'imagf', which no earlier layer",
            error({{{"image"}, "a"}, {{"a", "imagf"}, "b"}}));
}

TEST(ClassNames, ReadsPythonTexts) {
  EXPECT_EQ(python_names("{0: 'person', 1: 'traffic light'}"), (Names{"person", "traffic light"}));
  EXPECT_EQ(python_names(" [ 'person' ,\"driver's cab\"] "), (Names{"person", "driver's cab"}));
  EXPECT_EQ(python_names("{1:'b',0:'a',}"), Names{});
  EXPECT_EQ(python_names("{1:'b',0:'a'}"), (Names{"a", "b"}));
  EXPECT_EQ(python_names(R"({0: 'a\'b', 1: 'c\\'})"), (Names{"a'b", "c\\"}));
  EXPECT_EQ(python_names("{0: ''}"), (Names{""}));
}

TEST(ClassNames, ReturnsNoneForOtherText) {
  for (const char* text : {"",
                           " ",
                           "{",
                           "[",
                           "{}",
                           "[]",
                           "person",
                           "{0: 'person'",
                           "{0: 'person}",
                           "{0: 'person']",
                           "{0 'person'}",
                           "{'0': 'person'}",
                           "{0: person}",
                           "{1: 'person'}",
                           "{-1: 'a', 0: 'b'}",
                           "{0: 'a', 0: 'b'}",
                           "{0: 'a', 2: 'b'}",
                           "{99999999999: 'a'}",
                           "{0: 'a'} x",
                           "['a' 'b']",
                           "['a\\",
                           "{0: 'a', 2147483647: 'b'}",
                           "[[['a']]]",
                           "\xff\xfe"}) {
    EXPECT_EQ(python_names(text), Names{}) << text;
  }
}

TEST(ClassNames, ReadsLists) {
  EXPECT_EQ(listed_names("person", "classes"), (Names{"person"}));
  EXPECT_EQ(listed_names(" person , traffic light,agv ", "classes"),
            (Names{"person", "traffic light", "agv"}));
  EXPECT_EQ(listed_names("  ", "classes"), Names{});
  for (const char* text : {"person,,agv", "person, "}) {
    expect_in("classes: class 2 of '" + std::string(text) + "' is empty",
              message_of<DataError>([&] { listed_names(text, "classes"); }));
  }
  expect_in("class 1 of ','", message_of<DataError>([] { listed_names(",", "classes"); }));
}

}  // namespace
}  // namespace mms::onnx
