#include "mms/dataset/camera/oni_records.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

#include "mms/core/error.hpp"
#include "mms/ros/storage/input_file.hpp"

namespace mms {
namespace {

// The layout is that of OpenNI2's driver OniFile. Numbers are little-endian.
constexpr std::uint64_t kOniHeader = 24;                 // [B]
constexpr std::uint64_t kMaxOniFields = 64 * 1024;       // [B]
constexpr std::uint64_t kMaxOniImage = 1600 * 1200 * 3;  // the driver's buffer [B]
constexpr std::uint32_t kMaxOniNode = 64;                // cameras have three

constexpr const char* kNoEnd = "the properties of a node have no end before it";

enum OniRecord : std::uint32_t {
  kNodeAddedFirst = 0x2,  // up to version 1.0.0.4
  kIntProperty = 0x3,
  kRealProperty = 0x4,
  kStringProperty = 0x5,
  kGeneralProperty = 0x6,
  kDataBegin = 0x8,
  kStateReady = 0x9,
  kNewData = 0xA,
  kEnd = 0xB,
  kNodeAddedSecond = 0xC,  // 1.0.0.5
  kNodeAdded = 0xD,
  kSeekTable = 0xE,
};

template <class T>
T oni_number(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

class OniRecords {
 public:
  explicit OniRecords(const std::filesystem::path& path) : file_(path, path.string()) {
    const std::string_view header = file_.view(0, kOniHeader);
    if (!header.starts_with("NI10")) throw DataError(file_.name(), "is not a recording of OpenNI");
    const std::tuple version(header[4], header[5], oni_number<std::uint16_t>(header, 6));
    long_positions_ = version >= std::tuple('\1', '\0', std::uint16_t{1});
    header_ = long_positions_ ? 28 : 24;
    last_node_ = oni_number<std::uint32_t>(header, 20);
    if (last_node_ > kMaxOniNode) fail(20, "has " + std::to_string(last_node_) + " nodes");
  }

  void check() {
    std::uint64_t at = kOniHeader;
    while (file_.size() - at >= header_) {
      const Record record = check_record(at);
      follow(record, at);
      if (record.type == kEnd) return;
      if (record.size > file_.size() - at) return;  // the driver reads up to there
      at += record.size;
    }
  }

 private:
  struct Record {
    std::uint32_t type = 0;
    std::uint32_t node = 0;
    std::uint64_t size = 0;  ///< with its payload [B]
  };

  [[noreturn]] void fail(std::uint64_t at, const std::string& what) const {
    throw DataError(file_.name(), "is damaged at byte " + std::to_string(at) + ": " + what);
  }

  Record check_record(std::uint64_t at) {
    const std::string_view header = file_.view(at, header_);
    if (!header.starts_with(std::string_view("NIR\0", 4))) fail(at, "no record begins there");
    const auto fields = oni_number<std::uint32_t>(header, 12);
    const auto payload = oni_number<std::uint32_t>(header, 16);
    const Record record = {oni_number<std::uint32_t>(header, 4),
                           oni_number<std::uint32_t>(header, 8), std::uint64_t{fields} + payload};
    if (fields < header_ || fields > kMaxOniFields || payload > kMaxOniImage) {
      fail(at,
           "a record of " + std::to_string(fields) + " and " + std::to_string(payload) + " bytes");
    }
    if (record.node > last_node_) fail(at, "a record of node " + std::to_string(record.node));
    if (fields > file_.size() - at) return record;
    switch (record.type) {
      case kIntProperty:
      case kRealProperty:
      case kStringProperty:
      case kGeneralProperty:
        check_property(at, fields, record.type == kStringProperty);
        break;
      case kNodeAddedFirst:
      case kNodeAddedSecond:
      case kNodeAdded:
        check_node(at, fields, record.type == kNodeAdded);
        break;
      default:
        break;
    }
    return record;
  }

  /// The text at a place in the fields of a record; moves on behind it. OpenNI2 crashes where it is
  /// no ASCII.
  void check_text(std::uint64_t record, std::uint64_t& at, std::uint64_t end) {
    const std::uint64_t size = take_size(record, at, end);
    const std::string_view text = file_.view(at, size);
    const auto printable = [](char c) { return c >= ' ' && c <= '~'; };
    if (size < 2 || text.back() != '\0' || !std::all_of(text.begin(), text.end() - 1, printable)) {
      fail(record, "a record with a damaged name");
    }
    at += size;
  }

  /// A number of bytes that follow it.
  std::uint64_t take_size(std::uint64_t record, std::uint64_t& at, std::uint64_t end) {
    constexpr std::uint64_t kSize = sizeof(std::uint32_t);
    if (end - at < kSize) fail(record, "a record that is too short");
    const auto size = oni_number<std::uint32_t>(file_.view(at, kSize), 0);
    at += kSize;
    if (size > end - at) fail(record, "a record with " + std::to_string(size) + " bytes of data");
    return size;
  }

  void check_property(std::uint64_t record, std::uint64_t fields, bool text) {
    std::uint64_t at = record + header_;
    const std::uint64_t end = record + fields;
    check_text(record, at, end);
    if (text) return check_text(record, at, end);
    take_size(record, at, end);
  }

  void check_node(std::uint64_t record, std::uint64_t fields, bool has_table) {
    constexpr std::uint64_t kBeforeTable = 3 * sizeof(std::uint32_t) + 2 * sizeof(std::uint64_t);
    std::uint64_t at = record + header_;
    const std::uint64_t end = record + fields;
    check_text(record, at, end);
    const std::uint64_t width = long_positions_ ? sizeof(std::uint64_t) : sizeof(std::uint32_t);
    if (!has_table) return;
    if (end - at < kBeforeTable + width) fail(record, "a record that is too short");
    const std::string_view place = file_.view(at + kBeforeTable, width);
    const std::uint64_t table =
        long_positions_ ? oni_number<std::uint64_t>(place, 0) : oni_number<std::uint32_t>(place, 0);
    if (table == 0) return;
    if (table > file_.size() || file_.size() - table < header_ ||
        oni_number<std::uint32_t>(file_.view(table, header_), 4) != kSeekTable) {
      fail(record, "no table at byte " + std::to_string(table));
    }
    check_record(table);
  }

  /// OpenNI2 begins anew, again and again, where the properties of a node have no end.
  void follow(const Record& record, std::uint64_t at) {
    switch (record.type) {
      case kNodeAddedFirst:
      case kNodeAddedSecond:
      case kNodeAdded:
        if (!nodes_.insert(record.node).second) fail(at, "a node that is added twice");
        open_.insert(record.node);
        break;
      case kStateReady:
        open_.erase(record.node);
        break;
      case kDataBegin:
      case kNewData:
        if (open_.contains(record.node)) fail(at, kNoEnd);
        break;
      case kEnd:
        if (!open_.empty()) fail(at, kNoEnd);
        if (nodes_.empty()) fail(at, "no node before it");
        break;
      default:
        break;
    }
  }

  InputFile file_;
  bool long_positions_ = true;
  std::uint64_t header_ = 0;  ///< of records [B]
  std::uint32_t last_node_ = 0;
  std::set<std::uint32_t> nodes_;
  std::set<std::uint32_t> open_;  ///< nodes whose properties follow
};

}  // namespace

void check_oni_records(const std::filesystem::path& path) {
  OniRecords(path).check();
}

}  // namespace mms
