#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace mms::testing {

/// A reader of bytes that others wrote.
struct FuzzTarget {
  std::string name;
  std::vector<std::string> (*seeds)();  ///< valid inputs, made by our own writers
  /// Reads the input and uses what it read. Any exception but Error is a finding.
  void (*read)(std::string_view bytes);
};

/// Readers of files and texts, of map files, of result folders, of recordings, and of the network
/// and the viewer's server.
std::vector<FuzzTarget> file_targets();
std::vector<FuzzTarget> map_targets();
std::vector<FuzzTarget> result_targets();
std::vector<FuzzTarget> recording_targets();
std::vector<FuzzTarget> network_targets();

/// All of them.
std::vector<FuzzTarget> fuzz_targets();

/// A literal with zero bytes.
template <std::size_t n>
std::string raw(const char (&text)[n]) {
  return {text, n - 1};
}

/// A folder for the files of this process, removed at its end.
const std::filesystem::path& fuzz_folder();

/// Writes the bytes to a file of that name in the folder of this process.
std::filesystem::path as_file(std::string_view bytes, const std::string& name);

/// The bytes of the file that `write` makes at a path of that name.
std::string bytes_of(const std::string& name,
                     const std::function<void(const std::filesystem::path&)>& write);

/// A damaged copy of one of the seeds, the same for the same number.
std::string damaged(const std::vector<std::string>& seeds, unsigned number);

}  // namespace mms::testing
