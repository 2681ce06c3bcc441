#include "mms/server/viewer/command.hpp"

#include <gtest/gtest.h>

#include "mms/core/error.hpp"
#include "tests/io/temp_folder.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

template <class Wanted>
Wanted parsed(std::string_view text) {
  return std::get<Wanted>(parse_command(text));
}

TEST(Command, ParsesAllTypes) {
  parsed<PlayCommand>(R"({"type":"play"})");
  parsed<PauseCommand>(R"({"type":"pause"})");
  EXPECT_EQ(parsed<StepCommand>(R"({"type":"step"})").by, 1);
  EXPECT_EQ(parsed<StepCommand>(R"({"type":"step","by":-3})").by, -3);
  EXPECT_EQ(parsed<SeekCommand>(R"({"type":"seek","frame":12})").frame, 12U);
  EXPECT_EQ(parsed<SpeedCommand>(R"({"type":"speed","value":2.5})").value, 2.5);
  const auto want = parsed<WantCommand>(R"({"type":"want","image":false,"budget":1000})");
  EXPECT_EQ(want.image, false);
  EXPECT_FALSE(want.points.has_value());
  EXPECT_EQ(want.budget, 1000U);
  EXPECT_EQ(parsed<FocusCommand>(R"({"type":"focus","point":[1,2,3.5]})").point,
            Eigen::Vector3f(1.0F, 2.0F, 3.5F));
}

TEST(Command, RejectsInvalidCommandsWithReason) {
  const auto reason = [](std::string_view text) {
    return message_of<DataError>([&] { parse_command(text); });
  };
  expect_in("is not a JSON object", reason(""));
  expect_in("is not a JSON object", reason("\xff\xfe{"));
  expect_in("is not a JSON object", reason("[1,2]"));
  expect_in("is not a JSON object", reason(std::string(2000, '[')));
  expect_in("has no \"type\"", reason("{}"));
  expect_in("known: play", reason(R"({"type":"format"})"));
  expect_in("known: play", reason(R"({"type":7})"));
  expect_in("has no \"frame\"", reason(R"({"type":"seek"})"));
  expect_in("\"frame\" must be a number from 0.0 to", reason(R"({"type":"seek","frame":-1})"));
  expect_in("\"frame\" must be a number", reason(R"({"type":"seek","frame":1e300})"));
  expect_in("\"value\" must be a number from 0.1 to 20", reason(R"({"type":"speed","value":0})"));
  expect_in("\"value\" must be", reason(R"({"type":"speed","value":"fast"})"));
  expect_in("\"points\" must be true or false", reason(R"({"type":"want","points":1})"));
  expect_in("[x, y, z]", reason(R"({"type":"focus","point":[1,2]})"));
  expect_in("longer than 4096", reason(std::string(5000, ' ')));
}

}  // namespace
}  // namespace mms
