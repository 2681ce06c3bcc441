#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mms/dataset/source/rgbd_source.hpp"
#include "mms/io/text/text_table.hpp"

namespace mms {

/// Images of one kind, named by their number: prefix, number, ending.
struct ImageSeries {
  std::filesystem::path folder;
  std::string prefix{};
  std::vector<std::string> endings{};  ///< as ".jpg"
};

/// The series of a folder whose images have one number each, between a common beginning and ending,
/// as rgb_0001.png or 0001_color.png.
/// @throws FileError if the folder cannot be read.
ImageSeries find_series(const std::filesystem::path& folder,
                        const std::vector<std::string>& endings);

/// The files of a series by number; other files are ignored.
/// @throws FileError if the folder cannot be read.
std::map<std::int64_t, std::filesystem::path> find_numbered(const ImageSeries& series);

/// Adds a frame for every number that has both images, and facts. Stamps are the numbers
/// (`stamp_of_number`), or else at `rate`.
/// @returns the numbers of the frames
/// @throws FileError if a folder cannot be read; DataError if no number has both, or one is too
/// large.
std::vector<std::int64_t> add_numbered_frames(RgbdRecording& recording, const ImageSeries& color,
                                              const ImageSeries& depth,
                                              const AssumedRate& rate = kDataSetRate);

/// Camera-to-world pose of a line; `where` is for messages.
using PoseOfLine = std::function<Eigen::Isometry3d(const TextLine& line, const std::string& where)>;

/// Adds the ground-truth poses of a file with a line for every number from 0 on, and a fact.
/// @param numbers  parallel to `recording.frames`; those beyond the file have no pose
/// @throws FileError if the file cannot be read; what `pose_of` throws.
void add_pose_lines(RgbdRecording& recording, const std::vector<std::int64_t>& numbers,
                    const std::filesystem::path& file, const PoseOfLine& pose_of);

}  // namespace mms
