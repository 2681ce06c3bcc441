#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "mms/core/image.hpp"

namespace mms {

/// One picture to be segmented.
struct Picture {
  std::int64_t id = 0;  ///< in COCO files
  std::string name;     ///< of its file, without folders
  std::string stem;     ///< of the files about it: the name without extension, which stays where
                        ///< another picture has the same (a.jpg beside a.png)
  Image<Rgb> image;
};

/// Pictures one after the other, however they are kept.
class PictureSource {
 public:
  virtual ~PictureSource() = default;
  virtual std::optional<Picture> next() = 0;
  virtual std::size_t size() const = 0;
};

/// Receives a line about a picture that cannot be read and is passed over.
using PictureWarning = std::function<void(const std::string&)>;

/// A PNG or JPEG file, a folder of them, or a recording (mms run's DATA). Ids count from 1.
/// @throws FileError, DataError when it is none of these.
std::unique_ptr<PictureSource> open_pictures(const std::string& where,
                                             const PictureWarning& warning);

/// The images of a COCO file with its ids; only those of a split when one is given. They are in
/// `folder`, or in images/ below it.
/// @throws FileError, DataError when the file cannot be read, or has no such images.
std::unique_ptr<PictureSource> open_annotated(const std::filesystem::path& annotations,
                                              const std::filesystem::path& folder,
                                              const std::string& split,
                                              const PictureWarning& warning);

}  // namespace mms
