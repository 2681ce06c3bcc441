// Localizes with masks from a segmentation plug-in, and prints how much of each frame is dynamic:
//   own_masks [RECORDING]
// The plug-in here is for a fixed depth camera; a network of your own takes its place.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "mms/dataset/open_dataset.hpp"
#include "mms/pipeline/slam_system.hpp"

namespace {

/// Masks what is in front of the background: the largest depth that each pixel had so far.
class BackgroundSegmenter : public mms::Segmenter {
 public:
  mms::Segmentation segment(const mms::Frame& frame) override {
    const mms::Image<float>& depth = frame.depth;
    if (!background_.same_size(depth)) background_ = depth;

    mms::Instance person;  // at (0, 0): its mask has the size of the image
    person.object_class = mms::ObjectClass::kPerson;
    person.score = 0.9F;
    person.mask = mms::Image<std::uint8_t>(depth.width(), depth.height());
    for (std::size_t i = 0; i < depth.size(); ++i) {
      person.mask[i] = depth[i] > 0.0F && depth[i] < background_[i] - kDistance;
      background_[i] = std::max(background_[i], depth[i]);
    }

    mms::Segmentation segmentation{depth.width(), depth.height(), {}};
    segmentation.instances.push_back(std::move(person));  // a network adds one for each object
    return segmentation;
  }

 private:
  static constexpr float kDistance = 0.3F;  ///< of a person from the background [m]
  mms::Image<float> background_;            ///< [m]
};

void localize(const std::string& recording) {
  const std::unique_ptr<mms::FrameSource> source = mms::open_dataset(recording);
  mms::SlamSystem system({}, std::make_unique<BackgroundSegmenter>());
  while (const std::optional<mms::Frame> frame = source->next()) {
    const mms::FrameResult result = system.process(*frame);
    std::printf("%s s  dynamic %4.1f %%  objects %zu\n", frame->stamp.to_string().c_str(),
                100.0 * result.dynamic_share, result.objects.size());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    localize(argc > 1 ? argv[1] : "sim:still_walker?frames=12");
  } catch (const std::exception& error) {  // mms::Error says where, what and what to do about it
    std::fprintf(stderr, "own_masks: %s\n", error.what());
    return 1;
  }
  return 0;
}
