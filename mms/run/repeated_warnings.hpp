#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <vector>

namespace mms {

/// Limits warnings that repeat: of each kind, the first three are shown, the others counted. Two
/// warnings are of one kind if they differ only in words with digits, such as stamps and file
/// names. May be used by several threads.
class RepeatedWarnings {
 public:
  /// Counts a warning.
  /// @returns whether to show it
  bool add(const std::string& message);

  /// A line for each kind that was not shown in full, with the number of the others.
  std::vector<std::string> rest() const;

 private:
  struct Kind {
    std::string first;
    std::size_t count = 0;
  };

  mutable std::mutex mutex_;
  std::map<std::string, Kind> kinds_;
};

}  // namespace mms
