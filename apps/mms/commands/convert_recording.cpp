#include "apps/mms/commands/convert_recording.hpp"

#include <fmt/core.h>

#include "apps/mms/console/interrupt.hpp"
#include "apps/mms/console/overwrite_option.hpp"
#include "apps/mms/console/rate_progress.hpp"
#include "mms/core/error.hpp"
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

/// "x.partial.bag", "x.partial.mcap", "x.partial" of a folder.
fs::path partial_name(const fs::path& output) {
  fs::path partial = output;
  const std::string ending = output.extension().string();
  if (is_bag_name(output)) return partial.replace_extension(".partial" + ending);
  return partial += ".partial";
}

std::unique_ptr<FrameRecorder> open_recorder(const fs::path& output, bool compressed) {
  return is_bag_name(output) ? record_bag(output, compressed) : record_folder(output);
}

}  // namespace

bool is_recording_conversion(const std::string& input, const fs::path& output) {
  if (is_bag_name(input) || is_bag_name(output)) return true;
  if (is_capture_name(input) || is_simulated(input)) return true;
  if (!fs::is_directory(input) || fs::exists(fs::path(input) / kJournalName)) return false;
  return is_bag_folder(list_folder(input));
}

void convert_recording(const RecordingConversion& conversion) {
  const fs::path output = other_recording(conversion);
  const auto source =
      open_dataset(conversion.input,
                   {.map_truth = false, .topics = conversion.topics, .camera = conversion.camera});
  refuse_existing_file(output, conversion.overwrite);
  const auto recorder = open_recorder(output, conversion.compressed);
  RateProgress progress("frame");
  source->on_warning([&](const std::string& message) { progress.warn(message); });
  const InterruptGuard interrupt;
  int done = 0;
  while (!InterruptGuard::requested()) {
    const std::optional<Frame> frame = source->next();
    if (!frame) break;
    recorder->add(*frame);
    progress.show(++done, static_cast<int>(source->size()));
  }
  progress.finish();
  if (done == 0) throw DataError(conversion.input, "none of its frames could be read");
  recorder->finish(source->ground_truth());
  if (InterruptGuard::requested()) {
    const fs::path partial = partial_name(output);
    fs::rename(output, partial);
    throw Interrupted(
        fmt::format("{} of {} frames are in {}", done, source->size(), partial.string()));
  }
  fmt::print("{}: {} frames, {} ground-truth poses\nplay it: mms run {}\n", output.string(), done,
             source->ground_truth().size(), output.string());
}

}  // namespace mms
