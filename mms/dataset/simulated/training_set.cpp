#include "mms/dataset/simulated/training_set.hpp"

#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

#include "mms/core/error.hpp"
#include "mms/dataset/recorder/recording_folder.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/text/atomic_file.hpp"
#include "mms/io/text/files.hpp"
#include "mms/io/text/output_folder.hpp"
#include "mms/simulation/training_view.hpp"

namespace mms {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view kSetFile = "training_set.json";

std::string name_of(int index) {
  char text[16];
  std::snprintf(text, sizeof text, "%06d", index);
  return text;
}

void check_seed(const fs::path& file, std::uint64_t seed) {
  const auto set = nlohmann::json::parse(read_file(file), nullptr, false);
  const bool known = set.is_object() && set.contains("seed") && set["seed"].is_number_unsigned();
  if (known && set["seed"].get<std::uint64_t>() == seed) return;
  throw DataError(
      file.string(),
      "has seed " + (known ? set["seed"].dump() : "unknown") + ", not " + std::to_string(seed),
      "use the same --seed to continue it, or another folder with -o");
}

/// Creates the folder, or checks that the existing one can be continued.
void prepare(const fs::path& folder, std::uint64_t seed) {
  const std::vector<std::string> names = list_folder(folder);
  if (fs::exists(folder / kSetFile)) {
    check_seed(folder / kSetFile, seed);
  } else if (!names.empty()) {
    throw FileError(folder.string(),
                    "is not empty (it has " + names.front() + ") and not a training set",
                    "choose a new folder with -o, or empty this one");
  } else {
    write_file(folder / kSetFile, nlohmann::json{{"seed", seed}}.dump() + "\n");
  }
  make_folder(folder / "images");
  make_folder(folder / "parts");
}

class TrainingSet {
 public:
  TrainingSet(fs::path folder, const TrainingSetOptions& options)
      : folder_(std::move(folder)), options_(options), views_(options.seed) {}

  /// The annotations of an image are written after it, so they mark a finished image.
  bool has(int index) const {
    return fs::exists(part(index)) && fs::exists(folder_ / image(index));
  }

  void add(int index) {
    const SimulatedFrame frame = views_.render(index);
    CocoDataset dataset = empty_annotations();
    annotate(dataset, frame, index + 1, image(index), options_.limits);
    write_file(folder_ / image(index), encode_jpeg(frame.frame.color, options_.jpeg_quality));
    write_coco(part(index), dataset);
  }

  /// The annotations of all images up to `end`, renumbered.
  CocoDataset collect(int end) const {
    CocoDataset whole = empty_annotations();
    for (int i = 0; i < end; ++i) {
      CocoDataset one = read_coco(part(i));
      whole.images.insert(whole.images.end(), one.images.begin(), one.images.end());
      for (CocoAnnotation& annotation : one.annotations) {
        annotation.id = static_cast<std::int64_t>(whole.annotations.size()) + 1;
        whole.annotations.push_back(std::move(annotation));
      }
    }
    return whole;
  }

 private:
  static std::string image(int index) { return "images/" + name_of(index) + ".jpg"; }
  fs::path part(int index) const { return folder_ / "parts" / (name_of(index) + ".json"); }

  fs::path folder_;
  const TrainingSetOptions& options_;
  TrainingViews views_;
};

}  // namespace

WrittenTrainingSet write_training_set(const fs::path& folder, const TrainingSetOptions& options) {
  const FolderLock lock(folder);
  prepare(folder, options.seed);
  TrainingSet set(folder, options);
  WrittenTrainingSet written;
  bool go_on = true;
  while (go_on && written.images < options.images) {
    const int index = written.images++;
    if (set.has(index)) continue;
    set.add(index);
    ++written.fresh;
    go_on = !options.progress || options.progress(written.images, written.fresh);
  }
  const CocoDataset whole = set.collect(written.images);
  write_coco(folder / "annotations.json", whole);
  written.annotations = whole.annotations.size();
  for (const CocoAnnotation& annotation : whole.annotations) written.crowd += annotation.iscrowd;
  return written;
}

}  // namespace mms
