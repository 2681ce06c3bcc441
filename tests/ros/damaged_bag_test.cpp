#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/bag/bag_reader.hpp"
#include "mms/ros/storage/ros1_records.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/ros/sample_bags.hpp"
#include "tests/support/memory_limit.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

template <class Message>
void read_all(const BagReader& bag, const std::string& topic) {
  for (std::size_t i = 0; i < bag.count(topic); ++i) {
    try {
      bag.read<Message>(topic, i);
    } catch (const DataError&) {  // a damaged message
    }
  }
}

/// Opens the recordings and reads all messages. Messages and an mms::Error are allowed, everything
/// else is a failure.
class DamagedBags : public ::testing::TestWithParam<std::string> {
 protected:
  std::string whole() const {
    const std::string& name = GetParam();
    MessageList list;
    write_sample(list);
    const auto path = folder_.path() / name;
    if (name == "plain.mcap") return mcap_bytes(list.messages(), {.compression = ""});
    if (name == "lz4.mcap") return mcap_bytes(list.messages(), {.compression = "lz4"});
    if (name == "open.mcap") return mcap_bytes(list.messages(), {.chunks = false});
    if (name.ends_with(".db3")) {
      write_db3(path, list.messages(), {.zstd_messages = name == "zstd.db3"});
      return read_file(path);
    }
    const auto bag = create_bag(path);
    write_sample(*bag);
    bag->finish();
    return read_file(path);
  }

  void expect_survived(const std::string& bytes, const std::string& what) const {
    constexpr auto kHang = std::chrono::seconds(5);
    const auto path = folder_.write("damaged_" + GetParam(), bytes);
    const auto start = std::chrono::steady_clock::now();
    try {
      const BagReader bag(path);
      read_all<msg::Image>(bag, "/image");
      read_all<msg::PoseStamped>(bag, "/pose");
      read_all<msg::Transforms>(bag, "/tf");
    } catch (const Error&) {  // refused with a message
    } catch (const std::exception& error) {
      ADD_FAILURE() << what << ": " << error.what();
    }
    EXPECT_LT(std::chrono::steady_clock::now() - start, kHang) << what;
  }

  TempFolder folder_;
  MemoryLimit limit_;
};

TEST_P(DamagedBags, SurvivesTruncation) {
  const std::string bytes = whole();
  const std::size_t step = 1 + bytes.size() / 500;
  for (std::size_t size = 1; size < bytes.size(); size += step) {
    expect_survived(bytes.substr(0, size), "cut at " + std::to_string(size));
  }
}

/// Sets all four and all eight consecutive bytes to an extreme value, whatever they mean.
TEST_P(DamagedBags, SurvivesExtremeLengths) {
  const std::string bytes = whole();
  constexpr std::uint64_t kValues[] = {0x7FFF'FFFF, 0xFFFF'FFFF'FFFF'FFFF};
  for (std::size_t at = 0; at + 8 < bytes.size(); ++at) {
    const bool padding = bytes.find_first_not_of(bytes[at], at) >= at + 8;
    if (padding) continue;
    for (const std::uint64_t value : kValues) {
      std::string damaged = bytes;
      std::memcpy(damaged.data() + at, &value, value > UINT32_MAX ? 8 : 4);
      expect_survived(damaged, std::to_string(value) + " at " + std::to_string(at));
    }
  }
}

TEST_P(DamagedBags, SurvivesRandomChanges) {
  const std::string bytes = whole();
  std::mt19937 random(7);  // NOLINT: always the same changes
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = bytes;
    for (std::uint32_t changes = 1 + random() % 8; changes > 0; --changes) {
      damaged[random() % damaged.size()] = static_cast<char>(random());
    }
    if (random() % 4 == 0) damaged.erase(random() % damaged.size(), random() % 64);
    expect_survived(damaged, "change " + std::to_string(i));
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, DamagedBags,
                         ::testing::Values("a.bag", "a.mcap", "plain.mcap", "lz4.mcap", "open.mcap",
                                           "a.db3", "zstd.db3"),
                         [](const auto& parameter) {
                           std::string name = parameter.param;
                           name[name.find('.')] = '_';
                           return name;
                         });

TEST(Ros1Fields, AreBounded) {
  std::string header;
  for (int i = 0; i < 100; ++i) header += std::string("\x02\0\0\0a=", 6);
  EXPECT_EQ(Ros1Fields(header).text("a"), "");
  header += std::string("\x02\0\0\0b=", 6);
  expect_in("has more than 100 values", message_of<DataError>([&] { Ros1Fields fields(header); }));
}

}  // namespace
}  // namespace mms
