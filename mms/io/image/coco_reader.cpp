#include "mms/io/image/coco_io.hpp"

#include <map>
#include <set>

#include "mms/core/error.hpp"
#include "mms/io/config/json_entry.hpp"
#include "mms/io/image/polygon_mask.hpp"
#include "mms/io/text/numbers.hpp"

namespace mms {
namespace {

constexpr Range kSize = {1, 65535};  // of an image [px]
constexpr Range kCategory = {0, 1e6};
constexpr Range kCount = {0, 4294967295.0};
constexpr Range kNotNegative = {0.0};
constexpr double kBoxTolerance = 1.0;  // [px]: rounding of boxes given as shares of the image

template <class Action>
auto naming(const JsonEntry& entry, const Action& action) {
  try {
    return action();
  } catch (const DataError& error) {
    entry.fail(error.what());
  }
}

std::vector<double> numbers(const JsonEntry& list) {
  std::vector<double> values;
  for (const JsonEntry& element : list.elements()) values.push_back(element.number());
  return values;
}

std::pair<int, int> size_of(const JsonEntry& rle) {
  const std::vector<JsonEntry> size = rle.at("size").elements();
  if (size.size() != 2) rle.at("size").fail("is not a list of height and width");
  return {static_cast<int>(size[1].integer(kSize)), static_cast<int>(size[0].integer(kSize))};
}

Rle read_runs(const JsonEntry& entry) {
  const auto [width, height] = size_of(entry);
  const JsonEntry counts = entry.at("counts");
  if (counts.is_text()) {
    const std::string text = counts.text();
    return naming(counts, [&, w = width, h = height] { return rle_from_string(text, w, h); });
  }
  Rle rle{width, height, {}};
  for (const JsonEntry& count : counts.elements()) {
    rle.counts.push_back(static_cast<std::uint32_t>(count.integer(kCount)));
  }
  naming(counts, [&] { check_rle(rle); });
  return rle;
}

Rle read_segmentation(const JsonEntry& entry, const CocoImage& image) {
  if (entry.is_list()) {
    std::vector<Polygon> polygons;
    for (const JsonEntry& polygon : entry.elements()) polygons.push_back(numbers(polygon));
    return naming(entry, [&] { return rasterise(polygons, image.width, image.height); });
  }
  Rle rle = read_runs(entry);
  if (rle.width != image.width || rle.height != image.height) {
    entry.fail("has " + std::to_string(rle.width) + " x " + std::to_string(rle.height) +
               " px, its image " + std::to_string(image.id) + " has " +
               std::to_string(image.width) + " x " + std::to_string(image.height));
  }
  return rle;
}

Rle box_mask(const std::array<double, 4>& box, int width, int height) {
  const auto [x, y, w, h] = box;
  const std::vector<Polygon> outline = {{x, y, x + w, y, x + w, y + h, x, y + h}};
  return rasterise(outline, width, height);
}

std::string text_of(const std::array<double, 4>& box) {
  std::string text;
  for (const double value : box) text += (text.empty() ? "" : ", ") + format_number(value);
  return "[" + text + "]";
}

/// Reads the three lists and indexes the ids for references between them.
class CocoReader {
 public:
  explicit CocoReader(const JsonEntry& root) : root_(root) {}

  CocoDataset read() {
    for (const JsonEntry& entry : root_.at("images").elements()) read_image(entry);
    for (const JsonEntry& entry : root_.at("categories").elements()) read_category(entry);
    for (const JsonEntry& entry : root_.at("annotations").elements()) read_annotation(entry);
    return std::move(dataset_);
  }

  CocoDataset read(CocoFaults& faults) {
    std::set<std::int64_t> lost;
    for (const JsonEntry& entry : root_.at("categories").elements()) read_category(entry);
    for (const JsonEntry& entry : root_.at("images").elements()) {
      read_or_note([&] { read_image(entry); }, faults.images,
                   [&] { lost.insert(id_of(entry, "id")); });
    }
    for (const JsonEntry& entry : root_.at("annotations").elements()) {
      const std::int64_t image = id_of(entry, "image_id");
      if (lost.contains(image) && !images_.contains(image)) continue;
      read_or_note(
          [&] {
            read_annotation(entry);
            check_box(entry);
          },
          faults.annotations, [&] { mark_incomplete(image); });
    }
    return std::move(dataset_);
  }

 private:
  template <class Read, class Handle>
  static void read_or_note(const Read& read, std::vector<std::string>& messages,
                           const Handle& handle) {
    try {
      read();
    } catch (const DataError& error) {
      messages.emplace_back(error.what());
      handle();
    }
  }

  /// -1 if there is none.
  static std::int64_t id_of(const JsonEntry& entry, const std::string& key) {
    try {
      return entry.at(key).integer();
    } catch (const DataError&) {
      return -1;
    }
  }

  void mark_incomplete(std::int64_t id) {
    const auto found = images_.find(id);
    if (found == images_.end()) return;
    std::vector<std::string>& partial = dataset_.images[found->second].partial;
    partial.clear();
    for (const CocoCategory& category : dataset_.categories) partial.push_back(category.name);
  }

