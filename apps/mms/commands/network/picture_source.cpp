#include "apps/mms/commands/network/picture_source.hpp"

#include <map>
#include <set>
#include <vector>

#include "mms/core/error.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/io/image/coco_io.hpp"
#include "mms/io/image/image_io.hpp"
#include "mms/io/image/picture_files.hpp"

namespace mms {
namespace {

namespace fs = std::filesystem;

struct PictureFile {
  std::int64_t id = 0;
  fs::path path;
  std::string stem = path.stem().string();
};

/// Extends equal stems, so that output files do not overwrite each other.
void make_stems_unique(std::vector<PictureFile>& files) {
  std::map<std::string, int> pictures;
  for (const PictureFile& file : files) ++pictures[file.stem];
  std::set<std::string> taken;
  for (const auto& [stem, count] : pictures) taken.insert(stem);
  for (PictureFile& file : files) {
    if (pictures[file.stem] == 1) continue;
    const std::string name = file.path.filename().string();
    file.stem = name;
    for (int i = 2; !taken.insert(file.stem).second; ++i) {
      file.stem = name + "-" + std::to_string(i);
    }
  }
}

class PictureFiles final : public PictureSource {
 public:
  PictureFiles(std::vector<PictureFile> files, PictureWarning warning,
               std::vector<CocoCategory> categories = {})
      : files_(std::move(files)), warning_(std::move(warning)), categories_(std::move(categories)) {
    make_stems_unique(files_);
  }

  std::optional<Picture> next() override {
    while (position_ < files_.size()) {
      const PictureFile& file = files_[position_++];
      try {
        return Picture{file.id, file.path.filename().string(), file.stem, read_color(file.path)};
      } catch (const Error& error) {
        warning_(error.what());
      }
    }
    return std::nullopt;
  }
  std::size_t size() const override { return files_.size(); }
  std::vector<CocoCategory> categories() const override { return categories_; }

 private:
  std::vector<PictureFile> files_;
  PictureWarning warning_;
  std::vector<CocoCategory> categories_;
  std::size_t position_ = 0;
};

class RecordedPictures final : public PictureSource {
 public:
  RecordedPictures(const std::string& where, const PictureWarning& warning,
                   const CameraOptions& camera)
      : source_(open_dataset(
            where, {.masks = {}, .load_masks = false, .map_truth = false, .camera = camera})),
        warning_(warning) {
    source_->on_warning(warning);
  }

  std::optional<Picture> next() override {
    std::optional<Frame> frame = source_->next();
    for (; frame && frame->color.empty(); frame = source_->next()) ++without_color_;
    if (!frame && without_color_ > 0) {
      warning_(std::to_string(without_color_) + " frames have no color image");
      without_color_ = 0;
    }
    if (!frame) return std::nullopt;
    fs::path name = frame->name;  // possibly a stamp: keeps the part after its dot
    if (!is_picture(name)) name += ".png";
    return Picture{frame->index + 1, name.string(), name.stem().string(), std::move(frame->color)};
  }
  std::size_t size() const override { return source_->size(); }

 private:
  std::unique_ptr<FrameSource> source_;
  PictureWarning warning_;
  std::size_t without_color_ = 0;
};

std::vector<PictureFile> pictures_of(const fs::path& folder) {
  std::vector<PictureFile> files;
  for (const fs::path& path : list_pictures(folder)) {
    files.push_back({static_cast<std::int64_t>(files.size()) + 1, path});
  }
  return files;
}

}  // namespace

std::unique_ptr<PictureSource> open_pictures(const std::string& where,
                                             const PictureWarning& warning,
                                             const CameraOptions& camera) {
  if (fs::is_regular_file(where) && is_picture(where)) {
    return std::make_unique<PictureFiles>(std::vector<PictureFile>{{1, where}}, warning);
  }
  try {  // recordings first: some have their depth images in the same folder
    return std::make_unique<RecordedPictures>(where, warning, camera);
  } catch (const DataError&) {
    std::vector<PictureFile> files;
    if (fs::is_directory(where)) files = pictures_of(where);
    if (files.empty()) throw;
    return std::make_unique<PictureFiles>(std::move(files), warning);
  }
}

std::unique_ptr<PictureSource> open_annotated(const fs::path& annotations, const fs::path& folder,
                                              const std::string& split,
                                              const PictureWarning& warning) {
  std::vector<PictureFile> files;
  CocoDataset dataset = read_coco(annotations);
  for (const CocoImage& image : dataset.images) {
    if (!split.empty() && image.split != split) continue;
    files.push_back({image.id, picture_path(folder, image.file_name)});
  }
  if (files.empty()) {
    throw DataError(annotations.string(),
                    split.empty() ? "has no images" : "has no images in the split '" + split + "'");
  }
  return std::make_unique<PictureFiles>(std::move(files), warning, std::move(dataset.categories));
}

}  // namespace mms
