#include "mms/io/weights/safetensors.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using testing::expect_in;
using testing::message_of;
using testing::TempFolder;

std::string length_bytes(std::uint64_t length) {
  std::string bytes;
  for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(length >> shift);
  return bytes;
}

/// A file of a header and its data.
std::string file_of(const std::string& header, const std::string& data = "") {
  return length_bytes(header.size()) + header + data;
}

Weights parse(const std::string& bytes) {
  return parse_safetensors({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                           "net.safetensors");
}

std::string error_of(const std::string& bytes) {
  const std::string message = message_of<DataError>([&] { parse(bytes); });
  EXPECT_TRUE(message.starts_with("net.safetensors: ")) << message;
  return message;
}

std::string entry(const std::string& dtype, const std::string& shape, const std::string& offsets,
                  const std::string& more = "") {
  return R"({"dtype": ")" + dtype + R"(", "shape": )" + shape + R"(, "data_offsets": )" + offsets +
         more + "}";
}

/// A file with the one tensor "a".
std::string file_with(const std::string& tensor, const std::string& data = "") {
  return file_of(R"({"a": )" + tensor + "}", data);
}

const std::string kFour(4, '\0');
const std::string kEight(8, '\0');

Weights sample() {
  Weights weights;
  weights.metadata = {{"format", "pt"}, {"note", "a \"quoted\" ä"}};
  weights.tensors["conv.weight"] = {{2, 1, 3}, {0.1F, -0.0F, 1e-45F, 6e4F, -1.5F, 1e-30F}};
  weights.tensors["a.scale"] = {{}, {2.5F}};
  weights.tensors["empty"] = {{0, 4}, {}};
  return weights;
}

void expect_same_bits(const Weights& actual, const Weights& expected) {
  EXPECT_EQ(actual, expected);
  for (const auto& [name, tensor] : expected.tensors) {  // == does not distinguish -0 from 0
    for (std::size_t i = 0; i < tensor.values.size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(actual.tensors.at(name).values[i]),
                std::bit_cast<std::uint32_t>(tensor.values[i]));
    }
  }
}

TEST(Safetensors, RoundTripsExactly) {
  const TempFolder folder;
  const auto path = folder.path() / "a.safetensors";
  write_safetensors(path, sample());
  expect_same_bits(read_safetensors(path), sample());
  write_safetensors(folder.path() / "b.safetensors", read_safetensors(path));
  EXPECT_EQ(read_file(folder.path() / "b.safetensors"), read_file(path));
}

TEST(Safetensors, WritesDocumentedFormat) {
  const TempFolder folder;
  write_safetensors(folder.path() / "a", {{}, {{"b", {{1}, {1.0F}}}, {"a", {{}, {-2.0F}}}}});
  const std::string header = R"({"a":{"dtype":"F32","shape":[],"data_offsets":[0,4]},)"
                             R"("b":{"dtype":"F32","shape":[1],"data_offsets":[4,8]}})";
  const std::string padding((8 - header.size() % 8) % 8, ' ');
  EXPECT_EQ(read_file(folder.path() / "a"),
            file_of(header + padding, std::string("\0\0\0\xC0\0\0\x80\x3F", 8)));
}

TEST(Safetensors, EmptyWeightsRoundTrip) {
  EXPECT_EQ(encode_safetensors({}, TensorType::kFloat32, "").size(), 16U);
  EXPECT_EQ(parse(file_of("{}")), Weights());
}

TEST(Safetensors, Float16IsRoundedAndSmaller) {
  Weights weights;
  weights.tensors["a"] = {{2, 2}, {1.0F + 0x1p-11F, 1.0F + 3 * 0x1p-11F, 3 * 0x1p-25F, -65519.0F}};
  const TempFolder folder;
  write_safetensors(folder.path() / "a", weights, TensorType::kFloat16);
  const WeightTensor read = read_safetensors(folder.path() / "a").tensors.at("a");
  EXPECT_EQ(read.values, (std::vector{1.0F, 1.0F + 0x1p-9F, 0x1p-23F, -65504.0F}));
  const auto whole = encode_safetensors(weights, TensorType::kFloat32, "");
  const auto half = encode_safetensors(weights, TensorType::kFloat16, "");
  EXPECT_LT(half.size(), whole.size());
}

