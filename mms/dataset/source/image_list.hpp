#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mms/core/time.hpp"

namespace mms {

/// One line "stamp path" of a TUM image list.
struct ListedImage {
  Timestamp stamp;             ///< as written in the list
  std::filesystem::path path;  ///< with the list's folder before it
};

/// One line "stamp path stamp path" of an associations file.
struct ListedPair {
  ListedImage color;  ///< its stamp becomes that of the frame
  ListedImage depth;  ///< taken at nearly the same time
};

/// Reads rgb.txt or depth.txt. Lines that cannot be read and images with a stamp that was there
/// before are left out, and said so in `warnings`.
/// @throws FileError when the list cannot be read, DataError when nothing is left.
std::vector<ListedImage> read_image_list(const std::filesystem::path& list,
                                         std::vector<std::string>& warnings);

/// Reads associations.txt, colour first or depth first, with the same leniency.
/// @throws FileError, DataError as above.
std::vector<ListedPair> read_associations(const std::filesystem::path& list,
                                          std::vector<std::string>& warnings);

}  // namespace mms
