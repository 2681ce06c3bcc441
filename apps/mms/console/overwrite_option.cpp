#include "apps/mms/console/overwrite_option.hpp"

#include "mms/core/error.hpp"

namespace mms {

void add_overwrite_flag(CLI::App& command, bool& overwrite) {
  command.add_flag("--overwrite", overwrite, "replace an existing output");
}

void refuse_existing_file(const std::filesystem::path& file, bool overwrite) {
  if (overwrite || !std::filesystem::is_regular_file(file)) return;
  throw FileError(file.string(), "exists already", "replace it with --overwrite");
}

}  // namespace mms