TEST(Safetensors, Int8StoresIntegersOnly) {
  Weights weights;
  weights.tensors["bytes"] = {{3}, {-127.0F, 0.0F, 127.0F}};
  weights.tensors["halves"] = {{2}, {0.5F, 127.0F}};
  weights.tensors["large"] = {{1}, {128.0F}};
  const auto written = encode_safetensors(weights, TensorType::kInt8, "");
  EXPECT_EQ(parse_safetensors(written, ""), weights);
  const std::string text(written.begin(), written.end());
  EXPECT_NE(text.find(R"("bytes":{"dtype":"I8","shape":[3],"data_offsets":[0,3]})"), text.npos);
  EXPECT_NE(text.find(R"("halves":{"dtype":"F16","shape":[2],"data_offsets":[3,7]})"), text.npos);
  EXPECT_NE(text.find(R"("large":{"dtype":"F16","shape":[1],"data_offsets":[7,9]})"), text.npos);
}

TEST(Safetensors, ReadsEveryType) {
  struct Case {
    const char* type;
    std::string data;
    float value;
  };
  const std::vector<Case> cases = {{"F32", std::string("\0\0\xA0\xBF", 4), -1.25F},
                                   {"F16", std::string("\x55\x35", 2), 0.333251953125F},
                                   {"BF16", std::string("\x49\xC0", 2), -3.140625F},
                                   {"F64", std::string("\0\0\0\0\0\0\xF4\xBF", 8), -1.25F},
                                   {"I64", std::string("\xFE\xFF\xFF\xFF\xFF\xFF\xFF\xFF"), -2.0F},
                                   {"I32", std::string("\x07\0\0\x80", 4), -2147483641.0F},
                                   {"I8", "\x81", -127.0F}};
  for (const Case& c : cases) {
    const std::string offsets = "[0, " + std::to_string(c.data.size()) + "]";
    EXPECT_EQ(parse(file_with(entry(c.type, "[]", offsets), c.data)).tensors.at("a"),
              (WeightTensor{{}, {c.value}}))
        << c.type;
  }
}

TEST(Safetensors, ReadsTensorsInAnyOrder) {
  const Weights weights = parse(file_of(R"({"z": )" + entry("F32", "[1]", "[0, 4]") + R"(, "e": )" +
                                            entry("F32", "[0]", "[4, 4]") + R"(, "a": )" +
                                            entry("F16", "[1]", "[4, 6]") + "}   ",
                                        std::string("\0\0\x80\x3F\0\x40", 6)));
  EXPECT_EQ(weights.tensors.at("z").values, std::vector{1.0F});
  EXPECT_EQ(weights.tensors.at("a").values, std::vector{2.0F});
  EXPECT_TRUE(weights.tensors.at("e").values.empty());
}

TEST(Safetensors, ReportsTruncation) {
  const TempFolder folder;
  expect_in("no such file",
            message_of<FileError>([&] { read_safetensors(folder.path() / "none"); }));
  EXPECT_TRUE(message_of<DataError>([&] {
                read_safetensors(folder.write("a", "abc"));
              }).starts_with((folder.path() / "a").string() + ": is truncated: 5 of its 8 bytes"));
  expect_in("is truncated: 8 of its 8 bytes are missing", error_of(""));
  const std::string whole = file_with(entry("F32", "[2]", "[0, 8]"), kEight);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    expect_in("is truncated: ", error_of(whole.substr(0, size)));
  }
  expect_in("is truncated: 3 of its " + std::to_string(whole.size()) + " bytes are missing",
            error_of(whole.substr(0, whole.size() - 3)));
  expect_in("has 1 bytes after its last tensor", error_of(whole + " "));
  expect_in("has 4 bytes after its last tensor", error_of(file_of("{}", kFour)));
}

