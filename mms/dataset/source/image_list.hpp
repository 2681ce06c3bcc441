#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mms/core/time.hpp"

namespace mms {

/// Names of lists of pairs of color and depth images, for ORB-SLAM and others.
inline constexpr const char* kPairNames[] = {"associations.txt", "association.txt", "associate.txt",
                                             "associated.txt", "assoc.txt"};

/// One line "stamp path" of a TUM image list.
struct ListedImage {
  Timestamp stamp;             ///< as in the list
  std::filesystem::path path;  ///< including the folder of the list
};

/// One line "stamp path stamp path" of an associations file.
struct ListedPair {
  ListedImage color;  ///< its stamp is that of the frame
  ListedImage depth;  ///< nearly simultaneous
};

/// Reads rgb.txt, depth.txt, or a data.csv of EuRoC. Skips invalid lines and duplicate stamps with
/// an entry in `warnings`.
/// @param below  folder of the images, relative to that of the list
/// @throws FileError if the list cannot be read; DataError if no image is left.
std::vector<ListedImage> read_image_list(const std::filesystem::path& list,
                                         std::vector<std::string>& warnings,
                                         const std::filesystem::path& below = {});

/// Whether the stamps of a list are whole numbers, as those of images: "1", but not "1.000".
/// @throws FileError if the list cannot be read.
bool has_whole_stamps(const std::filesystem::path& list);

/// Reads associations.txt, with color or depth first; skips lines as above.
/// @throws FileError, DataError as above.
std::vector<ListedPair> read_associations(const std::filesystem::path& list,
                                          std::vector<std::string>& warnings);

}  // namespace mms
