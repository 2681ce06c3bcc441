#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace mms {

/// One run of a batch: a recording with options of `mms run`.
struct BatchRun {
  std::string name;                ///< of its result folder; made of the words if none is given
  std::vector<std::string> words;  ///< DATA and options
};

/// Reads the runs of a list, one a line: [NAME =] DATA [OPTIONS of mms run]. Words are separated by
/// spaces and may be in quotes; `#` begins a comment.
/// @throws FileError if it cannot be read; DataError with the line for an open quote, a name that
/// is there twice, and options that the batch sets itself, or if there are no runs
std::vector<BatchRun> read_batch_list(const std::filesystem::path& list);

/// A part of a list: every `count`-th run, from the `index`-th on.
struct Shard {
  std::size_t index = 0;  ///< in [0, count)
  std::size_t count = 1;
};

/// @param text  "i/n", i from 1 to n
/// @throws DataError otherwise
Shard parse_shard(const std::string& text);

}  // namespace mms