TEST(Safetensors, RejectsExcessiveHeaderLength) {
  expect_in("its header has 100000001 bytes, allowed: up to 100000000",
            error_of(length_bytes(100'000'001) + "{}"));
  expect_in("its header has 18446744073709551615 bytes",
            error_of(length_bytes(~std::uint64_t{0}) + "{}"));
  expect_in("is truncated: 99999998 of its 100000008 bytes are missing",
            error_of(length_bytes(100'000'000) + "{}"));
  expect_in("is it a safetensors file? convert a .pth file to one",  // a zip, as PyTorch writes
            error_of("PK\x03\x04\x14\x08\x08\x08 archive/data.pkl"));
}

TEST(Safetensors, RejectsHeaderThatIsNoObject) {
  expect_in("its header does not begin with '{'", error_of(file_of("")));
  expect_in("its header does not begin with '{'", error_of(file_of("[1]")));
  expect_in("its header does not begin with '{'", error_of(file_of(" {}")));
  expect_in("its header is not JSON: parse error at line 1, column 2", error_of(file_of("{")));
  expect_in("its header is not JSON: parse error", error_of(file_of("{} {}")));
  expect_in("its header is not JSON: parse error", error_of(file_of("{\"\xFF\": 1}")));
  expect_in("a: is a number, expected an object", error_of(file_with("3")));
  expect_in("a: is a list, expected an object", error_of(file_with("[1]")));
  expect_in("a: is a null, expected an object", error_of(file_with("null")));
}

TEST(Safetensors, RejectsDuplicateNames) {
  const std::string tensor = entry("F32", "[0]", "[0, 0]");
  expect_in("has the name 'a' twice", error_of(file_of(R"({"a": )" + tensor + R"(, "b": )" +
                                                       tensor + R"(, "a": )" + tensor + "}")));
  expect_in("has the name 'dtype' twice",
            error_of(file_with(entry("F32", "[0]", "[0, 0]", R"(, "dtype": "F16")"))));
  expect_in("has the name 'x' twice",
            error_of(file_of(R"({"__metadata__": {"x": "1", "x": "2"}})")));
  EXPECT_EQ(
      parse(file_of(R"({"dtype": )" + tensor + R"(, "shape": )" + tensor + "}")).tensors.size(),
      2U);
}

TEST(Safetensors, RejectsDeepNesting) {
  for (const auto& [open, close] :
       std::vector<std::pair<std::string, std::string>>{{"[", "]"}, {R"({"a": )", "}"}}) {
    std::string nested = R"({"a": )";
    for (int i = 0; i < 1'000'000; ++i) nested += open;
    expect_in("its header is nested more than 3 levels deep", error_of(file_of(nested)));
    expect_in("its header is nested more than 3 levels deep",
              error_of(file_with(open + open + open + "1" + close + close + close)));
  }
  expect_in("nested more than 3", error_of(file_with(entry("F32", "[[1]]", "[0, 4]"), kFour)));
}

