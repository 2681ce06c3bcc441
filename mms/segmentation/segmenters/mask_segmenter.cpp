#include "mms/segmentation/segmenters/mask_segmenter.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace mms {
namespace {

constexpr int kNoRun = -1;

/// Maximal horizontal run of one value: columns [begin, end) of row y.
struct Run {
  int y;
  int begin;
  int end;
  std::uint8_t value;
};

std::vector<Run> find_runs(const Image<std::uint8_t>& mask) {
  std::vector<Run> runs;
  for (int y = 0; y < mask.height(); ++y) {
    const std::uint8_t* row = mask.row(y);
    for (int x = 0; x < mask.width();) {
      const int end = static_cast<int>(
          std::find_if(row + x, row + mask.width(), [&](auto v) { return v != row[x]; }) - row);
      if (row[x] != 0) runs.push_back({y, x, end, row[x]});
      x = end;
    }
  }
  return runs;
}

int find_root(std::vector<int>& parent, int i) {
  while (parent[static_cast<std::size_t>(i)] != i) {
    auto& up = parent[static_cast<std::size_t>(i)];
    up = parent[static_cast<std::size_t>(up)];
    i = up;
  }
  return i;
}

/// First run of the component of every run; runs of adjacent rows are connected if their columns
/// overlap or meet at a corner.
std::vector<int> connect(const std::vector<Run>& runs) {
  std::vector<int> parent(runs.size());
  std::iota(parent.begin(), parent.end(), 0);
  std::size_t above = 0;
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const Run& run = runs[i];
    const auto is_before = [&](const Run& other) {
      return other.y < run.y - 1 || (other.y == run.y - 1 && other.end < run.begin);
    };
    while (above < i && is_before(runs[above])) ++above;
    for (std::size_t j = above; j < i && runs[j].y < run.y && runs[j].begin <= run.end; ++j) {
      if (runs[j].value != run.value) continue;
      const int a = find_root(parent, static_cast<int>(i));
      const int b = find_root(parent, static_cast<int>(j));
      parent[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    }
  }
  for (std::size_t i = 0; i < runs.size(); ++i) parent[i] = find_root(parent, static_cast<int>(i));
  return parent;
}

ObjectClass class_of(std::uint8_t value) {
  return value <= kObjectClassCount ? static_cast<ObjectClass>(value - 1) : ObjectClass::kPerson;
}

Instance make_instance(const std::vector<Run>& runs) {
  int x_end = 0;
  Instance instance;
  instance.object_class = class_of(runs.front().value);
  instance.x = runs.front().begin;
  instance.y = runs.front().y;
  for (const Run& run : runs) {
    instance.x = std::min(instance.x, run.begin);
    x_end = std::max(x_end, run.end);
  }
  instance.mask = Image<std::uint8_t>(x_end - instance.x, runs.back().y - instance.y + 1);
  for (const Run& run : runs) {
    std::uint8_t* row = instance.mask.row(run.y - instance.y) - instance.x;
    std::fill(row + run.begin, row + run.end, std::uint8_t{1});
  }
  return instance;
}

}  // namespace

Segmentation MaskSegmenter::segment(const Frame& frame) {
  const std::vector<Run> runs = find_runs(frame.mask);
  const std::vector<int> first = connect(runs);
  std::vector<std::vector<Run>> components;
  std::vector<int> component(runs.size(), kNoRun);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    int& slot = component[static_cast<std::size_t>(first[i])];
    if (slot == kNoRun) {
      slot = static_cast<int>(components.size());
      components.emplace_back();
    }
    components[static_cast<std::size_t>(slot)].push_back(runs[i]);
  }
  Segmentation segmentation{frame.mask.width(), frame.mask.height(), {}};
  for (const auto& part : components) segmentation.instances.push_back(make_instance(part));
  return segmentation;
}

}  // namespace mms
