#include "apps/mms/commands/convert_recording.hpp"

#include <fmt/core.h>

#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/overwrite_option.hpp"
#include "apps/mms/console/rate_progress.hpp"
#include "mms/core/error.hpp"
#include "mms/dataset/camera/oni_source.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/dataset/recorder/frame_recorder.hpp"
#include "mms/dataset/simulated/simulated_source.hpp"
#include "mms/io/capture/packet_capture.hpp"
#include "mms/io/journal/journal.hpp"
#include "mms/io/text/files.hpp"
#include "mms/ros/bag/bag_files.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

/// x.bag, x.mcap or x.db3 becomes the folder x.
fs::path other_recording(const RecordingConversion& conversion) {
  if (!conversion.output.empty()) return conversion.output;
  if (is_bag_name(conversion.input)) return bag_stem(conversion.input);
  if (is_capture_name(conversion.input)) return fs::path(conversion.input).replace_extension();
  throw DataError(conversion.input, "has no default output name", "use -o x.bag or x.mcap");
}

/// Without trailing slash.
fs::path plain_path(const fs::path& output) {
  const fs::path path = output.lexically_normal();
  if (!path.has_filename()) return path.parent_path();
  return path.filename() == "." || path.filename() == ".."
             ? fs::absolute(path).lexically_normal().parent_path()
             : path;
}

/// "x.partial.bag", "x.partial.mcap", "x.partial" of a folder, or "x.partial2" if that exists.
fs::path partial_name(const fs::path& output) {
  for (int i = 1;; ++i) {
    const std::string mark = ".partial" + (i == 1 ? "" : std::to_string(i));
    fs::path partial = plain_path(output);
    if (is_bag_name(output)) {
      partial.replace_extension(mark + output.extension().string());
    } else {
      partial += mark;
    }
    if (!fs::exists(partial)) return partial;
  }
}

/// @throws FileError if the output exists, and is not a file to overwrite or an empty folder.
void refuse_existing(const fs::path& output, bool overwrite) {
  refuse_existing_file(output, overwrite);
  const bool bag = is_bag_name(output);
  if (!fs::exists(output) || (bag && fs::is_regular_file(output))) return;
  if (bag || !fs::is_directory(output)) {
    throw FileError(output.string(), bag ? "is not a regular file" : "is a file",
                    "choose another name with -o");
  }
  const auto names = list_folder(output);
  if (names.empty()) return;
  throw FileError(output.string(), "is not empty (it has " + names.front() + ")",
                  "choose a new folder with -o");
}

std::unique_ptr<FrameRecorder> open_recorder(const fs::path& output, bool compressed) {
  return is_bag_name(output) ? record_bag(output, compressed) : record_folder(output);
}

}  // namespace

bool is_recording_conversion(const std::string& input, const fs::path& output) {
  if (is_bag_name(input) || is_bag_name(output)) return true;
  if (is_capture_name(input) || is_oni_name(input) || is_simulated(input)) return true;
  if (!fs::is_directory(input) || fs::exists(fs::path(input) / kJournalName)) return false;
  return is_bag_folder(list_folder(input));
}

void convert_recording(const RecordingConversion& conversion) {
  const fs::path output = other_recording(conversion);
  const auto source = open_dataset(conversion.input, {.map_truth = false,
                                                      .topics = conversion.topics,
                                                      .camera = conversion.camera,
                                                      .rate = conversion.rate});
  refuse_existing(output, conversion.overwrite);
  const fs::path partial = partial_name(output);
  const InterruptGuard interrupt;
  auto recorder = open_recorder(partial, conversion.compressed);
  RateProgress progress("frame");
  source->on_warning([&](const std::string& message) { progress.warn(message); });
  int done = 0;
  while (const std::optional<Frame> frame = source->next()) {
    recorder->add(*frame);
    progress.show(++done, static_cast<int>(source->size()));
    if (InterruptGuard::requested()) break;  // a partial recording has a frame
  }
  progress.finish();
  if (done == 0) {
    recorder.reset();
    std::error_code ignored;
    fs::remove(partial, ignored);  // an empty folder
    throw DataError(conversion.input, "none of its frames could be read");
  }
  recorder->finish(source->ground_truth());
  if (InterruptGuard::requested()) {
    throw Interrupted(
        fmt::format("{} of {} frames are in {}", done, source->size(), partial.string()));
  }
  std::error_code error;
  fs::rename(partial, plain_path(output), error);
  if (error) {
    throw FileError(output.string(), "cannot be written: " + error.message(),
                    "the recording is in " + partial.string());
  }
  fmt::print("{}: {} frames, {} ground-truth poses\nplay it: mms run {}\n", output.string(), done,
             source->ground_truth().size(), output.string());
}

}  // namespace mms