TEST(Safetensors, ErrorsNameEntry) {
  const auto error = [](const std::string& dtype, const std::string& shape,
                        const std::string& offsets, const std::string& more = "") {
    return error_of(file_with(entry(dtype, shape, offsets, more), kEight));
  };
  expect_in("a.dtype: is 'U8', allowed: F32, F16, BF16, F64, I64, I32, I8",
            error("U8", "[]", "[]"));
  expect_in("a: missing key 'dtype'", error_of(file_with("{}")));
  expect_in("a.dtype: is a number", error_of(file_with(R"({"dtype": 1})")));
  expect_in("a: missing key 'shape'", error_of(file_with(R"({"dtype": "F32"})")));
  expect_in("a: missing key 'data_offsets'",
            error_of(file_with(R"({"dtype": "F32", "shape": []})")));
  expect_in("a: has the unknown key 'stride', allowed: dtype, shape, data_offsets",
            error("F32", "[2]", "[0, 8]", R"(, "stride": [1])"));
  expect_in("a.shape: is a number, expected a list", error("F32", "2", "[0, 8]"));
  expect_in("a.shape[1]: is -2, allowed: 0 to 9e+18", error("F32", "[1, -2]", "[0, 8]"));
  expect_in("a.shape[0]: is a string, expected a number", error("F32", R"(["2"])", "[0, 8]"));
  expect_in("has the floating-point number 2, allowed: integers", error("F32", "[2.0]", "[0, 8]"));
  expect_in("has the floating-point number 1e+20, allowed: integers below 2^63",
            error("F32", "[100000000000000000000]", "[0, 8]"));
  expect_in("a.shape[0]: is 1.844", error("F32", "[18446744073709551615]", "[0, 8]"));
  expect_in("a.shape: exceeds 64 bits", error("F32", "[4611686018427387904]", "[0, 0]"));
  expect_in("a.shape: exceeds 64 bits", error("F32", "[4294967296, 4294967296, 0]", "[0, 0]"));
  expect_in("a.data_offsets: has 1 numbers", error("F32", "[2]", "[8]"));
  expect_in("a.data_offsets: end at byte 0, before its begin at byte 8",
            error("F32", "[2]", "[8, 0]"));
  expect_in("a.data_offsets[0]: is -8, allowed: 0 to 9e+18", error("F32", "[2]", "[-8, 0]"));
  expect_in("a.data_offsets: have 8 bytes, expected from shape and dtype: 12",
            error("F32", "[3]", "[0, 8]"));
  expect_in("a.data_offsets: have 8 bytes, expected from shape and dtype: 16",
            error("F64", "[2]", "[0, 8]"));
}

TEST(Safetensors, RejectsUnusedAndSharedData) {
  const auto two = [](const std::string& first, const std::string& second) {
    return error_of(file_of(
        R"({"a": )" + entry("F32", "[1]", first) + R"(, "b": )" + entry("F32", "[1]", second) + "}",
        kEight));
  };
  expect_in("tensor 'b' begins at byte 2 of the data, but byte 4 is the first free one",
            two("[0, 4]", "[2, 6]"));
  expect_in("tensor 'b' begins at byte 0 of the data", two("[0, 4]", "[0, 4]"));
  expect_in("4 unused bytes of data before 'b'", two("[0, 4]", "[8, 12]"));
  expect_in("2 unused bytes of data before 'a'", two("[2, 6]", "[6, 10]"));
  expect_in("is truncated: 4 of its", error_of(file_with(entry("F32", "[3]", "[0, 12]"), kEight)));
  expect_in("is truncated: 8000000000000000000 of its",  // without an allocation of that size
            error_of(file_with(entry("F64", "[1000000000000000000]", "[0, 8000000000000000000]"))));
}

TEST(Safetensors, RejectsMetadataThatIsNoText) {
  expect_in("__metadata__.epoch: is a number, expected a string",
            error_of(file_of(R"({"__metadata__": {"epoch": 3}})")));
  expect_in("__metadata__: is not an object of strings",
            error_of(file_of(R"({"__metadata__": ["x"]})")));
  expect_in("__metadata__: is not an object of strings",
            error_of(file_of(R"({"__metadata__": null})")));
}

