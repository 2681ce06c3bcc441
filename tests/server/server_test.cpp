#include "mms/server/http/server.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <random>
#include <thread>

#include "mms/core/error.hpp"
#include "mms/io/cloud/ply_io.hpp"
#include "mms/server/scene/pictures.hpp"
#include "tests/io/temp_folder.hpp"
#include "tests/server/client.hpp"
#include "tests/server/scenes.hpp"

namespace mms {
namespace {

using namespace testing;  // NOLINT: helpers of the tests
using namespace std::chrono_literals;

ServerOptions any_port() {
  ServerOptions options;
  options.port = 0;
  options.version = "1.2.3";
  return options;
}

/// Waits, up to ten seconds, until `done()`.
template <class Condition>
bool wait_until(const Condition& done) {
  for (int i = 0; i < 2000; ++i) {
    if (done()) return true;
    std::this_thread::sleep_for(5ms);
  }
  return false;
}

TEST(Server, ServesPageWithTypes) {
  const ViewerServer server(any_port(), finished_scene(3));
  const HttpAnswer page = http_get(server.port(), "/");
  EXPECT_EQ(page.status, 200);
  EXPECT_EQ(page.type, "text/html; charset=utf-8");
  expect_in("<html", page.body);
  expect_in("default-src 'none'", page.policy);
  EXPECT_EQ(http_get(server.port(), "/favicon.svg").type, "image/svg+xml");
  EXPECT_EQ(http_get(server.port(), "/nothing").status, 404);
}

TEST(Server, ServesOnlyFilesOfRun) {
  const TempFolder folder;
  folder.write("run/static_map.ply", std::string(3'000'000, 'x'));
  folder.write("run/private.txt", "x");
  const ViewerServer server(any_port(), finished_scene(1, folder.path() / "run"));
  EXPECT_EQ(http_get(server.port(), "/files/static_map.ply").body.size(), 3'000'000U);
  for (const char* path : {"/files/private.txt", "/files/../run/static_map.ply",
                           "/files/..%2frun/static_map.ply", "/../../../etc/passwd"}) {
    EXPECT_EQ(http_get(server.port(), path).status, 404) << path;
  }
}

TEST(Server, SendsLargeFilesToSlowClients) {
  constexpr std::size_t kSize = 16'000'000;
  const TempFolder folder;
  folder.write("run/static_map.ply", std::string(kSize, 'x'));
  ServerOptions options = any_port();
  options.send_time = 500ms;
  const ViewerServer server(options, finished_scene(1, folder.path() / "run"));
  EXPECT_EQ(download_slowly(server.port(), "/files/static_map.ply", 200'000, 20ms), kSize);
}

TEST(Server, ServesMapOfLiveRun) {
  const TempFolder folder;
  const auto scene = std::make_shared<Scene>(scene_info(true));
  scene->add(frame_at(0), nullptr, floor_map(5));
  const ViewerServer server(any_port(), scene);
  const auto file = folder.write("map.ply", http_get(server.port(), "/files/static_map.ply").body);
  EXPECT_EQ(read_ply(file).points.size(), 25U);
  expect_in("0.000000000 0 0 0", http_get(server.port(), "/files/trajectory.tum").body);
}

TEST(Server, RejectsForeignOrigins) {
  const ViewerServer server(any_port(), finished_scene(3));
  const std::string own = "http://localhost:" + std::to_string(server.port());
  EXPECT_EQ(upgrade_status(server.port(), own), 101);
  EXPECT_EQ(upgrade_status(server.port(), ""), 101);
  EXPECT_EQ(upgrade_status(server.port(), "http://evil.example"), 403);
  EXPECT_EQ(upgrade_status(server.port(), own + "0"), 403);
  EXPECT_EQ(http_get(server.port(), "/", "Origin: http://evil.example\r\n").status, 403);
  EXPECT_EQ(http_get(server.port(), "/", "Host: evil.example\r\n").status, 403);
}

TEST(Server, SendsRunToViewer) {
  const ViewerServer server(any_port(), finished_scene(30));
  ViewerClient client(server.port());
  const DecodedMessage hello = client.wait_for("hello");
  EXPECT_EQ(hello.json["version"], "1.2.3");
  EXPECT_EQ(hello.json["frames"], 30);
  EXPECT_EQ(client.wait_for("trajectory").values<float>("pose").size(), 7 * 30U);
  client.send(R"({"type":"pause"})");
  client.send(R"({"type":"seek","frame":17})");
  while (client.wait_for("frame").json["frame"] != 17) {
  }
  EXPECT_EQ(server.viewers(), 1U);
}

TEST(Server, SurvivesGarbage) {
  const ViewerServer server(any_port(), finished_scene(3));
  expect_in("HTTP/1.1 400", send_raw(server.port(), "\x01\x02 what\r\n\r\n"));
  expect_in("HTTP/1.1 413", send_raw(server.port(), "GET /" + std::string(20'000, 'a') +
                                                        " HTTP/1.1\r\nHost: localhost\r\n\r\n"));
  expect_in("HTTP/1.1 413", send_raw(server.port(),
                                     "POST / HTTP/1.1\r\nHost: localhost\r\nContent-Length: "
                                     "100000\r\n\r\n" +
                                         std::string(100'000, 'b')));
  ViewerClient client(server.port());
  client.send("no JSON");
  expect_in("is not a JSON object", client.wait_for("error").json["message"].get<std::string>());
  client.send(std::string(300, '\xfe'), true);
  client.wait_for("error");
  client.send(std::string(100'000, 'x'));  // longer than a message may be
  while (client.read()) {
  }
  EXPECT_TRUE(wait_until([&] { return server.viewers() == 0; }));
  EXPECT_EQ(http_get(server.port(), "/").status, 200);
}

TEST(Server, DisconnectsClientsThatSendOnlyGarbage) {
  const ViewerServer server(any_port(), finished_scene(3));
  ViewerClient client(server.port());
  for (int i = 0; i < 200; ++i) client.send("garbage");
  while (client.read()) {
  }
  EXPECT_TRUE(wait_until([&] { return server.viewers() == 0; }));
}

TEST(Server, SlowViewerGetsOnlyNewestFrames) {
  SceneInfo info = scene_info(true);
  info.has_pictures = true;
  const auto scene = std::make_shared<Scene>(info);
  const auto large_view = [](std::size_t frame) {
    auto view = std::make_shared<SensorView>();
    view->frame = frame;
    view->cloud.points.assign(kMaxScanPoints, Eigen::Vector3f::Constant(1.0F));
    view->cloud.labels.assign(kMaxScanPoints, PointLabel::kStatic);
    return view;
  };
  scene->add(frame_at(0), large_view(0), nullptr);
  const ViewerServer server(any_port(), scene);
  ViewerClient slow(server.port());
  slow.wait_for("frame");
  constexpr std::size_t kFrames = 120;
  for (std::size_t i = 1; i <= kFrames; ++i) {  // the viewer does not read meanwhile
    scene->add(frame_at(i), large_view(i), nullptr);
    std::this_thread::sleep_for(20ms);
  }
  std::size_t frames = 0;
  std::size_t last = 0;
  while (last < kFrames) {
    last = slow.wait_for("frame").json["frame"].get<std::size_t>();
    ++frames;
  }
  EXPECT_LT(frames, 60U) << "it was sent outdated frames";
}

TEST(Server, SurvivesManyConcurrentViewers) {
  ServerOptions options = any_port();
  options.max_viewers = 12;
  const auto scene = finished_scene(200);
  const ViewerServer server(options, scene);
  std::vector<std::thread> clients;
  for (unsigned seed = 0; seed < 8; ++seed) {
    clients.emplace_back([&server, seed] {
      std::mt19937 random(seed);
      for (int i = 0; i < 10; ++i) {
        try {
          ViewerClient client(server.port());
          for (unsigned n = random() % 8; n > 0; --n) client.read();
          if (random() % 2 == 0) client.send(std::string(random() % 6000, 'g'));
          if (random() % 2 == 0) client.drop();
        } catch (const std::runtime_error&) {  // too many viewers
        }
      }
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_TRUE(wait_until([&] { return server.viewers() == 0; }));
  ViewerClient client(server.port());
  client.wait_for("frame");
}

TEST(Server, LimitsNumberOfViewers) {
  ServerOptions options = any_port();
  options.max_viewers = 2;
  const ViewerServer server(options, finished_scene(3));
  const ViewerClient first(server.port());
  auto second = std::make_unique<ViewerClient>(server.port());
  EXPECT_EQ(upgrade_status(server.port(), ""), 503);
  second->drop();
  EXPECT_TRUE(wait_until([&] { return upgrade_status(server.port(), "") == 101; }));
}

TEST(Server, ServesPageBesideSlowConnections) {
  const ViewerServer server(any_port(), finished_scene(3));
  std::vector<std::unique_ptr<SlowClient>> slow;
  for (int i = 0; i < 200; ++i) {
    slow.push_back(std::make_unique<SlowClient>(server.port(), "GET / HTTP/1.1\r\nHost: loc"));
  }
  const auto start = std::chrono::steady_clock::now();
  EXPECT_FALSE(http_get(server.port(), "/").type.empty());
  EXPECT_LT(std::chrono::steady_clock::now() - start, 1s);
}

TEST(Server, ClientsThatReadNothingKeepNobodyAway) {
  constexpr std::size_t kSize = 16'000'000;  // more than sockets keep
  const TempFolder folder;
  folder.write("run/static_map.ply", std::string(kSize, 'x'));
  const ViewerServer server(any_port(), finished_scene(1, folder.path() / "run"));
  const std::string request = "GET /files/static_map.ply HTTP/1.1\r\nHost: localhost\r\n\r\n";
  std::vector<std::unique_ptr<SlowClient>> idle;
  for (int i = 0; i < 200; ++i) {
    idle.push_back(std::make_unique<SlowClient>(server.port(), request));
  }
  SlowClient first(server.port(), "GET / HTTP/1.1\r\nHost: loc");
  SlowClient second(server.port(), "GET / HTTP/1.1\r\nHost: loc");
  EXPECT_FALSE(http_get(server.port(), "/").type.empty());
  EXPECT_TRUE(first.is_open());
  EXPECT_TRUE(second.is_open());
}

TEST(Server, ClosesConnectionsAtEnd) {
  auto server = std::make_unique<ViewerServer>(any_port(), finished_scene(3));
  ViewerClient client(server->port());
  client.wait_for("hello");
  std::thread end([&] { server.reset(); });
  while (client.read()) {
  }
  end.join();
}

TEST(Server, ReportsUrl) {
  const ViewerServer server(any_port(), finished_scene(1));
  EXPECT_EQ(server.url(), "http://localhost:" + std::to_string(server.port()));
  EXPECT_FALSE(server.is_open());
  ServerOptions open = any_port();
  open.address = "0.0.0.0";
  EXPECT_TRUE(ViewerServer(open, finished_scene(1)).is_open());
}

TEST(Server, ErrorsNameAddressProblem) {
  const ViewerServer server(any_port(), finished_scene(1));
  const auto error = [](const ServerOptions& options) {
    return message_of<DataError>([&] { ViewerServer(options, finished_scene(1)); });
  };
  ServerOptions used = any_port();
  used.port = server.port();
  used.port_hint = "--port N";
  expect_in("port " + std::to_string(server.port()) + ": is in use", error(used));
  expect_in("--port N", error(used));
  ServerOptions invalid = any_port();
  invalid.address = "here";
  expect_in("'here' is not an address", error(invalid));
  invalid.address = "192.0.2.1";
  expect_in("192.0.2.1", error(invalid));
}

}  // namespace
}  // namespace mms
