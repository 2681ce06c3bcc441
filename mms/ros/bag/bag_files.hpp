#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "mms/ros/storage/bag_storage.hpp"
#include "mms/ros/storage/bag_writer.hpp"

namespace mms {

/// Whether a file name is that of a recording of ROS: "x.bag", "x.bag.active" of one that was not
/// closed, "x.mcap", "x.db3", and the latter two with ".zstd".
bool is_bag_name(const std::filesystem::path& path);

/// Whether these files of a folder are a recording of rosbag2.
bool is_bag_folder(const std::vector<std::string>& names);

/// Without the endings of `is_bag_name`: "x" of "x.db3.zstd".
std::filesystem::path bag_stem(const std::filesystem::path& path);

/// The files of a recording in the order of time: the file itself, or those that metadata.yaml of a
/// folder lists, or all of the folder by their numbers ("x_9.mcap" before "x_10.mcap").
/// @param warnings  receives the listed files that are missing
/// @throws DataError if the folder has several recordings or none.
std::vector<std::filesystem::path> bag_files(const std::filesystem::path& path,
                                             std::vector<std::string>& warnings);

/// Opens one file of a recording by its name. A .zstd file is decompressed into the folder of
/// temporary files (TMPDIR) until it is closed.
/// @throws FileError, DataError if it cannot be opened.
std::unique_ptr<BagStorage> open_bag_file(const std::filesystem::path& path);

/// Creates a recording that has the format of its name: "x.bag" or "x.mcap".
/// @throws FileError if it cannot be created; DataError for other names.
std::unique_ptr<BagWriter> create_bag(const std::filesystem::path& path);

}  // namespace mms