TEST(Safetensors, RejectsNonFiniteValues) {
  const auto second = [](const std::string& type, const std::string& bits) {
    const std::string offsets = "[0, " + std::to_string(2 * bits.size()) + "]";
    return error_of(file_with(entry(type, "[2]", offsets), std::string(bits.size(), '\0') + bits));
  };
  expect_in("tensor 'a': value 1 is nan, allowed: -3.40", second("F32", {"\0\0\xC0\x7F", 4}));
  expect_in("tensor 'a': value 1 is -inf", second("F32", {"\0\0\x80\xFF", 4}));
  expect_in("tensor 'a': value 1 is inf", second("F16", {"\0\x7C", 2}));
  expect_in("tensor 'a': value 1 is nan", second("BF16", {"\xC0\x7F", 2}));
  expect_in("tensor 'a': value 1 is 1e+300",
            second("F64", {"\x9C\x75\x00\x88\x3C\xE4\x37\x7E", 8}));
}

TEST(Safetensors, WritesFloat32BeyondFloat16Range) {
  Weights weights;
  weights.tensors["large"] = {{2}, {0.1F, 65520.0F}};
  weights.tensors["small"] = {{1}, {0.1F}};
  const Weights read = parse_safetensors(encode_safetensors(weights, TensorType::kFloat16, ""), "");
  EXPECT_EQ(read.tensors.at("large"), weights.tensors.at("large"));
  EXPECT_EQ(read.tensors.at("small").values[0], 0.0999755859375F);
}

TEST(Safetensors, RejectsWritingInvalidWeights) {
  const TempFolder folder;
  const auto path = folder.path() / "net";
  const auto error = [&](const std::string& name, const WeightTensor& tensor, TensorType type) {
    Weights weights;
    weights.tensors[name] = tensor;
    const auto message = message_of<DataError>([&] { write_safetensors(path, weights, type); });
    EXPECT_TRUE(message.starts_with(path.string() + ": ")) << message;
    EXPECT_TRUE(list_folder(folder.path()).empty());
    return message;
  };
  expect_in("tensor 'a': value 0 is nan", error("a", {{1}, {std::nanf("")}}, TensorType::kFloat16));
  expect_in("tensor 'a': value 0 is -inf",
            error("a", {{1}, {-std::numeric_limits<float>::infinity()}}, TensorType::kFloat32));
  expect_in("tensor 'a' has 3 values, expected the product of its shape",
            error("a", {{2, 2}, {1, 2, 3}}, TensorType::kFloat32));
  expect_in("tensor 'a' has 1 values", error("a", {{-1, -1}, {1}}, TensorType::kFloat32));
  expect_in("tensor 'a' has 0 values",
            error("a", {{1LL << 32, 1LL << 32}, {}}, TensorType::kFloat32));
  expect_in("the tensor name '__metadata__'",
            error("__metadata__", {{}, {1}}, TensorType::kFloat32));
  expect_in("is not UTF-8", error("\xFF", {{}, {1}}, TensorType::kFloat32));
}

TEST(Safetensors, ChangedBytesCauseAtMostDataErrors) {
  const auto bytes = encode_safetensors(sample(), TensorType::kFloat16, "");
  const std::string whole(bytes.begin(), bytes.end());
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const char wrong : {'\0', '\xFF', '"', '9', '-', '[', '}', ' ', ',', '\x7C'}) {
      std::string changed = whole;
      changed[i] = wrong;
      try {
        parse(changed);
      } catch (const DataError&) {
        continue;  // any other exception fails the test
      }
    }
  }
}

TEST(Safetensors, ReadsSharedFile) {
  const auto path = std::filesystem::path(MMS_SOURCE_DIR) /
                    "../shared/data/weights/resnet18_imagenet_partial.safetensors";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no shared data";
  const Weights weights = read_safetensors(path);
  EXPECT_EQ(weights.tensors.size(), 38U);
  EXPECT_EQ(weights.metadata.at("format"), "pt");
  const WeightTensor& stem = weights.tensors.at("conv1.weight");
  EXPECT_EQ(stem.shape, (std::vector<std::int64_t>{64, 3, 7, 7}));
  EXPECT_EQ(stem.values.size(), 9408U);
}

}  // namespace
}  // namespace mms
