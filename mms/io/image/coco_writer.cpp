#include "mms/io/config/json_entry.hpp"
#include "mms/io/image/coco_io.hpp"

namespace mms {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Rle& rle) {
  return {{"size", {rle.height, rle.width}}, {"counts", rle_to_string(rle)}};
}

Json json_of(const CocoImage& image) {
  Json json = {{"id", image.id},
               {"file_name", image.file_name},
               {"width", image.width},
               {"height", image.height}};
  if (!image.split.empty()) json["split"] = image.split;
  return json;
}

Json json_of(const CocoCategory& category) {
  return {{"id", category.id}, {"name", category.name}};
}

Json json_of(const CocoAnnotation& annotation) {
  return {{"id", annotation.id},
          {"image_id", annotation.image_id},
          {"category_id", annotation.category_id},
          {"bbox", annotation.bbox},
          {"area", annotation.area},
          {"iscrowd", annotation.iscrowd ? 1 : 0},
          {"segmentation", json_of(annotation.segmentation)}};
}

Json json_of(const CocoResult& result) {
  return {{"image_id", result.image_id},
          {"category_id", result.category_id},
          {"score", result.score},
          {"segmentation", json_of(result.segmentation)}};
}

/// A list with one entry per line, for readable and compact files.
template <class Entry>
std::string list_text(const std::vector<Entry>& entries) {
  std::string text = "[";
  for (const Entry& entry : entries) {
    text += (text.size() == 1 ? "\n" : ",\n") + json_of(entry).dump();
  }
  return text + "\n]";
}

}  // namespace

CocoAnnotation coco_annotation(std::int64_t id, std::int64_t image_id, int category_id,
                               const Rle& mask) {
  return {.id = id,
          .image_id = image_id,
          .category_id = category_id,
          .bbox = rle_box(mask),
          .area = static_cast<double>(rle_area(mask)),
          .iscrowd = false,
          .segmentation = mask};
}

void write_coco(const std::filesystem::path& path, const CocoDataset& dataset) {
  write_file(path, "{\"images\": " + list_text(dataset.images) +
                       ",\n\"annotations\": " + list_text(dataset.annotations) +
                       ",\n\"categories\": " + list_text(dataset.categories) + "}\n");
}

void write_coco_results(const std::filesystem::path& path, const std::vector<CocoResult>& results) {
  CocoResultsWriter writer(path);
  for (const CocoResult& result : results) writer.add(result);
  writer.finish();
}

CocoResultsWriter::CocoResultsWriter(const std::filesystem::path& path) : file_(path) {
  file_.stream() << '[';
}

void CocoResultsWriter::add(const CocoResult& result) {
  file_.stream() << (empty_ ? "\n" : ",\n") << json_of(result).dump();
  empty_ = false;
}

void CocoResultsWriter::finish() {
  file_.stream() << "\n]\n";
  file_.commit();
}

}  // namespace mms
