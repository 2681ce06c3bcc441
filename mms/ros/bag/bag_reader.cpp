#include "mms/ros/bag/bag_reader.hpp"

#include <algorithm>
#include <map>

#include "mms/core/error.hpp"
#include "mms/ros/bag/bag_files.hpp"
#include "mms/ros/storage/input_file.hpp"
#include "mms/storage/compression.hpp"

namespace mms {

BagReader::BagReader(const std::filesystem::path& path)
    : name_((path.has_filename() ? path : path.parent_path()).filename().string()) {
  for (const std::filesystem::path& file : bag_files(path, damage_)) {
    files_.push_back(open_bag_file(file));
    add_file(files_.size() - 1);
  }
  for (BagTopic& topic : topics_) {
    std::vector<Message>& list = messages_[topic.name];
    std::stable_sort(list.begin(), list.end(), [](const Message& a, const Message& b) {
      return a.stored.received < b.stored.received;
    });
    topic.count = list.size();
  }
  std::sort(topics_.begin(), topics_.end(),
            [](const BagTopic& a, const BagTopic& b) { return a.name < b.name; });
  layout_ = files_.front()->contents().layout;
  if (files_.size() > 1) layout_ += ", " + std::to_string(files_.size()) + " files";
}

void BagReader::add_file(std::size_t file) {
  const BagContents& contents = files_[file]->contents();
  if (!contents.damage.empty()) damage_.push_back(contents.damage);
  // Several publishers of a topic are one topic, if they agree in the type.
  std::map<std::string, std::string> type_of;
  for (const BagTopic& topic : topics_) type_of.emplace(topic.name, topic.type);
  std::vector<std::vector<Message>*> lists;
  for (const StoredTopic& stored : contents.topics) {
    const auto [known, is_new] = type_of.emplace(stored.name, stored.type);
    lists.push_back(known->second == stored.type ? &messages_[stored.name] : nullptr);
    if (is_new) topics_.push_back({stored.name, stored.type, 0});
  }
  for (const StoredMessage& stored : contents.messages) {
    if (lists[stored.topic] != nullptr) lists[stored.topic]->push_back({file, stored});
  }
}

const std::vector<BagReader::Message>& BagReader::messages(const std::string& topic) const {
  static const std::vector<Message> kNone;
  const auto found = messages_.find(topic);
  return found == messages_.end() ? kNone : found->second;
}

msg::WireFormat BagReader::format(const std::string& topic, std::size_t index) const {
  const Message& message = messages(topic).at(index);
  return files_[message.file]->contents().topics[message.stored.topic].format;
}

std::string BagReader::where(const std::string& topic, std::size_t index) const {
  return name_ + ": " + topic + " message " + std::to_string(index);
}

std::string_view BagReader::bytes(const std::string& topic, std::size_t index) const {
  const Message& message = messages(topic).at(index);
  const std::string at = where(topic, index);
  const std::string_view stored = files_[message.file]->read(message.stored, at);
  // rosbag2 can compress each message; CDR never begins so.
  if (format(topic, index) != msg::WireFormat::kCdr || !is_zstd(stored)) return stored;
  decompressed_ = decompress(stored, Compression::kZstd, kMaxBlock, at);
  return decompressed_;
}

std::string listed(const std::vector<BagTopic>& topics) {
  std::string text;
  for (const BagTopic& topic : topics) {
    text += (text.empty() ? "" : ", ") + topic.name + " " + topic.type + " (" +
            std::to_string(topic.count) + ")";
  }
  return text.empty() ? "no topics" : text;
}

}  // namespace mms
