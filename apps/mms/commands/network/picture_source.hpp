#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mms/core/image.hpp"
#include "mms/dataset/source/camera_options.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms {

/// One image to be segmented.
struct Picture {
  std::int64_t id = 0;  ///< in COCO files
  std::string name;     ///< file name without folder
  std::string stem;     ///< of output files: the name without extension, unless
                        ///< another image has the same (a.jpg next to a.png)
  Image<Rgb> image;
};

/// A sequence of images from any source.
class PictureSource {
 public:
  virtual ~PictureSource() = default;
  virtual std::optional<Picture> next() = 0;
  virtual std::size_t size() const = 0;
  /// Those of the COCO file; empty for other sources.
  virtual std::vector<CocoCategory> categories() const { return {}; }
};

/// Receives a line about an unreadable image, which is skipped.
using PictureWarning = std::function<void(const std::string&)>;

/// An image file (PNG or JPEG), a folder of them, or a recording (mms run's DATA). Ids count from
/// 1.
/// @param camera  in place of the recording's
/// @throws FileError, DataError if it is none of these.
std::unique_ptr<PictureSource> open_pictures(const std::string& where,
                                             const PictureWarning& warning,
                                             const CameraOptions& camera = {});

/// The images of a COCO file with its ids, optionally of one split. They are in `folder`, or in its
/// subfolder images/.
/// @throws FileError, DataError if the file cannot be read or has no such images.
std::unique_ptr<PictureSource> open_annotated(const std::filesystem::path& annotations,
                                              const std::filesystem::path& folder,
                                              const std::string& split,
                                              const PictureWarning& warning);

}  // namespace mms
