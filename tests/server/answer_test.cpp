#include "mms/server/http/answer.hpp"

#include <gtest/gtest.h>

#include "mms/server/http/origin.hpp"
#include "mms/server/http/page.hpp"
#include "mms/server/scene/downloads.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/server/scenes.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests

Request get(const std::string& target) {
  Request request;
  request.target = target;
  request.host = "localhost:8080";
  return request;
}

Answer answer_of(const Request& request, bool loopback = true) {
  return answer_to(request, *finished_scene(1), loopback);
}

TEST(Origin, IsOwnOnlyForHost) {
  EXPECT_TRUE(is_own_origin("", "localhost:8080"));
  EXPECT_TRUE(is_own_origin("http://localhost:8080", "localhost:8080"));
  EXPECT_TRUE(is_own_origin("https://robot.lan", "robot.lan"));
  EXPECT_FALSE(is_own_origin("http://localhost:8081", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("http://evil.example", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("http://localhost:8080.evil.example", "localhost:8080"));
  EXPECT_FALSE(is_own_origin("null", "localhost:8080"));
}

TEST(Origin, RecognizesLoopbackNames) {
  for (const char* name : {"localhost", "localhost:1", "127.0.0.1:8080", "[::1]", "[::1]:8080"}) {
    EXPECT_TRUE(is_loopback_name(name)) << name;
  }
  for (const char* name : {"", "evil.example", "localhost.evil.example:8080", "[::2]:8080"}) {
    EXPECT_FALSE(is_loopback_name(name)) << name;
  }
}

TEST(Answer, RejectsForeignOriginsAndHosts) {
  Request foreign = get("/ws");
  foreign.upgrades = true;
  foreign.origin = "http://evil.example";
  EXPECT_EQ(answer_of(foreign).status, 403);
  Request rebound = get("/");
  rebound.host = "evil.example:8080";
  rebound.origin = "http://evil.example:8080";
  EXPECT_EQ(answer_of(rebound).status, 403);
  EXPECT_NE(answer_of(rebound, false).status, 403) << "an open server has any name";
  Request invalid = get("/");
  invalid.host = "a b\r\nX: y";
  EXPECT_EQ(answer_of(invalid, false).status, 400);
  invalid.host = "";
  EXPECT_EQ(answer_of(invalid).status, 400);
}

TEST(Answer, RejectsWriteMethods) {
  Request request = get("/");
  request.reads = false;
  EXPECT_EQ(answer_of(request).status, 405);
}

TEST(Answer, WebSocketNeedsUpgrade) {
  EXPECT_EQ(answer_of(get("/ws")).status, 426);
  Request request = get("/ws?x=1");
  request.upgrades = true;
  EXPECT_EQ(answer_of(request).kind, Answer::Kind::kWebSocket);
}

TEST(Answer, ServesPageWithTypes) {
  ASSERT_FALSE(page_files().empty()) << "viewer/dist is empty";
  const Answer page = answer_of(get("/"));
  ASSERT_EQ(page.kind, Answer::Kind::kBytes);
  EXPECT_EQ(page.type, "text/html; charset=utf-8");
  expect_in("<html", std::string(page.bytes));
  expect_in("connect-src 'self' ws://localhost:8080", page.policy);
  EXPECT_EQ(page.policy.find("unsafe"), std::string::npos);
  for (const PageFile& file : page_files()) {
    const Answer answer = answer_of(get(std::string(file.path)));
    EXPECT_EQ(answer.status, 200) << file.path;
    EXPECT_NE(answer.type, "application/octet-stream") << file.path;
    EXPECT_EQ(answer.bytes.size(), file.bytes.size());
  }
}

TEST(Answer, NotModifiedForKnownTag) {
  Request request = get("/index.html");
  request.known_tag = answer_of(request).tag;
  EXPECT_EQ(answer_of(request).status, 304);
  EXPECT_TRUE(answer_of(request).bytes.empty());
}

TEST(Answer, ServesOnlyKnownFiles) {
  const TempFolder folder;
  folder.write("run/trajectory.tum", "x");
  folder.write("run/secret.txt", "x");
  folder.write("run/static_map.ply/inner", "a folder");
  folder.write("trajectory.tum", "x");
  const auto scene = finished_scene(1, folder.path() / "run");
  EXPECT_EQ(download_names(*scene), std::vector<std::string>{"trajectory.tum"});
  const auto status = [&](const std::string& target) {
    return answer_to(get(target), *scene, true).status;
  };
  const Answer found = answer_to(get("/files/trajectory.tum"), *scene, true);
  EXPECT_EQ(found.kind, Answer::Kind::kFile);
  EXPECT_EQ(found.file, folder.path() / "run/trajectory.tum");
  EXPECT_EQ(found.download_name, "trajectory.tum");
  EXPECT_EQ(found.type, "text/plain; charset=utf-8");
  for (const char* target :
       {"/files/secret.txt", "/files/../trajectory.tum", "/files/%2e%2e/trajectory.tum",
        "/files//etc/passwd", "/files/", "/files/static_map.ply", "/files/report.html",
        "/files/trajectory.tum/", "/../etc/passwd", "/etc/passwd", "//", ""}) {
    EXPECT_EQ(status(target), 404) << target;
  }
}

TEST(Answer, LiveRunServesMapAndTrajectory) {
  Scene scene(scene_info(true));
  scene.add(frame_at(0), nullptr, floor_map(4));
  EXPECT_EQ(answer_to(get("/files/metrics.json"), scene, true).status, 404);
  const Answer answer = answer_to(get("/files/static_map.ply"), scene, true);
  EXPECT_EQ(answer.kind, Answer::Kind::kLiveFile);
  EXPECT_EQ(answer.live_file, "static_map.ply");
}

}  // namespace
}  // namespace mms
