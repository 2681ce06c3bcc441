// libFuzzer on one of the targets of tests/fuzz, for benchmarks/fuzz.sh.
//   MMS_FUZZ_TARGET=NAME mms_fuzz [OPTION OF LIBFUZZER...] CORPUS...
//   mms_fuzz --list            prints the names of the targets
//   mms_fuzz --seeds FOLDER    writes the seeds of each target to FOLDER/NAME

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "mms/core/error.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "tests/fuzz/fuzz_target.hpp"

namespace {

using mms::testing::FuzzTarget;

FuzzTarget target;  // NOLINT: libFuzzer calls a function without context

void list_targets() {
  for (const FuzzTarget& known : mms::testing::fuzz_targets()) std::puts(known.name.c_str());
}

void write_seeds(const std::filesystem::path& folder) {
  for (const FuzzTarget& known : mms::testing::fuzz_targets()) {
    std::filesystem::create_directories(folder / known.name);
    int number = 0;
    for (const std::string& seed : known.seeds()) {
      mms::write_file(folder / known.name / ("seed" + std::to_string(number++)), seed);
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  const std::string word = *argc > 1 ? (*argv)[1] : "";
  if (word == "--list") list_targets();
  if (word == "--seeds" && *argc > 2) write_seeds((*argv)[2]);
  if (word == "--list" || word == "--seeds") std::exit(0);
  const char* name = std::getenv("MMS_FUZZ_TARGET");
  for (const FuzzTarget& known : mms::testing::fuzz_targets()) {
    if (name != nullptr && known.name == name) target = known;
  }
  if (target.read != nullptr) return 0;
  std::fputs("MMS_FUZZ_TARGET is none of these:\n", stderr);
  list_targets();
  std::exit(2);
}

/// Any exception but mms::Error ends the program, which libFuzzer reports with the input.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    target.read({reinterpret_cast<const char*>(data), size});
  } catch (const mms::Error&) {  // refused with a message
  }
  return 0;
}
