#include <gtest/gtest.h>

#include "tests/io/temp_folder.hpp"
#include "tests/program/program.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

TEST(Info, DescribesWeightsFile) {
  const TempFolder folder;
  const Outcome outcome =
      run_mms(folder.path(), {"info", MMS_SOURCE_DIR "/weights/nano.safetensors"});
  expect_success(outcome);
  expect_in("segmentation network of the classes person, agv", outcome.out);
  expect_in("GFLOP for an image of 640x480 (input 416x320)", outcome.out);
  expect_in("size: nano", outcome.out);
}

TEST(Info, DamagedWeightsAreOneLineError) {
  const TempFolder folder;
  folder.write("broken.safetensors", "none");
  expect_error(run_mms(folder.path(), {"info", "broken.safetensors"}), "broken.safetensors: ");
}

}  // namespace
}  // namespace mms
