#include "mms/io/image/npy_io.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

std::string file_of(const std::string& header, const std::string& data) {
  std::string bytes = "\x93NUMPY";
  bytes += '\x01';
  bytes += '\0';
  bytes += static_cast<char>(header.size());
  bytes += '\0';
  return bytes + header + data;
}

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)};
}

std::string header(const std::string& type, const std::string& shape = "(2, 3)",
                   const std::string& order = "False") {
  return "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
}

TEST(NpyIo, ReadsRowsOfEachType) {
  const TempFolder folder;
  const std::vector<std::string> files = {
      file_of(header("<f4"), bytes_of<float>({1, 2, 3, 4, 5, 6.5F})),
      file_of(header("<f8"), bytes_of<double>({1, 2, 3, 4, 5, 6.5}))};
  for (const std::string& bytes : files) {
    const auto image = std::get<Image<float>>(read_npy(folder.write("a.npy", bytes)));
    ASSERT_EQ(image.width(), 3);
    ASSERT_EQ(image.height(), 2);
    EXPECT_EQ(image(2, 0), 3.0F);
    EXPECT_EQ(image(0, 1), 4.0F);
    EXPECT_EQ(image(2, 1), 6.5F);
  }
}

TEST(NpyIo, KeepsIntegers) {
  const TempFolder folder;
  const auto path =
      folder.write("a.npy", file_of(header("<u2"), bytes_of<std::uint16_t>({1, 2, 3, 4, 5, 6})));
  const auto image = std::get<Image<std::uint16_t>>(read_npy(path));
  ASSERT_EQ(image.width(), 3);
  EXPECT_EQ(image(2, 0), 3);
  EXPECT_EQ(image(2, 1), 6);
}

TEST(NpyIo, RejectsOtherArraysAndDamagedFiles) {
  const TempFolder folder;
  const std::string data = bytes_of<float>({1, 2, 3, 4, 5, 6});
  const auto error = [&](const std::string& bytes) {
    return message_of<DataError>([&] { read_npy(folder.write("a.npy", bytes)); });
  };
  expect_in("is not a NumPy file", error("hello"));
  expect_in("is truncated", error(file_of(header("<f4"), data).substr(0, 30)));
  expect_in("has 20 bytes of data, not 24", error(file_of(header("<f4"), data.substr(4))));
  expect_in("expected one of two dimensions", error(file_of(header("<f4", "(6,)"), data)));
  expect_in("in C order", error(file_of(header("<f4", "(2, 3)", "True"), data)));
  expect_in("has numbers of type >f4", error(file_of(header(">f4"), data)));
  expect_in("has a side of 0 px", error(file_of(header("<f4", "(0, 3)"), "")));
  expect_in("has a side of 99999 px", error(file_of(header("<f4", "(99999, 99999)"), "")));
  expect_in("bytes of data, not 1073741824", error(file_of(header("<f4", "(16384, 16384)"), "")));
  std::string huge = file_of(header("<f4"), std::string(20'000, 'x'));
  huge[6] = '\x02';  // four bytes have the size of the header
  huge[9] = '\x40';
  huge[10] = huge[11] = '\0';
  expect_in("has a damaged NumPy header", error(huge));
}

}  // namespace
}  // namespace mms
