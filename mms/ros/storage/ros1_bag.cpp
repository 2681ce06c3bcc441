#include "mms/ros/storage/ros1_bag.hpp"

#include <algorithm>

#include "mms/core/error.hpp"

namespace mms {

Ros1Bag::Ros1Bag(const std::filesystem::path& path, const std::string& name)
    : ChunkedFile(path, name) {
  contents_.layout = "ROS 1 bag";
  const std::string_view start = file_.view(0, std::min(file_.size(), kRos1Magic.size()));
  if (start != kRos1Magic) {
    throw DataError(name, "is not a ROS 1 bag of version 2.0", "a bag begins with '#ROSBAG V2.0'");
  }
  walk(kRos1Magic.size());
}

std::uint64_t Ros1Bag::walk_record(std::uint64_t offset) {
  const auto length_at = [this](std::uint64_t at) {
    return ByteReader(file_.view(at, sizeof(std::uint32_t)), "length").take<std::uint32_t>();
  };
  const std::uint64_t header_size = length_at(offset);
  const Ros1Fields header(file_.view(offset + sizeof(std::uint32_t), header_size));
  const std::uint64_t data = offset + header_size + 2 * sizeof(std::uint32_t);
  const std::uint64_t size = length_at(data - sizeof(std::uint32_t));
  const Ros1Op op = header.op();
  if (op == Ros1Op::kChunk) add_chunk(header, data, size);
  if (data + size > file_.size()) throw DataError(file_.name(), "ends within a record");
  if (op == Ros1Op::kBagHeader) {
    missing_ = std::uint64_t{header.number<std::uint32_t>("conn_count")} +
               header.number<std::uint32_t>("chunk_count");
    const bool indexed = header.number<std::uint64_t>("index_pos") > 0;
    closed_ = indexed && missing_ == 0;
  }
  if (op == Ros1Op::kConnection || op == Ros1Op::kChunkInfo) closed_ = --missing_ == 0;
  if (op == Ros1Op::kIndex) add_index(header, file_.view(data, size));
  if (op == Ros1Op::kConnection) add_connection(header, file_.view(data, size));
  return data + size;
}

void Ros1Bag::add_chunk(const Ros1Fields& header, std::uint64_t data, std::uint64_t size) {
  const std::uint64_t available = std::min(size, file_.size() - data);
  chunks_.push_back({.offset = data,
                     .size = available,
                     .raw_size = header.number<std::uint32_t>("size"),
                     .compression = compression_of(header.text("compression"), file_.name()),
                     .incomplete = available < size});
}

void Ros1Bag::add_index(const Ros1Fields& header, std::string_view data) {
  constexpr std::size_t kEntry = sizeof(std::uint64_t) + sizeof(std::uint32_t);
  if (header.number<std::uint32_t>("ver") != 1) {
    throw DataError(file_.name(), "has an index of another version");
  }
  if (chunks_.empty()) throw DataError(file_.name(), "has an index without chunk");
  const auto topic = header.number<std::uint32_t>("conn");
  ByteReader entries(data, "the index of a chunk");
  auto left = entries.checked_count(header.number<std::uint32_t>("count"), kEntry);
  for (; left > 0; --left) {
    const Timestamp time = ros1_time(entries.take<std::uint64_t>());
    contents_.messages.push_back({.received = time,
                                  .topic = topic,
                                  .chunk = static_cast<std::uint32_t>(chunks_.size() - 1),
                                  .offset = entries.take<std::uint32_t>()});
  }
  chunks_.back().indexed = true;
}

void Ros1Bag::add_connection(const Ros1Fields& header, std::string_view data) {
  describe_topic(header.number<std::uint32_t>("conn"),
                 {.name = std::string(header.text("topic")),
                  .type = std::string(Ros1Fields(data).text("type")),
                  .format = msg::WireFormat::kRos1});
}

void Ros1Bag::scan_record(ByteReader& records, const StoredMessage& at, bool messages) {
  const Ros1Fields header(records.take(records.take_count(1)));
  const std::string_view data = records.take(records.take_count(1));
  if (header.op() == Ros1Op::kConnection) add_connection(header, data);
  if (header.op() != Ros1Op::kMessage || !messages) return;
  StoredMessage message = at;
  message.topic = header.number<std::uint32_t>("conn");
  message.received = ros1_time(header.number<std::uint64_t>("time"));
  contents_.messages.push_back(message);
}

std::string_view Ros1Bag::message_of(std::string_view record, const std::string& where) {
  ByteReader reader(record, where);
  const Ros1Fields header(reader.take(reader.take_count(1)));
  if (header.op() != Ros1Op::kMessage) throw DataError(where, "is not where the index says");
  return reader.take(reader.take_count(1));
}

}  // namespace mms
