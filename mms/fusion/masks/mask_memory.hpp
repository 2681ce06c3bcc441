#pragma once

#include <cstdint>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/core/labeled_cloud.hpp"
#include "mms/core/segmentation.hpp"
#include "mms/fusion/clouds/mask_image.hpp"
#include "mms/fusion/clusters/dynamic_objects.hpp"
#include "mms/fusion/config/fusion_config.hpp"

namespace mms {

/// Keeps dynamic objects over frames in which their masks are missing (beyond the paper, whose
/// clusters need a mask in every frame). Pixels that were dynamic in the last frame and have the
/// same depth serve as a mask; the clusters then complete it, so that it follows a moving object.
/// Where the network was asked, an object is kept for as long as it was followed before, and one
/// more frame.
class MaskMemory {
 public:
  explicit MaskMemory(const FusionConfig& config) : config_(config) {}

  /// Adds the remembered objects that no mask covers now to `mask` and `instances`, with score 0
  /// for lack of a detection in this frame.
  /// @param is_segmented  whether masks of the frame were computed
  void recall(const LabeledCloud& cloud, MaskImage& mask, std::vector<Instance>& instances,
              bool is_segmented);

  /// Stores the objects found with the instances of `recall`, and says of the cloud's clusters how
  /// long they were followed.
  void remember(LabeledCloud& cloud, const std::vector<DynamicObjects::Object>& objects);

 private:
  struct Object {
    ObjectClass object_class = ObjectClass::kPerson;
    Timestamp masked;  ///< when it last had a mask
    Timestamp since;   ///< when it was found first
  };

  /// The pixels that still show a remembered object.
  struct Present {
    int pixels = 0;
    std::vector<int> under;  ///< how many are under each mask
  };

  bool is_still_there(const LabeledCloud& cloud, std::size_t pixel) const;
  std::vector<Present> find_present(const LabeledCloud& cloud, const MaskImage& mask,
                                    std::size_t masks) const;
  bool is_missing(const Object& object, const Present& present, Timestamp now,
                  Duration interval) const;

  FusionConfig config_;
  Timestamp last_segmented_;  ///< of the last frame with masks, of which some may be missing
  std::vector<Object> objects_;
  std::vector<std::int16_t> object_of_;  ///< of every pixel, -1 for none
  std::vector<float> depth_;             ///< of every pixel [m]
  std::vector<Object> instances_;        ///< those of the frame
};

}  // namespace mms
