#include "mms/ros/bag/bag_files.hpp"

#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <atomic>

#include "mms/core/error.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/numbers.hpp"
#include "mms/io/text/temporary_path.hpp"
#include "mms/ros/storage/mcap_file.hpp"
#include "mms/ros/storage/mcap_writer.hpp"
#include "mms/ros/storage/ros1_bag.hpp"
#include "mms/ros/storage/ros1_writer.hpp"
#include "mms/ros/storage/sqlite_bag.hpp"
#include "mms/storage/compression.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kZstd = ".zstd";
constexpr std::string_view kRos2Endings[] = {".mcap", ".db3", ".mcap.zstd", ".db3.zstd"};
constexpr std::string_view kRos1Endings[] = {".bag", ".bag.active"};

template <std::size_t N>
std::string_view ending_of(std::string_view name, const std::string_view (&endings)[N]) {
  const auto* found = std::find_if(std::begin(endings), std::end(endings),
                                   [&](std::string_view ending) { return name.ends_with(ending); });
  return found == std::end(endings) ? std::string_view() : *found;
}

/// The ending of a recording's name; empty for others.
std::string_view bag_ending(std::string_view name) {
  const std::string_view ending = ending_of(name, kRos2Endings);
  return ending.empty() ? ending_of(name, kRos1Endings) : ending;
}

/// Files of a rosbag2 folder. Of a file and its compressed copy, the file is used.
std::vector<std::string> recorded_files(const std::vector<std::string>& names) {
  std::vector<std::string> files;
  for (const std::string& name : names) {
    if (ending_of(name, kRos2Endings).empty()) continue;
    const bool copy = name.ends_with(kZstd) &&
                      std::find(names.begin(), names.end(),
                                name.substr(0, name.size() - kZstd.size())) != names.end();
    if (!copy) files.push_back(name);
  }
  return files;
}

/// "x_12.mcap" as a part of the recording x.
struct SplitName {
  explicit SplitName(const std::string& name) {
    stem = name.substr(0, name.size() - bag_ending(name).size());
    const std::size_t bar = stem.rfind('_');
    if (bar == std::string::npos) return;
    if (const auto parsed = parse_integer(std::string_view(stem).substr(bar + 1))) {
      number = *parsed;
      stem.resize(bar);
    }
  }
  std::string stem;
  std::int64_t number = 0;
};

std::vector<std::string> by_number(std::vector<std::string> files, const fs::path& folder) {
  for (const std::string& file : files) {
    if (SplitName(file).stem == SplitName(files.front()).stem) continue;
    throw DataError(folder.string(), "has several recordings, " + files.front() + " and " + file,
                    "choose one, as " + (folder / files.front()).string());
  }
  std::sort(files.begin(), files.end(), [](const std::string& a, const std::string& b) {
    return SplitName(a).number < SplitName(b).number;
  });
  return files;
}

/// Opens the file `path`, whose format is that of the name `original`.
/// @param shown  name in messages
std::unique_ptr<BagStorage> open_plain(const fs::path& path, const std::string& original,
                                       const std::string& shown) {
  if (original.ends_with(".mcap")) return std::make_unique<McapFile>(path, shown);
  if (original.ends_with(".db3")) return std::make_unique<SqliteBag>(path, shown);
  return std::make_unique<Ros1Bag>(path, shown);
}

/// Opens a file that is decompressed first, and removes it at the end.
class UnpackedStorage final : public BagStorage {
 public:
  explicit UnpackedStorage(const fs::path& packed) {
    decompress_zstd_file(packed, file_.path());
    std::string name = packed.filename().string();
    name.resize(name.size() - kZstd.size());
    storage_ = open_plain(file_.path(), name, packed.string());
  }

  const BagContents& contents() const override { return storage_->contents(); }
  std::string_view read(const StoredMessage& message, const std::string& where) override {
    return storage_->read(message, where);
  }

 private:
  static fs::path temporary_file() {
    static std::atomic<int> counter = 0;
    return fs::temp_directory_path() /
           ("mms_" + std::to_string(::getpid()) + "_" + std::to_string(counter++) + ".unpacked");
  }

  TemporaryPath file_{temporary_file()};
  std::unique_ptr<BagStorage> storage_;
};

/// The list of files in metadata.yaml; empty if it has none.
std::vector<std::string> listed_files(const fs::path& metadata) {
  std::vector<std::string> files;
  try {
    const YAML::Node information = YAML::Load(read_file(metadata))["rosbag2_bagfile_information"];
    for (const YAML::Node& file : information["relative_file_paths"]) {
      files.push_back(fs::path(file.as<std::string>()).filename().string());
    }
  } catch (const YAML::Exception& error) {
    throw DataError(metadata.string(), std::string("cannot be read: ") + error.what(),
                    "without this file the recording is opened, too");
  }
  return files;
}

/// The listed files that are there, under their names or decompressed.
std::vector<std::string> present_files(const std::vector<std::string>& listed_names,
                                       const std::vector<std::string>& present,
                                       std::vector<std::string>& warnings) {
  std::vector<std::string> files;
  for (const std::string& name : listed_names) {
    const auto found = std::find_if(present.begin(), present.end(), [&](const std::string& file) {
      return file == name || file + std::string(kZstd) == name;
    });
    if (found != present.end()) {
      files.push_back(*found);
    } else {
      warnings.push_back(name + " of metadata.yaml is missing");
    }
  }
  return files;
}

}  // namespace

bool is_bag_name(const fs::path& path) {
  return !bag_ending(path.filename().string()).empty();
}

bool is_bag_folder(const std::vector<std::string>& names) {
  return !recorded_files(names).empty();
}

fs::path bag_stem(const fs::path& path) {
  const std::string name = path.string();
  return name.substr(0, name.size() - bag_ending(name).size());
}

std::vector<fs::path> bag_files(const fs::path& path, std::vector<std::string>& warnings) {
  if (!fs::is_directory(path)) return {path};
  const std::vector<std::string> present = recorded_files(list_folder(path));
  const fs::path metadata = path / "metadata.yaml";
  std::vector<std::string> files;
  if (fs::exists(metadata)) files = present_files(listed_files(metadata), present, warnings);
  if (files.empty() && !present.empty()) files = by_number(present, path);
  if (files.empty()) throw DataError(path.string(), "has no .mcap or .db3 file");
  std::vector<fs::path> paths;
  for (const std::string& file : files) paths.push_back(path / file);
  return paths;
}

std::unique_ptr<BagStorage> open_bag_file(const fs::path& path) {
  const std::string name = path.string();
  if (name.ends_with(kZstd)) return std::make_unique<UnpackedStorage>(path);
  return open_plain(path, name, name);
}

std::unique_ptr<BagWriter> create_bag(const fs::path& path) {
  const std::string name = path.string();
  if (name.ends_with(".mcap")) return std::make_unique<McapWriter>(path);
  if (name.ends_with(".bag")) return std::make_unique<Ros1Writer>(path);
  throw DataError(name, "cannot be written in this format", "expected a name as x.bag or x.mcap");
}

}  // namespace mms