  /// Removes the last annotation if its box is outside of the image or empty.
  void check_box(const JsonEntry& entry) {
    const CocoAnnotation annotation = dataset_.annotations.back();
    const CocoImage& image = dataset_.images[images_.at(annotation.image_id)];
    const auto [x, y, width, height] = annotation.bbox;
    const bool outside = x < -kBoxTolerance || y < -kBoxTolerance ||
                         x + width > image.width + kBoxTolerance ||
                         y + height > image.height + kBoxTolerance;
    const bool empty = width <= 0.0 || height <= 0.0 || rle_area(annotation.segmentation) == 0;
    if (!outside && !empty) return;
    dataset_.annotations.pop_back();
    if (empty) entry.fail("has no area");
    entry.at("bbox").fail("is " + text_of(annotation.bbox) + ", outside of its image " +
                          image.file_name + " of " + std::to_string(image.width) + " x " +
                          std::to_string(image.height) + " px");
  }

  void read_image(const JsonEntry& entry) {
    CocoImage image;
    image.id = entry.at("id").integer();
    image.file_name = entry.at("file_name").text();
    image.width = static_cast<int>(entry.at("width").integer(kSize));
    image.height = static_cast<int>(entry.at("height").integer(kSize));
    if (entry.has("split")) image.split = entry.at("split").text();
    if (entry.has("partial")) {
      for (const JsonEntry& name : entry.at("partial").elements()) {
        image.partial.push_back(name.text());
      }
    }
    if (!images_.emplace(image.id, dataset_.images.size()).second) fail_twice(entry, image.id);
    dataset_.images.push_back(std::move(image));
  }

  void read_category(const JsonEntry& entry) {
    const auto id = static_cast<int>(entry.at("id").integer(kCategory));
    if (!categories_.insert(id).second) fail_twice(entry, id);
    dataset_.categories.push_back({id, entry.at("name").text()});
  }

  void read_annotation(const JsonEntry& entry) {
    CocoAnnotation annotation;
    annotation.id = entry.at("id").integer();
    if (!annotations_.insert(annotation.id).second) fail_twice(entry, annotation.id);
    annotation.image_id = entry.at("image_id").integer();
    const auto image = images_.find(annotation.image_id);
    if (image == images_.end()) {
      entry.at("image_id").fail("is " + std::to_string(annotation.image_id) + ", no such image");
    }
    annotation.category_id = static_cast<int>(entry.at("category_id").integer(kCategory));
    if (!categories_.contains(annotation.category_id)) {
      entry.at("category_id")
          .fail("is " + std::to_string(annotation.category_id) + ", no such category");
    }
    read_box(entry.at("bbox"), annotation);
    annotation.box_only = entry.has("box_only") && entry.at("box_only").boolean();
    const CocoImage& where = dataset_.images[image->second];
    annotation.segmentation = annotation.box_only
                                  ? box_mask(annotation.bbox, where.width, where.height)
                                  : read_segmentation(entry.at("segmentation"), where);
    annotation.area = entry.at("area").number(kNotNegative);
    annotation.iscrowd = entry.has("iscrowd") && entry.at("iscrowd").integer({0, 1}) == 1;
    dataset_.annotations.push_back(std::move(annotation));
  }

  static void read_box(const JsonEntry& entry, CocoAnnotation& annotation) {
    const std::vector<double> box = numbers(entry);
    if (box.size() != 4 || box[2] < 0.0 || box[3] < 0.0) {
      entry.fail("is not a box", "expected x, y, width and height in pixels");
    }
    std::copy(box.begin(), box.end(), annotation.bbox.begin());
  }

  [[noreturn]] static void fail_twice(const JsonEntry& entry, std::int64_t id) {
    entry.at("id").fail("is " + std::to_string(id) + ", a duplicate");
  }

  const JsonEntry& root_;
  CocoDataset dataset_;
  std::map<std::int64_t, std::size_t> images_;
  std::set<std::int64_t> annotations_;
  std::set<int> categories_;
};

JsonEntry dataset_root(const nlohmann::json& json, const std::filesystem::path& path) {
  JsonEntry root(json, path.string());
  if (root.is_list()) {
    root.fail("is a list, as of results",
              "expected an object with images, annotations and categories");
  }
  return root;
}

}  // namespace

CocoDataset read_coco(const std::filesystem::path& path) {
  const nlohmann::json json = parse_json(path);
  const JsonEntry root = dataset_root(json, path);
  return CocoReader(root).read();
}

CocoDataset read_coco(const std::filesystem::path& path, CocoFaults& faults) {
  const nlohmann::json json = parse_json(path);
  const JsonEntry root = dataset_root(json, path);
  return CocoReader(root).read(faults);
}

std::vector<CocoResult> read_coco_results(const std::filesystem::path& path) {
  const nlohmann::json json = parse_json(path);
  const JsonEntry root(json, path.string());
  if (!root.is_list()) {
    root.fail("is not a list of results", "an object with images and annotations is not a result");
  }
  std::vector<CocoResult> results;
  for (const JsonEntry& entry : root.elements()) {
    CocoResult result;
    result.image_id = entry.at("image_id").integer();
    result.category_id = static_cast<int>(entry.at("category_id").integer(kCategory));
    result.score = entry.at("score").number({0.0, 1.0});
    result.segmentation = read_runs(entry.at("segmentation"));
    results.push_back(std::move(result));
  }
  return results;
}

}  // namespace mms
