#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "interfaces/python/src/bindings.hpp"
#include "interfaces/python/src/numpy_arrays.hpp"
#include "mms/dataset/open_dataset.hpp"
#include "mms/run/repeated_frames.hpp"

namespace mms::python {
namespace {

using Path = std::filesystem::path;

/// A recording that can be closed, with its warnings kept until Python can show them.
class Recording {
 public:
  Recording(const Path& path, const SourceOptions& options) : path_(path.string()) {
    const py::gil_scoped_release release;
    source_ = open_dataset(path, options);
    source_->on_warning([this](const std::string& line) { warnings_.push_back(line); });
  }

  /// The result of `call(source)`, without the GIL. Threads take turns.
  template <class Call>
  auto with_source(const Call& call) {
    std::vector<std::string> warnings;
    auto result = [&] {
      const py::gil_scoped_release release;
      const std::scoped_lock lock(mutex_);
      if (!source_) throw py::value_error(path_ + ": this recording is closed");
      auto value = call(*source_);
      warnings = std::exchange(warnings_, {});
      return value;
    }();
    warn(warnings);
    return result;
  }

  /// The next frame but those that mms run leaves out, too; nothing at the end.
  std::optional<Frame> next() {
    return with_source([this](FrameSource& source) {
      std::optional<Frame> frame = source.next();
      const auto keep_warning = [this](const std::string& line) { warnings_.push_back(line); };
      while (frame && repeated_.omits(*frame, keep_warning)) frame = source.next();
      return frame;
    });
  }

  /// Frames that were left out so far.
  std::size_t skipped() {
    return with_source(
        [this](const FrameSource& source) { return source.skipped() + repeated_.count(); });
  }

  void close() {
    const py::gil_scoped_release release;
    const std::scoped_lock lock(mutex_);
    source_.reset();
  }

 private:
  std::string path_;
  std::mutex mutex_;
  std::unique_ptr<FrameSource> source_;
  RepeatedFrames repeated_;
  std::vector<std::string> warnings_;
};

BagTopicNames topics_of(const std::map<std::string, std::string>& given) {
  BagTopicNames topics;
  const std::map<std::string, std::string*> names = {
      {"color", &topics.color}, {"depth", &topics.depth},
      {"cloud", &topics.cloud}, {"camera_info", &topics.camera_info},
      {"mask", &topics.mask},   {"wheels", &topics.wheels},
      {"imu", &topics.imu},     {"truth", &topics.truth}};
  for (const auto& [key, topic] : given) {
    const auto name = names.find(key);
    if (name == names.end()) {
      throw py::value_error("topics: has the key '" + key +
                            "', allowed: 'color', 'depth', 'cloud', 'camera_info', 'mask', "
                            "'wheels', 'imu', 'truth'");
    }
    *name->second = topic;
  }
  return topics;
}

std::unique_ptr<Recording> open_recording(
    const Path& path, const std::optional<Path>& masks, const std::optional<Path>& calibration,
    std::optional<std::array<double, 4>> intrinsics, std::optional<double> depth_scale,
    std::optional<double> rate, const std::map<std::string, std::string>& topics,
    const std::optional<Path>& wheels, const std::optional<Path>& imu) {
  SourceOptions options;
  options.masks = masks.value_or(Path());
  options.camera = {calibration.value_or(Path()), intrinsics, depth_scale};
  if (rate && !(*rate >= 0.2 && *rate <= 1000.0)) {  // as --rate
    throw py::value_error("rate: is " + std::to_string(*rate) + ", allowed: 0.2 to 1000");
  }
  options.rate = rate;
  options.topics = topics_of(topics);
  options.motion = {wheels.value_or(Path()), imu.value_or(Path())};
  return std::make_unique<Recording>(path, options);
}

Frame next_frame(Recording& recording) {
  std::optional<Frame> frame = recording.next();
  if (!frame) throw py::stop_iteration();
  return std::move(*frame);
}

/// A property that the source computes.
template <class Result>
auto from_source(Result (*read)(FrameSource&)) {
  return [read](Recording& recording) { return recording.with_source(read); };
}

}  // namespace

void bind_recording(py::module_& module) {
  py::class_<TruthCloud>(module, "TruthCloud", "Exact points of a simulation, as views.")
      .def_property_readonly(
          "points", [](const py::object& c) { return view(c.cast<TruthCloud&>().points, c); },
          "N x 3 float32, world frame of the ground-truth poses [m].")
      .def_property_readonly(
          "labels", [](const py::object& c) { return view(c.cast<TruthCloud&>().labels, c); },
          "N int32: 0 static, else 1 + id of the object.");
  py::class_<Recording>(module, "Recording",
                        "A recording as an iterator of Frame. Frames that are damaged, or repeat\n"
                        "an image or scan of the frame before, are left out with a warning.")
      .def(
          py::init(&open_recording), py::arg("path"), py::kw_only(), py::arg("masks") = py::none(),
          py::arg("calibration") = py::none(), py::arg("intrinsics") = py::none(),
          py::arg("depth_scale") = py::none(), py::arg("rate") = py::none(),
          py::arg("topics") = py::dict(), py::arg("wheels") = py::none(),
          py::arg("imu") = py::none(),
          "path: folder, bag, capture, or simulation such as 'sim:crowd', as for mms run.\n"
          "masks: folder of label images in place of the recording's.\n"
          "calibration: file, intrinsics: fx fy cx cy [px], depth_scale: units per meter; these\n"
          "replace the recording's. rate: frames a second of a recording without time stamps\n"
          "[Hz]. topics: of a bag, by 'color', 'depth', 'cloud', 'camera_info', 'mask', 'wheels',\n"
          "'imu' and 'truth', where type and name do not tell. wheels, imu: files in place of the\n"
          "recording's, or 'none'. Raises DataError, FileError, ConfigError, ValueError.")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__next__", &next_frame, "The next Frame. Raises ValueError after close().")
      .def("__len__", from_source<std::size_t>([](FrameSource& s) { return s.size(); }))
      .def("__enter__", [](const py::object& self) { return self; })
      .def("__exit__", [](Recording& recording, const py::args&) { recording.close(); })
      .def("close", &Recording::close, "Frees its memory. Frames stay valid.")
      .def(
          "skip",
          [](Recording& recording, std::size_t count) {
            recording.with_source([count](FrameSource& source) { return source.skip(count), 0; });
          },
          py::arg("count"), "Leaves out the next frames, without reading them.")
      .def("describe",
           from_source<std::vector<std::string>>([](FrameSource& s) { return s.describe(); }),
           "Facts, one a line, as mms info shows them.")
      .def_property_readonly("skipped", &Recording::skipped, "Damaged and repeated frames so far.")
      .def_property_readonly("has_masks",
                             from_source<bool>([](FrameSource& s) { return s.has_masks(); }),
                             "Whether any frame has masks.")
      .def_property_readonly("calibration",
                             from_source<std::shared_ptr<Calibration>>([](FrameSource& s) {
                               return std::const_pointer_cast<Calibration>(s.calibration());
                             }),
                             "Calibration, or None if only frames have one.")
      .def_property_readonly(
          "ground_truth", from_source<Trajectory>([](FrameSource& s) { return s.ground_truth(); }),
          "Trajectory in the recording's world frame; empty if unknown.")
      .def("map_truth",
           from_source<std::optional<TruthCloud>>([](FrameSource& s) { return s.map_truth(); }),
           "TruthCloud of the frames so far, or None if unknown. Raises Error.")
      .def("objects_truth",
           from_source<ObjectHistory>([](FrameSource& s) { return s.objects_truth(); }),
           "List of ObjectFrame of the frames so far; empty if unknown. Raises Error.");
}

}  // namespace mms::python
